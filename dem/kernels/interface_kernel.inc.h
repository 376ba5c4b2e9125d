// Body of the interface kernel; the including file sets PLATEN_LANES and PLATEN_KERNELS.
#include "base/pi.h"
#include "dem/kernels/block_rows.inc.h"
#include "dem/kernels/interface_kernel.h"
#include "dem/kernels/pack.inc.h"

namespace platen::dem::kernels {
namespace {

// A pack of interfaces: of the columns, or of copies that fill it up at the end of a block.
struct Rows {
  const int *first, *second;
  const double *rest_length, *lever, *normal_stiffness, *bond_radius;
  double *plastic, *tension_damage, *shear_damage, *dissipated;
  Vector3 *shear, *slider;
  const double *strength_factor; // only with factors
};

Rows rows_at(const InterfaceColumns &c, std::size_t k) {
  const BondColumns &b = c.bonds;
  return {b.first + k,
          b.second + k,
          b.rest_length + k,
          b.lever + k,
          b.normal_stiffness + k,
          b.bond_radius + k,
          c.plastic + k,
          c.tension_damage + k,
          c.shear_damage + k,
          c.dissipated + k,
          c.shear + k,
          c.slider + k,
          b.strength_factor == nullptr ? nullptr : b.strength_factor + k};
}

// The last interfaces of a block, the very last repeated where they do not fill a pack.
struct Filled {
  int first[lanes], second[lanes];
  double rest_length[lanes], lever[lanes], normal_stiffness[lanes], bond_radius[lanes];
  double plastic[lanes], tension_damage[lanes], shear_damage[lanes], dissipated[lanes];
  double strength_factor[lanes];
  Vector3 shear[lanes + 1], slider[lanes + 1];

  Filled(const InterfaceColumns &c, std::size_t from, std::size_t to) {
    for (std::size_t l = 0; l < lanes; ++l) {
      const Rows r = rows_at(c, from + l < to ? from + l : to - 1);
      first[l] = *r.first, second[l] = *r.second;
      rest_length[l] = *r.rest_length, lever[l] = *r.lever;
      normal_stiffness[l] = *r.normal_stiffness, bond_radius[l] = *r.bond_radius;
      plastic[l] = *r.plastic, dissipated[l] = *r.dissipated;
      tension_damage[l] = *r.tension_damage, shear_damage[l] = *r.shear_damage;
      shear[l] = *r.shear, slider[l] = *r.slider;
      strength_factor[l] = r.strength_factor == nullptr ? 1.0 : *r.strength_factor;
    }
  }
  Rows rows() {
    return {first,          second,       rest_length, lever, normal_stiffness, bond_radius,    plastic,
            tension_damage, shear_damage, dissipated,  shear, slider,           strength_factor};
  }
  void give_back(const InterfaceColumns &c, std::size_t from, std::size_t to) const {
    for (std::size_t l = 0; from + l < to; ++l) {
      const Rows r = rows_at(c, from + l);
      *r.plastic = plastic[l], *r.dissipated = dissipated[l];
      *r.tension_damage = tension_damage[l], *r.shear_damage = shear_damage[l];
      *r.shear = shear[l], *r.slider = slider[l];
    }
  }
};

inline void store(double *to, const Pack &a) {
  for (int l = 0; l < lanes; ++l)
    to[l] = a.v[l];
}

// What the pair has done since its last state, at the velocities of the drift that led here.
template <bool rotation>
PLATEN_INLINE InterfaceMotion<Pack> motion_of(const BondColumns &c, const Rows &r, const Ends &ends,
                                              const Pack &lever, double dt) {
  InterfaceMotion<Pack> m;
  m.distance = distances(ends);
  Triple<Pack> v = gather_difference(c.velocity, r.second, r.first);
  m.travelled = scale(Pack(dt), v);
  m.spun = Pack(0.0);
  if constexpr (rotation) {
    const Triple<Pack> wi = gather(c.angular_velocity, r.first), wj = gather(c.angular_velocity, r.second);
    // Of the second's point, -(1 - a) d from its centre, against the first's, a d from its own.
    v = v + cross(m.distance, scale(lever, wi) + scale(Pack(1.0 - lever), wj));
    const Pack length = root(dot(m.distance, m.distance));
    m.spun = (0.5 * dt) * dot(wi + wj, m.distance) / length;
  }
  m.moved = scale(Pack(dt), v);
  return m;
}

template <bool rotation, bool factors>
PLATEN_INLINE Pack add_pack(const InterfaceColumns &c, const ElastoDamagePlastic &law, const Rows &r,
                            const Ends &ends, double dt) {
  const Pack radius = load(r.bond_radius);
  InterfaceGeometry<Pack> g{load(r.rest_length), load(r.lever), load(r.normal_stiffness),
                            Pack(pi * radius * radius)};
  if constexpr (factors) g.strength_factor = load(r.strength_factor);
  InterfaceState<Pack> s{load(r.plastic), load(r.tension_damage), load(r.shear_damage),
                         load(r.shear),   load(r.slider),         load(r.dissipated)};
  const InterfaceMotion<Pack> m = motion_of<rotation>(c.bonds, r, ends, g.lever, dt);
  const InterfaceResponse<Pack> response = law(s, g, m);
  store(r.plastic, s.plastic);
  store(r.tension_damage, s.tension_damage);
  store(r.shear_damage, s.shear_damage);
  store(r.dissipated, s.dissipated);
  store(r.shear, s.shear);
  store(r.slider, s.slider);
  // Only what is across the distance has a moment: d x F = d x F_s.
  const Triple<Pack> moment = cross(m.distance, response.force);
  scatter<rotation>(ends, response.force, scale(g.lever, moment), scale(Pack(1.0 - g.lever), moment));
  return response.failed_now;
}

template <bool rotation, bool factors>
bool compute_forces(const InterfaceColumns &c, const BlockColumns &block, const ElastoDamagePlastic &law,
                    double dt, std::size_t first, std::size_t last) {
  gather<rotation>(c.bonds, block);
  Pack failed(0.0);
  std::size_t k = first;
  for (; k + lanes <= last; k += lanes)
    failed =
        larger(failed, add_pack<rotation, factors>(c, law, rows_at(c, k), ends_of(c.bonds, block, k), dt));
  if (k < last) {
    Filled filled(c, k, last);
    failed = larger(failed, add_pack<rotation, factors>(c, law, filled.rows(),
                                                        tail_ends<rotation>(c.bonds, block, k, last), dt));
    filled.give_back(c, k, last);
  }
  scatter<rotation, false>(block);
  bool any = false;
  for (int l = 0; l < lanes; ++l)
    any |= failed.v[l] > 0.0;
  return any;
}

template <bool rotation>
bool compute_with(const InterfaceColumns &c, const BlockColumns &block, const ElastoDamagePlastic &law,
                  double dt, std::size_t first, std::size_t last) {
  return c.bonds.strength_factor != nullptr ? compute_forces<rotation, true>(c, block, law, dt, first, last)
                                            : compute_forces<rotation, false>(c, block, law, dt, first, last);
}

bool compute_forces_of(const InterfaceColumns &c, const BlockColumns &block, const ElastoDamagePlastic &law,
                       double dt, std::size_t first, std::size_t last) {
  return c.bonds.orientation != nullptr ? compute_with<true>(c, block, law, dt, first, last)
                                        : compute_with<false>(c, block, law, dt, first, last);
}

} // namespace

const InterfaceKernel PLATEN_KERNELS{compute_forces_of};

} // namespace platen::dem::kernels
