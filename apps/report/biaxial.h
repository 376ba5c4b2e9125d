// Strength under two stresses at once, over the uniaxial one: runs beside each other, and what was published.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/report/sides.h"

namespace platen::apps::report {

struct BiaxialPoint {
  std::string run, surface;     // of its platens, in words
  double first = 0, second = 0; // 1, the larger and the smaller stress at failure over the uniaxial strength
};

struct BiaxialStrengths {
  std::vector<BiaxialPoint> points;
  std::vector<std::string> left_out; // runs with platens on their sides that gave no point, and why
};

// A point for each run with platens on its sides that has failed between two stresses (the third below 2 % of
// the first); (1, 0) for those without stress on the sides, each the reference of the others with the same
// platens.
BiaxialStrengths biaxial_strengths(const std::vector<Run> &runs);

// Whether there is a point besides those of free sides.
bool tells_envelope(const BiaxialStrengths &strengths);

// A curve for each kind of platens, with what was published. Needs an X server (display.h); throws
// OutputError.
void draw_biaxial(const BiaxialStrengths &strengths, const std::filesystem::path &png);

} // namespace platen::apps::report
