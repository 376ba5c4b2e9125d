// A study whose runs are made one by one, on whatever machines see its folder.
#pragma once

#include "apps/scene/command_line.h"
#include "apps/study/plan_file.h"

namespace platen::apps {

// --plan: writes the plan where none is there, leaves one that is the same, and refuses another; with
// --overwrite all that is there is removed first. Runs nothing.
int plan_runs(const CommandLine &command, const PlannedStudy &study, RunLog &log);

// --run K: makes the run with this number. One that is done is left; one that was stopped or killed goes on
// from its checkpoint, or is made anew. Returns its exit status: as platen-compress has it, 128 and the
// signal where it was ended by one. Throws InputError where the number is not in the plan, where another
// process is at that run, and as require_plan.
int make_planned_run(const CommandLine &command, const PlannedStudy &study, RunLog &log);

// --collect: tables, study.json and summary.json of the runs that are there, as if the study had been one
// process. Runs that are missing are told with what is known of them; then the exit status is 3.
int collect_runs(const CommandLine &command, const PlannedStudy &study, RunLog &log);

} // namespace platen::apps
