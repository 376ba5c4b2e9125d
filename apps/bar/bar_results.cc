#include "apps/bar/bar_results.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "apps/run/history.h"
#include "apps/run/problem_setup.h"

namespace platen::apps {
namespace {

// Sections as lengths: the radius of a round bar, the widths of a rectangular one.
void add_section(Json &s, const std::string &name, const CrossSection &section) {
  if (section.round) {
    s[name + "_radius_m"] = section.radius;
  } else {
    s[name + "_width_x_m"] = section.width_x;
    s[name + "_width_y_m"] = section.width_y;
  }
}

std::string percent(const Json &summary, const char *key) {
  const double part = number_in(summary, key);
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

void BarResults::add(BarLoad load, const StaticTest &t) {
  const bool turns = load == BarLoad::torsion;
  Json &s = loads[word_of(bar_loads, load)];
  s[turns ? "torque_n_m" : "force_n"] = t.load;
  s[turns ? "static_twist_rad" : "static_displacement_m"] = t.measured;
  s["static_by_hand"] = rod(false).response(load, t.load);
  s["static_error"] = t.measured / rod(false).response(load, t.load) - 1;
  s["static_error_effective"] = t.measured / rod(true).response(load, t.load) - 1;
  s["energy_j"] = t.energy.total();
  s["axial_energy_share"] = t.energy.axial / t.energy.total();
  s["bending_energy_share"] = t.energy.bending / t.energy.total();
  s["torsion_energy_share"] = t.energy.torsion / t.energy.total();
  s["static_iterations"] = t.state.iterations;
}

void BarResults::add(BarLoad load, const Oscillation &oscillation) {
  if (oscillation.stopped) return;
  const double f = oscillation.frequency, by_hand = oscillating_rod(false).frequency(load);
  Json &s = loads[word_of(bar_loads, load)];
  s["energy_residual_relative"] = oscillation.energy_residual.value();
  s["frequency_hz"] = f;
  s["period_s"] = 1 / f;
  s["frequency_by_hand_hz"] = by_hand;
  s["dynamic_error"] = f / by_hand - 1;
  s["dynamic_error_effective"] = f / oscillating_rod(true).frequency(load) - 1;
}

void BarResults::add(const Impact &impact, double struck_velocity) {
  if (impact.stopped) return;
  const double by_hand = oscillating_rod(false).wave_speed();
  Json &s = loads["impact"];
  s["energy_residual_relative"] = impact.energy_residual.value();
  s["time_step_s"] = time.impact_step;
  s["struck_velocity_m_s"] = struck_velocity;
  s["arrival_quarter_s"] = impact.quarter_time;
  s["arrival_half_s"] = impact.half_time;
  s["arrival_far_end_s"] = impact.far_time;
  s["wave_speed_by_hand_m_s"] = by_hand;
  s["wave_speed_m_s"] = impact.speed_end_to_end;
  s["wave_error"] = impact.speed_end_to_end / by_hand - 1;
  s["wave_speed_quarter_to_half_m_s"] = impact.speed_quarter_to_half;
}

std::vector<std::string> bar_columns() {
  std::vector<std::string> names = history_names(nullptr);
  for (const char *own :
       {"load", "end_x_m", "end_y_m", "end_z_m", "end_twist_rad", "end_velocity_m_s", "far_end_velocity_m_s",
        "quarter_z_m", "half_z_m", "axial_energy_j", "bending_energy_j", "torsion_energy_j"})
    names.emplace_back(own);
  return names;
}

std::vector<CsvCell> bar_row(const BarSample &s, BarLoad load, const BarResults &results, bool ledger) {
  const auto energy = [ledger](double of) { return ledger ? of : not_given; };
  const std::map<std::string, CsvCell> measured{
      {"time_s", s.time},
      {"intact_bonds", static_cast<long>(results.bonds) - s.broken_tension - s.broken_shear},
      {"broken_tension", s.broken_tension},
      {"broken_shear", s.broken_shear},
      {"kinetic_energy_j", energy(s.kinetic)},
      {"bond_energy_j", energy(s.energy.total())},
      {"energy_residual_j", energy(s.residual)},
      {"time_step_s", results.time.of(load)},
      {"plastic_work_j", 0},
      {"load", word_of(bar_loads, load)},
      {"end_x_m", s.end.moved.x},
      {"end_y_m", s.end.moved.y},
      {"end_z_m", s.end.moved.z},
      {"end_twist_rad", s.end.twist},
      {"end_velocity_m_s", s.struck_velocity},
      {"far_end_velocity_m_s", s.far_velocity},
      {"quarter_z_m", s.quarter},
      {"half_z_m", s.half},
      {"axial_energy_j", energy(s.energy.axial)},
      {"bending_energy_j", energy(s.energy.bending)},
      {"torsion_energy_j", energy(s.energy.torsion)}};
  std::vector<CsvCell> cells;
  for (const std::string &name : bar_columns()) { // what platens measure has no value
    const auto found = measured.find(name);
    cells.push_back(found == measured.end() ? CsvCell(not_given) : found->second);
  }
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
  s.update(r.loads);
  return s;
}

std::string report_of(const BarResults &r) {
  const CrossSection &b = r.bar.bounding, &e = r.bar.effective;
  std::string text = fmt::format(
      "  modulus {:.4g} GPa on the bounding section ({:.4g} cm2), {:.4g} GPa on the effective one "
      "({:.4g} cm2); Poisson ratio {:.4f}\n",
      1e-9 * r.pulled.axial_rigidity / b.area(), 1e4 * b.area(), 1e-9 * r.pulled.axial_rigidity / e.area(),
      1e4 * e.area(), r.pulled.poisson_ratio);
  if (std::isfinite(r.bulk.youngs))
    text += fmt::format("  bulk: modulus {:.4g} GPa, Poisson ratio {:.4f}\n", 1e-9 * r.bulk.youngs,
                        r.bulk.poisson);
  const char *row = "  {:<10}{:>14}{:>12}{:>14}{:>12}\n";
  bool head = false;
  for (const auto &[word, s] : r.loads.items()) {
    if (word == "impact") {
      text += fmt::format("  wave {:.1f} m/s, by hand {:.1f} m/s: {}; from a quarter to half {:.1f} m/s\n",
                          number_in(s, "wave_speed_m_s"), number_in(s, "wave_speed_by_hand_m_s"),
                          percent(s, "wave_error"), number_in(s, "wave_speed_quarter_to_half_m_s"));
      continue;
    }
    if (!head) text += fmt::format(row, "measured", "static", "effective", "dynamic", "effective");
    head = true;
    text += fmt::format(row, word, percent(s, "static_error"), percent(s, "static_error_effective"),
                        percent(s, "dynamic_error"), percent(s, "dynamic_error_effective"));
  }
  return text;
}

} // namespace platen::apps
