#include "dist/block_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "block_graphs.h"
#include "dem/packing/specimen.h"
#include "dem/pair_blocks.h"
#include "dem/particles.h"

using namespace platen;
using namespace platen::dist;

namespace {

constexpr double radius = 1e-3; // m

// A straight row of touching spheres: Morton order is the order along it.
dem::Specimen row(std::size_t spheres) {
  dem::Specimen specimen;
  for (std::size_t k = 0; k < spheres; ++k) {
    specimen.centre.push_back({2 * radius * static_cast<double>(k), 0, 0});
    specimen.radius.push_back(radius);
  }
  return specimen;
}

dem::PairBlocks pairs_of(const std::vector<int> &first, const std::vector<int> &second,
                         std::size_t particles) {
  dem::PairBlocks blocks;
  blocks.rebuild(first.data(), second.data(), first.size(), particles, false);
  return blocks;
}

dem::PairBlocks chain(std::size_t particles) {
  std::vector<int> first, second;
  for (int k = 0; k + 1 < static_cast<int>(particles); ++k) {
    first.push_back(k);
    second.push_back(k + 1);
  }
  return pairs_of(first, second, particles);
}

TEST(BlockGraph, of_a_row_of_spheres_is_a_chain_of_blocks) {
  const std::size_t spheres = 2 * block_rows + 100;
  const dem::Particles particles(row(spheres), 2500, false);
  const BlockGraph graph = graph_of(chain(spheres), particles);
  ASSERT_EQ(graph.blocks(), 3u);
  EXPECT_EQ(graph.first_edge, (std::vector<std::size_t>{0, 1, 3, 4}));
  EXPECT_EQ(graph.neighbour, (std::vector<int>{1, 0, 2, 1}));
  EXPECT_EQ(graph.edge_weight, (std::vector<double>(4, 1.0))); // one ghost where the row goes on
  const double full = 512 * (1 + work_of_a_particle);
  EXPECT_NEAR(graph.weight[0], full, 1e-9);
  EXPECT_NEAR(graph.weight[1], full, 1e-9);
  EXPECT_NEAR(graph.weight[2], 99 + 100 * work_of_a_particle, 1e-9); // the last sphere begins no bond
  EXPECT_NEAR(graph.centre[1].x, 2 * radius * (512 + 255.5), 1e-12);
  EXPECT_NEAR(graph.centre[2].x, 2 * radius * (1024 + 49.5), 1e-12);
  require_consistent(graph);
}

TEST(BlockGraph, counts_a_ghost_once_however_many_bonds_reach_it_and_keeps_far_neighbours) {
  const std::size_t spheres = 3 * block_rows;
  const dem::Particles particles(row(spheres), 2500, false);
  // Two bonds to particle 600, one to 700 (block 1); one to 1100 (block 2).
  const BlockGraph graph = graph_of(pairs_of({0, 1, 2, 3}, {600, 600, 700, 1100}, spheres), particles);
  EXPECT_EQ(graph.first_edge, (std::vector<std::size_t>{0, 2, 3, 4}));
  EXPECT_EQ(graph.neighbour, (std::vector<int>{1, 2, 0, 0}));
  EXPECT_EQ(graph.edge_weight, (std::vector<double>{2, 1, 2, 1}));
}

TEST(BlockGraph, contacts_add_to_the_work_and_to_the_ghosts) {
  const std::size_t spheres = 3 * block_rows;
  const dem::Particles particles(row(spheres), 2500, false);
  BlockGraph graph = graph_of(chain(spheres), particles);
  const double before = graph.weight[0];
  add_pairs(graph, pairs_of({5, 6, 7}, {9, 1200, 513}, spheres));
  EXPECT_DOUBLE_EQ(graph.weight[0], before + 3);
  EXPECT_EQ(graph.neighbour, (std::vector<int>{1, 2, 0, 2, 0, 1}));
  EXPECT_EQ(graph.edge_weight, (std::vector<double>{2, 1, 2, 1, 1, 1}));
  require_consistent(graph);
  EXPECT_THROW(add_pairs(graph, chain(100)), std::invalid_argument);
}

TEST(BlockGraph, that_is_not_whole_is_refused) {
  const BlockGraph whole = box_of_blocks(3, 2, 1);
  require_consistent(whole);
  require_consistent(BlockGraph{{}, {}, {0}, {}, {}});
  const auto refused = [&](const char *what, auto change) {
    BlockGraph graph = whole;
    change(graph);
    EXPECT_THROW(require_consistent(graph), std::invalid_argument) << what;
  };
  refused("negative weight", [](BlockGraph &g) { g.weight[1] = -1; });
  refused("weight nan", [](BlockGraph &g) { g.weight[1] = std::nan(""); });
  refused("weight inf", [](BlockGraph &g) { g.weight[1] = std::numeric_limits<double>::infinity(); });
  refused("centre nan", [](BlockGraph &g) { g.centre[1].z = std::nan(""); });
  refused("neighbour beyond the end", [](BlockGraph &g) { g.neighbour.back() = 6; });
  refused("neighbour of itself", [](BlockGraph &g) { g.neighbour[0] = 0; });
  refused("one way", [](BlockGraph &g) { g.neighbour[1] = 4; });
  refused("other weight back", [](BlockGraph &g) { g.edge_weight[0] = 2; });
  refused("negative edge", [](BlockGraph &g) { g.edge_weight.assign(g.edge_weight.size(), -1); });
  refused("edges that descend", [](BlockGraph &g) { std::swap(g.neighbour[0], g.neighbour[1]); });
  refused("centres missing", [](BlockGraph &g) { g.centre.pop_back(); });
  refused("edges missing", [](BlockGraph &g) { g.first_edge.back() -= 1; });
}

} // namespace
