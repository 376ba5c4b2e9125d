// Text of a scene, .json where it begins with a brace, else .prm: what is set, and where, is read or refused.
#include <cstdint>

#include "apps/scene/declare.h"
#include "apps/scene/scene_files.h"

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
  try {
    if (!text.empty() && text.front() == '{')
      read_json_text(text, "fuzz.json", parameters);
    else
      read_prm_text(text, "fuzz.prm", parameters);
  } catch (const InputError &) {
  }
  return 0;
}
