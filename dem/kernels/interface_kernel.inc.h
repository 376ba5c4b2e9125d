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
  const double *strength_factor; // only with factors
  MemoryColumns memory;
};

Rows rows_at(const InterfaceColumns &c, std::size_t k) {
  const BondColumns &b = c.bonds;
  Rows r{b.first + k,
         b.second + k,
         b.rest_length + k,
         b.lever + k,
         b.normal_stiffness + k,
         b.bond_radius + k,
         b.strength_factor == nullptr ? nullptr : b.strength_factor + k,
         c.memory};
  for (double *&column : r.memory.scalar)
    column += column == nullptr ? 0 : k;
  for (Vector3 *&column : r.memory.vector)
    column += column == nullptr ? 0 : k;
  return r;
}

// The last interfaces of a block, the very last repeated where they do not fill a pack.
struct Filled {
  int first[lanes], second[lanes];
  double rest_length[lanes], lever[lanes], normal_stiffness[lanes], bond_radius[lanes];
  double strength_factor[lanes];
  double scalar[most_scalars][lanes];
  Vector3 vector[most_vectors][lanes + 1];

  Filled(const InterfaceColumns &c, std::size_t from, std::size_t to) {
    for (std::size_t l = 0; l < lanes; ++l) {
      const Rows r = rows_at(c, from + l < to ? from + l : to - 1);
      first[l] = *r.first, second[l] = *r.second;
      rest_length[l] = *r.rest_length, lever[l] = *r.lever;
      normal_stiffness[l] = *r.normal_stiffness, bond_radius[l] = *r.bond_radius;
      strength_factor[l] = r.strength_factor == nullptr ? 1.0 : *r.strength_factor;
      for (std::size_t m = 0; m < most_scalars && r.memory.scalar[m] != nullptr; ++m)
        scalar[m][l] = *r.memory.scalar[m];
      for (std::size_t m = 0; m < most_vectors && r.memory.vector[m] != nullptr; ++m)
        vector[m][l] = *r.memory.vector[m];
    }
  }
  Rows rows() {
    Rows r{first, second, rest_length, lever, normal_stiffness, bond_radius, strength_factor, {}};
    for (std::size_t m = 0; m < most_scalars; ++m)
      r.memory.scalar[m] = scalar[m];
    for (std::size_t m = 0; m < most_vectors; ++m)
      r.memory.vector[m] = vector[m];
    return r;
  }
  void give_back(const InterfaceColumns &c, std::size_t from, std::size_t to) const {
    for (std::size_t l = 0; from + l < to; ++l) {
      for (std::size_t m = 0; m < most_scalars && c.memory.scalar[m] != nullptr; ++m)
        c.memory.scalar[m][from + l] = scalar[m][l];
      for (std::size_t m = 0; m < most_vectors && c.memory.vector[m] != nullptr; ++m)
        c.memory.vector[m][from + l] = vector[m][l];
    }
  }
};

inline void store(double *to, const Pack &a) {
  for (int l = 0; l < lanes; ++l)
    to[l] = a.v[l];
}

// f(column, member) for every member of a state and the column that keeps it.
template <class State, class F>
PLATEN_INLINE void for_each_memory(const MemoryColumns &columns, State &state, const F &f) {
  std::size_t scalars = 0, vectors = 0;
  State::describe(
      [&](const char *, const char *, auto &member) {
        if constexpr (std::is_same_v<std::decay_t<decltype(member)>, Pack>)
          f(columns.scalar[scalars++], member);
        else
          f(columns.vector[vectors++], member);
      },
      state);
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

template <bool rotation, bool factors, class Law>
PLATEN_INLINE Pack add_pack(const InterfaceColumns &c, const Law &law, const Rows &r, const Ends &ends,
                            double dt) {
  const Pack radius = load(r.bond_radius);
  InterfaceGeometry<Pack> g{load(r.rest_length), load(r.lever), load(r.normal_stiffness),
                            Pack(pi * radius * radius)};
  if constexpr (factors) g.strength_factor = load(r.strength_factor);
  typename Law::template State<Pack> s;
  for_each_memory(r.memory, s, [](const auto *column, auto &member) { member = load(column); });
  const InterfaceMotion<Pack> m = motion_of<rotation>(c.bonds, r, ends, g.lever, dt);
  const InterfaceResponse<Pack> response = law(s, g, m);
  for_each_memory(r.memory, s, [](auto *column, const auto &member) { store(column, member); });
  // Only what is across the distance has a moment: d x F = d x F_s.
  const Triple<Pack> moment = cross(m.distance, response.force);
  scatter<rotation>(ends, response.force, scale(g.lever, moment), scale(Pack(1.0 - g.lever), moment));
  return response.failed_now;
}

template <bool rotation, bool factors, class Law>
bool compute_forces(const InterfaceColumns &c, const BlockColumns &block, const Law &law, double dt,
                    std::size_t first, std::size_t last) {
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

template <bool rotation, class Law>
bool compute_with(const InterfaceColumns &c, const BlockColumns &block, const Law &law, double dt,
                  std::size_t first, std::size_t last) {
  return c.bonds.strength_factor != nullptr ? compute_forces<rotation, true>(c, block, law, dt, first, last)
                                            : compute_forces<rotation, false>(c, block, law, dt, first, last);
}

bool compute_forces_of(const InterfaceColumns &c, const BlockColumns &block, const BondLaw &law, double dt,
                       std::size_t first, std::size_t last) {
  return of_remembering(law, [&](const auto &one) {
    return c.bonds.orientation != nullptr ? compute_with<true>(c, block, one, dt, first, last)
                                          : compute_with<false>(c, block, one, dt, first, last);
  });
}

} // namespace

const InterfaceKernel PLATEN_KERNELS{compute_forces_of};

} // namespace platen::dem::kernels
