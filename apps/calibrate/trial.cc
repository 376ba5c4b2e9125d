#include "apps/calibrate/trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/calibrate/calibrate_section.h"
#include "apps/output/stop_signal.h"
#include "apps/run/controls.h"
#include "apps/run/peak.h"
#include "apps/run/problem_setup.h"
#include "apps/run/quasi_static.h"
#include "apps/scene/parameters.h"
#include "coupling/static_press.h"
#include "dem/measure/gauge.h"

namespace platen::apps {
namespace {

// Readings of the stress on the way to the largest strain, as many as platen-compress takes.
constexpr double readings = 600;
// A run is over when the stress has fallen to this share of its peak; moduli are secants at that of 40 %.
constexpr double fallen = 0.8, modulus_share = 0.4;
// A fall before this share of the largest strain is none: what a cell leaves shakes about zero at first.
constexpr double begun = 0.02;
// Steps between two looks for a signal.
constexpr long between_signals = 1000;

struct Reading {
  double stress = 0, strain_platen = 0, axial = 0, lateral = 0; // signed by the sense of the test
  bool damaged = false;                                         // a bond has broken
  Reading minus(const Reading &o) const {
    return {stress - o.stress, strain_platen - o.strain_platen, axial - o.axial, lateral - o.lateral,
            damaged};
  }
};

// What lies between two readings, linearly.
double between(const Reading &a, const Reading &b, double weight, double Reading::*value) {
  return (1 - weight) * a.*value + weight * b.*value;
}

// Linear between the readings on both sides of a share of the peak, before it.
void add_moduli(const std::vector<Reading> &all, double peak, TrialResult &result) {
  for (std::size_t k = 1; k < all.size(); ++k) {
    const Reading &a = all[k - 1], &b = all[k];
    if (b.stress < modulus_share * peak) continue;
    const double w = (modulus_share * peak - a.stress) / (b.stress - a.stress);
    const double axial = between(a, b, w, &Reading::axial);
    result.young_modulus = modulus_share * peak / axial;
    result.platen_modulus = modulus_share * peak / between(a, b, w, &Reading::strain_platen);
    result.poisson_ratio = between(a, b, w, &Reading::lateral) / axial;
    return;
  }
}

// At equal steps of strain, where the strain is first reached; the last reading beyond all of them.
void add_curve(const std::vector<Reading> &all, const SpecimenTest &test, TrialResult &result) {
  double Reading::*const strain = test.curve_of_gauge ? &Reading::axial : &Reading::strain_platen;
  std::size_t k = 1;
  for (std::size_t point = 1; point <= curve_points; ++point) {
    const double at = test.curve_strain * static_cast<double>(point) / curve_points;
    while (k < all.size() && all[k].*strain < at)
      ++k;
    if (k == all.size()) {
      result.curve.push_back(all.back().stress);
      continue;
    }
    const double from = all[k - 1].*strain, to = all[k].*strain;
    result.curve.push_back(between(all[k - 1], all[k], (at - from) / (to - from), &Reading::stress));
  }
}

// As platen-compress judges it.
bool reached_peak(const std::vector<Reading> &all) {
  std::vector<CurvePoint> curve;
  for (const Reading &one : all)
    curve.push_back({one.strain_platen, one.stress, one.damaged});
  return judge_peak(curve).reached();
}

// All sides bore the cell's pressure when the platens took over; true without a cell.
bool consolidated(const coupling::PlatenTest &problem) {
  if (!problem.cell()) return true;
  const std::vector<coupling::Controlled> told = problem.program().controls(0);
  return std::all_of(told.begin(), told.end(), [](const auto &one) { return one.is_met(); });
}

// What tells whether the test is slow enough.
Sample pace_of(const coupling::PlatenTest &problem) {
  const dem::Model &model = problem.model;
  Sample s;
  s.time = problem.time();
  s.stress_top = problem.stress_top(), s.stress_bottom = problem.stress_bottom();
  s.intact_bonds = static_cast<double>(model.intact_bonds());
  s.unbalanced = problem.unbalanced_ratio();
  s.platen_speed = problem.platen_speed();
  return s;
}

// From a tenth of the peak to the peak, by the bounds of platen-compress on all but the kinetic energy; ""
// where it was slow enough. `paces`:
// of the readings, the first before the platens move.
std::string haste(const coupling::PlatenTest &problem, const std::vector<Reading> &all,
                  const std::vector<Sample> &paces) {
  constexpr double from = 0.1; // of the peak
  constexpr int axis = 2;
  const auto stress = [](const Reading &a, const Reading &b) { return a.stress < b.stress; };
  const auto top = std::max_element(all.begin(), all.end(), stress);
  const auto first =
      std::find_if(all.begin(), top, [&](const Reading &one) { return one.stress >= from * top->stress; });
  const std::vector<Sample> rise(paces.begin() + (first - all.begin()),
                                 paces.begin() + (top - all.begin()) + 1);
  Slowness s = slowness(problem, rise, axis);
  // Of a few hundred spheres the largest kinetic energy is what one crack sets free, however slow the
  // platens.
  s.kinetic = not_measured;
  s.wave_transits = wave_transits(problem, axis, rise.back().time - paces.front().time);
  const std::vector<std::string> reasons = reasons_not_quasi_static(s, false);
  return reasons.empty() ? "" : fmt::format("{}: {}", TrialResult::too_fast_words, fmt::join(reasons, "; "));
}

std::vector<Reading> load(coupling::PlatenTest &problem, const Scene &scene, const SpecimenTest &test,
                          TrialResult &result) {
  const double sign = test.kind == TestKind::tension ? -1 : 1, target = scene.loading.target_strain;
  const dem::Gauge gauge(problem.model.particles, problem.shape(), problem.model.bonds.get());
  const double step_closes = problem.settings().loading.rate * problem.time_step() / problem.shape().height;
  const long steps = std::max(1L, std::lround(target / readings / step_closes));
  const auto read = [&]() -> Reading {
    const dem::GaugeStrain strain = gauge.strain(problem.model.particles);
    return {sign * 0.5 * (problem.stress_top() + problem.stress_bottom()), sign * problem.closure_strain(),
            -sign * strain.axial, sign * strain.lateral(),
            problem.model.broken_tension + problem.model.broken_shear > 0};
  };
  // A test may take minutes: after a signal it is given up, and made again by --resume.
  const auto advance = [&](long count) {
    if (stop_requested() != 0) throw Stopped{stop_requested()};
    return problem.advance(count);
  };
  while (!problem.axial_stage())
    advance(steps);
  const Reading start = problem.cell() ? read() : Reading{};
  std::vector<Reading> all{{}};
  std::vector<Sample> paces{pace_of(problem)};
  double peak = 0, confined = 1; // Pa; of the lateral surface, at the peak
  bool fell = false;
  while (all.back().strain_platen < target && !(fell && all.back().strain_platen >= test.curve_strain)) {
    for (long made = 0; made < steps;)
      made += advance(std::min(steps - made, between_signals));
    all.push_back(read().minus(start));
    paces.push_back(pace_of(problem));
    const Reading &now = all.back();
    if (!std::isfinite(now.stress + now.strain_platen))
      throw coupling::NumericsStopped(
          fmt::format("not finite: stress or strain of the platens at time {:.6g} s", problem.time()));
    if (now.stress > peak) {
      peak = now.stress, result.strain_at_peak = now.strain_platen, fell = false;
      confined = problem.confined_share();
    }
    fell = fell || (now.damaged && now.strain_platen > begun * target && now.stress < fallen * peak);
  }
  const bool peaked = reached_peak(all);
  const std::string too_fast = peaked ? haste(problem, all, paces) : "";
  if (!consolidated(problem) || confined < least_confined) {
    result.strain_at_peak = not_given;
    result.status = consolidated(problem) ? "the cell's pressure does not load the specimen at its peak"
                                          : "the cell's pressure was not reached on all sides";
  } else if (peaked && too_fast.empty()) {
    result.strength = peak + start.stress;
    add_moduli(all, peak, result);
  } else {
    result.strain_at_peak = not_given;
    result.status = peaked ? too_fast : "no peak before the largest strain";
  }
  return all;
}

} // namespace

dem::Specimen placed(const dem::Specimen &specimen, const SpecimenTest &test) {
  return test.kind == TestKind::splitting ? dem::laid_down(specimen) : specimen;
}

TrialResult run_test(const Scene &scene, const dem::Specimen &specimen, const Choice &choice,
                     const SpecimenTest &test) {
  TrialResult result;
  const Scene s = scene_of_test(chosen(scene, choice), test);
  try {
    coupling::PlatenTest problem(placed(specimen, test), problem_settings(s));
    if (!test.loads()) {
      const coupling::StaticPress p = coupling::press_statically(problem, calibrate_of(scene).strain);
      result.young_modulus = p.youngs_modulus();
      result.platen_modulus = p.platen_modulus();
      result.poisson_ratio = p.poisson_ratio();
      return result;
    }
    const std::vector<Reading> all = load(problem, s, test, result);
    if (test.curve_strain > 0 && !result.too_fast()) add_curve(all, test, result);
  } catch (const coupling::NumericsStopped &e) {
    result.status = scene.parameters->with_entries(e.what());
  }
  return result;
}

dem::NetworkModuli bounds_of(const Scene &scene, const dem::Specimen &specimen, const Choice &choice) {
  const dem::ModelSettings settings = problem_settings(chosen(scene, choice)).model;
  const dem::Particles particles(specimen, settings.density, settings.rotation);
  const dem::Bonds bonds(particles, settings.bond_layout, *settings.bond);
  return dem::network_moduli(bonds, specimen.shape.volume());
}

} // namespace platen::apps
