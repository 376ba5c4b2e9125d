// What loading stages are told: what each side is asked, how it starts, when it is over.
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
// The sides that it is made of; of the lateral surface all four.
std::vector<Side> sides_of(SideGroup group);

// Of one side. Compression positive.
struct SideAsk {
  enum class Ask {
    rate,            // m/s, closure of all its platens together, each at its part of it; negative: they part
    stress,          // Pa, by a servo
    share,           // of the stress of `of`
    pressure,        // Pa, of a cell
    hold,            // platens stand; a pressure stays
    free,            // no stress
    circumferential, // 1/s, at which the specimen widens: the axial platens close or part as that asks
  };
  SideGroup side = SideGroup::axial;
  Ask ask = Ask::hold;
  double value = not_given;        // a rate that is not given is that of the loading
  bool back = false;               // of a rate: platens part at it
  SideGroup of = SideGroup::axial; // of a share
  double path = 0;                 // of a pressure, 1: what it gains per deviator of the stage
  // Of a servo, where they are not chosen: gain and limit; s, how far ahead it is told what will be asked.
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
  std::vector<SideAsk> asks;     // sides that are not named hold
  double ramp = 0;               // s, from what is found to what is asked; 0: chosen
  double hold = 0;               // s, how long it goes on after the ramp before it counts as settled
  std::vector<StageUntil> until; // any of them; none: never
  // s, at which it is over though it has not settled; not given: twice ramp and hold.
  double latest = not_given;
};

// Whether it is led or ended by the circumferential strain.
bool needs_circumferential_strain(const StageSettings &stage);

// What stages can ask of a test.
struct StageScope {
  std::vector<Side> platens; // that there are
  bool cell = false;         // presses the lateral surface
  bool rate = false;         // of the loading is given, or follows from wave transits
  bool bonded = true;        // a wave's time over the specimen sets ramps
};

// Throws BadSetup where stages cannot be: its member is "loading.stage_2.top" or "loading.stage_2.until".
void require_stages(const std::vector<StageSettings> &stages, const StageScope &scope);

} // namespace platen::coupling
