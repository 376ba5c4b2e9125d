// The output folder of a study of a target, read as far as a report needs it, and its page.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

#include "apps/report/report.h"

namespace platen::apps::report {

struct TargetLook { // what was known after a batch of runs
  int runs = 0;
  double seconds = 0;        // of one core
  double mean = 0;           // in the figure's unit
  double half = 0;           // of the interval, relative
  std::vector<double> parts; // of it, as TargetResults::part_names
};

struct TargetResults {
  std::string title, figure, unit; // unit: "MPa", "GPa", or "" of a gain
  double accuracy = 0, confidence = 0;
  std::vector<std::string> part_names; // packings, chaos, speed, step
  std::vector<TargetLook> looks;       // empty where nothing could be told
  std::vector<std::string> remarks;
  std::filesystem::path folder; // that it was read from
};

// Throws InputError where study.json is missing, damaged, of another study or of one that has not ended.
TargetResults read_target(const std::filesystem::path &folder);

// A row for each look.
TableOfFigures table_of_target(const TargetResults &study);

// Draws the interval against seconds and the parts of the error into `folder`, puts them and the table on the
// page report.html there, and prints the same. Needs an X server; throws OutputError.
void write_target_report(const TargetResults &study, const std::filesystem::path &folder, std::ostream &out);

} // namespace platen::apps::report
