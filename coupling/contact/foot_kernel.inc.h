// Bodies of the foot kernels; the including file sets PLATEN_LANES, PLATEN_FEET and PLATEN_FLAT_FEET.
// Compiled without contraction, as the rest of the layer is.
#include "coupling/contact/foot_kernel.h"
#include "coupling/contact/foot_of_face.h"
#include "dem/kernels/lane_mask.inc.h"
#include "dem/kernels/pack.inc.h"

namespace platen::coupling::kernels {
namespace {

using dem::Rotation;
using dem::Triple;
using dem::kernels::lanes;
using dem::kernels::Pack;

// Columns of the eight doubles that begin at a place of each face.
struct Eight {
  Rotation<Pack> first, second;
};
template <class Face>
PLATEN_INLINE Eight eight_at(const Face *const *face, std::size_t place) {
  dem::kernels::LongRow rows[lanes];
  for (int l = 0; l < lanes; ++l)
    rows[l] = dem::kernels::load_long_row(&face[l]->e.x + place);
  return {dem::kernels::first_columns(rows), dem::kernels::second_columns(rows)};
}

// Of a BilinearMap, in the order of its members; returns its last double and the seven that follow.
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

PLATEN_INLINE FaceMap<Pack> map_of(const MovingFace *const *face) {
  static_assert(sizeof(MovingFace) == 36 * sizeof(double));
  FaceMap<Pack> m;
  const Eight rest = read_map(face, m);
  m.corner = {rest.first.x, rest.first.y, rest.first.z};
  m.normal = {rest.second.w, rest.second.x, rest.second.y};
  for (int l = 0; l < lanes; ++l)
    m.single_foot.v[l] = face[l]->single_foot;
  return m;
}

PLATEN_INLINE FlatMap<Pack> map_of(const FlatFace *const *face) {
  static_assert(sizeof(FlatFace) == 24 * sizeof(double));
  FlatMap<Pack> m;
  const Eight rest = read_map(face, m);
  m.normal = {rest.first.x, rest.first.y, rest.first.z};
  m.flat = rest.second.w;
  return m;
}

PLATEN_INLINE Triple<Pack> gather(const Vector3 *const *from) {
  Triple<Pack> a;
  for (int l = 0; l < lanes; ++l)
    a.x.v[l] = from[l]->x, a.y.v[l] = from[l]->y, a.z.v[l] = from[l]->z;
  return a;
}

// Faces and centres from `first` on, lane by lane; the last once more where there are fewer.
template <class Face>
struct Lanes {
  const Face *face[lanes];
  const Vector3 *centre[lanes];

  PLATEN_INLINE Lanes(const Face *const *faces, const Vector3 *centres, std::size_t first,
                      std::size_t count) {
    for (std::size_t l = 0; l < lanes; ++l) {
      const std::size_t k = first + l < count ? first + l : count - 1;
      face[l] = faces[k], centre[l] = centres + k;
    }
  }
};

} // namespace

void PLATEN_FLAT_FEET(const FlatFace *const *face, const Vector3 *centre, std::size_t count, FlatFoot *foot,
                      bool *found) {
  for (std::size_t first = 0; first < count; first += lanes) {
    const Lanes<FlatFace> at(face, centre, first, count);
    FootOnFlat<Pack> feet;
    const auto inside = search_flat_foot<dem::kernels::OfLanes>(map_of(at.face), gather(at.centre), feet);
    const unsigned bits = dem::kernels::bits_of(inside);
    for (std::size_t l = 0; l < lanes && first + l < count; ++l) {
      found[first + l] = bits >> l & 1u;
      foot[first + l] = {feet.u.v[l], feet.v.v[l], feet.distance.v[l]};
    }
  }
}

void PLATEN_FEET(const MovingFace *const *face, const Vector3 *centre, std::size_t count, Foot *foot,
                 bool *found) {
  for (std::size_t first = 0; first < count; first += lanes) {
    const std::size_t last = first + lanes < count ? first + lanes : count;
    const Lanes<MovingFace> at(face, centre, first, count);
    FootOnFace<Pack> feet;
    const auto inside = search_foot<dem::kernels::OfLanes>(map_of(at.face), gather(at.centre), feet);
    const unsigned bits = dem::kernels::bits_of(inside);
    if (bits == 0) {
      for (std::size_t k = first; k < last; ++k)
        found[k] = false;
      continue;
    }
    for (std::size_t l = 0; first + l < last; ++l) {
      found[first + l] = bits >> l & 1u;
      Foot &to = foot[first + l];
      const auto vector = [l](const Triple<Pack> &a) { return Vector3{a.x.v[l], a.y.v[l], a.z.v[l]}; };
      to.u = feet.u.v[l], to.v = feet.v.v[l];
      to.out = vector(feet.out), to.along_u = vector(feet.along_u), to.along_v = vector(feet.along_v);
      to.normal = vector(feet.normal);
    }
  }
}

} // namespace platen::coupling::kernels
