#include "apps/bonds/load_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include "apps/bonds/pair_section.h"

namespace platen::apps {
namespace {

// A load that is put on at once overshoots, to twice its step where nothing damps it: a step takes
// up less than half of the strength that is left, but not less than the accuracy of the breaking load.
constexpr double share_of_reserve = .4, finest_step = 2e-4;
constexpr double first_step = 1e-3; // of the largest load, until a bond's utilisation tells how far it may go

class Walk {
public:
  Walk(BondRig &rig, const Scene &scene) : rig_(rig), test_(pair_test_of(scene)) {
    const bool turns = test_.path == PairPath::bending || test_.path == PairPath::twisting;
    const double radius = scene.specimen.sphere_radius;
    by_load_ = !std::isnan(test_.force);
    // A moment is Force at the arm of a radius, an angle is Displacement over it.
    peak_ = by_load_ ? test_.force * (turns ? radius : 1) : test_.displacement / (turns ? radius : 1);
    careful_ = std::isfinite(rig.section().tensile_strength) || std::isfinite(rig.section().shear_strength);
    result_.break_load = not_given;
    now_.intact = rig.bonds_at_start();
  }

  PathResult go() {
    const std::vector<double> points = turning_points(test_);
    double length = 0, from = 0;
    for (const double to : points)
      length += std::abs(to - from), from = to;
    for (const double to : points) {
      const double part = std::abs(to - at_) / length;
      const int steps = std::max(1, static_cast<int>(std::lround(part * test_.steps)));
      const double start = at_;
      for (int k = 1; k <= steps && !over_; ++k)
        go_to(start + (to - start) * k / steps);
    }
    return std::move(result_);
  }

private:
  // To a load step, by smaller ones where a bond is close to its strength.
  void go_to(double goal) {
    while (at_ != goal && !over_) {
      const double further = std::abs(goal) > std::abs(at_) ? reach() : std::abs(goal - at_);
      const double left = goal - at_;
      const double next = std::abs(left) <= further ? goal : at_ + std::copysign(further, left);
      const RigReading before = now_;
      now_ = by_load_ ? rig_.load_to(next * peak_) : rig_.move_to(next * peak_);
      at_ = next;
      if (now_.intact < rig_.bonds_at_start() && std::isnan(result_.break_load)) {
        result_.break_load = load_of(before);
        const bool known = !result_.rows.empty() && load_of(result_.rows.back()) == load_of(before);
        if (load_of(before) != 0 && !known) result_.rows.push_back(before);
        over_ = by_load_; // a broken bond holds no load
        if (!over_) result_.rows.push_back(now_);
        continue;
      }
      if (now_.intact == rig_.bonds_at_start() &&
          std::abs(load_of(now_)) > std::abs(load_of(result_.largest)))
        result_.largest = now_;
      if (at_ == goal) result_.rows.push_back(now_);
    }
  }

  // How far the load may go on, over the peak.
  double reach() const {
    const double used = now_.utilisation();
    if (!careful_ || now_.intact < rig_.bonds_at_start()) return std::numeric_limits<double>::infinity();
    if (at_ == 0) return first_step;
    if (!(used > 0)) return std::abs(at_); // nothing is near its strength: at most doubled
    return std::max(share_of_reserve * (1 - used), finest_step) * std::abs(at_) / used;
  }

  static double load_of(const RigReading &r) { return r.force != 0 ? r.force : r.moment; }

  BondRig &rig_;
  const PairTest &test_;
  bool by_load_ = true, careful_ = true, over_ = false;
  double peak_ = 0, at_ = 0; // at_: over peak_
  RigReading now_;
  PathResult result_;
};

} // namespace

std::vector<double> turning_points(const PairTest &test) {
  if (test.path == PairPath::compression) return {-1};
  if (test.path != PairPath::cyclic) return {1};
  return test.particles == 3 ? std::vector<double>{-.5, 0, -1} : std::vector<double>{.5, 0, -.5, 0, 1};
}

PathResult follow_path(BondRig &rig, const Scene &scene) {
  return Walk(rig, scene).go();
}

} // namespace platen::apps
