#include "coupling/boundaries/machine_spring.h"

namespace platen::coupling {
namespace {

// A servo moves the crosshead at (F_wanted - F) / c. On the mass M it is stable for any specimen while c is
// above sqrt(k M) / (2 xi) (Routh's criterion, with a specimen that is infinitely stiff); at its highest gain
// c is ten times the impedance, so that this keeps twice the distance.
constexpr double impedances_of_servo = 10;

} // namespace

MachineSpring::MachineSpring(const MachineSettings &settings) : settings_(settings) {
  require_in_range(settings);
  require_given(settings, "stiffness", settings.stiffness);
  require_given(settings, "mass", settings.mass);
  dashpot_ = 2 * settings.damping * std::sqrt(settings.stiffness * settings.mass);
}

double MachineSpring::drift(double speed, double load, double dt) {
  speed_ = speed;
  spring_before_ = settings_.stiffness * compression_;
  damped_before_ = dashpot_force(speed, velocity_);
  drifting_ = velocity_ + 0.5 * dt * (spring_before_ + damped_before_ - load) / settings_.mass;
  compression_ += dt * (speed - drifting_);
  return drifting_;
}

// The velocity is solved for with the dashpot's force at it.
void MachineSpring::finish(double load, double dt) {
  const double kick = 0.5 * dt / settings_.mass, spring = settings_.stiffness * compression_;
  velocity_ = (drifting_ + kick * (spring + dashpot_ * speed_ - load)) / (1 + kick * dashpot_);
  const double damped = dashpot_force(speed_, velocity_);
  power_ = (spring_before_ + spring + damped_before_ + damped) * speed_;
  damping_work_ += 0.5 * dt * (damped_before_ + damped) * (speed_ - drifting_);
}

double MachineSpring::servo_impedance() const {
  return std::sqrt(settings_.stiffness * settings_.mass) / (impedances_of_servo * settings_.damping);
}

// dt^2 K + 2 dt C = 4 M; its own dashpot does not count, being solved for.
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
