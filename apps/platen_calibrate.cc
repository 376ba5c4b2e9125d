// platen-calibrate: bonds that give a wanted material.
#include "apps/calibrate/run_calibrate.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  return run_app(argc, argv,
                 {AppKind::calibrate, "platen-calibrate",
                  "Finds bonds that give a wanted E, nu, compressive and tensile strength."},
                 run_calibrate);
}
