// What a study leaves in tables: a row for each run, means and scatter for each case.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/many/runs.h"
#include "apps/output/csv_writer.h"
#include "apps/output/output_folder.h"
#include "apps/output/seed_statistics.h"
#include "apps/output/summary.h"
#include "apps/study/cases.h"

namespace platen::apps {

// Whether a run is known to have borne its most: its stress fell to 0.8 of the peak, where damage is
// measured. Else it has no strength that could be compared.
bool has_peaked(const Json &summary);

// What came of runs, by case, then by seed.
using Outcomes = std::vector<std::vector<RunOutcome>>;
// Pa; NaN: failed, or without a peak.
std::vector<std::vector<double>> strengths_of(const Outcomes &outcomes);

// Rows of words for the screen, columns as wide as what stands in them.
std::string aligned(const std::vector<std::vector<std::string>> &rows);

// A row of numbers and words; null and NaN are empty cells.
void write_row(CsvWriter &table, const Json &cells);
// A whole table of objects, by their keys: "mean", and "laboratory/mean" of a member of an object, whose
// column is laboratory_mean. Throws OutputError.
void write_table(const std::filesystem::path &csv, const std::vector<std::string> &keys, const Json &objects);

class StudyTables {
public:
  // Begins study.csv and costs.csv anew: they follow from the folders of the runs.
  StudyTables(const StudyPlan &plan, const OutputPaths &paths);

  // Rows of a run, in the order of the runs.
  void add(const TestRun &run, const RunOutcome &outcome);

  const Outcomes &outcomes() const { return outcomes_; }
  std::size_t count(const std::string &status) const; // runs that are "done", "failed", "missing"
  // One object a case: labels, counts, statistics of each figure. Repeats to the byte.
  Json cases() const;
  // For the screen, with what a run of each case cost.
  std::string text() const;

private:
  const StudyPlan &plan_;
  CsvWriter study_, costs_;
  Outcomes outcomes_;
};

} // namespace platen::apps
