// Sorted lists of pairs, by blocks of first particles.
#include "dem/pair_lists.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace platen::dem {
namespace {

struct Row {
  IndexPair pair;
  double value = 0;
  operator IndexPair() const { return pair; }
};

int drawn(Random &random, int below) {
  return static_cast<int>(random.uniform(0, below));
}

// Each with its next three.
PairLists<IndexPair> neighbours(int spheres) {
  std::vector<IndexPair> pairs;
  for (int i = 0; i + 3 < spheres; ++i)
    for (int j = 1; j <= 3; ++j)
      pairs.push_back({i, i + j});
  PairLists<IndexPair> lists;
  lists.assign(pairs);
  return lists;
}

TEST(pair_lists, hold_what_one_sorted_list_holds) {
  Random random(3);
  PairLists<Row> lists;
  std::vector<Row> sorted;
  for (int k = 0; k < 3000; ++k) {
    const IndexPair pair{drawn(random, 2000), 2000 + drawn(random, 3)};
    const auto at =
        std::lower_bound(sorted.begin(), sorted.end(), pair, [](IndexPair a, IndexPair b) { return a < b; });
    const bool is_new = at == sorted.end() || !(at->pair == pair);
    ASSERT_EQ(lists.insert({pair, 1.0 * k}), is_new);
    if (is_new) sorted.insert(at, {pair, 1.0 * k});
  }
  const auto expect_equal = [&] {
    const std::vector<Row> rows = lists.rows();
    ASSERT_EQ(lists.size(), sorted.size());
    ASSERT_EQ(rows.size(), sorted.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      ASSERT_TRUE(rows[k].pair == sorted[k].pair) << k;
      ASSERT_EQ(rows[k].value, sorted[k].value) << k;
      ASSERT_EQ(lists.find(sorted[k].pair)->value, sorted[k].value) << k;
    }
  };
  expect_equal();
  EXPECT_EQ(lists.find({5, 2003}), nullptr);
  EXPECT_EQ(lists.find({99999, 100000}), nullptr);
  lists.assign(lists.rows());
  expect_equal();
  const std::vector<Row> even = lists.rows_if([](const Row &row) { return row.pair.first % 2 == 0; });
  std::size_t of_even = 0;
  for (const Row &row : sorted)
    of_even += row.pair.first % 2 == 0;
  EXPECT_EQ(even.size(), of_even);
  lists.assign({});
  EXPECT_EQ(lists.size(), 0u);
  EXPECT_TRUE(lists.rows().empty());
}

TEST(pair_lists, a_pair_that_is_added_moves_as_much_in_a_large_specimen_as_in_a_small_one) {
  const auto bytes_of_a_pair = [](int spheres) {
    constexpr int pairs = 200;
    PairLists<IndexPair> lists = neighbours(spheres);
    Random random(4);
    for (int k = 0; k < pairs; ++k) {
      const int first = drawn(random, spheres - 100);
      lists.insert({first, first + 4 + drawn(random, 90)});
    }
    return static_cast<double>(lists.bytes_moved()) / pairs;
  };
  const double small = bytes_of_a_pair(20000), large = bytes_of_a_pair(80000);
  EXPECT_NEAR(large / small, 1, .2);
  // Half a block of three pairs each in the mean.
  EXPECT_NEAR(small, .5 * 3 * block_rows * sizeof(IndexPair), .2 * small);
}

} // namespace
} // namespace platen::dem
