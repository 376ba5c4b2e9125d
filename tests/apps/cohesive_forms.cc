#include "apps/cohesive_forms.h"

#include <algorithm>
#include <cmath>

#include "base/pi.h"

namespace platen::apps::testing {
namespace {

// Of the displacement of failure: rows stand on both of its sides. What turns is known less closely.
constexpr double beside_failure = 1e-9, beside_turned_failure = 1e-6;

// Share of the softening that is used up at a displacement so far.
double share(const SofteningByHand &of, double farthest) {
  return std::isfinite(of.limit()) ? of.damage(farthest / of.limit()) : 0;
}

} // namespace

CohesiveSection section_of(const dem::Bonds &bonds) {
  CohesiveSection s;
  s.length = bonds.rest_length[0], s.area = pi * bonds.bond_radius[0] * bonds.bond_radius[0];
  s.modulus = bonds.normal_stiffness[0] * s.length;
  const auto take = [&s](const auto &law) {
    s.tensile_strength = law.parameters.tensile_strength, s.shear_strength = law.parameters.shear_strength;
    s.compression = law.compression;
  };
  if (const auto *yielding = std::get_if<dem::YieldingParallelBond>(&bonds.law)) {
    take(*yielding);
    s.arms_at_rest = true;
    s.shear_ratio = yielding->parameters.stiffness_ratio;
    s.friction_static = std::tan(yielding->parameters.friction_angle);
    s.friction_dynamic = yielding->grain_friction;
    return s;
  }
  const auto &law = std::get<dem::ElastoDamagePlastic>(bonds.law);
  const dem::ElastoDamagePlastic::Parameters &p = law.parameters;
  take(law);
  s.shear_ratio = 0.5 / (1 + p.poisson_ratio);
  s.friction_static = p.friction_static, s.friction_dynamic = p.friction_dynamic;
  s.softening_tension = p.softening_tension, s.softening_shear = p.softening_shear;
  s.fracture_energy_tension = p.fracture_energy_tension, s.fracture_energy_shear = p.fracture_energy_shear;
  s.coupled = p.failure_line == dem::FailureLine::coupled;
  return s;
}

SofteningByHand CohesiveSection::tension() const {
  SofteningByHand s{dem::never_if_zero(tensile_strength), normal_stiffness(), softening_tension};
  if (fracture_energy_tension > 0)
    s.softening = 2 * fracture_energy_tension * s.stiffness / (s.strength * s.strength);
  return s;
}

SofteningByHand CohesiveSection::shear(double pressure) const {
  const double strength = dem::never_if_zero(shear_strength);
  SofteningByHand s{strength + friction_static * pressure, shear_stiffness(), softening_shear};
  if (fracture_energy_shear > 0)
    s.softening = 2 * fracture_energy_shear * s.stiffness / (strength * strength);
  return s;
}

double CohesiveSection::yield_stress(double closing) const {
  double at = 0, stress = 0, slope = normal_stiffness();
  for (const auto &branch : compression.branches) {
    const double next = at + (branch.limit - stress) / slope;
    if (closing <= next) break;
    at = next, stress = branch.limit, slope = normal_stiffness() / branch.slope;
  }
  return stress + slope * (closing - at);
}

double CohesiveSection::closing_at(double wanted) const {
  double at = 0, stress = 0, slope = normal_stiffness();
  for (const auto &branch : compression.branches) {
    if (wanted <= branch.limit) break;
    at += (branch.limit - stress) / slope;
    stress = branch.limit, slope = normal_stiffness() / branch.slope;
  }
  return at + (wanted - stress) / slope;
}

CohesiveByHand::CohesiveByHand(const CohesiveSection &section, bool combined, double slip_ratio)
    : section_(section), combined_(combined), slip_ratio_(slip_ratio) {}

double CohesiveByHand::pressure() const {
  return std::max(0.0, -section_.normal_stiffness() * (at_.opening + plastic_));
}

double CohesiveByHand::stretch() const {
  return section_.friction_dynamic * pressure() / section_.shear_stiffness();
}

// Both spheres have turned by slip/d, the arms at rest with them.
double CohesiveByHand::own_slip(double slip) const {
  if (!section_.arms_at_rest) return slip;
  return section_.length * std::sin(slip / (section_.length + at_.opening));
}

double CohesiveByHand::slip_of(double own) const {
  if (!section_.arms_at_rest) return own;
  return (section_.length + at_.opening) * std::asin(own / section_.length);
}

CohesiveByHand::Used CohesiveByHand::used() const {
  const SofteningByHand tension = section_.tension(), shear = section_.shear(0);
  const double n = widest_ / tension.limit(), s = slip_ratio_ * widest_ / shear.limit();
  if (section_.coupled) return {n + s, n + s};
  return {n, s};
}

double CohesiveByHand::tension_damage() const {
  const SofteningByHand tension = section_.tension();
  if (combined_) return tension.damage(used().tension);
  return share(tension, widest_);
}

double CohesiveByHand::shear_damage() const {
  if (combined_) return section_.shear(0).damage(used().shear);
  return share(section_.shear(pressure()), farthest_);
}

// Shares of stress that cohesion holds at the present opening and slip, and what friction adds.
CohesiveByHand::Stresses CohesiveByHand::stresses() const {
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
  // The moment of a force at these arms is what the energy gives: K u_s over the lever of the present
  // distance.
  const double lean = section_.arms_at_rest ? section_.length / (section_.length + at_.opening) : 1.0;
  const double turn = section_.arms_at_rest ? at_.slip / (section_.length + at_.opening) : 0.0;
  s.cohesion = ks * own_slip(at_.slip) * lean * std::cos(turn);
  if (ds > 0) s.cohesion = ds < 1 ? shear.strength * (1 - ds) * at_.slip / farthest_ : 0;
  s.friction_share = ds;
  return s;
}

double CohesiveByHand::stored() const {
  const Stresses s = stresses();
  const double friction = s.friction_share * section_.shear_stiffness() * slider_ * slider_;
  const double own = failed_ || !section_.arms_at_rest
                         ? s.cohesion * at_.slip
                         : section_.shear_stiffness() * own_slip(at_.slip) * own_slip(at_.slip);
  return 0.5 * section_.area * (s.normal * (at_.opening + plastic_) + own + friction);
}

void CohesiveByHand::update() {
  deepest_ = std::max(deepest_, -at_.opening);
  plastic_ = deepest_ - section_.yield_stress(deepest_) / section_.normal_stiffness();
  widest_ = std::max(widest_, at_.opening + plastic_);
  farthest_ = std::max(farthest_, std::abs(own_slip(at_.slip)));
  if (!failed_ && damage() >= 1) {
    failed_ = true;
    // What is brittle slides from the slip that it broke with.
    if (section_.shear(0).is_brittle()) slider_ = std::clamp(own_slip(at_.slip), -stretch(), stretch());
  }
  const Stresses s = stresses();
  now_ = {section_.area * s.normal,
          section_.area * (s.cohesion + s.friction_share * section_.shear_stiffness() * slider_)};
}

std::vector<double> CohesiveByHand::kinks(const CohesivePlace &to) const {
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
    const bool coupled = section_.coupled;
    const double un = 1 / (coupled ? per_n + per_s : per_n), us = 1 / (coupled ? per_n + per_s : per_s);
    const double end = std::min(un * (1 + tension.softening), us * (1 + shear.softening));
    if (!tension.is_brittle()) opening(un), opening(us); // else the bond may hold there, or not
    for (const double place : {widest_, end * (1 - beside_failure), end * (1 + beside_failure)})
      opening(place);
  } else {
    const SofteningByHand tension = section_.tension(), shear = section_.shear(pressure());
    for (const auto &branch : section_.compression.branches)
      opening(-section_.closing_at(branch.limit));
    if (!tension.is_brittle()) opening(tension.limit() - plastic_);
    for (const double place :
         {widest_, tension.end() * (1 - beside_failure), tension.end() * (1 + beside_failure), 0.0})
      opening(place - plastic_);
    opening(-deepest_);
    for (const double side : {-1.0, 1.0}) {
      if (!shear.is_brittle()) slip(slip_of(side * shear.limit()));
      const double beside = section_.arms_at_rest ? beside_turned_failure : beside_failure;
      for (const double place : {farthest_, shear.end() * (1 - beside), shear.end() * (1 + beside)})
        slip(slip_of(side * place));
    }
    slip(at_.slip + std::copysign(stretch(), slipped) - slider_);
  }
  std::sort(shares.begin(), shares.end());
  return shares;
}

void CohesiveByHand::go(const CohesivePlace &to) {
  const CohesivePlace from = at_;
  std::vector<double> ends = kinks(to);
  ends.push_back(1);
  for (const double end : ends) {
    const CohesiveLoad before = now_;
    const CohesivePlace last = at_;
    at_.opening = end < 1 ? from.opening + end * (to.opening - from.opening) : to.opening;
    at_.slip = end < 1 ? from.slip + end * (to.slip - from.slip) : to.slip;
    slider_ = std::clamp(slider_ + at_.slip - last.slip, -stretch(), stretch());
    update();
    work_ += 0.5 * ((before.normal + now_.normal) * (at_.opening - last.opening) +
                    (before.shear + now_.shear) * (at_.slip - last.slip));
  }
}

} // namespace platen::apps::testing
