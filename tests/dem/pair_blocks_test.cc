// Blocks of pairs: what leaves a block, where it returns to, and blocks that are cut again one by one.
#include "dem/pair_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/parallel.h"
#include "base/random.h"
#include "dem/model.h"
#include "dem/pair_lists.h"
#include "tests/dem/examples.h"
#include "tests/same_state.h"

namespace platen::dem::pair_blocks_test {
namespace {

using Pair = std::pair<int, int>;

struct Pairs {
  std::vector<int> first, second;
  explicit Pairs(std::vector<Pair> pairs) {
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    for (const auto &[i, j] : pairs)
      first.push_back(i), second.push_back(j);
  }
};

std::vector<Pair> random_pairs(std::mt19937 &random, int particles, int count) {
  std::vector<Pair> pairs;
  while (static_cast<int>(pairs.size()) < count) {
    const int i = static_cast<int>(random() % static_cast<unsigned>(particles - 1));
    const int j = std::min(particles - 1, i + 1 + static_cast<int>(random() % 1200));
    pairs.push_back({i, j});
  }
  return pairs;
}

void cut(PairBlocks &blocks, const Pairs &pairs, std::size_t particles,
         const std::vector<char> *changed = nullptr) {
  blocks.rebuild(pairs.first.data(), pairs.second.data(), pairs.first.size(), particles, true, 3, changed);
}

// What the definition says of every pair, ghost and return.
void expect_cut(const PairBlocks &blocks, const Pairs &pairs, std::size_t particles) {
  ASSERT_EQ(blocks.blocks(), number_of_blocks(particles));
  ASSERT_EQ(blocks.ends.size(), pairs.first.size());
  for (std::size_t b = 0; b < blocks.blocks(); ++b) {
    const int begin = static_cast<int>(b * block_rows);
    const int own = static_cast<int>(std::min(particles, (b + 1) * block_rows)) - begin;
    const auto ghosts = blocks.ghost_particle.begin() + static_cast<std::ptrdiff_t>(blocks.first_ghost[b]);
    EXPECT_TRUE(std::is_sorted(
        ghosts, blocks.ghost_particle.begin() + static_cast<std::ptrdiff_t>(blocks.first_ghost[b + 1])));
    for (std::size_t k = blocks.first_pair[b]; k < blocks.first_pair[b + 1]; ++k) {
      EXPECT_EQ(blocks.ends[k].first, 3 * (pairs.first[k] - begin)) << "pair " << k;
      const int second = blocks.ends[k].second / 3;
      EXPECT_EQ(second < own ? begin + second : ghosts[second - own], pairs.second[k]) << "pair " << k;
    }
  }
  ASSERT_EQ(blocks.returns.size(), blocks.own_ghosts());
  int before = -1, from_before = -1;
  for (std::size_t r = 0; r < blocks.returns.size(); ++r) {
    const auto &[particle, ghost] = blocks.returns[r];
    EXPECT_EQ(blocks.ghost_particle[ghost], particle);
    EXPECT_TRUE(particle > before || (particle == before && ghost > from_before)) << "return " << r;
    before = particle, from_before = ghost;
    const std::size_t block = static_cast<std::size_t>(particle) / block_rows;
    EXPECT_TRUE(r >= blocks.first_return[block] && r < blocks.first_return[block + 1]) << "return " << r;
  }
}

TEST(PairBlocks, are_cut_as_they_are_defined) {
  std::mt19937 random(3);
  for (const std::size_t particles : {1u, 2u, 511u, 512u, 513u, 1700u, 5000u}) {
    const Pairs pairs(particles > 1 ? random_pairs(random, static_cast<int>(particles), 900)
                                    : std::vector<Pair>{});
    PairBlocks blocks;
    cut(blocks, pairs, particles);
    expect_cut(blocks, pairs, particles);
    EXPECT_EQ(blocks.ghost_force.size(), blocks.own_ghosts());
    EXPECT_EQ(blocks.ghost_torque.size(), blocks.own_ghosts());
  }
}

TEST(PairBlocks, that_have_changed_are_cut_alone_to_the_same_end) {
  constexpr std::size_t particles = 5000;
  std::mt19937 random(5);
  std::vector<Pair> all = random_pairs(random, particles, 2000);
  PairBlocks blocks;
  cut(blocks, Pairs(all), particles);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<char> changed(blocks.blocks(), 0);
    for (const Pair &pair : random_pairs(random, particles, 1 + trial % 3)) {
      all.push_back(pair);
      changed[static_cast<std::size_t>(pair.first) / block_rows] = 1;
    }
    const Pairs pairs(all);
    const unsigned number = blocks.cut_number();
    cut(blocks, pairs, particles, &changed);
    expect_cut(blocks, pairs, particles);
    EXPECT_NE(blocks.cut_number(), number);
  }
}

// Of so few second particles that each is reached from every block before its own.
std::vector<Pair> pairs_to_the_last(std::mt19937 &random, int particles, int count) {
  std::vector<Pair> pairs;
  for (int k = 0; k < count; ++k)
    pairs.push_back({static_cast<int>(random() % static_cast<unsigned>(particles - 20)),
                     particles - 1 - static_cast<int>(random() % 20)});
  return pairs;
}

// Behind those that were there, until all are cut again.
TEST(PairBlocks, that_get_a_pair_reach_its_particles_and_return_in_the_order_of_blocks) {
  constexpr std::size_t particles = 5000;
  std::mt19937 random(6);
  for (const int before : {0, 40, 2000}) {
    std::vector<Pair> all = pairs_to_the_last(random, particles, before);
    Pairs pairs(all);
    PairBlocks blocks;
    cut(blocks, pairs, particles);
    for (int more = 0; more < 300; ++more) {
      const Pair pair = pairs_to_the_last(random, particles, 1).front();
      pairs.first.push_back(pair.first), pairs.second.push_back(pair.second);
      blocks.add(pair.first, pair.second, particles);
      const auto block = static_cast<std::size_t>(pair.first) / block_rows;
      const int begin = static_cast<int>(block * block_rows),
                own = static_cast<int>(std::min(particles - block * block_rows, block_rows));
      ASSERT_EQ(blocks.ends.size(), pairs.first.size());
      const PairBlocks::Ends ends = blocks.ends.back();
      ASSERT_EQ(begin + ends.first / 3, pair.first);
      const int second = ends.second / 3;
      const std::size_t ghost = blocks.first_ghost[block] + static_cast<std::size_t>(second - own);
      ASSERT_EQ(second < own ? begin + second : blocks.ghost_particle[ghost], pair.second);
      if (second >= own) {
        ASSERT_EQ(blocks.ghost_of(static_cast<int>(block), pair.second), static_cast<int>(ghost));
      }
    }
    // One ghost for each particle that a block reaches, and its return in the order of blocks.
    std::vector<Pair> reached; // particle, block that it comes from
    for (std::size_t k = 0; k < pairs.first.size(); ++k)
      if (pairs.first[k] / static_cast<int>(block_rows) != pairs.second[k] / static_cast<int>(block_rows))
        reached.push_back({pairs.second[k], pairs.first[k] / static_cast<int>(block_rows)});
    std::sort(reached.begin(), reached.end());
    reached.erase(std::unique(reached.begin(), reached.end()), reached.end());
    // Forces so unlike that each order of a sum has another end.
    Model model(examples::row(particles, {1, 0, 0}), examples::bonded());
    Particles &p = model.particles;
    std::vector<Vector3> expected(particles);
    for (const auto &[particle, block] : reached) {
      const double force = (block % 2 == 0 ? 1 : -1) * std::pow(10, 5 * (block % 4)) / 3;
      const int ghost = blocks.ghost_of(block, particle);
      ASSERT_GE(ghost, 0);
      ASSERT_EQ(blocks.ghost_particle[ghost], particle);
      blocks.ghost_force[ghost] = {force, 2 * force, -force};
      expected[particle] += {force, 2 * force, -force};
    }
    EXPECT_EQ(blocks.own_ghosts(), reached.size()) << "one ghost for each particle that a block reaches";
    std::fill(p.force.begin(), p.force.end(), Vector3{});
    for (std::size_t block = 0; block < blocks.blocks(); ++block)
      return_ghosts(p, blocks, block);
    for (std::size_t i = 0; i < particles; ++i)
      ASSERT_EQ(p.force[i].x, expected[i].x) << i;
    EXPECT_EQ(blocks.ghost_force.size(), blocks.own_ghosts());
    EXPECT_EQ(blocks.ghost_torque.size(), blocks.own_ghosts());
    // Forces in ghosts of one block are cleared, and no others.
    blocks.ghost_force.assign(blocks.own_ghosts(), Vector3{1, 1, 1});
    blocks.ghost_torque.assign(blocks.own_ghosts(), Vector3{1, 1, 1});
    blocks.clear_ghosts(1);
    for (const auto &[particle, block] : reached) {
      const auto ghost = static_cast<std::size_t>(blocks.ghost_of(block, particle));
      EXPECT_EQ(norm_squared(blocks.ghost_force[ghost]), block == 1 ? 0 : 3);
      EXPECT_EQ(norm_squared(blocks.ghost_torque[ghost]), block == 1 ? 0 : 3);
    }
    const Pairs sorted([&] {
      std::vector<Pair> list;
      for (std::size_t k = 0; k < pairs.first.size(); ++k)
        list.push_back({pairs.first[k], pairs.second[k]});
      return list;
    }());
    cut(blocks, sorted, particles);
    expect_cut(blocks, sorted, particles);
  }
}

// A ghost that is computed elsewhere is returned between those of the blocks before and behind its own.
TEST(PairBlocks, return_remote_ghosts_by_the_blocks_that_they_come_from) {
  constexpr std::size_t particles = 4 * block_rows;
  const int last = static_cast<int>(particles) - 1, b = static_cast<int>(block_rows);
  const Pairs pairs({{0, last}, {2 * b, last}, {0, b}});
  PairBlocks blocks;
  blocks.remote = {{last, 1}, {b, 2}, {last, 3}};
  cut(blocks, pairs, particles);
  std::vector<Pair> returned;
  for (const auto &[particle, ghost] : blocks.returns)
    returned.push_back({particle, ghost});
  // Own ghosts: 0 (b, from block 0), 1 (last, from block 0), 2 (last, from block 2).
  EXPECT_EQ(returned, (std::vector<Pair>{{b, 0}, {b, 4}, {last, 1}, {last, 3}, {last, 2}, {last, 5}}));
  EXPECT_EQ(blocks.ghost_force.size(), 6u);
}

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

// The last bond of the first block of 512 spheres; the second of its spheres is in the next block. All others
// stay at rest.
TEST(pair_blocks, a_bond_between_two_blocks_pulls_at_neither_once_it_is_broken) {
  using namespace examples;
  Model model(row(1100, {1, 0, 0}), breakable());
  Particles &p = model.particles;
  for (std::size_t i = 512; i < p.size(); ++i)
    p.position[i].x += 1.2 * tensile_strength / normal_stiffness;
  model.compute_forces(1e-9);
  EXPECT_EQ(model.broken_tension, 1);
  const double strength = tensile_strength * area; // others hold round-off of a place 2.9 m away
  for (std::size_t i = 0; i < p.size(); ++i)
    ASSERT_LT(norm(p.force[i]), 1e-6 * strength) << i;
}

// The last bond of the first block, which ends in the second, and the one after it.
TEST(pair_blocks, a_state_with_bonds_that_are_not_in_the_order_of_blocks_is_refused) {
  Model model(examples::row(1100, {1, 0, 0}), examples::bonded());
  const State good = state_of(model);
  State exchanged = good;
  constexpr std::size_t last = block_rows - 1;
  for (const std::string &name : good.names())
    if (name.find("bonds/rows/") != std::string::npos && good.find(name)->rows > last + 1) {
      const std::size_t size = good.find(name)->type.bytes_per_row();
      std::vector<char> rows(good.find(name)->rows * size);
      good.read(name, rows.data());
      const auto of_last = rows.begin() + static_cast<std::ptrdiff_t>(last * size);
      std::swap_ranges(of_last, of_last + static_cast<std::ptrdiff_t>(size),
                       of_last + static_cast<std::ptrdiff_t>(size));
      exchanged = with_rows(exchanged, name, rows);
    }
  const auto read = [&](const State &state) {
    read_parts(state, [&](Archive &archive) { archive.part("state", model); });
  };
  try {
    read(exchanged);
    ADD_FAILURE() << "was taken";
  } catch (const StateError &e) {
    EXPECT_STREQ(e.what(),
                 "\"state/bonds/rows/first\", row 512: 511. Allowed: in the order of blocks of particles.");
  }
  EXPECT_NO_THROW(read(good));
}

} // namespace
} // namespace platen::dem::pair_blocks_test
