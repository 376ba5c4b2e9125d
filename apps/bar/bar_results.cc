#include "apps/bar/bar_results.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/bar/bar_section.h"
#include "apps/output/numbers.h"
#include "apps/run/history.h"
#include "apps/run/problem_setup.h"

namespace platen::apps {
namespace {

// A bar knows no platens: their columns are not measured.
Sample common(const BarSample &s, std::size_t bonds, double step, bool ledger) {
  Sample c;
  c.time = s.time;
  for (double *unmeasured :
       {&c.strain_platen, &c.strain_gauge, &c.lateral_strain, &c.volumetric_strain, &c.lateral_extremal,
        &c.axial_extremal, &c.stress_top, &c.stress_bottom, &c.confining_pressure, &c.contact, &c.body,
        &c.damping, &c.friction, &c.fracture, &c.boundary, &c.unbalanced, &c.platen_speed})
    *unmeasured = not_given;
  c.intact_bonds = static_cast<double>(bonds) - static_cast<double>(s.broken_tension + s.broken_shear);
  c.broken_tension = static_cast<double>(s.broken_tension);
  c.broken_shear = static_cast<double>(s.broken_shear);
  c.kinetic = ledger ? s.kinetic : not_given;
  c.bond = ledger ? s.energy.total() : not_given;
  c.residual = ledger ? s.kinetic + s.energy.total() - s.initial_energy : not_given;
  c.time_step = step;
  return c;
}

// Sections as lengths: the radius of a round bar, the widths of a rectangular one.
void add_section(Json &s, const std::string &name, const Section &section) {
  if (section.round) {
    s[name + "_radius_m"] = section.radius;
  } else {
    s[name + "_width_x_m"] = section.width_x;
    s[name + "_width_y_m"] = section.width_y;
  }
}

Json static_part(const BarResults &r, const LoadResult &l) {
  const StaticTest &t = l.at_rest;
  const bool turns = l.load == BarLoad::torsion;
  const Rod nominal = r.rod(false), effective = r.rod(true);
  Json s;
  s[turns ? "torque_n_m" : "force_n"] = t.load;
  s[turns ? "static_twist_rad" : "static_displacement_m"] = t.measured;
  s["static_by_hand"] = response_of(nominal, l.load, t.load);
  s["static_by_hand_effective"] = response_of(effective, l.load, t.load);
  s["static_error"] = t.measured / response_of(nominal, l.load, t.load) - 1;
  s["static_error_effective"] = t.measured / response_of(effective, l.load, t.load) - 1;
  if (l.load == BarLoad::bending) {
    s["static_error_without_shear"] = t.measured / nominal.deflection(t.load) - 1;
    s["static_error_effective_without_shear"] = t.measured / effective.deflection(t.load) - 1;
    s["shear_share_by_hand"] = 1 - effective.deflection(t.load) / effective.deflection_with_shear(t.load);
  }
  if (l.load == BarLoad::tension) {
    Rod bulk = effective; // nothing measured on the bar as a whole
    bulk.axial_rigidity = r.bulk.youngs * effective.section.area();
    s["static_error_bulk_modulus"] = t.measured / bulk.stretch(t.load) - 1;
  }
  s["energy_j"] = t.energy.total();
  s["axial_energy_share"] = t.energy.axial / t.energy.total();
  s["bending_energy_share"] = t.energy.bending / t.energy.total();
  s["torsion_energy_share"] = t.energy.torsion / t.energy.total();
  s["static_iterations"] = t.state.iterations;
  return s;
}

void add_dynamic(Json &s, const BarResults &r, const LoadResult &l) {
  if (!l.oscillation || l.oscillation->stopped) return;
  const Rod nominal = r.oscillating_rod(false), effective = r.oscillating_rod(true);
  const double f = l.oscillation->frequency;
  s["energy_residual_relative"] = l.oscillation->energy_residual.value();
  s["frequency_hz"] = f;
  s["period_s"] = 1 / f;
  s["frequency_by_hand_hz"] = frequency_of(nominal, l.load);
  s["frequency_by_hand_effective_hz"] = frequency_of(effective, l.load);
  s["dynamic_error"] = f / frequency_of(nominal, l.load) - 1;
  s["dynamic_error_effective"] = f / frequency_of(effective, l.load) - 1;
  if (l.load == BarLoad::bending) {
    s["dynamic_error_without_shear"] = f / nominal.bending_frequency() - 1;
    s["dynamic_error_effective_without_shear"] = f / effective.bending_frequency() - 1;
  }
}

Json part_of(const BarResults &r, const LoadResult &l) {
  Json s = l.keeps_static ? static_part(r, l) : Json::object();
  add_dynamic(s, r, l);
  return s;
}

Json impact_part(const BarResults &r) {
  const double by_hand = r.oscillating_rod(false).wave_speed();
  Json s;
  s["energy_residual_relative"] = r.impact->energy_residual.value();
  s["time_step_s"] = r.time.impact_step;
  s["struck_velocity_m_s"] = r.struck_velocity;
  s["arrival_quarter_s"] = r.impact->quarter_time;
  s["arrival_half_s"] = r.impact->half_time;
  s["arrival_far_end_s"] = r.impact->far_time;
  s["wave_speed_by_hand_m_s"] = by_hand;
  s["wave_speed_m_s"] = r.impact->speed_end_to_end;
  s["wave_error"] = r.impact->speed_end_to_end / by_hand - 1;
  s["wave_speed_quarter_to_half_m_s"] = r.impact->speed_quarter_to_half;
  s["wave_error_quarter_to_half"] = r.impact->speed_quarter_to_half / by_hand - 1;
  return s;
}

std::string percent(double part) {
  return std::isfinite(part) ? fmt::format("{:+.2f} %", 100 * part) : "-";
}

} // namespace

Rod BarResults::rod(bool effective) const {
  Rod rod =
      rod_at_rest(bar, pulled.axial_rigidity, pulled.poisson_ratio, effective ? bar.effective : bar.bounding);
  if (!effective) rod.mass_section = bar.bounding;
  return rod;
}

Rod BarResults::oscillating_rod(bool effective) const {
  Rod oscillating = rod(effective);
  oscillating.length = bar.top - bar.low.z;
  return oscillating;
}

std::vector<std::string> bar_columns() {
  std::vector<std::string> names = history_names(nullptr);
  for (const std::string &own :
       cells_of("load,end_x_m,end_y_m,end_z_m,end_twist_rad,end_velocity_m_s,far_end_velocity_m_s,"
                "quarter_z_m,half_z_m,axial_energy_j,bending_energy_j,torsion_energy_j"))
    names.push_back(own);
  return names;
}

std::vector<CsvCell> bar_row(const BarSample &s, BarLoad load, const BarResults &results, bool ledger) {
  std::vector<CsvCell> cells = history_row(common(s, results.bonds, results.time.of(load), ledger), nullptr);
  cells[cells.size() - 2] = not_given; // grain contacts, not counted
  cells.insert(cells.end(), {word_of(bar_loads, load), s.end.moved.x, s.end.moved.y, s.end.moved.z,
                             s.end.twist, s.struck_velocity, s.far_velocity, s.quarter, s.half});
  cells.insert(cells.end(), {ledger ? s.energy.axial : not_given, ledger ? s.energy.bending : not_given,
                             ledger ? s.energy.torsion : not_given});
  return cells;
}

Json summary_of(const Scene &scene, const BarResults &r, const std::string &status) {
  Json s = summary_head(scene, "platen-bar", status, effects_on(scene));
  add_figures(s, r);
  s["mean_radius_m"] = r.bar.mean_radius;
  s["length_m"] = r.bar.length();
  s["loose_spheres"] = r.bar.loose;
  s["clamped_spheres"] = r.bar.low.rows.size();
  s["loaded_spheres"] = r.bar.high.rows.size();
  add_section(s, "bounding", r.bar.bounding);
  add_section(s, "effective", r.bar.effective);
  add_section(s, "mass", r.bar.mass);
  s["mass_per_length_kg_m"] = r.bar.mass_per_length;
  s["density_kg_m3"] = r.bar.mass_per_length / r.bar.bounding.area();
  s["axial_rigidity_n"] = r.pulled.axial_rigidity;
  s["youngs_modulus_effective_pa"] = r.pulled.axial_rigidity / r.bar.effective.area();
  if (bar_test_of(scene).bulk_moduli) {
    s["bulk"]["youngs_modulus_pa"] = r.bulk.youngs;
    s["bulk"]["poisson_ratio"] = r.bulk.poisson;
    s["bulk"]["anisotropy"] = r.bulk.anisotropy;
  }
  for (const LoadResult &l : r.loads)
    s[word_of(bar_loads, l.load)] = part_of(r, l);
  if (r.impact && !r.impact->stopped) s["impact"] = impact_part(r);
  return s;
}

std::string report_of(const BarResults &r) {
  const Section &b = r.bar.bounding, &e = r.bar.effective;
  std::string text = fmt::format(
      "  modulus {:.4g} GPa on the bounding section ({:.4g} cm2), {:.4g} GPa on the effective one "
      "({:.4g} cm2); Poisson ratio {:.4f}\n",
      1e-9 * r.pulled.axial_rigidity / b.area(), 1e4 * b.area(), 1e-9 * r.pulled.axial_rigidity / e.area(),
      1e4 * e.area(), r.pulled.poisson_ratio);
  if (std::isfinite(r.bulk.youngs))
    text += fmt::format("  bulk: modulus {:.4g} GPa, Poisson ratio {:.4f}\n", 1e-9 * r.bulk.youngs,
                        r.bulk.poisson);
  if (!r.loads.empty())
    text += fmt::format("  {:<10}{:>14}{:>12}{:>14}{:>12}\n", "measured", "static", "effective", "dynamic",
                        "effective");
  for (const LoadResult &l : r.loads) {
    const Json s = part_of(r, l);
    const auto figure = [&s](const char *key) { return percent(number_in(s, key)); };
    text += fmt::format("  {:<10}{:>14}{:>12}{:>14}{:>12}\n", word_of(bar_loads, l.load),
                        figure("static_error"), figure("static_error_effective"), figure("dynamic_error"),
                        figure("dynamic_error_effective"));
  }
  if (r.impact && !r.impact->stopped) {
    const Json s = impact_part(r);
    const auto figure = [&s](const char *key) { return number_in(s, key); };
    text +=
        fmt::format("  wave {:.1f} m/s, by hand {:.1f} m/s: {}; from a quarter to half {:.1f} m/s: {}\n",
                    figure("wave_speed_m_s"), figure("wave_speed_by_hand_m_s"), percent(figure("wave_error")),
                    figure("wave_speed_quarter_to_half_m_s"), percent(figure("wave_error_quarter_to_half")));
  }
  return text;
}

} // namespace platen::apps
