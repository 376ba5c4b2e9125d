// A rigid body: it has six degrees of freedom, and its grid gives the surface and the picture. The machine
// prescribes all six, or only the translation of a spherical seat on which the body rotates freely. With a
// seat, the energy balance contains the rotational energy about the seat; the machine's work contains its
// work against the loads where the seat moves, and the change of that energy by jumps of the seat's velocity.
#pragma once

#include <vector>

#include "fem/body.h"
#include "fem/grids.h"
#include "fem/material.h"

namespace platen::fem {

class RigidBody : public Body {
public:
  // Throws std::invalid_argument where a constant is out of range or a surface face has no area (naming the
  // face).
  RigidBody(Grid grid, const Material &material);
  // On a spherical seat (m, its centre at the start), which the machine moves: the body rotates about it
  // under the moment of its loads. Coulomb friction of the ball holds it back by a moment of at most the
  // force of the loads times `friction_arm` (m), the coefficient of friction times the radius of the ball; 0:
  // none.
  RigidBody(Grid grid, const Material &material, const Vector3 &seat, double friction_arm = 0);

  const Material &material() const { return material_; }
  double volume() const { return volume_; }                            // m^3
  double mass() const override { return material_.density * volume_; } // kg

  // Motion about the centre of mass, or about the seat. With a seat the angular velocity is free, and the
  // first form keeps it.
  void set_velocity(const Vector3 &velocity) override;                         // m/s
  void set_velocity(const Vector3 &velocity, const Vector3 &angular_velocity); // m/s; rad/s, global axes
  void kick(double dt) override; // rotates a body on a seat, otherwise no effect
  // Moves every vertex over dt (s): the centre along a straight line, the rotation by its exponential, so
  // that the shape is kept to round-off for any dt. Loads do not change. On a seat, surface velocities are
  // then means over the path: displacement of each vertex divided by dt.
  void drift(double dt) override;
  const Vector3 &velocity() const override { return velocity_; }                 // m/s, of the centre
  const Vector3 &angular_velocity() const override { return angular_velocity_; } // rad/s
  const Vector3 &displacement() const override { return displacement_; }         // m, of the centre
  Vector3 centre() const { return pivot_ + displacement_; } // m, centre of mass, or of the seat
  // Unit quaternion (w, x, y, z) from reference axes to current ones.
  const Quaternion &rotation() const override { return rotation_; }
  bool turns() const override { return turns_; }
  // Upper bound of the displacement of any vertex in a drift over dt (m).
  double largest_move(double dt) const;
  double last_move() const override { return last_move_; } // m, that bound for the last drift

  double kinetic_energy() const; // J
  // s, for the rotation on a seat; infinite without one.
  double stable_step(const VertexSprings &springs) const override;
  EnergyBalance energy_balance() const override; // of the rotation only

  void describe(Archive &archive) override;

  Picture picture(const std::vector<double> &slip = {}) const override;

private:
  Vector3 current_position(const Vector3 &reference) const;
  void place_vertices();
  void find_inertia(const VolumeMoments &moments);
  // With a seat: rotational energy about it (J), and angular velocity from the angular momentum.
  double turning_energy() const { return 0.5 * dot(angular_velocity_, spin_); }
  void find_angular_velocity();
  void turn(double dt);
  void drift_on_seat(double dt);
  void hold_back(double impulse); // N m s, by friction of the seat at most

  Grid grid_;
  Material material_;
  std::vector<Vector3> reference_vertices_; // m, of the surface
  std::vector<int> grid_vertex_;            // of each surface vertex
  double volume_ = 0;
  Vector3 reference_centre_{}; // m, of mass
  bool turns_ = false;
  double friction_arm_ = 0;               // m
  Vector3 pivot_{};                       // m, centre of mass or seat at the start
  Matrix3 inertia_{}, inverse_inertia_{}; // kg m^2 about the pivot, reference axes; of a seat the inverse
  Vector3 arm_{};                         // kg m, first moment about the seat, reference axes

  Vector3 displacement_{}, velocity_{}, angular_velocity_{};
  Vector3 spin_{}; // kg m^2/s, angular momentum about a seat at rest
  Quaternion rotation_;
  double last_move_ = 0;
  double load_work_ = 0, clamp_work_ = 0, rubbed_ = 0; // J
};

} // namespace platen::fem
