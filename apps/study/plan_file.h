// A study's plan as it stands in its folder: plan.csv, a run a line, and plan.json, what it was made of.
#pragma once

#include <string>

#include "apps/output/run_log.h"
#include "apps/study/study_setup.h"

namespace platen::apps {

// Whether a whole plan of this very study is there. Throws InputError where another is, and says what
// differs; whatever is damaged of this one counts as not there, is told, and may be written.
bool has_plan(const StudySetup &study, RunLog &log);
// Writes plan.json, scene.prm, plan.csv and, where there is none, study.json, in this order. Throws
// OutputError.
void write_plan(const StudySetup &study);
// Throws InputError unless a whole plan of this very study is there: of this kind, version, scene, and of the
// files that it names.
void require_plan(const StudySetup &study);

} // namespace platen::apps
