// platen-bonds: force and displacement of two and three bonded spheres.
#include "apps/bonds/run_bonds.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  return run_app(argc, argv,
                 {AppKind::bonds, "platen-bonds",
                  "Tests bonds between two or three spheres and compares them with closed forms."},
                 run_bonds);
}
