// An experiment is made of parts: a specimen, what it meets, and a program that says what is done with it, on
// one clock.
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

  // What the specimen meets, in this order; before begin().
  template <class Kind>
  Kind &add(std::unique_ptr<Kind> boundary) {
    Kind &added = *boundary;
    boundaries_.push_back(std::move(boundary));
    return added;
  }
  // Takes what is to be done with it and chooses the time step, once all boundaries are there. Throws
  // BadSetup.
  void begin(std::unique_ptr<Program> program);

  // Up to `most` steps, to the same bits as one by one and faster; ends early after the one that finishes the
  // program. Returns how many were made. Throws
  // NumericsStopped, naming particles and columns, where numbers are not finite: within a step or two where
  // they reach a force, else within a hundred.
  long advance(long most);
  // Before the first step: carries the particles by displacements (m) and turns (rad; empty without rotation)
  // and each boundary by what is given for it (m), so slowly that nothing is left in motion, as a solve
  // without inertia has it. Bonds, contacts, friction springs and the energy balance are then as after a very
  // slow loading; the clock stands at zero. Throws BadSetup where a bond breaks meanwhile, and
  // std::logic_error after the first step or where a boundary has inertia.
  void carry(const std::vector<Vector3> &displacement, const std::vector<Vector3> &turn,
             const std::vector<Vector3> &of_boundaries);
  // Throws NumericsStopped where a particle's motion is not finite: to be asked before a state is kept.
  void require_finite();

  dem::Model model; // the specimen

  const std::vector<std::unique_ptr<Boundary>> &boundaries() const { return boundaries_; }
  const Program &program() const { return *program_; }
  void change_rate(double rate) { program_->change_rate(rate); } // m/s, as the program does
  // After a state was read that had been finished by an earlier end: goes on.
  void go_on() { program_->go_on(); }
  const dem::Shape &shape() const { return shape_; }
  double time() const { return model.time; } // s
  long steps() const { return steps_; }
  double time_step() const { return time_step_; } // s
  const std::string &time_step_reason() const { return reason_; }
  dem::EnergyLedger energy() const;
  std::size_t bytes() const; // of all columns and of the search lists
  virtual void describe(Archive &archive);

  // Cuts the specimen over ranks, which all hold this same experiment and call the same from now on. Between
  // calls of advance() each knows its own part of the specimen, and all of it from gather() on until the next
  // step: before rows of bonds and contacts are asked for. gather_motion() is enough for energies and
  // measures of places. settle() makes cracks and their number known to all; settle_state() too what a state
  // of the first rank holds beside the rows that each rank has.
  void share(std::unique_ptr<dem::Exchange> exchange) { model.share(std::move(exchange)); }
  void gather();
  void gather_motion();
  void settle() { model.settle(); }
  void settle_state();

protected:
  // Of cracks: the strain of the test. Rows that the program's measures read in each step, ascending.
  virtual double strain_of_cracks() const { return 0; }
  virtual std::vector<int> rows_measured() const { return {}; }

private:
  void make_step(bool first_of_call);
  void compute_forces();
  void drift_boundaries(const Step &step);
  // On ranks (experiment_ranks.cc).
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
  // What stops a run (experiment_limits.cc).
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
    int particle;            // row of its first
    std::size_t boundary, k; // of its parts
  };
  std::vector<Part> parts_;                      // of the boundaries' contact work, by particle
  std::vector<std::size_t> at_once_, in_turn_;   // boundaries whose drift is worth a thread; the others
  std::vector<std::vector<std::size_t>> groups_; // of boundaries of which no two push the same particle
  long lists_grouped_ = -1;                      // search lists made when that was found
  std::vector<SharedContacts *> shared_;         // of boundaries whose contact work the ranks divide
  long lists_shared_ = -1;                       // the same of rows that all ranks see
  double time_step_ = 0;
  std::string reason_;
  long steps_ = 0;
  std::size_t near_at_choice_ = 0;
  double machine_work_ = 0;   // J, on boundaries without an energy balance of their own
  double given_energy_ = 0;   // J, of motion before the first step
  double energy_allowed_ = 0; // J, of motion, when it was last checked
  double half_lightest_ = 0;  // kg, of the particles' masses
};

} // namespace platen::coupling
