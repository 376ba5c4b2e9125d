#include "dem/large_rotations.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "dem/statics/conjugate_gradients.h"
#include "dem/statics/tangent.h"

namespace platen::dem {
namespace {

constexpr double most_turn = 0.3; // rad, of a particle in one iteration
constexpr int most_halves = 6;    // of an iteration that makes the residual larger
constexpr double linear_tolerance = 1e-8;
constexpr int most_linear = 2000;
constexpr double growth = 1.5; // of load steps that converge
constexpr double position_digits = 4 * 2.2e-16;

Vector3 vector(const Triple<double> &a) {
  return {a.x, a.y, a.z};
}
// Rotation vector of a unit quaternion.
Vector3 turn_of(const Quaternion &q) {
  const Vector3 v{q.x, q.y, q.z};
  const double s = norm(v);
  if (s == 0) return {};
  return (2 * std::atan2(q.w < 0 ? -s : s, std::abs(q.w)) / s) * v;
}
class Newton {
public:
  Newton(Particles &p, const Bonds &b, const StaticCase &load, const LargeSettings &settings)
      : p_(p), b_(b), load_(load), settings_(settings), held_(p.size(), 0) {
    start_ = state();
    for (const Led &l : load.led)
      held_[static_cast<std::size_t>(l.particle)] = 1;
    std::vector<char> bound(p.size(), 0);
    for (std::size_t k = 0; k < b.size(); ++k)
      if (b.stiffness(k).axial > 0)
        bound[static_cast<std::size_t>(b.first[k])] = bound[static_cast<std::size_t>(b.second[k])] = 1;
    for (const Support &s : load.supports)
      bound[static_cast<std::size_t>(s.spring.particle)] = 1;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (!bound[i]) held_[i] = 1;
  }

  LargeResult operator()() {
    double share = 0, step = 1.0 / settings_.load_steps;
    while (share < 1) {
      const std::vector<Place> before = state();
      const double next = std::min(1.0, share + step);
      if (settle(next)) {
        share = next;
        step *= growth;
        ++result_.load_steps;
        continue;
      }
      put(before);
      step *= 0.5;
      if (step < settings_.smallest_step)
        throw NoEquilibrium("no equilibrium was found beyond " + std::to_string(share) +
                            " of the loads; the residual stayed at " + std::to_string(result_.residual));
    }
    return result_;
  }

private:
  struct Place {
    Vector3 position;
    Quaternion orientation;
  };
  std::vector<Place> state() const {
    std::vector<Place> s(p_.size());
    for (std::size_t i = 0; i < p_.size(); ++i)
      s[i] = {p_.position[i], (*p_.orientation)[i]};
    return s;
  }
  void put(const std::vector<Place> &s) {
    for (std::size_t i = 0; i < p_.size(); ++i)
      p_.position[i] = s[i].position, (*p_.orientation)[i] = s[i].orientation;
  }

  // Newton's iterations at this share of the case; false where they do not converge.
  bool settle(double share) {
    for (const Led &l : load_.led) {
      const std::size_t i = static_cast<std::size_t>(l.particle);
      p_.position[i] = start_[i].position + share * l.displacement;
      (*p_.orientation)[i] = normalised(rotation_quaternion(share * l.turn) * start_[i].orientation);
    }
    std::vector<double> r(6 * p_.size());
    double now = residual(share, r);
    for (int it = 0; it < settings_.most_iterations; ++it) {
      if (now <= settings_.tolerance + round_off_) return true;
      if (!std::isfinite(now)) return false;
      const std::vector<Place> before = state();
      const std::vector<double> x = correction(r);
      if (x.empty()) return false;
      double factor = 1;
      for (std::size_t i = 0; i < p_.size(); ++i) {
        const double way = norm(Vector3{x[6 * i + 3], x[6 * i + 4], x[6 * i + 5]}),
                     most = most_turn * p_.radius[i];
        if (factor * way > most) factor = most / way;
      }
      // A step that is right at last may make the residual larger first: axial springs are far stiffer.
      const double was = now;
      for (int half = 0; half <= most_halves; ++half, factor *= 0.5) {
        put(before);
        move(x, factor);
        now = residual(share, r);
        if (now < 10 * was || now < 1) break;
      }
      ++result_.iterations;
    }
    return now <= settings_.tolerance + round_off_;
  }

  void move(const std::vector<double> &x, double factor) {
    for (std::size_t i = 0; i < p_.size(); ++i) {
      const double *u = &x[6 * i];
      p_.position[i] += factor * Vector3{u[0], u[1], u[2]};
      Quaternion &q = (*p_.orientation)[i];
      q = normalised(rotation_quaternion((factor / p_.radius[i]) * Vector3{u[3], u[4], u[5]}) * q);
    }
  }

