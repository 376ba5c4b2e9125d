// Loading as a list of stages. In every step a stage sends a command to each boundary, computed from
// measures, until the stage ends; it does not access particles.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/archive.h"
#include "coupling/boundary.h"

namespace platen::coupling {

// How a specimen widens: the strain of its circumference (1), or the opening of the mouth of its notch (m).
enum class Widening { circumference, mouth };

// The measures of a test that a program reads.
class Measures {
public:
  virtual ~Measures() = default;
  virtual double time() const = 0;                   // s; during a step, the time at its end
  virtual double time_step() const = 0;              // s
  virtual double closure_strain() const = 0;         // of the platens, over the height
  virtual double closure_strain(int axis) const = 0; // 0 x, 1 y, 2 z, over the length; NaN without platens
  virtual double widening(Widening of) const = 0;    // positive where it widens
  virtual double axial_stress() const = 0;           // Pa, mean of both platens, compression positive
  virtual double lateral_pressure() const = 0;       // Pa
  virtual double broken_bonds() const = 0;           // since the start
  // Of a boundary by its index in the experiment's list: N, force of the specimen on it; N, load with which a
  // platen presses; its direction of pressing; the resistance to it.
  virtual Vector3 force(std::size_t boundary) const = 0;
  virtual double load(std::size_t boundary) const = 0;
  virtual double moved_inward(std::size_t boundary) const = 0; // m, displacement of a platen's face inward
  virtual Vector3 inward(std::size_t boundary) const = 0;
  virtual ServoLoad servo_load(std::size_t boundary) const = 0;
};

// Indices of a test's boundaries in the experiment's list.
struct Sides {
  std::size_t bottom = 0, top = 1;
  std::optional<std::size_t> left, right, front, back; // platens of a box
  std::optional<std::size_t> lateral;                  // the boundary that presses the lateral surface
};
// The command to each boundary of an experiment, in the order of its list.
using Commands = std::vector<Command>;

// 0 to 1 without a jump in the rate, for x from 0 to 1.
inline double smooth_start(double x) {
  return x >= 1 ? 1.0 : x * x * (3 - 2 * x);
}

// What a stage takes over from the one before it.
struct Transfer {
  Commands commands;            // commands of the step that has just ended; empty at the start of a test
  std::array<double, 3> zero{}; // closure strains along x, y, z from which strains count
};

// The prescribed and the reached value of a side in a stage; compression and closing positive.
struct Controlled {
  static constexpr const char *pascal = "Pa";
  static constexpr int around = 3; // the axis of a lateral surface

  std::string quantity, side; // "stress", "lateral x"
  std::string unit;           // "Pa"; of rates "m/s" and "1/s", which are means over the stage
  int axis = 2;               // 0 x, 1 y, 2 z, or around
  bool constant = false;      // prescribed to stay as at the start of the stage
  double target = 0, reached = 0;
  double reference = 0; // of the tolerance of 1 %: the magnitude of `target`, unless that is zero

  // Within 1 %; false where a value is not finite.
  bool is_met() const;
};

// How a stage increases the load along the loaded axis in the sense of the test. With `none` the load does
// not increase: a fall of the stress, or a constant stress under stress control, is then prescribed.
enum class Loads { none, by_closure, by_stress, by_widening };

class Stage {
public:
  virtual ~Stage() = default;
  virtual std::string name() const = 0;
  // Called once, before its first command; the first stage of a test has begun at 0 s with no closure.
  void begin(const Measures &m, const Transfer &from, bool first);
  // Called after the drift of the particles, before forces. All commands are zero on entry.
  virtual void command(const Measures &m, Commands &commands) = 0;
  // After forces.
  virtual void update(const Measures &) {}
  virtual bool has_ended(const Measures &m) const = 0;
  // Called once, when the stage has ended.
  virtual void end(const Measures &) {}
  // For a stage that had ended by an earlier end than it has now: cancels the end.
  virtual void go_on() {}
  // For a stage that has ended: the reason, if known, "strain", "settled" or `not_settled`: its time was over
  // and not all of its stresses were reached.
  static constexpr const char *not_settled = "not settled";
  virtual std::string ended_by() const { return ""; }
  // For a stage that has begun: present values, or those at its end.
  virtual std::vector<Controlled> controls(const Measures &) const { return {}; }

