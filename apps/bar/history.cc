#include "apps/bar/history.h"

#include <limits>

#include "apps/run/history.h"

namespace platen::apps {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// A bar knows no platens: their columns are not measured.
Sample common(const BarSample &s, std::size_t bonds, double step, bool ledger) {
  Sample c;
  c.time = s.time;
  for (double *unmeasured :
       {&c.strain_platen, &c.strain_gauge, &c.lateral_strain, &c.volumetric_strain, &c.lateral_extremal,
        &c.axial_extremal, &c.stress_top, &c.stress_bottom, &c.confining_pressure, &c.contact, &c.body,
        &c.damping, &c.friction, &c.fracture, &c.boundary, &c.unbalanced, &c.platen_speed})
    *unmeasured = none;
  c.intact_bonds = static_cast<double>(bonds) - static_cast<double>(s.broken_tension + s.broken_shear);
  c.broken_tension = static_cast<double>(s.broken_tension);
  c.broken_shear = static_cast<double>(s.broken_shear);
  c.kinetic = ledger ? s.kinetic : none;
  c.bond = ledger ? s.energy.total() : none;
  c.residual = ledger ? s.kinetic + s.energy.total() - s.initial_energy : none;
  c.time_step = step;
  return c;
}

} // namespace

std::vector<std::string> bar_columns() {
  std::vector<std::string> names = history_names(nullptr);
  for (const char *own :
       {"load", "end_x_m", "end_y_m", "end_z_m", "end_twist_rad", "end_velocity_m_s", "far_end_velocity_m_s",
        "quarter_z_m", "half_z_m", "axial_energy_j", "bending_energy_j", "torsion_energy_j"})
    names.emplace_back(own);
  return names;
}

std::vector<CsvCell> bar_row(const BarSample &s, BarLoad load, const BarResults &results, bool ledger) {
  std::vector<CsvCell> cells = history_row(common(s, results.bonds, results.time.of(load), ledger), nullptr);
  cells[cells.size() - 2] = none; // grain contacts, not counted
  for (const CsvCell &own : std::initializer_list<CsvCell>{
           word(load), s.end.moved.x, s.end.moved.y, s.end.moved.z, s.end.twist, s.struck_velocity,
           s.far_velocity, s.quarter, s.half, ledger ? s.energy.axial : none,
           ledger ? s.energy.bending : none, ledger ? s.energy.torsion : none})
    cells.push_back(own);
  return cells;
}

} // namespace platen::apps
