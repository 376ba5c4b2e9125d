// Values of a scene that a number alone does not state.
#pragma once

#include "dem/laws/contact_settings.h"

namespace platen::apps {

// How often: a count of steps, a time (simulated seconds; wall clock for checkpoints), or none of both.
struct Interval {
  enum class Kind { none, steps, time }; // none: the app chooses, or the thing is off (see the member)
  Kind kind = Kind::none;
  double value = 0; // steps or s
};

using dem::Gap;
using dem::Stiffness;

} // namespace platen::apps
