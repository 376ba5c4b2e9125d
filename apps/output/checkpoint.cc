#include "apps/output/checkpoint.h"

#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <new>
#include <stdexcept>

namespace platen::apps {

// XXH64 of a stream of bytes.
class CheckpointHash {
public:
  CheckpointHash() : state_(XXH64_createState(), XXH64_freeState) {
    if (!state_) throw std::bad_alloc();
    XXH64_reset(state_.get(), 0);
  }
  void update(const void *bytes, std::size_t count) {
    if (count > 0) XXH64_update(state_.get(), bytes, count);
  }
  std::uint64_t value() const { return XXH64_digest(state_.get()); }

private:
  std::unique_ptr<XXH64_state_t, decltype(&XXH64_freeState)> state_;
};

namespace {

constexpr std::size_t buffer_bytes = 1 << 20; // blocks above it are written without a copy
constexpr std::size_t chunk_bytes = 1 << 20;  // of a block that is verified

// What the header of a block says of its rows, where that can be.
std::optional<StoredBlock> stored_block(const CheckpointBlockHeader &header) {
  using Kind = BlockType::Kind;
  if (header.kind < static_cast<std::uint32_t>(Kind::signed_integer) ||
      header.kind > static_cast<std::uint32_t>(Kind::text) || header.reserved != 0)
    return std::nullopt;
  const Kind kind = static_cast<Kind>(header.kind);
  const std::uint32_t size = header.number_bytes;
  const bool known = kind == Kind::text       ? size == 1
                     : kind == Kind::floating ? size == 4 || size == 8
                                              : size == 1 || size == 2 || size == 4 || size == 8;
  if (!known || header.numbers == 0) return std::nullopt;
  StoredBlock block;
  block.type = {kind, size, header.numbers, ""};
  if (header.bytes % block.type.bytes_per_row() != 0) return std::nullopt;
  block.rows = static_cast<std::size_t>(header.bytes / block.type.bytes_per_row());
  return block;
}

} // namespace

void BlockWriter::begin() {
  CheckpointHeader header{{}, checkpoint_version, checkpoint_byte_order};
  std::memcpy(header.magic, checkpoint_magic, sizeof header.magic);
  put(&header, sizeof header);
}

void BlockWriter::begin_block(const std::string &name, const BlockType &type, std::uint64_t bytes,
                              std::uint64_t sum) {
  if (!names_.insert(name).second)
    throw std::logic_error("checkpoint block \"" + name + "\" is written twice");
  const CheckpointBlockHeader header{static_cast<std::uint32_t>(name.size()),
                                     static_cast<std::uint32_t>(type.unit.size()),
                                     static_cast<std::uint32_t>(type.kind),
                                     type.bytes,
                                     type.numbers,
                                     0,
                                     bytes,
                                     sum};
  const std::string text =
      std::string(reinterpret_cast<const char *>(&header), sizeof header) + name + type.unit;
  put(text.data(), text.size());
}

void BlockWriter::add(const std::string &name, const BlockType &type, const void *data, std::size_t rows) {
  const std::size_t bytes = rows * type.bytes_per_row();
  begin_block(name, type, bytes, bytes > 0 ? XXH64(data, bytes, 0) : XXH64("", 0, 0));
  put(data, bytes);
}

void BlockWriter::end(std::uint64_t length) {
  CheckpointTrailer trailer{{}, names_.size(), length + sizeof trailer, 0};
  std::memcpy(trailer.magic, checkpoint_end, sizeof trailer.magic);
  put(&trailer, sizeof trailer - sizeof trailer.checksum);
  trailer.checksum = checksum();
  put(&trailer.checksum, sizeof trailer.checksum);
}

CheckpointWriter::CheckpointWriter(const std::filesystem::path &path)
    : file_(path), hash_(std::make_unique<CheckpointHash>()) {
  begin();
}

CheckpointWriter::~CheckpointWriter() = default;

void CheckpointWriter::finish() {
  end(length_);
  flush();
  file_.sync();
  file_.close();
}

std::uint64_t CheckpointWriter::checksum() {
  return hash_->value();
}

void CheckpointWriter::put(const void *bytes, std::size_t count) {
  if (count == 0) return;
  hash_->update(bytes, count);
  length_ += count;
  if (buffer_.size() + count > buffer_bytes) flush();
  if (count > buffer_bytes)
    file_.write(bytes, count);
  else
    buffer_.append(static_cast<const char *>(bytes), count);
}

void CheckpointWriter::flush() {
  file_.write(buffer_);
  buffer_.clear();
}

// The file, and a checksum over what was read in order.
struct CheckpointReader::Source {
  explicit Source(const std::filesystem::path &path) : stream(path, std::ios::binary) {
    stream.seekg(0, std::ios::end);
    if (stream) size = static_cast<std::uint64_t>(stream.tellg());
    stream.seekg(0);
  }
  bool read(void *data, std::size_t count) {
    stream.read(static_cast<char *>(data), static_cast<std::streamsize>(count));
    return stream.good();
  }
  bool read_in_order(void *data, std::size_t count) {
    if (!read(data, count)) return false;
    hash.update(data, count);
    position += count;
    return true;
  }
  std::ifstream stream;
  std::uint64_t size = 0, position = 0;
  CheckpointHash hash;
  std::vector<char> chunk = std::vector<char>(chunk_bytes);
};

CheckpointReader::CheckpointReader(const std::filesystem::path &path) : path_(path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw CheckpointError(path.string() + ": no such checkpoint");
  source_ = std::make_unique<Source>(path);
  if (!source_->stream) throw CheckpointError(path.string() + ": cannot be read");
  verify_header();
  while (source_->position < source_->size - sizeof(CheckpointTrailer))
    verify_block(source_->size - sizeof(CheckpointTrailer));
  verify_trailer();
}

CheckpointReader::~CheckpointReader() = default;

void CheckpointReader::fail(const std::string &what) const {
  throw CheckpointError(path_.string() + ": " + what);
}

void CheckpointReader::verify_header() {
  if (source_->size < sizeof(CheckpointHeader) + sizeof(CheckpointTrailer))
    fail("cut off: " + std::to_string(source_->size) + " bytes, less than any checkpoint has");
  CheckpointHeader header{};
  if (!source_->read_in_order(&header, sizeof header)) fail("cannot be read");
  if (std::memcmp(header.magic, checkpoint_magic, sizeof header.magic) != 0)
    fail("not a checkpoint of Platen");
  if (header.byte_order != checkpoint_byte_order)
    fail("damaged, or written on a machine with another byte order");
  if (header.version != checkpoint_version)
    fail("has format version " + std::to_string(header.version) + ", this program reads version " +
         std::to_string(checkpoint_version) +
         (header.version < checkpoint_version ? ": its state has no names; start the run anew" : ""));
}

// No length is believed before it is known to fit into the file.
void CheckpointReader::verify_block(std::uint64_t end) {
  Source &source = *source_;
  const auto damaged = [&] { fail("cut off or damaged after " + std::to_string(names_.size()) + " blocks"); };
  CheckpointBlockHeader header{};
  if (end - source.position < sizeof header || !source.read_in_order(&header, sizeof header)) damaged();
  const std::uint64_t room = end - source.position,
                      words = std::uint64_t{header.name_bytes} + header.unit_bytes;
  std::optional<StoredBlock> stored = stored_block(header);
  if (words > room || header.bytes > room - words || !stored) damaged();
  std::string name(header.name_bytes, '\0');
  stored->type.unit.resize(header.unit_bytes);
  if (!source.read_in_order(name.data(), name.size()) ||
      !source.read_in_order(stored->type.unit.data(), header.unit_bytes))
    fail("cannot be read");

  const std::uint64_t offset = source.position;
  CheckpointHash hash;
  for (std::uint64_t left = header.bytes; left > 0;) {
    const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(left, source.chunk.size()));
    if (!source.read_in_order(source.chunk.data(), count)) fail("cannot be read");
    hash.update(source.chunk.data(), count);
    left -= count;
  }
  if (hash.value() != header.checksum) fail("block \"" + name + "\" is damaged: its checksum does not hold");
  if (!blocks_.emplace(name, Block{offset, header.bytes, header.checksum, *stored}).second)
    fail("damaged: block \"" + name + "\" stands there twice");
  names_.push_back(name);
}

