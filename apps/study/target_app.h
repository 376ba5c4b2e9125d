// A study of a target as platen-study carries it out.
#pragma once

#include "apps/output/run_log.h"
#include "apps/study/target_study.h"

namespace platen::apps {

// Entries that may be another when such a study goes on: what is ordered, and not what is run.
bool may_change_on_resume(const std::string &entry);

// --dry-run: by the runs that are there, what is still to be run and what it is expected to cost; or that
// there are none, and what the pilot is.
int tell_target_plan(const TargetSetup &setup);

// Makes all runs and leaves study.csv, costs.csv, study.json, summary.json. Returns the exit status: 1 where
// the accuracy was not reached. Throws Stopped as carry_out. `summary_costs` are the keys of summary.json on
// what the study took, asked for at the end.
int make_target(const TargetSetup &setup, RunLog &log, const std::function<Json()> &summary_costs);

} // namespace platen::apps
