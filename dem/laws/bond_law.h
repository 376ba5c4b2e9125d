// The laws that the bonds of a specimen may follow, one law for all bonds: those with a word in the input,
// and one from outside. Loops choose the law once per block.
#pragma once

#include "dem/laws/cohesive_beam.h"
#include "dem/laws/cohesive_moments.h"
#include "dem/laws/elasto_damage_plastic.h"
#include "dem/laws/facet_bond.h"
#include "dem/laws/law_list.h"
#include "dem/laws/outside_law.h"
#include "dem/laws/parallel_bond.h"
#include "dem/laws/yielding_parallel_bond.h"

namespace platen::dem {

using BondLaws = LawList<ParallelBond, CohesiveBeam, ElastoDamagePlastic, YieldingParallelBond, FacetBond>;
using AllBondLaws = BondLaws::With<OutsideLaw>;
using BondLaw = AllBondLaws::Law;
using BondParameters = AllBondLaws::Parameters;

// Throws BadParameter.
inline BondLaw bond_law(const BondParameters &parameters) {
  return AllBondLaws::law(parameters);
}

// Whether bonds bend and twist, where spheres rotate.
inline bool bends(const BondLaw &law) {
  return std::visit([](const auto &l) { return l.bends(); }, law);
}
// Whether the law makes no sense between spheres without rotation.
inline bool needs_rotation(const BondLaw &law) {
  return std::visit([](const auto &l) { return l.needs_rotation; }, law);
}
template <class Law>
constexpr bool only_with_rotation = Law::needs_rotation;
template <>
inline constexpr bool only_with_rotation<OutsideLaw> = false; // its member decides
// Centre to centre: bonds act at the middle between the centres, otherwise at the point that divides the
// distance as the radii do.
inline bool centre_to_centre(const BondLaw &law) {
  return std::visit([](const auto &l) { return l.centre_to_centre; }, law);
}

// The reference length of strain is the distance of the centres when the bond is made, otherwise the sum of
// the radii.
inline bool over_distance(const BondLaw &law) {
  return std::visit([](const auto &l) { return l.over_distance; }, law);
}
// Bonds with a history: one update per step gives their forces. They yield, lose strength gradually, and
// continue as a contact of their own after failure.
inline bool has_history(const BondLaw &law) {
  return std::visit([](const auto &l) { return l.has_history; }, law);
}

// For bonds with a history: whether failed rows are kept behind the intact ones of their block, so that all
// bonds of a SIMD vector are of one kind.
template <class Law, class = void>
constexpr bool keeps_failed_last = false;
template <class Law>
constexpr bool keeps_failed_last<Law, std::enable_if_t<Law::failed_rows_last>> = true;
inline bool failed_rows_last(const BondLaw &law) {
  return std::visit([](const auto &l) { return keeps_failed_last<std::decay_t<decltype(l)>>; }, law);
}

// Of those, laws that leave their quick path wherever a bond of a SIMD vector is damaged, and damage many
// bonds long before they fail: their damaged rows are kept between the intact and the failed ones.
template <class Law, class = void>
constexpr bool keeps_damaged_separate = false;
template <class Law>
constexpr bool keeps_damaged_separate<Law, std::enable_if_t<Law::damaged_rows_separate>> = true;
inline bool damaged_rows_separate(const BondLaw &law) {
  return std::visit([](const auto &l) { return keeps_damaged_separate<std::decay_t<decltype(l)>>; }, law);
}

// Laws whose quick path (cohesive_form.h) reads how a bond's particles move; others do so where a bond is
// broken or breaks, or never.
template <class Law, class = void>
constexpr bool reads_motion = false;
template <class Law>
constexpr bool reads_motion<Law, std::enable_if_t<Law::intact_reads_motion>> = true;
// Laws for which the rows of a block hold the velocities of its particles: the laws above, and laws whose
// quick path reads no motion but which leave this path in most vectors.
template <class Law, class = void>
constexpr bool rows_hold_motion = reads_motion<Law>;
template <class Law>
constexpr bool rows_hold_motion<Law, std::enable_if_t<Law::often_reads_motion>> = true;
inline bool rows_hold_motion_of(const BondLaw &law) {
  return std::visit([](const auto &l) { return rows_hold_motion<std::decay_t<decltype(l)>>; }, law);
}

// Pairs within a fraction of the sum of their radii are bonded, whatever their gap.
inline bool bonds_by_range(const BondLaw &law) {
  return std::visit([](const auto &l) { return l.bonds_by_range; }, law);
}
// Broken bonds get the friction of grains, if their law has no friction of its own.
inline void set_grain_friction(BondLaw &law, double friction) {
  if (auto *yielding = std::get_if<YieldingParallelBond>(&law)) yielding->grain_friction = friction;
}

// f(law) for an elastic law; otherwise a default-constructed result.
template <class F>
auto of_elastic(const BondLaw &law, const F &f) {
  using Result = decltype(f(std::declval<const ParallelBond &>()));
  return std::visit(
      [&](const auto &one) {
        if constexpr (std::decay_t<decltype(one)>::has_history)
          return Result();
        else
          return f(one);
      },
      law);
}

// f(law) for a law with history; otherwise a default-constructed result.
template <class F>
auto of_remembering(const BondLaw &law, const F &f) {
  using Result = decltype(f(std::declval<const ElastoDamagePlastic &>()));
  return std::visit(
      [&](const auto &one) {
        if constexpr (std::decay_t<decltype(one)>::has_history)
          return f(one);
        else
          return Result();
      },
      law);
}

} // namespace platen::dem
