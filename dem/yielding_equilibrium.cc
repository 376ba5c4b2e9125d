#include "dem/yielding_equilibrium.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/pi.h"

namespace platen::dem {
namespace {

using State = YieldingParallelBond::State<double>;

Rotation<double> rotation(const Quaternion &q) {
  return {q.w, q.x, q.y, q.z};
}
Vector3 vector(const Triple<double> &a) {
  return {a.x, a.y, a.z};
}

// Displacements and rotations of all particles since the last state of rest.
struct Displacements {
  std::vector<Vector3> displacement, turn; // m, rad
  explicit Displacements(std::size_t particles) : displacement(particles), turn(particles) {}
  Displacements ahead(const StaticState &by, double fraction) const {
    Displacements next = *this;
    for (std::size_t i = 0; i < displacement.size(); ++i) {
      next.displacement[i] += fraction * by.displacement[i];
      next.turn[i] += fraction * by.turn[i];
    }
    return next;
  }
};

// Unbalanced forces on every particle: external forces plus bond forces.
struct Forces {
  std::vector<Vector3> force, torque; // N, N m
};

class Increment {
public:
  Increment(const Particles &p, const Bonds &b, const StaticCase &load)
      : p_(p), b_(b), law_(std::get<YieldingParallelBond>(b.law)), load_(load), prescribed_(p.size(), 0) {
    for (const PrescribedMotion &m : load.prescribed)
      prescribed_[static_cast<std::size_t>(m.particle)] = 1;
    for (std::size_t k = 0; k < b.size(); ++k)
      states_.push_back(b.memory<State>(k));
  }

  CohesiveGeometry<double> geometry(std::size_t k) const {
    const double radius = b_.bond_radius[k];
    CohesiveGeometry<double> g{b_.rest_length[k], b_.lever[k], b_.normal_stiffness[k], pi * radius * radius};
    if (b_.strength_factor != nullptr) g.strength_factor = (*b_.strength_factor)[k];
    g.reference = triple(b_.reference[k]);
    g.radius = radius;
    return g;
  }
  CohesiveMotion<double> motion(std::size_t k, const Displacements &moved) const {
    const auto i = static_cast<std::size_t>(b_.first[k]), j = static_cast<std::size_t>(b_.second[k]);
    const Vector3 by = moved.displacement[j] - moved.displacement[i];
    const Vector3 d = p_.position[j] - p_.position[i] + by;
    const Quaternion unturned{1, 0, 0, 0};
    const auto turned = [&](std::size_t at) {
      return rotation(p_.has_rotation() ? rotation_quaternion(moved.turn[at]) * (*p_.orientation)[at]
                                        : unturned);
    };
    const Vector3 arms = b_.lever[k] * moved.turn[i] + (1 - b_.lever[k]) * moved.turn[j];
    CohesiveMotion<double> m{};
    m.distance = triple(d), m.travelled = triple(by);
    m.moved = triple(by + cross(d - 0.5 * by, arms));
    m.spun_along = 0.5 * dot(moved.turn[i] + moved.turn[j], d);
    m.turn_i = turned(i), m.turn_j = turned(j);
    m.turned_i = triple(moved.turn[i]), m.turned_j = triple(moved.turn[j]);
    return m;
  }

  // Sums in the order of rows. `outside`: N, magnitude of loads and of forces on prescribed particles.
  Forces unbalanced(const Displacements &moved, double &outside) const {
    Forces sum{load_.force, load_.torque};
    sum.force.resize(p_.size()), sum.torque.resize(p_.size());
    double square = 0;
    for (std::size_t i = 0; i < p_.size(); ++i)
      if (!prescribed_[i]) square += size(i, sum);
    for (std::size_t k = 0; k < b_.size(); ++k) {
      State s = states_[k];
      const CohesiveResponse<double> r = law_(s, geometry(k), motion(k, moved));
      const auto i = static_cast<std::size_t>(b_.first[k]), j = static_cast<std::size_t>(b_.second[k]);
      sum.force[i] += vector(r.force), sum.force[j] -= vector(r.force);
      sum.torque[i] += vector(r.torque_i), sum.torque[j] += vector(r.torque_j);
    }
    for (std::size_t i = 0; i < p_.size(); ++i)
      if (prescribed_[i]) {
        square += size(i, sum);
        sum.force[i] = sum.torque[i] = {};
      } else if (!p_.has_rotation()) {
        sum.torque[i] = {};
      }
    outside = std::sqrt(square);
    return sum;
  }
  double size(const Forces &of) const {
    double square = 0;
    for (std::size_t i = 0; i < p_.size(); ++i)
      square += size(i, of);
    return std::sqrt(square);
  }
  // J, work of these forces over a displacement.
  double work(const Forces &of, const StaticState &by) const {
    double sum = 0;
    for (std::size_t i = 0; i < p_.size(); ++i)
      sum += dot(of.force[i], by.displacement[i]) + dot(of.torque[i], by.turn[i]);
    return sum;
  }

