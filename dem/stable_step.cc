#include "dem/stable_step.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/lanczos.h"
#include "base/parallel.h"
#include "base/random.h"

namespace platen::dem {
namespace {

// A pair spring in general form: bonds carry moments, contacts do not.
struct PairSpring {
  std::size_t first, second;
  double lever; // contact point x_i + lever d
  double axial, shear, bending, twisting;
  Vector3 normal{}, arm_first{}, arm_second{}; // from the centres to the contact point
};

struct Mode {
  std::vector<Vector3> u, turn;
  explicit Mode(std::size_t n = 0, bool turning = false) : u(n), turn(turning ? n : 0) {}
};

double inner(const Mode &a, const Mode &b) {
  return ordered_sum<double>(a.u.size(), [&](std::size_t first, std::size_t last) {
    double s = 0;
    for (std::size_t i = first; i < last; ++i)
      s += dot(a.u[i], b.u[i]) + (a.turn.empty() ? 0.0 : dot(a.turn[i], b.turn[i]));
    return s;
  });
}

// a += s b
void add(Mode &a, double s, const Mode &b) {
  for_each(a.u.size(), [&](std::size_t i) {
    a.u[i] += s * b.u[i];
    if (!a.turn.empty()) a.turn[i] += s * b.turn[i];
  });
}

void multiply(Mode &a, double s) {
  for_each(a.u.size(), [&](std::size_t i) {
    a.u[i] *= s;
    if (!a.turn.empty()) a.turn[i] *= s;
  });
}

// Coefficient of a dashpot, from its parallel spring and the mass (or inertia) attached to it.
double dashpot(double fraction, double stiffness, double mass) {
  return 2 * fraction * std::sqrt(stiffness * mass);
}

enum class Matrix { stiffness, damping };

// Springs, or the dashpots that act along the same directions.
class Operator {
public:
  Operator(Matrix matrix, const Particles &p, const Bonds *bonds, const Contacts *contacts,
           const std::vector<GroundSpring> &ground, const DashpotFractions &dashpots)
      : p_(p), ground_(ground) {
    const bool damping = matrix == Matrix::damping;
    if (bonds != nullptr && !(damping && dashpots.bonds == 0)) add_bonds(*bonds, contacts);
    const std::size_t bonded = springs_.size();
    if (contacts != nullptr && !(damping && dashpots.contacts == 0)) add_contacts(*contacts);
    for (PairSpring &s : springs_) {
      const Vector3 d = p.position[s.second] - p.position[s.first];
      s.normal = d / norm(d), s.arm_first = s.lever * d, s.arm_second = s.arm_first - d;
    }
    if (damping) {
      for (std::size_t k = 0; k < springs_.size(); ++k)
        turn_into_dashpot(springs_[k], k < bonded ? dashpots.bonds : dashpots.contacts);
      if (dashpots.surfaces == 0) ground_.clear();
      for (GroundSpring &g : ground_) {
        g.normal_stiffness = dashpot(dashpots.surfaces, g.normal_stiffness, p.mass[g.particle]);
        g.tangential_stiffness = g.rotational_stiffness = 0;
      }
    }
    force_.resize(springs_.size());
    torque_first_.resize(p.has_rotation() ? springs_.size() : 0);
    torque_second_.resize(torque_first_.size());
    offset_.assign(p.size() + 1, 0);
    for (const PairSpring &s : springs_)
      ++offset_[s.first + 1], ++offset_[s.second + 1];
    for (std::size_t i = 0; i < p.size(); ++i)
      offset_[i + 1] += offset_[i];
    entry_.resize(2 * springs_.size());
    std::vector<std::size_t> next(offset_.begin(), offset_.end() - 1);
    for (std::size_t k = 0; k < springs_.size(); ++k) {
      entry_[next[springs_[k].first]++] = 2 * k;
      entry_[next[springs_[k].second]++] = 2 * k + 1;
    }
  }
  bool empty() const { return springs_.empty() && ground_.empty(); }
  bool turning() const { return p_.has_rotation(); }
  Mode apply(const Mode &x);

private:
  // A broken bond leaves a contact, which may be stiffer than the bond.
  void add_bonds(const Bonds &b, const Contacts *contacts) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      const BondStiffness s = b.stiffness(k);
      if (s.axial == 0.0) continue;
      const std::size_t i = static_cast<std::size_t>(b.first[k]), j = static_cast<std::size_t>(b.second[k]);
      const ContactStiffness after = contacts != nullptr
                                         ? contacts->stiffness_bound(p_, b.first[k], b.second[k], 0.0)
                                         : ContactStiffness{};
      springs_.push_back({i, j, b.lever[k], std::max(s.axial, after.normal),
                          std::max(s.shear, after.tangential), s.bending, s.twisting});
    }
  }
  // Pairs that touch, and those that are near enough to touch soon.
  void add_contacts(const Contacts &c) {
    for (std::size_t k = 0; k < c.table.size(); ++k) {
      const std::size_t i = static_cast<std::size_t>(c.first[k]), j = static_cast<std::size_t>(c.second[k]);
      const ContactStiffness stiffness = c.stiffness_bound(p_, c.first[k], c.second[k], c.overlap[k]);
      springs_.push_back(
          {i, j, p_.radius[i] / (p_.radius[i] + p_.radius[j]), stiffness.normal, stiffness.tangential, 0, 0});
    }
  }

