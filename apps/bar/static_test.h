// The clamped bar at rest under a load on its free end.
#pragma once

#include "apps/bar/bar.h"
#include "dem/measure/bond_energy.h"

namespace platen::apps {

struct StaticTest {
  double load = 0;     // N, N m
  double measured = 0; // m, rad: the free end along the load
  dem::StaticState state;
  dem::EnergyShares energy; // J
};

// The rod between the middles of the clamped and of the loaded spheres.
Rod rod_at_rest(const BarGeometry &bar, double axial_rigidity, double poisson_ratio, const Section &section);

// The load under which `rod` has the strain at its skin where it is clamped; N, N m. Load is tension, bending
// or torsion.
double load_of_strain(const Rod &rod, BarLoad load, double strain);
// What strength of materials says of it: m, rad; bending with shear.
double response_of(const Rod &rod, BarLoad load, double size);
// Its lowest frequency in that motion, 1/s; bending with shear.
double frequency_of(const Rod &rod, BarLoad load);

// Throws dem::NoEquilibrium.
StaticTest load_bar(const dem::Model &model, const BarGeometry &bar, BarLoad load, double size,
                    const dem::StaticSettings &settings = {});

} // namespace platen::apps
