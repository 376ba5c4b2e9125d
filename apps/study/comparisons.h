// What platens and slenderness do to the strength: ratios of runs of one study on the same seed, with the
// laboratory's figures beside them.
#pragma once

#include <string>
#include <vector>

#include "apps/io/seed_statistics.h"
#include "apps/io/summary.h"
#include "apps/study/cases.h"
#include "apps/study/laboratory.h"

namespace platen::apps {

struct Comparison {
  PlatenEffect effect;
  std::size_t of = 0, over = 0; // StudyPlan::cases
  SeedStatistics ratio;
  const LaboratoryFigure *laboratory = nullptr; // null: none is known
};

// Strengths of all runs of a study of platens (Pa; NaN: failed or never peaked), by case, then by seed. Ends
// count as free where friction is at most 0.05; of several such platens those with the least friction are
// what the others are compared with.
std::vector<Comparison> compare(const StudyPlan &plan, const std::vector<std::vector<double>> &strengths);

// For study.json; repeats to the byte.
Json json_of(const StudyPlan &plan, const std::vector<Comparison> &comparisons);
Json json_of(const std::vector<LaboratoryFigure> &figures);
// For the screen; "" of nothing.
std::string text_of(const StudyPlan &plan, const std::vector<Comparison> &comparisons);

} // namespace platen::apps
