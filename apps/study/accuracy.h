// Errors of a study of accuracy against its references, seed by seed, and what they cost.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/output/seed_statistics.h"
#include "apps/output/summary.h"
#include "apps/study/tables.h"

namespace platen::apps {

// What errors are told of; broken bonds are those at the end of a run.
enum class Measure { strength, strain_at_peak, modulus, broken_bonds };
constexpr std::array all_measures{Measure::strength, Measure::strain_at_peak, Measure::modulus,
                                  Measure::broken_bonds};

struct ValueErrors {                                      // of one value of a parameter, over the seeds
  std::array<SeedStatistics, all_measures.size()> errors; // over the reference on the same seed, less one
  std::array<SeedStatistics, 3> numbers; // relative residual of energy, kinetic over internal energy, steps
  SeedStatistics seconds;                // of wall clock, a run
  const SeedStatistics &of(Measure m) const { return errors[static_cast<std::size_t>(m)]; }
};

struct ParameterErrors {
  // Standard deviation over mean of the reference's seeds: accuracy below it is lost among specimens.
  std::array<double, all_measures.size()> scatter;
  std::vector<ValueErrors> values; // as StudiedParameter::values
  double scatter_of(Measure m) const { return scatter[static_cast<std::size_t>(m)]; }
};

// By parameters of the plan. A run that failed or never peaked has no strength, no strain at the peak and no
// modulus.
std::vector<ParameterErrors> errors_of(const StudyPlan &plan, const Outcomes &outcomes);
// A row for each value of each parameter and each seed; repeats to the byte. Throws OutputError.
void write_errors(const std::filesystem::path &csv, const StudyPlan &plan, const Outcomes &outcomes);

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
