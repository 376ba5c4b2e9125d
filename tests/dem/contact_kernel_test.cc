// Which rows of contacts are at work: the same for every instruction set, and those of the definition.
#include "dem/kernels/contact_kernel.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "base/table.h"
#include "dem/instruction_set.h"

namespace platen::dem::contact_kernel_test {
namespace {

struct Rows {
  Table particles, table;
  Column<Vector3> &position = particles.add<Vector3>("position", "m");
  Column<int> &first = table.add<int>("first", "1"), &second = table.add<int>("second", "1");
  Column<double> &rest = table.add<double>("rest_distance", "m");
  Column<int> &touching = table.add<int>("touching", "1");
};

TEST(ContactKernel, finds_rows_that_are_closer_than_at_rest_or_were_touching) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> draw(0, 1);
  Rows r;
  r.particles.resize(50);
  r.table.resize(1000);
  for (Vector3 &x : r.position)
    x = {draw(random), draw(random), draw(random)};
  r.position[17].y = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < r.table.size(); ++k) {
    r.first[k] = static_cast<int>(random() % 50), r.second[k] = static_cast<int>(random() % 50);
    r.rest[k] = k % 10 == 0 ? norm(r.position[r.second[k]] - r.position[r.first[k]]) : draw(random);
    r.touching[k] = random() % 20 == 0;
  }
  kernels::ContactColumns columns{};
  columns.first = r.first.data(), columns.second = r.second.data(), columns.rest_distance = r.rest.data();
  columns.touching = r.touching.data(), columns.position = r.position.data();
  const auto expected = [&](std::size_t from, std::size_t to) {
    std::vector<int> rows;
    for (std::size_t k = from; k < to; ++k) {
      const double square = norm_squared(r.position[r.second[k]] - r.position[r.first[k]]);
      if (!(square >= r.rest[k] * r.rest[k]) || r.touching[k]) rows.push_back(static_cast<int>(k));
    }
    return rows;
  };
  for (const auto &[kernels, set] : {std::pair{kernels::contact_kernels_baseline, InstructionSet::baseline},
                                     {kernels::contact_kernels_avx2, InstructionSet::avx2},
                                     {kernels::contact_kernels_avx512, InstructionSet::avx512}}) {
    if (set > best_instruction_set()) continue;
    for (const auto &[from, to] :
         {std::pair<std::size_t, std::size_t>{0, 1000}, {3, 4}, {5, 5}, {1, 992}, {7, 14}}) {
      std::vector<int> rows(to - from + 1, -7);
      const std::size_t count = kernels.rows_at_work(columns, from, to, rows.data());
      EXPECT_EQ(rows[count], -7) << "writes no more than it finds";
      rows.resize(count);
      EXPECT_EQ(rows, expected(from, to)) << name(set) << ", rows " << from << " to " << to;
    }
  }
  EXPECT_GT(expected(0, 1000).size(), 200u);
  EXPECT_LT(expected(0, 1000).size(), 800u);
}

} // namespace
} // namespace platen::dem::contact_kernel_test
