// The machine behind a platen is a spring: its crosshead moves as the machine is told, the platen follows
// through it. A soft machine gives what it holds to a specimen that falls, a stiff one does not.
//
// With the displacements x of the crosshead and q of the platen along the way that it presses, the mass M
// that moves with it and the load F that the specimen bears,
//
//   M q'' = k (x - q) + c (x' - q') - F,   c = 2 xi sqrt(k M)
//
// by velocity Verlet on the steps of the particles, the dashpot by the mean of its forces at both ends of the
// drift, so that only k, and not c, bounds the step. The works below are those by which this scheme changes
// the kinetic energy (docs/theory.md, 8.2). The weight of the platen is the machine's.
//
// Where the platen is a body that moves by itself (an elastic one, by what it bears on its clamp), the spring
// pushes that body at both ends of its drift instead of solving for M.
#pragma once

#include <cmath>

#include "base/archive.h"
#include "base/describe.h"

namespace platen::coupling {

struct MachineSettings {
  double stiffness = not_given; // N/m, from the crosshead to the platen; not given: rigid
  double mass = not_given;      // kg, that moves with the platen, itself included; not given: its own. What
                                // an elastic one has not is fixed to its clamp
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
  // Stiffness and mass are given. Throws BadParameter where one is not, or is out of range.
  explicit MachineSpring(const MachineSettings &settings);

  // Of a step dt (s) whose crosshead goes at `speed` (m/s, the way that the platen presses) and that begins
  // with `load` (N, on the specimen): moves the crosshead. Returns the platen's velocity over the drift, m/s.
  double drift(double speed, double load, double dt);
  // The end of that step, with the load that it has found.
  void finish(double load, double dt);

  // The same of a platen that moves by itself. The force on it at the start of the drift, N;
  double push(double speed);
  // where it has gone over the drift, m;
  void follow(double path, double dt);
  // the impulse that the spring gives, at the end, to a `mass` (kg) that goes at `velocity` by then, N s.
  double finish_push(double velocity, double mass, double dt);

  double compression() const { return compression_; } // m, crosshead before platen since the start
  double velocity() const { return velocity_; }       // m/s, of the platen, at the end of the step
  // N, of the crosshead on the platen, at the start and at the end of the drift, added up, times its speed.
  double power() const { return power_; }                                                           // W
  double elastic_energy() const { return 0.5 * settings_.stiffness * compression_ * compression_; } // J
  double kinetic_energy() const { return 0.5 * settings_.mass * velocity_ * velocity_; }            // J
  double damping_work() const { return damping_work_; } // J, lost since the start

  // Force per speed of an impact that keeps a servo stable which moves the crosshead by the specimen's load,
  // N s/m; infinite without damping.
  double servo_impedance() const;
  // s, the longest step on springs (N/m) and dashpots (N s/m) that the specimen's side holds at rest.
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
  double speed_ = 0, drifting_ = 0;              // m/s, of crosshead and platen; of the step that is made
  double spring_before_ = 0, damped_before_ = 0; // N, at its start
};

} // namespace platen::coupling
