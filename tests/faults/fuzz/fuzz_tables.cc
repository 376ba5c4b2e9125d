// Tables of text: specimens in all formats and lists of ids. The first byte chooses.
#include <cstdint>

#include "apps/output/specimen_csv.h"
#include "apps/scene/errors.h"
#include "memory_file.h"

using namespace platen::apps;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  if (size == 0) return 0;
  const platen::fuzz::MemoryFile file(data + 1, size - 1);
  try {
    if (data[0] % 3 == 0)
      read_id_list(file.path(), 1000);
    else
      read_specimen_file(file.path(), {data[0] % 2 == 0 ? SpecimenFormat::automatic : SpecimenFormat::yade,
                                       "", dem::ShapeKind::cylinder, data[0] % 5 == 0});
  } catch (const InputError &) {
  }
  return 0;
}
