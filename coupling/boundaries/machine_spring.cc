#include "coupling/boundaries/machine_spring.h"

namespace platen::coupling {
namespace {

// A servo moves the crosshead at (F_wanted - F) / c. On the mass M it is stable for any specimen while c is
// above sqrt(k M) / (2 xi) (Routh's criterion, with an infinitely stiff specimen); at its highest gain c is
// ten times the impedance, so that there is a factor of two.
constexpr double impedances_of_servo = 10;

} // namespace

MachineSpring::MachineSpring(const MachineSettings &settings) : settings_(settings) {
  require_in_range(settings);
  require_given(settings, "stiffness", settings.stiffness);
  require_given(settings, "mass", settings.mass);
  dashpot_ = 2 * settings.damping * std::sqrt(settings.stiffness * settings.mass);
}

double MachineSpring::push(double speed) {
  speed_ = speed;
  spring_before_ = settings_.stiffness * compression_;
  damped_before_ = dashpot_force(speed, velocity_);
  return spring_before_ + damped_before_;
}

void MachineSpring::go(double velocity, double dt) {
  drifting_ = velocity;
  compression_ += dt * (speed_ - drifting_);
}

void MachineSpring::follow(double path, double dt) {
  go(path / dt, dt);
}

double MachineSpring::drift(double speed, double load, double dt) {
  go(velocity_ + 0.5 * dt * (push(speed) - load) / settings_.mass, dt);
  return drifting_;
}

void MachineSpring::finish(double load, double dt) {
  end(drifting_, load, settings_.mass, dt);
}

double MachineSpring::finish_push(double velocity, double mass, double dt) {
  end(velocity, 0, mass, dt);
  return mass * (velocity_ - velocity);
}

// The velocity is solved for with the dashpot's force at that velocity.
void MachineSpring::end(double velocity, double load, double mass, double dt) {
  const double kick = 0.5 * dt / mass, spring = settings_.stiffness * compression_;
  velocity_ = (velocity + kick * (spring + dashpot_ * speed_ - load)) / (1 + kick * dashpot_);
  const double damped = dashpot_force(speed_, velocity_);
  power_ = (spring_before_ + spring + damped_before_ + damped) * speed_;
  damping_work_ += 0.5 * dt * (damped_before_ + damped) * (speed_ - drifting_);
}

double MachineSpring::servo_impedance() const {
  return std::sqrt(settings_.stiffness * settings_.mass) / (impedances_of_servo * settings_.damping);
}

// dt^2 K + 2 dt C = 4 M; its own dashpot does not count, because it is solved for implicitly.
double MachineSpring::stable_step(double springs, double dashpots) const {
  const double k = settings_.stiffness + springs;
  return (std::sqrt(dashpots * dashpots + 4 * settings_.mass * k) - dashpots) / k;
}

void MachineSpring::describe(Archive &archive) {
  archive.version(1);
  archive("compression", compression_, "m");
  archive("velocity", velocity_, "m/s");
  archive("damping_work", damping_work_, "J");
}

} // namespace platen::coupling
