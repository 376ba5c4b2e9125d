// What a run measured as curves: stress and energies against strain, acoustic events by size. Pictures need
// an X server (display.h) and throw OutputError where the file cannot be written.
#pragma once

#include <filesystem>
#include <vector>

#include "apps/report/run_folder.h"

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

// The line log10 N = log10 n - b (M - limit) that the summary's b-value stands for.
struct FittedLine {
  bool is_there = false; // too few events have none
  double b = 0, error = 0, limit = 0, events = 0;
  double log_count(double magnitude) const;
};
FittedLine line_of(const Run &run, Stage stage);

// Both, before and after the peak. The run must have events, at least one.
void draw_acoustic(const Run &run, const std::filesystem::path &png);

} // namespace platen::apps::report
