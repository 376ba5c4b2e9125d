// What a study leaves when its runs are there: tables, study.json, summary.json, words on the screen.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/output/run_log.h"
#include "apps/study/study_setup.h"
#include "apps/study/tables.h"

namespace platen::apps {

// Says what came of a run, after `head`, and which numbers that the scene expects it missed. Returns whether
// it missed none.
bool tell_outcome(const StudySetup &study, const std::string &head, const TestRun &run,
                  const RunOutcome &outcome, RunLog &log);

// What the runs of a kind of study tell together: added to study.json; words for the screen.
using Analysis = std::function<std::string(Json &study)>;

class StudyResults {
public:
  // Begins the tables anew.
  StudyResults(const StudySetup &study, RunLog &log)
      : tables(study.plan, study.paths), study_(study), log_(log) {}

  // Of each run, in their order.
  void keep(const TestRun &run, const RunOutcome &outcome);
  // Once all are there: study.json and summary.json, and what is told of the whole. `costs` are the keys of
  // summary.json on what the study took. Returns the exit status: whether the scene's expectations were met.
  int write(const std::string &status, const std::vector<unsigned long> &seeds, const Analysis &analysis,
            const Json &costs) const;
  // The same of a study whose runs were all planned: with the analyses of its kind, and 3 where runs are
  // missing or none has come to its end.
  int finish(const Json &costs) const;

  StudyTables tables;

private:
  std::string analyse(Json &study) const;

  const StudySetup &study_;
  RunLog &log_;
  Json expectations_ = Json::array();
};

} // namespace platen::apps
