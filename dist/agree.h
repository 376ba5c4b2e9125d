// What ranks tell each other: errors, and whether they were asked the same.
#pragma once

#include <mpi.h>

#include <string>

namespace platen::dist {

// What went wrong on the first rank that says so, on every rank; empty where none does. Collective.
std::string first_error(MPI_Comm ranks, const std::string &mine);

// Whether all ranks have this text. Collective.
bool same_on_all(MPI_Comm ranks, const std::string &mine);

} // namespace platen::dist
