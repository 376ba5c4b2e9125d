// A body that keeps its shape: it moves by six numbers, and its grid is there for its surface and for the
// picture. The machine gives all six, or, where the body turns by itself on a spherical seat, the three of
// the seat. Of one on a seat the energy balance holds what its turning stores about the seat; where that
// moves, the machine does its work against the loads, and what a jump of its velocity does to the turning.
#pragma once

#include <iosfwd>
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
  // On a spherical seat without friction (m, its centre at the start), which the machine moves: the body
  // turns about it under the moment of its loads.
  RigidBody(Grid grid, const Material &material, const Vector3 &seat);

  const Material &material() const { return material_; }
  double volume() const { return volume_; }                            // m^3
  double mass() const override { return material_.density * volume_; } // kg

  // Motion. A rigid body moves by six numbers about its centre of mass, or about its seat; there angular
  // velocities are its own, and the first form keeps them.
  void set_velocity(const Vector3 &velocity) override;                         // m/s
  void set_velocity(const Vector3 &velocity, const Vector3 &angular_velocity); // m/s; rad/s, global axes
  void kick(double dt) override; // the machine takes it; a seat turns
  // Moves every vertex over dt (s): the centre along a straight line, the rotation by its exponential, so
  // that the shape is kept to round-off for any dt. Loads stay as they are. On a seat surface velocities are
  // then those of the path, whose product with dt is what each vertex went.
  void drift(double dt) override;
  const Vector3 &velocity() const override { return velocity_; }                 // m/s, of the centre
  const Vector3 &angular_velocity() const override { return angular_velocity_; } // rad/s
  const Vector3 &displacement() const override { return displacement_; }         // m, of the centre
  Vector3 centre() const { return pivot_ + displacement_; } // m, centre of mass, or of the seat
  // Unit quaternion (w, x, y, z) from reference axes to current ones.
  const Quaternion &rotation() const override { return rotation_; }
  bool turns() const override { return turns_; }
  // Bound on how far any vertex moves in a drift over dt (m).
  double largest_move(double dt) const;
  double last_move() const override { return last_move_; } // m, that bound for the last drift

  double kinetic_energy() const; // J
  // s; of the seat's turning; infinite without one.
  double stable_step(const VertexSprings &springs) const override;
  EnergyBalance energy_balance() const override; // of the turning alone

  // Motion, velocities and loads.
  void describe(Archive &archive) override;

  void write_vtu(std::ostream &stream, const std::vector<double> &slip = {}) const override;

private:
  Vector3 current_position(const Vector3 &reference) const;
  void place_vertices();
  void find_inertia(const VolumeMoments &moments);
  // Of the seat: what the body's turning about it stores (J), and its rate of turning by its momentum.
  double turning_energy() const { return 0.5 * dot(angular_velocity_, spin_); }
  void find_angular_velocity();
  void turn(double dt);
  void drift_on_seat(double dt);

  Grid grid_;
  Material material_;
  std::vector<Vector3> reference_vertices_; // m, of the surface
  std::vector<int> grid_vertex_;            // of each surface vertex
  double volume_ = 0;
  Vector3 reference_centre_{}; // m, of mass
  bool turns_ = false;
  Vector3 pivot_{};                       // m, centre of mass or seat at the start
  Matrix3 inertia_{}, inverse_inertia_{}; // kg m^2 about the pivot, reference axes; of a seat the inverse
  Vector3 arm_{};                         // kg m, first moment about the seat, reference axes

  Vector3 displacement_{}, velocity_{}, angular_velocity_{};
  Vector3 spin_{}; // kg m^2/s, angular momentum about the seat, as if that stood
  Quaternion rotation_;
  double last_move_ = 0;
  double load_work_ = 0, clamp_work_ = 0; // J
};

} // namespace platen::fem
