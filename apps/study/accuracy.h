// Errors of a study of accuracy against its references, seed by seed, and what they cost.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/many/runs.h"
#include "apps/output/seed_statistics.h"
#include "apps/output/summary.h"
#include "apps/study/cases.h"

namespace platen::apps {

// What errors are told of; broken bonds are those at the end of a run.
enum class Measure { strength, strain_at_peak, modulus, broken_bonds };
constexpr std::size_t measure_count = 4;
const char *word(Measure measure);

struct ValueErrors {                                // of one value of a parameter, over the seeds
  std::array<SeedStatistics, measure_count> errors; // over the reference on the same seed, less one
  SeedStatistics residual, kinetic, steps;          // as in summary.json
  SeedStatistics seconds;                           // of wall clock, a run
  const SeedStatistics &of(Measure m) const { return errors[static_cast<std::size_t>(m)]; }
};

struct ParameterErrors {
  // Standard deviation over mean of the reference's seeds: accuracy below it is lost among specimens.
  std::array<double, measure_count> scatter;
  std::vector<ValueErrors> values; // as StudiedParameter::values
  double scatter_of(Measure m) const { return scatter[static_cast<std::size_t>(m)]; }
};

class Accuracy {
public:
  explicit Accuracy(const StudyPlan &plan) : plan_(plan), cases_(plan.cases.size()) {}

  // Runs, in their order. A run that failed or never peaked has no strength and no strain at the peak.
  void add(const TestRun &run, const RunOutcome &outcome);

  // Once all runs are there, by parameters of the plan.
  std::vector<ParameterErrors> errors() const;
  // A row for each value of each parameter and each seed; repeats to the byte.
  void write_rows(const std::filesystem::path &csv) const;

private:
  struct Run {
    const char *status;                         // "done", "failed", "missing"
    std::array<double, measure_count> measures; // SI; NaN: not measured
    double residual, kinetic, steps, seconds;
  };
  double error(const StudiedParameter &parameter, std::size_t value, std::size_t seed,
               std::size_t measure) const;

  const StudyPlan &plan_;
  std::vector<std::vector<Run>> cases_; // by case, then by seed
};

// The cheapest value of an ordered parameter whose error is within a bound (root mean square over all seeds),
// as are those of all finer values: what one coarse value reaches by chance does not count. Nothing where
// even the finest below the reference is beyond it.
std::optional<std::size_t> cheapest_within(const ParameterErrors &of, Measure measure, double bound);

// For study.json: what repeats to the byte, and what runs cost.
Json json_of(const StudyPlan &plan, const std::vector<ParameterErrors> &errors);
Json costs_of(const StudyPlan &plan, const std::vector<ParameterErrors> &errors);
// For the screen: a table for each parameter, and what accuracy costs in words.
std::string text_of(const StudyPlan &plan, const std::vector<ParameterErrors> &errors);

} // namespace platen::apps