  void turn_into_dashpot(PairSpring &s, double fraction) const {
    const double mass = reduced(p_.mass[s.first], p_.mass[s.second]);
    s.axial = dashpot(fraction, s.axial, mass);
    s.shear = dashpot(fraction, s.shear, mass);
    if (!p_.has_rotation()) return;
    const double inertia = reduced((*p_.inertia)[s.first], (*p_.inertia)[s.second]);
    s.bending = dashpot(fraction, s.bending, inertia);
    s.twisting = dashpot(fraction, s.twisting, inertia);
  }

  // M^-1/2
  void over_root_of_mass(Mode &x) const {
    for_each(p_.size(), [&](std::size_t i) {
      x.u[i] *= 1 / std::sqrt(p_.mass[i]);
      if (turning()) x.turn[i] *= 1 / std::sqrt((*p_.inertia)[i]);
    });
  }

  const Particles &p_;
  std::vector<GroundSpring> ground_;
  std::vector<PairSpring> springs_;
  std::vector<Vector3> force_, torque_first_, torque_second_;
  std::vector<std::size_t> offset_, entry_;
};

// y = M^-1/2 K M^-1/2 x, or with C for K
Mode Operator::apply(const Mode &x) {
  const bool with_turn = turning();
  Mode scaled = x;
  over_root_of_mass(scaled);
  for_each(springs_.size(), [&](std::size_t k) {
    const PairSpring &s = springs_[k];
    const Vector3 &n = s.normal, &ri = s.arm_first, &rj = s.arm_second;
    Vector3 u = scaled.u[s.second] - scaled.u[s.first];
    if (with_turn) u += cross(scaled.turn[s.second], rj) - cross(scaled.turn[s.first], ri);
    const double un = dot(u, n);
    force_[k] = s.axial * un * n + s.shear * (u - un * n);
    if (!with_turn) return;
    const Vector3 w = scaled.turn[s.second] - scaled.turn[s.first];
    const double wn = dot(w, n);
    const Vector3 moment = s.bending * (w - wn * n) + s.twisting * wn * n;
    torque_first_[k] = cross(ri, force_[k]) + moment;
    torque_second_[k] = -cross(rj, force_[k]) - moment;
  });
  Mode y(p_.size(), with_turn);
  for_each(p_.size(), [&](std::size_t i) {
    for (std::size_t e = offset_[i]; e < offset_[i + 1]; ++e) {
      const std::size_t k = entry_[e] / 2;
      const bool second = entry_[e] & 1;
      y.u[i] += second ? force_[k] : -force_[k];
      if (with_turn) y.turn[i] -= second ? torque_second_[k] : torque_first_[k];
    }
  });
  for (const GroundSpring &g : ground_) {
    const int i = g.particle;
    Vector3 u = scaled.u[i];
    if (with_turn) u += cross(scaled.turn[i], g.arm);
    const double un = dot(u, g.normal);
    const Vector3 force = g.normal_stiffness * un * g.normal + g.tangential_stiffness * (u - un * g.normal);
    y.u[i] += force;
    if (with_turn) y.turn[i] += cross(g.arm, force) + g.rotational_stiffness * scaled.turn[i];
  }
  over_root_of_mass(y);
  return y;
}

