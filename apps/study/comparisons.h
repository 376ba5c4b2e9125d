// What platens and slenderness do to the strength: ratios of runs of one study on the same seed, with the
// laboratory's figures beside them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/output/seed_statistics.h"
#include "apps/output/summary.h"
#include "apps/study/cases.h"

namespace platen::apps {

enum class PlatenEffect {
  gain,              // strength over that between free ends, at one slenderness
  relative_strength, // strength over that at height over width 2, between the same platens
  cube_over_prism    // strength at height over width 1 over that of a prism, between the same platens
};

const char *word(PlatenEffect effect);

struct LaboratoryFigure {
  PlatenEffect effect;
  bool free_ends;         // of ends that are free to spread, else of steel platens
  double slenderness;     // height over width; of the cube where cube over prism
  double mean, low, high; // 1; the range of what was measured, else the source says what it is
  std::string source;     // author, year; of figures that were read, no others
};

const std::vector<LaboratoryFigure> &laboratory_figures();

// The figure for the same effect and ends at about this slenderness; null where there is none.
const LaboratoryFigure *laboratory_figure(PlatenEffect effect, bool free_ends, double slenderness);

struct Comparison {
  PlatenEffect effect;
  std::size_t of = 0, over = 0; // StudyPlan::cases
  SeedStatistics ratio = {};
  const LaboratoryFigure *laboratory = nullptr; // null: none is known
  std::string reason = {};                      // why there is no ratio; "" where the bonds may have one

  // The mean against what laboratories measured, "within" or "outside"; "" where either is missing.
  const char *verdict() const {
    if (laboratory == nullptr || ratio.count() == 0) return "";
    return laboratory->low <= ratio.mean() && ratio.mean() <= laboratory->high ? "within" : "outside";
  }
};

// Strengths of all runs of a study of platens (Pa; NaN: failed or never peaked), by case, then by seed. Ends
// count as free where friction is at most 0.05; of several such platens those with the least friction are
// what the others are compared with. A ratio that the bonds are not calibrated for is none, with the reason.
std::vector<Comparison> compare(const StudyPlan &plan, const std::vector<std::vector<double>> &strengths,
                                const CalibratedFor &bonds = {});

// For study.json; repeats to the byte.
void to_json(Json &json, const LaboratoryFigure &figure);
Json json_of(const StudyPlan &plan, const std::vector<Comparison> &comparisons);
// The same as comparisons.csv, a row each. Throws OutputError.
void write_comparisons(const std::filesystem::path &csv, const Json &comparisons);
// For the screen; "" of nothing.
std::string text_of(const StudyPlan &plan, const std::vector<Comparison> &comparisons);

} // namespace platen::apps
