// The output folder of a study of size, packing or rate: strength, modulus and strain at the peak over what
// was varied.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "apps/report/platen_study.h"
#include "apps/report/report.h"

namespace platen::apps::report {

struct VariedColumn { // of those that differ between cases
  std::string key, title;
  double factor = 1; // from SI to the title's unit
  bool logarithmic = false;
};

struct ParameterCase {
  std::string name;
  std::vector<double> labels; // of ParameterStudy::columns, in the titles' units; NaN where it has none
  int runs = 0, failed = 0;
  Spread particles, packing, strength, modulus, poisson, strain; // 1, 1, MPa, GPa, 1, mm/m
};

struct ParameterStudy {
  std::string title, kind;
  std::vector<VariedColumn> columns; // the first is the x axis
  std::vector<ParameterCase> cases;
  std::vector<std::string> remarks;
  std::filesystem::path folder; // that it was read from
};

bool is_parameter_study(const std::string &kind);

// Throws InputError where study.json is missing, damaged, of another kind or of a study that has not ended.
ParameterStudy read_parameter_study(const std::filesystem::path &folder);

// A row for each case.
TableOfFigures table_of(const ParameterStudy &study);

// A curve for each choice of what is varied beside the x axis, bars of scatter; cases without a figure are
// gaps. Needs an X server; throws OutputError.
void draw_parameter_study(const ParameterStudy &study, const std::filesystem::path &png);

// Picture and table on the page report.html of `folder`, and prints the same.
void write_parameter_report(const ParameterStudy &study, const std::filesystem::path &folder,
                            std::ostream &out);

} // namespace platen::apps::report
