#include "apps/bonds/load_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/bonds/bond_rig.h"

namespace platen::apps {
namespace {

// A load that is put on at once overshoots, to twice its step where nothing damps it: a step takes
// up less than half of the strength that is left, but not less than the accuracy of the breaking load.
constexpr double share_of_reserve = .4, finest_step = 2e-4;
// Of the largest load, until a bond's utilisation tells how far it may go.
constexpr double share_of_first_step = 1e-3;

// Turning points over the largest load, tension positive: two spheres go through a cycle; three only stand on
// their plate.
std::vector<double> turning_points(const PairTest &test) {
  if (test.path == PairPath::compression) return {-1};
  if (test.path != PairPath::cyclic) return {1};
  return test.particles == 3 ? std::vector<double>{-.5, 0, -1} : std::vector<double>{.5, 0, -.5, 0, 1};
}

bool is_breakable(const Scene &scene) {
  return std::isfinite(dem::never_if_zero(scene.bond.number("tensile_strength"))) ||
         std::isfinite(dem::never_if_zero(scene.bond.number("shear_strength")));
}

class Walk {
public:
  explicit Walk(const Scene &scene)
      : rig_(scene),
        test_(pair_test_of(scene)),
        by_load_(!std::isnan(test_.force)),
        careful_(is_breakable(scene)),
        run_(scene, rig_.model()) {
    // A moment is Force at the arm of a radius, an angle is Displacement over it.
    const double radius = turns(scene) ? scene.specimen.sphere_radius : 1;
    peak_ = by_load_ ? test_.force * radius : test_.displacement / radius;
    bonds_ = now_.intact = static_cast<double>(run_.bonds);
  }

  BondRun go() {
    for (const Leg &leg : legs_of(turning_points(test_), test_.steps))
      for (int k = 1; k <= leg.steps && !over_; ++k)
        go_to(leg.from + (leg.to - leg.from) * k / leg.steps);
    const BondReading &r = run_.largest;
    if (r.travel() != 0) run_.stiffness = r.load() / r.travel();
    run_.time_step = rig_.time_step();
    run_.time_step_reason = rig_.time_step_reason();
    run_.conclude(rig_.model(), rig_.steps());
    return std::move(run_);
  }

private:
  // To a load step, by smaller ones where a bond is close to its strength.
  void go_to(double goal) {
    while (at_ != goal && !over_) {
      const double further = std::abs(goal) > std::abs(at_) ? reach() : std::abs(goal - at_);
      const double left = goal - at_;
      const double next = std::abs(left) <= further ? goal : at_ + std::copysign(further, left);
      const BondReading before = now_;
      now_ = by_load_ ? rig_.load_to(next * peak_) : rig_.move_to(next * peak_);
      at_ = next;
      if (now_.intact < bonds_ && std::isnan(run_.break_load)) {
        run_.break_load = before.load();
        const bool known = !run_.rows.empty() && run_.rows.back().load() == before.load();
        if (before.load() != 0 && !known) run_.rows.push_back(before);
        over_ = by_load_; // a broken bond holds no load
        if (!over_) run_.rows.push_back(now_);
        continue;
      }
      if (now_.intact == bonds_ && std::abs(now_.load()) > std::abs(run_.largest.load())) run_.largest = now_;
      if (at_ == goal) run_.rows.push_back(now_);
    }
  }

  // How far the load may go on, over the peak.
  double reach() const {
    const double used = std::max(now_.tension_ratio, now_.shear_ratio);
    if (!careful_ || now_.intact < bonds_) return std::numeric_limits<double>::infinity();
    if (at_ == 0) return share_of_first_step;
    if (!(used > 0)) return std::abs(at_); // nothing is near its strength: at most doubled
    return std::max(share_of_reserve * (1 - used), finest_step) * std::abs(at_) / used;
  }

  BondRig rig_;
  const PairTest &test_;
  const bool by_load_, careful_;
  BondRun run_;
  bool over_ = false;
  double peak_ = 0, at_ = 0; // at_: over peak_
  double bonds_ = 0;         // at the start
  BondReading now_;
};

} // namespace

std::vector<Leg> legs_of(const std::vector<double> &turns, int steps) {
  std::vector<Leg> legs;
  double from = 0, length = 0;
  for (const double to : turns) {
    legs.push_back({from, to, 0});
    length += std::abs(to - from), from = to;
  }
  for (Leg &leg : legs)
    leg.steps = std::max(1, static_cast<int>(std::lround(std::abs(leg.to - leg.from) / length * steps)));
  return legs;
}

std::vector<double> turning_displacements(const PairTest &test) {
  if (!test.turns.empty()) return test.turns;
  std::vector<double> turns = turning_points(test);
  for (double &point : turns)
    point *= test.displacement;
  return turns;
}

BondRun follow_path(const Scene &scene) {
  return Walk(scene).go();
}

} // namespace platen::apps
