// One file that several ranks write, each its own pieces of it.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace platen::dist {

struct FilePiece {
  std::uint64_t offset = 0; // in the file, bytes
  const void *bytes = nullptr;
  std::uint64_t length = 0; // bytes
};

// A stretch of a file that one rank holds.
struct FileRun {
  std::uint64_t offset, length; // bytes
  int rank;
};

// Who holds what of a file, from its beginning; the same on every rank. Pieces of a rank in any order.
// Collective. Throws std::invalid_argument on all ranks where pieces overlap or leave a gap.
std::vector<FileRun> runs_of_file(MPI_Comm ranks, const std::vector<FilePiece> &pieces);

constexpr std::uint64_t bytes_at_once = std::uint64_t{1} << 30; // of one call: MPI counts by int

// A file that is written piece by piece. Where a rank fails it goes on without writing, so that it stays with
// the others, and finish() tells all.
class FileOfRanks {
public:
  // Empties what stands at `path`. Collective. Where that fails all throw the same std::runtime_error with
  // path, reason and rank.
  FileOfRanks(MPI_Comm ranks, std::string path, std::uint64_t at_once = bytes_at_once);
  ~FileOfRanks();
  FileOfRanks(const FileOfRanks &) = delete;
  FileOfRanks &operator=(const FileOfRanks &) = delete;

  void write(const FilePiece &piece); // of this rank
  // Returns when the disk has what all have written. Collective, throws as the constructor does.
  void finish();

private:
  class Open;
  MPI_Comm ranks_;
  std::string path_;
  std::uint64_t at_once_;
  std::unique_ptr<Open> open_;
};

// Writes `path` from the pieces of all ranks, which cover it, and returns when the disk has it. What stood
// there is replaced. Collective. Where anything fails on any rank, all throw the same std::runtime_error with
// path, reason and rank; the file is then to be removed: write it aside, and give it its name when it is
// whole. `at_once` is for tests.
void write_rank_file(MPI_Comm ranks, const std::string &path, const std::vector<FilePiece> &pieces,
                     std::uint64_t at_once = bytes_at_once);

} // namespace platen::dist
