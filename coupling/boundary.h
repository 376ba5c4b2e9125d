// What a specimen may meet: platens, strips, a sleeve, a pressure on its skin, a wall. An experiment holds a
// list of any number of them and knows no more of each than this.
#pragma once

#include <iosfwd>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/archive.h"
#include "base/vector3.h"
#include "coupling/contact/contact_layer.h"
#include "coupling/program/platen_speed.h"
#include "dem/energy.h"
#include "dem/particles.h"
#include "dem/stable_step.h"

namespace platen::coupling {

// The run cannot go on: what, where, when and what to try. Texts name members of the settings in backquotes
// (`loading.ramp`), which a program that reads them from a file replaces by its own names. Apps exit with
// status 3.
class NumericsStopped : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

// The settings ask for something that cannot be run: what is wrong with which member. Apps exit with status
// 2.
class BadSetup : public std::runtime_error {
public:
  BadSetup(std::string member, const std::string &reason)
      : std::runtime_error("`" + member + "` " + reason), member_(std::move(member)), reason_(reason) {}
  const std::string &member() const { return member_; } // "loading.ramp"
  const std::string &reason() const { return reason_; } // what() without the member

private:
  std::string member_, reason_;
};

// What the machine asks of a boundary in a step.
struct Command {
  Vector3 velocity{};  // m/s, of what the machine moves
  double pressure = 0; // Pa
};

// The step that is being made; the particles have drifted.
struct Step {
  double dt = 0;       // s
  double time = 0;     // s, of its end
  long number = 0;     // steps made before it
  double farthest = 0; // m, bound on what any particle moved
};

struct StepLimit {
  double seconds = std::numeric_limits<double>::infinity();
  std::string reason;
};

// A boundary that frames show.
class Pictured {
public:
  virtual std::string series() const = 0; // the time series of files that it belongs to, as "platens"
  virtual void write_vtu(std::ostream &) const = 0;
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

  // A step, in this order. Takes a command and moves what is its own over the step.
  virtual void drift(const Step &step, const Command &command) = 0;
  // Finds the contacts that are due; in how many parts they are. Throws std::runtime_error where a particle
  // may have passed through it unseen.
  virtual std::size_t prepare(const dem::Particles &, const Step &) { return 0; }
  // The forces of one part, in any order, on any thread and beside the bonds; writes nothing of others.
  virtual void compute_part(const dem::Particles &, const Step &, std::size_t) {}
  // Row of the first particle of a part: tells which thread has its particles at hand.
  virtual int particle_of_part(std::size_t) const { return 0; }
  // What the particles get, and what is its own of it.
  virtual void apply_forces(dem::Particles &particles, const Step &step) = 0;
  // The end of its own step. Throws NumericsStopped where it cannot go on.
  virtual void finish(const Step &) {}
  // Of a boundary without an energy balance of its own, which a machine holds against the particles: their
  // power on it (W) at the start and at the end of the drift, added up.
  virtual double power_on_machine() const { return 0; }
  virtual bool is_finite() const { return true; }
  // Whether it may be carried to a start without inertia (Experiment::carry).
  virtual bool can_be_carried() const { return true; }
  // Stands still from now on; loads stay.
  virtual void rest() {}

  // Whether it goes with others, which have to drift before; and whether its drift is worth a thread of its
  // own. Asked once.
  virtual bool follows_others() const { return false; }
  virtual bool drifts_long() const { return false; }
  // Particles that it may push, ascending, and how often they were listed so far; null: any.
  virtual const std::vector<int> *listed_particles() const { return nullptr; }
  virtual long lists_made() const { return 0; }

  // Where a specimen is cut over ranks, of which each computes the boundaries, only some particles are known
  // to all in each step: the rows that it reads, ascending; none: any. Whether it will go through all
  // particles in this step, asked when boundaries have drifted.
  virtual std::optional<std::vector<int>> rows_read() const {
    const std::vector<int> *listed = listed_particles();
    return listed != nullptr ? std::optional(*listed) : std::nullopt;
  }
  virtual bool reads_all(const Step &) const { return false; }
  // The contact work that ranks divide; null: every rank does all of it.
  virtual SharedContacts *shared_contacts() { return nullptr; }

  // Springs of the particles near it, listed anew, for the stable step; fraction of critical damping of its
  // dashpots; its own limit, once they are listed; the same as far as it is known without work.
  virtual void add_springs(const dem::Particles &, std::vector<dem::GroundSpring> &) {}
  virtual double dashpots() const { return 0; }
  virtual StepLimit limit(const dem::Particles &) const { return {}; }
  virtual double known_limit() const { return std::numeric_limits<double>::infinity(); } // s
  // Whether a spring has grown stiffer than add_springs counted it.
  virtual bool stiffened() const { return false; }
  // Contacts listed, and closed, whose growth is a reason to choose the step anew.
  virtual std::size_t near() const { return 0; }
  virtual std::size_t closed() const { return 0; }
  // Once, when the first time step (s) has been chosen: sets itself up for it.
  virtual void fit(const dem::Particles &, double /*time_step*/) {}

  virtual void add_energy(dem::EnergyLedger &) const {}
  virtual Vector3 force() const { return {}; }  // N, of the particles on it
  virtual Vector3 inward() const { return {}; } // unit vector of the way that a platen presses; else zero
  virtual double closure() const { return 0; }  // m, how far the face of a platen has moved inward
  double load() const { return dot(force(), -1.0 * inward()); } // N, with which a platen presses
  virtual double pressure() const { return 0; }                 // Pa, mean, that acts on the lateral surface
  // 1, of the lateral surface that a cell's pressure loads; NaN of what is no cell, or has none.
  virtual double confined_share() const { return std::numeric_limits<double>::quiet_NaN(); }
  virtual double speed() const { return 0; } // m/s, at which the machine moves it
  virtual ServoLoad servo_load(const dem::Particles &) const { return {}; }
  virtual std::size_t bytes() const { return 0; } // of rows and search lists

  virtual const Pictured *pictured() const { return nullptr; } // null: it has no picture
  virtual void describe(Archive &archive) = 0;

private:
  std::string name_;
};

// One whose surface meets the particles by a contact layer.
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
  virtual double farthest(const Step &step) const = 0; // m, bound on what its surface moved
};

} // namespace platen::coupling
