// The lines for the screen at the end of a test.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "apps/run/at_peak.h"
#include "apps/run/failure_summary.h"
#include "apps/run/quasi_static.h"
#include "apps/run/summary_of_run.h"
#include "apps/run/validity.h"
#include "dem/measure/damage.h"
#include "dem/measure/gauge.h"

namespace platen::apps {
namespace {

// Lines for the screen, of what has been measured.
class Report {
public:
  explicit Report(const Validity &validity) : validity_(validity) {}
  // Of a key of summary.json; where there is a reason against it, that, told once.
  template <class... Numbers>
  void figure(const char *key, const char *what, const char *format, Numbers... numbers) {
    if ((std::isnan(static_cast<double>(numbers)) || ...)) return;
    if (validity_.holds(key)) return line(what, format, numbers...);
    const std::string &reason = validity_.reasons(key).front();
    words(what,
          "none: " + (std::find(told_.begin(), told_.end(), reason) == told_.end() ? reason : "as above"));
    told_.push_back(reason);
  }
  template <class... Numbers>
  void line(const char *what, const char *format, Numbers... numbers) {
    if ((std::isnan(static_cast<double>(numbers)) || ...)) return;
    text_ += fmt::format("  {:<36}{}\n", what, fmt::format(fmt::runtime(format), numbers...));
  }
  void words(const char *what, const std::string &said) { text_ += fmt::format("  {:<36}{}\n", what, said); }
  const std::string &text() const { return text_; }

private:
  const Validity &validity_;
  std::vector<std::string> told_;
  std::string text_;
};

// Of a test that ended before its peak, or on a plateau, or that bore more at another moment than at its
// peak.
void report_peak(Report &report, const Results &results) {
  const PeakOfCurve peak = results.peak();
  const LargestReading largest = results.largest_stress();
  if (!(results.largest_deviator().value > 0)) return;
  if (!peak.reached())
    report.line("largest stress, no strength", "{:.2f} MPa at the strain of {:.5f}", largest.value / 1e6,
                largest.strain);
  else if (largest.time != results.time_at_peak())
    report.line("largest stress, not at the peak", "{:.2f} MPa at {:.4g} ms", largest.value / 1e6,
                1e3 * largest.time);
  if (peak.kind == PeakKind::plateau)
    report.line("the peak is a plateau", "{:.2f} % gained in the last fifth of the strain",
                100 * peak.gained);
}

void report_strength(Report &report, const Scene &scene, const coupling::PlatenTest &problem,
                     const Results &results) {
  const bool disc = problem.shape().kind == dem::ShapeKind::disc,
             tension = scene.loading.test == LoadingTest::tension;
  if (disc || problem.bent())
    report.figure("failure_load_n", "load at failure", "{:.4g} kN",
                  results.strength() * problem.nominal_area() / 1e3);
  report.figure("strength_pa",
                disc             ? "splitting strength, 2P/(pi D t)"
                : problem.bent() ? "flexural strength, 3PL/(2bd^2)"
                : tension        ? "tensile strength"
                                 : "compressive strength",
                "{:.2f} MPa", results.strength() / 1e6);
  report_peak(report, results);
  if (problem.cell()) {
    report.figure("deviator_strength_pa", "deviator at the peak", "{:.2f} MPa at a pressure of {:.2f} MPa",
                  results.deviator_strength() / 1e6, results.confining_pressure() / 1e6);
    if (const LargestReading largest = results.largest_deviator();
        !results.peak().reached() || largest.time != results.time_at_peak())
      report.line("largest deviator", "{:.2f} MPa at {:.4g} ms", largest.value / 1e6, 1e3 * largest.time);
    report.figure("bulk_modulus_pa", "bulk modulus", "{:.2f} GPa", results.bulk_modulus() / 1e9);
  }
  std::vector<std::string> sides;
  for (const coupling::Side side : further_sides(problem, results.axis()))
    sides.push_back(
        fmt::format("{} {:.2f}", coupling::name_of(side), results.side_stress_at_peak(side) / 1e6));
  if (!sides.empty() && !std::isnan(results.strength()) && results.peak().reached())
    report.words("stress on the sides then", fmt::format("{} MPa", fmt::join(sides, ", ")));
}

void report_stiffness(Report &report, const coupling::PlatenTest &problem, const Results &results) {
  if (problem.bent()) {
    report.figure("deflection_at_peak_m", "deflection at peak", "{:.4g} um",
                  1e6 * results.deflection_at_peak());
    report.figure("flexural_modulus_pa", "flexural modulus",
                  "{:.2f} GPa (deflection by shear over bending {:.2f}, at nu = 0.2)",
                  flexural_modulus(problem, results) / 1e9,
                  problem.three_points().shear_share(assumed_poisson_ratio));
    report.line("moment at mid-span over PL/4", "{:.3f}", moment_over_nominal(problem, results));
    return;
  }
  if (results.axis() != 2) {
    report.words("loaded along", std::string(1, "xyz"[results.axis()]));
    report.figure("strain_at_peak_platen", "strain at peak (platen)", "{:.5f}",
                  results.strain_at_peak_platen());
    report.line("stress over strain, at 40 %", "{:.2f} GPa", results.youngs_modulus_platen() / 1e9);
    return;
  }
  report.figure("strain_at_peak_platen", "strain at peak (platen, gauge)", "{:.5f}, {:.5f}",
                results.strain_at_peak_platen(), results.strain_at_peak_gauge());
  if (problem.shape().kind == dem::ShapeKind::disc) return;
  const bool walled = problem.wall() != nullptr, held = !further_sides(problem).empty();
  if (held) {
    report.line("axial stress over strain, at 40 %", "{:.2f}, {:.2f} GPa",
                results.youngs_modulus_gauge() / 1e9, results.youngs_modulus_platen() / 1e9);
    return;
  }
  if (walled) {
    report.figure("constrained_modulus_pa", "constrained modulus (gauge, platen)", "{:.2f}, {:.2f} GPa",
                  results.youngs_modulus_gauge() / 1e9, results.youngs_modulus_platen() / 1e9);
    report.figure("lateral_over_axial_stress", "lateral over axial stress", "{:.3f}",
                  results.lateral_over_axial());
    return;
  }
  report.figure("youngs_modulus_gauge_pa", "Young's modulus (gauge)", "{:.2f} GPa",
                results.youngs_modulus_gauge() / 1e9);
  report.figure("youngs_modulus_platen_pa", "Young's modulus (platen)", "{:.2f} GPa",
                results.youngs_modulus_platen() / 1e9);
  report.figure("poisson_ratio", "Poisson's ratio", "{:.3f}", results.poisson_ratio());
}

void report_damage(Report &report, const Scene &scene, const coupling::PlatenTest &problem,
                   const Results &results) {
  const dem::Model &model = problem.model;
  report.line("broken bonds (tension, shear)", "{}, {} of {}",
              model.broken(dem::BondState::broken_in_tension), model.broken(dem::BondState::broken_in_shear),
              model.bonds ? model.bonds->initial_count() : 0);
  if (problem.bent()) {
    report.line("cracks within d/2 of mid-span", "{:.2f}",
                dem::broken_near_midspan(model.particles, *model.bonds, problem.shape().height));
    return;
  }
  if (problem.shape().kind == dem::ShapeKind::disc) {
    if (!model.bonds) return;
    const dem::SplitPattern s = dem::split_pattern(model.particles, *model.bonds, problem.shape());
    report.line("cracks on the loaded diameter", "{:.2f}, of the first twenty in its middle half {:.2f}",
                s.on_diameter, s.first_in_middle);
    return;
  }
  const Pattern &p = results.pattern();
  if (std::isnan(p.strain) || scene.loading.test == LoadingTest::tension) return;
  report.line("damage at 0.8 of the peak, after it", "top {:.2f}, bottom {:.2f}, middle {:.2f}",
              p.failure.damage.end_top, p.failure.damage.end_bottom, p.failure.damage.middle);
  report.line("end spread, barrel at peak", "{:.2f}, {:.2f}", p.failure.end_spread, results.barrel_at_peak());
  if (!tells_pattern(scene, problem)) return;
  report.words("cone on top", cone_words(p.failure.dead[dem::top_end]));
  report.words("cone on the bottom", cone_words(p.failure.dead[dem::bottom_end]));
  report.words("cones by damage, top", cone_words(p.failure.sound[dem::top_end]));
  report.words("bottom", cone_words(p.failure.sound[dem::bottom_end]));
  const dem::FailureVerdict verdict = dem::judge_failure(p.failure);
  report.words("pattern", fmt::format("{}: {}", dem::word_of(verdict.pattern), reason_words(p.failure)));
}

void report_emission(Report &report, const Results &results) {
  const Emission &e = results.emission();
  if (e.events.empty()) return;
  report.line("acoustic events", "{}, the largest of magnitude {:.1f}", e.events.size(),
              largest_magnitude(e));
  report.line("b-value before the peak", "{:.2f} +- {:.2f}", e.before.b, e.before.error);
  report.line("b-value after the peak", "{:.2f} +- {:.2f}", e.after.b, e.after.error);
}

} // namespace

std::string report_of_run(const Scene &scene, const coupling::PlatenTest &problem, const Results &results,
                          const RunCosts &costs) {
  const Validity validity = judge(scene, problem, results);
  Report report(validity);
  report_strength(report, scene, problem, results);
  report_stiffness(report, problem, results);
  report_damage(report, scene, problem, results);
  report_emission(report, results);
  report.line("energy residual over work", "{:.2e}", results.energy_residual_relative());
  report.line("kinetic over internal, to peak", "{:.2e}", results.kinetic_to_internal_max());
  const double transits = wave_transits_to_peak(problem, results);
  if (problem.bent())
    report.line("swings of the bar to the peak", "{:.1f}", oscillations_to_peak(problem, results));
  else
    report.line(results.peak().reached() ? "wave crossings to the peak" : "wave crossings to that stress",
                "{:.0f}", transits);
  report.line("unbalanced over bond forces, median", "{:.2e}", slowness(problem, results).unbalanced);
  report.line("steps, seconds", "{}, {:.1f} ({:.1f} M bond-steps/s)", problem.steps(), costs.wall_seconds,
              problem.model.bonds && costs.step_seconds > 0
                  ? 1e-6 * static_cast<double>(problem.model.bonds->initial_count()) *
                        static_cast<double>(costs.steps_here) / costs.step_seconds
                  : 0.0);
  return report.text();
}

} // namespace platen::apps
