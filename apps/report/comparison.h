// Figures of several runs as a table of text.
#pragma once

#include <string>
#include <vector>

#include "apps/report/run_folder.h"

namespace platen::apps::report {

struct TableOfFigures {
  std::vector<std::string> header; // first the figure's title, then one column a run, then the gains
  std::vector<std::vector<std::string>> rows; // as many fields as the header; "-" for what was not measured
};

// The figures of the summaries; with several runs also what the first gains over each other one (its figure
// divided by theirs).
TableOfFigures table_of_figures(const std::vector<Run> &runs);

// The table in columns, one line a row, each line ended.
std::string as_text(const TableOfFigures &table);

} // namespace platen::apps::report
