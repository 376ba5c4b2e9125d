// Writes a small checkpoint, for the fuzzer to begin with.
#include "apps/output/checkpoint.h"
#include "base/vector3.h"

namespace {

struct Spheres {
  platen::Table table;
  platen::Column<platen::Vector3> &position = table.add<platen::Vector3>("position", "m");
  platen::Column<double> &radius = table.add<double>("radius", "m");
  platen::Column<int> &id = table.add<int>("id", "1");
  void describe(platen::Archive &archive) {
    archive.version(1);
    std::uint64_t step = 12;
    std::vector<double> numbers{1, 2};
    std::string reason = "bond 1";
    archive("step", step);
    archive.rows("numbers", numbers);
    archive.text("reason", reason);
    archive.table("particles", table);
  }
};

} // namespace

int main(int, char **arguments) {
  Spheres spheres;
  spheres.table.resize(2);
  for (int k = 0; k < 2; ++k) {
    const auto row = static_cast<std::size_t>(k);
    spheres.position[row] = {1.0 * k, 0, 0};
    spheres.radius[row] = 0.5;
    spheres.id[row] = k;
  }
  platen::apps::CheckpointWriter writer(arguments[1]);
  platen::save_part(writer, "part", spheres);
  writer.finish();
}
