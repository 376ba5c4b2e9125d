#include "dist/partition.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "block_graphs.h"
#include "dist/zoltan_cut.h"
#include "on_ranks.h"

using namespace platen;
using namespace platen::dist;

namespace {

using Method = PartitionMethod;

const auto ranks = platen::dist::testing::number_of_ranks;

Partition cut(const BlockGraph &graph, std::vector<Method> methods = {Method::graph, Method::bisection}) {
  PartitionLimits limits;
  limits.methods = std::move(methods);
  return partition(graph, MPI_COMM_WORLD, limits);
}

std::vector<double> work_of_ranks(const Partition &p, const BlockGraph &graph) {
  std::vector<double> work(static_cast<std::size_t>(ranks()));
  for (std::size_t b = 0; b < graph.blocks(); ++b)
    work[p.rank[b]] += graph.weight[b];
  return work;
}

// Every rank's own vector against that of rank 0.
bool alike_on_all_ranks(const std::vector<int> &mine) {
  std::vector<int> first = mine;
  unsigned long size = first.size();
  MPI_Bcast(&size, 1, MPI_UNSIGNED_LONG, 0, MPI_COMM_WORLD);
  first.resize(size);
  MPI_Bcast(first.data(), static_cast<int>(size), MPI_INT, 0, MPI_COMM_WORLD);
  int same = first == mine;
  MPI_Allreduce(MPI_IN_PLACE, &same, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  return same != 0;
}

void expect_sound(const Partition &p, const BlockGraph &graph) {
  ASSERT_EQ(p.rank.size(), graph.blocks());
  EXPECT_EQ(p.useful_ranks, std::min(ranks(), static_cast<int>(graph.blocks())));
  const std::set<int> used(p.rank.begin(), p.rank.end());
  EXPECT_EQ(static_cast<int>(used.size()), p.useful_ranks);
  EXPECT_EQ(*used.begin(), 0);
  EXPECT_EQ(*used.rbegin(), p.useful_ranks - 1);
  EXPECT_EQ(p.rank[0], 0) << "ranks are numbered by their first block";
  EXPECT_TRUE(alike_on_all_ranks(p.rank));
}

TEST(Partition, of_a_bar_cuts_it_once_between_two_ranks) {
  for (const auto &methods : std::vector<std::vector<Method>>{
           {Method::graph}, {Method::bisection}, {}, {Method::graph, Method::bisection}}) {
    const BlockGraph bar = box_of_blocks(60, 1, 1, 50);
    const Partition p = cut(bar, methods);
    expect_sound(p, bar);
    EXPECT_EQ(p.cut_edges, static_cast<std::size_t>(ranks() - 1)) << describe(p);
    EXPECT_DOUBLE_EQ(p.cut_weight, 50. * (ranks() - 1));
    EXPECT_EQ(p.edges, 59u);
    if (60 % ranks() == 0) {
      EXPECT_DOUBLE_EQ(p.imbalance, 1) << describe(p);
    }
  }
}

TEST(Partition, of_a_cube_is_balanced_and_cut_no_worse_than_into_slabs) {
  const BlockGraph cube = box_of_blocks(4, 4, 4, 30);
  const Partition p = cut(cube);
  expect_sound(p, cube);
  const std::vector<double> work = work_of_ranks(p, cube);
  EXPECT_DOUBLE_EQ(*std::max_element(work.begin(), work.end()), p.imbalance * 64 / ranks());
  if (64 % ranks() == 0) {
    EXPECT_LE(p.imbalance, 1.1) << describe(p);
  }
  // Faces between two halves; four columns (slabs: 48); eight small cubes (slabs: seven cuts of at least 14).
  const std::map<int, std::size_t> known = {{2, 16}, {4, 32}, {8, 48}};
  const auto faces = known.find(ranks());
  if (faces != known.end()) {
    EXPECT_LE(p.cut_edges, faces->second) << describe(p);
  }
}

TEST(Partition, by_each_method_is_the_one_that_is_asked_for) {
  const BlockGraph cube = box_of_blocks(4, 4, 4);
  if (ranks() != 4 && ranks() != 8) GTEST_SKIP() << "consecutive blocks are as good on so few ranks";
  EXPECT_EQ(cut(cube, {}).method, Method::curve);
  EXPECT_EQ(cut(cube, {Method::bisection}).method, Method::bisection);
  EXPECT_EQ(cut(cube, {Method::graph}).method, Method::graph);
}

TEST(Partition, is_the_same_in_every_call) {
  const BlockGraph box = box_of_blocks(7, 6, 5, 12);
  const Partition first = cut(box);
  expect_sound(first, box);
  for (int call = 0; call < 3; ++call) {
    cut(box_of_blocks(3 + call, 4, 4)); // other cuts between
    const Partition again = cut(box);
    EXPECT_EQ(again.rank, first.rank);
    EXPECT_EQ(again.method, first.method);
    EXPECT_EQ(again.cut_weight, first.cut_weight);
  }
}

TEST(Partition, does_not_depend_on_who_asks) {
  const BlockGraph box = box_of_blocks(7, 6, 5, 12);
  EXPECT_EQ(partition(box, ranks()).rank, cut(box).rank);
  // On ranks that do not run, up to more of them than blocks.
  for (const int parts : {5, 16, 64, 210, 211}) {
    const Partition planned = partition(box, parts);
    EXPECT_TRUE(alike_on_all_ranks(planned.rank)) << parts;
    EXPECT_EQ(planned.useful_ranks, std::min(parts, 210));
    EXPECT_EQ(static_cast<int>(std::set<int>(planned.rank.begin(), planned.rank.end()).size()),
              planned.useful_ranks);
  }
  EXPECT_THROW(partition(box, 0), std::invalid_argument);
}

TEST(Partition, shares_the_work_out_not_the_blocks) {
  // The first quarter of a bar is five times the work: cut by numbers, rank 0 of two would have 80 of 96.
  BlockGraph bar = box_of_blocks(64, 1, 1);
  for (int b = 0; b < 16; ++b)
    bar.weight[b] = 5;
  const double total = std::accumulate(bar.weight.begin(), bar.weight.end(), 0.0);
  for (const auto &methods : std::vector<std::vector<Method>>{{Method::graph}, {Method::bisection}, {}}) {
    const Partition p = cut(bar, methods);
    expect_sound(p, bar);
    const std::vector<double> work = work_of_ranks(p, bar);
    // A mean share, and at most a heavy block beyond it.
    EXPECT_LE(*std::max_element(work.begin(), work.end()), total / ranks() + 5) << describe(p);
    EXPECT_DOUBLE_EQ(p.imbalance, *std::max_element(work.begin(), work.end()) * ranks() / total);
  }
}

TEST(Partition, by_the_graph_goes_where_few_ghosts_are) {
  // Two bars side by side, joined by heavy rungs: centres alone would part the bars as soon as cut across
  // them.
  if (ranks() != 2) GTEST_SKIP() << "a cut in two";
  std::vector<Vector3> centres;
  std::vector<std::map<int, double>> edges(48);
  const auto join = [&](int a, int b, double ghosts) {
    edges[a][b] = ghosts;
    edges[b][a] = ghosts;
  };
  // A chain of 48 blocks that jumps to and fro along an axis: what is near is no neighbour.
  for (int b = 0; b < 48; ++b) {
    centres.push_back({static_cast<double>(b * 29 % 48), 0, 0});
    if (b > 0) join(b - 1, b, 40);
  }
  BlockGraph chain = graph_from(centres, edges);
  const Partition by_planes = cut(chain, {Method::bisection}), by_graph = cut(chain, {Method::graph});
  EXPECT_EQ(by_graph.cut_weight, 40) << describe(by_graph);
  EXPECT_EQ(by_planes.method, Method::curve) << "planes cut more: " << describe(by_planes);

  // The same graph with its blocks numbered along the planes: only edges tell the chain.
  std::vector<Vector3> sorted(48);
  std::vector<std::map<int, double>> other(48);
  for (int b = 0; b < 48; ++b) {
    sorted[b * 29 % 48] = centres[b];
    for (const auto &[n, w] : edges[b])
      other[b * 29 % 48][n * 29 % 48] = w;
  }
  chain = graph_from(sorted, other);
  EXPECT_EQ(cut(chain, {}).method, Method::curve);
  EXPECT_GE(cut(chain, {}).cut_edges, 20u);
  const Partition found = cut(chain);
  EXPECT_EQ(found.method, Method::graph) << describe(found);
  EXPECT_LE(found.cut_edges, 4u) << describe(found);
}

TEST(Partition, prefers_balance_up_to_the_limit_and_few_ghosts_below_it) {
  // Block 1 has as much work as the two others, which lie side by side: 0 2 | 1 is even and has 11 ghosts, in
  // order it is 0 1 | 2 with 15 of 20 and one ghost.
  BlockGraph graph = graph_from({{0, 0, 0}, {5, 0, 0}, {.1, 0, 0}}, {{{1, 10}}, {{0, 10}, {2, 1}}, {{1, 1}}});
  graph.weight = {5, 10, 5};
  PartitionLimits limits;
  limits.methods = {Method::bisection};
  const Partition even = partition(graph, 2, limits);
  EXPECT_EQ(even.rank, (std::vector<int>{0, 1, 0})) << describe(even);
  EXPECT_DOUBLE_EQ(even.imbalance, 1);
  EXPECT_DOUBLE_EQ(even.cut_weight, 11);
  EXPECT_EQ(even.method, Method::bisection);
  limits.imbalance = 1.6;
  const Partition few = partition(graph, 2, limits);
  EXPECT_EQ(few.rank, (std::vector<int>{0, 0, 1})) << describe(few);
  EXPECT_DOUBLE_EQ(few.imbalance, 1.5);
  EXPECT_DOUBLE_EQ(few.cut_weight, 1);
  EXPECT_EQ(few.method, Method::curve);
}

// Zoltan alone, for a cut of its own that is worse than another method's is not seen above.
TEST(ZoltanCut, shares_the_work_out) {
  BlockGraph bar = box_of_blocks(64, 1, 1);
  for (std::size_t b = 0; b < 16; ++b)
    bar.weight[b] = 5; // of 128 in all: 64 of them in the first 13 blocks
  for (const Method method : {Method::graph, Method::bisection}) {
    const auto part = cut_by_zoltan(bar, 2, method);
    ASSERT_TRUE(part);
    double work[2] = {};
    for (std::size_t b = 0; b < 64; ++b)
      work[(*part)[b]] += bar.weight[b];
    EXPECT_LE(std::max(work[0], work[1]), 67) << "method " << static_cast<int>(method);
  }
}

TEST(ZoltanCut, goes_by_the_weight_of_edges) {
  // Across a bar all cuts are one edge; a light one is a little off the middle, within 3 % of balance.
  BlockGraph bar = box_of_blocks(101, 1, 1, 100);
  for (const std::size_t b : {std::size_t{48}, std::size_t{49}})
    for (std::size_t e = bar.first_edge[b]; e < bar.first_edge[b + 1]; ++e)
      if (static_cast<std::size_t>(bar.neighbour[e]) + b == 97) bar.edge_weight[e] = 3;
  const auto part = cut_by_zoltan(bar, 2, Method::graph);
  ASSERT_TRUE(part);
  EXPECT_NE((*part)[48], (*part)[49]);
  EXPECT_EQ(std::count(part->begin(), part->end(), (*part)[48]), 49);
}

TEST(Partition, gives_every_rank_a_block_while_there_are_enough) {
  for (int blocks = 1; blocks <= 10; ++blocks) {
    const BlockGraph bar = box_of_blocks(blocks, 1, 1);
    expect_sound(cut(bar), bar);
    BlockGraph heavy = bar; // all the work in one block: the others still go round
    heavy.weight.assign(heavy.weight.size(), 1e-3);
    heavy.weight[0] = 1e6;
    expect_sound(cut(heavy), heavy);
  }
}

TEST(Partition, of_nothing_of_idle_blocks_and_of_blocks_alone) {
  const Partition none = cut(BlockGraph{{}, {}, {0}, {}, {}});
  EXPECT_TRUE(none.rank.empty());
  EXPECT_EQ(none.useful_ranks, 0);

  BlockGraph idle = box_of_blocks(24, 1, 1);
  idle.weight.assign(24, 0);
  const Partition even = cut(idle);
  expect_sound(even, idle);
  for (int r = 0; r < ranks(); ++r)
    EXPECT_LE(std::count(even.rank.begin(), even.rank.end(), r), (24 + ranks() - 1) / ranks() + 1);

  BlockGraph alone = box_of_blocks(5, 5, 1);
  alone.first_edge.assign(26, 0);
  alone.neighbour.clear();
  alone.edge_weight.clear();
  const Partition apart = cut(alone);
  expect_sound(apart, alone);
  EXPECT_EQ(apart.cut_edges, 0u);
  EXPECT_EQ(apart.edges, 0u);

  BlockGraph at_one_place = box_of_blocks(4, 4, 1); // no plane parts these
  at_one_place.centre.assign(16, Vector3{1, 1, 1});
  expect_sound(cut(at_one_place), at_one_place);
}

TEST(Partition, refuses_a_graph_that_is_not_whole_on_every_rank) {
  BlockGraph broken = box_of_blocks(4, 1, 1);
  broken.neighbour[0] = 3;
  EXPECT_THROW(cut(broken), std::invalid_argument);
}

TEST(Partition, tells_what_it_did_in_a_line) {
  if (ranks() != 2) GTEST_SKIP() << "one text is enough";
  EXPECT_EQ(describe(cut(box_of_blocks(10, 1, 1, 7), {})),
            "curve: 10 blocks on 2 ranks, largest work 1.00 of the mean, 1 of 9 neighbours apart, 7 ghosts");
}

TEST(CutInOrder, has_the_smallest_largest_share) {
  // 7 | 2 5 1 | 8; with 7 2 together it is 9.
  EXPECT_EQ(cut_in_order({7, 2, 5, 1, 8}, 3), (std::vector<int>{0, 1, 1, 1, 2}));
  EXPECT_EQ(cut_in_order({1, 1, 1, 9}, 2), (std::vector<int>{0, 0, 0, 1}));
  EXPECT_EQ(cut_in_order({9, 0, 0, 0}, 4), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(cut_in_order({0, 0, 0}, 2).back(), 1);
  EXPECT_EQ(cut_in_order({3}, 1), (std::vector<int>{0}));
  EXPECT_THROW(cut_in_order({1, 1}, 3), std::invalid_argument);
  EXPECT_THROW(cut_in_order({1, 1}, 0), std::invalid_argument);
}

// All cuts of short rows of weights, one by one.
TEST(CutInOrder, is_as_good_as_the_best_of_all_cuts) {
  unsigned state = 7;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> weight(6);
    for (double &w : weight)
      w = static_cast<double>((state = state * 1664525u + 1013904223u) >> 28);
    double best = 1e9;
    for (int i = 1; i < 5; ++i)
      for (int j = i + 1; j < 6; ++j) {
        double sums[3] = {};
        for (int b = 0; b < 6; ++b)
          sums[(b >= i) + (b >= j)] += weight[b];
        best = std::min(best, *std::max_element(sums, sums + 3));
      }
    const std::vector<int> part = cut_in_order(weight, 3);
    double sums[3] = {};
    for (std::size_t b = 0; b < 6; ++b)
      sums[part[b]] += weight[b];
    EXPECT_EQ(*std::max_element(sums, sums + 3), best) << "trial " << trial;
  }
}

} // namespace
