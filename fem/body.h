// A body of finite elements that meets the particles with its surface: a rigid platen.
// Callers see a surface, loads on its vertices and a few numbers; what happens inside is the kind's own
// affair.
#pragma once

#include <array>
#include <iosfwd>
#include <vector>

#include "fem/grids.h"
#include "fem/loaded_surface.h"
#include "fem/material.h"

namespace platen::fem {

enum class BodyKind { rigid };

class Body : public LoadedSurface {
public:
  // Throws std::invalid_argument where a constant is out of range or a surface face has no area (naming the
  // face).
  Body(Grid grid, const Material &material, BodyKind kind = BodyKind::rigid);

  BodyKind kind() const { return kind_; }
  const Material &material() const { return material_; }
  double volume() const { return volume_; }                   // m^3
  double mass() const { return material_.density * volume_; } // kg

  // Motion. A rigid body moves by six numbers about its centre of mass.
  void set_velocity(const Point &velocity) { set_velocity(velocity, Point{}); } // m/s
  void set_velocity(const Point &velocity, const Point &angular_velocity);      // m/s; rad/s, global axes
  // Moves every vertex over dt (s): the centre along a straight line, the rotation by its exponential, so
  // that the shape is kept to round-off for any dt. Loads stay as they are.
  void drift(double dt);
  const Point &velocity() const { return velocity_; }                 // m/s, of the centre
  const Point &angular_velocity() const { return angular_velocity_; } // rad/s
  const Point &displacement() const { return displacement_; }         // m, of the centre
  Point centre() const { return reference_centre_ + displacement_; }  // m, centre of mass
  // Unit quaternion (w, x, y, z) from reference axes to current ones.
  const std::array<double, 4> &rotation() const { return rotation_; }
  // Bound on how far any vertex moves in a drift over dt (m).
  double largest_move(double dt) const;

  double kinetic_energy() const;  // J
  double internal_energy() const; // J; a rigid body stores none
  double stable_step() const;     // s; infinite for a rigid body

  // Everything that changes in a run, to the last bit: motion, velocities and loads.
  std::vector<double> state() const;
  // Throws std::invalid_argument where the numbers are not those of a body with this surface.
  void set_state(const std::vector<double> &numbers);

  // Writes the grid where it is now as VTU (binary, zlib) with point data displacement (m), contact_pressure
  // and contact_shear (Pa, as contact_tractions) and slip (m; one value per surface vertex, or an empty
  // vector for zero).
  void write_vtu(std::ostream &stream, const std::vector<double> &slip = {}) const;

private:
  Point current_position(const Point &reference) const;
  void place_vertices();

  Grid grid_;
  Material material_;
  BodyKind kind_;
  std::vector<Point> reference_vertices_; // m, of the surface
  std::vector<int> grid_vertex_;          // of each surface vertex
  double volume_ = 0;
  Point reference_centre_{};
  std::array<double, 9> inertia_{}; // kg m^2 about the centre, reference axes

  Point displacement_{}, velocity_{}, angular_velocity_{};
  std::array<double, 4> rotation_{1, 0, 0, 0};
};

} // namespace platen::fem
