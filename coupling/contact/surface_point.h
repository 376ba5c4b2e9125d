// The closest point of a surface to the centre of a particle.
#pragma once

#include <cstddef>

#include "coupling/contact/closest_point.h"

namespace platen::coupling {

struct SurfacePoint {
  int face = -1;
  ClosestPoint local;  // point relative to the centre; weights of the face's corners
  Vector3 normal;      // unit, out of the body; from the surface to the centre where the centre is outside
  double distance = 0; // m, of the centre; negative inside the body
  // m, derivatives of the point by u and v; zero and unused on a surface that only shifts.
  Vector3 along_u, along_v;
};

// Points of up to `most` centres, one column each, as kernels write and read them in whole SIMD vectors.
struct alignas(64) SurfacePoints {
  static constexpr std::size_t most = 32;
  double arm[3][most]{}, normal[3][most]{};      // m, from the centre; 1
  double along_u[3][most]{}, along_v[3][most]{}; // m
  double place[3][most]{};                       // m, of the point itself
  double u[most]{}, v[most]{}, weights[4][most]{};
  double distance[most]{}, distance_squared[most]{}; // m, m^2
  int face[most]{};

  void set(std::size_t k, const SurfacePoint &point, const Vector3 &centre) {
    for (int c = 0; c < 3; ++c) {
      arm[c][k] = point.local.point[c], normal[c][k] = point.normal[c];
      place[c][k] = centre[c] + point.local.point[c];
      along_u[c][k] = point.along_u[c], along_v[c][k] = point.along_v[c];
    }
    for (std::size_t corner = 0; corner < 4; ++corner)
      weights[corner][k] = point.local.weights[corner];
    u[k] = point.local.u, v[k] = point.local.v;
    distance[k] = point.distance, distance_squared[k] = point.local.distance_squared;
    face[k] = point.face;
  }
  std::array<double, 4> weights_at(std::size_t k) const {
    return {weights[0][k], weights[1][k], weights[2][k], weights[3][k]};
  }
  // Without the feature on which the point lies.
  SurfacePoint at(std::size_t k) const {
    SurfacePoint point;
    for (int c = 0; c < 3; ++c) {
      point.local.point[c] = arm[c][k], point.normal[c] = normal[c][k];
      point.along_u[c] = along_u[c][k], point.along_v[c] = along_v[c][k];
    }
    point.local.weights = weights_at(k);
    point.local.u = u[k], point.local.v = v[k];
    point.distance = distance[k], point.local.distance_squared = distance_squared[k];
    point.face = face[k];
    return point;
  }
};

} // namespace platen::coupling
