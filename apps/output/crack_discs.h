// cracks.csv as something to look at: a disc for each broken bond.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace platen::apps {

// Of cracks.csv, in SI units; `mode` is tension or shear.
extern const std::vector<std::string> crack_columns;

// Discs of the cracks in `csv` with `time`, `mode` (2 in tension, 3 in shear, as the states of bonds.pvd),
// `energy`, `area`, `normal`, `axial_strain`, `particle_a` and `particle_b`; `end_time` (s) is that of the
// run. The file follows from the table alone. Throws InputError if the table is damaged, OutputError.
void write_crack_discs(const std::filesystem::path &csv, double end_time, const std::filesystem::path &vtu);

} // namespace platen::apps
