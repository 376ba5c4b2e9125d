// A metal that yields (fem/materials/j2_plasticity.h): the wall of a tube, or platens.
#pragma once

#include <vector>

#include "base/describe.h"
#include "fem/materials/j2_plasticity.h"

namespace platen::coupling {

struct MetalSettings {
  double yield_strength = not_given; // Pa
  // Pa; not given: no hardening but that below, else that of structural steel (structural_steel.h).
  double ultimate_strength = not_given;
  double saturation = 0, saturation_rate = 0; // Pa, 1: of Voce's part
  // Flow stress over plastic strain, after the yield strength; instead of the ultimate strength.
  std::vector<fem::Hardening::Point> points;

  // Throws std::invalid_argument where it is no hardening.
  fem::Hardening hardening(double young_modulus) const;

  static constexpr const char *name = "sleeve.metal"; // of a tube
  template <class Visitor, class Self>
  static void describe(Visitor &&v, Self &p);
};

// Of the platens' own material.
struct PlatenMetal : MetalSettings {
  static constexpr const char *name = "platens.elastic.metal";
};

template <class Visitor, class Self>
void MetalSettings::describe(Visitor &&v, Self &p) {
  v("yield_strength", p.yield_strength, "Pa", above(0),
    "Stress at which the metal yields, in tension as in compression.");
  v("ultimate_strength", p.ultimate_strength, "Pa", above(0),
    "Of structural steel, in tension: it hardens by the lines of Yun and Gardner 2017; not given: the flow "
    "stress stays what it is at yield.");
  v("saturation", p.saturation, "Pa", at_least(0), "What the flow stress gains at most by Voce's law.");
  v("saturation_rate", p.saturation_rate, "1", at_least(0),
    "Of Voce's law: gain = saturation (1 - exp(-rate x plastic strain)).");
}

} // namespace platen::coupling
