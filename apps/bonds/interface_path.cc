#include "apps/bonds/interface_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace platen::apps {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double same_row = 1e-7; // share of a way: an equal step that close to a kink is left out

bool slides(const PairTest &test) {
  return test.path == PairPath::shear;
}

// Shares of a way where rows stand, ascending, the last one 1.
std::vector<double> shares_of(const std::vector<double> &kinks, int steps) {
  std::vector<double> shares = kinks;
  for (int k = 1; k < steps; ++k) {
    const double share = static_cast<double>(k) / steps;
    if (std::none_of(kinks.begin(), kinks.end(), [&](double at) { return std::abs(at - share) < same_row; }))
      shares.push_back(share);
  }
  std::sort(shares.begin(), shares.end());
  shares.push_back(1);
  return shares;
}

double length_of(const InterfacePlace &from, const InterfacePlace &to) {
  return std::abs(to.opening - from.opening) + std::abs(to.slip - from.slip);
}

class Lead {
public:
  Lead(InterfaceRig &rig, const PairTest &test)
      : rig_(rig), test_(test), by_hand_(rig.section(), test.path == PairPath::combined, test.slip_ratio) {
    result_.section = rig.section();
  }

  InterfaceResult go() {
    const std::vector<InterfacePlace> places = turning_places(test_, rig_.section());
    double length = 0;
    InterfacePlace from;
    for (const InterfacePlace &to : places)
      length += length_of(from, to), from = to;
    from = {};
    for (const InterfacePlace &to : places) {
      const double part = length_of(from, to) / length;
      const int steps = std::max(1, static_cast<int>(std::lround(part * test_.steps)));
      for (const double share : shares_of(by_hand_.kinks(to), steps))
        go_to(share < 1 ? InterfacePlace{from.opening + share * (to.opening - from.opening),
                                         from.slip + share * (to.slip - from.slip)}
                        : to);
      from = to;
    }
    conclude();
    return std::move(result_);
  }

private:
  void go_to(const InterfacePlace &to) {
    rig_.go(to);
    by_hand_.go(to);
    const InterfaceReading m = rig_.read();
    RigReading row;
    row.force = slides(test_) ? m.load.shear : m.load.normal;
    row.displacement = slides(test_) ? to.slip : to.opening;
    row.normal = m.load.normal;
    row.shear = m.load.shear;
    row.tension_ratio = m.tension_ratio;
    row.shear_ratio = m.shear_ratio;
    row.intact = m.intact;
    row.strain_ratio = none;
    result_.path.rows.push_back(row);
    result_.rows.push_back({m, by_hand_.load(), by_hand_.dissipated()});
    if (row.intact > 0 && std::abs(row.force) > std::abs(result_.path.largest.force))
      result_.path.largest = row;
  }

  void conclude() {
    const InterfaceSection &s = rig_.section();
    const bool slides_only = slides(test_);
    const SofteningByHand softening = slides_only ? s.shear(test_.pressure) : s.tension();
    result_.stiffness_by_hand = s.area * softening.stiffness;
    result_.strength_by_hand = s.area * softening.strength;
    if (test_.path == PairPath::compression)
      result_.strength_by_hand = std::numeric_limits<double>::infinity();
    const bool combined = test_.path == PairPath::combined;
    if (combined) { // where the first of the lines bends down
      InterfaceByHand fresh(s, true, test_.slip_ratio);
      const InterfacePlace end = turning_places(test_, s).front();
      const std::vector<double> kinks = fresh.kinks(end);
      result_.strength_by_hand = none;
      if (!kinks.empty()) {
        fresh.go({kinks.front() * end.opening, kinks.front() * end.slip});
        result_.strength_by_hand = fresh.load().normal;
      }
    }
    result_.path.break_load = result_.fracture_energy = result_.fracture_energy_by_hand = none;
    if (result_.rows.back().measured.intact > 0) return;
    std::size_t peak = 0, failed = 0;
    for (std::size_t k = 0; k < result_.rows.size(); ++k) {
      if (result_.path.rows[k].intact == 0) break;
      failed = k + 1;
      if (height(k) > height(peak)) peak = k;
    }
    result_.path.break_load = driven(peak);
    if (combined || (slides_only && test_.pressure > 0)) return;
    result_.fracture_energy =
        (result_.rows[failed].measured.work - result_.rows[peak].measured.work) / s.area;
    result_.fracture_energy_by_hand = softening.fracture_energy();
  }

  double driven(std::size_t row) const { return result_.path.rows[row].force; }
  double height(std::size_t row) const { return slides(test_) ? std::abs(driven(row)) : driven(row); }

  InterfaceRig &rig_;
  const PairTest &test_;
  InterfaceByHand by_hand_;
  InterfaceResult result_;
};

} // namespace

std::vector<InterfacePlace> turning_places(const PairTest &test, const InterfaceSection &section) {
  std::vector<double> turns = test.turns;
  if (turns.empty())
    for (const double point : turning_points(test))
      turns.push_back(point * test.displacement);
  std::vector<InterfacePlace> places;
  const double closed = slides(test) && test.pressure > 0 ? -section.closing_at(test.pressure) : 0;
  if (closed != 0) places.push_back({closed, 0});
  for (const double turn : turns) {
    if (slides(test))
      places.push_back({closed, turn});
    else
      places.push_back({turn, test.path == PairPath::combined ? test.slip_ratio * turn : 0});
  }
  return places;
}

InterfaceResult follow_interface(InterfaceRig &rig, const Scene &scene) {
  return Lead(rig, scene.pair_test).go();
}

double InterfaceResult::difference(std::size_t row) const {
  double scale = 0;
  for (const InterfaceRow &r : rows)
    scale = std::max({scale, std::abs(r.by_hand.normal), std::abs(r.by_hand.shear)});
  const InterfaceRow &r = rows[row];
  const double normal = r.measured.load.normal - r.by_hand.normal,
               shear = r.measured.load.shear - r.by_hand.shear;
  return (std::abs(normal) > std::abs(shear) ? normal : shear) / scale;
}

double InterfaceResult::largest_difference() const {
  double largest = 0;
  for (std::size_t k = 0; k < rows.size(); ++k)
    largest = std::max(largest, std::abs(difference(k)));
  return largest;
}

} // namespace platen::apps
