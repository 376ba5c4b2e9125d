// A finite-element body that a machine moves and whose surface touches the particles: a platen. Callers use a
// surface, loads on its vertices and a few numbers; derived classes define the rest. One step of the
// particles is kick(dt / 2), drift(dt), new loads, kick(dt / 2).
#pragma once

#include <vector>

#include "fem/picture.h"
#include "fem/surface.h"

namespace platen::fem {

// Energies of a body and energy exchanged since the start (J): kinetic + strain + dissipated + plastic +
// rubbed + unbalanced - load_work - clamp_work is constant. A rigid body without a seat keeps no energy
// balance: the machine does the work of its loads.
struct EnergyBalance {
  // Explicit: product of velocities half a step before and after, for which the balance is exact.
  double kinetic = 0;
  double strain = 0;
  double load_work = 0;  // by loads on the surface
  double clamp_work = 0; // by the machine
  double dissipated = 0; // by damping
  double plastic = 0;    // lost to yielding
  double rubbed = 0;     // by friction of a seat
  // Quasi-static: work of the loads on the deformation less the strain energy, of either sign. It arises
  // because the body lags behind its loads.
  double unbalanced = 0;
};

// Contact springs and dashpots at each vertex of the surface, for the stable step.
struct VertexSprings {
  std::vector<double> stiffness; // N/m
  std::vector<double> dashpot;   // N s/m
  double clamp = 0;              // N/m, of the part that pushes a sliding clamp
};

class Body : public LoadedSurface {
public:
  virtual ~Body() = default;
  Body(const Body &) = default;
  Body(Body &&) = default;
  Body &operator=(const Body &) = default;
  Body &operator=(Body &&) = default;

  virtual double mass() const = 0; // kg

  // The machine moves the clamp, or all of a rigid body, without rotation.
  virtual void set_velocity(const Vector3 &velocity) = 0; // m/s
  virtual const Vector3 &velocity() const = 0;            // m/s, of the centre of the moved frame
  virtual const Vector3 &displacement() const = 0;        // m, of the same centre
  // Rotation of that frame since the start, and its angular velocity (rad/s, global axes).
  virtual const Quaternion &rotation() const = 0;
  virtual const Vector3 &angular_velocity() const = 0;
  virtual bool turns() const { return false; } // freely, on a seat that the machine moves

  virtual void kick(double dt) = 0;  // impulse of the loads over dt (s)
  virtual void drift(double dt) = 0; // moves everything over dt (s); loads do not change
  // m, largest displacement of a vertex in the last drift, or an upper bound of it.
  virtual double last_move() const = 0;
  // s, longest stable step between kicks with these springs, whose ends at the particles are taken as at
  // rest; infinite where nothing limits it.
  virtual double stable_step(const VertexSprings &springs) const = 0;

  // Local compliance of the mesh under a point force, one entry per face of the surface; empty for a body
  // whose mesh does not deform.
  virtual std::vector<FaceCompliance> face_compliance() const { return {}; }

  virtual EnergyBalance energy_balance() const = 0;

  // All values that change in a run.
  virtual void describe(Archive &archive) = 0;

  // Its elements in their current position, with displacement (m), contact_pressure and contact_shear (Pa, as
  // contact_tractions) and slip (m; one value per surface vertex, or an empty vector for zero); a deformable
  // body adds stress and von_mises (Pa).
  virtual Picture picture(const std::vector<double> &slip) const = 0;

protected:
  Body() = default;
};

} // namespace platen::fem
