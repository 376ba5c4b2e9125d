// A study whose runs are made one by one, on whatever machines see its folder.
#pragma once

#include "apps/output/run_log.h"
#include "apps/study/study_setup.h"

namespace platen::apps {

// Throws InputError where the command line asks for one of these of a target: which runs it needs is not
// known before others are there.
void refuse_planned(const CommandLine &command);

// --plan: writes the plan where none is there, leaves one that is the same, and refuses another; with
// --overwrite all that is there is removed first. Runs nothing.
int plan_runs(const StudySetup &study, RunLog &log);

// --run K: makes the run with this number. One that is done is left; one that was stopped or killed goes on
// from its checkpoint, or is made anew. Returns its exit status: as platen-compress has it, 128 and the
// signal where it was ended by one. Throws InputError where the number is not in the plan, where another
// process is at that run, and as require_plan.
int make_planned_run(const StudySetup &study, RunLog &log);

// --collect: tables, study.json and summary.json of the runs that are there, as if the study had been one
// process. Runs that are missing are told with what is known of them; then the exit status is 3.
int collect_runs(const StudySetup &study, RunLog &log);

} // namespace platen::apps
