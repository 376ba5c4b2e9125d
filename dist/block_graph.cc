#include "dist/block_graph.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include "base/parallel.h"
#include "dem/pair_blocks.h"
#include "dem/particles.h"

namespace platen::dist {
namespace {

using Edges = std::vector<std::map<int, double>>; // for each block: weight by neighbour

Edges edges_of(const BlockGraph &graph) {
  Edges edges(graph.blocks());
  for (std::size_t b = 0; b < graph.blocks(); ++b)
    for (std::size_t e = graph.first_edge[b]; e < graph.first_edge[b + 1]; ++e)
      edges[b][graph.neighbour[e]] = graph.edge_weight[e];
  return edges;
}

void set_edges(BlockGraph &graph, const Edges &edges) {
  graph.first_edge.assign(1, 0);
  graph.neighbour.clear();
  graph.edge_weight.clear();
  for (const auto &of_block : edges) {
    for (const auto &[neighbour, weight] : of_block) {
      graph.neighbour.push_back(neighbour);
      graph.edge_weight.push_back(weight);
    }
    graph.first_edge.push_back(graph.neighbour.size());
  }
}

[[noreturn]] void refuse(std::size_t block, const std::string &what) {
  throw std::invalid_argument("graph of blocks: block " + std::to_string(block) + " " + what);
}

void require_edge(const BlockGraph &graph, std::size_t b, std::size_t e) {
  const int neighbour = graph.neighbour[e];
  const double weight = graph.edge_weight[e];
  if (neighbour < 0 || static_cast<std::size_t>(neighbour) >= graph.blocks() ||
      static_cast<std::size_t>(neighbour) == b)
    refuse(b, "has an edge to block " + std::to_string(neighbour) + " of " + std::to_string(graph.blocks()));
  if (!std::isfinite(weight) || weight < 0) refuse(b, "has an edge of weight " + std::to_string(weight));
  const auto from = graph.neighbour.begin();
  const auto first = from + static_cast<std::ptrdiff_t>(graph.first_edge[neighbour]),
             last = from + static_cast<std::ptrdiff_t>(graph.first_edge[neighbour + 1]);
  const auto back = std::lower_bound(first, last, static_cast<int>(b));
  if (back == last || *back != static_cast<int>(b) || graph.edge_weight[back - from] != weight)
    refuse(b, "has an edge to block " + std::to_string(neighbour) + " that does not come back alike");
}

} // namespace

BlockGraph graph_of(const dem::PairBlocks &bonds, const dem::Particles &particles) {
  BlockGraph graph;
  for (std::size_t first = 0; first < particles.size(); first += block_rows) {
    const std::size_t last = std::min(particles.size(), first + block_rows);
    Vector3 sum;
    for (std::size_t k = first; k < last; ++k)
      sum += particles.reference_position[k];
    const double rows = static_cast<double>(last - first);
    graph.centre.push_back(sum / rows);
    graph.weight.push_back(work_of_a_particle * rows);
  }
  graph.first_edge.assign(graph.blocks() + 1, 0);
  add_pairs(graph, bonds);
  return graph;
}

void add_pairs(BlockGraph &graph, const dem::PairBlocks &pairs) {
  if (pairs.blocks() != graph.blocks())
    throw std::invalid_argument("graph of " + std::to_string(graph.blocks()) + " blocks: pairs of " +
                                std::to_string(pairs.blocks()) + " blocks");
  Edges edges = edges_of(graph);
  for (std::size_t b = 0; b < pairs.blocks(); ++b) {
    graph.weight[b] += static_cast<double>(pairs.first_pair[b + 1] - pairs.first_pair[b]);
    for (std::size_t g = pairs.first_ghost[b]; g < pairs.first_ghost[b + 1]; ++g) {
      const std::size_t owner = static_cast<std::size_t>(pairs.ghost_particle[g]) / block_rows;
      edges[b][static_cast<int>(owner)] += 1;
      edges[owner][static_cast<int>(b)] += 1;
    }
  }
  set_edges(graph, edges);
}

void require_consistent(const BlockGraph &graph) {
  const std::size_t blocks = graph.blocks();
  if (graph.centre.size() != blocks || graph.first_edge.size() != blocks + 1 ||
      graph.edge_weight.size() != graph.neighbour.size() || graph.first_edge.front() != 0 ||
      graph.first_edge.back() != graph.neighbour.size() ||
      !std::is_sorted(graph.first_edge.begin(), graph.first_edge.end()))
    throw std::invalid_argument("graph of blocks: columns of unlike lengths");
  for (std::size_t b = 0; b < blocks; ++b) {
    const Vector3 &c = graph.centre[b];
    if (!std::isfinite(graph.weight[b]) || graph.weight[b] < 0)
      refuse(b, "has weight " + std::to_string(graph.weight[b]));
    if (!std::isfinite(c.x + c.y + c.z)) refuse(b, "has a centre that is not finite");
    for (std::size_t e = graph.first_edge[b]; e < graph.first_edge[b + 1]; ++e) {
      if (e > graph.first_edge[b] && graph.neighbour[e] <= graph.neighbour[e - 1])
        refuse(b, "has edges that do not ascend");
      require_edge(graph, b, e);
    }
  }
}

} // namespace platen::dist
