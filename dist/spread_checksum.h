// The checksum of bytes that lie on several ranks.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <vector>

#include "dist/rank_file.h"

namespace platen::dist {

constexpr std::uint64_t largest_share = std::uint64_t{1} << 24; // bytes that a rank hashes in one go

// XXH64 (seed 0) of each text whose bytes the ranks hold in pieces that cover it, offsets counted from its
// own beginning: what one rank that had all would compute, on every rank. XXH64 of two parts cannot be made
// from those of each: ranks exchange bytes so that each has a share of the text in one piece, and hand the
// hash on from share to share (88 bytes). Collective; each rank gives as many texts, with no piece where it
// has none. Throws std::invalid_argument as runs_of_file does. `share` is for tests.
std::vector<std::uint64_t> xxh64_of(MPI_Comm ranks, const std::vector<std::vector<FilePiece>> &texts,
                                    std::uint64_t share = largest_share);

} // namespace platen::dist
