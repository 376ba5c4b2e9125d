// A body that keeps its shape: it moves by six numbers, and its grid is there for its surface and for the
// picture.
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

  const Material &material() const { return material_; }
  double volume() const { return volume_; }                            // m^3
  double mass() const override { return material_.density * volume_; } // kg

  // Motion. A rigid body moves by six numbers about its centre of mass.
  void set_velocity(const Vector3 &velocity) override { set_velocity(velocity, Vector3{}); } // m/s
  void set_velocity(const Vector3 &velocity, const Vector3 &angular_velocity); // m/s; rad/s, global axes
  void kick(double) override {}                                                // the machine takes it
  // Moves every vertex over dt (s): the centre along a straight line, the rotation by its exponential, so
  // that the shape is kept to round-off for any dt. Loads stay as they are.
  void drift(double dt) override;
  const Vector3 &velocity() const override { return velocity_; }         // m/s, of the centre
  const Vector3 &angular_velocity() const { return angular_velocity_; }  // rad/s
  const Vector3 &displacement() const override { return displacement_; } // m, of the centre
  Vector3 centre() const { return reference_centre_ + displacement_; }   // m, centre of mass
  // Unit quaternion (w, x, y, z) from reference axes to current ones.
  const Quaternion &rotation() const { return rotation_; }
  // Bound on how far any vertex moves in a drift over dt (m).
  double largest_move(double dt) const;
  double last_move() const override { return last_move_; } // m, that bound for the last drift

  double kinetic_energy() const;                                   // J
  double stable_step(const VertexSprings &springs) const override; // s; infinite
  EnergyBalance energy_balance() const override { return {}; }

  // Motion, velocities and loads.
  void describe(Archive &archive) override;

  void write_vtu(std::ostream &stream, const std::vector<double> &slip = {}) const override;

private:
  Vector3 current_position(const Vector3 &reference) const;
  void place_vertices();

  Grid grid_;
  Material material_;
  std::vector<Vector3> reference_vertices_; // m, of the surface
  std::vector<int> grid_vertex_;            // of each surface vertex
  double volume_ = 0;
  Vector3 reference_centre_{};
  Matrix3 inertia_{}; // kg m^2 about the centre, reference axes

  Vector3 displacement_{}, velocity_{}, angular_velocity_{};
  Quaternion rotation_;
  double last_move_ = 0;
};

} // namespace platen::fem
