// A boundary of a specimen: platens, strips, a sleeve, a pressure on its skin, a wall. An experiment holds a
// list of any number of boundaries and uses them only through this interface.
#pragma once

#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/archive.h"
#include "base/vector3.h"
#include "coupling/contact/contact_layer.h"
#include "dem/energy.h"
#include "dem/particles.h"
#include "dem/stable_step.h"
#include "fem/picture.h"

namespace platen::coupling {

// The run cannot go on: cause, place, time and what to try. The text names members of the settings in
// backquotes (`loading.ramp`), which a program that reads them from a file replaces by its own names. Apps
// exit with status 3.
class NumericsStopped : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

// The settings describe an impossible run: the faulty member and the reason. Apps exit with status 2.
class BadSetup : public std::runtime_error {
public:
  BadSetup(std::string member, const std::string &reason)
      : std::runtime_error("`" + member + "` " + reason), member_(std::move(member)), reason_(reason) {}
  const std::string &member() const { return member_; } // "loading.ramp"
  const std::string &reason() const { return reason_; } // what() without the member

private:
  std::string member_, reason_;
};

// What the machine prescribes for a boundary in a step.
struct Command {
  Vector3 velocity{};  // m/s, of what the machine moves
  double pressure = 0; // Pa
};

// The current step; the particles have drifted.
struct Step {
  double dt = 0;       // s
  double time = 0;     // s, of its end
  long number = 0;     // steps made before it
  double farthest = 0; // m, bound on the displacement of any particle
};

struct StepLimit {
  double seconds = std::numeric_limits<double>::infinity();
  std::string reason;
};

// A boundary that is written to frames.
class Pictured {
public:
  virtual std::string series() const = 0; // the time series of files that it belongs to, as "platens"
  virtual fem::Picture picture() const = 0;
  virtual std::vector<ActiveContact> contacts() const = 0; // of the last step

protected:
  ~Pictured() = default;
};

class Boundary {
public:
  explicit Boundary(std::string name) : name_(std::move(name)) {}
  virtual ~Boundary() = default;
  Boundary(const Boundary &) = delete;
  Boundary &operator=(const Boundary &) = delete;
  const std::string &name() const { return name_; }

  // The calls of a step, in this order. Takes a command and moves its own parts over the step.
  virtual void drift(const Step &step, const Command &command) = 0;
  // Finds the contacts that are due and returns the number of parts. Throws std::runtime_error where a
  // particle may have passed through the boundary unseen.
  virtual std::size_t prepare(const dem::Particles &, const Step &) { return 0; }
  // Forces of one part, in any order, on any thread, in parallel with the bonds; writes only its own data.
  virtual void compute_part(const dem::Particles &, const Step &, std::size_t) {}
  // Row of the first particle of a part: decides which thread computes it, by the particles in its cache.
  virtual int particle_of_part(std::size_t) const { return 0; }
  // Adds the forces to the particles, and to the boundary itself.
  virtual void apply_forces(dem::Particles &particles, const Step &step) = 0;
  // The end of the step. Throws NumericsStopped where the boundary cannot go on.
  virtual void finish(const Step &) {}
  // For a boundary without its own energy balance that a machine moves or holds against the particles: their
  // power on it (W) at the start plus that at the end of the drift.
  virtual double power_on_machine() const { return 0; }
  virtual bool is_finite() const { return true; }
  // Whether it may be carried to a start without inertia (Experiment::carry).
  virtual bool can_be_carried() const { return true; }
  // Stops the boundary; its loads stay.
  virtual void rest() {}

  // Whether it moves with other boundaries, which have to drift before it; and whether its drift takes long
  // enough for a thread of its own. Called once.
  virtual bool follows_others() const { return false; }
  virtual bool drifts_long() const { return false; }
  // Particles that it may push, ascending, and how often they have been listed; null: any particle.
  virtual const std::vector<int> *listed_particles() const { return nullptr; }
  virtual long lists_made() const { return 0; }

  // Where a specimen is divided over ranks, each rank computes all boundaries, but only some particles are
  // known to all ranks in each step: the rows that the boundary reads, ascending; none: any. Whether it will
  // read all particles in this step; called after boundaries have drifted.
  virtual std::optional<std::vector<int>> rows_read() const {
    const std::vector<int> *listed = listed_particles();
    return listed != nullptr ? std::optional(*listed) : std::nullopt;
  }
  virtual bool reads_all(const Step &) const { return false; }
  // The contact work that is divided over the ranks; null: every rank does all of it.
  virtual SharedContacts *shared_contacts() { return nullptr; }

