#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "apps/io/checkpoint.h"
#include "apps/io/checkpoint_format.h"

namespace platen::apps {
namespace {

constexpr std::size_t buffer_bytes = 1 << 20; // blocks above it are written without a copy

} // namespace

CheckpointWriter::CheckpointWriter(const std::filesystem::path &path)
    : file_(path), hash_(std::make_unique<CheckpointHash>()) {
  CheckpointHeader header{};
  std::memcpy(header.magic, checkpoint_magic, sizeof header.magic);
  header.version = checkpoint_version;
  header.byte_order = checkpoint_byte_order;
  put(&header, sizeof header);
}

CheckpointWriter::~CheckpointWriter() = default;

void CheckpointWriter::add(const std::string &name, const BlockType &type, const void *data,
                           std::size_t rows) {
  if (std::find(names_.begin(), names_.end(), name) != names_.end())
    throw std::logic_error("checkpoint block \"" + name + "\" is written twice");
  names_.push_back(name);
  const std::size_t bytes = rows * type.bytes_per_row();
  CheckpointBlockHeader header{};
  header.name_bytes = static_cast<std::uint32_t>(name.size());
  header.unit_bytes = static_cast<std::uint32_t>(type.unit.size());
  header.kind = static_cast<std::uint32_t>(type.kind);
  header.number_bytes = type.bytes;
  header.numbers = type.numbers;
  header.bytes = bytes;
  header.checksum = bytes > 0 ? XXH64(data, bytes, 0) : XXH64("", 0, 0);
  put(&header, sizeof header);
  put(name.data(), name.size());
  put(type.unit.data(), type.unit.size());
  put(data, bytes);
}

void CheckpointWriter::finish() {
  CheckpointTrailer trailer{};
  std::memcpy(trailer.magic, checkpoint_end, sizeof trailer.magic);
  trailer.blocks = names_.size();
  trailer.file_bytes = length_ + sizeof trailer;
  hash_->update(&trailer, sizeof trailer - sizeof trailer.checksum);
  trailer.checksum = hash_->value();
  put(&trailer, sizeof trailer);
  flush();
  file_.sync();
  file_.close();
}

void CheckpointWriter::put(const void *bytes, std::size_t count) {
  if (count == 0) return;
  hash_->update(bytes, count);
  length_ += count;
  if (buffer_.size() + count > buffer_bytes) flush();
  const char *first = static_cast<const char *>(bytes);
  if (count > buffer_bytes)
    file_.write(bytes, count);
  else
    buffer_.insert(buffer_.end(), first, first + count);
}

void CheckpointWriter::flush() {
  file_.write(buffer_.data(), buffer_.size());
  buffer_.clear();
}

} // namespace platen::apps
