// platen-study: sweeps what a result may depend on, each case on several seeds.
#include "apps/scene/apps.h"
#include "apps/study/run_study.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  return run_app(argc, argv, description_of(AppKind::study), run_study);
}
