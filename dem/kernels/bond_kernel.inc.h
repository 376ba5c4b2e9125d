// Body of the bond kernel; the including file sets PLATEN_LANES and PLATEN_KERNEL. Everything stays in an
// unnamed namespace of that file, because functions compiled for one instruction set must never be linked
// into another's.
#include "dem/kernels/bond_kernel.h"

namespace platen::dem::kernels {
namespace {

constexpr int lanes = PLATEN_LANES;
typedef double Native __attribute__((vector_size(8 * PLATEN_LANES)));

// A struct of this file, not the bare vector type: what is instantiated on it then belongs to this file
// alone.
struct Pack {
  Native v{};
  Pack() = default;
  Pack(Native a) : v(a) {}
  Pack(double a) : v(a - Native{}) {}
};
inline Pack operator+(const Pack &a, const Pack &b) {
  return a.v + b.v;
}
inline Pack operator-(const Pack &a, const Pack &b) {
  return a.v - b.v;
}
inline Pack operator*(const Pack &a, const Pack &b) {
  return a.v * b.v;
}
inline Pack operator/(const Pack &a, const Pack &b) {
  return a.v / b.v;
}
inline Pack operator-(const Pack &a) {
  return -a.v;
}
inline Pack root(const Pack &a) {
  Pack r;
  for (int l = 0; l < lanes; ++l)
    r.v[l] = __builtin_sqrt(a.v[l]);
  return r;
}
inline Pack magnitude(const Pack &a) {
  return a.v < 0.0 ? -a.v : a.v;
}
inline Pack positive_part(const Pack &a) {
  return a.v > 0.0 ? a.v : a.v * 0.0;
}
inline Pack sign_of(const Pack &a) {
  return a.v < 0.0 ? Pack(-1.0).v : Pack(1.0).v;
}

// Rows that the lanes of one pack read. The tail of a block repeats its last row.
struct Rows {
  std::size_t row[lanes];
};

inline Triple<Pack> gather(const Vector3 *column, const std::size_t *row) {
  Triple<Pack> t;
  for (int l = 0; l < lanes; ++l) {
    t.x.v[l] = column[row[l]].x;
    t.y.v[l] = column[row[l]].y;
    t.z.v[l] = column[row[l]].z;
  }
  return t;
}

inline Rotation<Pack> gather(const Quaternion *column, const std::size_t *row) {
  Rotation<Pack> t;
  for (int l = 0; l < lanes; ++l) {
    t.w.v[l] = column[row[l]].w;
    t.x.v[l] = column[row[l]].x;
    t.y.v[l] = column[row[l]].y;
    t.z.v[l] = column[row[l]].z;
  }
  return t;
}

inline Pack gather(const double *column, const std::size_t *row) {
  Pack t;
  for (int l = 0; l < lanes; ++l)
    t.v[l] = column[row[l]];
  return t;
}

inline void scatter(Vector3 *column, const Rows &r, int count, const Triple<Pack> &t) {
  for (int l = 0; l < count; ++l)
    column[r.row[l]] = {t.x.v[l], t.y.v[l], t.z.v[l]};
}

template <bool turning>
inline ParallelBond::Response<Pack> respond(const BondColumns &c, const ParallelBond &law, const Rows &r) {
  std::size_t i[lanes], j[lanes];
  for (int l = 0; l < lanes; ++l) {
    i[l] = static_cast<std::size_t>(c.first[r.row[l]]);
    j[l] = static_cast<std::size_t>(c.second[r.row[l]]);
  }
  ParallelBond::Geometry<Pack> g;
  g.reference = gather(c.reference, r.row);
  g.rest_length = gather(c.rest_length, r.row);
  g.lever = gather(c.lever, r.row);
  g.normal_stiffness = gather(c.normal_stiffness, r.row);
  g.radius = gather(c.bond_radius, r.row);
  const Triple<Pack> d = gather(c.position, j) - gather(c.position, i);
  if constexpr (turning) {
    const ParallelBond::Motion<Pack> m{d, gather(c.orientation, i), gather(c.orientation, j)};
    return law(g, m);
  } else {
    return law.without_rotation(g, d);
  }
}

template <bool turning>
bool run(const BondColumns &c, const ParallelBond &law, std::size_t first, std::size_t last) {
  int failed = 0;
  for (std::size_t k = first; k < last; k += lanes) {
    const int count = last - k < lanes ? static_cast<int>(last - k) : lanes;
    Rows r;
    for (int l = 0; l < lanes; ++l)
      r.row[l] = l < count ? k + static_cast<std::size_t>(l) : last - 1;
    const ParallelBond::Response<Pack> f = respond<turning>(c, law, r);
    scatter(c.force, r, count, f.force);
    if constexpr (turning) {
      scatter(c.torque_first, r, count, f.torque_i);
      scatter(c.torque_second, r, count, f.torque_j);
    }
    for (int l = 0; l < lanes; ++l)
      failed |= static_cast<int>(f.tension_ratio.v[l] >= 1.0) | static_cast<int>(f.shear_ratio.v[l] >= 1.0);
    if (c.tension_ratio != nullptr)
      for (int l = 0; l < count; ++l) {
        c.tension_ratio[k - first + static_cast<std::size_t>(l)] = f.tension_ratio.v[l];
        c.shear_ratio[k - first + static_cast<std::size_t>(l)] = f.shear_ratio.v[l];
      }
  }
  return failed != 0;
}

} // namespace

bool PLATEN_KERNEL(const BondColumns &c, const ParallelBond &law, std::size_t first, std::size_t last) {
  return c.orientation != nullptr ? run<true>(c, law, first, last) : run<false>(c, law, first, last);
}

} // namespace platen::dem::kernels
