// Loading stages: sections alike, one after the other.
#include "apps/scene/sections.h"

namespace platen::apps {
namespace {

const char *control_words =
    "rate [SPEED], unload [SPEED], stress VALUE, share of SIDE VALUE, pressure VALUE, hold, "
    "free, circumferential rate VALUE, cmod rate VALUE";
const char *end_words =
    "[SIDE] strain, [SIDE] strain change, [SIDE] stress, [SIDE] share of peak, [SIDE] share of "
    "start, circumferential strain, cmod, time, each with its value; settled";

std::string about(coupling::SideGroup group) {
  using G = coupling::SideGroup;
  const std::string asked = " What it is asked; nothing said: it holds.";
  switch (group) {
    case G::axial:
      return "Top and bottom platen alike." + asked;
    case G::lateral:
      return "The pressure of a cell, or the platens of all four sides." + asked;
    case G::lateral_x:
      return "Left and right platen alike." + asked;
    case G::lateral_y:
      return "Front and back platen alike." + asked;
    default:
      return "The " + coupling::name_of(group) + " platen alone." + asked;
  }
}

void declare_stage(Parameters &parameters, StageSection &stage, std::size_t number) {
  Section section(parameters, section_of_stage(number));
  const std::string member = "loading.stage_" + std::to_string(number) + ".";
  for (const coupling::SideGroup group : coupling::all_side_groups)
    section
        .value(key_of(group), stage.controls.at(static_cast<std::size_t>(group)), "", control_words,
               read_control, about(group))
        .member(member + coupling::name_of(group));
  section
      .entry("Ramp", stage.ramp, "s", at_least(0),
             "From what the stage finds to what it asks, smoothly; 0: sixty wave crossings for a stress, ten "
             "for a "
             "rate.")
      .member(member + "ramp");
  section
      .entry("Hold", stage.hold, "s", at_least(0),
             "How long it goes on after the ramp before it counts as settled.")
      .member(member + "hold");
  section
      .value("Until", stage.until, "", end_words, read_until,
             "What ends it, any of a list. Strain: closure of the axis over its length since the end of a "
             "consolidation; strain change: since the stage began; shares: of the largest stress of the "
             "stage, or of "
             "that at its start, less a cell's pressure; settled: each stress is within 1 % of what is "
             "asked, or "
             "twice ramp and hold have passed.")
      .member(member + "until");
}

} // namespace

void declare_stages(Parameters &parameters, std::array<StageSection, most_stages> &stages) {
  parameters.declare_series(
      section_of_stage(1), stages.size(),
      [&stages](Parameters &to, std::size_t number) { declare_stage(to, stages[number - 1], number); });
}

} // namespace platen::apps
