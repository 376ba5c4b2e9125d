// platen-bonds: force and displacement of two and three bonded spheres.
#include "apps/bonds/run_bonds.h"
#include "apps/scene/apps.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  return run_app(argc, argv, description_of(AppKind::bonds), run_bonds);
}