void CheckpointReader::verify_trailer() {
  CheckpointTrailer trailer{};
  if (!source_->read(&trailer, sizeof trailer)) fail("cannot be read");
  source_->hash.update(&trailer, sizeof trailer - sizeof trailer.checksum);
  if (std::memcmp(trailer.magic, checkpoint_end, sizeof trailer.magic) != 0 ||
      trailer.file_bytes != source_->size || trailer.blocks != blocks_.size())
    fail("cut off or damaged: its end is not where it should be");
  if (source_->hash.value() != trailer.checksum) fail("damaged: the checksum of the file does not hold");
}

std::vector<std::string> CheckpointReader::names() const {
  return names_;
}

std::optional<StoredBlock> CheckpointReader::find(const std::string &name) const {
  const auto found = blocks_.find(name);
  return found == blocks_.end() ? std::nullopt : std::optional(found->second.stored);
}

void CheckpointReader::read(const std::string &name, void *data) const {
  const Block &wanted = blocks_.at(name);
  if (wanted.bytes == 0) return;
  source_->stream.clear();
  source_->stream.seekg(static_cast<std::streamoff>(wanted.offset));
  if (!source_->read(data, static_cast<std::size_t>(wanted.bytes)) ||
      XXH64(data, static_cast<std::size_t>(wanted.bytes), 0) != wanted.checksum)
    fail("block \"" + name + "\" cannot be read, or changed while it was in use");
}

} // namespace platen::apps
