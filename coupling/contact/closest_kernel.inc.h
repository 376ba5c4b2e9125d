// Bodies of the closest point kernels; the including file sets PLATEN_LANES, PLATEN_CLOSEST_POINTS,
// PLATEN_FLAT_CLOSEST_POINTS and PLATEN_SET_FACES. Compiled without contraction, as the rest of the layer is.
#include "coupling/contact/closest_kernel.h"
#include "coupling/contact/closest_on_face.h"
#include "coupling/contact/face_of_corners.h"
#include "dem/kernels/lane_mask.inc.h"
#include "dem/kernels/simd.inc.h"

namespace platen::coupling::kernels {
namespace {

using dem::dot;
using dem::Rotation;
using dem::scale;
using dem::Triple;
using dem::kernels::lanes;
using dem::kernels::Simd;

// Columns of eight doubles that begin at one place of each face.
struct Eight {
  Rotation<Simd> first, second;
};
template <class Face>
PLATEN_INLINE Eight eight_at(const Face *const *face, std::size_t place) {
  dem::kernels::LongRow rows[lanes];
  for (int l = 0; l < lanes; ++l)
    rows[l] = dem::kernels::load_long_row(&face[l]->e.x + place);
  return {dem::kernels::first_columns(rows), dem::kernels::second_columns(rows)};
}

// A BilinearMap, in the order of its members; returns its last double and the seven that follow.
template <class Map, class Face>
PLATEN_INLINE Eight read_map(const Face *const *face, Map &m) {
  const Eight a = eight_at(face, 0), b = eight_at(face, 8), c = eight_at(face, 16);
  m.e = {a.first.w, a.first.x, a.first.y};
  m.f = {a.first.z, a.second.w, a.second.x};
  m.t = {a.second.y, a.second.z, b.first.w};
  m.linear = {b.first.x, b.first.y, b.first.z};
  m.free = {b.second.w, b.second.x, b.second.y};
  m.square = b.second.z;
  m.constant = c.first.w;
  return c;
}

PLATEN_INLINE FaceMap<Simd> map_of(const MovingFace *const *face) {
  FaceMap<Simd> m;
  const Eight rest = read_map(face, m);
  m.corner = {rest.first.x, rest.first.y, rest.first.z};
  m.normal = {rest.second.w, rest.second.x, rest.second.y};
  m.single_closest = rest.second.z;
  return m;
}

PLATEN_INLINE FlatMap<Simd> map_of(const FlatFace *const *face) {
  static_assert(sizeof(FlatFace) == 24 * sizeof(double));
  FlatMap<Simd> m;
  const Eight rest = read_map(face, m);
  m.normal = {rest.first.x, rest.first.y, rest.first.z};
  m.flat = rest.second.w;
  return m;
}

// Indices of the lanes of a SIMD vector from `first` on; the last one is repeated where there are fewer.
struct Lanes {
  std::size_t of[lanes];

