// platen-bonds: bond tests on two and three spheres, measured and by hand side by side.
#pragma once

#include <string>
#include <vector>

#include "apps/bonds/guided_pair.h"
#include "apps/bonds/load_path.h"
#include "apps/run/app_output.h"
#include "apps/scene/command_line.h"

namespace platen::apps {

// One pair of bond modulus and stiffness ratio.
struct BondRun : TestFigures {
  double modulus = 0, stiffness_ratio = 0; // Pa, 1
  PathResult path;
  CohesiveResult cohesive;  // only of a bond that remembers
  double fracture_work = 0; // J
  double bond_area = 0;     // m^2

  // The same by closed forms: stiffness (N/m or N m), breaking load (N or N m; infinite, or NaN where none is
  // known) and strain ratio (three spheres, else NaN).
  double stiffness_by_hand = 0, strength_by_hand = 0, strain_ratio_by_hand = 0;
};

// Runs every combination of the scene's moduli and stiffness ratios. Throws InputError where the scene asks
// for what this test cannot do, NumericsError where the spheres do not come to rest.
std::vector<BondRun> run_bond_tests(const Scene &scene);

// The whole app: output folder, bonds.csv, summary.json, log; returns the exit status.
int run_bonds(const CommandLine &command, const Scene &scene);

} // namespace platen::apps
