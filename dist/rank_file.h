// One file that several ranks write, each its own pieces.
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

// A contiguous part of a file, on one rank.
struct FileRun {
  std::uint64_t offset, length; // bytes
  int rank;
};

// The rank of each part of a file, from its beginning; the same on every rank. Pieces of a rank in any order.
// Collective. Throws std::invalid_argument on all ranks where pieces overlap or leave a gap.
std::vector<FileRun> runs_of_file(MPI_Comm ranks, const std::vector<FilePiece> &pieces);

constexpr std::uint64_t bytes_at_once = std::uint64_t{1} << 30; // per call: MPI counts by int

// A file that is written piece by piece. A rank that fails continues without writing, so that collective
// calls match, and finish() reports the error on all ranks.
class FileOfRanks {
public:
  // Empties the file at `path`. Collective. Where that fails, all ranks throw the same std::runtime_error
  // with path, reason and rank.
  FileOfRanks(MPI_Comm ranks, std::string path, std::uint64_t at_once = bytes_at_once);
  ~FileOfRanks();
  FileOfRanks(const FileOfRanks &) = delete;
  FileOfRanks &operator=(const FileOfRanks &) = delete;

  void write(const FilePiece &piece); // of this rank
  // Returns when all data is on the disk. Collective, throws as the constructor does.
  void finish();

private:
  class Open;
  MPI_Comm ranks_;
  std::string path_;
  std::uint64_t at_once_;
  std::unique_ptr<Open> open_;
};

// Writes `path` from the pieces of all ranks, which must cover it, and returns when the data is on the disk.
// An existing file is replaced. Collective. Where any rank fails, all throw the same std::runtime_error with
// path, reason and rank; the caller must then remove the file: write to a temporary name, and rename the
// complete file. `at_once` is for tests.
void write_rank_file(MPI_Comm ranks, const std::string &path, const std::vector<FilePiece> &pieces,
                     std::uint64_t at_once = bytes_at_once);

} // namespace platen::dist
