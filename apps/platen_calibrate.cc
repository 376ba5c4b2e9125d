// platen-calibrate: bonds that give a wanted material.
#include "apps/calibrate/run_calibrate.h"
#include "apps/scene/apps.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  return run_app(argc, argv, description_of(AppKind::calibrate), run_calibrate);
}
