#include "dist/rank_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "dist/agree.h"

namespace platen::dist {
namespace {

int rank_in(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

// Runs of this rank, neighbours joined.
std::vector<FileRun> own_runs(const std::vector<FilePiece> &pieces, int rank) {
  std::vector<FileRun> runs;
  for (const FilePiece &piece : pieces)
    if (piece.length > 0) runs.push_back({piece.offset, piece.length, rank});
  std::sort(runs.begin(), runs.end(), [](const FileRun &a, const FileRun &b) { return a.offset < b.offset; });
  std::size_t kept = 0;
  for (const FileRun &run : runs)
    if (kept > 0 && runs[kept - 1].offset + runs[kept - 1].length == run.offset)
      runs[kept - 1].length += run.length;
    else
      runs[kept++] = run;
  runs.resize(kept);
  return runs;
}

// The system's error message, where MPI passes it on.
std::string reason(int status, int system) {
  int kind = MPI_SUCCESS;
  MPI_Error_class(status, &kind);
  if (kind == MPI_ERR_NO_SUCH_FILE) return std::strerror(ENOENT);
  if (kind == MPI_ERR_ACCESS) return std::strerror(EACCES);
  if (kind == MPI_ERR_NO_SPACE) return std::strerror(ENOSPC);
  if (kind == MPI_ERR_READ_ONLY) return std::strerror(EROFS);
  // EBADF: OpenMPI 4.1 has already closed a file that it could not open.
  if (system != 0 && system != EBADF) return std::strerror(system);
  char text[MPI_MAX_ERROR_STRING] = "";
  int length = 0;
  MPI_Error_string(status, text, &length);
  return text;
}

void require_none(MPI_Comm ranks, const std::string &path, const std::string &mine) {
  const std::string with_rank = mine.empty() ? "" : mine + " (rank " + std::to_string(rank_in(ranks)) + ")";
  const std::string first = first_error(ranks, with_rank);
  if (!first.empty()) throw std::runtime_error(path + ": " + first);
}

} // namespace

// A file that one rank has open. Each opens it separately: where one fails, the others do not wait.
class FileOfRanks::Open {
public:
  Open(const std::string &path, int mode) {
    errno = 0;
    note(MPI_File_open(MPI_COMM_SELF, path.c_str(), mode, MPI_INFO_NULL, &file_),
         "cannot be opened for writing");
    if (!error_.empty()) file_ = MPI_FILE_NULL;
  }
  ~Open() { close(); }
  Open(const Open &) = delete;
  Open &operator=(const Open &) = delete;

  void empty() {
    errno = 0;
    if (good()) note(MPI_File_set_size(file_, 0), "cannot be written");
  }
  // A disk that becomes full accepts a part first; OpenMPI 4.1 then reports success with zero bytes.
  void write(const FilePiece &piece, std::uint64_t at_once) {
    const char *bytes = static_cast<const char *>(piece.bytes);
    for (std::uint64_t done = 0; good() && done < piece.length;) {
      const int count = static_cast<int>(std::min(at_once, piece.length - done));
      MPI_Status status;
      errno = 0;
      const int result = MPI_File_write_at(file_, static_cast<MPI_Offset>(piece.offset + done), bytes + done,
                                           count, MPI_BYTE, &status);
      int written = 0;
      if (result == MPI_SUCCESS) MPI_Get_count(&status, MPI_BYTE, &written);
      if (written <= 0) note(result == MPI_SUCCESS ? MPI_ERR_IO : result, "cannot be written");
      done += static_cast<std::uint64_t>(std::max(written, 0));
    }
  }
  void sync() {
    errno = 0;
    if (good()) note(MPI_File_sync(file_), "cannot be written");
  }
  void close() {
    if (file_ == MPI_FILE_NULL) return;
    errno = 0;
    const int status = MPI_File_close(&file_);
    file_ = MPI_FILE_NULL;
    if (good()) note(status, "cannot be written");
  }
  bool good() const { return error_.empty(); }
  const std::string &error() const { return error_; } // the first

private:
  void note(int status, const char *what) {
    const int system = errno;
    if (status != MPI_SUCCESS) error_ = std::string(what) + ": " + reason(status, system);
  }
  MPI_File file_ = MPI_FILE_NULL;
  std::string error_;
};

std::vector<FileRun> runs_of_file(MPI_Comm ranks, const std::vector<FilePiece> &pieces) {
  const std::vector<FileRun> own = own_runs(pieces, rank_in(ranks));
  int size = 1, bytes = static_cast<int>(own.size() * sizeof(FileRun));
  MPI_Comm_size(ranks, &size);
  std::vector<int> counts(static_cast<std::size_t>(size)), firsts(counts.size());
  MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, ranks);
  for (std::size_t r = 1; r < counts.size(); ++r)
    firsts[r] = firsts[r - 1] + counts[r - 1];
  std::vector<FileRun> runs(static_cast<std::size_t>(firsts.back() + counts.back()) / sizeof(FileRun));
  MPI_Allgatherv(own.data(), bytes, MPI_BYTE, runs.data(), counts.data(), firsts.data(), MPI_BYTE, ranks);
  std::sort(runs.begin(), runs.end(), [](const FileRun &a, const FileRun &b) { return a.offset < b.offset; });
  std::uint64_t end = 0;
  for (const FileRun &run : runs) {
    if (run.offset != end)
      throw std::invalid_argument(
          "pieces of a file " + std::string(run.offset < end ? "overlap" : "leave a gap") + " at byte " +
          std::to_string(std::min(run.offset, end)) + ", by rank " + std::to_string(run.rank));
    end += run.length;
  }
  return runs;
}

FileOfRanks::FileOfRanks(MPI_Comm ranks, std::string path, std::uint64_t at_once)
    : ranks_(ranks), path_(std::move(path)), at_once_(at_once) {
  std::string error;
  if (rank_in(ranks) == 0) {
    Open file(path_, MPI_MODE_CREATE | MPI_MODE_WRONLY);
    file.empty();
    file.close();
    error = file.error();
  }
  require_none(ranks, path_, error);
  open_ = std::make_unique<Open>(path_, MPI_MODE_WRONLY);
}

FileOfRanks::~FileOfRanks() = default;

void FileOfRanks::write(const FilePiece &piece) {
  open_->write(piece, at_once_);
}

void FileOfRanks::finish() {
  open_->sync();
  open_->close();
  require_none(ranks_, path_, open_->error());
}

void write_rank_file(MPI_Comm ranks, const std::string &path, const std::vector<FilePiece> &pieces,
                     std::uint64_t at_once) {
  runs_of_file(ranks, pieces);
  FileOfRanks file(ranks, path, at_once);
  for (const FilePiece &piece : pieces)
    file.write(piece);
  file.finish();
}

} // namespace platen::dist
