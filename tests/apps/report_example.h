// Writes output folders of a made-up crushed cylinder, as the apps would, for tests of the report: known
// numbers in, so that what comes out can be judged.
#pragma once

#include <filesystem>

namespace platen::apps::report {

struct ExampleRun {
  double radius = 0.025, height = 0.1; // m
  double spacing = 0.005;              // m, between sphere centres, roughly
  double peak_stress = 40e6;           // Pa
  bool hourglass = true;   // the middle is destroyed and the ends are sound; else the other way round
  double first_height = 0; // m, where the specimen starts
  bool square = false;     // a box, `radius` is half its width
};

// What the example is made of; times in s.
constexpr double example_peak_time = 1.0, example_fall_time = 1.5, example_end_time = 2.0;

// Contacts with the platens press evenly, with the peak stress times the time over 1 s; they are drawn
// inwards by this share of it at the rim, in proportion to the radius, and stick within this share of the
// area.
constexpr double example_inward_shear = 0.2, example_sticking_share = 0.64;

// Stress falls linearly from the peak at 1 s to 0.6 of it at 2 s, so that 0.8 is met at 1.5 s; strain is
// 0.0025 t. Frames lie at 0, 1, 1.5 and 2 s. Bonds join neighbours; those within a quarter of the height from
// the middle (or from an end, without hourglass) are broken from 1.5 s on, nine in ten of them in tension.
void write_example(const std::filesystem::path &folder, const ExampleRun &run);

} // namespace platen::apps::report
