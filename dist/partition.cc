#include "dist/partition.h"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "dist/zoltan_cut.h"

namespace platen::dist {
namespace {

constexpr int halvings = 60; // of an interval of weights: down to its last bit

// Fills ranks in order up to `bound`, the last ones with at least a block each; returns the largest weight.
double fill_in_order(const std::vector<double> &weight, int parts, double bound, std::vector<int> &part) {
  double sum = 0, largest = 0;
  int now = 0;
  for (std::size_t b = 0; b < weight.size(); ++b) {
    const bool needed = weight.size() - b == static_cast<std::size_t>(parts - 1 - now);
    if (b > 0 && now + 1 < parts && (needed || sum + weight[b] > bound)) ++now, sum = 0;
    part[b] = now;
    sum += weight[b];
    largest = std::max(largest, sum);
  }
  return largest;
}

// Numbers ranks by their first block. Returns false where a rank has no block.
bool number_by_first_block(std::vector<int> &rank, int parts) {
  std::vector<int> number(static_cast<std::size_t>(parts), -1);
  int next = 0;
  for (int &r : rank) {
    int &n = number[static_cast<std::size_t>(r)];
    if (n < 0) n = next++;
    r = n;
  }
  return next == parts;
}

// Equal weights where no block has work.
std::vector<double> usable_weights(const std::vector<double> &weight) {
  const bool none = std::all_of(weight.begin(), weight.end(), [](double w) { return w == 0; });
  return none ? std::vector<double>(weight.size(), 1) : weight;
}

// Computes the cost of a cut.
void measure(Partition &cut, const BlockGraph &graph) {
  const std::vector<double> weight = usable_weights(graph.weight);
  std::vector<double> sums(static_cast<std::size_t>(cut.useful_ranks));
  for (std::size_t b = 0; b < graph.blocks(); ++b)
    sums[static_cast<std::size_t>(cut.rank[b])] += weight[b];
  const double mean = std::accumulate(sums.begin(), sums.end(), 0.0) / cut.useful_ranks;
  cut.imbalance = *std::max_element(sums.begin(), sums.end()) / mean;
  cut.edges = graph.neighbour.size() / 2;
  cut.cut_edges = 0;
  cut.cut_weight = 0;
  for (std::size_t b = 0; b < graph.blocks(); ++b)
    for (std::size_t e = graph.first_edge[b]; e < graph.first_edge[b + 1]; ++e) {
      const std::size_t other = static_cast<std::size_t>(graph.neighbour[e]);
      if (other < b || cut.rank[b] == cut.rank[other]) continue;
      ++cut.cut_edges;
      cut.cut_weight += graph.edge_weight[e];
    }
}

std::optional<Partition> try_method(const BlockGraph &graph, int parts, PartitionMethod method) {
  Partition cut;
  cut.method = method;
  cut.useful_ranks = parts;
  if (method == PartitionMethod::curve) {
    cut.rank = cut_in_order(usable_weights(graph.weight), parts);
  } else {
    const auto by_zoltan = cut_by_zoltan(graph, parts, method);
    if (!by_zoltan) return std::nullopt;
    cut.rank = *by_zoltan;
  }
  if (!number_by_first_block(cut.rank, parts)) return std::nullopt;
  measure(cut, graph);
  return cut;
}

// Balance above the limit comes first, then few ghosts.
bool is_better(const Partition &a, const Partition &b, const PartitionLimits &limits) {
  const double unlike_a = std::max(a.imbalance, limits.imbalance),
               unlike_b = std::max(b.imbalance, limits.imbalance);
  return unlike_a != unlike_b ? unlike_a < unlike_b : a.cut_weight < b.cut_weight;
}

} // namespace

std::vector<int> cut_in_order(const std::vector<double> &weight, int parts) {
  if (parts < 1 || static_cast<std::size_t>(parts) > weight.size())
    throw std::invalid_argument("cut of " + std::to_string(weight.size()) + " blocks into " +
                                std::to_string(parts) + " parts");
  std::vector<int> part(weight.size());
  double high = std::accumulate(weight.begin(), weight.end(), 0.0), low = 0;
  for (int k = 0; k < halvings; ++k) {
    const double middle = low + (high - low) / 2;
    (fill_in_order(weight, parts, middle, part) <= middle ? high : low) = middle;
  }
  fill_in_order(weight, parts, high, part);
  return part;
}

Partition partition(const BlockGraph &graph, int ranks, const PartitionLimits &limits) {
  require_consistent(graph);
  if (ranks < 1) throw std::invalid_argument("a cut of blocks over " + std::to_string(ranks) + " ranks");
  if (graph.blocks() == 0) return {};
  const int parts = static_cast<int>(std::min(static_cast<std::size_t>(ranks), graph.blocks()));
  Partition best = *try_method(graph, parts, PartitionMethod::curve);
  if (parts == 1) return best;
  for (const PartitionMethod method : limits.methods)
    if (const auto cut = try_method(graph, parts, method))
      if (is_better(*cut, best, limits)) best = *cut;
  return best;
}

Partition partition(const BlockGraph &graph, MPI_Comm ranks, const PartitionLimits &limits) {
  require_consistent(graph);
  int rank = 0, size = 1;
  MPI_Comm_rank(ranks, &rank);
  MPI_Comm_size(ranks, &size);
  Partition cut;
  if (rank == 0) cut = partition(graph, size, limits);
  cut.rank.resize(graph.blocks());
  int numbers[2] = {cut.useful_ranks, static_cast<int>(cut.method)};
  MPI_Bcast(numbers, 2, MPI_INT, 0, ranks);
  MPI_Bcast(cut.rank.data(), static_cast<int>(cut.rank.size()), MPI_INT, 0, ranks);
  cut.useful_ranks = numbers[0];
  cut.method = static_cast<PartitionMethod>(numbers[1]);
  if (rank != 0 && graph.blocks() > 0) measure(cut, graph);
  return cut;
}

std::string describe(const Partition &cut) {
  const char *name = cut.method == PartitionMethod::graph       ? "graph"
                     : cut.method == PartitionMethod::bisection ? "bisection"
                                                                : "curve";
  char text[200];
  std::snprintf(
      text, sizeof text,
      "%s: %zu blocks on %d ranks, largest work %.2f of the mean, %zu of %zu neighbours apart, %.0f ghosts",
      name, cut.rank.size(), cut.useful_ranks, cut.imbalance, cut.cut_edges, cut.edges, cut.cut_weight);
  return text;
}

} // namespace platen::dist
