// platen-bonds: bond tests on two and three spheres.
#pragma once

#include <vector>

#include "apps/bonds/bond_run.h"
#include "apps/scene/command_line.h"

namespace platen::apps {

// Runs every combination of the scene's moduli and stiffness ratios. Throws InputError where the scene asks
// for what this test cannot do, NumericsError where the spheres do not come to rest.
std::vector<BondRun> run_bond_tests(const Scene &scene);

// The whole app: output folder, bonds.csv, summary.json, log; returns the exit status.
int run_bonds(const CommandLine &command, const Scene &scene);

} // namespace platen::apps
