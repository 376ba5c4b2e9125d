// platen-pack: packs spheres into a specimen and judges the packing.
#include "apps/run/pack.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  AppDescription app;
  app.kind = AppKind::pack;
  app.name = "platen-pack";
  app.purpose = "Packs spheres into a specimen and judges the packing.";
  return run_app(argc, argv, app, run_pack);
}
