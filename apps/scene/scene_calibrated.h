// What the bonds of a scene were calibrated for. A scene that says nothing claims nothing, and is judged by
// nothing.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/scene_specimen.h"
#include "base/describe.h"

namespace platen::apps {

enum class CalibratedFigure {
  elastic,     // E and Poisson's ratio of small strains
  compression, // strength
  confined,    // strength under pressure
  tension,
  friction,    // what platen friction adds to the strength of short and of slender specimens
  slenderness, // strength of a short specimen over that of a slender one
  secant_ratio // Poisson's ratio to 40 % of the strength, where bonds have broken already
};
inline const Words<CalibratedFigure> calibrated_figures{
    {"elastic", CalibratedFigure::elastic},          {"compression", CalibratedFigure::compression},
    {"confined", CalibratedFigure::confined},        {"tension", CalibratedFigure::tension},
    {"friction", CalibratedFigure::friction},        {"slenderness", CalibratedFigure::slenderness},
    {"secant ratio", CalibratedFigure::secant_ratio}};

struct CalibratedFor {
  std::optional<PackingKind> packing;    // none: nothing is said
  std::vector<CalibratedFigure> figures; // empty: nothing is said

  bool covers(CalibratedFigure figure) const {
    return figures.empty() || std::find(figures.begin(), figures.end(), figure) != figures.end();
  }
  // Why a figure that needs this one is none; "" where it may be one.
  std::string against(CalibratedFigure needed) const {
    if (covers(needed)) return "";
    std::string words;
    for (const CalibratedFigure figure : figures)
      words += (words.empty() ? "" : ", ") + word_of(calibrated_figures, figure);
    return "the bonds are not calibrated for it: Bond/Calibrated figures = " + words + ", without " +
           word_of(calibrated_figures, needed);
  }
};

} // namespace platen::apps
