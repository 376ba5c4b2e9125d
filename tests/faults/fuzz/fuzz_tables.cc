// Tables of text: lists of ids, bonds, and specimens in all formats. The first byte chooses.
#include <cstdint>

#include "apps/output/specimen_csv.h"
#include "apps/scene/bond_file.h"
#include "apps/scene/errors.h"
#include "memory_file.h"

using namespace platen::apps;

namespace {

void read(const std::filesystem::path &path, int choice) {
  SpecimenForm form;
  form.filled = platen::dem::ShapeKind::cylinder;
  form.with_ids = choice % 8 == 3;
  switch (choice % 4) {
    case 0:
      read_id_list(path, 1000);
      return;
    case 1: {
      SpecimenFile spheres;
      for (int k = 0; k < 10; ++k)
        spheres.specimen.centre.push_back({0, 0, 2e-3 * k}), spheres.specimen.radius.push_back(1e-3);
      read_bond_file(path, spheres, {});
      return;
    }
    case 2:
      form.format = SpecimenFormat::yade;
      break;
    default:
      if (choice % 16 == 7) form.columns = "id, x_mm, y_mm, z_mm, diameter_mm";
  }
  read_specimen_file(path, form);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  if (size == 0) return 0;
  const platen::fuzz::MemoryFile file(data + 1, size - 1);
  try {
    read(file.path(), data[0]);
  } catch (const InputError &) {
  }
  return 0;
}
