// An experiment consists of a specimen, its boundaries, and a program that prescribes the loading, on one
// clock.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/describe.h"
#include "coupling/boundary.h"
#include "coupling/program/program.h"
#include "dem/model.h"
#include "dem/packing/specimen.h"

namespace platen::coupling {

struct TimeStepSettings {
  double safety = 0.8;   // time step over the limit
  double fixed_step = 0; // s; 0: safety times the limit

  static constexpr const char *name = "time_step";
  template <class Visitor, class Self>
  static void describe(Visitor &&v, Self &p) {
    v("safety", p.safety, "1", above_up_to(0, 1), "Time step over the stability limit.");
    v("fixed_step", p.fixed_step, "s", at_least(0),
      "0: Safety times the limit; a larger one than the limit is refused.");
  }
};

class Experiment {
public:
  // Without boundaries and program. Throws std::invalid_argument as dem::Model does.
  Experiment(const dem::Specimen &specimen, const dem::ModelSettings &settings,
             const TimeStepSettings &time_step);
  virtual ~Experiment() = default;

  // Boundaries of the specimen, in this order; before begin().
  template <class Kind>
  Kind &add(std::unique_ptr<Kind> boundary) {
    Kind &added = *boundary;
    boundaries_.push_back(std::move(boundary));
    return added;
  }
  // Takes the program and chooses the time step, after all boundaries have been added. Throws BadSetup.
  void begin(std::unique_ptr<Program> program);

  // Makes up to `most` steps, bitwise as one by one and faster; stops early after the step that finishes the
  // program. Returns the number of steps made. Throws NumericsStopped, naming particles and columns, where
  // numbers are not finite: within a step or two where they reach a force, else within a hundred.
  long advance(long most);
  // Before the first step: carries the particles by displacements (m) and turns (rad; empty without rotation)
  // and each boundary by its given displacement (m), so slowly that no motion is left, as in a solve without
  // inertia. Bonds, contacts, friction springs and the energy balance are then as after a very slow loading;
  // the clock is at zero. Throws BadSetup where a bond breaks during this, and std::logic_error after the
  // first step or where a boundary has inertia.
  void carry(const std::vector<Vector3> &displacement, const std::vector<Vector3> &turn,
             const std::vector<Vector3> &of_boundaries);
  // Throws NumericsStopped where a particle's motion is not finite; to be called before a state is saved.
  void require_finite();

  dem::Model model; // the specimen

  const std::vector<std::unique_ptr<Boundary>> &boundaries() const { return boundaries_; }
  const Program &program() const { return *program_; }
  void change_rate(double rate) { program_->change_rate(rate); } // m/s, as Program::change_rate
  // Continues after a state was read that had been finished by an earlier end.
  void go_on() { program_->go_on(); }
  const dem::Shape &shape() const { return shape_; }
  double time() const { return model.time; } // s
  long steps() const { return steps_; }
  double time_step() const { return time_step_; } // s
  const std::string &time_step_reason() const { return reason_; }
  dem::EnergyLedger energy() const;
  std::size_t bytes() const; // of all columns and of the search lists
  virtual void describe(Archive &archive);

  // Divides the specimen over ranks, which all hold this same experiment and make the same calls from now on.
  // Between calls of advance() each rank has the current values of its own part of the specimen only; all
  // ranks have all of it from gather() until the next step: call it before reading rows of bonds and
  // contacts. gather_motion() is enough for energies and measures of places. settle() makes cracks and their
  // number known to all; settle_state() also the data of the first rank's state beyond the rows that each
  // rank has.
  void share(std::unique_ptr<dem::Exchange> exchange) { model.share(std::move(exchange)); }
  void gather();
  void gather_motion();
  void settle() { model.settle(); }
  void settle_state();

protected:
  // The strain of the test, for cracks. Rows that the program's measures read in each step, ascending.
  virtual double strain_of_cracks() const { return 0; }
  virtual std::vector<int> rows_measured() const { return {}; }

private:
  void make_step(bool first_of_call);
  void compute_forces();
  void drift_boundaries(const Step &step);
  // For ranks (experiment_ranks.cc).
  void begin_sharing();
  void gather_for_boundaries(const Step &step);
  void share_rows_of_boundaries();
  void gather_rows();
  void send_loads();
  void receive_loads();
  bool any_rank(bool here) const;
  long lists_made() const;
  double work_from_outside() const;
  void prepare_contacts(const Step &step);
  void apply_boundary_forces(const Step &step);
  void group_boundaries();
  void finish_boundaries(const Step &step);
  // Time step (experiment_limits.cc).
  dem::StableStep limit_now(double sought_below);
  std::size_t contacts_closed() const;
  void choose_step(bool first);
  bool choice_is_due();
  // Reasons to stop a run (experiment_limits.cc).
  [[noreturn]] void stop_not_finite();
  [[noreturn]] void stop_unseen(const std::string &reason);
  void require_boundaries_finite();
  void check_energy();

  dem::Shape shape_;
  TimeStepSettings settings_;
  std::vector<std::unique_ptr<Boundary>> boundaries_;
  std::unique_ptr<Program> program_;
  Commands commands_; // one for each boundary
  struct Part {
    int particle;            // row of its first particle
    std::size_t boundary, k; // index among its parts
  };
  std::vector<Part> parts_;                      // of the boundaries' contact work, by particle
  std::vector<std::size_t> at_once_, in_turn_;   // boundaries whose drift gets a thread of its own; the
                                                 // others
  std::vector<std::vector<std::size_t>> groups_; // boundaries of one group push different particles
  long lists_grouped_ = -1;                      // number of search lists made when the groups were found
  std::vector<SharedContacts *> shared_;         // of boundaries whose contact work is divided over the ranks
  long lists_shared_ = -1;                       // the same for the rows that all ranks see
  double time_step_ = 0;
  std::string reason_;
  long steps_ = 0;
  std::size_t near_at_choice_ = 0;
  double machine_work_ = 0;   // J, on boundaries without an energy balance of their own
  double given_energy_ = 0;   // J, of motion before the first step
  double energy_allowed_ = 0; // J, limit of the kinetic energy at the last check
  double half_lightest_ = 0;  // kg, half the smallest mass of a particle
};

} // namespace platen::coupling
