// platen-brazilian: splits a disc of bonded spheres between two platens.
#include "apps/run/compression.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  AppDescription app;
  app.kind = AppKind::brazilian;
  app.name = "platen-brazilian";
  app.purpose = "Splits a disc of bonded spheres along its diameter between two flat platens or strips.";
  return run_app(argc, argv, app, run_brazilian);
}
