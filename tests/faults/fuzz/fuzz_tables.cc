// Tables of text: specimens, lists of ids, and the CSV files that reports are made of. The first byte
// chooses.
#include <cstdint>

#include "apps/output/specimen_csv.h"
#include "apps/report/csv.h"
#include "apps/scene/errors.h"
#include "memory_file.h"

using namespace platen::apps;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  if (size == 0) return 0;
  const platen::fuzz::MemoryFile file(data + 1, size - 1);
  try {
    switch (data[0] % 4) {
      case 0:
      case 1:
        read_specimen_csv(file.path());
        break;
      case 2:
        read_id_list(file.path(), 1000);
        break;
      default:
        report::read_csv(file.path(), {"mode"});
    }
  } catch (const InputError &) {
  }
  return 0;
}