  // For the stable step: springs of the particles near it, from a rebuilt list; fraction of critical damping
  // of its dashpots; its own limit, after add_springs; the limit that is known without computation.
  virtual void add_springs(const dem::Particles &, std::vector<dem::GroundSpring> &) {}
  virtual double dashpots() const { return 0; }
  virtual StepLimit limit(const dem::Particles &) const { return {}; }
  virtual double known_limit() const { return std::numeric_limits<double>::infinity(); } // s
  // Whether a spring is now stiffer than add_springs assumed.
  virtual bool stiffened() const { return false; }
  // Numbers of listed and of closed contacts; when they grow, the step is chosen again.
  virtual std::size_t near() const { return 0; }
  virtual std::size_t closed() const { return 0; }
  // Called once, when the first time step (s) has been chosen: prepares the boundary for it.
  virtual void fit(const dem::Particles &, double /*time_step*/) {}

  virtual void add_energy(dem::EnergyLedger &) const {}
  virtual Vector3 force() const { return {}; }  // N, of the particles on it
  virtual Vector3 inward() const { return {}; } // unit direction in which a platen presses; else zero
  virtual double closure() const { return 0; }  // m, displacement of the face of a platen inward
  double load() const { return dot(force(), -1.0 * inward()); } // N, with which a platen presses
  virtual double pressure() const { return 0; }                 // Pa, mean, on the lateral surface
  // 1, fraction of the lateral surface that a cell's pressure loads; NaN where there is no cell or no value.
  virtual double confined_fraction() const { return std::numeric_limits<double>::quiet_NaN(); }
  virtual double speed() const { return 0; } // m/s, at which the machine moves it
  virtual ServoLoad servo_load(const dem::Particles &) const { return {}; }
  virtual std::size_t bytes() const { return 0; } // of rows and search lists

  virtual const Pictured *pictured() const { return nullptr; } // null: it is not written to frames
  virtual void describe(Archive &archive) = 0;

private:
  std::string name_;
};

// A boundary whose surface touches the particles through a contact layer.
class ContactBoundary : public Boundary, public Pictured {
public:
  using Boundary::Boundary;
  std::size_t prepare(const dem::Particles &particles, const Step &step) override {
    layer().moved(step.farthest + farthest(step));
    return layer().prepare(particles, surface());
  }
  void compute_part(const dem::Particles &particles, const Step &step, std::size_t part) override {
    layer().compute_part(particles, surface(), step.dt, part);
  }
  int particle_of_part(std::size_t part) const override { return layer().particle_of_part(part); }
  void apply_forces(dem::Particles &particles, const Step &) override {
    layer().apply_forces(particles, &surface());
  }
  const std::vector<int> *listed_particles() const override { return &layer().search().particles(); }
  long lists_made() const override { return layer().search().lists_made(); }
  std::optional<std::vector<int>> rows_read() const override { return std::vector<int>{}; }
  SharedContacts *shared_contacts() override { return &layer(); }
  bool reads_all(const Step &step) const override {
    return layer().search().stale_after(step.farthest + farthest(step));
  }
  void add_springs(const dem::Particles &particles, std::vector<dem::GroundSpring> &springs) override {
    layer().make_list(particles, surface());
    layer().allow_for_depth();
    const std::vector<dem::GroundSpring> own = layer().ground_springs(particles, surface());
    springs.insert(springs.end(), own.begin(), own.end());
  }
  void add_energy(dem::EnergyLedger &energy) const override {
    energy.contacts += layer().elastic_energy();
    energy.friction += layer().friction_work;
    energy.damping += layer().damping_work;
  }
  bool stiffened() const override { return layer().stiffened(); }
  std::size_t bytes() const override { return layer().bytes(); }
  const Pictured *pictured() const override { return this; }
  std::vector<ActiveContact> contacts() const override { return layer().contacts(); }

  virtual const ContactLayer &layer() const = 0;
  virtual const fem::LoadedSurface &surface() const = 0;
  ContactLayer &layer() { return const_cast<ContactLayer &>(std::as_const(*this).layer()); }
  fem::LoadedSurface &surface() { return const_cast<fem::LoadedSurface &>(std::as_const(*this).surface()); }

protected:
  virtual double farthest(const Step &step) const = 0; // m, bound on the displacement of its surface
};

} // namespace platen::coupling
