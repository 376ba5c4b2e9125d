#include "apps/calibrate/trial.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "apps/output/numbers.h"
#include "apps/output/output_folder.h"
#include "apps/run/problem_setup.h"
#include "apps/scene/parameters.h"
#include "coupling/static_press.h"

namespace platen::apps {
namespace {

struct Reading {
  double time, strain, stress; // s, 1, Pa; signed as history.csv has them
};

std::vector<Reading> read_history(const std::filesystem::path &path, bool of_gauge) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> header = cells_of(line);
  const auto column = [&](const char *name) {
    return static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
  };
  const std::size_t time = column("time_s"),
                    strain = column(of_gauge ? "axial_strain_gauge" : "axial_strain_platen"),
                    top = column("axial_stress_top_pa"), bottom = column("axial_stress_bottom_pa");
  std::vector<Reading> all;
  while (std::getline(file, line)) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != header.size()) break;
    const auto number = [&](std::size_t at) { return number_of(cells.at(at)).value_or(not_given); };
    all.push_back({number(time), number(strain), 0.5 * (number(top) + number(bottom))});
  }
  return all;
}

// At equal steps of strain, where the strain is first reached; the last reading beyond all of them. Both
// count from the end of consolidation, and are positive in the sense of the test.
std::vector<double> curve_of(const SpecimenTest &test, const Json &summary,
                             const std::vector<Reading> &history) {
  const double sign = text_in(summary, "test") == "tension" ? -1 : 1,
               from = number_in(summary, "consolidation_end_time_s");
  std::vector<Reading> all;
  for (const Reading &one : history)
    if (std::isnan(from) || one.time >= from) all.push_back(one);
  if (all.empty()) return {};
  const Reading start = std::isnan(from) ? Reading{0, 0, 0} : all.front();
  for (Reading &one : all)
    one.strain = sign * (one.strain - start.strain), one.stress = sign * (one.stress - start.stress);
  std::vector<double> curve;
  std::size_t k = 0;
  for (std::size_t point = 1; point <= curve_points; ++point) {
    const double at = test.curve_strain * static_cast<double>(point) / curve_points;
    while (k < all.size() && all[k].strain < at)
      ++k;
    if (k == 0 || k == all.size()) {
      curve.push_back(k == 0 ? all.front().stress : all.back().stress);
      continue;
    }
    const Reading &a = all[k - 1], &b = all[k];
    curve.push_back(a.stress + (b.stress - a.stress) * (at - a.strain) / (b.strain - a.strain));
  }
  return curve;
}

} // namespace

const std::vector<std::string> usual_figures{"youngs_modulus_gauge_pa", "youngs_modulus_platen_pa",
                                             "poisson_ratio", "strength_pa", "strain_at_peak_platen"};

TrialResult solve_statically(const Scene &scene, const dem::Specimen &specimen) {
  TrialResult result;
  try {
    coupling::PlatenTest problem(specimen, problem_settings(scene));
    const coupling::StaticPress p = coupling::press_statically(problem, calibrate_of(scene).strain);
    result.summary = {{"youngs_modulus_gauge_pa", p.youngs_modulus()},
                      {"youngs_modulus_platen_pa", p.platen_modulus()},
                      {"poisson_ratio", p.poisson_ratio()}};
  } catch (const coupling::NumericsStopped &e) {
    result.status = scene.parameters->with_entries(e.what());
  }
  return result;
}

dem::NetworkModuli bounds_of(const Scene &scene, const dem::Specimen &specimen) {
  const dem::ModelSettings settings = problem_settings(scene).model;
  const dem::Particles particles(specimen, settings.density, settings.rotation);
  const dem::Bonds bonds(particles, settings.bond_layout, *settings.bond);
  return dem::network_moduli(bonds, specimen.shape.volume());
}

std::vector<std::string> entries_of_trials(const Scene &scene, const SpecimenTest &test) {
  std::vector<std::string> entries{"Output/Fields = off", "Checkpoint/Every = 0"};
  if (!scene.bond.calibrated.figures.empty())
    entries.emplace_back("Bond/Calibrated figures ="); // what is calibrated now
  const bool usual = std::all_of(test.figures.begin(), test.figures.end(), [](const std::string &key) {
    return std::find(usual_figures.begin(), usual_figures.end(), key) != usual_figures.end();
  });
  if (usual) entries.insert(entries.end(), {"Effects/Energy ledger = off", "Effects/Crack log = off"});
  if (usual && test.curve_strain == 0) entries.emplace_back("Loading/Stop at residual = 0.8");
  const bool own_strain = std::any_of(test.entries.begin(), test.entries.end(), [](const std::string &entry) {
    return entry.rfind("Loading/Target strain =", 0) == 0;
  });
  if (!own_strain && test.curve_strain > scene.loading.target_strain)
    entries.push_back("Loading/Target strain = " + shortest_text(test.curve_strain));
  return entries;
}

TrialResult result_of(const SpecimenTest &test, const Json &summary, const std::filesystem::path &folder) {
  TrialResult result;
  if (summary.value("quasi_static", Json()) == false && summary.value("peak_reached", Json()) == true) {
    result.status = fmt::format("{}: {}", TrialResult::too_fast_words,
                                fmt::join(summary["signs_of_haste"].get<std::vector<std::string>>(), "; "));
    return result;
  }
  result.summary = summary;
  if (test.curve_strain > 0)
    result.curve = curve_of(test, summary, read_history(OutputPaths(folder).history(), test.curve_of_gauge));
  for (const std::string &key : test.figures) {
    if (!std::isnan(result.number(key))) continue;
    const Json validity = summary.value("validity", Json::object()).value(key, Json());
    result.status =
        validity.is_array() && !validity.empty() ? validity[0].get<std::string>() : key + " was not measured";
    break;
  }
  return result;
}

} // namespace platen::apps
