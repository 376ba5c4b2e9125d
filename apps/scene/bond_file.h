// Bonds of a specimen from a text file, a pair of spheres a row:
//   a,b,strength_factor,broken
//   0,1,1,0
// The last two columns may be missing; others are passed over. Spheres are named by the column "id" of their
// own file, or by their rows there, from 0. A broken bond is none.
#pragma once

#include <filesystem>
#include <vector>

#include "apps/scene/specimen_file.h"
#include "dem/bond_choice.h"

namespace platen::apps {

// Throws InputError, naming file and line, for a sphere that is not there, a pair of one sphere, one that is
// there twice, spheres farther apart than any bond, and what is no factor.
std::vector<dem::GivenBond> read_bond_file(const std::filesystem::path &path, const SpecimenFile &spheres,
                                           const dem::BondLayout &layout);

} // namespace platen::apps
