// The laws that a specimen's bonds may follow, all bonds the same: those that have a word, and one from
// outside. Loops ask once a block which it is.
#pragma once

#include "dem/laws/cohesive_beam.h"
#include "dem/laws/cohesive_moments.h"
#include "dem/laws/elasto_damage_plastic.h"
#include "dem/laws/law_list.h"
#include "dem/laws/outside_law.h"
#include "dem/laws/parallel_bond.h"
#include "dem/laws/yielding_parallel_bond.h"

namespace platen::dem {

using BondLaws = LawList<ParallelBond, CohesiveBeam, ElastoDamagePlastic, YieldingParallelBond>;
using AllBondLaws = BondLaws::With<OutsideLaw>;
using BondLaw = AllBondLaws::Law;
using BondParameters = AllBondLaws::Parameters;

// Throws BadParameter.
inline BondLaw bond_law(const BondParameters &parameters) {
  return AllBondLaws::law(parameters);
}

// With bending and twisting, where spheres turn.
inline bool bends(const BondLaw &law) {
  return std::visit([](const auto &l) { return l.bends(); }, law);
}
// Bonds that make no sense between spheres that do not turn.
inline bool needs_rotation(const BondLaw &law) {
  return std::visit([](const auto &l) { return l.needs_rotation; }, law);
}
template <class Law>
constexpr bool only_with_rotation = Law::needs_rotation;
template <>
inline constexpr bool only_with_rotation<OutsideLaw> = false; // it says so itself
// From centre to centre: they act on each other in the middle between the centres, otherwise where their
// distance is divided as the radii are.
inline bool centre_to_centre(const BondLaw &law) {
  return std::visit([](const auto &l) { return l.centre_to_centre; }, law);
}

// The length that strain refers to is the distance of the centres when the bond is made, otherwise the sum of
// the radii.
inline bool over_distance(const BondLaw &law) {
  return std::visit([](const auto &l) { return l.over_distance; }, law);
}
// Bonds that remember: their forces are found by bringing them up to date once a step. They yield, lose
// strength bit by bit, and what has failed goes on as a contact of its own.
inline bool has_history(const BondLaw &law) {
  return std::visit([](const auto &l) { return l.has_history; }, law);
}

// Of bonds that remember: whether rows that have failed are kept behind the whole ones of their block, so
// that SIMD vectors of a kernel are of one kind.
template <class Law, class = void>
constexpr bool keeps_failed_last = false;
template <class Law>
constexpr bool keeps_failed_last<Law, std::enable_if_t<Law::failed_rows_last>> = true;
inline bool failed_rows_last(const BondLaw &law) {
  return std::visit([](const auto &l) { return keeps_failed_last<std::decay_t<decltype(l)>>; }, law);
}

// Laws whose quick path (cohesive_form.h) reads how a bond's particles move; others do so where a bond is
// broken or breaks, or never.
template <class Law, class = void>
constexpr bool reads_motion = false;
template <class Law>
constexpr bool reads_motion<Law, std::enable_if_t<Law::intact_reads_motion>> = true;
inline bool law_reads_motion(const BondLaw &law) {
  return std::visit([](const auto &l) { return reads_motion<std::decay_t<decltype(l)>>; }, law);
}

// Pairs within a share of the sum of their radii are bonded, whatever their gap.
inline bool bonds_by_range(const BondLaw &law) {
  return std::visit([](const auto &l) { return l.bonds_by_range; }, law);
}
// What has broken rubs as grains do, of laws that have no friction of their own for it.
inline void set_grain_friction(BondLaw &law, double friction) {
  if (auto *yielding = std::get_if<YieldingParallelBond>(&law)) yielding->grain_friction = friction;
}

// f(law) where the law held is elastic; else f's result as it is made of nothing.
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

// f(law) where the law held remembers; else f's result as it is made of nothing.
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
