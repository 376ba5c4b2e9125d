// platen-bar: a bonded bar under tension, bending, torsion and impact.
#include "apps/bar/run_bar.h"
#include "apps/scene/apps.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  return run_app(argc, argv, description_of(AppKind::bar), run_bar);
}
