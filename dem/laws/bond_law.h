// The laws that a specimen's bonds may follow, all bonds the same. Loops ask once a block which it is.
#pragma once

#include <variant>

#include "dem/laws/cohesive_beam.h"
#include "dem/laws/parallel_bond.h"

namespace platen::dem {

using BondLaw = std::variant<ParallelBond, CohesiveBeam>;
using BondParameters = std::variant<ParallelBond::Parameters, CohesiveBeam::Parameters>;

inline BondLaw bond_law(const BondParameters &parameters) {
  if (const auto *beam = std::get_if<CohesiveBeam::Parameters>(&parameters)) return CohesiveBeam{*beam};
  return ParallelBond{std::get<ParallelBond::Parameters>(parameters)};
}

// With bending and twisting, where spheres turn.
inline bool bends(const BondLaw &law) {
  return std::visit([](const auto &l) { return l.bends(); }, law);
}
// Bonds that make no sense between spheres that do not turn.
inline bool needs_rotation(const BondLaw &law) {
  return std::visit([](const auto &l) { return l.needs_rotation; }, law);
}
// From centre to centre: length is the distance of the centres, and they act on each other at its middle.
// Otherwise length is the sum of the radii, and they act where it is divided as the radii are.
inline bool centre_to_centre(const BondLaw &law) {
  return std::visit([](const auto &l) { return l.centre_to_centre; }, law);
}

} // namespace platen::dem
