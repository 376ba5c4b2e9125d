// Numbers and words of summary.json that a scene may state beforehand.
#include "apps/run/figures.h"
#include "apps/scene/sections.h"
#include "dem/measure/failure_pattern.h"

namespace platen::apps {
namespace {

// Of platen-bar: what it finds of the bar, and errors against strength of materials.
std::vector<Figure> figures_of_bar() {
  std::vector<Figure> all{{"bulk/youngs_modulus_pa", "Pa"},
                          {"bulk/poisson_ratio", "1"},
                          {"effective_radius_m", "m"},
                          {"density_kg_m3", "kg/m3"},
                          {"impact/wave_error", "1"}};
  for (const std::string load : {"tension", "bending", "torsion"})
    for (const char *motion : {"/static_error", "/dynamic_error"}) {
      all.push_back({load + motion, "1"});
      if (load != "tension") all.push_back({load + motion + "_effective", "1"});
    }
  return all;
}

} // namespace

void declare_expect(Parameters &parameters, std::vector<Expectation> &expect) {
  Section section(parameters, "Expect");
  const auto declare = [&](const Figure &figure) {
    if (figure.is_number() && (figure.needs & of_machine) == 0)
      section.expectation(
          figure.key, expect, figure.unit,
          "Range of the number in summary.json, one side may be left out; empty: not checked.");
  };
  for (const Figure &figure : figures())
    declare(figure);
  for (const Figure &figure : figures_of_bar())
    declare(figure);
  for (const char *key : {"pattern", "final_pattern"})
    section.expected_words(key, expect, {dem::pattern_words.begin(), dem::pattern_words.end()},
                           "Words of which summary.json has one; empty: not checked.");
}

} // namespace platen::apps
