// A plate and a rod's worth of tools for the tests of ElasticSolid.
#pragma once

#include <cmath>
#include <vector>

#include "fem/elastic_solid.h"

namespace platen::fem {

constexpr Material steel{7850, 210e9, 0.3};
constexpr Material pad{1200, 50e6, 0.3};

inline Grid plate() {
  return make_grid(BoxPlate{{-0.02, -0.03, 0}, {0.04, 0.03, 0.02}, {3, 3, 2}});
}

// Push, shear and tilt on the low end, uneven in place.
inline std::vector<Vector3> uneven_loads(const ElasticSolid &solid, double size) {
  std::vector<Vector3> loads(solid.surface().vertices.size(), Vector3{});
  for (std::size_t f = 0; f < solid.surface().faces.size(); ++f)
    if (solid.surface().face_tags[f] == low_end_tag)
      for (const int v : solid.surface().faces[f]) {
        const Vector3 &p = solid.surface().vertices[static_cast<std::size_t>(v)];
        loads[static_cast<std::size_t>(v)] = loads[static_cast<std::size_t>(v)] +
                                             size * Vector3{0.2, -0.1 + 3 * p[0], 1 + 10 * p[0] - 20 * p[1]};
      }
  return loads;
}

inline void put(ElasticSolid &solid, const std::vector<Vector3> &loads) {
  solid.clear_loads();
  for (std::size_t v = 0; v < loads.size(); ++v)
    if (norm(loads[v]) > 0) solid.add_surface_force(static_cast<int>(v), loads[v]);
}

inline double total(const EnergyBalance &b) {
  return b.kinetic + b.strain + b.dissipated + b.plastic + b.unbalanced - b.load_work - b.clamp_work;
}

// A deformation without pattern, the same each time.
inline std::vector<Vector3> shaken(const ElasticSolid &solid, double size) {
  std::vector<Vector3> u(solid.model().nodes.size());
  for (std::size_t i = 0; i < u.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      u[i][k] = size * std::sin(12.9898 * static_cast<double>(3 * i + k + 1) * (1 + static_cast<double>(k)));
  return u;
}

} // namespace platen::fem
