// A rubber sleeve around a specimen: a tube of hyperelastic elements whose inner face meets the particles,
// whose outer face bears the cell's pressure, and whose rims go with the platens.
//
// Rubber is slow: its own stable step is tens of steps of the particles. So it is kicked once an interval of
// several steps. Within the interval its nodes move at constant velocity (the surface that particles meet
// moves smoothly), impulses of contact are added up, and at its end they act as their mean, with the
// elements' forces and the pressure: velocity Verlet with the interval as step (impulses of two step sizes,
// as in fem/elastic_solid.h).
#pragma once

#include <vector>

#include "coupling/contact_layer.h"
#include "dem/packing/specimen.h"
#include "fem/hyperelastic_solid.h"

namespace platen::coupling {

struct SleeveSettings {
  double thickness = 3e-3; // m
  fem::Rubber rubber{1100, fem::NeoHookean{0.5e6, 5e8}};
  int elements_around = 48, elements_along = 0, elements_through = 1; // along 0: as long as wide
  bool bonded_rims = true; // to the platens' rims; else they slide along them
  double mass_scaling = 1; // of the sleeve alone, whose inertia hardly counts
  double mass_damping = 0; // 1/s, rate at which its velocities die away
  double safety = 0.5;     // interval over its limit
  int most_steps = 200;    // of the particles in an interval
  SurfaceContact contact;  // of its inner face with the particles
};

// Motion of the ends and pressure for the next interval.
struct SleeveLead {
  fem::Point bottom{}, top{}; // m/s
  double pressure = 0;        // Pa, on the outer face
};

class Sleeve {
public:
  // Around a cylinder of `shape`, from z = low to z = high (m). The middles of the inner faces lie on the
  // mantle of the shape. Throws std::invalid_argument where a setting is out of range or the shape is no
  // cylinder.
  Sleeve(const dem::Particles &particles, const dem::Shape &shape, double low, double high,
         const SleeveSettings &settings);

  // Each step of the particles, after their drift over dt (s) and before forces: moves the surface. Begins an
  // interval where the last one has ended.
  void move(double dt, const SleeveLead &lead);
  // Bound on how far the surface moves over dt (m).
  double largest_move(double dt) const;
  // After the contact layer has given its forces: takes them, and ends the interval where it is due. Throws
  // fem::InvertedElement before an element is used that would be inside out.
  void take_loads(double dt);

  fem::HyperelasticSolid solid;
  ContactLayer layer;

  int steps_of_interval() const { return planned_; }
  double axial_force_top() const { return solid.lead_force(top_lead_)[2]; } // N, of the platen on the sleeve
  double axial_force_bottom() const { return solid.lead_force(bottom_lead_)[2]; } // N
  double inner_volume() const { return solid.enclosed_volume(fem::inner_tag); }   // m^3, of the specimen
  // Work of pressure and platens on the sleeve since the start, and what it stores and has lost (J).
  double work() const { return solid.pressure_work() + solid.lead_work(); }
  double stored() const { return solid.kinetic_energy() + solid.internal_energy(); }
  double lost() const { return solid.damping_work(); }

  // To the last bit, beside the layer's table and works.
  std::vector<double> state() const;
  void set_state(const std::vector<double> &numbers);

private:
  void begin_interval(double dt, const SleeveLead &lead);
  void end_interval();
  double limit() const;

  SleeveSettings settings_;
  int bottom_lead_ = 0, top_lead_ = 0;
  int planned_ = 0, made_ = 0;      // steps of the interval
  double elapsed_ = 0;              // s, of the interval
  double limit_ = 0;                // s, of the next interval, by the contacts at the end of this one
  std::vector<fem::Point> impulse_; // N s, of each vertex in the interval
};

} // namespace platen::coupling
