// The machine behind a platen is a spring: its crosshead moves as prescribed, and the platen follows through
// the spring. A soft machine releases its stored energy into a failing specimen, a stiff one does not.
//
// With the displacements x of the crosshead and q of the platen in the direction that it presses, the mass M
// that moves with it and the load F on the specimen,
//
//   M q'' = k (x - q) + c (x' - q') - F,   c = 2 xi sqrt(k M)
//
// by velocity Verlet on the steps of the particles, the dashpot by the mean of its forces at both ends of the
// drift, so that only k, and not c, bounds the step. The works below are those by which this scheme changes
// the kinetic energy (docs/theory.md, 8.2). The machine carries the weight of the platen.
//
// Where the platen is a body that moves by itself (an elastic one, by the load on its clamp), the spring
// pushes that body at both ends of its drift instead of solving for M.
#pragma once

#include <cmath>

#include "base/archive.h"
#include "base/describe.h"

namespace platen::coupling {

struct MachineSettings {
  double stiffness = not_given; // N/m, from the crosshead to the platen; not given: rigid
  double mass = not_given;      // kg, moves with the platen, itself included; not given: its own. The excess
                                // over an elastic platen's mass is fixed to its clamp
  double damping = 0.1;         // fraction of critical

  bool yields() const { return !std::isnan(stiffness); }

  static constexpr const char *name = "platens.machine";
  template <class Visitor, class Self>
  static void describe(Visitor &&v, Self &p) {
    v("stiffness", p.stiffness, "N/m", above(0),
      "Of the whole machine, from its crosshead to the top platen; the bottom one stands on its base. "
      "The crosshead moves as Loading says; strains are those of the faces. Not given: rigid.");
    v("mass", p.mass, "kg", above(0),
      "That moves with the top platen on that spring, itself included; not given: the platen's own. What a "
      "deformable platen does not have of it is fixed to its far end.");
    v("damping", p.damping, "1", between(0, 1), "Fraction of critical damping of that mass on that spring.");
  }
};

class MachineSpring {
public:
  // Stiffness and mass are required. Throws BadParameter where one is missing or out of range.
  explicit MachineSpring(const MachineSettings &settings);

  // Start of a step dt (s): the crosshead moves at `speed` (m/s, in the direction that the platen presses),
  // the load on the specimen is `load` (N). Returns the platen's velocity over the drift, m/s.
  double drift(double speed, double load, double dt);
  // End of that step, with the load at its end.
  void finish(double load, double dt);

  // The same for a platen that moves by itself. Returns the force on it at the start of the drift, N;
  double push(double speed);
  // takes its displacement over the drift, m;
  void follow(double path, double dt);
  // returns the impulse of the spring at the end, N s, for a `mass` (kg) with this `velocity` at that time.
  double finish_push(double velocity, double mass, double dt);

  double compression() const { return compression_; } // m, of crosshead less platen
  double velocity() const { return velocity_; }       // m/s, of the platen, at the end of the step
  // Force of the crosshead on the platen (N), at the start plus at the end of the drift, times its speed.
  double power() const { return power_; }                                                           // W
  double elastic_energy() const { return 0.5 * settings_.stiffness * compression_ * compression_; } // J
  double kinetic_energy() const { return 0.5 * settings_.mass * velocity_ * velocity_; }            // J
  double damping_work() const { return damping_work_; } // J, lost since the start

  // N s/m, force per speed of an impact for which a servo is stable that moves the crosshead by the
  // specimen's load; infinite without damping.
  double servo_impedance() const;
  // s, the largest stable step with springs (N/m) and dashpots (N s/m) to a specimen at rest.
  double stable_step(double springs, double dashpots) const;
  const MachineSettings &settings() const { return settings_; }

  void describe(Archive &archive);

private:
  double dashpot_force(double speed, double velocity) const { return dashpot_ * (speed - velocity); } // N
  void go(double velocity, double dt);
  void end(double velocity, double load, double mass, double dt);

  MachineSettings settings_;
  double dashpot_ = 0; // N s/m
  double compression_ = 0, velocity_ = 0, damping_work_ = 0;
  double power_ = 0;
  double speed_ = 0, drifting_ = 0;              // m/s, of crosshead and platen in the current step
  double spring_before_ = 0, damped_before_ = 0; // N, at its start
};

} // namespace platen::coupling
