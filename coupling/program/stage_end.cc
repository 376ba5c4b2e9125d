#include "coupling/program/stage_end.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace platen::coupling {

using Reached = Until::Reached;

namespace {

bool is_fraction(const Until &until) {
  return until.what == Reached::fraction_of_peak || until.what == Reached::fraction_of_start;
}

} // namespace

const char *name_of(Reached what) {
  static constexpr std::array<const char *, 9> names{
      "strain", "strain change", "stress", "share of peak", "share of start", "circumferential strain",
      "cmod",   "time",          "settled"};
  return names.at(static_cast<std::size_t>(what));
}

std::optional<Widening> widening_of(Reached what) {
  if (what == Reached::circumferential_strain) return Widening::circumference;
  if (what == Reached::mouth_opening) return Widening::mouth;
  return std::nullopt;
}

StageEnd::StageEnd(Parameters parameters)
    : parameters_(std::move(parameters)), seen_(parameters_.any.size()) {
  for (const Until &until : parameters_.any)
    if (!std::isfinite(until.value)) throw std::invalid_argument("a stage ends at no finite value");
}

double StageEnd::now(const Measures &m, const Until &until) const {
  switch (until.what) {
    case Reached::strain:
    case Reached::strain_change:
      return m.closure_strain(until.of.axis);
    case Reached::circumferential_strain:
    case Reached::mouth_opening:
      return m.widening(*widening_of(until.what));
    case Reached::stress:
    case Reached::fraction_of_peak:
    case Reached::fraction_of_start:
      return until.of.stress(m) - (is_fraction(until) && until.less_pressure ? m.lateral_pressure() : 0.0);
    default:
      return 0;
  }
}

void StageEnd::begin(const Measures &m, const Transfer &from) {
  for (std::size_t k = 0; k < seen_.size(); ++k) {
    const Until &until = parameters_.any[k];
    seen_[k].found = seen_[k].largest = now(m, until);
    if (until.what == Reached::strain) seen_[k].zero = from.zero[static_cast<std::size_t>(until.of.axis)];
  }
}

void StageEnd::update(const Measures &m, double) {
  for (std::size_t k = 0; k < seen_.size(); ++k)
    if (parameters_.any[k].what == Reached::fraction_of_peak)
      seen_[k].largest = std::max(seen_[k].largest, std::abs(now(m, parameters_.any[k])));
}

bool StageEnd::is_met(const Measures &m, const Until &until, const Seen &seen, double passed,
                      bool settled) const {
  const double value = until.value;
  switch (until.what) {
    case Reached::settled:
      return settled && passed >= parameters_.least;
    case Reached::time:
      return passed >= value;
    case Reached::strain_change:
      return std::abs(now(m, until) - seen.found) >= value;
    case Reached::strain: {
      const double strain = std::abs(now(m, until) - seen.zero);
      return until.direction > 0 ? strain >= value : strain <= value;
    }
    case Reached::fraction_of_peak:
      return passed > parameters_.ramp && std::abs(now(m, until)) <= value * seen.largest;
    case Reached::fraction_of_start: {
      const double sign = seen.found < 0 ? -1 : 1;
      return sign * now(m, until) <= value * std::abs(seen.found);
    }
    default:
      return seen.found < value ? now(m, until) >= value : now(m, until) <= value;
  }
}

int StageEnd::reached(const Measures &m, double passed, bool settled) const {
  for (std::size_t k = 0; k < seen_.size(); ++k)
    if (is_met(m, parameters_.any[k], seen_[k], passed, settled)) return static_cast<int>(k) + 1;
  return passed >= parameters_.latest ? too_late : 0;
}

bool StageEnd::needs_settled() const {
  return std::any_of(parameters_.any.begin(), parameters_.any.end(),
                     [](const Until &until) { return until.what == Reached::settled; });
}

double StageEnd::progress(const Measures &m, double passed) const {
  double most = 0;
  for (std::size_t k = 0; k < seen_.size(); ++k) {
    const Until &until = parameters_.any[k];
    const double from = until.what == Reached::strain ? seen_[k].zero : seen_[k].found;
    const bool falls = until.what == Reached::strain && until.direction < 0;
    if (until.what == Reached::time && until.value > 0) most = std::max(most, passed / until.value);
    if (widening_of(until.what) || (until.what == Reached::strain && !falls) ||
        until.what == Reached::strain_change)
      if (until.value > 0) most = std::max(most, std::abs(now(m, until) - from) / until.value);
  }
  return std::min(1.0, most);
}

void StageEnd::Seen::describe(Archive &archive) {
  archive.version(1);
  archive("found", found, "1", or_nan());
  archive("largest", largest, "1", or_nan());
  archive("zero", zero, "1", or_nan());
}

void StageEnd::describe(Archive &archive) {
  archive.version(1);
  for (std::size_t k = 0; k < seen_.size(); ++k)
    archive.part("until_" + std::to_string(k + 1), seen_[k]);
}

} // namespace platen::coupling
