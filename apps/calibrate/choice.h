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

struct ScreenUnit {
  double factor = 1;
  std::string word = "", si = ""; // " GPa", " Pa"
};

struct ParameterFacts {
  FreeParameter parameter;
  std::string word;   // of Calibrate/Free; "" of one that has none
  std::string member; // of the bond laws that have it; "" of what is no bond law's
  std::string entry;  // of the scene
  std::string column; // of trials.csv and summary.json
  std::string words;  // for the screen
  ScreenUnit unit;
  bool elastic; // static solves depend on it
  // The coordinate of a search is the number, or its logarithm, over a large change of it; how much of one is
  // tried at once.
  bool logarithm;
  double change, step;
  bool scale = false; // a modulus, a strength: any factor to the scene's own may be

  // What the search bounds: the words, but of the shear strength that over the tensile one.
  std::string bounded() const {
    return parameter == FreeParameter::shear_strength ? "shear over tensile strength" : words;
  }
};
// In the order of a choice's numbers.
std::vector<ParameterFacts> parameter_facts(const Calibrate &calibrate);
ParameterFacts facts_of(const Calibrate &calibrate, FreeParameter parameter);
// Of Calibrate/Free.
Words<FreeParameter> free_words();

// Whether the scene's bonds and contacts have it.
bool has_parameter(const Scene &scene, FreeParameter parameter);
// Where a search may go from there; what nobody has bounded is held, but a scale by any factor.
Bounds bounds_of(const Scene &scene, FreeParameter parameter, double from);

// The scene's own.
Choice choice_of(const Scene &scene);
// "Bond/Modulus = 3e10 Pa" and so on, for a scene that is to have it.
std::vector<std::string> overrides_of(const Scene &scene, const Choice &choice);
// "tensile strength 7.34 MPa", for the screen.
std::string text_of(const ParameterFacts &facts, double value);

} // namespace platen::apps
