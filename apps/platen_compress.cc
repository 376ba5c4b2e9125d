// platen-compress: crushes, pulls or bends a bonded specimen between two platens.
#include "apps/run/compression.h"
#include "apps/run/ranks.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  AppDescription app{
      AppKind::compress, "platen-compress",
      "Crushes, pulls by glued ends or bends a specimen of bonded spheres between two platens."};
  app.shares_packings = true;
  return run_app_on_ranks(argc, argv, app, run_compression);
}
