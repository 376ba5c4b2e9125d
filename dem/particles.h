// The particles of a specimen as columns. Row order is the spatial order; `id` is the order of the input.
#pragma once

#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/table.h"
#include "base/vector3.h"

namespace platen::dem {

struct Specimen;

// Between the drift and the second half kick, `velocity` and `angular_velocity` hold the values of the drift,
// with velocity Verlet those of the half step; after the kick they hold the full-step values (docs/theory.md,
// time integration).
struct Particles {
  Table table;
  Column<int> &id = table.add<int>("id", "1");
  Column<Vector3> &position = table.add<Vector3>("position", "m");
  Column<Vector3> &reference_position = table.add<Vector3>("reference_position", "m");
  Column<Vector3> &velocity = table.add<Vector3>("velocity", "m/s");
  Column<Vector3> &force = table.add<Vector3>("force", "N");
  Column<double> &radius = table.add<double>("radius", "m", above(0));
  Column<double> &mass = table.add<double>("mass", "kg", above(0));
  // Only where rotation is on; null otherwise.
  Column<Quaternion> *orientation = nullptr;
  Column<Vector3> *angular_velocity = nullptr; // rad/s, global axes
  Column<Vector3> *torque = nullptr;           // N m, about the centre, global axes
  Column<double> *inertia = nullptr;           // kg m^2, 2/5 m R^2
  Column<int> *phase = nullptr;                // Phase; only with phases
  // Only with a dissipative scheme: drift value minus half-step value; the second only with rotation.
  Column<Vector3> *excess_velocity = nullptr, *excess_spin = nullptr; // m/s, rad/s

  Particles() = default;
  // Spheres of one density (kg/m^3) at rest, in spatial (Morton) order.
  Particles(const Specimen &specimen, double density, bool rotation);
  Particles(const Particles &) = delete;
  Particles &operator=(const Particles &) = delete;

  std::size_t size() const { return table.size(); }
  bool has_rotation() const { return orientation != nullptr; }
  void add_rotation();
  void add_excess();
};

// Order of centres along a Morton curve through their bounding box: order[k] is the input row of row k.
std::vector<int> spatial_order(const std::vector<Vector3> &centres);

// m; 1 without particles.
inline double mean_radius(const Particles &particles) {
  const double sum = std::accumulate(particles.radius.begin(), particles.radius.end(), 0.0);
  return particles.size() == 0 ? 1.0 : sum / static_cast<double>(particles.size());
}

// Reduced value of two masses, inertias or radii that a spring joins.
inline double reduced(double a, double b) {
  return a * b / (a + b);
}

// Thrown if a search finds a centre that is not finite; Problem then names the particle.
class NotFinite : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

// Whether position, velocity and, with rotation, orientation and angular velocity are all finite.
bool motion_is_finite(const Particles &particles);

// Text that names the values that are not finite: "velocity of particle 17", "position, velocity of particles
// 3, 17 and 5 more". Ids are those of the input. Empty if all are finite. Checks every column of numbers.
std::string not_finite(const Particles &particles);

} // namespace platen::dem
