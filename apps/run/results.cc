#include "apps/run/results.h"

#include <algorithm>
#include <cmath>

#include "base/largest.h"
#include "dem/measure/damage.h"

namespace platen::apps {
namespace {

// A peak counts once the stress has fallen to this share of it: where the pattern is measured.
constexpr double pattern_share = 0.8;
// Moduli are secants at this share of the strength (Bamforth; Tannu 2017).
constexpr double modulus_share = 0.4;
// From here on the energy balance, and the speed of a test, say more than the noise of the first contacts.
constexpr double whole_share = 0.1;

} // namespace

Pattern Results::measure_pattern(const coupling::PlatenTest &problem) const {
  Pattern p;
  p.time = problem.time();
  p.strain = problem.closure_strain(axis_);
  if (!problem.model.bonds) return p;
  const dem::Bonds &bonds = *problem.model.bonds;
  if (axis_ == 2)
    p.failure =
        dem::measure_failure(problem.model.particles, bonds, problem.shape(), intact_rules_,
                             has_fallen() ? state_at_peak_.motion_since(problem) : dem::MotionAfterPeak{},
                             problem.model.bond_losses());
  p.broken_tension = static_cast<double>(problem.model.broken(dem::BondState::broken_in_tension));
  p.broken_shear = static_cast<double>(problem.model.broken(dem::BondState::broken_in_shear));
  return p;
}

std::vector<int> Results::moves_with(const coupling::PlatenTest &problem) const {
  if (!follows_motion_ || !problem.model.bonds) return {};
  std::vector<int> with(problem.model.particles.size(), 0);
  if (!has_fallen()) return with;
  const dem::DeadZones zones = dem::find_dead_zones(
      dem::specimen_before(problem.model.particles, problem.shape()), state_at_peak_.motion_since(problem));
  for (const dem::End end : {dem::bottom_end, dem::top_end})
    for (std::size_t i = 0; i < with.size(); ++i)
      if (zones.members[end][i]) with[i] = 1 + end;
  return with;
}

bool LoadedOn::operator()(const Sample &sample, double strain) {
  const bool loads = sample.axial_stage != 0 && sample.cycling == 0 && sample.loads != 0;
  if (!loads) turn_ = last_;
  if (!loads || strain < turn_) return false;
  turn_ = -std::numeric_limits<double>::infinity();
  last_ = strain;
  return true;
}

bool Results::counts(const Sample &sample, LoadedOn &loaded_on) const {
  return loaded_on(sample, sign_ * sample.*platen_strain(axis_));
}

bool Results::falls_in(const Sample &sample) const {
  return peak_ > 0 && sample.setting == samples_[peak_row_].setting;
}

void Results::count_anew() {
  loaded_on_ = {}, counts_.clear(), peak_row_ = 0;
  for (std::size_t k = 0; k < samples_.size(); ++k) {
    counts_.push_back(counts(samples_[k], loaded_on_));
    if (counts_[k] && (!counts_[peak_row_] || stress(samples_[k]) > stress(samples_[peak_row_])))
      peak_row_ = k;
  }
}

bool Results::falls_with(const Sample &sample) const {
  LoadedOn next = loaded_on_;
  return counts(sample, next) && falls_in(sample) && stress(sample) < pattern_share * peak_ &&
         measured_for_ != peak_;
}

bool Results::add(const Sample &sample, const coupling::PlatenTest &problem) {
  const bool falls = falls_with(sample);
  if (problem.model.bonds && problem.model.settings().crack_log)
    largest_openings_.follow(problem.model.particles, *problem.model.bonds);
  samples_.push_back(sample);
  counts_.push_back(counts(sample, loaded_on_));
  if (!counts_.back()) return false;
  const double now = stress(sample);
  if (now > peak_) {
    peak_ = now;
    peak_row_ = samples_.size() - 1;
    at_eighty_ = Pattern{};
    if (problem.model.bonds && follows_motion_) state_at_peak_.keep(problem);
    if (problem.model.bonds && axis_ == 2)
      barrel_ =
          dem::barrel(dem::skin_opening(problem.model.particles, *problem.model.bonds, problem.shape()));
    return false;
  }
  if (!falls) return false;
  measured_for_ = peak_;
  at_eighty_ = measure_pattern(problem);
  return true;
}

void Results::listen(const dem::Crack &c) {
  emission_.rose.add(c.normal, c.area);
  emission_.pulses.push_back({c.time, c.point, c.energy});
}

void Results::finish(const coupling::PlatenTest &problem, const dem::EventWindow &window) {
  last_ = measure_pattern(problem);
  emission_.events = dem::gather_events(emission_.pulses, window);
  std::vector<double> before, after;
  for (const dem::AcousticEvent &event : emission_.events)
    (event.time > time_at_peak() ? after : before).push_back(event.magnitude);
  emission_.before = dem::b_value(before);
  emission_.after = dem::b_value(after);
}

double Emission::largest_magnitude() const {
  double largest = not_measured;
  for (const dem::AcousticEvent &event : events)
    largest = std::fmax(largest, event.magnitude);
  return largest;
}

int Emission::largest_cracks() const {
  int most = 0;
  for (const dem::AcousticEvent &event : events)
    most = std::max(most, event.cracks);
  return most;
}

// Platens that begin to move make the stress oscillate a little, and so may a heavy sleeve: no peak before a
// bond of the axial stage breaks.
bool Results::fallen_to(double share) const {
  if (samples_.empty() || !counts_.back() || !falls_in(samples_.back())) return false;
  const Sample &now = samples_.back();
  if (!(stress(now) < share * peak_)) return false;
  return now.intact_bonds + now.broken() == 0 || now.broken() > zero().broken();
}

PeakOfCurve Results::peak() const {
  if (!(peak_ > 0)) return {};
  const Sample start = zero();
  const auto strain = platen_strain(axis_);
  std::vector<CurvePoint> curve;
  for (std::size_t k = 0; k < samples_.size(); ++k)
    if (const Sample &s = samples_[k]; counts_[k] && falls_in(s))
      curve.push_back({sign_ * (s.*strain - start.*strain), stress(s),
                       s.intact_bonds + s.broken() == 0 || s.broken() > start.broken(),
                       static_cast<coupling::Loads>(static_cast<int>(s.loads))});
  return judge_peak(curve);
}

bool Results::has_axial_stage() const {
  return std::any_of(samples_.begin(), samples_.end(), [](const Sample &s) { return s.axial_stage != 0; });
}

bool Results::is_ever_loaded_on() const {
  return std::count(counts_.begin(), counts_.end(), 1) > 0;
}

bool Results::goes_on_by_command() const {
  for (std::size_t k = peak_row_ + 1; k < samples_.size(); ++k)
    if (samples_[k].loads == 0 || samples_[k].setting != samples_[peak_row_].setting) return true;
  return false;
}

const Sample &Results::zero() const {
  std::size_t last = 0;
  while (last + 1 < samples_.size() && samples_[last + 1].axial_stage == 0)
    ++last; // with a pressure the first sample is of the hydrostatic stage
  return samples_[last];
}

double Results::consolidation_end() const {
  const bool consolidated = !samples_.empty() && zero().time > samples_.front().time;
  return consolidated ? zero().time : not_measured;
}

// NaN where one of them is.
LargestReading Results::largest_of(bool axial_alone, double cell) const {
  LargestReading largest;
  for (const Sample &s : samples_) {
    if (axial_alone && s.axial_stage == 0) continue;
    const double now = sign_ * (s.stress(axis_) - cell * s.cell_pressure);
    if (std::isnan(now)) return {};
    if (!(now <= largest.value)) largest = {now, s.time};
  }
  return largest;
}

const Sample *Results::at_largest(double Sample::*value) const {
  const Sample *largest = nullptr;
  for (const Sample &s : samples_) {
    if (std::isnan(s.*value)) return nullptr;
    if (largest == nullptr || s.*value > largest->*value) largest = &s;
  }
  return largest;
}

const Sample *Results::before_tear() const {
  std::size_t k = 0;
  while (k < samples_.size() && samples_[k].wrap_torn == 0)
    ++k;
  return k > 1 && k < samples_.size() ? &samples_[k - 1] : nullptr;
}

double Results::stress_at_end() const {
  return samples_.empty() ? not_measured : sign_ * samples_.back().stress(axis_);
}
double Results::strength() const {
  return peak_ > 0 ? sign_ * samples_[peak_row_].stress(axis_) : not_measured;
}
double Results::deviator_strength() const {
  return peak_ > 0 ? peak_ : not_measured;
}
double Results::confining_pressure() const {
  if (samples_.empty()) return not_measured;
  return (peak().reached() ? samples_[peak_row_] : samples_.back()).confining_pressure;
}
double Results::bulk_modulus() const {
  if (samples_.empty()) return not_measured;
  const Sample &end = zero();
  return end.cell_pressure > 0 ? end.cell_pressure / end.volumetric_strain : not_measured;
}
double Results::strain_at_peak(double Sample::*strain) const {
  return peak_ > 0 ? sign_ * (samples_[peak_row_].*strain - zero().*strain) : not_measured;
}
double Results::axial_time_to_peak() const {
  return peak_ > 0 ? samples_[peak_row_].time - zero().time : not_measured;
}

std::size_t Results::readings_until(std::size_t row) const {
  std::size_t count = 0;
  for (std::size_t k = 1; k <= row; ++k)
    count += samples_[k].axial_stage != 0;
  return count;
}
std::size_t Results::readings_to_peak() const {
  return peak_ > 0 ? readings_until(peak_row_) : 0;
}

double Results::unequal(const Sample &a, const Sample &b, double weight) const {
  const auto difference = [&](const Sample &s) {
    return axis_ == 0   ? s.stress_left - s.stress_right
           : axis_ == 1 ? s.stress_front - s.stress_back
                        : s.stress_top - s.stress_bottom;
  };
  const auto mean = [&](double of_a, double of_b) { return (1 - weight) * of_a + weight * of_b; };
  return std::abs(mean(difference(a), difference(b)) / mean(a.stress(axis_), b.stress(axis_)));
}
double Results::unequal_at_peak() const {
  return peak_ > 0 ? unequal(samples_[peak_row_], samples_[peak_row_], 0) : not_measured;
}

Results::Crossing Results::ascending(double share) const {
  for (std::size_t k = 1; k < samples_.size() && peak_ > 0; ++k) {
    if (samples_[k].axial_stage == 0) continue;
    const double before = stress(samples_[k - 1]), after = stress(samples_[k]);
    if (after >= share * peak_) return {true, k, (share * peak_ - before) / (after - before)};
  }
  return {};
}
double Results::at(const Crossing &c, double Sample::*value) const {
  return (1 - c.weight) * samples_[c.after - 1].*value + c.weight * samples_[c.after].*value;
}
double Results::gained(const Crossing &c, double Sample::*value) const {
  return at(c, value) - zero().*value;
}

ModulusState Results::modulus_state() const {
  ModulusState state;
  const Crossing c = ascending(modulus_share);
  if (!c.found) return state;
  const Sample &s = samples_[c.after];
  state.found = true;
  state.stress = modulus_share * peak_;
  state.time = s.time;
  state.unequal = unequal(samples_[c.after - 1], s, c.weight);
  state.readings = readings_until(c.after);
  state.broken = s.broken() - zero().broken();
  const double plastic = s.plastic - s.platen_plastic - (zero().plastic - zero().platen_plastic);
  if (s.bond > 0 && plastic > 0) state.plastic_share = plastic / s.bond;
  state.loaded_on = s.loads != 0 && s.setting == zero().setting;
  return state;
}
double Results::secant(double Sample::*strain) const {
  const Crossing c = ascending(modulus_share);
  return c.found ? (modulus_share * peak_ - stress(zero())) / (sign_ * gained(c, strain)) : not_measured;
}
double Results::bulging(double Sample::*across, double Sample::*along) const {
  const Crossing c = ascending(modulus_share);
  return c.found ? -gained(c, across) / gained(c, along) : not_measured;
}
double Results::lateral_over_axial() const {
  const Crossing c = ascending(modulus_share);
  return c.found ? at(c, &Sample::confining_pressure) / (modulus_share * peak_) : not_measured;
}

// Without an axial stage the energy balance is read from half the pressure on, of a tube alone from half its
// load.
std::size_t Results::whole_balance_from() const {
  if (peak_ > 0) return ascending(whole_share).after;
  double Sample::*const load =
      !samples_.empty() && samples_.back().total_load > 0 ? &Sample::total_load : &Sample::confining_pressure;
  std::size_t k = 0;
  while (k + 1 < samples_.size() && samples_[k].*load < 0.5 * samples_.back().*load)
    ++k;
  return k;
}

double Results::largest_over_work(double Sample::*value) const {
  const std::size_t from = whole_balance_from();
  if (from == 0 || std::isnan(samples_[from].*value)) return not_measured; // no load, or no ledger
  Largest largest;
  for (std::size_t k = from; k < samples_.size(); ++k)
    largest.add(std::abs(samples_[k].*value));
  return largest.value() / samples_[peak_ > 0 ? peak_row_ : samples_.size() - 1].boundary;
}

double Results::work_over_strain() const {
  const auto strain = platen_strain(axis_);
  double work = samples_.empty() ? not_measured : 0;
  for (std::size_t k = 1; k < samples_.size(); ++k) {
    const Sample &before = samples_[k - 1], &now = samples_[k];
    work += 0.5 * (stress(before) + stress(now)) * sign_ * (now.*strain - before.*strain);
  }
  return work;
}

double Results::lost_in_bonds() const {
  if (samples_.empty()) return not_measured;
  const Sample &first = samples_.front(), &last = samples_.back();
  const auto lost = [](const Sample &s) { return s.fracture + s.plastic - s.platen_plastic; };
  return lost(last) - lost(first);
}

std::vector<Sample> Results::rise() const {
  const Crossing c = ascending(whole_share);
  if (!c.found) return {};
  const auto row = [&](std::size_t k) { return samples_.begin() + static_cast<std::ptrdiff_t>(k); };
  return {row(c.after), row(peak_row_ + 1)};
}

void Pattern::describe(Archive &archive) {
  archive.version(1);
  archive("time", time, "s", or_nan());
  archive("strain", strain, "1", or_nan());
  archive("broken_tension", broken_tension, "1", or_nan(at_least(0)));
  archive("broken_shear", broken_shear, "1", or_nan(at_least(0)));
  archive.part("failure", failure);
}

void Results::describe(Archive &archive) {
  const auto version = archive.version(3);
  archive("barrel", barrel_, "1", or_nan());
  archive("peak", peak_, "Pa");
  archive("measured_for", measured_for_, "Pa");
  archive.part("at_eighty", at_eighty_);
  if (version > 1) archive.part("state_at_peak", state_at_peak_);       // else no cones by displacement
  if (version > 2) archive.part("largest_openings", largest_openings_); // else from here on
  archive("crack_rose", emission_.rose.area, "m2");
  dem::describe(archive, "crack_pulses", emission_.pulses);
  apps::describe(archive, "samples", samples_);
  if (archive.reads()) count_anew();
}

} // namespace platen::apps
