// Elastic moduli of the very specimen, each by static solves of its own.
#pragma once

#include "apps/bar/bar.h"
#include "dem/measure/region.h"

namespace platen::apps {

// The bar pulled at both ends, its ends free to contract: axial rigidity from the force and the strain of the
// middle half, which feels nothing of how the ends are held.
struct BarModuli {
  double axial_rigidity = 0; // N, E A
  double poisson_ratio = 0;  // 1
};
BarModuli pull_bar(const dem::Model &model, const BarGeometry &bar, const dem::Shape &shape);

// Depth of the skin that is led through six uniform strains, and distance from the walls to the region that
// is looked at, in mean radii: stress and strain are both means over that region, so the stiff or weak layers
// outside it do not enter.
constexpr double skin_depth = 1, region_margin = 5;
// NaN where the specimen is too thin to have such a region.
dem::Moduli bulk_moduli(const dem::Model &model, const BarGeometry &bar, const dem::Shape &shape);

} // namespace platen::apps
