#include "apps/run/model_setup.h"

#include <cmath>
#include <limits>

#include "apps/io/id_list.h"

namespace platen::apps {
namespace {

constexpr double standard_gravity = 9.80665; // m/s^2

// In a scene 0 stands for a strength that is never reached.
double strength(double value) {
  return value > 0 ? value : std::numeric_limits<double>::infinity();
}

dem::RadiusRule radius_rule(RadiusRule rule) {
  switch (rule) {
    case RadiusRule::mean:
      return dem::RadiusRule::mean;
    case RadiusRule::harmonic:
      return dem::RadiusRule::harmonic;
    case RadiusRule::given:
      return dem::RadiusRule::given;
    case RadiusRule::minimum:
      break;
  }
  return dem::RadiusRule::minimum;
}

dem::BondLayout bond_layout(const Bond &from) {
  dem::BondLayout to;
  to.modulus = from.modulus;
  to.radius_multiplier = from.radius_multiplier;
  to.area_factor = from.area_factor;
  to.radius_rule = radius_rule(from.radius_rule);
  if (from.radius_rule == RadiusRule::given) to.given_radius = from.radius;
  to.gap = from.gap.value;
  to.gap_is_relative = from.gap.relative;
  return to;
}

template <class Parameters>
Parameters with_strengths(Parameters to, const Bond &from) {
  to.tensile_strength = strength(from.tensile_strength);
  to.shear_strength = strength(from.shear_strength);
  to.friction_coefficient = std::tan(from.friction_angle);
  to.moment_contribution = from.moment_contribution;
  return to;
}

dem::ElastoDamagePlastic::Parameters interface_parameters(const Bond &from) {
  dem::ElastoDamagePlastic::Parameters to;
  to.poisson_ratio = from.poisson_ratio;
  to.tensile_strength = strength(from.tensile_strength);
  to.shear_strength = strength(from.shear_strength);
  to.friction_static = from.friction_static;
  to.friction_dynamic = from.friction_dynamic;
  to.softening_tension = from.softening_tension;
  to.softening_shear = from.softening_shear;
  to.fracture_energy_tension = from.fracture_energy_tension;
  to.fracture_energy_shear = from.fracture_energy_shear;
  // Branches that are not given go on as the last one does.
  dem::ElastoDamagePlastic::Branch last;
  for (std::size_t b = 0; b < 3; ++b) {
    if (b < from.compression_limits.size()) last = {from.compression_limits[b], from.compression_slopes[b]};
    to.branches[b] = last;
  }
  to.line =
      from.failure_line == FailureLine::coupled ? dem::FailureLine::coupled : dem::FailureLine::uncoupled;
  return to;
}

dem::BondParameters bond_parameters(const Bond &from, const Effects &effects) {
  if (effects.bond == BondKind::cohesive_beam) {
    dem::CohesiveBeam::Parameters beam;
    beam.poisson_ratio = from.poisson_ratio;
    return with_strengths(beam, from);
  }
  if (effects.bond == BondKind::elasto_damage_plastic) return interface_parameters(from);
  dem::ParallelBond::Parameters bond;
  bond.stiffness_ratio = from.stiffness_ratio;
  bond.moments = effects.bond_moments;
  return with_strengths(bond, from);
}

dem::ContactSettings contact_settings(const Scene &scene) {
  const Contact &from = scene.contact;
  const TangentialKind tangential = scene.effects.tangential;
  dem::ContactSettings to;
  to.normal =
      scene.effects.contact == ContactKind::hertz ? dem::NormalContact::hertz : dem::NormalContact::linear;
  to.tangential = dem::TangentialContact::none;
  if (tangential == TangentialKind::coulomb) to.tangential = dem::TangentialContact::coulomb;
  if (tangential == TangentialKind::coulomb_with_rolling_resistance)
    to.tangential = dem::TangentialContact::coulomb_with_rolling;
  to.stiffness_rule = from.stiffness.kind == Stiffness::Kind::absolute  ? dem::StiffnessRule::absolute
                      : from.stiffness.kind == Stiffness::Kind::of_bulk ? dem::StiffnessRule::bulk_fraction
                                                                        : dem::StiffnessRule::bond_multiple;
  to.stiffness = from.stiffness.value;
  to.tangential_ratio = from.tangential_ratio;
  to.friction = from.friction;
  to.rolling_friction = from.rolling_friction;
  to.damping = from.damping;
  to.restitution = from.restitution;
  to.young_modulus = scene.material.young_modulus;
  to.poisson_ratio = scene.material.poisson_ratio;
  return to;
}

dem::Phases phases(const PhasesSection &from) {
  dem::Phases to;
  if (from.by == PhasesBy::radius) to.radius_above = from.radius_above;
  if (from.by == PhasesBy::file) to.aggregate_ids = read_id_list(from.file);
  to.aggregate = {from.aggregate_modulus, from.aggregate_strength};
  to.interface = {from.interface_modulus, from.interface_strength};
  return to;
}

} // namespace

dem::DensityOf density_of(const Scene &scene) {
  return scene.material.density_of == DensityOf::solid ? dem::DensityOf::solid : dem::DensityOf::grains;
}

dem::ModelSettings model_settings(const Scene &scene) {
  dem::ModelSettings to;
  to.rotation = scene.effects.rotation;
  to.density = scene.material.density;
  to.density_of = density_of(scene);
  to.mass_scaling = scene.integration.mass_scaling;
  if (scene.effects.gravity) to.gravity = {0, 0, -standard_gravity};
  to.local_damping = scene.integration.damping;
  to.damping_form = scene.integration.damping_form == DampingForm::vector ? dem::DampingForm::vector
                                                                          : dem::DampingForm::component;
  if (scene.integration.scheme == Scheme::tchamwa_wielgosz) to.dissipation = scene.integration.dissipation;
  to.bond_dashpot = scene.bond.damping;
  to.bond_layout = bond_layout(scene.bond);
  if (scene.effects.bond == BondKind::elasto_damage_plastic)
    to.bond_layout.interaction_range = scene.bond.interaction_range;
  to.energy_ledger = scene.effects.energy_ledger;
  to.crack_log = scene.effects.crack_log;
  if (scene.phases.by != PhasesBy::none) to.phases = phases(scene.phases);
  if (scene.effects.bond != BondKind::none && scene.bond.strength_scatter == StrengthScatter::weibull)
    to.strength_scatter = dem::StrengthScatter{scene.bond.weibull_modulus, scene.general.seed};
  if (scene.effects.bond != BondKind::none) to.bond = bond_parameters(scene.bond, scene.effects);
  if (scene.effects.contact != ContactKind::none) to.contact = contact_settings(scene);
  to.instruction_set = scene.integration.instruction_set == InstructionSet::baseline
                           ? dem::InstructionSet::baseline
                           : dem::best_instruction_set();
  return to;
}

} // namespace platen::apps
