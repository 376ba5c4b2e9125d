// platen-brazilian: splits a disc of bonded spheres between two platens.
#include "apps/run/compression.h"
#include "apps/run/ranks.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  return run_app_on_ranks(
      argc, argv,
      {AppKind::brazilian, "platen-brazilian",
       "Splits a disc of bonded spheres along its diameter between two flat platens or strips."},
      run_brazilian);
}
