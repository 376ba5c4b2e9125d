#include "apps/bar/summary.h"

#include <fmt/format.h>

#include <limits>

#include "apps/io/machine.h"
#include "apps/run/problem_setup.h"
#include "apps/scene/version.h"

namespace platen::apps {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

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
  if (!l.swing || l.swing->stopped) return;
  const Rod nominal = r.swinging_rod(false), effective = r.swinging_rod(true);
  const double f = l.swing->frequency;
  s["energy_residual_relative"] = l.swing->energy_residual;
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

Json impact_part(const BarResults &r) {
  const double by_hand = r.swinging_rod(false).wave_speed();
  Json s;
  s["energy_residual_relative"] = r.impact->energy_residual;
  s["time_step_s"] = r.time.blow_step;
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

std::vector<std::string> effects_of(const Scene &scene) {
  std::vector<std::string> words; // a bar meets no platens
  for (const std::string &word : effects_on(scene))
    if (word.find("platen") == std::string::npos && word != "glued ends" && word != "seats" &&
        word != "fields" && word != "crack log")
      words.push_back(word);
  return words;
}

std::string percent(double part) {
  return std::isfinite(part) ? fmt::format("{:+.2f} %", 100 * part) : "-";
}

} // namespace

Json summary_of(const Scene &scene, const BarResults &r, const BarCosts &costs, const std::string &status) {
  Json s;
  s["status"] = status;
  s["app"] = "platen-bar";
  s["scene"] = scene.general.title.empty() ? scene.name : scene.general.title;
  s["version"] = version_line();
  s["effects"] = effects_of(scene);
  s["particles"] = r.particles;
  s["bonds"] = r.bonds;
  s["coordination_number"] = 2.0 * static_cast<double>(r.bonds) / static_cast<double>(r.particles);
  s["packing_fraction"] = r.packing_fraction;
  s["steps"] = r.steps;
  s["time_step_s"] = r.time.step;
  s["time_step_reason"] = r.time.reason;
  s["threads"] = costs.threads;
  s["wall_seconds"] = costs.seconds;
  s["setup_seconds"] = costs.setup_seconds;
  s["particle_steps_per_second"] =
      static_cast<double>(r.particles) * static_cast<double>(r.steps) / costs.seconds;
  for (std::size_t k = 0; k < r.stage_seconds.size(); ++k)
    s["stage_seconds"][dem::stage_names[k]] = r.stage_seconds[k];
  s["peak_memory_bytes"] = peak_memory_bytes();
  for (const char *unmeasured : {"strength_pa", "strain_at_peak_platen", "strain_at_peak_gauge"})
    s[unmeasured] = none;
  s["youngs_modulus_gauge_pa"] = r.pulled.axial_rigidity / r.bar.bounding.area();
  s["youngs_modulus_platen_pa"] = none;
  s["poisson_ratio"] = r.pulled.poisson_ratio;
  s["broken_tension"] = r.broken_tension;
  s["broken_shear"] = r.broken_shear;
  s["energy_residual_relative"] = r.steps > 0 ? r.energy_residual : none;
  for (const char *unmeasured :
       {"kinetic_to_internal_max", "end_damage_top", "end_damage_bottom", "middle_damage", "end_spread",
        "barrel_at_peak", "fragments", "cone_top", "cone_bottom"})
    s[unmeasured] = none;
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
  if (scene.bar_test.bulk_moduli) {
    s["bulk"]["youngs_modulus_pa"] = r.bulk.youngs;
    s["bulk"]["poisson_ratio"] = r.bulk.poisson;
    s["bulk"]["anisotropy"] = r.bulk.anisotropy;
  }
  for (const LoadResult &l : r.loads) {
    Json part = l.keeps_static ? static_part(r, l) : Json::object();
    add_dynamic(part, r, l);
    s[word(l.load)] = part;
  }
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
    Json s = l.keeps_static ? static_part(r, l) : Json::object();
    add_dynamic(s, r, l);
    const auto figure = [&](const char *key) {
      return percent(s.contains(key) ? s[key].get<double>() : none);
    };
    text += fmt::format("  {:<10}{:>14}{:>12}{:>14}{:>12}\n", word(l.load), figure("static_error"),
                        figure("static_error_effective"), figure("dynamic_error"),
                        figure("dynamic_error_effective"));
  }
  if (r.impact && !r.impact->stopped) {
    const Json s = impact_part(r);
    text +=
        fmt::format("  wave {:.1f} m/s, by hand {:.1f} m/s: {}; from a quarter to half {:.1f} m/s: {}\n",
                    s["wave_speed_m_s"].get<double>(), s["wave_speed_by_hand_m_s"].get<double>(),
                    percent(s["wave_error"].get<double>()), s["wave_speed_quarter_to_half_m_s"].get<double>(),
                    percent(s["wave_error_quarter_to_half"].get<double>()));
  }
  return text;
}

} // namespace platen::apps
