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

// Lower edge of the fullest bin; of several the lowest.
double mode(const std::vector<double> &sorted, double bin) {
  double best = std::floor(sorted.front() / bin), here = best;
  std::size_t most = 0, count = 0;
  for (const double m : sorted) {
    const double at = std::floor(m / bin);
    count = at == here ? count + 1 : 1;
    here = at;
    if (count > most) most = count, best = here;
  }
  return best * bin;
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
  return events; // a set is named by its first crack, so these are in order
}

BValue b_value(const std::vector<double> &magnitudes, const BValueRules &rules) {
  std::vector<double> sorted;
  std::copy_if(magnitudes.begin(), magnitudes.end(), std::back_inserter(sorted),
               [](double m) { return std::isfinite(m); });
  std::sort(sorted.begin(), sorted.end());
  BValue v;
  if (sorted.empty()) return v;
  v.limit = std::isnan(rules.limit) ? mode(sorted, rules.bin) + rules.above_mode : rules.limit;
  const auto first = std::lower_bound(sorted.begin(), sorted.end(), v.limit);
  const double n = v.events = static_cast<double>(sorted.end() - first);
  if (n < std::max(2, rules.least_events)) return v;
  double mean = 0, square = 0;
  for (auto m = first; m != sorted.end(); ++m)
    mean += *m / n;
  for (auto m = first; m != sorted.end(); ++m)
    square += (*m - mean) * (*m - mean);
  if (!(mean > v.limit)) return v;
  v.b = (n - 1) / n / (std::log(10.0) * (mean - v.limit));
  v.error = std::log(10.0) * v.b * v.b * std::sqrt(square / (n * (n - 1)));
  return v;
}

void describe(Archive &archive, const std::string &name, std::vector<CrackPulse> &pulses) {
  Table table;
  Column<double> &time = table.add<double>("time", "s"), &energy = table.add<double>("energy", "J");
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
