// Text of a scene, .json where it begins with a brace, else .prm: what is set, and where, is read or refused.
#include <cstdint>

#include "apps/scene/declare.h"

using namespace platen::apps;

namespace {

// Declared once; a run reads into a copy of the entries.
struct AllEntries {
  Scene scene;
  Parameters parameters;
  AllEntries() { declare_scene(parameters, scene); }
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  static const AllEntries declared;
  const std::string text(reinterpret_cast<const char *>(data), size);
  Parameters parameters = declared.parameters;
  const bool json = !text.empty() && text.front() == '{';
  parameters.apply(json ? json_assignments(text, "fuzz.json") : prm_assignments(text, "fuzz.prm"));
  return 0;
}
