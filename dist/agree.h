// Exchange between ranks of errors, and a check that all have the same text.
#pragma once

#include <mpi.h>

#include <string>

namespace platen::dist {

// The error of the first rank that has one, on every rank; empty where none has. Collective.
std::string first_error(MPI_Comm ranks, const std::string &mine);

// Whether all ranks pass the same text. Collective.
bool same_on_all(MPI_Comm ranks, const std::string &mine);

} // namespace platen::dist
