// A scene file as an app reads it, with all checks of what entries mean together. The first byte chooses the
// app.
#include <unistd.h>

#include <cstdint>
#include <fstream>

#include "apps/programs.h"
#include "apps/scene/errors.h"
#include "apps/scene/scene.h"

using namespace platen::apps;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  if (size == 0) return 0;
  // The reader goes by the ending of the name.
  const std::string path =
      "/dev/shm/platen_fuzz_" + std::to_string(getpid()) + (size > 1 && data[1] == '{' ? ".json" : ".prm");
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char *>(data) + 1, static_cast<std::streamsize>(size) - 1);
  try {
    read_scene(path, {}, programs()[data[0] % programs().size()]);
  } catch (const InputError &) {
  }
  unlink(path.c_str());
  return 0;
}
