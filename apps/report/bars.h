// Horizontal bars with a name before and words after each: where the seconds of a run went, and which way its
// cracks face. Pictures need an X server (display.h) and throw OutputError where the file cannot be written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/report/canvas.h"
#include "apps/report/run_folder.h"

namespace platen::apps::report {

struct Bar {
  std::string name, words;
  double value = 0; // not negative
  Colour colour = colours::blue;
};

// From above to below at one scale, the longest over the whole width. `mark`, where it is above 0, draws a
// line at that value.
void save_bars(const std::string &title, const std::string &subtitle, const std::vector<Bar> &bars,
               double mark, const std::filesystem::path &png);

struct Cost {
  std::string name;
  double seconds = 0;
  bool is_stage = true; // of the steps; else setting up, and what no clock saw
};

// What a run cost, as its summary says: the largest first; the rest of the wall clock last. Empty where the
// summary has no stage_seconds.
std::vector<Cost> costs_of(const Run &run);

// "2.63 million sphere steps a second, 1 thread, Intel ..., 190 MB at most"; what is not known is left out.
std::string machine_words(const Run &run);

// Seconds of each stage. The run must have costs.
void draw_costs(const Run &run, const std::filesystem::path &png);

// Area of all cracks by the angle of their normals to the axis, over that of cracks that face all ways alike.
// The summary must have it.
bool tells_rose(const Run &run);
void draw_crack_rose(const Run &run, const std::filesystem::path &png);

} // namespace platen::apps::report
