#include "apps/io/rank_checkpoint.h"

#include <xxhash.h>

#include <cstddef>

#include "apps/io/checkpoint.h"
#include "apps/io/checkpoint_folder.h"
#include "dist/agree.h"
#include "dist/spread_checksum.h"

namespace platen::apps {
namespace {

// The file as it grows. Rank 0 alone knows its length, for blocks that all have may differ in theirs (times
// as text): it tells it where others have to write.
class RankCheckpointWriter : public StateSink {
public:
  RankCheckpointWriter(MPI_Comm ranks, const dist::SpreadState &spread, const std::filesystem::path &path)
      : ranks_(ranks), spread_(spread), file_(ranks, path.string()), hash_(ranks) {
    MPI_Comm_rank(ranks, &rank_);
    const CheckpointHeader header = checkpoint_header();
    put(&header, sizeof header);
  }

  void add(const std::string &name, const BlockType &type, const void *data, std::size_t rows) override {
    names_.add(name);
    if (const dist::SpreadRows *own = spread_.rows_of(name))
      add_spread(name, type, own->pieces(data, type.bytes_per_row()), own->whole * type.bytes_per_row());
    else if (const auto size = spread_.size_told_by(name))
      add_whole(name, type, &*size, sizeof *size);
    else
      add_whole(name, type, data, rows * type.bytes_per_row());
  }

  void finish() {
    CheckpointTrailer trailer = checkpoint_trailer(names_.count(), length_);
    put(&trailer, sizeof trailer - sizeof trailer.checksum);
    trailer.checksum = hash_.value();
    put(&trailer.checksum, sizeof trailer.checksum);
    file_.finish();
  }

private:
  // From rank 0.
  void put(const void *bytes, std::uint64_t count) {
    if (rank_ != 0) return;
    hash_.add_of_first(bytes, count);
    file_.write({length_, bytes, count});
    length_ += count;
  }
  void add_whole(const std::string &name, const BlockType &type, const void *data, std::uint64_t bytes) {
    if (rank_ != 0) return;
    const std::string begin =
        checkpoint_block_begin(name, type, bytes, bytes > 0 ? XXH64(data, bytes, 0) : XXH64("", 0, 0));
    put(begin.data(), begin.size());
    put(data, bytes);
  }
  void add_spread(const std::string &name, const BlockType &type, const std::vector<dist::FilePiece> &own,
                  std::uint64_t bytes) {
    dist::SpreadHash of_block(ranks_);
    of_block.add(own);
    const std::string begin = checkpoint_block_begin(name, type, bytes, of_block.value());
    put(begin.data(), begin.size());
    hash_.add(own);
    MPI_Bcast(&length_, 1, MPI_UINT64_T, 0, ranks_);
    for (const dist::FilePiece &piece : own)
      file_.write({length_ + piece.offset, piece.bytes, piece.length});
    length_ += bytes;
  }

  MPI_Comm ranks_;
  int rank_ = 0;
  const dist::SpreadState &spread_;
  dist::FileOfRanks file_;
  dist::SpreadHash hash_; // of the whole file
  std::uint64_t length_ = 0;
  CheckpointNames names_;
};

// What rank 0 does for all: where it fails all fail.
void by_first(MPI_Comm ranks, const std::function<void()> &act) {
  int rank = 0;
  MPI_Comm_rank(ranks, &rank);
  std::string error;
  try {
    if (rank == 0) act();
  } catch (const std::exception &e) {
    error = e.what();
  }
  if (const std::string first = dist::first_error(ranks, error); !first.empty()) throw OutputError(first);
}

} // namespace

std::filesystem::path write_rank_checkpoint(MPI_Comm ranks, const dist::SpreadState &spread,
                                            const std::filesystem::path &folder, std::uint64_t step,
                                            const std::function<void(StateSink &)> &fill) {
  const std::filesystem::path path = checkpoint_path(folder, step), part = part_path(path);
  by_first(ranks, [&] { create_folder(folder); });
  try {
    try {
      RankCheckpointWriter writer(ranks, spread, part);
      fill(writer);
      writer.finish();
    } catch (const std::runtime_error &error) { // of a file of dist/, alike on all ranks
      throw OutputError(error.what());
    }
    by_first(ranks, [&] { make_current(part, path); });
  } catch (const OutputError &) {
    by_first(ranks, [&] {
      std::error_code ignored;
      std::filesystem::remove(part, ignored);
    });
    throw;
  }
  by_first(ranks, [&] { remove_other_checkpoints(folder, step); });
  return path;
}

} // namespace platen::apps
