// The section Bar test, which platen-bar reads.
#pragma once

#include "apps/scene/program.h"
#include "apps/scene/scene.h"

namespace platen::apps {

enum class BarLoad { all, tension, bending, torsion, impact, none };
inline const Words<BarLoad> bar_loads{{"all", BarLoad::all},         {"tension", BarLoad::tension},
                                      {"bending", BarLoad::bending}, {"torsion", BarLoad::torsion},
                                      {"impact", BarLoad::impact},   {"none", BarLoad::none}};
enum class BarMethod { both, at_rest, dynamic };
enum class BarSide { x, y };

struct BarTest {               // platen-bar
  BarLoad load = BarLoad::all; // none: the moduli alone
  BarMethod method = BarMethod::both;
  BarSide side = BarSide::x; // the way in which the bar is bent
  double strain = 1e-4;      // at the skin of the clamped end
  double end_depth = 1;      // mean sphere radii
  double periods = 10;       // recorded of each oscillation
  bool bulk_moduli = true;
};

inline const BarTest &bar_test_of(const Scene &scene) {
  return scene.own<BarTest>();
}

Program bar_program();

} // namespace platen::apps
