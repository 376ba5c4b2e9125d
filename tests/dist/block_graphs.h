// Graphs of blocks with cuts that are known.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "dist/block_graph.h"

namespace platen::dist {

inline BlockGraph graph_from(const std::vector<Vector3> &centres,
                             const std::vector<std::map<int, double>> &edges) {
  BlockGraph graph;
  graph.centre = centres;
  graph.weight.assign(centres.size(), 1);
  graph.first_edge.assign(1, 0);
  for (const auto &of_block : edges) {
    for (const auto &[neighbour, weight] : of_block) {
      graph.neighbour.push_back(neighbour);
      graph.edge_weight.push_back(weight);
    }
    graph.first_edge.push_back(graph.neighbour.size());
  }
  return graph;
}

// A box of equal blocks, x first; neighbours share a face of `ghosts`.
inline BlockGraph box_of_blocks(int nx, int ny, int nz, double ghosts = 1) {
  std::vector<Vector3> centres;
  std::vector<std::map<int, double>> edges(static_cast<std::size_t>(nx * ny * nz));
  const auto number = [&](int x, int y, int z) { return x + nx * (y + ny * z); };
  const auto join = [&](int a, int b) {
    edges[a][b] = ghosts;
    edges[b][a] = ghosts;
  };
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) {
        centres.push_back({x + .5, y + .5, z + .5});
        if (x > 0) join(number(x - 1, y, z), number(x, y, z));
        if (y > 0) join(number(x, y - 1, z), number(x, y, z));
        if (z > 0) join(number(x, y, z - 1), number(x, y, z));
      }
  return graph_from(centres, edges);
}

} // namespace platen::dist
