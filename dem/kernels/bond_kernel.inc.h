// Body of the bond kernels; the including file sets PLATEN_LANES and PLATEN_KERNELS.
#include "dem/kernels/block_rows.inc.h"
#include "dem/kernels/bond_kernel.h"
#include "dem/kernels/pack.inc.h"

namespace platen::dem::kernels {
namespace {

// What moves and what bonds resist.
enum class Turning { none, forces, moments };

template <bool factors>
PLATEN_INLINE BondGeometry<Pack> geometry(const BondColumns &c, std::size_t k) {
  BondGeometry<Pack> g;
  g.reference = load(c.reference + k);
  g.rest_length = load(c.rest_length + k);
  g.lever = load(c.lever + k);
  g.normal_stiffness = load(c.normal_stiffness + k);
  g.radius = load(c.bond_radius + k);
  if constexpr (factors) g.strength_factor = load(c.strength_factor + k);
  return g;
}

// `factors`: bonds have strengths of their own.
template <Turning turning>
using RowsOf = RowLayout<turning != Turning::none, false>;

template <Turning turning, bool factors, class Law>
PLATEN_INLINE Pack add_pack(const BondColumns &c, const Law &law, std::size_t k, const Ends &ends) {
  using Rows = RowsOf<turning>;
  const Triple<Pack> d = distances(ends);
  BondResponse<Pack> r;
  if constexpr (Rows::rotation)
    r = law.template turning<turning == Turning::moments>(
        geometry<factors>(c, k),
        BondMotion<Pack>{d, orientations<Rows>(FirstEnd(ends)), orientations<Rows>(SecondEnd(ends))});
  else
    r = law.without_rotation(geometry<factors>(c, k), d);
  scatter<Rows>(ends, r.force, r.torque_i, r.torque_j);
  return r.excess;
}

template <Turning turning, bool factors, class Law>
[[gnu::noinline]] Pack add_tail(const BondColumns &c, const BlockColumns &block, const Law &law,
                                std::size_t k, std::size_t last) {
  Tail tail(c, k, last);
  const TailEnds ends = tail_ends<RowsOf<turning>>(c, block, k, last);
  return add_pack<turning, factors>(tail.columns(c), law, 0, Ends{block.rows, ends.at});
}

template <Turning turning, bool factors, class Law>
bool compute_forces(const BondColumns &c, const BlockColumns &block, const Law &law, std::size_t first,
                    std::size_t last) {
  gather<RowsOf<turning>>(c, block);
  Pack excess = Pack(-1.0);
  std::size_t k = first;
  for (; k + lanes <= last; k += lanes)
    excess = larger(excess, add_pack<turning, factors>(c, law, k, ends_of(c, block, k)));
  if (k < last) excess = larger(excess, add_tail<turning, factors>(c, block, law, k, last));
  scatter<RowsOf<turning>, false>(block);
  bool reached = false;
  for (int l = 0; l < lanes; ++l)
    reached |= excess.v[l] >= 0.0;
  return reached;
}

template <bool factors, class Law>
bool compute_forces_with(const BondColumns &c, const BlockColumns &block, const Law &law, std::size_t first,
                         std::size_t last) {
  if (c.orientation != nullptr && law.bends())
    return compute_forces<Turning::moments, factors>(c, block, law, first, last);
  if constexpr (!Law::needs_rotation) {
    if (c.orientation != nullptr) return compute_forces<Turning::forces, factors>(c, block, law, first, last);
    return compute_forces<Turning::none, factors>(c, block, law, first, last);
  }
  return false;
}

bool compute_forces_of(const BondColumns &c, const BlockColumns &block, const BondLaw &law, std::size_t first,
                       std::size_t last) {
  const auto compute = [&](const auto &one) {
    return c.strength_factor != nullptr ? compute_forces_with<true>(c, block, one, first, last)
                                        : compute_forces_with<false>(c, block, one, first, last);
  };
  return of_elastic(law, compute);
}

// From the particles' columns, for bonds of any block.
template <Turning turning, bool factors, class Law>
PLATEN_INLINE BondResponse<Pack> respond(const BondColumns &c, const Law &law, std::size_t k) {
  const int *i = c.first + k, *j = c.second + k;
  const Triple<Pack> d = gather_difference(c.position, j, i);
  if constexpr (turning == Turning::none)
    return law.without_rotation(geometry<factors>(c, k), d);
  else
    return law.template turning<turning == Turning::moments>(
        geometry<factors>(c, k), BondMotion<Pack>{d, gather(c.orientation, i), gather(c.orientation, j)});
}

template <Turning turning, bool factors, class Law>
void measure(const BondColumns &c, const Law &law, const BondRowValues &to, std::size_t first,
             std::size_t last) {
  const auto put = [&](double *column, const Pack &value, std::size_t at, std::size_t count) {
    if (column == nullptr) return;
    for (std::size_t l = 0; l < count; ++l)
      column[at + l] = value.v[l];
  };
  for (std::size_t k = first; k < last; k += lanes) {
    const std::size_t count = last - k < lanes ? last - k : lanes;
    BondResponse<Pack> r;
    if (count == lanes) {
      r = respond<turning, factors>(c, law, k);
    } else {
      Tail tail(c, k, last);
      r = respond<turning, factors>(tail.columns(c), law, 0);
    }
    put(to.tension_ratio, r.tension_ratio, k - first, count);
    put(to.shear_ratio, r.shear_ratio, k - first, count);
    put(to.energy, r.energy, k - first, count);
    put(to.force, root(dot(r.force, r.force)), k - first, count);
  }
}

template <bool factors, class Law>
void measure_with(const BondColumns &c, const Law &law, const BondRowValues &to, std::size_t first,
                  std::size_t last) {
  if (c.orientation != nullptr && law.bends())
    return measure<Turning::moments, factors>(c, law, to, first, last);
  if constexpr (!Law::needs_rotation) {
    if (c.orientation != nullptr) return measure<Turning::forces, factors>(c, law, to, first, last);
    measure<Turning::none, factors>(c, law, to, first, last);
  }
}

void measure_of(const BondColumns &c, const BondLaw &law, const BondRowValues &to, std::size_t first,
                std::size_t last) {
  const auto measure_all = [&](const auto &one) {
    c.strength_factor != nullptr ? measure_with<true>(c, one, to, first, last)
                                 : measure_with<false>(c, one, to, first, last);
  };
  of_elastic(law, measure_all);
}

// Dashpots beside the springs, at the contact point lever d from the first centre (docs/theory.md).
template <class Rows, Turning turning>
PLATEN_INLINE Pack add_dashpot_pack(const BondColumns &c, std::size_t k, const Ends &ends) {
  const int *i = c.first + k, *j = c.second + k;
  const Triple<Pack> d = gather_difference(c.position, j, i);
  const Triple<Pack> ri = scale(load(c.lever + k), d), rj = ri - d;
  Triple<Pack> v = gather_difference(c.velocity, j, i), w{}, ti{}, tj{};
  if constexpr (turning != Turning::none) {
    const Triple<Pack> wi = gather(c.angular_velocity, i), wj = gather(c.angular_velocity, j);
    v = v + (cross(wj, rj) - cross(wi, ri));
    w = wj - wi;
  }
  const Pack per_square = 1.0 / dot(d, d);
  const Triple<Pack> along = scale(dot(v, d) * per_square, d);
  const Triple<Pack> force =
      scale(load(c.dashpot + k), along + scale(Pack(c.dashpot_shear_ratio), v - along));
  Pack power = dot(force + load(c.dashpot_force + k), v);
  store(c.dashpot_force + k, force);
  if constexpr (turning != Turning::none) {
    ti = cross(ri, force);
    tj = cross(force, rj);
  }
  if constexpr (turning == Turning::moments) {
    const Triple<Pack> twisting = scale(dot(w, d) * per_square, d);
    const Triple<Pack> moment =
        scale(load(c.dashpot_bending + k), (w - twisting) + scale(Pack(c.dashpot_twist_ratio), twisting));
    ti = ti + moment;
    tj = tj - moment;
    power = power + dot(moment + load(c.dashpot_moment + k), w);
    store(c.dashpot_moment + k, moment);
  }
  scatter<Rows>(ends, force, ti, tj);
  return power;
}

// Powers by the number of the bond, so that their sum does not depend on which rows were dropped.
struct PowerSums {
  static constexpr int slots = 8;
  double slot[slots] = {};
  void add(const Pack &power, const int *record, std::size_t count) {
    for (std::size_t l = 0; l < count; ++l)
      slot[record[l] % slots] += power.v[l];
  }
  double sum() const {
    double all = 0;
    for (const double s : slot)
      all += s;
    return all;
  }
};

template <Turning turning, bool motion>
double add_dashpots(const BondColumns &c, const BlockColumns &block, std::size_t first, std::size_t last) {
  using Rows = RowLayout<turning != Turning::none, motion>;
  gather<Rows>(c, block);
  PowerSums power;
  std::size_t k = first;
  for (; k + lanes <= last; k += lanes)
    power.add(add_dashpot_pack<Rows, turning>(c, k, ends_of(c, block, k)), c.record + k, lanes);
  if (k < last) {
    Tail tail(c, k, last);
    const TailEnds ends = tail_ends<Rows>(c, block, k, last);
    power.add(add_dashpot_pack<Rows, turning>(tail.columns(c), 0, Ends{block.rows, ends.at}), c.record + k,
              last - k);
    for (std::size_t l = 0; k + l < last; ++l) {
      c.dashpot_force[k + l] = tail.dashpot_force[l];
      if constexpr (turning == Turning::moments) c.dashpot_moment[k + l] = tail.dashpot_moment[l];
    }
  }
  scatter<Rows, true>(block);
  return power.sum();
}

template <bool motion>
double add_dashpots_in(const BondColumns &c, const BlockColumns &block, std::size_t first, std::size_t last) {
  if (c.orientation == nullptr) return add_dashpots<Turning::none, motion>(c, block, first, last);
  return c.dashpot_moment != nullptr ? add_dashpots<Turning::moments, motion>(c, block, first, last)
                                     : add_dashpots<Turning::forces, motion>(c, block, first, last);
}
double add_dashpots_of(const BondColumns &c, const BlockColumns &block, std::size_t first, std::size_t last) {
  return c.motion ? add_dashpots_in<true>(c, block, first, last)
                  : add_dashpots_in<false>(c, block, first, last);
}

} // namespace

const BondKernels PLATEN_KERNELS{compute_forces_of, add_dashpots_of, measure_of};

} // namespace platen::dem::kernels
