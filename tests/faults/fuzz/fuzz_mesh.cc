// Meshes of Gmsh, as far as they are looked at before deal.II reads them.
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "fem/gmsh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  try {
    platen::fem::check_gmsh({reinterpret_cast<const char *>(data), size}, "fuzzed.msh");
  } catch (const std::invalid_argument &refused) {
    if (std::string_view(refused.what()).rfind("fuzzed.msh:", 0) != 0) __builtin_trap();
  }
  return 0;
}
