#include "dem/measure/acoustic_emission.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

#include "dem/measure/fragments.h"

namespace platen::dem {
namespace {

auto key(const CrackPulse &c) {
  return std::make_tuple(c.time, c.point.x, c.point.y, c.point.z, c.energy);
}

AcousticEvent event_of(const std::vector<CrackPulse> &cracks, const std::vector<int> &members) {
  AcousticEvent e;
  e.cracks = static_cast<int>(members.size());
  e.time = cracks[members.front()].time;
  e.duration = cracks[members.back()].time - e.time;
  Vector3 mean, weighed;
  for (const int k : members) {
    mean += cracks[k].point / static_cast<double>(members.size());
    weighed += cracks[k].energy * cracks[k].point;
    e.energy += cracks[k].energy;
  }
  e.centre = e.energy > 0 ? weighed / e.energy : mean;
  double square = 0;
  for (const int k : members)
    square += norm_squared(cracks[k].point - mean);
  e.size = std::sqrt(square / static_cast<double>(members.size()));
  e.magnitude = magnitude_of(e.energy);
  return e;
}

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double nearly = 1e-9;              // of a bin
constexpr double decade_of_energy = 1 / 1.5; // in magnitudes

// Number of the fullest bin; the lowest of several.
double mode(const std::vector<double> &sorted, double bin) {
  double best = std::floor(sorted.front() / bin), here = best;
  std::size_t most = 0, count = 0;
  for (const double m : sorted) {
    const double at = std::floor(m / bin);
    count = at == here ? count + 1 : 1;
    here = at;
    if (count > most) most = count, best = here;
  }
  return best;
}

// The events of a range of magnitudes, in a sorted catalogue.
struct Magnitudes {
  std::vector<double>::const_iterator first, last;
  double limit, upper;
  double count() const { return static_cast<double>(last - first); }
  double length() const { return upper - limit; }
  double mean_above_limit() const {
    double sum = 0;
    for (auto m = first; m != last; ++m)
      sum += *m - limit;
    return sum / count();
  }
};

// ln(10) b of a range with an upper end, by bisection; 0 if smaller events are not more frequent.
double decay_between(double mean, double length) {
  if (!(mean > 0 && mean < 0.5 * length)) return 0;
  double low = 0, high = 1 / mean; // without an upper end it would be 1 / mean
  constexpr int halvings = 60;
  for (int k = 0; k < halvings; ++k) {
    const double beta = 0.5 * (low + high);
    (1 / beta - length / std::expm1(beta * length) > mean ? low : high) = beta;
  }
  return 0.5 * (low + high);
}

BValue fit(const Magnitudes &range) {
  const double n = range.count(), mean = range.mean_above_limit(), ln10 = std::log(10.0);
  BValue v;
  v.limit = range.limit, v.upper = range.upper, v.events = n, v.law = PowerLaw::holds;
  if (std::isinf(range.upper)) {
    double square = 0;
    for (auto m = range.first; m != range.last; ++m)
      square += (*m - range.limit - mean) * (*m - range.limit - mean);
    v.b = mean > 0 ? (n - 1) / n / (ln10 * mean) : 0;
    v.error = ln10 * v.b * v.b * std::sqrt(square / (n * (n - 1)));
  } else {
    const double length = range.length(), beta = decay_between(mean, length);
    v.b = beta / ln10;
    const double s = 2 * std::sinh(0.5 * beta * length);
    v.error = 1 / (ln10 * std::sqrt(n * (1 / (beta * beta) - length * length / (s * s))));
  }
  return v;
}

// Allowed distance between the fractions of events below a magnitude and those of the law: a tenth of samples
// of the law exceed it (Stephens 1974, Table 1.1: exponential, scale unknown).
double distance_allowed(double n) {
  const double root = std::sqrt(n);
  return 0.990 / (root + 0.26 + 0.5 / root) + 0.2 / n;
}

bool follows(const Magnitudes &range, const BValue &v) {
  const double n = range.count(), beta = std::log(10.0) * v.b, allowed = distance_allowed(n);
  const double reach = *(range.last - 1) - range.limit, length = std::min(range.length(), reach);
  if (!(v.b * length >= 1 && length >= decade_of_energy)) return false;
  constexpr double most_missing = 3; // -ln(0.05): events expected beyond the largest
  if (std::isinf(range.upper) && n * std::exp(-beta * reach) > most_missing) return false;
  const double total = -std::expm1(-beta * range.length());
  double before = 0;
  for (auto m = range.first; m != range.last; ++m) {
    const double fraction = -std::expm1(-beta * (*m - range.limit)) / total;
    const double after = before + 1 / n;
    if (std::abs(fraction - before) > allowed || std::abs(fraction - after) > allowed) return false;
    before = after;
  }
  return true;
}

} // namespace

EventWindow event_window(double mean_radius, double wave_speed, double radii, double transits) {
  const double reach = radii * mean_radius;
  return {reach, transits * reach / wave_speed};
}

double magnitude_of(double energy) {
  return energy > 0 ? (std::log10(energy) - 4.8) / 1.5 : std::numeric_limits<double>::quiet_NaN();
}

std::vector<AcousticEvent> gather_events(std::vector<CrackPulse> cracks, const EventWindow &window) {
  std::sort(cracks.begin(), cracks.end(),
            [](const CrackPulse &one, const CrackPulse &other) { return key(one) < key(other); });
  DisjointSets sets(cracks.size());
  for (std::size_t i = 0; i < cracks.size(); ++i)
    for (std::size_t j = i + 1; j < cracks.size() && cracks[j].time - cracks[i].time <= window.time; ++j)
      if (norm_squared(cracks[j].point - cracks[i].point) <= window.reach * window.reach)
        sets.join(static_cast<int>(i), static_cast<int>(j));
  std::vector<AcousticEvent> events;
  for (const std::vector<int> &members : sets.all())
    events.push_back(event_of(cracks, members));
  return events; // a set is named by its first crack, so events are in order
}

BValue b_value(const std::vector<double> &magnitudes, const BValueRules &rules) {
  std::vector<double> sorted;
  std::copy_if(magnitudes.begin(), magnitudes.end(), std::back_inserter(sorted),
               [](double m) { return std::isfinite(m); });
  std::sort(sorted.begin(), sorted.end());
  BValue best;
  if (sorted.empty()) return best;
  const bool given = !std::isnan(rules.limit);
  const double start = given ? rules.limit : rules.bin * mode(sorted, rules.bin) + rules.above_mode;
  const auto from = [&](double m) { return std::lower_bound(sorted.begin(), sorted.end(), m); };
  best.limit = start;
  best.events = static_cast<double>(sorted.end() - from(start));
  const double wanted = std::max<double>(std::max(2, rules.least_events), rules.least_fraction * best.events);
  if (best.events < wanted) return best;
  best.law = PowerLaw::not_followed;
  double most = wanted - 1;
  for (int k = 0; k == 0 || !given; ++k) {
    const double limit = start + k * rules.bin;
    const auto first = from(limit);
    if (static_cast<double>(sorted.end() - first) <= most) break;
    // First without an upper end, then up to the largest event, then one bin less at a time.
    double upper = infinite;
    for (int step = 0;; ++step) {
      const auto last = step < 2 ? sorted.end() : from(upper);
      if (static_cast<double>(last - first) <= most) break;
      const Magnitudes range{first, last, limit, upper};
      if (const BValue found = fit(range); follows(range, found)) {
        best = found;
        best.above = static_cast<double>(sorted.end() - last);
        most = best.events;
        break;
      }
      upper = step == 0 ? sorted.back() : rules.bin * (std::ceil(upper / rules.bin - nearly) - 1);
    }
  }
  return best;
}

double BValue::count(double magnitude) const {
  const double beta = std::log(10.0) * b, x = magnitude - limit;
  if (std::isinf(upper)) return events * std::exp(-beta * x);
  const double length = upper - limit;
  return above + events * (std::exp(-beta * x) - std::exp(-beta * length)) / -std::expm1(-beta * length);
}

std::string reason_against(const BValue &value, const BValueRules &rules) {
  const std::string found =
      std::to_string(static_cast<long>(value.events)) + " events from the magnitude of completeness on";
  switch (value.law) {
    case PowerLaw::holds:
      break;
    case PowerLaw::few_events:
      return found + "; a b-value needs " + std::to_string(rules.least_events);
    case PowerLaw::not_followed:
      return found +
             ": no range that holds half of the events and spans a decade in number and in energy fits a "
             "power law";
  }
  return "";
}

void describe(Archive &archive, const std::string &name, std::vector<CrackPulse> &pulses) {
  Table table;
  Column<double> &time = table.add<double>("time", "s"), &energy = table.add<double>("energy", "J", or_nan());
  Column<Vector3> &point = table.add<Vector3>("point", "m");
  table.resize(pulses.size());
  for (std::size_t k = 0; k < pulses.size(); ++k)
    time[k] = pulses[k].time, point[k] = pulses[k].point, energy[k] = pulses[k].energy;
  archive.table(name, table);
  if (!archive.reads()) return;
  pulses.resize(table.size());
  for (std::size_t k = 0; k < pulses.size(); ++k)
    pulses[k] = {time[k], point[k], energy[k]};
}

} // namespace platen::dem
