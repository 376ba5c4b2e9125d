// Sections of a scene that say what is tested. NaN means "not given" where a member says so.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "apps/scene/quantities.h"

namespace platen::apps {

enum class SpecimenShape { cylinder, box, bar, disc };
enum class RadiusDistribution { equal, two_sizes, uniform };
enum class PackingKind { advancing_front, random_close, file };
enum class EndsKind { as_packed, ground };

struct SpecimenSection {
  SpecimenShape shape = SpecimenShape::cylinder;
  double radius = not_given;                       // m; cylinder, round bar
  double height = not_given;                       // m, along z
  double width_x = not_given, width_y = not_given; // m; box, rectangular bar
  double sphere_radius = not_given;                // m, mean
  double radius_spread = 0;                        // kappa = (largest - smallest radius) / mean
  RadiusDistribution radius_distribution = RadiusDistribution::uniform;
  double second_radius_ratio = 0.5; // two sizes: second radius over the first
  double second_fraction = 0.5;     // two sizes: share of the number of spheres that has the second radius
  PackingKind packing = PackingKind::advancing_front;
  std::string file; // Packing = file; resolved against the folder of the scene
  EndsKind ends = EndsKind::as_packed;
  double end_layer = 1; // mean sphere radii
  bool seat = false;

  bool round() const {
    return !std::isnan(radius);
  } // cross-section: circle of `radius`, else width_x x width_y
};

enum class DensityOf { grains, solid };

struct Material {        // of the grains
  double density = 2400; // kg/m3
  DensityOf density_of = DensityOf::grains;
  double young_modulus = 17e9; // Pa
  double poisson_ratio = 0.15;
};

enum class BondKind { none, parallel_bond, cohesive_beam, elasto_damage_plastic };
enum class ContactKind { none, linear, hertz };
enum class TangentialKind { none, coulomb, coulomb_with_rolling_resistance };

struct Effects {
  BondKind bond = BondKind::parallel_bond;
  ContactKind contact = ContactKind::linear;
  TangentialKind tangential = TangentialKind::coulomb;
  bool rotation = true;
  bool bond_moments = true;
  bool gravity = false;
  bool energy_ledger = true;
  bool crack_log = true;
};

enum class RadiusRule { minimum, mean, harmonic, given };
enum class FailureLine { uncoupled, coupled };
enum class StrengthScatter { none, weibull };

struct Bond {
  double modulus = not_given;     // Pa
  double stiffness_ratio = 0.4;   // parallel bond
  double poisson_ratio = 0.3;     // cohesive beam, elasto damage plastic
  double tensile_strength = 0;    // Pa; 0: never breaks in tension
  double shear_strength = 0;      // Pa; 0: never breaks in shear
  double friction_angle = 0;      // rad
  double moment_contribution = 1; // 0 ... 1
  double radius_multiplier = 1;
  RadiusRule radius_rule = RadiusRule::minimum;
  double radius = not_given; // m; Radius rule = given
  Gap gap;
  double damping = 0; // dashpot, fraction of critical
  // Elasto damage plastic.
  double interaction_range = 0.1;         // of the sum of both radii
  double area_factor = 1;                 // 0: from the packing
  double friction_static = 0;             // while it holds
  double friction_dynamic = 0;            // once it has failed
  double softening_tension = 0.2;         // displacement of softening over that at the strength
  double softening_shear = 1;             // the same
  double fracture_energy_tension = 0;     // J/m2 of the softening branch; 0: by softening_tension
  double fracture_energy_shear = 0;       // J/m2
  std::vector<double> compression_limits; // Pa, LCS1..3
  std::vector<double> compression_slopes; // YRC1..3
  FailureLine failure_line = FailureLine::uncoupled;
  StrengthScatter strength_scatter = StrengthScatter::none;
  double weibull_modulus = not_given; // m; strength_scatter = weibull
};

enum class PhasesBy { none, radius, file };

struct PhasesSection { // aggregates in a matrix
  PhasesBy by = PhasesBy::none;
  double radius_above = not_given;                      // m; by = radius
  std::string file;                                     // by = file; resolved against the folder of the scene
  double aggregate_modulus = 1, aggregate_strength = 1; // of bonds, over those of the matrix
  double interface_modulus = 1, interface_strength = 1;
};

struct Contact {
  double friction = 0.5;
  Stiffness stiffness;           // linear contact
  double tangential_ratio = 0.5; // tangential over normal stiffness, linear contact
  double damping = 0.2;          // fraction of critical, linear contact
  double restitution = 1;        // (0, 1], hertz
  double rolling_friction = 0;   // rolling moment <= rolling_friction R* N
};

} // namespace platen::apps
