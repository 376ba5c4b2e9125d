// Settings of loading stages: what is prescribed on each side, how a stage starts, when it ends.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/describe.h"
#include "coupling/program/platen_speed.h"
#include "coupling/program/stage_end.h"
#include "coupling/side.h"

namespace platen::coupling {

// One side, two opposite ones, or the lateral surface: the pressure of a cell, or the platens of all four
// sides.
enum class SideGroup { axial, lateral, lateral_x, lateral_y, bottom, top, left, right, front, back };

// "axial", "lateral_x"
std::string name_of(SideGroup group);
std::string words_of(SideGroup group); // "lateral x"
inline constexpr std::array<SideGroup, 10> all_side_groups{
    SideGroup::axial, SideGroup::lateral, SideGroup::lateral_x, SideGroup::lateral_y, SideGroup::bottom,
    SideGroup::top,   SideGroup::left,    SideGroup::right,     SideGroup::front,     SideGroup::back};
// The sides of the group; for the lateral surface all four.
std::vector<Side> sides_of(SideGroup group);

// What is prescribed on one side. Compression positive.
struct SideControl {
  enum class Mode {
    rate,            // m/s, closure of all its platens together; negative: they open
    stress,          // Pa, by a servo
    fraction,        // of the stress of `of`
    pressure,        // Pa, of a cell
    hold,            // platens stand still; a pressure stays constant
    free,            // no stress
    circumferential, // 1/s, circumferential strain rate: the axial platens close or open to reach it
    mouth_opening,   // m/s, of the mouth of a notch, likewise
  };
  SideGroup side = SideGroup::axial;
  Mode mode = Mode::hold;
  double value = not_given;        // a rate that is not given is that of the loading
  bool back = false;               // of a rate: platens open at it
  SideGroup of = SideGroup::axial; // of a fraction
  double path = 0;                 // of a pressure, 1: increase per deviator of the stage
  // Servo parameters, chosen by default: gain and limit; s, time by which it gets its target in advance.
  std::optional<Servo::Parameters> servo;
  double lead = not_given;
};

struct StageUntil {
  Until::Reached what = Until::Reached::settled;
  double value = not_given;
  SideGroup of = SideGroup::axial;
};

struct StageSettings {
  std::string name;
  std::vector<SideControl> controls; // sides without one hold
  double ramp = 0;                   // s, from the values at the start to the prescribed ones; 0: chosen
  double hold = 0;                   // s, duration after the ramp before the stage counts as settled
  std::vector<StageUntil> until;     // the first that is met; none: never
  // s, at which the stage ends although it has not settled; not given: twice ramp and hold.
  double latest = not_given;
};

// By which widening the axial platens are controlled; none where something else is prescribed.
std::optional<Widening> widening_of(SideControl::Mode mode);
// Whether the stage is controlled or ended by it.
bool needs(const StageSettings &stage, Widening of);

// What a test has for its stages.
struct StageScope {
  std::vector<Side> platens; // that the test has
  bool cell = false;         // presses the lateral surface
  bool rate = false;         // of the loading is given, or follows from wave transits
  bool bonded = true;        // ramps follow from the wave transit over the specimen
  bool bent = false;         // in three points
  bool notched = false;      // or it is not known yet whether it is
};

// Throws BadSetup for invalid stages: its member is "loading.stage_2.top" or "loading.stage_2.until".
void require_stages(const std::vector<StageSettings> &stages, const StageScope &scope);

} // namespace platen::coupling
