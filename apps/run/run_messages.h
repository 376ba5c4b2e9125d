// What a run says of its test: beforehand, on the way, and at the end.
#pragma once

#include <string>

#include "apps/output/run_log.h"
#include "apps/run/observer.h"
#include "apps/run/results.h"
#include "apps/run/specimen_check.h"
#include "apps/scene/scene.h"
#include "dem/exchange.h"

namespace platen::apps {

// "target", "stop at residual", "shortened too far"; "" while the test goes on.
std::string ended_by(const Scene &scene, const coupling::PlatenTest &test, const Results &results);

// Lines for the screen before the first step.
std::string description_of(const Scene &scene, const coupling::PlatenTest &test,
                           const SpecimenState &specimen, double expected_steps, int threads);

class RunMessages : public Observer {
public:
  // `ranks`: of the test; null: alone.
  RunMessages(const Scene &scene, const coupling::PlatenTest &test, const Results &results, RunLog &log,
              const dem::Exchange *ranks)
      : scene_(scene),
        test_(test),
        results_(results),
        log_(log),
        ranks_(ranks),
        reported_(test.program().stages_ended()) {}

  // Stages that have not reached what they asked; once how a specimen is cut over ranks.
  void observe(const Moment &now) override;
  // What speaks against the test that has ended.
  void report_doubts(const Json &summary) const;

private:
  void report_misses(std::size_t from, bool ended) const;
  void report_path() const;

  const Scene &scene_;
  const coupling::PlatenTest &test_;
  const Results &results_;
  RunLog &log_;
  const dem::Exchange *ranks_;
  std::size_t reported_; // stages
};

} // namespace platen::apps
