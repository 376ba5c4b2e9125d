#include "apps/scene/apps.h"

#include <stdexcept>

namespace platen::apps {

AppDescription description_of(AppKind kind) {
  AppDescription app;
  app.kind = kind;
  switch (kind) {
    case AppKind::pack:
      app.name = "platen-pack";
      app.purpose = "Packs spheres into a specimen and judges the packing.";
      return app;
    case AppKind::bonds:
      app.name = "platen-bonds";
      app.purpose = "Tests bonds between two or three spheres and compares them with closed forms.";
      return app;
    case AppKind::bar:
      app.name = "platen-bar";
      app.purpose =
          "Pulls, bends, twists and strikes a bonded bar and compares it with strength of materials.";
      app.caches_packings = true;
      return app;
    case AppKind::compress:
      app.name = "platen-compress";
      app.purpose = "Crushes, pulls by glued ends or bends a specimen of bonded spheres between two platens.";
      app.shares_packings = true;
      app.caches_packings = true;
      return app;
    case AppKind::brazilian:
      app.name = "platen-brazilian";
      app.purpose = "Splits a disc of bonded spheres along its diameter between two flat platens or strips.";
      app.caches_packings = true;
      return app;
    case AppKind::calibrate:
      app.name = "platen-calibrate";
      app.purpose = "Finds bonds that give a wanted E, nu, compressive and tensile strength.";
      app.caches_packings = true;
      return app;
    case AppKind::study:
      app.name = "platen-study";
      app.purpose =
          "Runs platen-compress over platens, slendernesses, sizes, packings, rates or what trades accuracy "
          "for time, each on several seeds, and tables the results; or finds the cheapest runs for an "
          "accuracy "
          "that is ordered (target).";
      app.kinds = {study_words.begin(), study_words.end()};
      app.caches_packings = true;
      app.plans_runs = true;
      return app;
  }
  throw std::logic_error("no such app");
}

} // namespace platen::apps
