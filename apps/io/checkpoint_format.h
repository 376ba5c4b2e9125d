// The bytes of a checkpoint file that are no values: header, block header, trailer, checksums (checkpoint.h).
#pragma once

#include <xxhash.h>

#include <cstdint>
#include <new>

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

// XXH64 of a stream of bytes.
class CheckpointHash {
public:
  CheckpointHash() : state_(XXH64_createState()) {
    if (state_ == nullptr) throw std::bad_alloc();
    XXH64_reset(state_, 0);
  }
  ~CheckpointHash() { XXH64_freeState(state_); }
  CheckpointHash(const CheckpointHash &) = delete;
  CheckpointHash &operator=(const CheckpointHash &) = delete;
  void update(const void *bytes, std::size_t count) {
    if (count > 0) XXH64_update(state_, bytes, count);
  }
  std::uint64_t value() const { return XXH64_digest(state_); }

private:
  XXH64_state_t *state_;
};

} // namespace platen::apps