  // Unbalanced forces, and torques over the radius; returns their size over that of the loads.
  double residual(double share, std::vector<double> &r) {
    std::fill(r.begin(), r.end(), 0.0);
    const auto add = [&](std::size_t i, const Vector3 &force, const Vector3 &torque) {
      double *to = &r[6 * i];
      const Vector3 t = torque / p_.radius[i];
      to[0] += force.x, to[1] += force.y, to[2] += force.z, to[3] += t.x, to[4] += t.y, to[5] += t.z;
    };
    double loads = 0, bonds = 0, noise = 0;
    for (std::size_t k = 0; k < b_.size(); ++k) {
      if (b_.stiffness(k).axial == 0) continue;
      const double blur = b_.stiffness(k).axial * norm(p_.position[static_cast<std::size_t>(b_.first[k])]);
      noise += blur * blur;
      const BondResponse<double> a = b_.response(k, p_);
      add(static_cast<std::size_t>(b_.first[k]), vector(a.force), vector(a.torque_i));
      add(static_cast<std::size_t>(b_.second[k]), -vector(a.force), vector(a.torque_j));
      bonds += norm_squared(vector(a.force)) +
               norm_squared(vector(a.torque_i) / p_.radius[static_cast<std::size_t>(b_.first[k])]);
    }
    for (const Support &s : load_.supports)
      pull(s, share, add);
    for (std::size_t i = 0; i < p_.size(); ++i) {
      const Vector3 f = load_.force.empty() ? Vector3{} : share * load_.force[i],
                    t = load_.torque.empty() ? Vector3{} : share * load_.torque[i];
      loads += norm_squared(f) + norm_squared(t / p_.radius[i]);
      add(i, f, t);
      if (held_[i]) std::fill_n(&r[6 * i], 6, 0.0);
    }
    double sum = 0;
    for (const double a : r)
      sum += a * a;
    const double scale = std::max(loads, bonds);
    round_off_ = scale > 0 ? position_digits * std::sqrt(noise / scale) : 0;
    return result_.residual = scale > 0 ? std::sqrt(sum / scale) : (sum > 0 ? 1.0 : 0.0);
  }

  // The arm of a support as it has turned with its particle since the start.
  Vector3 arm_of(const Support &s) const {
    const std::size_t i = static_cast<std::size_t>(s.spring.particle);
    return rotate((*p_.orientation)[i] * conjugate(start_[i].orientation), s.spring.arm);
  }
  template <class Add>
  void pull(const Support &support, double share, const Add &add) const {
    const GroundSpring &s = support.spring;
    const std::size_t i = static_cast<std::size_t>(s.particle);
    const Vector3 arm = arm_of(support);
    const Vector3 u = share * support.moved - (p_.position[i] + arm - start_[i].position - s.arm);
    const double along = dot(u, s.normal);
    const Vector3 force =
        s.tangential_stiffness * (u - along * s.normal) + (s.normal_stiffness * along) * s.normal;
    const Vector3 turn = turn_of((*p_.orientation)[i] * conjugate(start_[i].orientation));
    add(i, force, cross(arm, force) - s.rotational_stiffness * turn);
  }

  // By the tangent, or where that is not positive by the stiffness of the bonds without their forces; empty
  // where neither helps.
  std::vector<double> correction(const std::vector<double> &r) const {
    for (const bool exact : {true, false}) {
      statics::BlockRows<6, double> k = statics::assemble<6>(p_.size(), b_, [&](std::size_t row) {
        return exact ? statics::tangent_stiffness(p_, b_, row) : statics::material_stiffness<6>(p_, b_, row);
      });
      for (const Support &s : load_.supports) {
        GroundSpring now = s.spring;
        now.arm = arm_of(s);
        const std::size_t i = static_cast<std::size_t>(now.particle);
        for (std::size_t e = k.begin[i]; e < k.begin[i + 1]; ++e)
          if (static_cast<std::size_t>(k.column[e]) == i) statics::add_support<6>(p_, now, k.at(e));
      }
      statics::Multigrid<6> multigrid(k, {p_.position.begin(), p_.position.end()},
                                      {p_.radius.begin(), p_.radius.end()}, held_);
      std::vector<double> x(r.size(), 0.0);
      const statics::Solution s =
          statics::conjugate_gradients(k, multigrid, held_, r, x, linear_tolerance, most_linear);
      if (s.residual <= linear_tolerance) return x;
    }
    return {};
  }

  Particles &p_;
  const Bonds &b_;
  const StaticCase &load_;
  const LargeSettings &settings_;
  std::vector<char> held_;
  std::vector<Place> start_;
  LargeResult result_;
  double round_off_ = 0; // of the residual, by that of positions
};

} // namespace

LargeResult solve_static_far(Particles &p, const Bonds &b, const StaticCase &load,
                             const LargeSettings &settings) {
  if (!p.has_rotation()) throw std::invalid_argument("large rotations need particles that turn");
  if ((!load.force.empty() && load.force.size() != p.size()) ||
      (!load.torque.empty() && load.torque.size() != p.size()) || settings.load_steps < 1)
    throw std::invalid_argument("static loads need one row per particle, and at least one step");
  const LargeResult result = Newton(p, b, load, settings)();
  place_at_rest(p, b);
  return result;
}

void move_to(const StaticState &state, Particles &p, const Bonds &b) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.position[i] += state.displacement[i];
    if (!p.has_rotation()) continue;
    Quaternion &q = (*p.orientation)[i];
    q = normalised(rotation_quaternion(state.turn[i]) * q);
  }
  place_at_rest(p, b);
}

void place_at_rest(Particles &p, const Bonds &b) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.velocity[i] = p.force[i] = {};
    if (p.has_rotation()) (*p.angular_velocity)[i] = (*p.torque)[i] = {};
  }
  for (std::size_t k = 0; k < b.size(); ++k) {
    if (b.stiffness(k).axial == 0) continue;
    const std::size_t i = static_cast<std::size_t>(b.first[k]), j = static_cast<std::size_t>(b.second[k]);
    const BondResponse<double> a = b.response(k, p);
    p.force[i] += vector(a.force);
    p.force[j] -= vector(a.force);
    if (!p.has_rotation()) continue;
    (*p.torque)[i] += vector(a.torque_i);
    (*p.torque)[j] += vector(a.torque_j);
  }
}

} // namespace platen::dem
