// What a checkpoint keeps of a problem.
#include "coupling/problem.h"

namespace platen::coupling {

void Problem::Cycle::describe(Archive &archive) {
  archive.version(1);
  archive("direction", direction);
  archive("speed", speed);
  archive("turns", turns);
  archive("strain", strain);
  archive("stress", stress, "Pa");
}

void Problem::describe(Archive &archive) {
  archive.version(1);
  archive("time_step", time_step_, "s");
  archive.text("time_step_reason", reason_);
  archive("steps", steps_);
  archive("near_at_choice", near_at_choice_);
  archive("boundary_work", boundary_work_, "J");
  archive("given_energy", given_energy_, "J");
  archive("reaction_top", reaction_top_, "N");
  archive("reaction_bottom", reaction_bottom_, "N");
  archive.part("specimen", model);
  archive.part("top", top);
  archive.part("top_contacts", top_layer);
  archive.part("bottom", bottom);
  archive.part("bottom_contacts", bottom_layer);
  if (quasi_static()) {
    archive.part("top_loads", top_loads_);
    archive.part("bottom_loads", bottom_loads_);
  }
  if (confinement_) archive.part("skin_pressure", *confinement_);
  if (sleeve_) archive.part("sleeve", *sleeve_);
  if (wall_) archive.part("wall", *wall_);
  if (servo_) archive.part("servo", *servo_);
  if (pace_) archive.part("rate_control", *pace_);
  if (!settings_.loading.unload_at.empty()) archive.part("cycle", cycle_);
  if (!cell()) return;
  archive("cell_end", cell_end_, "s");
  archive("cell_closure", cell_closure_);
  archive("path_deviator", path_deviator_, "Pa");
}

} // namespace platen::coupling
