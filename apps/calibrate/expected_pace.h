// How fast the tests of a calibration are to be, before anything is packed.
#pragma once

#include <string>
#include <vector>

#include "apps/calibrate/goals.h"
#include "apps/scene/command_line.h"

namespace platen::apps {

struct ExpectedPace {
  std::string test;    // as SpecimenTest names it
  double rate = 0;     // m/s
  double transits = 0; // of a wave over the specimen until the peak, about
  std::string entry;   // that sets the rate
};

// Of compression tests without a cell and of tension tests whose strength, strain at the peak or curve is
// wanted beside Young's modulus; nothing of others. A guess: that a specimen of the wanted figures is
// strained as ready concretes are at their peak, and that its bonds are as much stiffer than it.
std::vector<ExpectedPace> expected_paces(const Scene &scene, const CommandLine &command, const Goals &goals);

} // namespace platen::apps
