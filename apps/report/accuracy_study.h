// The output folder of a study of accuracy, read as far as a report needs it, and its page.
#pragma once

#include <array>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "apps/report/platen_study.h"

namespace platen::apps::report {

constexpr std::size_t accuracy_measures = 4; // strength, strain at the peak, modulus, broken bonds

struct ErrorOverSeeds {
  Spread error;            // relative; NaN where nothing was compared
  double root_mean_square; // the same
  int runs;
};

struct AccuracyValue { // of one parameter
  std::string text;    // "0.9", "Effects/Rotation = off"
  double number;       // SI; NaN where it is none
  std::array<ErrorOverSeeds, accuracy_measures> errors;
  double seconds; // of wall clock, a run
};

struct AccuracyParameter {
  std::string name, unit;
  bool ordered = true;                             // from coarse to fine
  std::array<double, accuracy_measures> scatter{}; // of the reference's seeds, relative
  std::vector<AccuracyValue> values;               // the last is the reference
};

struct AccuracyResults {
  std::string title;
  std::vector<AccuracyParameter> parameters;
  std::vector<std::string> remarks; // what accuracy costs, and what failed
  std::filesystem::path folder;     // that it was read from
};

// Throws InputError where study.json is missing, damaged, of another study or of one that has not ended.
AccuracyResults read_accuracy(const std::filesystem::path &folder);

// A row for each value of each parameter.
TableOfFigures table_of_accuracy(const AccuracyResults &study);

// Draws errors against seconds, a line for each parameter, into `folder` (made where it is not there), puts
// them and the table on the page report.html there, and prints the same. Needs an X server; throws
// OutputError.
void write_accuracy_report(const AccuracyResults &study, const std::filesystem::path &folder,
                           std::ostream &out);

} // namespace platen::apps::report
