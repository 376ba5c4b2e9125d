// Loading as a list of stages. A stage asks something of each boundary in every step, by what is measured,
// until it is over; it touches no particle.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/archive.h"
#include "coupling/boundary.h"

namespace platen::coupling {

// What a program sees of a test.
class Measures {
public:
  virtual ~Measures() = default;
  virtual double time() const = 0;                   // s; in a step that of its end
  virtual double time_step() const = 0;              // s
  virtual double closure_strain() const = 0;         // of the platens, over the height
  virtual double closure_strain(int axis) const = 0; // 0 x, 1 y, 2 z, over the length; NaN without platens
  virtual double circumferential_strain() const = 0; // of the lateral surface, where it widens positive
  virtual double axial_stress() const = 0;           // Pa, mean of both platens, compression positive
  virtual double lateral_pressure() const = 0;       // Pa
  virtual double broken_bonds() const = 0;           // since the start
  // Of a boundary by its place in the experiment's list: N, of the specimen on it; N, with which a platen
  // presses; the way that it presses; what it pushes against.
  virtual Vector3 force(std::size_t boundary) const = 0;
  virtual double load(std::size_t boundary) const = 0;
  virtual double moved_inward(
      std::size_t boundary) const = 0; // m, that the face of a platen has moved inward
  virtual Vector3 inward(std::size_t boundary) const = 0;
  virtual ServoLoad servo_load(std::size_t boundary) const = 0;
};

// Places of a test's boundaries in the experiment's list.
struct Sides {
  std::size_t bottom = 0, top = 1;
  std::optional<std::size_t> left, right, front, back; // platens of a box
  std::optional<std::size_t> lateral;                  // what presses the lateral surface
};
// What is asked of each boundary of an experiment, in the order of its list.
using Commands = std::vector<Command>;

// 0 to 1 without a jump in the rate, for x from 0 to 1.
inline double smooth_start(double x) {
  return x >= 1 ? 1.0 : x * x * (3 - 2 * x);
}

// From one stage to the next.
struct Transfer {
  Commands asked;               // in the step that has just ended; empty at the start of a test
  std::array<double, 3> zero{}; // closure strains along x, y, z from which strains count
};

// What a stage asks of a side and what is reached; compression and closing positive.
struct Controlled {
  static constexpr const char *pascal = "Pa";
  static constexpr int around = 3; // of what presses the lateral surface

  std::string quantity, side; // "stress", "lateral x"
  std::string unit;           // "Pa"; of rates "m/s" and "1/s", which are means over the stage
  int axis = 2;               // 0 x, 1 y, 2 z, or around
  bool held = false;          // it is asked to stay as it was found
  double asked = 0, reached = 0;
  double whole = 0; // what a hundredth is counted of: the size of what is asked, unless that is nothing

  // Within a hundredth. What is not finite is not met.
  bool is_met() const;
};

// Whether a stage loads the axis of the test on, in the sense of the test, and by what: a stress that falls
// where it is not loaded on falls by command, and one that stays while a stress is asked stays by command.
enum class Loads { none, by_closure, by_stress, by_widening };

class Stage {
public:
  virtual ~Stage() = default;
  virtual std::string name() const = 0;
  // Once, before its first command; the first stage of a test has begun at 0 s with no closure.
  void begin(const Measures &m, const Transfer &from, bool first);
  // Of a step whose particles have drifted, before forces. Finds commands that ask for nothing.
  virtual void command(const Measures &m, Commands &asked) = 0;
  // After forces.
  virtual void update(const Measures &) {}
  virtual bool has_ended(const Measures &m) const = 0;
  // Once, when it has ended.
  virtual void end(const Measures &) {}
  // Of one that had ended, by an earlier end than it has now: forgets that.
  virtual void go_on() {}
  // Of one that has ended, where it says so: by what, "strain", "settled" or `not_settled`: its time was over
  // and its stresses were not all borne.
  static constexpr const char *not_settled = "not settled";
  virtual std::string ended_by() const { return ""; }
  // Of one that has begun: as it is now, or was at its end.
  virtual std::vector<Controlled> controls(const Measures &) const { return {}; }

  virtual double expected_seconds() const = 0;            // until it ends, as far as that is known
  virtual double progress(const Measures &m) const = 0;   // 0 ... 1
  virtual double fastest() const { return 0; }            // m/s, closure speed that it may ask for
  virtual bool is_consolidation() const { return false; } // all sides alike, before the axial loading
  // From a turn of the platens until the strain of the turn has been reached again.
  virtual bool is_cycling(const Measures &) const { return false; }
  // Of the axis that the test loads. A stage of one's own that unloads says `none`.
  virtual Loads loads(const Measures &) const { return Loads::by_closure; }
  // Counts how often other sides have been asked something else: stresses compare within one number.
  virtual int setting() const { return 0; }

  double begun() const { return begun_; } // s
  double closure_gained(const Measures &m) const { return m.closure_strain() - closure_at_begin_; }
  virtual void describe(Archive &archive);

protected:
  virtual void on_begin(const Measures &, const Transfer &) {}

private:
  double begun_ = 0, closure_at_begin_ = 0; // s, 1
};

class Drive;

// The stages of a test, one after the other.
class Program {
public:
  // At least one stage; drives that go on from one to the next. `measures` outlives the program.
  Program(const Measures &measures, std::vector<std::unique_ptr<Stage>> stages,
          std::vector<std::shared_ptr<Drive>> drives = {});
  ~Program();

  // For a step whose particles have drifted: what is asked of each boundary.
  void command(Commands &asked);
  // After forces: goes on to the next stage where one is over. The last one goes on asking when it is over.
  void update();
  // A program that had finished, and was read with another end of its last stage, goes on where that is not
  // yet met. It is asked nothing else than if it had not finished in between.
  void go_on();

  // The platens that are driven close at another rate (m/s, positive) from the next step on, the way they go
  // now, until a stage asks anew. Throws std::invalid_argument where nothing, or more than one pair of
  // platens, is driven.
  void change_rate(double rate);

  bool finished() const { return finished_; }
  const Stage &stage() const { return *stages_[now_]; }
  const Stage &stage(std::size_t number) const { return *stages_[number]; }
  double fastest() const; // m/s, closure speed of any stage
  double expected_seconds() const;
  double progress() const; // 0 ... 1, of all stages by their expected times
  // Closure strain since the end of a consolidation; all of it without one, none while it lasts.
  double axial_closure() const;
  bool in_axial_stage() const { return finished_ || !stage().is_consolidation(); }
  bool is_cycling() const;
  Loads loads() const { return stage().loads(measures_); }
  std::size_t stage_number() const { return now_; } // from 0
  std::size_t stage_count() const { return stages_.size(); }
  std::size_t stages_ended() const { return now_ + (finished_ ? 1 : 0); }
  // What a stage that has begun asks and what is reached: now, or at its end. Empty of one that had ended in
  // a state before this was told.
  std::vector<Controlled> controls(std::size_t number) const;
  // Which stage was on at a time (s) up to now, from 0; at its end that one, not the next.
  std::size_t stage_at(double time) const;
  void describe(Archive &archive);

private:
  void begin_stage(bool first);

  const Measures &measures_;
  std::vector<std::unique_ptr<Stage>> stages_;
  std::vector<std::shared_ptr<Drive>> drives_;
  std::size_t now_ = 0;
  bool begun_ = false, finished_ = false;
  bool consolidated_ = false;    // the zero of strains is found
  std::array<double, 3> zero_{}; // closure strains at the end of a consolidation
  Commands last_;                // of the step that is being made
};

} // namespace platen::coupling
