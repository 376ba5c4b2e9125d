// platen-bar: a bonded bar under tension, bending, torsion and impact.
#include "apps/bar/run_bar.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  return run_app(
      argc, argv,
      {AppKind::bar, "platen-bar",
       "Pulls, bends, twists and strikes a bonded bar and compares it with strength of materials."},
      run_bar);
}
