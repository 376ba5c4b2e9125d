#include "dem/integrator.h"

#include <algorithm>
#include <cmath>

#include "dem/parallel.h"

namespace platen::dem {
namespace {

struct Largest {
  double value = 0;
  Largest &operator+=(const Largest &b) {
    value = std::max(value, b.value);
    return *this;
  }
};

// Turns by dt w; Cayley's form needs no sine and is exact to (w dt)^3 / 12, the order of the scheme.
Quaternion turn(const Quaternion &q, const Vector3 &w, double dt) {
  const double h = 0.5 * dt;
  return normalised(Quaternion{1, h * w.x, h * w.y, h * w.z} * q);
}

// Local damping of one component; adds the work it takes out over the step.
void damp(double &force, double velocity, double alpha) {
  force -= std::copysign(alpha * std::abs(force), velocity);
}

// Local damping of one vector, then the half kick; returns the work lost in the step, which the leapfrog
// books at the full-step velocity.
double damp_and_kick(Vector3 &force, Vector3 &velocity, double alpha, double kick, double dt) {
  const Vector3 whole = force;
  damp(force.x, velocity.x, alpha);
  damp(force.y, velocity.y, alpha);
  damp(force.z, velocity.z, alpha);
  velocity += kick * force;
  return dot(whole - force, velocity) * dt;
}

} // namespace

Motion kick_and_drift(Particles &p, double dt, const Vector3 &gravity) {
  const bool turning = p.has_rotation(), heavy = norm_squared(gravity) > 0;
  const Largest fastest = ordered_sum<Largest>(p.size(), [&](std::size_t first, std::size_t last) {
    double square = 0;
    for (std::size_t i = first; i < last; ++i) {
      Vector3 &v = p.velocity[i];
      v += (0.5 * dt / p.mass[i]) * p.force[i];
      p.position[i] += dt * v;
      p.force[i] = heavy ? p.mass[i] * gravity : Vector3{};
      square = std::max(square, norm_squared(v));
    }
    if (turning)
      for (std::size_t i = first; i < last; ++i) {
        Vector3 &w = (*p.angular_velocity)[i];
        w += (0.5 * dt / (*p.inertia)[i]) * (*p.torque)[i];
        (*p.orientation)[i] = turn((*p.orientation)[i], w, dt);
        (*p.torque)[i] = {};
      }
    return Largest{std::sqrt(square)};
  });
  return {fastest.value};
}

KickSums gather_and_kick(Particles &p, const Bonds *bonds, double dt, double alpha, const Vector3 &gravity) {
  const bool turning = p.has_rotation();
  return ordered_sum<KickSums>(p.size(), [&](std::size_t first, std::size_t last) {
    KickSums sums;
    for (std::size_t i = first; i < last; ++i) {
      Vector3 force = p.force[i], torque = turning ? (*p.torque)[i] : Vector3{};
      if (bonds != nullptr)
        for (int e = bonds->incidence_offset[i]; e < bonds->incidence_offset[i + 1]; ++e) {
          const int entry = bonds->incidence[e], row = entry >> 1;
          if (entry & 1)
            force -= bonds->force[row];
          else
            force += bonds->force[row];
          if (turning) torque += entry & 1 ? (*bonds->torque_second)[row] : (*bonds->torque_first)[row];
        }
      sums.unbalanced += norm(force);
      sums.damping_work += damp_and_kick(force, p.velocity[i], alpha, 0.5 * dt / p.mass[i], dt);
      sums.kinetic_energy += 0.5 * p.mass[i] * norm_squared(p.velocity[i]);
      sums.weight_work += dt * p.mass[i] * dot(gravity, p.velocity[i]);
      p.force[i] = force;
      if (!turning) continue;
      Vector3 &w = (*p.angular_velocity)[i];
      const double inertia = (*p.inertia)[i];
      sums.damping_work += damp_and_kick(torque, w, alpha, 0.5 * dt / inertia, dt);
      sums.kinetic_energy += 0.5 * inertia * norm_squared(w);
      (*p.torque)[i] = torque;
    }
    return sums;
  });
}

double kinetic_energy(const Particles &p) {
  return ordered_sum<double>(p.size(), [&](std::size_t first, std::size_t last) {
    double sum = 0;
    for (std::size_t i = first; i < last; ++i) {
      sum += 0.5 * p.mass[i] * norm_squared(p.velocity[i]);
      if (p.has_rotation()) sum += 0.5 * (*p.inertia)[i] * norm_squared((*p.angular_velocity)[i]);
    }
    return sum;
  });
}

} // namespace platen::dem
