// A study of a target: runs are made in batches until an interval is as narrow as was ordered.
//
// What is decided, and so all tables, follows from the figures of the runs, their steps and spheres alone:
// the same on every machine that rounds alike, and after any number of stops.
#pragma once

#include <functional>
#include <vector>

#include "apps/study/study_section.h"
#include "apps/study/target_decision.h"
#include "apps/study/target_figures.h"

namespace platen::apps {

struct TargetSetup {
  const Scene &scene;
  const StudyPlan &plan;
  const OutputPaths &paths;
  std::string scene_path;
  std::vector<std::string> overrides; // of the command line
  int threads = 1;                    // at a time
  std::string command;                // "platen-study target a.prm -o results/a"
};

// What was known after a batch.
struct TargetLook {
  std::size_t runs = 0, packings = 0;
  double work = 0, seconds = 0; // steps times spheres, of one core
  TargetEstimate estimate;
  double half = 0;
};

class TargetStudy {
public:
  explicit TargetStudy(const TargetSetup &setup);

  // Runs of a batch, in their order. False where they are not all there: nothing further is decided then.
  using Carry = std::function<bool(const std::vector<TestRun> &)>;
  using Told = std::function<void()>; // after each decision
  // Asks for batches until the study ends; false where a batch was not carried out.
  bool work(const Carry &carry, const Told &told);
  // Of the batch under way: its run of that number.
  void add(std::size_t k, const RunOutcome &outcome);

  const TargetSetup &setup() const { return setup_; }
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
  std::size_t side_runs() const;            // with half the step, of coarser spheres

private:
  void fill_batch(const Counts &next);
  void add_to_batch(std::size_t of_case, std::size_t packing);
  std::size_t most_per_scene() const;

  TargetSetup setup_;
  TargetCases cases_;
  TargetFigures figures_;
  TargetState state_;
  Decision decision_;
  std::vector<TargetLook> looks_;
  std::vector<TestRun> batch_;
  std::vector<std::size_t> packings_; // of the batch
};

} // namespace platen::apps
