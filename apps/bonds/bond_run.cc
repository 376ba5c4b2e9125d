#include "apps/bonds/bond_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/output/csv_writer.h"
#include "base/pi.h"
#include "dem/laws/normal_contact.h"

namespace platen::apps {
namespace {

struct ReadingColumn {
  const char *name;
  double BondReading::*member;
};
constexpr ReadingColumn of_any_bond[] = {{"force_n", &BondReading::force},
                                         {"displacement_m", &BondReading::displacement},
                                         {"moment_nm", &BondReading::moment},
                                         {"rotation_rad", &BondReading::rotation},
                                         {"bond_normal_n", &BondReading::normal},
                                         {"bond_shear_n", &BondReading::shear},
                                         {"tension_utilisation", &BondReading::tension_ratio},
                                         {"shear_utilisation", &BondReading::shear_ratio},
                                         {"intact_bonds", &BondReading::intact},
                                         {"lateral_m", &BondReading::lateral},
                                         {"strain_ratio", &BondReading::strain_ratio}};
constexpr ReadingColumn of_history[] = {{"tension_damage", &BondReading::tension_damage},
                                        {"shear_damage", &BondReading::shear_damage},
                                        {"plastic_closing_m", &BondReading::plastic_closing},
                                        {"work_j", &BondReading::work},
                                        {"stored_j", &BondReading::stored},
                                        {"dissipated_j", &BondReading::dissipated}};

std::vector<ReadingColumn> columns_of(const Scene &scene) {
  std::vector<ReadingColumn> columns(std::begin(of_any_bond), std::end(of_any_bond));
  if (is_prescribed(scene)) columns.insert(columns.end(), std::begin(of_history), std::end(of_history));
  return columns;
}

constexpr std::size_t shown_rows = 10; // of each run, on the screen

Json summary_of(const Scene &scene, const BondRun &run) {
  Json j;
  j["modulus_pa"] = run.modulus;
  j["stiffness_ratio"] = run.stiffness_ratio;
  j["largest_load"] = run.largest.load();          // N; N m in bending and twisting
  j["way_at_largest_load"] = run.largest.travel(); // m; rad
  j["stiffness"] = run.stiffness;
  j["strain_ratio"] = run.largest.strain_ratio;
  j["break_load"] = run.break_load;
  j["break_stress_pa"] = turns(scene) ? not_given : std::abs(run.break_load) / run.bond_area;
  j["fracture_work_j"] = run.fracture_work;
  j["steps"] = run.steps;
  if (!is_prescribed(scene)) return j;
  const BondReading &last = run.rows.back();
  j["work_j"] = last.work;
  j["stored_j"] = last.stored;
  j["dissipated_j"] = last.dissipated;
  j["fracture_energy_j_m2"] = run.fracture_energy;
  j["plastic_closing_m"] = last.plastic_closing;
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

BondRun::BondRun(const Scene &scene, const dem::Model &model) : modulus(scene.model.bond_layout.modulus) {
  const dem::BondStiffness stiff = model.bonds->stiffness(0);
  stiffness_ratio =
      scene.bond.has("stiffness_ratio") ? scene.bond.number("stiffness_ratio") : stiff.shear / stiff.axial;
  bond_area = pi * model.bonds->bond_radius[0] * model.bonds->bond_radius[0];
  bonds = model.intact_bonds();
}

void BondRun::conclude(const dem::Model &model, long steps_made) {
  add(model, steps_made);
  fracture_work = model.works.fracture;
}

void write_table(const std::filesystem::path &path, const Scene &scene, const std::vector<BondRun> &runs) {
  const std::vector<ReadingColumn> columns = columns_of(scene);
  std::vector<std::string> names{"run", "modulus_pa", "stiffness_ratio"};
  for (const ReadingColumn &column : columns)
    names.emplace_back(column.name);
  WholeTable table(path, names);
  for (std::size_t k = 0; k < runs.size(); ++k)
    for (const BondReading &row : runs[k].rows) {
      std::vector<CsvCell> cells{k + 1, runs[k].modulus, runs[k].stiffness_ratio};
      for (const ReadingColumn &column : columns)
        cells.emplace_back(row.*column.member);
      table.row(cells);
    }
  table.finish();
}

std::string report(const Scene &scene, const std::vector<BondRun> &runs) {
  const bool turned = turns(scene), three = is_pyramid(scene), remembers = is_prescribed(scene);
  const char *unit = turned ? "N m" : "N";
  std::string text = fmt::format("  {:>12} {:>8} {:>14} {:>18} {:>12}\n", "modulus, GPa", "ks/kn",
                                 fmt::format("{}, {}", turned ? "moment" : "force", unit),
                                 turned ? "rotation, urad" : "displacement, um",
                                 three       ? "strain ratio"
                                 : remembers ? "damage"
                                             : "");
  for (const BondRun &run : runs) {
    const std::size_t rows = run.rows.size(), shown = std::min(rows, shown_rows);
    for (std::size_t k = 1; k <= shown; ++k) {
      const BondReading &row = run.rows[k * rows / shown - 1];
      text += fmt::format("  {:>12.6g} {:>8.4g} {:>14.7g} {:>18.7g}", 1e-9 * run.modulus, run.stiffness_ratio,
                          row.load(), 1e6 * row.travel());
      if (three) text += fmt::format(" {:>12.5f}", row.strain_ratio);
      if (remembers) text += fmt::format(" {:>12.4f}", std::max(row.tension_damage, row.shear_damage));
      text += "\n";
    }
    if (!std::isnan(run.break_load)) text += fmt::format("  broken at {:.6g} {}\n", run.break_load, unit);
    if (remembers) text += fmt::format("  dissipated {:.6g} J\n", run.rows.back().dissipated);
    if (!std::isnan(run.fracture_energy))
      text += fmt::format("  fracture energy {:.6g} J/m2\n", run.fracture_energy);
  }
  return text;
}

Json summary_of(const Scene &scene, const std::vector<BondRun> &runs, int threads, double seconds) {
  TestFigures f;
  f.particles = static_cast<std::size_t>(pair_test_of(scene).particles);
  f.bonds = runs.front().bonds;
  f.time_step = runs.front().time_step;
  f.time_step_reason = runs.front().time_step_reason;
  f.threads = threads;
  f.wall_seconds = seconds;
  Json list = Json::array();
  for (const BondRun &run : runs) {
    f.steps += run.steps;
    f.broken_tension += run.broken_tension;
    f.broken_shear += run.broken_shear;
    for (std::size_t k = 0; k < f.stage_seconds.size(); ++k)
      f.stage_seconds[k] += run.stage_seconds[k];
    list.push_back(summary_of(scene, run));
  }
  Json s = summary_head(scene, "platen-bonds", "done", effects_of(scene));
  s["path"] = word_of(pair_paths, pair_test_of(scene).path);
  add_figures(s, f);
  s["runs"] = list;
  return s;
}

} // namespace platen::apps
