// Tests by stages: what each stage asked and where it ended. Pictures need an X server (display.h) and throw
// OutputError where the file cannot be written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/report/run_folder.h"

namespace platen::apps::report {

struct TableOfFigures;

// Rows of the history that a stage (from 1) was sampled in, and the last one before it: where it began.
struct StageRows {
  int number = 1;
  std::size_t first = 0, last = 0;
};
// None where the scene wrote no stages.
std::vector<StageRows> stages_of(const Run &run);
// The row at the end of stages of consolidation, as the summary tells them; the first one without.
std::size_t end_of_consolidation(const Run &run);
// "Lateral pressure 4 MPa, Top stress 4 MPa", as the scene of the run has it.
std::string stage_words(const Run &run, int number);

// Along the loaded axis: stress against strain, a colour for each stage; with stress on the sides the
// deviator against the strains along and across, of a test that is led by its circumference that strain;
// stresses against time. The run must have stages.
void draw_stages(const Run &run, const std::filesystem::path &png);
// A row for each stage.
TableOfFigures table_of_stages(const Run &run);

} // namespace platen::apps::report
