// What a calibration does with its trials. Bonds for a wanted material: Poisson's ratio by the stiffness
// ratio (beams: the radius multiplier), Young's modulus by the bond's, to which it is proportional; then the
// strengths by those of the bond, its moment contribution and its friction angle (strengths.h).
#pragma once

#include "apps/calibrate/trials.h"
#include "apps/io/seed_statistics.h"
#include "apps/io/summary.h"

namespace platen::apps {

// Over seeds; strengths of those runs that came to a peak.
struct Measured {
  SeedStatistics young, platen, poisson, compressive, tensile, triaxial;
  int failed = 0;
};

struct Found {
  BondChoice choice;
  Measured training, unseen;
  int strength_trials = 0;
  std::vector<std::string> missed; // what could not be reached, one line each
};

Found search(const Scene &scene, Trials &trials, RunLog &log);

// A table of elastic moduli against what bonds are made of: every combination of the lists, on every seed, as
// abacus.csv; returns means over the seeds, one object for each combination. Moduli are proportional to the
// bond's and Poisson's ratio does not depend on it, so one bond modulus is solved for, unless the platens'
// stiffness is absolute.
Json make_abacus(const Scene &scene, const OutputPaths &paths, Trials &trials, RunLog &log);

} // namespace platen::apps
