// What the bonds of a scene were calibrated for. A scene that says nothing claims nothing, and is judged by
// nothing.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "apps/scene/scene_specimen.h"
#include "base/describe.h"

namespace platen::apps {

enum class CalibratedFigure { elastic, compression, confined, tension };
inline const Words<CalibratedFigure> calibrated_figures{{"elastic", CalibratedFigure::elastic},
                                                        {"compression", CalibratedFigure::compression},
                                                        {"confined", CalibratedFigure::confined},
                                                        {"tension", CalibratedFigure::tension}};

struct CalibratedFor {
  std::optional<PackingKind> packing;    // none: nothing is said
  std::vector<CalibratedFigure> figures; // empty: nothing is said

  bool covers(CalibratedFigure figure) const {
    return figures.empty() || std::find(figures.begin(), figures.end(), figure) != figures.end();
  }
};

} // namespace platen::apps
