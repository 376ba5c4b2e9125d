// What platen-bonds writes and shows of its runs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/bonds/run_bonds.h"
#include "apps/output/summary.h"

namespace platen::apps {

bool turns(const Scene &scene); // whether the path is a rotation
// A bond that remembers: its places are prescribed.
bool is_prescribed(const Scene &scene);

// bonds.csv. `by_hand` is what the closed form gives for a row: displacement (m) or rotation (rad) under the
// row's load of two spheres, the strain ratio of three; NaN once a bond has broken. Of bonds that remember it
// is the load (N) at the row's place, `difference` the larger one of both loads over the largest load by
// hand, and columns of damage and energies follow.
void write_table(const std::filesystem::path &path, const Scene &scene, const std::vector<BondRun> &runs);
// Some rows of each run, evenly; the table has all.
std::string report(const Scene &scene, const std::vector<BondRun> &runs);
Json summary_of(const Scene &scene, const std::vector<BondRun> &runs, int threads, double seconds);

} // namespace platen::apps
