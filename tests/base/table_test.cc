// Rows that are put between others.
#include "base/table.h"

#include <gtest/gtest.h>

#include <random>

namespace platen {
namespace {

std::vector<double> values(const Column<double> &column) {
  return {column.begin(), column.end()};
}

TEST(Table, gets_blank_rows_before_those_that_are_named) {
  Table table;
  Column<double> &a = table.add<double>("a", "m");
  Column<int> &b = table.add<int>("b", "1");
  table.resize(4);
  for (std::size_t k = 0; k < 4; ++k)
    a[k] = static_cast<double>(k + 1), b[k] = static_cast<int>(10 * (k + 1));
  table.insert({0, 2, 2, 4});
  EXPECT_EQ(table.size(), 8u);
  EXPECT_EQ(values(a), (std::vector<double>{0, 1, 2, 0, 0, 3, 4, 0}));
  EXPECT_EQ((std::vector<int>{b.begin(), b.end()}), (std::vector<int>{0, 10, 20, 0, 0, 30, 40, 0}));
  EXPECT_EQ(a.data()[8], 0) << "the spare row, which kernels read";
  table.insert({});
  EXPECT_EQ(table.size(), 8u);
}

TEST(Table, gets_rows_as_a_list_would) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const std::size_t size = random() % 9, more = random() % 5;
    Table table;
    Column<double> &a = table.add<double>("a", "m");
    table.resize(size);
    std::vector<double> expected(size);
    for (std::size_t k = 0; k < size; ++k)
      a[k] = expected[k] = static_cast<double>(random());
    std::vector<std::size_t> before(more);
    for (std::size_t &at : before)
      at = random() % (size + 1);
    std::sort(before.begin(), before.end());
    for (std::size_t n = 0; n < more; ++n)
      expected.insert(expected.begin() + static_cast<std::ptrdiff_t>(before[n] + n), 0.0);
    table.insert(before);
    EXPECT_EQ(values(a), expected) << "trial " << trial;
  }
}

} // namespace
} // namespace platen
