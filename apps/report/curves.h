// What a run measured as curves: stress and energies against strain, acoustic events by size. Pictures need
// an X server (display.h) and throw OutputError where the file cannot be written.
#pragma once

#include <filesystem>
#include <vector>

#include "apps/report/chart.h"
#include "apps/report/run_folder.h"
#include "dem/measure/acoustic_emission.h"

namespace platen::apps::report {

// Stress along the loaded axis against platen, gauge and lateral strain, the peak marked; below,
// broken bonds by mode against platen strain. Several runs share the axes, one colour each.
void draw_stress_strain(const std::vector<Run> &runs, const std::filesystem::path &png);

// The energy balance: where the work of the platens went, against platen strain.
void draw_energies(const Run &run, const std::filesystem::path &png);

enum class Stage { before_peak, after_peak };

// log10 of how many events have at least a magnitude: a step down at each event, from the smallest on.
struct MagnitudeCount {
  std::vector<double> magnitude, log_count;
};
// Of the events that began then; those without energy have no magnitude and do not count. The run must have
// events.
MagnitudeCount count_of(const Run &run, Stage stage);

// The law that the summary's b-value stands for, over its range.
struct FittedLine {
  bool is_there = false;
  dem::BValue law;
  std::string reason; // why it is not there
  double log_count(double magnitude) const;
  Curve curve(const std::string &when, Stroke stroke) const;
};
FittedLine line_of(const Run &run, Stage stage);

// What to see in the picture, and why there is no b-value where there is none.
std::string acoustic_caption(const Run &run);
// Whether the run has events with a magnitude.
bool tells_magnitudes(const Run &run);
// Both, before and after the peak. The run must have such events.
void draw_acoustic(const Run &run, const std::filesystem::path &png);

} // namespace platen::apps::report
