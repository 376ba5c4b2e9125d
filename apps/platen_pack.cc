// platen-pack: packs spheres into a specimen and judges the packing.
#include "apps/run/pack.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  return run_app(argc, argv,
                 {AppKind::pack, "platen-pack", "Packs spheres into a specimen and judges the packing."},
                 run_pack);
}
