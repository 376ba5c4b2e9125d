// platen-compress: crushes, pulls or bends a bonded specimen between two platens.
#include "apps/run/compression.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  AppDescription app;
  app.kind = AppKind::compress;
  app.name = "platen-compress";
  app.purpose = "Crushes, pulls by glued ends or bends a specimen of bonded spheres between two platens.";
  return run_app(argc, argv, app, run_compression);
}