// The same start on every machine; it contains a part of every mode.
Mode start_mode(std::size_t n, bool turning) {
  std::uint64_t state = 0x9e3779b97f4a7c15ULL;
  const auto next = [&state] { return static_cast<double>(split_mix(state) >> 11) * 0x1.0p-52 - 1.0; };
  Mode x(n, turning);
  for (std::size_t i = 0; i < n; ++i) {
    for (int k = 0; k < 3; ++k)
      x.u[i][k] = next();
    if (turning)
      for (int k = 0; k < 3; ++k)
        x.turn[i][k] = next();
  }
  return x;
}

int largest_particle(const Mode &mode) {
  std::size_t best = 0;
  double most = -1;
  for (std::size_t i = 0; i < mode.u.size(); ++i) {
    const double a = norm_squared(mode.u[i]) + (mode.turn.empty() ? 0.0 : norm_squared(mode.turn[i]));
    if (a > most) most = a, best = i;
  }
  return static_cast<int>(best);
}

// Names of the springs that act on the particles.
std::string springs_of(const Bonds *bonds, const Contacts *contacts,
                       const std::vector<GroundSpring> &ground) {
  std::vector<std::string> parts;
  if (bonds != nullptr) parts.emplace_back("bonds");
  if (contacts != nullptr) parts.emplace_back("contacts");
  if (!ground.empty()) parts.emplace_back("platens");
  std::string text;
  for (std::size_t k = 0; k < parts.size(); ++k)
    text += (k == 0 ? "" : k + 1 == parts.size() ? " and " : ", ") + parts[k];
  return text;
}

} // namespace

// The dashpots use half-step velocities, so that the scheme is stable while dt^2 K + 2 dt C <= 4 M. With the
// largest eigenvalues of K and C taken separately (their sum is an upper bound) this is a quadratic equation
// for dt. A dashpot of fraction xi of a pair damps the highest mode of a network by more than xi, because
// that mode is faster than the pair. At the limit, where every step reverses the motion, the drift with a
// dissipation phi is that of (2 phi - 1) times the force, and both terms grow by this factor: (2 phi - 1)
// (dt^2 K + 2 dt C) <= 4 M.
StableStep stable_step(const Particles &particles, const Bonds *bonds, const Contacts *contacts,
                       const std::vector<GroundSpring> &ground, const DashpotFractions &dashpots,
                       double sought_below) {
  StableStep result;
  result.limit = std::numeric_limits<double>::infinity();
  result.reason = "nothing elastic in the scene limits the step";
  Operator stiffness(Matrix::stiffness, particles, bonds, contacts, ground, dashpots);
  if (particles.size() == 0 || stiffness.empty()) return result;
  // Accuracy 1 % of omega^2: the step is at most 0.5 % too small. The iteration stops earlier if omega^2 is
  // certainly below `enough`.
  const Mode start = start_mode(particles.size(), particles.has_rotation());
  const auto largest = [&](Operator &matrix, double enough) {
    LanczosLimits limits;
    limits.enough = enough;
    return largest_eigenvalue([&](const Mode &x) { return matrix.apply(x); }, start, limits);
  };
  Operator damping(Matrix::damping, particles, bonds, contacts, ground, dashpots);
  const double rate = damping.empty() ? 0.0 : largest(damping, 0).value; // 1/s
  const double holding = (1 + dashpots.local) * (2 * dashpots.scheme - 1), c = holding * rate;
  // The value of omega^2 at which the limit is sought_below.
  const double enough = (4 / sought_below - 2 * c) / (sought_below * holding);
  LargestEigenvalue<Mode> squared = largest(stiffness, enough);
  result.iterations = squared.iterations;
  result.omega = std::sqrt(squared.value);
  const double k = holding * squared.value;
  result.limit = (std::sqrt(c * c + 4 * k) - c) / k;
  result.reason = "2/omega of " + springs_of(bonds, contacts, ground);
  if (!(result.limit < sought_below)) return result;
  // A few more applications show the particle that sets the limit.
  Mode &x = squared.mode;
  for (int it = 0; it < 12; ++it) {
    x = stiffness.apply(x);
    multiply(x, 1 / std::sqrt(std::max(inner(x, x), 1e-300)));
  }
  result.particle_id = particles.id[largest_particle(x)];
  result.reason += ", highest mode at particle " + std::to_string(result.particle_id);
  return result;
}

} // namespace platen::dem