  virtual double expected_seconds() const = 0;            // duration, as far as it is known
  virtual double progress(const Measures &m) const = 0;   // 0 ... 1
  virtual double fastest() const { return 0; }            // m/s, largest closure speed that it may command
  virtual bool is_consolidation() const { return false; } // all sides alike, before the axial loading
  // From a reversal of the platens until its strain has been reached again.
  virtual bool is_cycling(const Measures &) const { return false; }
  // For the loaded axis. A user-defined stage that unloads returns `none`.
  virtual Loads loads(const Measures &) const { return Loads::by_closure; }
  // Number of changes of what is prescribed on other sides: stresses are comparable within one number.
  virtual int setting() const { return 0; }

  double begun() const { return begun_; } // s
  virtual void describe(Archive &archive);

protected:
  virtual void on_begin(const Measures &, const Transfer &) {}

private:
  double begun_ = 0, closure_at_begin_ = 0; // s, 1; the second is read by nobody but is in checkpoints
};

class Drive;

// The stages of a test, one after the other.
class Program {
public:
  // At least one stage; drives that continue from one stage to the next. `measures` outlives the program.
  Program(const Measures &measures, std::vector<std::unique_ptr<Stage>> stages,
          std::vector<std::shared_ptr<Drive>> drives = {});
  ~Program();

  // Called after the drift of the particles: sets the command of each boundary.
  void command(Commands &commands);
  // After forces: goes to the next stage where one has ended. The last one continues after its end.
  void update();
  // A program that had finished, and was read with another end of its last stage, continues where that end is
  // not yet met. Its commands are the same as if it had not finished in between.
  void go_on();

  // The driven platens close at another rate (m/s, positive) from the next step on, in the present direction,
  // until a stage sets a new rate. Throws std::invalid_argument where no pair of platens, or more than one,
  // is driven.
  void change_rate(double rate);

  bool finished() const { return finished_; }
  const Stage &stage() const { return *stages_[now_]; }
  const Stage &stage(std::size_t number) const { return *stages_[number]; }
  double fastest() const; // m/s, largest closure speed of any stage
  double expected_seconds() const;
  double progress() const; // 0 ... 1, of all stages by their expected times
  // Closure strain since the end of a consolidation; since the start without one; zero during it.
  double axial_closure() const;
  bool in_axial_stage() const { return finished_ || !stage().is_consolidation(); }
  bool is_cycling() const;
  Loads loads() const { return stage().loads(measures_); }
  std::size_t stage_number() const { return now_; } // from 0
  std::size_t stage_count() const { return stages_.size(); }
  std::size_t stages_ended() const { return now_ + (finished_ ? 1 : 0); }
  // Prescribed and reached values of a stage that has begun: now, or at its end. Empty for a stage that had
  // ended in a state from an older version without them.
  std::vector<Controlled> controls(std::size_t number) const;
  // Number of the stage that was active at a time (s) up to now, from 0; at a stage's end that one, not the
  // next.
  std::size_t stage_at(double time) const;
  void describe(Archive &archive);

private:
  void begin_stage(bool first);

  const Measures &measures_;
  std::vector<std::unique_ptr<Stage>> stages_;
  std::vector<std::shared_ptr<Drive>> drives_;
  std::size_t now_ = 0;
  bool begun_ = false, finished_ = false;
  bool consolidated_ = false;    // the zero of strains is known
  std::array<double, 3> zero_{}; // closure strains at the end of a consolidation
  Commands last_;                // of the current step
};

} // namespace platen::coupling
