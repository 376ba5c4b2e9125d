// What laboratories measured of platens and slenderness, to stand beside the figures of a study.
#pragma once

#include <string>
#include <vector>

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
  double mean, low, high; // 1; equal where one number is given
  std::string source;     // author, year; "from memory" where nobody has looked it up since
};

const std::vector<LaboratoryFigure> &laboratory_figures();

// The figure for the same effect and ends at about this slenderness; null where there is none.
const LaboratoryFigure *laboratory_figure(PlatenEffect effect, bool free_ends, double slenderness);

// Slenderness of the prisms that cubes are compared with.
constexpr double laboratory_prism = 2.39; // Hughes and Bahramian 1967: 244 mm x 102 mm

} // namespace platen::apps
