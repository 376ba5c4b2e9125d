// What a study leaves when its runs are there: tables, study.json, summary.json, words on the screen.
#pragma once

#include <string>
#include <vector>

#include "apps/many/runs.h"
#include "apps/output/output_folder.h"
#include "apps/output/run_log.h"
#include "apps/study/accuracy.h"
#include "apps/study/cases.h"
#include "apps/study/tables.h"

namespace platen::apps {

// Says what came of a run, after `head`, and which numbers that the scene expects it missed. Returns what the
// scene expects of it, as its summary would have it (apps/scene/expect.h), each with the name of the `run`.
Json tell_outcome(const Scene &scene, StudyKind kind, const std::string &head, const TestRun &run,
                  const RunOutcome &outcome, RunLog &log);
// "NAME: why" of each of them that is not met.
std::vector<std::string> missed_in(const Json &expectations);

class StudyResults {
public:
  // Begins the tables anew. All but the scene's text has to outlive this.
  StudyResults(const Scene &scene, const StudyPlan &plan, const std::vector<TestRun> &runs,
               const OutputPaths &paths, RunLog &log);

  // Of run k when it has ended, the how manieth of all.
  void tell(std::size_t k, const RunOutcome &outcome, std::size_t ended);
  // Of run k, in their order.
  void keep(std::size_t k, const RunOutcome &outcome);
  // Once all are there. `costs` are the keys of summary.json on what the study took. Returns the exit status.
  int finish(const Json &costs);

private:
  // What the kind of study alone leaves: added to study.json, told.
  std::string compare(Json &study) const;
  Json study_json() const;
  std::string status() const;

  const Scene &scene_;
  const StudyPlan &plan_;
  const std::vector<TestRun> &runs_;
  const OutputPaths &paths_;
  RunLog &log_;
  StudyTables tables_;
  Accuracy accuracy_;
  std::vector<Json> expectations_; // by run
};

} // namespace platen::apps
