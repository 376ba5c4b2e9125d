// What a study leaves: a row for each run, means and scatter for each case.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "apps/many/runs.h"
#include "apps/output/csv_writer.h"
#include "apps/output/output_folder.h"
#include "apps/output/seed_statistics.h"
#include "apps/output/summary.h"
#include "apps/study/cases.h"

namespace platen::apps {

// Rows of words for the screen, columns as wide as what stands in them.
std::string aligned(const std::vector<std::vector<std::string>> &rows);

class StudyTables {
public:
  // Begins study.csv and costs.csv anew: they follow from the folders of the runs.
  StudyTables(const StudyPlan &plan, const OutputPaths &paths);

  // Rows of a run, in the order of the runs.
  void add(const TestRun &run, const RunOutcome &outcome);

  int failed() const, missing() const; // runs
  // Whether a run is known to have borne its most: its stress fell to 0.8 of the peak, where damage is
  // measured. Else it has no strength that could be compared.
  static bool peaked(const Json &summary);
  // One object a case: labels, counts, {"mean", "deviation", "runs"} of each figure. Repeats to the byte.
  Json cases() const;
  // Of all runs (Pa; NaN: failed, or without a peak), by case, then by seed; once all rows are there.
  std::vector<std::vector<double>> strengths() const;
  // For the screen, with what a run of each case cost.
  std::string text() const;

private:
  struct OfCase {
    int runs = 0, failed = 0, missing = 0, without_peak = 0;
    std::map<std::string, SeedStatistics> figures; // by key of summary.json
    std::vector<double> strengths;                 // by seed
    std::map<std::string, int> patterns;           // runs that failed so
  };

  const StudyPlan &plan_;
  CsvWriter study_, costs_;
  std::vector<OfCase> cases_;
};

} // namespace platen::apps
