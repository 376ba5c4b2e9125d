#include "apps/run/controls.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/largest.h"

namespace platen::apps {
namespace {

using coupling::Controlled;

bool is_stress(const Controlled &c) {
  return c.unit == Controlled::pascal;
}

// "3.42 of 5 MPa"
std::string reached_of_asked(const Controlled &c) {
  const double unit = is_stress(c) ? 1e-6 : 1;
  return fmt::format("{:.4g} of {:.4g} {}", unit * c.reached, unit * c.target, is_stress(c) ? "MPa" : c.unit);
}

std::vector<Controlled> misses(const coupling::PlatenTest &problem, std::size_t stage) {
  std::vector<Controlled> all = problem.program().controls(stage);
  all.erase(std::remove_if(all.begin(), all.end(), [](const Controlled &c) { return c.is_met(); }),
            all.end());
  return all;
}

bool is_asked_again(const coupling::PlatenTest &problem, int axis, std::size_t after, std::size_t until) {
  for (std::size_t stage = after + 1; stage <= until; ++stage)
    for (const Controlled &c : problem.program().controls(stage))
      if (c.axis == axis && !c.constant) return true;
  return false;
}

} // namespace

std::string words_of_misses(const coupling::PlatenTest &problem, std::size_t stage) {
  const std::string by = problem.program().stage(stage).ended_by();
  std::vector<std::string> words;
  for (const Controlled &c : misses(problem, stage))
    words.push_back(fmt::format("{} {} {}", c.side, c.quantity, reached_of_asked(c)));
  if (by == coupling::Stage::not_settled)
    return fmt::format("stage {} did not settle in its time: {}; a longer Hold gives it more", stage + 1,
                       fmt::join(words, ", "));
  if (words.empty()) return "";
  return fmt::format("stage {} (ended by: {}) has not reached what it asked: {}", stage + 1,
                     by.empty() ? "the end of the test" : by, fmt::join(words, ", "));
}

bool failed_in(const coupling::PlatenTest &problem, const Results &results, std::size_t stage) {
  return results.peak().reached() && problem.program().stage_at(results.time_at_peak()) == stage;
}

std::size_t stages_over(const coupling::PlatenTest &problem, bool test_ended) {
  return test_ended ? problem.program().stage_number() + 1 : problem.program().stages_ended();
}

std::string with_misses(const std::string &ended_by, const coupling::PlatenTest &problem,
                        const Results &results, std::size_t stages) {
  std::vector<std::string> words;
  for (std::size_t stage = 0; stage < stages; ++stage)
    for (const Controlled &c : misses(problem, stage))
      if (!failed_in(problem, results, stage))
        words.push_back(fmt::format("{} {} of stage {}", c.side, c.quantity, stage + 1));
  return words.empty() ? ended_by : fmt::format("{}; not reached: {}", ended_by, fmt::join(words, ", "));
}

std::vector<std::string> controls_against(const coupling::PlatenTest &problem, const Results &results,
                                          double time) {
  std::vector<std::string> reasons;
  if (!std::isfinite(time)) return reasons; // the figure was not read off
  const coupling::Program &program = problem.program();
  const std::size_t at = program.stage_at(time);
  for (std::size_t stage = 0; stage < program.stages_ended() && stage <= at; ++stage) {
    if (failed_in(problem, results, stage)) continue;
    for (const Controlled &c : misses(problem, stage))
      if (is_stress(c) && !is_asked_again(problem, c.axis, stage, at))
        reasons.push_back(fmt::format("stage {} has not reached what it asked: {} {} {}, within 1 %",
                                      stage + 1, c.side, c.quantity, reached_of_asked(c)));
  }
  return reasons;
}

std::string confinement_against(const Results &results, double time) {
  const std::vector<Sample> &samples = results.samples();
  const auto at =
      std::find_if(samples.begin(), samples.end(), [&](const Sample &s) { return s.time >= time; });
  if (at == samples.end() || !(at->confined_fraction < least_confined)) return "";
  return fmt::format(
      "the pressure loaded {:.0f} % of the lateral surface then, {:.0f} % at least: pieces have come loose",
      100 * at->confined_fraction, 100 * least_confined);
}

PressurePath pressure_path(const coupling::PlatenTest &problem, const Results &results) {
  PressurePath found;
  const std::optional<coupling::CellSettings> &cell = problem.settings().loading.cell;
  if (!cell || cell->path == 0) return found;
  const std::vector<Sample> &samples = results.samples();
  double strain_found = not_measured;
  Largest deviation;
  for (const Sample &s : samples) {
    if (s.axial_stage == 0) {
      strain_found = s.strain_platen;
      continue;
    }
    const double asked = cell->pressure + cell->path * s.deviator();
    if (asked <= 0 && s.confining_pressure <= 0) {
      found.ended_at_strain = s.strain_platen - strain_found;
      return found;
    }
    deviation.add(std::abs(s.confining_pressure - std::max(0.0, asked)) / std::max(cell->pressure, asked));
    found.deviation = deviation.value();
    if (s.time >= results.time_at_peak()) return found;
  }
  return found;
}

} // namespace platen::apps
