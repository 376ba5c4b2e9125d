// platen-brazilian: splits a disc of bonded spheres between two platens.
#include "apps/run/compression.h"
#include "apps/run/ranks.h"
#include "apps/scene/apps.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  return run_app_on_ranks(argc, argv, description_of(AppKind::brazilian), run_brazilian);
}
