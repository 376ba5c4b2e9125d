// platen-bonds: force and displacement of two and three bonded spheres.
#include "apps/bonds/run_bonds.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  AppDescription app;
  app.kind = AppKind::bonds;
  app.name = "platen-bonds";
  app.purpose = "Tests bonds between two or three spheres and compares them with closed forms.";
  return run_app(argc, argv, app, run_bonds);
}