  std::vector<BondStiffness> tangents(const Displacements &moved) const {
    std::vector<BondStiffness> rows(b_.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      rows[k] = law_.tangent(states_[k], geometry(k), motion(k, moved));
    return rows;
  }
  StaticState correction(const Displacements &moved, const Forces &of, bool first,
                         const StaticSettings &settings) const {
    StaticCase step;
    step.force = of.force, step.torque = of.torque;
    step.prescribed = load_.prescribed;
    if (!first)
      for (PrescribedMotion &m : step.prescribed)
        m.displacement = m.turn = {};
    StaticState s = EquilibriumSolver(p_, b_, tangents(moved)).solve(step, settings);
    s.turn.resize(p_.size());
    return s;
  }

  // Bond histories there; throws if a bond breaks.
  std::vector<State> states(const Displacements &moved) const {
    std::vector<State> then = states_;
    for (std::size_t k = 0; k < then.size(); ++k) {
      law_(then[k], geometry(k), motion(k, moved));
      if (then[k].broken > states_[k].broken)
        throw NoEquilibrium("the bond of particles " + std::to_string(p_.id[b_.first[k]]) + " and " +
                            std::to_string(p_.id[b_.second[k]]) +
                            " would break: what it sets free is for an explicit run");
    }
    return then;
  }

private:
  double size(std::size_t i, const Forces &of) const { // N^2
    return norm_squared(of.force[i]) + norm_squared(of.torque[i]) / (p_.radius[i] * p_.radius[i]);
  }

  const Particles &p_;
  const Bonds &b_;
  const YieldingParallelBond &law_;
  const StaticCase &load_;
  std::vector<char> prescribed_;
  std::vector<State> states_; // at rest
};

// Fraction of a correction to apply: 1, or about where its work is zero if forces then act against it.
double fraction_of(const Increment &problem, const Displacements &moved, const StaticState &by,
                   double work_before) {
  double fraction = 1, low = 0, high = 1, at_low = work_before, outside = 0;
  for (int trial = 0; trial < 8; ++trial) {
    const double work = problem.work(problem.unbalanced(moved.ahead(by, fraction), outside), by);
    if (work > -0.5 * work_before && (fraction < 1 ? std::abs(work) < 0.5 * work_before : true))
      return fraction;
    if (work > 0)
      low = fraction, at_low = work;
    else
      high = fraction;
    fraction = work > 0 ? 0.5 * (low + high) : low + (high - low) * std::max(0.1, at_low / (at_low - work));
  }
  return fraction;
}

} // namespace

YieldingStep settle(Particles &p, Bonds &b, const StaticCase &load, const YieldingSettings &settings) {
  if (!std::holds_alternative<YieldingParallelBond>(b.law))
    throw std::invalid_argument("static increments are for yielding parallel bonds");
  if (!load.supports.empty()) throw std::invalid_argument("static increments take no supports");
  require_fitting(p, load);
  const Increment problem(p, b, load);
  Displacements moved(p.size());
  YieldingStep step;
  double outside = 0;
  Forces rest = problem.unbalanced(moved, outside);
  for (;; ++step.solves) {
    const bool first = step.solves == 0;
    if (!first) {
      rest = problem.unbalanced(moved, outside);
      step.residual = outside > 0 ? problem.size(rest) / outside : 0;
      if (step.residual <= settings.tolerance) break;
    }
    if (step.solves == settings.most_solves)
      throw NoEquilibrium("the static increment stopped at a residual of " + std::to_string(step.residual) +
                          " of its loads after " + std::to_string(step.solves) + " solves");
    const StaticState by = problem.correction(moved, rest, first, settings.linear);
    moved = moved.ahead(by, first ? 1 : fraction_of(problem, moved, by, problem.work(rest, by)));
  }
  const std::vector<State> then = problem.states(moved);
  for (std::size_t k = 0; k < then.size(); ++k)
    b.set_memory(k, then[k]);
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.position[i] += moved.displacement[i];
    if (p.has_rotation())
      (*p.orientation)[i] = normalised(rotation_quaternion(moved.turn[i]) * (*p.orientation)[i]);
  }
  step.moved.displacement = std::move(moved.displacement), step.moved.turn = std::move(moved.turn);
  step.moved.iterations = step.solves, step.moved.residual = step.residual;
  return step;
}

} // namespace platen::dem
