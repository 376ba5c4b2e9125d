// What looks at a test between its steps: record, frames, messages, checkpoints, each in a file of its own.
// The loop (compression_run.h) makes steps until one of them has something to do, then calls all in their
// order.
#pragma once

#include <cmath>
#include <limits>

#include "apps/run/file_marks.h"
#include "apps/scene/quantities.h"
#include "coupling/platen_test.h"

namespace platen::apps {

// After the steps of a pass.
struct Moment {
  bool ends = false;             // the test is over
  int signal = 0;                // that stops the run; 0: none
  bool checkpoint_asked = false; // by a signal or a clock
};

// What ranks have to bring together of a specimen that is cut, before it is looked at.
enum class Gathered { nothing, motion, everything };

class Observer {
public:
  virtual ~Observer() = default;
  // Steps that can be made before it has something to do: a lower bound.
  virtual double steps_until_due() const { return std::numeric_limits<double>::infinity(); }
  virtual Gathered needs() const { return Gathered::nothing; }
  virtual void observe(const Moment &now) = 0;
  // Before a checkpoint: waits until the disk has what it wrote, and states where that ends.
  virtual void mark(FileMarks & /*marks*/) {}
  // Once, after the last step.
  virtual void finish() {}
};

// When something is written. Steps: every n-th. Times: the first step at or after each multiple. Neither:
// `automatic` times on the way to the target strain.
class Schedule {
public:
  // The interval is the scene's, which a script may change on the way.
  Schedule(const Interval &interval, double automatic, double expected_steps,
           const coupling::PlatenTest &test)
      : interval_(interval), open_(std::ceil(expected_steps / automatic)), test_(test) {}

  bool is_due() const {
    if (!by_time()) return std::fmod(steps(), every()) == 0;
    return std::floor(test_.time() / interval_.value) >
           std::floor((test_.time() - test_.time_step()) / interval_.value);
  }
  double steps_until_due() const { // a lower bound
    if (!by_time()) return every() - std::fmod(steps(), every());
    return (1 - std::fmod(test_.time() / interval_.value, 1.0)) * interval_.value / test_.time_step() - 1;
  }

private:
  bool by_time() const { return interval_.kind == Interval::Kind::time; }
  double steps() const { return static_cast<double>(test_.steps()); }
  double every() const {
    return std::fmax(1.0, interval_.kind == Interval::Kind::steps ? interval_.value : open_);
  }

  const Interval &interval_;
  double open_;
  const coupling::PlatenTest &test_;
};

} // namespace platen::apps
