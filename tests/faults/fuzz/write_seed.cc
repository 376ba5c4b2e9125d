// Writes a small checkpoint, for the fuzzer to begin with.
#include "apps/io/checkpoint.h"
#include "dem/vector3.h"

int main(int, char **arguments) {
  namespace dem = platen::dem;
  dem::Table table;
  auto &position = table.add<dem::Vector3>("position", "m");
  auto &radius = table.add<double>("radius", "m");
  auto &id = table.add<int>("id", "1");
  table.resize(2);
  for (int k = 0; k < 2; ++k) {
    const auto row = static_cast<std::size_t>(k);
    position[row] = {1.0 * k, 0, 0};
    radius[row] = 0.5;
    id[row] = k;
  }
  platen::apps::CheckpointWriter writer(arguments[1]);
  writer.add("step", std::uint64_t{12});
  writer.add("problem", std::vector<double>{1, 2});
  writer.add_text("reason", "bond 1");
  writer.add_table("particles", table);
  writer.finish();
}
