// What bonds and contacts of a trial are made of.
#pragma once

#include <string>
#include <vector>

#include "apps/calibrate/calibrate_section.h"

namespace platen::apps {

// SI; those of FreeParameter, then those of Calibrate/Parameter 1, ...; of compression limits their factor.
struct Choice {
  std::vector<double> numbers = std::vector<double>(parameter_count, 0.0);
  double &operator[](FreeParameter parameter) { return numbers[static_cast<std::size_t>(parameter)]; }
  double operator[](FreeParameter parameter) const { return numbers[static_cast<std::size_t>(parameter)]; }
};

struct ParameterFacts {
  FreeParameter parameter;
  std::string entry;     // of the scene
  std::string column;    // of trials.csv and summary.json
  std::string words;     // for the screen
  double unit;           // of what the screen shows
  std::string unit_word; // " GPa"
  std::string si;        // " Pa"
  bool elastic;          // static solves depend on it
};
// In the order of a choice's numbers.
std::vector<ParameterFacts> parameter_facts(const Calibrate &calibrate);
ParameterFacts facts_of(const Calibrate &calibrate, FreeParameter parameter);

// The scene's own.
Choice choice_of(const Scene &scene);
// "Bond/Modulus = 3e10 Pa" and so on, for a scene that is to have it.
std::vector<std::string> overrides_of(const Scene &scene, const Choice &choice);
// "tensile strength 7.34 MPa", for the screen.
std::string text_of(const ParameterFacts &facts, double value);

} // namespace platen::apps
