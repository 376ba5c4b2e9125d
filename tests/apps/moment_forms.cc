#include "apps/moment_forms.h"

#include <algorithm>
#include <cmath>

namespace platen::apps::testing {
namespace {

// Of the turn of failure: rows stand on both of its sides. A turn is the sum of its steps.
constexpr double beside_failing_turn = 1e-7;

} // namespace

MomentSection moment_section(const CohesiveSection &section, MomentAxis axis, double beta,
                             double bond_radius) {
  const double inertia = 0.25 * section.area * bond_radius * bond_radius; // m^4
  MomentSection s;
  s.arm = beta * bond_radius;
  s.coupled = section.coupled && axis == MomentAxis::across; // what is twisted alone is not pulled
  s.area = section.area;
  s.own = section.tension(), s.other = section.shear(0);
  s.stiffness = section.normal_stiffness() * inertia;
  if (axis == MomentAxis::along) {
    std::swap(s.own, s.other);
    s.stiffness = section.shear_stiffness() * 2 * inertia;
  }
  return s;
}

double MomentByHand::used() const {
  return std::isfinite(section_.own.limit()) ? section_.arm * widest_ / section_.own.limit() : 0;
}

double MomentByHand::damage() const {
  const double own = section_.own.damage(used());
  return section_.coupled ? std::max(own, section_.other.damage(used())) : own;
}

double MomentByHand::left() const {
  return failed_ ? 0 : (1 - damage()) / std::max(1.0, used());
}

double MomentByHand::moment() const {
  return left() * section_.stiffness * std::sin(at_);
}

// What is left turns back to rest by the same share.
double MomentByHand::stored() const {
  return left() * section_.stiffness * (1 - std::cos(at_));
}

std::vector<double> MomentByHand::kinks(double to) const {
  std::vector<double> sines = {widest_}, shares;
  if (section_.arm > 0 && std::isfinite(section_.own.limit())) {
    const double softest = section_.coupled ? std::min(section_.own.softening, section_.other.softening)
                                            : section_.own.softening;
    const double limit = section_.own.limit() / section_.arm, end = limit * (1 + std::max(0.0, softest));
    sines.insert(sines.end(), {end * (1 - beside_failing_turn), end * (1 + beside_failing_turn)});
    if (!section_.own.is_brittle()) sines.push_back(limit);
  }
  for (const double sine : sines)
    for (const double side : {-1.0, 1.0}) {
      if (!(sine < 1)) continue;
      const double share = (side * std::asin(sine) - at_) / (to - at_);
      if (share > 0 && share < 1) shares.push_back(share);
    }
  std::sort(shares.begin(), shares.end());
  return shares;
}

void MomentByHand::go(double to) {
  const double before = moment(), from = at_;
  at_ = to;
  widest_ = std::max(widest_, std::abs(std::sin(at_)));
  failed_ = failed_ || damage() >= 1;
  work_ += 0.5 * (before + moment()) * (at_ - from);
}

} // namespace platen::apps::testing
