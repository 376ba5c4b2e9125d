// A checkpoint file: a state (base/state.h) as named blocks of plain bytes, each with its type, its unit, its
// length and a checksum, and a checksum over the whole file. Layout, native byte order:
//   header   "PLATENCP", format version (4 bytes), byte order mark (4)
//   block    lengths, type and checksum, name, unit, bytes; as many as there are
//   trailer  "PLATENND", number of blocks, length of the file, XXH64 of all that stands before (8 each)
// Values are stored byte for byte, so that a resumed run has the same bits as one that was never stopped.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/output/errors.h"
#include "apps/output/file.h"
#include "base/state.h"

namespace platen::apps {

constexpr char checkpoint_magic[9] = "PLATENCP", checkpoint_end[9] = "PLATENND"; // 8 bytes each in the file
// Raised with every change of this layout; an older or newer file is refused, not guessed at.
constexpr std::uint32_t checkpoint_version = 3;
constexpr std::uint32_t checkpoint_byte_order = 0x01020304;

struct CheckpointHeader { // 16 bytes
  char magic[8];
  std::uint32_t version, byte_order;
};

struct CheckpointBlockHeader { // 40 bytes, then the name, the unit and the bytes
  std::uint32_t name_bytes, unit_bytes;
  std::uint32_t kind;         // BlockType::Kind
  std::uint32_t number_bytes; // of one number
  std::uint32_t numbers;      // of one row
  std::uint32_t reserved;     // 0
  std::uint64_t bytes;
  std::uint64_t checksum; // XXH64 of the bytes
};

struct CheckpointTrailer { // 32 bytes, the last of the file
  char magic[8];
  std::uint64_t blocks;
  std::uint64_t file_bytes;
  std::uint64_t checksum; // XXH64 of all bytes before this member
};

static_assert(sizeof(CheckpointHeader) == 16 && sizeof(CheckpointBlockHeader) == 40 &&
                  sizeof(CheckpointTrailer) == 32,
              "the layout is the file format");

// Writes the layout to wherever put() puts it. A file without end() is not a checkpoint.
class BlockWriter : public StateSink {
public:
  // Throws std::logic_error if the block is written twice.
  void add(const std::string &name, const BlockType &type, const void *data, std::size_t rows) override;

protected:
  virtual void put(const void *bytes, std::size_t count) = 0; // at the end of the file
  virtual std::uint64_t checksum() = 0;                       // XXH64 of all that was put
  void begin();
  // What stands before the bytes of a block, of which `sum` is the checksum.
  void begin_block(const std::string &name, const BlockType &type, std::uint64_t bytes, std::uint64_t sum);
  void end(std::uint64_t length); // of all that was put

private:
  std::set<std::string> names_;
};

class CheckpointHash; // running XXH64

// Writes blocks straight to a file, nothing is collected in memory. Failures throw OutputError. Use it
// through write_checkpoint (checkpoint_folder.h), which keeps the former ones.
class CheckpointWriter : public BlockWriter {
public:
  explicit CheckpointWriter(const std::filesystem::path &path);
  ~CheckpointWriter() override;
  // Writes the trailer and waits until the disk has all.
  void finish();

private:
  void put(const void *bytes, std::size_t count) override;
  std::uint64_t checksum() override;
  void flush();
  OutputFile file_;
  std::string buffer_; // small blocks are collected, large ones are written at once
  std::unique_ptr<CheckpointHash> hash_;
  std::uint64_t length_ = 0;
};

// Opens a checkpoint and verifies every byte of it; throws CheckpointError that says what is wrong. Blocks
// are read from the file when asked for, and checked again.
class CheckpointReader : public StateSource {
public:
  explicit CheckpointReader(const std::filesystem::path &path);
  ~CheckpointReader() override;

  std::vector<std::string> names() const override; // in the order of the file
  std::optional<StoredBlock> find(const std::string &name) const override;
  void read(const std::string &name, void *data) const override;
  // Throws CheckpointError with the name of the file.
  [[noreturn]] void fail(const std::string &what) const;

private:
  struct Block {
    std::uint64_t offset = 0, bytes = 0, checksum = 0;
    StoredBlock stored;
  };
  struct Source;
  void verify_header();
  void verify_block(std::uint64_t end);
  void verify_trailer();

  std::filesystem::path path_;
  std::unique_ptr<Source> source_;
  std::vector<std::string> names_;
  std::map<std::string, Block> blocks_;
};

} // namespace platen::apps
