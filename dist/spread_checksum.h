// The checksum of bytes that are distributed over several ranks.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "dist/rank_file.h"

namespace platen::dist {

constexpr std::uint64_t largest_portion = std::uint64_t{1} << 24; // bytes that a rank hashes at once

// XXH64 (seed 0) of a text that grows. It cannot be combined from hashes of two parts: ranks exchange bytes
// so that each has one part of the added text, and send the hash state (88 bytes) from part to part.
class SpreadHash {
public:
  explicit SpreadHash(MPI_Comm ranks, std::uint64_t portion = largest_portion); // `portion` is for tests
  ~SpreadHash();
  SpreadHash(const SpreadHash &) = delete;
  SpreadHash &operator=(const SpreadHash &) = delete;

  // Adds bytes that the ranks hold in pieces that cover them, offsets counted from their own beginning.
  // Collective. Throws std::invalid_argument as runs_of_file does.
  void add(const std::vector<FilePiece> &pieces);
  // Adds bytes of rank 0; arguments of other ranks are ignored.
  void add_of_first(const void *bytes, std::size_t count);
  std::uint64_t value() const; // on every rank; collective

private:
  struct State;
  MPI_Comm ranks_;
  std::uint64_t portion_;
  std::unique_ptr<State> state_;
};

// XXH64 (seed 0) of each text whose bytes the ranks hold in pieces that cover it, offsets counted from its
// own beginning: the same value as on one rank that has all bytes, on every rank. Collective; each rank
// passes the same number of texts, with no piece where it has none. Throws std::invalid_argument as
// runs_of_file does. `portion` is for tests.
std::vector<std::uint64_t> xxh64_of(MPI_Comm ranks, const std::vector<std::vector<FilePiece>> &texts,
                                    std::uint64_t portion = largest_portion);

} // namespace platen::dist
