// A body of finite elements that a machine moves and that meets the particles with its surface: a platen.
// Callers see a surface, loads on its vertices and a few numbers; what happens inside is the kind's own
// affair. One step of the particles is kick(dt / 2), drift(dt), new loads, kick(dt / 2).
#pragma once

#include <iosfwd>
#include <vector>

#include "fem/surface.h"

namespace platen::fem {

// Energies of a body and what it exchanged since the start (J): kinetic + strain + dissipated + unbalanced -
// load_work - clamp_work stays what it was. A rigid body keeps no energy balance: where its loads do work,
// the machine does it.
struct EnergyBalance {
  // Explicit: the product of velocities half a step apart over two, which central differences keep exactly.
  double kinetic = 0;
  double strain = 0;
  double load_work = 0;  // by loads on the surface
  double clamp_work = 0; // by the machine
  double dissipated = 0; // by damping
  // Quasi-static: what the loads did on its deformation less the strain energy that it has, of either sign.
  // It is what the body is behind its loads.
  double unbalanced = 0;
};

// What contacts add at each vertex of the surface, for the stable step.
struct VertexSprings {
  std::vector<double> stiffness; // N/m
  std::vector<double> dashpot;   // N s/m
  double clamp = 0;              // N/m, of what pushes a clamp that slides
};

class Body : public LoadedSurface {
public:
  virtual ~Body() = default;
  Body(const Body &) = default;
  Body(Body &&) = default;
  Body &operator=(const Body &) = default;
  Body &operator=(Body &&) = default;

  virtual double mass() const = 0; // kg

  // How the machine moves the body, without turning it: its clamp, or all of it where it is rigid.
  virtual void set_velocity(const Vector3 &velocity) = 0; // m/s
  virtual const Vector3 &velocity() const = 0;            // m/s, of the centre of the frame that is moved
  virtual const Vector3 &displacement() const = 0;        // m, of the same
  // How that frame has turned since the start, and how fast it turns (rad/s, global axes).
  virtual const Quaternion &rotation() const = 0;
  virtual const Vector3 &angular_velocity() const = 0;
  virtual bool turns() const { return false; } // by itself, on a seat that the machine moves

  virtual void kick(double dt) = 0;  // impulse of the loads over dt (s)
  virtual void drift(double dt) = 0; // moves everything over dt (s); loads stay as they are
  // m, the farthest that a vertex went in the last drift, or a bound of it.
  virtual double last_move() const = 0;
  // s, the longest step between kicks that keeps the body stable on these springs, which the particles' side
  // holds at rest; infinite where nothing limits it.
  virtual double stable_step(const VertexSprings &springs) const = 0;

  // Of each face of the surface, how the mesh yields locally under a single force; empty for a body whose
  // mesh does not.
  virtual std::vector<FaceCompliance> face_compliance() const { return {}; }

  virtual EnergyBalance energy_balance() const = 0;

  // Everything that changes in a run.
  virtual void describe(Archive &archive) = 0;

  // Writes the grid where it is now as VTU (binary, zlib) with point data displacement (m), contact_pressure
  // and contact_shear (Pa, as contact_tractions) and slip (m; one value per surface vertex, or an empty
  // vector for zero); a deformable one adds stress and von_mises (Pa).
  virtual void write_vtu(std::ostream &stream, const std::vector<double> &slip) const = 0;

protected:
  Body() = default;
};

} // namespace platen::fem
