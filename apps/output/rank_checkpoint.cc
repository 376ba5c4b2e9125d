#include "apps/output/rank_checkpoint.h"

#include <cstddef>

#include "apps/output/checkpoint.h"
#include "apps/output/checkpoint_folder.h"
#include "dist/agree.h"
#include "dist/spread_checksum.h"

namespace platen::apps {
namespace {

// The file as it grows. Rank 0 alone knows its length, for blocks that all have may differ in theirs (times
// as text): it sends it where others have to write.
class RankCheckpointWriter : public BlockWriter {
public:
  RankCheckpointWriter(MPI_Comm ranks, const dist::SpreadState &spread, const std::filesystem::path &path)
      : ranks_(ranks), spread_(spread), file_(ranks, path.string()), hash_(ranks) {
    MPI_Comm_rank(ranks, &rank_);
    begin();
  }

  void add(const std::string &name, const BlockType &type, const void *data, std::size_t rows) override {
    if (const dist::SpreadRows *own = spread_.rows_of(name))
      add_spread(name, type, own->pieces(data, type.bytes_per_row()), own->global * type.bytes_per_row());
    else if (rank_ != 0)
      return;
    else if (const auto size = spread_.table_size_in(name))
      BlockWriter::add(name, type, &*size, sizeof *size / type.bytes_per_row());
    else
      BlockWriter::add(name, type, data, rows);
  }

  void finish() {
    end(length_);
    file_.finish();
  }

private:
  // From rank 0.
  void put(const void *bytes, std::size_t count) override {
    if (rank_ != 0 || count == 0) return;
    hash_.add_of_first(bytes, count);
    file_.write({length_, bytes, count});
    length_ += count;
  }
  std::uint64_t checksum() override { return hash_.value(); }
  void add_spread(const std::string &name, const BlockType &type, const std::vector<dist::FilePiece> &own,
                  std::uint64_t bytes) {
    dist::SpreadHash of_block(ranks_);
    of_block.add(own);
    begin_block(name, type, bytes, of_block.value());
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
