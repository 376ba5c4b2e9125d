#include "apps/bonds/bond_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/bonds/pair_section.h"
#include "apps/output/csv_writer.h"
#include "apps/output/numbers.h"
#include "dem/laws/normal_contact.h"

namespace platen::apps {
namespace {

bool slides(const Scene &scene) {
  return pair_test_of(scene).path == PairPath::shear;
}
double load_of(const Scene &scene, const RigReading &row) {
  return turns(scene) ? row.moment : row.force;
}
double displacement_of(const Scene &scene, const RigReading &row) {
  return turns(scene) ? row.rotation : row.displacement;
}

double measured_of(const Scene &scene, const RigReading &row) {
  return is_pyramid(scene) ? row.strain_ratio : displacement_of(scene, row);
}

double by_hand_of(const Scene &scene, const BondRun &run, std::size_t k) {
  if (is_prescribed(scene)) {
    const CohesiveLoad &load = run.cohesive.rows[k].by_hand;
    if (turns(scene)) return load.moment;
    return slides(scene) ? load.shear : load.normal;
  }
  const RigReading &row = run.path.rows[k];
  if (row.intact < static_cast<int>(run.bonds)) return not_given;
  return is_pyramid(scene) ? run.strain_ratio_by_hand : load_of(scene, row) / run.stiffness_by_hand;
}

double relative(double measured, double by_hand) {
  if (std::isnan(measured) || std::isnan(by_hand)) return not_given;
  return by_hand == 0 ? measured : measured / by_hand - 1; // of nothing: the difference itself
}

double difference_of(const Scene &scene, const BondRun &run, std::size_t k) {
  if (is_prescribed(scene)) return run.cohesive.difference(k);
  return relative(measured_of(scene, run.path.rows[k]), by_hand_of(scene, run, k));
}

// Largest difference of a row that carries at least a hundredth of the load.
double largest_difference(const Scene &scene, const BondRun &run) {
  if (is_prescribed(scene)) return run.cohesive.largest_difference();
  double largest = 0;
  const double peak = std::abs(load_of(scene, run.path.largest));
  for (std::size_t k = 0; k < run.path.rows.size(); ++k) {
    const double d = difference_of(scene, run, k);
    if (std::abs(load_of(scene, run.path.rows[k])) >= .01 * peak && std::abs(d) > largest)
      largest = std::abs(d);
  }
  return largest;
}

std::string report_by_closed_form(const Scene &scene, const std::vector<BondRun> &runs) {
  const bool three = is_pyramid(scene);
  std::string text = fmt::format(
      "  {:>10} {:>7} {:>12} {:>14} {:>14} {:>11}\n", "modulus", "ks/kn", turns(scene) ? "moment" : "force",
      three ? "strain ratio" : (turns(scene) ? "rotation" : "displacement"), "by hand", "difference");
  text += fmt::format("  {:>10} {:>7} {:>12} {:>14} {:>14} {:>11}\n", "GPa", "", turns(scene) ? "N m" : "N",
                      three ? "" : (turns(scene) ? "rad" : "mm"), "", "");
  const double unit = three || turns(scene) ? 1 : 1e3;
  for (const BondRun &run : runs) {
    const std::size_t rows = run.path.rows.size(), shown = std::min<std::size_t>(rows, 6);
    for (std::size_t k = 1; k <= shown; ++k) {
      const std::size_t n = k * rows / shown - 1;
      const RigReading &row = run.path.rows[n];
      text +=
          fmt::format("  {:>10.6g} {:>7.4g} {:>12.6g} {:>14.7g} {:>14.7g} {:>11.2e}\n", 1e-9 * run.modulus,
                      run.stiffness_ratio, load_of(scene, row), unit * measured_of(scene, row),
                      unit * by_hand_of(scene, run, n), difference_of(scene, run, n));
    }
    if (std::isnan(run.path.break_load)) continue;
    text += fmt::format("  broken at {:.6g} {}", run.path.break_load, turns(scene) ? "N m" : "N");
    if (!std::isnan(run.strength_by_hand))
      text += fmt::format("; by hand {:.6g}, difference {:.2e}", run.strength_by_hand,
                          relative(std::abs(run.path.break_load), run.strength_by_hand));
    text += "\n";
  }
  return text;
}

std::string report_of_prescribed(const Scene &scene, const std::vector<BondRun> &runs) {
  const bool turning = turns(scene);
  const char *unit = turning ? "N m" : "N";
  std::string text = fmt::format("  {:>10} {:>14} {:>14} {:>14} {:>8} {:>11}\n", "modulus",
                                 turning ? "rotation" : "displacement", turning ? "moment" : "force",
                                 "by hand", "damage", "difference");
  text += fmt::format("  {:>10} {:>14} {:>14} {:>14} {:>8} {:>11}\n", "GPa", turning ? "urad" : "um", unit,
                      unit, "", "of largest");
  for (const BondRun &run : runs) {
    const std::size_t rows = run.path.rows.size(), shown = std::min<std::size_t>(rows, 12);
    for (std::size_t k = 1; k <= shown; ++k) {
      const std::size_t n = k * rows / shown - 1;
      const RigReading &row = run.path.rows[n];
      const CohesiveRow &at = run.cohesive.rows[n];
      text += fmt::format(
          "  {:>10.6g} {:>14.7g} {:>14.7g} {:>14.7g} {:>8.4f} {:>11.2e}\n", 1e-9 * run.modulus,
          1e6 * displacement_of(scene, row), load_of(scene, row), by_hand_of(scene, run, n),
          std::max(at.measured.tension_damage, at.measured.shear_damage), run.cohesive.difference(n));
    }
    const CohesiveRow &last = run.cohesive.rows.back();
    text += fmt::format("  dissipated {:.10g} J; by hand {:.10g} J\n", last.measured.dissipated,
                        last.dissipated_by_hand);
    if (!std::isnan(run.path.break_load))
      text += fmt::format("  strength {:.10g} {}; by hand {:.10g} {}\n", run.path.break_load, unit,
                          run.strength_by_hand, unit);
    if (!std::isnan(run.cohesive.fracture_energy))
      text += fmt::format("  fracture energy {:.10g} J/m2; by hand {:.10g} J/m2\n",
                          run.cohesive.fracture_energy, run.cohesive.fracture_energy_by_hand);
  }
  return text;
}

void add_prescribed(Json &j, const Scene &scene, const BondRun &run) {
  const CohesiveRow &last = run.cohesive.rows.back();
  // The first place on the prescribed path: a sheared bond is pressed first.
  const auto moved = std::find_if(run.path.rows.begin(), run.path.rows.end(),
                                  [&](const RigReading &row) { return displacement_of(scene, row) != 0; });
  j["stiffness"] =
      moved != run.path.rows.end() ? load_of(scene, *moved) / displacement_of(scene, *moved) : not_given;
  j["largest_difference"] = run.cohesive.largest_difference();
  j["work_j"] = last.measured.work;
  j["stored_j"] = last.measured.stored;
  j["dissipated_j"] = last.measured.dissipated;
  j["dissipated_by_hand_j"] = last.dissipated_by_hand;
  j["fracture_energy_j_m2"] = run.cohesive.fracture_energy;
  j["fracture_energy_by_hand_j_m2"] = run.cohesive.fracture_energy_by_hand;
  j["plastic_closing_m"] = last.measured.plastic_closing;
}

Json summary_of(const Scene &scene, const BondRun &run) {
  const RigReading &r = run.path.largest;
  const double load = load_of(scene, r), displacement = displacement_of(scene, r);
  Json j;
  j["modulus_pa"] = run.modulus;
  j["stiffness_ratio"] = run.stiffness_ratio;
  j["largest_load"] = load;                // N; N m in bending and twisting
  j["way_at_largest_load"] = displacement; // m; rad
  j["stiffness"] = displacement != 0 ? load / displacement : not_given;
  j["stiffness_by_hand"] = run.stiffness_by_hand;
  j["strain_ratio"] = r.strain_ratio;
  j["strain_ratio_by_hand"] = run.strain_ratio_by_hand;
  j["break_load"] = run.path.break_load;
  j["break_load_by_hand"] = run.strength_by_hand;
  j["break_stress_pa"] = turns(scene) ? not_given : std::abs(run.path.break_load) / run.bond_area;
  j["fracture_work_j"] = run.fracture_work;
  j["largest_difference"] = largest_difference(scene, run);
  j["steps"] = run.steps;
  if (is_prescribed(scene)) add_prescribed(j, scene, run);
  return j;
}

std::vector<std::string> effects_of(const Scene &scene) {
  std::vector<std::string> effects{scene.bond.word()};
  if (scene.model.rotation) effects.emplace_back("rotation");
  if (scene.model.rotation && (turns(scene) || !is_prescribed(scene))) effects.emplace_back("bond moments");
  if (scene.effects.contact) effects.push_back(dem::word(*scene.effects.contact) + std::string(" contact"));
  if (scene.model.bond_dashpot > 0 && !is_prescribed(scene)) effects.emplace_back("bond dashpots");
  if (!is_prescribed(scene)) effects.emplace_back("local damping");
  return effects;
}

} // namespace

bool turns(const Scene &scene) {
  return pair_test_of(scene).path == PairPath::bending || pair_test_of(scene).path == PairPath::twisting;
}
bool is_prescribed(const Scene &scene) {
  return scene.bond.remembers();
}

void write_table(const std::filesystem::path &path, const Scene &scene, const std::vector<BondRun> &runs) {
  std::string columns =
      "run,modulus_pa,stiffness_ratio,force_n,displacement_m,moment_nm,rotation_rad,bond_normal_n,"
      "bond_shear_n,tension_utilisation,shear_utilisation,intact_bonds,lateral_m,strain_ratio,by_hand,"
      "difference";
  if (is_prescribed(scene))
    columns +=
        ",shear_by_hand_n,tension_damage,shear_damage,plastic_closing_m,work_j,stored_j,dissipated_j,"
        "dissipated_by_hand_j";
  WholeTable table(path, cells_of(columns));
  for (std::size_t k = 0; k < runs.size(); ++k)
    for (std::size_t n = 0; n < runs[k].path.rows.size(); ++n) {
      const BondRun &run = runs[k];
      const RigReading &r = run.path.rows[n];
      std::vector<CsvCell> cells{k + 1, run.modulus, run.stiffness_ratio};
      cells.insert(cells.end(), {r.force, r.displacement, r.moment, r.rotation, r.normal, r.shear,
                                 r.tension_ratio, r.shear_ratio, r.intact, r.lateral, r.strain_ratio,
                                 by_hand_of(scene, run, n), difference_of(scene, run, n)});
      if (is_prescribed(scene)) {
        const CohesiveRow &row = run.cohesive.rows[n];
        const CohesiveReading &m = row.measured;
        cells.insert(cells.end(), {row.by_hand.shear, m.tension_damage, m.shear_damage, m.plastic_closing,
                                   m.work, m.stored, m.dissipated, row.dissipated_by_hand});
      }
      table.row(cells);
    }
  table.finish();
}

std::string report(const Scene &scene, const std::vector<BondRun> &runs) {
  return is_prescribed(scene) ? report_of_prescribed(scene, runs) : report_by_closed_form(scene, runs);
}

Json summary_of(const Scene &scene, const std::vector<BondRun> &runs, int threads, double seconds) {
  TestFigures f;
  f.particles = static_cast<std::size_t>(pair_test_of(scene).particles);
  f.bonds = runs.front().bonds;
  f.time_step = runs.front().time_step;
  f.time_step_reason = runs.front().time_step_reason;
  f.threads = threads;
  f.wall_seconds = seconds;
  double largest = 0;
  Json list = Json::array();
  for (const BondRun &run : runs) {
    f.steps += run.steps;
    f.broken_tension += run.broken_tension;
    f.broken_shear += run.broken_shear;
    for (std::size_t k = 0; k < f.stage_seconds.size(); ++k)
      f.stage_seconds[k] += run.stage_seconds[k];
    largest = std::max(largest, largest_difference(scene, run));
    list.push_back(summary_of(scene, run));
  }
  Json s = summary_head(scene, "platen-bonds", "done", effects_of(scene));
  s["path"] = word_of(pair_paths, pair_test_of(scene).path);
  add_figures(s, f);
  s["largest_difference"] = largest;
  s["runs"] = list;
  return s;
}

} // namespace platen::apps
