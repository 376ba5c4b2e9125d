// Body of the cohesive bond kernel; the including file sets PLATEN_LANES and PLATEN_KERNELS.
#include "base/pi.h"
#include "dem/kernels/block_rows.inc.h"
#include "dem/kernels/cohesive_kernel.h"
#include "dem/kernels/cohesive_memory.inc.h"
#include "dem/kernels/dashpots.inc.h"
#include "dem/kernels/simd.inc.h"

namespace platen::dem::kernels {
namespace {

template <class Law, class = void>
constexpr bool has_quick_path = false;
template <class Law>
constexpr bool has_quick_path<Law, std::void_t<decltype(Law::intact_members)>> = true;

PLATEN_INLINE Rotation<Simd> unturned() {
  const Simd none(0.0);
  return {Simd(1.0), none, none, none};
}

// Without rotation, orientations are those of the reference.
template <class Rows>
PLATEN_INLINE BondMotion<Simd> pose_of(const Triple<Simd> &distance, const Ends &ends) {
  if constexpr (Rows::rotation)
    return {distance, orientations<Rows>(FirstEnd(ends)), orientations<Rows>(SecondEnd(ends))};
  else
    return {distance, unturned(), unturned()};
}

// The argument of a quick path that does not read motion.
template <class Rows>
struct PairAtRest {
  const Ends &ends;
  Triple<Simd> distance = distances(ends);
  PLATEN_INLINE BondMotion<Simd> pose() const { return pose_of<Rows>(distance, ends); }
};

// Distance and relative velocity of the ends of each bond: from the rows, or from the particles' columns if
// the rows have no velocities.
template <class Rows>
PLATEN_INLINE void part(const BondColumns &c, std::size_t k, const Ends &ends, Triple<Simd> &distance,
                        Triple<Simd> &velocity) {
  if constexpr (Rows::motion)
    part(ends, distance, velocity);
  else
    distance = distances(ends), velocity = gather_difference(c.velocity, c.second + k, c.first + k);
}
template <class Rows, bool needs_orientations, class End>
PLATEN_INLINE EndTurn end_turn(const BondColumns &c, const int *particle, const End &end) {
  if constexpr (Rows::motion && needs_orientations) return turn_of<Rows>(end);
  EndTurn turn;
  if constexpr (Rows::motion)
    turn.spin = spins<Rows>(end);
  else
    turn.spin = gather(c.angular_velocity, particle);
  if constexpr (needs_orientations) turn.orientation = orientations<Rows>(end);
  return turn;
}

// Motion of the pair since its last state, at the velocities of the last drift. Without rotation, the
// orientations that a law needs are those of the reference.
template <class Rows, bool needs_orientations, bool from_the_middle = needs_orientations>
PLATEN_INLINE CohesiveMotion<Simd> motion_of(const BondColumns &c, std::size_t k, const Ends &ends,
                                             const Simd &lever, double dt) {
  CohesiveMotion<Simd> m;
  Triple<Simd> v;
  part<Rows>(c, k, ends, m.distance, v);
  m.travelled = scale(Simd(dt), v);
  m.spun_along = Simd(0.0);
  if constexpr (Rows::rotation) {
    const EndTurn i = end_turn<Rows, needs_orientations>(c, c.first + k, FirstEnd(ends));
    const EndTurn j = end_turn<Rows, needs_orientations>(c, c.second + k, SecondEnd(ends));
    const Triple<Simd> &wi = i.spin, &wj = j.spin;
    // Velocity of the second's point, at -(1 - a) d from its centre, minus the first's, at a d.
    const Triple<Simd> turning = scale(lever, wi) + scale(Simd(1.0 - lever), wj);
    if constexpr (from_the_middle)
      v = v + cross(m.distance - scale(Simd(0.5), m.travelled), turning);
    else
      v = v + cross(m.distance, turning);
    m.spun_along = (0.5 * dt) * dot(wi + wj, m.distance);
    if constexpr (needs_orientations) {
      m.turn_i = i.orientation, m.turn_j = j.orientation;
      m.turned_i = scale(Simd(dt), wi), m.turned_j = scale(Simd(dt), wj);
    }
  } else if constexpr (needs_orientations) {
    const Simd none(0.0);
    m.turn_i = m.turn_j = unturned();
    m.turned_i = m.turned_j = {none, none, none};
  }
  m.moved = scale(Simd(dt), v);
  return m;
}

template <class Law>
PLATEN_INLINE CohesiveGeometry<Simd> geometry(const BondColumns &b, std::size_t k, bool factors) {
  const Simd radius = load(b.bond_radius + k);
  CohesiveGeometry<Simd> g{load(b.rest_length + k), load(b.lever + k), load(b.normal_stiffness + k),
                           Simd(pi * radius * radius)};
  if (factors) g.strength_factor = load(b.strength_factor + k);
  if constexpr (Law::needs_orientations) g.reference = load(b.reference + k), g.radius = radius;
  return g;
}

template <class Rows, class Law>
PLATEN_INLINE void scatter_response(const Ends &ends, const CohesiveGeometry<Simd> &g,
                                    const Triple<Simd> &distance, const CohesiveResponse<Simd> &response) {
  if constexpr (Law::needs_orientations) {
    scatter<Rows>(ends, response.force, response.torque_i, response.torque_j);
  } else { // only the shear force has a moment: d x F = d x F_s
    const Triple<Simd> moment = cross(distance, response.force);
    scatter<Rows>(ends, response.force, scale(g.lever, moment), scale(Simd(1.0 - g.lever), moment));
  }
}

// Changes of a SIMD vector of bonds in this step.
struct LaneChanges {
  Simd failed;            // positive where one has failed
  bool by_damage = false; // an undamaged bond was damaged; only for laws that keep damaged rows separate
  PLATEN_INLINE bool any() const { return by_damage || any_positive(failed); }
};

// Response of bonds from their full history and motion.
template <class Rows, bool factors, class Law>
PLATEN_INLINE LaneChanges add_lanes_by_motion(const CohesiveColumns &c, const Law &law, std::size_t k,
                                              const Ends &ends, double dt) {
  const CohesiveGeometry<Simd> g = geometry<Law>(c.bonds, k, factors);
  typename Law::template State<Simd> s;
  for_each_memory(c.memory, k, s, [](const auto *column, auto &member) { member = load(column); });
  const CohesiveMotion<Simd> m = motion_of<Rows, Law::needs_orientations>(c.bonds, k, ends, g.lever, dt);
  const Simd before = law.damage_of(s);
  const CohesiveResponse<Simd> response = law(s, g, m);
  for_each_memory(c.memory, k, s, [](auto *column, const auto &member) { store(column, member); });
  scatter_response<Rows, Law>(ends, g, m.distance, response);
  LaneChanges changes{response.failed_now};
  if constexpr (keeps_damaged_separate<Law>)
    changes.by_damage = any_positive(where_positive(before, Simd(0.0), law.damage_of(s)));
  return changes;
}

// The same as a separate function, so that the loop over intact bonds keeps its registers.
template <class Rows, bool factors, class Law>
[[gnu::noinline]] LaneChanges add_broken_lanes(const CohesiveColumns &c, const Law &law, std::size_t k,
                                               const Ends &ends, double dt) {
  return add_lanes_by_motion<Rows, factors>(c, law, k, ends, dt);
}

// A SIMD vector in which all bonds are broken.
template <class Rows, bool factors, class Law>
[[gnu::noinline]] void add_lanes_of_broken(const CohesiveColumns &c, const Law &law, std::size_t k,
                                           const Ends &ends, double dt) {
  const CohesiveGeometry<Simd> g = geometry<Law>(c.bonds, k, factors);
  typename Law::template State<Simd> s;
  for_each_memory(c.memory, k, s, [](const auto *column, auto &member) { member = load(column); });
  if (law.stays_separated(s, g, distances(ends))) return;
  const CohesiveMotion<Simd> m =
      motion_of<Rows, false, Law::needs_orientations>(c.bonds, k, ends, g.lever, dt);
  const CohesiveResponse<Simd> response = law.advance_broken(s, g, m);
  for_each_memory(c.memory, k, s, [](auto *column, const auto &member) { store(column, member); });
  scatter<Rows>(ends, response.force, response.torque_i, response.torque_j);
}

// Adds the dashpots to the spring response of a SIMD vector of intact bonds.
template <class Rows, bool dashpots>
PLATEN_INLINE void add_dashpots(const BondColumns &c, std::size_t k, const Ends &ends,
                                CohesiveResponse<Simd> &response, PowerSum &power) {
  if constexpr (dashpots) {
    Triple<Simd> d, v;
    part(ends, d, v);
    const DashpotResponse r = dashpots_of<Rows>(c, k, ends, d, v, Simd(1.0), power);
    response.force = response.force + r.force;
    response.torque_i = response.torque_i + r.torque_i;
    response.torque_j = response.torque_j + r.torque_j;
  }
}

// A SIMD vector with bonds that are damaged or broken or may become so, from their full history.
template <class Rows, bool factors, bool dashpots, class Law>
PLATEN_INLINE bool add_any_lanes(const CohesiveColumns &c, const Law &law, std::size_t k, const Ends &ends,
                                 double dt, PowerSum &power) {
  const LaneChanges changes = add_broken_lanes<Rows, factors>(c, law, k, ends, dt);
  if constexpr (dashpots) add_dashpots_separately<Rows>(c.bonds, k, ends, changes.failed, power);
  return changes.any();
}

// Returns whether a bond has failed, or its place among the rows may have changed.
template <class Rows, bool factors, bool dashpots, class Law>
PLATEN_INLINE bool add_lanes(const CohesiveColumns &c, const Law &law, std::size_t k, const Ends &ends,
                             double dt, PowerSum &power) {
  typename Law::template State<Simd> s;
  for_each_memory(c.memory, k, s, [](const auto *column, auto &member) { member = load(column); });
  if constexpr (keeps_failed_last<Law>)
    if (all_positive(law.failed(s))) { // failed bonds have no dashpots
      add_lanes_of_broken<Rows, factors>(c, law, k, ends, dt);
      return false;
    }
  if constexpr (has_quick_path<Law>) {
    const CohesiveGeometry<Simd> g = geometry<Law>(c.bonds, k, factors);
    const auto advance = [&](const auto &pair) __attribute__((always_inline)) {
      CohesiveResponse<Simd> response;
      bool yielded = false;
      if (!law.advance_intact(s, g, pair, response, yielded)) return false;
      keep_intact<Law>(c.memory, k, s, yielded);
      add_dashpots<Rows, dashpots>(c.bonds, k, ends, response, power);
      scatter_response<Rows, Law>(ends, g, pair.distance, response);
      return true;
    };
    bool done = false;
    if constexpr (reads_motion<Law>)
      done = advance(motion_of<Rows, Law::needs_orientations>(c.bonds, k, ends, g.lever, dt));
    else
      done = advance(PairAtRest<Rows>{ends});
    if (done) return false;
  }
  return add_any_lanes<Rows, factors, dashpots>(c, law, k, ends, dt, power);
}

// Prefetches the coming rows of a column.
template <class Value>
PLATEN_INLINE void prefetch(const Value *row) {
  constexpr std::size_t vectors_ahead = 6, bytes = lanes * sizeof(Value), line = 64;
  const char *to_come = reinterpret_cast<const char *>(row) + vectors_ahead * bytes;
  for (std::size_t byte = 0; byte < bytes; byte += line)
    __builtin_prefetch(to_come + byte, 0, 2);
}
// Prefetches all columns of laws that read motion: a core by itself does not prefetch so many. (For laws that
// read fewer columns it does, and explicit prefetches only cost time.)
template <class Law>
PLATEN_INLINE void prefetch_next(const CohesiveColumns &c, std::size_t k) {
  if constexpr (reads_motion<Law>) {
    const BondColumns &b = c.bonds;
    if constexpr (Law::needs_orientations) prefetch(b.reference + k);
    prefetch(b.ends + k), prefetch(b.rest_length + k), prefetch(b.lever + k);
    prefetch(b.normal_stiffness + k), prefetch(b.bond_radius + k);
    typename Law::template State<Simd> state;
    for_each_memory(c.memory, k, state, [](const auto *column, auto &) { prefetch(column); });
  }
}

template <class Rows, bool factors, bool dashpots, class Law>
BlockFindings compute_forces(const CohesiveColumns &c, const BlockColumns &block, const Law &law, double dt,
                             std::size_t first, std::size_t last) {
  gather<Rows>(c.bonds, block);
  BlockFindings found;
  PowerSum power;
  const auto look = [&](std::size_t at, std::size_t end, bool changed) {
    if (changed) add_reached(found, at, end);
  };
  std::size_t k = first;
  for (; k + lanes <= last; k += lanes) {
    prefetch_next<Law>(c, k);
    const Ends ends = ends_of(c.bonds, block, k);
    look(k, k + lanes, add_lanes<Rows, factors, dashpots>(c, law, k, ends, dt, power));
  }
  if (k < last) {
    Tail tail(c.bonds, k, last);
    MemoryTail memory(c.memory, k, last);
    const TailEnds at = tail_ends<Rows>(c.bonds, block, k, last);
    const CohesiveColumns rest{tail.columns(c.bonds), memory.columns()};
    const Ends ends{block.rows, at.at};
    look(k, last, add_lanes<Rows, factors, dashpots>(rest, law, 0, ends, dt, power));
    memory.give_back(c.memory, k, last);
    tail.give_back(c.bonds, k, last);
  }
  scatter<Rows>(block);
  found.dashpot_power = power.sum;
  return found;
}

template <bool rotation, bool dashpots, class Law>
BlockFindings compute_with(const CohesiveColumns &c, const BlockColumns &block, const Law &law, double dt,
                           std::size_t first, std::size_t last) {
  using Rows = RowLayout<rotation, rows_hold_motion<Law> || dashpots>;
  return c.bonds.strength_factor != nullptr
             ? compute_forces<Rows, true, dashpots>(c, block, law, dt, first, last)
             : compute_forces<Rows, false, dashpots>(c, block, law, dt, first, last);
}

template <bool rotation, class Law>
BlockFindings compute_by_dashpots(const CohesiveColumns &c, const BlockColumns &block, const Law &law,
                                  double dt, std::size_t first, std::size_t last) {
  return c.bonds.dashpot != nullptr ? compute_with<rotation, true>(c, block, law, dt, first, last)
                                    : compute_with<rotation, false>(c, block, law, dt, first, last);
}

// f(law), or f of the bending variant of the law if spheres rotate and its bonds bend.
template <class Law, class F>
auto as_it_bends(const Law &law, bool turning, const F &f) {
  if constexpr (std::is_same_v<Law, ElastoDamagePlastic>)
    if (turning && law.bends()) return f(BendingCohesive{law});
  return f(law);
}

BlockFindings compute_forces_of(const CohesiveColumns &c, const BlockColumns &block, const BondLaw &law,
                                double dt, std::size_t first, std::size_t last) {
  const bool turning = c.bonds.orientation != nullptr;
  return of_remembering(law, [&](const auto &remembering) {
    return as_it_bends(remembering, turning, [&](const auto &one) {
      return turning ? compute_by_dashpots<true>(c, block, one, dt, first, last)
                     : compute_by_dashpots<false>(c, block, one, dt, first, last);
    });
  });
}

// Reads the particles' columns.
template <bool rotation, class Law>
PLATEN_INLINE void measure_lanes(const CohesiveColumns &c, const Law &law, const CohesiveRowValues &to,
                                 std::size_t k, std::size_t at, std::size_t count) {
  const BondColumns &b = c.bonds;
  const int *i = b.first + k, *j = b.second + k;
  const Simd none(0.0);
  BondMotion<Simd> pose{gather_difference(b.position, j, i), {Simd(1.0), none, none, none}, {}};
  pose.turn_j = pose.turn_i;
  if constexpr (rotation && Law::needs_orientations)
    pose.turn_i = gather(b.orientation, i), pose.turn_j = gather(b.orientation, j);
  const CohesiveGeometry<Simd> g = geometry<Law>(b, k, b.strength_factor != nullptr);
  typename Law::template State<Simd> s;
  for_each_memory(c.memory, k, s, [](const auto *column, auto &member) { member = load(column); });
  const ForceAndEnergy<Simd> stored = law.force_and_energy(s, g, pose);
  const auto put = [&](double *column, const Simd &value) {
    for (std::size_t l = 0; l < count; ++l)
      column[at + l] = value.v[l];
  };
  put(to.energy, stored.energy);
  put(to.force, root(dot(stored.force, stored.force)));
  put(to.dissipated, s.dissipated);
  put(to.damage, law.damage_of(s));
  put(to.plastic, law.plastic_work(s, g));
}

template <bool rotation, class Law>
void measure(const CohesiveColumns &c, const Law &law, const CohesiveRowValues &to, std::size_t first,
             std::size_t last) {
  std::size_t k = first;
  for (; k + lanes <= last; k += lanes)
    measure_lanes<rotation>(c, law, to, k, k - first, lanes);
  if (k == last) return;
  Tail tail(c.bonds, k, last);
  MemoryTail memory(c.memory, k, last);
  BondColumns rest = tail.columns(c.bonds);
  if (c.bonds.strength_factor == nullptr) rest.strength_factor = nullptr;
  measure_lanes<rotation>({rest, memory.columns()}, law, to, 0, k - first, last - k);
}

void measure_of(const CohesiveColumns &c, const BondLaw &law, const CohesiveRowValues &to, std::size_t first,
                std::size_t last) {
  const bool turning = c.bonds.orientation != nullptr;
  of_remembering(law, [&](const auto &remembering) {
    as_it_bends(remembering, turning, [&](const auto &one) {
      turning ? measure<true>(c, one, to, first, last) : measure<false>(c, one, to, first, last);
    });
  });
}

} // namespace

const CohesiveKernel PLATEN_KERNELS{compute_forces_of, measure_of};

} // namespace platen::dem::kernels
