// platen-bar: a bonded bar pulled, bent, twisted and struck, and what strength of materials says of it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/bar/bar.h"
#include "apps/bar/dynamic_test.h"
#include "apps/bar/moduli.h"
#include "apps/bar/static_test.h"
#include "apps/scene/command_line.h"

namespace platen::apps {

// One load: tension, bending or torsion.
struct LoadResult {
  BarLoad load = BarLoad::tension;
  StaticTest at_rest; // always solved, for the bar is let go from there
  bool keeps_static = false;
  std::optional<Oscillation> swing;
};

struct BarResults {
  std::size_t particles = 0, bonds = 0;
  double packing_fraction = 0; // spheres over the shape's volume
  BarGeometry bar;
  BarModuli pulled;
  dem::Moduli bulk;
  BarTime time;
  std::vector<LoadResult> loads;
  std::optional<Impact> impact;
  double struck_velocity = 0; // m/s
  long steps = 0, broken_tension = 0, broken_shear = 0;
  double energy_residual = 0; // largest of an oscillation or impact, over its energy
  std::array<double, dem::stage_count> stage_seconds{};

  // With the measured axial rigidity and Poisson ratio, on the bounding section or the effective one.
  Rod rod(bool effective) const;
  Rod swinging_rod(bool effective) const; // from the middle of the clamped spheres to the end plane
};

const char *word(BarLoad load);

// The whole app: output folder, history.csv, summary.json, log; returns the exit status.
int run_bar(const CommandLine &command, const Scene &scene);

} // namespace platen::apps
