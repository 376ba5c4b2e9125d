// What the tests of a calibration will be, before anything is packed.
#pragma once

#include <string>

#include "apps/calibrate/goals.h"
#include "apps/scene/command_line.h"

namespace platen::apps {

// Each test is a scene of its own: what it cannot be is refused, as InputError, at the target that asks for
// it. Returns lines for the screen: how many wave crossings the tests of wanted strengths are to take to
// their peaks, and what helps where they are too few; how long all trials take at most.
std::string expected_tests(const Scene &scene, const CommandLine &command, const Goals &goals);

} // namespace platen::apps
