// Rows of a contact layer in SIMD vectors, where the layer has only linear springs, dashpots and Coulomb's
// friction with two coefficients: no Hertz, glue, seats or friction that weakens. One source, compiled once
// per instruction set (layer_kernel.inc.h), to the bits of ContactLayer::row_force.
#pragma once

#include <cstddef>

#include "coupling/contact/row_load.h"
#include "coupling/contact/surface_search.h"
#include "dem/instruction_set.h"
#include "dem/laws/coulomb_friction.h"

namespace platen::coupling::kernels {

// Columns of the layer's rows and of particles, each with one spare row at the end.
struct LayerColumns {
  const int *particle;
  const double *offset; // m
  double *dashpot;      // N
  // Null without friction.
  Vector3 *normal, *spring; // 1, N
  int *sliding;
  double *slip;                               // m
  double *idle_until;                         // m
  const Vector3 *velocity, *angular_velocity; // the last is null without rotation
  const double *radius, *mass;
};

// Columns of a fem::SurfaceMesh.
struct LayerSurface {
  const Vector3 *velocity; // m/s, of each vertex
  const int *corner;       // vertices, four of each face
  bool only_shifted;
  const double *compliance; // m/N, a fem::FaceCompliance of each face; null: the mesh is rigid
};

struct LayerStep {
  double dt = 0;               // s
  double stiffness = 0;        // N/m, of the whole contact
  double damping = 0;          // fraction of critical
  double tangential_ratio = 0; // k_t / k_n
  dem::CoulombFriction::Parameters friction;
  double travelled = 0; // m, as in idle_until
};

// From the first of the computed rows on.
struct LayerResults {
  RowLoad *load;
  RowTorque *torque;
  RowWork *work;
  RowContact *contact;
};

// Computes row[0 ... count), ascending, count <= SurfacePoints::most, with the points closest to them.
using ComputeRows = void (*)(const LayerColumns &, const LayerSurface &, const LayerStep &,
                             const SurfacePoints &points, const std::size_t *row, std::size_t count,
                             const LayerResults &results);
void compute_rows_baseline(const LayerColumns &, const LayerSurface &, const LayerStep &,
                           const SurfacePoints &, const std::size_t *, std::size_t, const LayerResults &);
void compute_rows_avx2(const LayerColumns &, const LayerSurface &, const LayerStep &, const SurfacePoints &,
                       const std::size_t *, std::size_t, const LayerResults &);
void compute_rows_avx512(const LayerColumns &, const LayerSurface &, const LayerStep &, const SurfacePoints &,
                         const std::size_t *, std::size_t, const LayerResults &);
inline ComputeRows compute_rows(dem::InstructionSet set) {
  return dem::for_set<ComputeRows>(set, compute_rows_baseline, compute_rows_avx2, compute_rows_avx512);
}

} // namespace platen::coupling::kernels
