// Body of the bond kernels; the including file sets PLATEN_LANES and PLATEN_KERNELS.
#include "dem/kernels/block_rows.inc.h"
#include "dem/kernels/bond_kernel.h"
#include "dem/kernels/dashpots.inc.h"
#include "dem/kernels/simd.inc.h"

namespace platen::dem::kernels {
namespace {

// No rotation; rotation without moments of bonds; rotation with moments.
enum class Turning { none, forces, moments };

template <bool factors>
PLATEN_INLINE BondGeometry<Simd> geometry(const BondColumns &c, std::size_t k) {
  BondGeometry<Simd> g;
  g.reference = load(c.reference + k);
  g.rest_length = load(c.rest_length + k);
  g.lever = load(c.lever + k);
  g.normal_stiffness = load(c.normal_stiffness + k);
  g.radius = load(c.bond_radius + k);
  if constexpr (factors) g.strength_factor = load(c.strength_factor + k);
  return g;
}

// `factors`: each bond has a strength factor; `dashpots`: in parallel with the springs.
template <Turning turning_, bool factors_, bool dashpots_>
struct LoopOf {
  static constexpr Turning turning = turning_;
  static constexpr bool factors = factors_, dashpots = dashpots_;
  using Rows = RowLayout<turning != Turning::none, dashpots>;
};

template <class Loop, class Law>
PLATEN_INLINE BondResponse<Simd> respond(const BondColumns &c, const Law &law, std::size_t k,
                                         const Ends &ends, const Triple<Simd> &d) {
  using Rows = typename Loop::Rows;
  if constexpr (Rows::rotation)
    return law.template turning<Loop::turning == Turning::moments>(
        geometry<Loop::factors>(c, k),
        BondMotion<Simd>{d, orientations<Rows>(FirstEnd(ends)), orientations<Rows>(SecondEnd(ends))});
  else
    return law.without_rotation(geometry<Loop::factors>(c, k), d);
}

template <class Loop, class Law>
PLATEN_INLINE Simd add_lanes(const BondColumns &c, const Law &law, std::size_t k, const Ends &ends,
                             PowerSum &power) {
  using Rows = typename Loop::Rows;
  if constexpr (Loop::dashpots) {
    Triple<Simd> d, v;
    part(ends, d, v);
    const DashpotResponse damping = dashpots_of<Rows>(c, k, ends, d, v, Simd(1.0), power);
    const BondResponse<Simd> r = respond<Loop>(c, law, k, ends, d);
    scatter<Rows>(ends, r.force + damping.force, r.torque_i + damping.torque_i,
                  r.torque_j + damping.torque_j);
    return r.excess;
  } else {
    const BondResponse<Simd> r = respond<Loop>(c, law, k, ends, distances(ends));
    scatter<Rows>(ends, r.force, r.torque_i, r.torque_j);
    return r.excess;
  }
}

template <class Loop, class Law>
[[gnu::noinline]] Simd add_tail(const BondColumns &c, const BlockColumns &block, const Law &law,
                                std::size_t k, std::size_t last, PowerSum &power) {
  Tail tail(c, k, last);
  const TailEnds ends = tail_ends<typename Loop::Rows>(c, block, k, last);
  const Simd excess = add_lanes<Loop>(tail.columns(c), law, 0, Ends{block.rows, ends.at}, power);
  tail.give_back(c, k, last);
  return excess;
}

template <class Loop, class Law>
BlockFindings compute_forces(const BondColumns &c, const BlockColumns &block, const Law &law,
                             std::size_t first, std::size_t last) {
  using Rows = typename Loop::Rows;
  gather<Rows>(c, block);
  BlockFindings found;
  PowerSum power;
  const auto look = [&](std::size_t at, std::size_t end, const Simd &excess) {
    if (lanes_at_least(excess, Simd(0.0)) != 0) add_reached(found, at, end);
  };
  std::size_t k = first;
  for (; k + lanes <= last; k += lanes)
    look(k, k + lanes, add_lanes<Loop>(c, law, k, ends_of(c, block, k), power));
  if (k < last) look(k, last, add_tail<Loop>(c, block, law, k, last, power));
  scatter<Rows>(block);
  found.dashpot_power = power.sum;
  return found;
}

template <Turning turning, bool factors, class Law>
BlockFindings compute_turning(const BondColumns &c, const BlockColumns &block, const Law &law,
                              std::size_t first, std::size_t last) {
  return c.dashpot != nullptr ? compute_forces<LoopOf<turning, factors, true>>(c, block, law, first, last)
                              : compute_forces<LoopOf<turning, factors, false>>(c, block, law, first, last);
}

template <bool factors, class Law>
BlockFindings compute_forces_with(const BondColumns &c, const BlockColumns &block, const Law &law,
                                  std::size_t first, std::size_t last) {
  if (c.orientation != nullptr && law.bends())
    return compute_turning<Turning::moments, factors>(c, block, law, first, last);
  if constexpr (!Law::needs_rotation) {
    if (c.orientation != nullptr)
      return compute_turning<Turning::forces, factors>(c, block, law, first, last);
    return compute_turning<Turning::none, factors>(c, block, law, first, last);
  }
  return {};
}

// f(law) for the laws of these kernels: all elastic laws with a keyword, or the outside law.
template <class F>
auto of_compiled(const BondLaw &law, const F &f) {
#ifdef PLATEN_OUTSIDE_LAW
  return f(*static_cast<const PLATEN_OUTSIDE_LAW *>(std::get<OutsideLaw>(law).parameters.law.get()));
#else
  using Result = decltype(f(std::declval<const ParallelBond &>()));
  return of_elastic(law, [&](const auto &one) {
    if constexpr (std::is_same_v<std::decay_t<decltype(one)>, OutsideLaw>)
      return Result();
    else
      return f(one);
  });
#endif
}

BlockFindings compute_forces_of(const BondColumns &c, const BlockColumns &block, const BondLaw &law,
                                std::size_t first, std::size_t last) {
  const auto compute = [&](const auto &one) {
    return c.strength_factor != nullptr ? compute_forces_with<true>(c, block, one, first, last)
                                        : compute_forces_with<false>(c, block, one, first, last);
  };
  return of_compiled(law, compute);
}

// Reads the particles' columns, for bonds of any block.
template <Turning turning, bool factors, class Law>
PLATEN_INLINE BondResponse<Simd> respond(const BondColumns &c, const Law &law, std::size_t k) {
  const int *i = c.first + k, *j = c.second + k;
  const Triple<Simd> d = gather_difference(c.position, j, i);
  if constexpr (turning == Turning::none)
    return law.without_rotation(geometry<factors>(c, k), d);
  else
    return law.template turning<turning == Turning::moments>(
        geometry<factors>(c, k), BondMotion<Simd>{d, gather(c.orientation, i), gather(c.orientation, j)});
}

template <Turning turning, bool factors, class Law>
void measure(const BondColumns &c, const Law &law, const BondRowValues &to, std::size_t first,
             std::size_t last) {
  const auto put = [&](double *column, const Simd &value, std::size_t at, std::size_t count) {
    if (column == nullptr) return;
    for (std::size_t l = 0; l < count; ++l)
      column[at + l] = value.v[l];
  };
  for (std::size_t k = first; k < last; k += lanes) {
    const std::size_t count = last - k < lanes ? last - k : lanes;
    BondResponse<Simd> r;
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
  of_compiled(law, measure_all);
}

} // namespace

const BondKernels PLATEN_KERNELS{compute_forces_of, measure_of};

} // namespace platen::dem::kernels
