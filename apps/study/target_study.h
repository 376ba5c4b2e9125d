// A study of a target: runs are made in batches until an interval is as narrow as was ordered.
//
// What is decided, and so all tables, follows from the figures of the runs, their steps and spheres alone:
// the same on every machine that rounds alike, and after any number of stops.
#pragma once

#include <functional>
#include <vector>

#include "apps/output/run_log.h"
#include "apps/study/study_setup.h"
#include "apps/study/target_figures.h"

namespace platen::apps {

// Entries that may be another when such a study goes on: what is ordered, and not what is run.
bool may_change_on_resume(const std::string &entry);

// --dry-run: by the runs that are there, what is still to be run and what it is expected to cost; or that
// there are none, and what the pilot is.
int tell_target_plan(const StudySetup &setup);

// Makes all runs and leaves study.csv, costs.csv, study.json, summary.json. Returns the exit status: 1 where
// the accuracy was not reached. Throws Stopped as carry_out. `summary_costs` are the keys of summary.json on
// what the study took, asked for at the end.
int make_target(const StudySetup &setup, RunLog &log, const std::function<Json()> &summary_costs);

// What was known after a batch.
struct TargetLook {
  std::size_t runs = 0, packings = 0;
  double work = 0, seconds = 0; // steps times spheres, of one core
  TargetEstimate estimate;
  double half = 0;
};

class TargetStudy {
public:
  explicit TargetStudy(const StudySetup &setup); // its first batch is the pilot

  // Of the batch: its run of that number.
  void add(std::size_t k, const RunOutcome &outcome);
  // Once all of them are there; with the verdict `more` another batch is asked for.
  const Decision &decide();

  const StudySetup &setup() const { return setup_; }
  const StudyTarget &target() const { return study_of(setup_.scene).target; }
  const TargetFigures &figures() const { return figures_; }
  const TargetState &state() const { return state_; }
  const Decision &decision() const { return decision_; }
  const std::vector<TargetLook> &looks() const { return looks_; }
  const std::vector<TestRun> &batch() const { return batch_; }
  Aim aim() const;
  // Relative error for the time step: the allowance, or more where runs with half the step say so.
  double step_error() const;
  std::vector<unsigned long> seeds() const; // that have runs

private:
  void ask_for(const Counts &next);
  void add_to_batch(std::size_t of_case, std::size_t packing);
  std::size_t most_per_scene() const;

  const StudySetup &setup_;
  TargetCases cases_;
  TargetFigures figures_;
  TargetState state_;
  Counts asked_; // for with the batch too
  Decision decision_;
  std::vector<TargetLook> looks_;
  std::vector<TestRun> batch_;
  std::vector<std::size_t> packings_; // of the batch
};

} // namespace platen::apps
