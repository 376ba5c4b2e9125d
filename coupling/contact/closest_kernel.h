// Closest points on faces that move or are flat, in SIMD vectors, and the setup of these faces. One source,
// compiled once per instruction set (closest_kernel.inc.h), bitwise the same.
#pragma once

#include <cstddef>
#include <cstdint>

#include "coupling/contact/faces.h"
#include "coupling/contact/surface_point.h"
#include "dem/instruction_set.h"

namespace platen::coupling::kernels {

// find_closest(*face[k], centre[at[k]], ...) for k < count <= SurfacePoints::most, into `points` except for
// the face's number. Bit k of the result is that of find_closest: if 0, point k is undefined. Reads one more
// of `centre`.
using FindClosestPoints = std::uint32_t (*)(const MovingFace *const *face, const Vector3 *centre,
                                            const int *at, std::size_t count, SurfacePoints &points);
std::uint32_t find_closest_points_baseline(const MovingFace *const *, const Vector3 *, const int *,
                                           std::size_t, SurfacePoints &);
std::uint32_t find_closest_points_avx2(const MovingFace *const *, const Vector3 *, const int *, std::size_t,
                                       SurfacePoints &);
std::uint32_t find_closest_points_avx512(const MovingFace *const *, const Vector3 *, const int *, std::size_t,
                                         SurfacePoints &);
inline FindClosestPoints find_closest_points(dem::InstructionSet set) {
  return dem::for_set<FindClosestPoints>(set, find_closest_points_baseline, find_closest_points_avx2,
                                         find_closest_points_avx512);
}

// The same for flat faces, with the present first corner of each.
using FindFlatClosestPoints = std::uint32_t (*)(const FlatFace *const *face, const Vector3 *const *corner,
                                                const Vector3 *centre, const int *at, std::size_t count,
                                                SurfacePoints &points);
std::uint32_t find_flat_closest_points_baseline(const FlatFace *const *, const Vector3 *const *,
                                                const Vector3 *, const int *, std::size_t, SurfacePoints &);
std::uint32_t find_flat_closest_points_avx2(const FlatFace *const *, const Vector3 *const *, const Vector3 *,
                                            const int *, std::size_t, SurfacePoints &);
std::uint32_t find_flat_closest_points_avx512(const FlatFace *const *, const Vector3 *const *,
                                              const Vector3 *, const int *, std::size_t, SurfacePoints &);
inline FindFlatClosestPoints find_flat_closest_points(dem::InstructionSet set) {
  return dem::for_set<FindFlatClosestPoints>(set, find_flat_closest_points_baseline,
                                             find_flat_closest_points_avx2, find_flat_closest_points_avx512);
}

// moving[number[k]] = moving_face() of the corners of these faces (vertices, four of each face), k < count.
using SetFaces = void (*)(const Vector3 *vertex, const int *corners, const int *number, std::size_t count,
                          MovingFace *moving);
void set_faces_baseline(const Vector3 *, const int *, const int *, std::size_t, MovingFace *);
void set_faces_avx2(const Vector3 *, const int *, const int *, std::size_t, MovingFace *);
void set_faces_avx512(const Vector3 *, const int *, const int *, std::size_t, MovingFace *);
inline SetFaces set_faces(dem::InstructionSet set) {
  return dem::for_set<SetFaces>(set, set_faces_baseline, set_faces_avx2, set_faces_avx512);
}

} // namespace platen::coupling::kernels
