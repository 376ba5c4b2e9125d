// What bonds and contacts of a trial are made of.
#pragma once

#include <string>
#include <vector>

#include "apps/calibrate/calibrate_section.h"

namespace platen::apps {

// SI; those of Knob, then those of Calibrate/Parameter 1, ...; of compression limits their factor.
struct Choice {
  std::vector<double> numbers = std::vector<double>(knob_count, 0.0);
  double &operator[](Knob knob) { return numbers[static_cast<std::size_t>(knob)]; }
  double operator[](Knob knob) const { return numbers[static_cast<std::size_t>(knob)]; }
};

struct KnobFacts {
  Knob knob;
  std::string entry;     // of the scene
  std::string column;    // of trials.csv and summary.json
  std::string words;     // for the screen
  double unit;           // of what the screen shows
  std::string unit_word; // " GPa"
  std::string si;        // " Pa"
  bool elastic;          // static solves depend on it
};
// In the order of a choice's numbers.
std::vector<KnobFacts> knob_facts(const Calibrate &calibrate);
KnobFacts facts_of(const Calibrate &calibrate, Knob knob);

// The scene's own.
Choice choice_of(const Scene &scene);
// "Bond/Modulus = 3e10 Pa" and so on, for a scene that is to have it.
std::vector<std::string> overrides_of(const Scene &scene, const Choice &choice);
// "tensile strength 7.34 MPa", for the screen.
std::string text_of(const KnobFacts &facts, double value);

} // namespace platen::apps