  PLATEN_INLINE Lanes(std::size_t first, std::size_t count) {
    for (std::size_t l = 0; l < lanes; ++l)
      of[l] = first + l < count ? first + l : count - 1;
  }
  template <class T>
  PLATEN_INLINE void pick(const T *from, T *to) const {
    for (int l = 0; l < lanes; ++l)
      to[l] = from[of[l]];
  }
};

PLATEN_INLINE void write(double *to, const Simd &a) {
  __builtin_memcpy(to, &a.v, sizeof a.v);
}
template <class Columns>
PLATEN_INLINE void write(Columns &to, std::size_t first, const Triple<Simd> &a) {
  write(&to[0][first], a.x), write(&to[1][first], a.y), write(&to[2][first], a.z);
}

// bilinear_weights() (closest_point.h).
PLATEN_INLINE void write_weights(SurfacePoints &to, std::size_t first, const Simd &u, const Simd &v) {
  const Simd one = Simd(1.0), w[3] = {(one - u) * (one - v), u * (one - v), u * v};
  write(&to.u[first], u), write(&to.v[first], v);
  for (int corner = 0; corner < 3; ++corner)
    write(&to.weights[corner][first], w[corner]);
  write(&to.weights[3][first], one - ((w[0] + w[1]) + w[2]));
}

// Sets a point from its closest point as a surface search does.
PLATEN_INLINE void write_point(SurfacePoints &to, std::size_t first, const ClosestOnFace<Simd> &closest,
                               const Triple<Simd> &centre) {
  write_weights(to, first, closest.u, closest.v);
  write(to.arm, first, scale(Simd(-1.0), closest.out)), write(to.place, first, centre - closest.out);
  write(to.normal, first, closest.normal);
  write(to.along_u, first, closest.along_u), write(to.along_v, first, closest.along_v);
  write(&to.distance[first], dot(closest.out, closest.normal));
  write(&to.distance_squared[first], dot(closest.out, closest.out));
}
PLATEN_INLINE void write_point(SurfacePoints &to, std::size_t first, const ClosestOnFlat<Simd> &closest,
                               const Triple<Simd> &normal, const Triple<Simd> &centre) {
  const Triple<Simd> arm = scale(Simd(-closest.distance), normal);
  write_weights(to, first, closest.u, closest.v);
  write(to.arm, first, arm), write(to.normal, first, normal), write(to.place, first, centre + arm);
  const Triple<Simd> none = dem::no_vector<Simd>();
  write(to.along_u, first, none), write(to.along_v, first, none);
  write(&to.distance[first], closest.distance);
  write(&to.distance_squared[first], closest.distance * closest.distance);
}

// Four adjacent members of eight faces.
PLATEN_INLINE void scatter(const Rotation<Simd> &four, std::size_t place, int count,
                           MovingFace *const *face) {
  dem::kernels::Row rows[lanes];
  dem::kernels::to_rows(four, rows);
  for (int l = 0; l < count; ++l)
    dem::kernels::store_row(&face[l]->e.x + place, rows[l]);
}
PLATEN_INLINE void scatter(const FaceOfCorners<Simd> &f, int count, MovingFace *const *face) {
  static_assert(sizeof(MovingFace) == 40 * sizeof(double));
  scatter({f.e.x, f.e.y, f.e.z, f.f.x}, 0, count, face);
  scatter({f.f.y, f.f.z, f.t.x, f.t.y}, 4, count, face);
  scatter({f.t.z, f.linear.x, f.linear.y, f.linear.z}, 8, count, face);
  scatter({f.free.x, f.free.y, f.free.z, f.square}, 12, count, face);
  scatter({f.constant, f.corner.x, f.corner.y, f.corner.z}, 16, count, face);
  scatter({f.normal.x, f.normal.y, f.normal.z, f.single_closest}, 20, count, face);
  scatter({f.along.x, f.along.y, f.along.z, f.across.x}, 24, count, face);
  scatter({f.across.y, f.across.z, f.middle.x, f.middle.y}, 28, count, face);
  scatter({f.middle.z, f.half.x, f.half.y, f.half.z}, 32, count, face);
}

} // namespace

std::uint32_t PLATEN_FLAT_CLOSEST_POINTS(const FlatFace *const *face, const Vector3 *const *corner,
                                         const Vector3 *centre, const int *at, std::size_t count,
                                         SurfacePoints &points) {
  std::uint32_t found = 0;
  for (std::size_t first = 0; first < count; first += lanes) {
    const Lanes in(first, count);
    const FlatFace *faces[lanes];
    int rows[lanes];
    dem::kernels::Row corners[lanes];
    in.pick(face, faces), in.pick(at, rows);
    for (int l = 0; l < lanes; ++l)
      corners[l] = dem::kernels::load_vector(corner[in.of[l]]);
    const Triple<Simd> centres = dem::kernels::gather(centre, rows);
    const Triple<Simd> from = centres - dem::kernels::to_vectors(corners);
    const FlatMap<Simd> map = map_of(faces);
    ClosestOnFlat<Simd> closest;
    const auto inside = search_flat_closest<dem::kernels::OfLanes>(map, from, closest);
    write_point(points, first, closest, map.normal, centres);
    found |= static_cast<std::uint32_t>(dem::kernels::bits_of(inside)) << first;
  }
  return found;
}

std::uint32_t PLATEN_CLOSEST_POINTS(const MovingFace *const *face, const Vector3 *centre, const int *at,
                                    std::size_t count, SurfacePoints &points) {
  std::uint32_t found = 0;
  for (std::size_t first = 0; first < count; first += lanes) {
    const Lanes in(first, count);
    const MovingFace *faces[lanes];
    int rows[lanes];
    in.pick(face, faces), in.pick(at, rows);
    ClosestOnFace<Simd> closest;
    const Triple<Simd> centres = dem::kernels::gather(centre, rows);
    const auto inside = search_closest<dem::kernels::OfLanes>(map_of(faces), centres, closest);
    const unsigned bits = dem::kernels::bits_of(inside);
    if (bits == 0) continue;
    write_point(points, first, closest, centres);
    found |= static_cast<std::uint32_t>(bits) << first;
  }
  return found;
}

void PLATEN_SET_FACES(const Vector3 *vertex, const int *corners, const int *number, std::size_t count,
                      MovingFace *moving) {
  for (std::size_t first = 0; first < count; first += lanes) {
    const Lanes in(first, count);
    int faces[lanes];
    in.pick(number, faces);
    Triple<Simd> q[4];
    for (int corner = 0; corner < 4; ++corner) {
      dem::kernels::Row rows[lanes];
      for (int l = 0; l < lanes; ++l)
        rows[l] = dem::kernels::load_vector(vertex + corners[4 * faces[l] + corner]);
      q[corner] = dem::kernels::to_vectors(rows);
    }
    FaceOfCorners<Simd> face;
    const unsigned valid = dem::kernels::bits_of(set_face<dem::kernels::OfLanes>(q, face));
    MovingFace *to[lanes];
    for (int l = 0; l < lanes; ++l)
      to[l] = moving + faces[l];
    const int many = static_cast<int>(count - first < lanes ? count - first : lanes);
    scatter(face, many, to);
    for (int l = 0; l < many; ++l) {
      if (valid >> l & 1u) continue;
      const int *c = corners + 4 * faces[l];
      *to[l] = moving_face({vertex[c[0]], vertex[c[1]], vertex[c[2]], vertex[c[3]]});
    }
  }
}

} // namespace platen::coupling::kernels
