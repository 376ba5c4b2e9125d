// platen-bar: a bonded bar under tension, bending, torsion and impact.
#include "apps/bar/run_bar.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  AppDescription app;
  app.kind = AppKind::bar;
  app.name = "platen-bar";
  app.purpose = "Pulls, bends, twists and strikes a bonded bar and compares it with strength of materials.";
  return run_app(argc, argv, app, run_bar);
}
