// When a run leaves a checkpoint: at intervals, when a signal stops it or asks for one, and at its end, from
// where a test that has not shown its peak is led on.
#pragma once

#include <functional>
#include <utility>

#include "apps/output/output_folder.h"
#include "apps/run/observer.h"
#include "apps/run/results.h"
#include "apps/scene/scene.h"
#include "base/clock.h"

namespace platen::apps {

class Checkpoints : public Observer {
public:
  // `marks`: of all files of the run, which the disk then has.
  Checkpoints(const Scene &scene, coupling::PlatenTest &test, Results &results, const OutputPaths &paths,
              std::function<FileMarks()> marks)
      : every_(scene.checkpoint.every),
        test_(test),
        results_(results),
        paths_(paths),
        marks_(std::move(marks)) {}

  bool are_kept() const { return every_.kind != Interval::Kind::none; }
  bool are_by_clock() const { return every_.kind == Interval::Kind::time; }
  bool is_due() const;

  double steps_until_due() const override;
  void observe(const Moment &now) override;

private:
  const Interval &every_; // time: of wall clock
  coupling::PlatenTest &test_;
  Results &results_;
  const OutputPaths &paths_;
  std::function<FileMarks()> marks_;
  Clock::time_point last_ = Clock::now();
};

} // namespace platen::apps
