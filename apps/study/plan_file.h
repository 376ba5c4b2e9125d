// A study's plan as it stands in its folder: plan.csv, a run a line, and plan.json, what it was made of.
#pragma once

#include <string>
#include <vector>

#include "apps/many/runs.h"
#include "apps/output/output_folder.h"
#include "apps/output/run_log.h"
#include "apps/output/summary.h"
#include "apps/scene/scene.h"
#include "apps/study/cases.h"

namespace platen::apps {

// A study as this program, this scene and these files make it.
struct PlannedStudy {
  const Scene &scene;
  const StudyPlan &plan;
  const std::vector<TestRun> &runs;
  const OutputPaths &paths;
  std::string command; // "platen-study friction a.prm -o results/a", for what can be done next
};

// plan.csv: number from 1 on, name and folder of each run, the number of the first run with its packing, what
// it takes by counting (spheres, bytes of memory, seconds to the target strain on two threads; nan where that
// cannot be counted), and its entries over the scene.
std::string plan_text(const PlannedStudy &study);

// Whether a whole plan of this very study is there. Throws InputError where another is, and says what
// differs; whatever is damaged of this one counts as not there, is told, and may be written.
bool has_plan(const PlannedStudy &study, RunLog &log);
// Writes plan.json, scene.prm, plan.csv and, where there is none, study.json, in this order. Throws
// OutputError.
void write_plan(const PlannedStudy &study);
// Throws InputError unless a whole plan of this very study is there: of this kind, version, scene, and of the
// files that it names.
void require_plan(const PlannedStudy &study);

} // namespace platen::apps
