#include "apps/bonds/interface_forms.h"

#include <algorithm>
#include <cmath>

namespace platen::apps {
namespace {

constexpr double beside_failure = 1e-9; // of the displacement of failure: rows stand on both of its sides

// Share of the softening that is used up at a displacement so far.
double share(const SofteningByHand &of, double farthest) {
  if (!std::isfinite(of.limit())) return 0;
  return std::clamp((farthest - of.limit()) / (of.end() - of.limit()), 0.0, 1.0);
}

} // namespace

SofteningByHand InterfaceSection::tension() const {
  const dem::ElastoDamagePlastic::Parameters &p = law.parameters;
  SofteningByHand s{dem::never_if_zero(p.tensile_strength), normal_stiffness(), p.softening_tension};
  if (p.fracture_energy_tension > 0)
    s.softening = 2 * p.fracture_energy_tension * s.stiffness / (s.strength * s.strength);
  return s;
}

SofteningByHand InterfaceSection::shear(double pressure) const {
  const dem::ElastoDamagePlastic::Parameters &p = law.parameters;
  const double strength = dem::never_if_zero(p.shear_strength);
  SofteningByHand s{strength + p.friction_static * pressure, shear_stiffness(), p.softening_shear};
  if (p.fracture_energy_shear > 0)
    s.softening = 2 * p.fracture_energy_shear * s.stiffness / (strength * strength);
  return s;
}

double InterfaceSection::yield_stress(double closing) const {
  double at = 0, stress = 0, slope = normal_stiffness();
  for (const auto &branch : law.compression.branches) {
    const double next = at + (branch.limit - stress) / slope;
    if (closing <= next) break;
    at = next, stress = branch.limit, slope = normal_stiffness() / branch.slope;
  }
  return stress + slope * (closing - at);
}

double InterfaceSection::closing_at(double wanted) const {
  double at = 0, stress = 0, slope = normal_stiffness();
  for (const auto &branch : law.compression.branches) {
    if (wanted <= branch.limit) break;
    at += (branch.limit - stress) / slope;
    stress = branch.limit, slope = normal_stiffness() / branch.slope;
  }
  return at + (wanted - stress) / slope;
}

InterfaceByHand::InterfaceByHand(const InterfaceSection &section, bool combined, double slip_ratio)
    : section_(section), combined_(combined), slip_ratio_(slip_ratio) {}

double InterfaceByHand::pressure() const {
  return std::max(0.0, -section_.normal_stiffness() * (at_.opening + plastic_));
}

InterfaceByHand::Used InterfaceByHand::used() const {
  const SofteningByHand tension = section_.tension(), shear = section_.shear(0);
  const double n = widest_ / tension.limit(), s = slip_ratio_ * widest_ / shear.limit();
  if (section_.law.parameters.failure_line == dem::FailureLine::coupled) return {n + s, n + s};
  return {n, s};
}

double InterfaceByHand::tension_damage() const {
  const SofteningByHand tension = section_.tension();
  if (combined_) return std::clamp((used().tension - 1) / tension.softening, 0.0, 1.0);
  return share(tension, widest_);
}

double InterfaceByHand::shear_damage() const {
  if (combined_) return std::clamp((used().shear - 1) / section_.shear(0).softening, 0.0, 1.0);
  return share(section_.shear(pressure()), farthest_);
}

// Shares of stress that cohesion holds at the present opening and slip, and what friction adds.
InterfaceByHand::Stresses InterfaceByHand::stresses() const {
  Stresses s;
  const double kn = section_.normal_stiffness(), ks = section_.shear_stiffness();
  const double open = at_.opening + plastic_;
  if (combined_) {
    s.normal = failed_ ? 0 : kn * open * (1 - tension_damage()) / std::max(1.0, used().tension);
    s.cohesion = failed_ ? 0 : ks * at_.slip * (1 - shear_damage()) / std::max(1.0, used().shear);
    return s;
  }
  const SofteningByHand tension = section_.tension(), shear = section_.shear(pressure());
  const double dn = tension_damage(), ds = failed_ ? 1 : shear_damage();
  s.normal = kn * open;
  if (open > 0 && dn > 0) s.normal = failed_ ? 0 : tension.strength * (1 - dn) * open / widest_;
  s.cohesion = ks * at_.slip;
  if (ds > 0) s.cohesion = ds < 1 ? shear.strength * (1 - ds) * at_.slip / farthest_ : 0;
  s.friction_share = ds;
  return s;
}

double InterfaceByHand::stored() const {
  const Stresses s = stresses();
  const double friction = s.friction_share * section_.shear_stiffness() * slider_ * slider_;
  return 0.5 * section_.area * (s.normal * (at_.opening + plastic_) + s.cohesion * at_.slip + friction);
}

void InterfaceByHand::update() {
  deepest_ = std::max(deepest_, -at_.opening);
  plastic_ = deepest_ - section_.yield_stress(deepest_) / section_.normal_stiffness();
  widest_ = std::max(widest_, at_.opening + plastic_);
  farthest_ = std::max(farthest_, std::abs(at_.slip));
  failed_ = failed_ || damage() >= 1;
  const Stresses s = stresses();
  now_ = {section_.area * s.normal,
          section_.area * (s.cohesion + s.friction_share * section_.shear_stiffness() * slider_)};
}

std::vector<double> InterfaceByHand::kinks(const InterfacePlace &to) const {
  const double opened = to.opening - at_.opening, slipped = to.slip - at_.slip;
  std::vector<double> shares;
  const auto at = [&](double place, double from, double distance) {
    if (distance == 0 || !std::isfinite(place)) return;
    const double k = (place - from) / distance;
    if (k > 0 && k < 1) shares.push_back(k);
  };
  const auto opening = [&](double place) { at(place, at_.opening, opened); };
  const auto slip = [&](double place) { at(place, at_.slip, slipped); };
  if (combined_) {
    const SofteningByHand tension = section_.tension(), shear = section_.shear(0);
    const double per_n = 1 / tension.limit(), per_s = slip_ratio_ / shear.limit();
    const bool coupled = section_.law.parameters.failure_line == dem::FailureLine::coupled;
    const double un = 1 / (coupled ? per_n + per_s : per_n), us = 1 / (coupled ? per_n + per_s : per_s);
    const double end = std::min(un * (1 + tension.softening), us * (1 + shear.softening));
    for (const double place : {un, us, widest_, end * (1 - beside_failure), end * (1 + beside_failure)})
      opening(place);
  } else {
    const SofteningByHand tension = section_.tension(), shear = section_.shear(pressure());
    for (const auto &branch : section_.law.compression.branches)
      opening(-section_.closing_at(branch.limit));
    for (const double place : {tension.limit(), widest_, tension.end() * (1 - beside_failure),
                               tension.end() * (1 + beside_failure), 0.0})
      opening(place - plastic_);
    opening(-deepest_);
    for (const double place :
         {shear.limit(), farthest_, shear.end() * (1 - beside_failure), shear.end() * (1 + beside_failure)})
      for (const double side : {-1.0, 1.0})
        slip(side * place);
    const double stretch = section_.law.parameters.friction_dynamic * pressure() / section_.shear_stiffness();
    slip(at_.slip + std::copysign(stretch, slipped) - slider_);
  }
  std::sort(shares.begin(), shares.end());
  return shares;
}

void InterfaceByHand::go(const InterfacePlace &to) {
  const InterfacePlace from = at_;
  std::vector<double> ends = kinks(to);
  ends.push_back(1);
  for (const double end : ends) {
    const InterfaceLoad before = now_;
    const InterfacePlace last = at_;
    at_.opening = end < 1 ? from.opening + end * (to.opening - from.opening) : to.opening;
    at_.slip = end < 1 ? from.slip + end * (to.slip - from.slip) : to.slip;
    const double stretch = section_.law.parameters.friction_dynamic * pressure() / section_.shear_stiffness();
    slider_ = std::clamp(slider_ + at_.slip - last.slip, -stretch, stretch);
    update();
    work_ += 0.5 * ((before.normal + now_.normal) * (at_.opening - last.opening) +
                    (before.shear + now_.shear) * (at_.slip - last.slip));
  }
}

} // namespace platen::apps
