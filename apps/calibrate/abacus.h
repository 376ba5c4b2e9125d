// Elastic moduli against what bonds are made of.
#pragma once

#include "apps/calibrate/trials.h"
#include "apps/output/summary.h"

namespace platen::apps {

// A table of elastic moduli against what bonds are made of: every combination of the lists, on every seed, as
// abacus.csv; returns means over the seeds, one object for each combination. Moduli are proportional to the
// bond's and Poisson's ratio does not depend on it, so one bond modulus is solved for, unless the platens'
// stiffness is absolute.
Json make_abacus(const Scene &scene, const OutputPaths &paths, Trials &trials, RunLog &log);

} // namespace platen::apps
