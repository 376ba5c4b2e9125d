// The file of one checkpoint, written by ranks that hold a part of its rows each.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>

#include "apps/io/checkpoint.h"
#include "base/vector3.h"
#include "dist/rank_file.h"
#include "dist/spread_checksum.h"

using namespace platen;
using namespace platen::apps;
using namespace platen::dist;
namespace fs = std::filesystem;

namespace {

constexpr std::size_t rows = 5000, rows_of_block = 512;

struct Rows {
  std::vector<Vector3> position = std::vector<Vector3>(rows);
  std::vector<int> phase = std::vector<int>(rows);
  Rows() {
    std::mt19937_64 random(5);
    for (std::size_t k = 0; k < rows; ++k) {
      for (int axis = 0; axis < 3; ++axis)
        position[k][axis] = static_cast<double>(random()) * 1e-20;
      phase[k] = static_cast<int>(random() % 3);
    }
  }
};
const BlockType positions{BlockType::Kind::floating, 8, 3, "m"},
    phases{BlockType::Kind::signed_integer, 4, 1, "1"};

// A file as it grows: this rank's pieces of it, and the headers, which rank 0 writes.
class SpreadCheckpoint {
public:
  SpreadCheckpoint() {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
    CheckpointHeader header{};
    std::memcpy(header.magic, checkpoint_magic, sizeof header.magic);
    header.version = checkpoint_version;
    header.byte_order = checkpoint_byte_order;
    put(&header, sizeof header);
  }
  // Every rank holds all rows here, and gives those of its blocks alone.
  void add(const std::string &name, const BlockType &type, const void *data) {
    std::vector<FilePiece> own;
    const std::size_t row = type.bytes_per_row();
    for (std::size_t first = 0, b = 0; first < rows; first += rows_of_block, ++b)
      if (static_cast<int>(b * 3 % 10 * 7 % static_cast<std::size_t>(ranks_)) == rank_)
        own.push_back({first * row, static_cast<const char *>(data) + first * row,
                       std::min(rows_of_block, rows - first) * row});
    CheckpointBlockHeader header{};
    header.name_bytes = static_cast<std::uint32_t>(name.size());
    header.unit_bytes = static_cast<std::uint32_t>(type.unit.size());
    header.kind = static_cast<std::uint32_t>(type.kind);
    header.number_bytes = type.bytes;
    header.numbers = type.numbers;
    header.bytes = rows * row;
    header.checksum = xxh64_of(MPI_COMM_WORLD, {own})[0];
    put(&header, sizeof header);
    put(name.data(), name.size());
    put(type.unit.data(), type.unit.size());
    for (FilePiece piece : own) {
      piece.offset += length_;
      pieces_.push_back(piece);
    }
    length_ += rows * row;
    ++blocks_;
  }
  void write(const std::string &path) {
    CheckpointTrailer trailer{};
    std::memcpy(trailer.magic, checkpoint_end, sizeof trailer.magic);
    trailer.blocks = blocks_;
    trailer.file_bytes = length_ + sizeof trailer;
    put(&trailer, sizeof trailer - sizeof trailer.checksum);
    trailer.checksum = xxh64_of(MPI_COMM_WORLD, {pieces_})[0];
    put(&trailer.checksum, sizeof trailer.checksum);
    write_rank_file(MPI_COMM_WORLD, path, pieces_);
  }

private:
  void put(const void *bytes, std::size_t count) {
    const char *first = static_cast<const char *>(bytes);
    words_.push_back(std::make_unique<std::vector<char>>(first, first + count));
    if (rank_ == 0) pieces_.push_back({length_, words_.back()->data(), count});
    length_ += count;
  }
  int rank_ = 0, ranks_ = 1;
  std::uint64_t length_ = 0, blocks_ = 0;
  std::vector<FilePiece> pieces_;
  std::vector<std::unique_ptr<std::vector<char>>> words_;
};

std::vector<char> bytes_in(const fs::path &path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Checkpoint, of_ranks_is_the_file_that_one_process_writes) {
  int number = static_cast<int>(::getpid()), rank = 0;
  MPI_Bcast(&number, 1, MPI_INT, 0, MPI_COMM_WORLD);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const fs::path folder =
                     fs::temp_directory_path() / ("platen_checkpoint_of_ranks_" + std::to_string(number)),
                 spread = folder / "spread.platen", serial = folder / "serial.platen";
  const Rows state;
  if (rank == 0) {
    fs::create_directories(folder);
    CheckpointWriter writer(serial);
    writer.add("particles/position", positions, state.position.data(), rows);
    writer.add("particles/phase", phases, state.phase.data(), rows);
    writer.finish();
  }
  MPI_Barrier(MPI_COMM_WORLD);
  SpreadCheckpoint checkpoint;
  checkpoint.add("particles/position", positions, state.position.data());
  checkpoint.add("particles/phase", phases, state.phase.data());
  checkpoint.write(spread.string());
  EXPECT_TRUE(bytes_in(spread) == bytes_in(serial));
  EXPECT_EQ(CheckpointReader(spread).names().size(), 2u); // it verifies both checksums
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank == 0) fs::remove_all(folder);
}

} // namespace
