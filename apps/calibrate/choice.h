// What bonds and contacts of a trial are made of.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/calibrate/calibrate_section.h"

namespace platen::apps {

struct Choice {
  std::array<double, knob_count> numbers{}; // Pa, 1, rad; the limits' factor
  double &operator[](Knob knob) { return numbers[static_cast<std::size_t>(knob)]; }
  double operator[](Knob knob) const { return numbers[static_cast<std::size_t>(knob)]; }
};

struct KnobFacts {
  Knob knob;
  const char *column;    // of trials.csv and summary.json
  const char *words;     // for the screen
  double unit;           // of what the screen shows
  const char *unit_word; // " GPa"
  bool elastic;          // static solves depend on it
};
// In the order of the knobs.
const std::array<KnobFacts, knob_count> &knob_facts();
inline const KnobFacts &facts_of(Knob knob) {
  return knob_facts()[static_cast<std::size_t>(knob)];
}

// The scene's own.
Choice choice_of(const Scene &scene);
// The scene with this choice, without ledger and crack log.
Scene chosen(const Scene &scene, const Choice &choice);
// "Bond/Modulus = 3e10 Pa" and so on, for a scene that is to have it.
std::vector<std::string> overrides_of(const Scene &scene, const Choice &choice);
// "tensile strength 7.34 MPa", for the screen.
std::string text_of(Knob knob, double value);

} // namespace platen::apps
