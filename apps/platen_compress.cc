// platen-compress: crushes, pulls or bends a bonded specimen between two platens.
#include "apps/run/compression.h"
#include "apps/run/ranks.h"
#include "apps/scene/apps.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  return run_app_on_ranks(argc, argv, description_of(AppKind::compress), run_compression);
}
