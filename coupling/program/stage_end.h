// The end of a loading stage.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "coupling/program/task.h"

namespace platen::coupling {

// A condition that ends a stage.
struct Until {
  enum class Reached {
    strain,            // closure strain of the axis since the end of consolidation
    strain_change,     // since the stage began, of either sign
    stress,            // Pa, reached from below or above, depending on the stress at the start of the stage
    fraction_of_peak,  // of the largest stress of this stage, after the ramp: the stress has fallen to it
    fraction_of_start, // of the stress at the start of the stage: it has fallen to it
    circumferential_strain,
    mouth_opening, // m, of a notch
    time,          // s, since the stage began
    settled
  };
  Reached what = Reached::settled;
  double value = 0;
  PlatensOfAxis of; // the platens of that strain or stress
  // Of a strain: 1 where it rises (in compression, or in the sense of a tension test), -1 where it falls.
  double direction = 1;
  bool less_pressure = false; // stress fractions use stresses less the cell's pressure
};

// "strain change", "share of peak"
const char *name_of(Until::Reached what);
// The kind of widening that the condition reads; no value for other conditions.
std::optional<Widening> widening_of(Until::Reached what);

class StageEnd {
public:
  struct Parameters {
    std::vector<Until> any;
    double ramp = 0;  // s, of the stage
    double least = 0; // s, shortest time after which it may count as settled
    double latest = std::numeric_limits<double>::infinity(); // s, at which the stage ends in any case
  };
  explicit StageEnd(Parameters parameters);

  void begin(const Measures &m, const Transfer &from);
  void update(const Measures &m, double passed);
  // The condition in `any` that is met, from 1; `too_late` where none is met at the latest time; 0: it
  // continues. `passed`: s since the stage began; `settled`: all tasks have settled.
  static constexpr int too_late = -1;
  int reached(const Measures &m, double passed, bool settled) const;
  bool needs_settled() const;
  double progress(const Measures &m, double passed) const; // 0 ... 1, of a strain or a time; else 0
  const Parameters &parameters() const { return parameters_; }
  void describe(Archive &archive);

private:
  struct Seen { // for each of `any`
    double found = 0, largest = 0, zero = 0;
    void describe(Archive &archive);
  };
  double now(const Measures &m, const Until &until) const;
  bool is_met(const Measures &m, const Until &until, const Seen &seen, double passed, bool settled) const;

  Parameters parameters_;
  std::vector<Seen> seen_;
};

} // namespace platen::coupling
