// How friction works between specimen and platens while the test goes on. Pictures need an X server
// (display.h) and throw OutputError where the file cannot be written.
#pragma once

#include <filesystem>
#include <vector>

#include "apps/report/platens.h"

namespace platen::apps::report {

// What one platen's contacts do together at a time.
struct FrictionState {
  double sliding_share = 0; // of the contacts
  double mobilised = 0;     // sum of friction over sum of pressing forces
  double slip = 0;          // m, mean of the contacts, each as heavy as it presses
};
// NaN of everything where nothing presses.
FrictionState friction_state(const PlatenContacts &contacts);

// The coefficients of friction of a platen, as the scene of the run says; NaN where it says none.
struct FrictionLimits {
  double at_rest, sliding;
};
FrictionLimits friction_limits(const Run &run, Side side);

// Whether the scene glues the ends to the platens.
bool is_glued(const Run &run);
// Whether spheres press on platens that they are not glued to, in any frame.
bool tells_friction(const Run &run);

// Against time: share of the contacts that slide, mobilised friction with its limits, slip, work of friction.
void draw_friction(const Run &run, const std::filesystem::path &png);

} // namespace platen::apps::report
