// platen-calibrate: bonds that give a wanted material.
#include "apps/calibrate/run_calibrate.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  AppDescription app;
  app.kind = AppKind::calibrate;
  app.name = "platen-calibrate";
  app.purpose = "Finds bonds that give a wanted E, nu, compressive and tensile strength.";
  return run_app(argc, argv, app, run_calibrate);
}
