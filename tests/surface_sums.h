// Sums over a surface that tests compare with closed forms.
#pragma once

#include <cstddef>

#include "fem/surface.h"

namespace platen::fem {

// Sum of all area vectors (m^2): zero for a closed surface.
inline Vector3 total_area_vector(const SurfaceMesh &surface) {
  Vector3 sum{};
  for (std::size_t f = 0; f < surface.faces.size(); ++f)
    sum = sum + face_area_vector(surface, f);
  return sum;
}

// Volume inside a closed surface (m^3), by the divergence theorem; exact for flat faces.
inline double enclosed_volume(const SurfaceMesh &surface) {
  if (surface.vertices.empty()) return 0;
  const Vector3 origin = surface.vertices[0]; // any point does; a near one loses fewer digits
  double sum = 0;
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    Vector3 middle{};
    for (const int v : surface.faces[f])
      middle = middle + 0.25 * (surface.vertices[static_cast<std::size_t>(v)] - origin);
    sum += dot(middle, face_area_vector(surface, f)) / 3.0;
  }
  return sum;
}

// W, sum of load . vertex velocity: what the particles do to the body.
inline double load_power(const LoadedSurface &body) {
  double sum = 0;
  for (const int v : body.loaded_vertices())
    sum += dot(body.contact_load(v), body.surface().velocities[static_cast<std::size_t>(v)]);
  return sum;
}

} // namespace platen::fem
