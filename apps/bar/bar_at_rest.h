// The bar at rest: clamped and under a load on its free end, and the elastic moduli of the very specimen,
// each by static solves.
#pragma once

#include "apps/bar/bar.h"
#include "apps/bar/bar_section.h"
#include "dem/measure/bond_network.h"
#include "dem/measure/stress.h"

namespace platen::apps {

struct StaticTest {
  double load = 0;     // N, N m
  double measured = 0; // m, rad: the free end along the load
  dem::StaticState state;
  dem::BondEnergies energy; // J
};

// The rod between the middles of the clamped and of the loaded spheres.
Rod rod_at_rest(const BarGeometry &bar, double axial_rigidity, double poisson_ratio,
                const CrossSection &section);

// What the end has moved along the load: m, rad.
double along(BarLoad load, const EndMotion &end, bool along_x);

// Throws dem::NoEquilibrium.
StaticTest load_bar(const dem::Model &model, const BarGeometry &bar, BarLoad load, double size,
                    const dem::StaticSettings &settings = {});

// The bar pulled at both ends, its ends free to contract: axial rigidity from the force and the strain of the
// middle half, which feels nothing of how the ends are held.
struct BarModuli {
  double axial_rigidity = 0; // N, E A
  double poisson_ratio = 0;  // 1
};
BarModuli pull_bar(const dem::Model &model, const BarGeometry &bar, const dem::Shape &shape);

// Depth of the skin whose displacement follows six uniform strains, and distance from the walls to the region
// that is measured, in mean radii: stress and strain are both means over that region, so the stiff or weak
// layers outside it do not enter.
constexpr double skin_depth = 1, region_margin = 5;
// NaN where the specimen is too thin to have such a region.
dem::Moduli bulk_moduli(const dem::Model &model, const BarGeometry &bar, const dem::Shape &shape);

} // namespace platen::apps
