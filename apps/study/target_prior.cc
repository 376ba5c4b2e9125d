#include "apps/study/target_prior.h"

#include <cmath>
#include "apps/study/study_section.h"

namespace platen::apps {
namespace {

// Deviations of the logarithm for one sphere: both fall as 1 / sqrt(spheres).
struct Deviations {
  double packing, chaos;
};

// Concrete between dry platens, docs/accuracy.md. Strength of 728 and of 5 018 spheres: packings 6 and 2.5 %,
// chaos 2.5 and 1 %. Modulus: packings 4.3 and 1.6 %, chaos .5 and .3 %. Gain by platen friction of cubes of
// 5 021: 1.7 and 0.9 %. Gains over other scenes may share less, or more, of what packings do.
constexpr Deviations of_strength{1.7, 0.7}, of_modulus{1.15, 0.2}, of_gain{1.2, 0.7};

// One degree: of another material, spheres or loading the spread may well be half or twice as large. Its
// parts go together more closely.
constexpr double sum_freedom = 1, ratio_freedom = 4;

Deviations of_one_sphere(TargetFigure figure) {
  switch (figure) {
    case TargetFigure::strength:
      return of_strength;
    case TargetFigure::modulus:
      return of_modulus;
    case TargetFigure::gain:
      return of_gain;
  }
  return of_strength;
}

} // namespace

SpreadPrior expected_spread(TargetFigure figure, double spheres) {
  const Deviations one = of_one_sphere(figure);
  return {{one.packing * one.packing / spheres, one.chaos * one.chaos / spheres}, sum_freedom, ratio_freedom};
}

RunErrors expected_errors(TargetFigure figure, double spheres) {
  constexpr double haste = 1.5;
  const SpreadPrior prior = expected_spread(figure, spheres);
  return {prior.about, prior, haste * haste};
}

} // namespace platen::apps
