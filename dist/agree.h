// Errors that all ranks learn of.
#pragma once

#include <mpi.h>

#include <string>

namespace platen::dist {

// What went wrong on the first rank that says so, on every rank; empty where none does. Collective.
std::string first_error(MPI_Comm ranks, const std::string &mine);

} // namespace platen::dist
