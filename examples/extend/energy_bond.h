// A bond law of one's own: elastic as the parallel bond is, and broken once the energy that it stores over
// its section reaches a fracture energy. In tension if it is longer than at rest, otherwise in shear.
#pragma once

#include <stdexcept>

#include <base/pi.h>
#include <dem/laws/outside_law.h>
#include <dem/laws/parallel_bond.h>

struct EnergyBond {
  double stiffness_ratio = 0.4; // k_s / k_n
  double fracture_energy = 10;  // J/m^2

  // Throws std::invalid_argument.
  EnergyBond(double ratio, double energy) : stiffness_ratio(ratio), fracture_energy(energy) {
    if (!(ratio >= 0 && energy > 0))
      throw std::invalid_argument(
          "energy bond: the stiffness ratio is 0 or more, the fracture energy above 0");
  }

  static constexpr bool needs_rotation = true, centre_to_centre = false, over_distance = false,
                        has_history = false, bonds_by_range = false;
  bool bends() const { return true; }

  platen::dem::BondStiffness stiffness(const platen::dem::BondGeometry<double> &g) const { // at rest
    const double square = g.radius * g.radius, axial = platen::pi * square * g.normal_stiffness,
                 shear = stiffness_ratio * axial;
    return {axial, shear, 0.25 * square * axial, 0.5 * square * shear};
  }

  platen::dem::BondResponse<double> operator()(const platen::dem::BondGeometry<double> &g,
                                               const platen::dem::BondMotion<double> &m) const {
    return turning<true>(g, m);
  }
  // Real: double, or several in the loops, whose comparisons are functions (where_positive).
  template <bool moments, class Real>
  PLATEN_INLINE platen::dem::BondResponse<Real> turning(const platen::dem::BondGeometry<Real> &g,
                                                        const platen::dem::BondMotion<Real> &m) const {
    using platen::dem::where_positive;
    const Real square = g.radius * g.radius, area = platen::pi * square, axial = area * g.normal_stiffness;
    platen::dem::BondStrain<Real> strain;
    auto r = platen::dem::stretch_and_shear(g, m, axial, Real(stiffness_ratio * axial), strain);
    platen::dem::bend_and_twist(r, strain, Real(0.25 * square * axial), 2 * stiffness_ratio - 1, m);
    const Real ratio = r.energy / (fracture_energy * g.strength_factor * area), none = 0.0 * ratio;
    r.tension_ratio = where_positive(strain.stretch, ratio, none);
    r.shear_ratio = where_positive(strain.stretch, none, ratio);
    r.excess = ratio * (1 + 1e-12) - 1.0; // may be a hair too large, never too small
    return r;
  }
};

// The parallel bond of the library, from outside: gives the same bits.
struct SameBond : platen::dem::ParallelBond {
  using ParallelBond::ParallelBond;
};

// Made by platen_bond_law() in CMakeLists.txt.
template <>
platen::dem::OutsideLaw::KernelsOfSets platen::dem::outside_kernels<EnergyBond>();
template <>
platen::dem::OutsideLaw::KernelsOfSets platen::dem::outside_kernels<SameBond>();
