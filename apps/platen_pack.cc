// platen-pack: packs spheres into a specimen and judges the packing.
#include "apps/run/pack.h"
#include "apps/scene/apps.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  return run_app(argc, argv, description_of(AppKind::pack), run_pack);
}
