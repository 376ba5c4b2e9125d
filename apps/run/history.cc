#include "apps/run/history.h"

#include <stdexcept>

namespace platen::apps {

std::vector<std::string> history_columns(const ExtraColumns &extra) {
  std::vector<std::string> columns{"time_s",
                                   "axial_strain_platen",
                                   "axial_strain_gauge",
                                   "lateral_strain",
                                   "volumetric_strain",
                                   "axial_stress_top_pa",
                                   "axial_stress_bottom_pa",
                                   "confining_pressure_pa",
                                   "intact_bonds",
                                   "broken_tension",
                                   "broken_shear",
                                   "kinetic_energy_j",
                                   "bond_energy_j",
                                   "contact_energy_j",
                                   "body_energy_j",
                                   "damping_work_j",
                                   "friction_work_j",
                                   "fracture_work_j",
                                   "boundary_work_j",
                                   "energy_residual_j",
                                   "unbalanced_force_ratio",
                                   "lateral_strain_extremal",
                                   "axial_strain_extremal",
                                   "platen_speed_m_s",
                                   "time_step_s",
                                   "grain_contacts",
                                   "plastic_work_j"};
  if (extra.confined) columns.emplace_back("deviator_pa");
  if (extra.sleeved) columns.insert(columns.end(), {"volumetric_strain_sleeve", "sleeve_deviator_pa"});
  if (extra.disc) columns.emplace_back("opening_m");
  if (extra.bent) columns.insert(columns.end(), {"deflection_m", "midspan_moment_n_m"});
  return columns;
}

std::vector<CsvCell> history_row(const Sample &s, const ExtraColumns &extra) {
  const auto count = [](double n) { return CsvCell(static_cast<long long>(n)); };
  std::vector<CsvCell> row{s.time,
                           s.strain_platen,
                           s.strain_gauge,
                           s.lateral_strain,
                           s.volumetric_strain,
                           s.stress_top,
                           s.stress_bottom,
                           s.confining_pressure,
                           count(s.intact_bonds),
                           count(s.broken_tension),
                           count(s.broken_shear),
                           s.kinetic,
                           s.bond,
                           s.contact,
                           s.body,
                           s.damping,
                           s.friction,
                           s.fracture,
                           s.boundary,
                           s.residual,
                           s.unbalanced,
                           s.lateral_extremal,
                           s.axial_extremal,
                           s.platen_speed,
                           s.time_step,
                           count(s.touching),
                           s.plastic};
  if (extra.confined) row.emplace_back(s.deviator());
  if (extra.sleeved) row.insert(row.end(), {s.sleeve_volumetric_strain, s.sleeve_deviator});
  if (extra.disc) row.emplace_back(s.opening);
  if (extra.bent) row.insert(row.end(), {s.deflection, s.midspan_moment});
  return row;
}

Sampler::Sampler(const coupling::Problem &problem)
    : gauge_(problem.model.particles, problem.shape(), problem.model.bonds.get()),
      pairs_(problem.model.particles, problem.shape(), problem.model.bonds.get()) {
  if (problem.shape().kind == dem::ShapeKind::disc)
    opening_.emplace(problem.model.particles, problem.shape());
  if (!problem.bent()) return;
  try {
    deflection_.emplace(problem.model.particles, problem.shape(), problem.three_points().span);
  } catch (const std::invalid_argument &e) {
    throw coupling::BadSetup("Specimen/Sphere radius",
                             std::string("is too large for a deflection: ") + e.what() + ".");
  }
}

Sample Sampler::operator()(const coupling::Problem &problem) const {
  const dem::Model &model = problem.model;
  const dem::GaugeStrain gauge = gauge_.strain(model.particles);
  const dem::EnergyLedger energy = problem.energy();
  Sample s;
  s.time = problem.time();
  s.strain_platen = problem.closure_strain();
  s.strain_gauge = -gauge.axial;
  s.lateral_strain = -gauge.lateral();
  s.volumetric_strain = -(gauge.axial + gauge.lateral_x + gauge.lateral_y);
  s.lateral_extremal = -pairs_.lateral(model.particles);
  s.axial_extremal = -pairs_.axial(model.particles);
  s.stress_top = problem.stress_top();
  s.stress_bottom = problem.stress_bottom();
  s.confining_pressure = problem.confining_pressure();
  if (problem.cell()) s.cell_pressure = s.confining_pressure;
  if (problem.sleeve() != nullptr) {
    s.sleeve_volumetric_strain = problem.sleeve_volumetric_strain();
    s.sleeve_deviator = problem.sleeve_deviator();
  }
  s.intact_bonds = static_cast<double>(model.intact_bonds());
  s.broken_tension = static_cast<double>(model.broken(dem::BondState::broken_in_tension));
  s.broken_shear = static_cast<double>(model.broken(dem::BondState::broken_in_shear));
  s.kinetic = energy.kinetic;
  s.bond = energy.bonds;
  s.contact = energy.contacts;
  s.body = energy.bodies;
  s.damping = energy.damping;
  s.friction = energy.friction;
  s.fracture = energy.fracture;
  s.plastic = energy.plastic;
  s.boundary = energy.boundary;
  s.residual = energy.residual();
  s.unbalanced = problem.unbalanced_ratio();
  s.platen_speed = problem.platen_speed();
  s.time_step = problem.time_step();
  if (opening_) s.opening = (*opening_)(model.particles);
  if (deflection_) {
    s.deflection = (*deflection_)(model.particles);
    s.midspan_moment = problem.midspan_moment();
  }
  s.cycling = problem.cycling() ? 1.0 : 0.0;
  s.axial_stage = problem.axial_stage() ? 1.0 : 0.0;
  s.touching = model.contacts ? static_cast<double>(model.contacts->touching_count()) : 0.0;
  return s;
}

} // namespace platen::apps
