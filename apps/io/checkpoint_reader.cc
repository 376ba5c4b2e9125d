#include <algorithm>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>

#include "apps/io/checkpoint.h"
#include "apps/io/checkpoint_format.h"

namespace platen::apps {
namespace {

constexpr std::size_t chunk_bytes = 1 << 20;

std::string describe(ElementType type) {
  const std::string bytes = std::to_string(type.bytes) + "-byte ";
  switch (type.kind) {
    case ElementType::Kind::signed_number:
      return bytes + "integers";
    case ElementType::Kind::unsigned_number:
      return bytes + "unsigned integers";
    case ElementType::Kind::floating:
      return bytes + "floating-point numbers";
    case ElementType::Kind::text:
      return "text";
    case ElementType::Kind::raw:
      break;
  }
  return bytes + "records";
}

} // namespace

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
};

CheckpointReader::CheckpointReader(const std::filesystem::path &path) : path_(path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw CheckpointError(path.string() + ": no such checkpoint");
  source_ = std::make_unique<Source>(path);
  if (!source_->stream) throw CheckpointError(path.string() + ": cannot be read");
  verify();
}

CheckpointReader::~CheckpointReader() = default;

void CheckpointReader::fail(const std::string &what) const {
  throw CheckpointError(path_.string() + ": " + what);
}

void CheckpointReader::verify() {
  Source &source = *source_;
  if (source.size < sizeof(CheckpointHeader) + sizeof(CheckpointTrailer))
    fail("cut off: " + std::to_string(source.size) + " bytes, less than any checkpoint has");
  CheckpointHeader header{};
  if (!source.read_in_order(&header, sizeof header)) fail("cannot be read");
  if (std::memcmp(header.magic, checkpoint_magic, sizeof header.magic) != 0)
    fail("not a checkpoint of Platen");
  if (header.byte_order != checkpoint_byte_order)
    fail("damaged, or written on a machine with another byte order");
  if (header.version != checkpoint_version)
    fail("has format version " + std::to_string(header.version) + ", this program reads version " +
         std::to_string(checkpoint_version));

  const std::uint64_t end = source.size - sizeof(CheckpointTrailer);
  std::vector<char> chunk(static_cast<std::size_t>(std::min<std::uint64_t>(chunk_bytes, source.size)));
  while (source.position < end) {
    // No length is believed before it is known to fit into the file.
    CheckpointBlockHeader block{};
    if (end - source.position < sizeof block || !source.read_in_order(&block, sizeof block))
      fail("cut off or damaged after " + std::to_string(blocks_.size()) + " blocks");
    const std::uint64_t room = end - source.position;
    if (block.name_bytes > room || block.bytes > room - block.name_bytes || block.element_bytes == 0 ||
        block.kind > static_cast<std::uint32_t>(ElementType::Kind::text) || block.reserved != 0)
      fail("cut off or damaged after " + std::to_string(blocks_.size()) + " blocks");
    std::string name(block.name_bytes, '\0');
    if (!source.read_in_order(name.data(), name.size())) fail("cannot be read");

    const std::uint64_t offset = source.position;
    CheckpointHash hash;
    for (std::uint64_t left = block.bytes; left > 0;) {
      const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(left, chunk.size()));
      if (!source.read_in_order(chunk.data(), count)) fail("cannot be read");
      hash.update(chunk.data(), count);
      left -= count;
    }
    if (hash.value() != block.checksum) fail("block \"" + name + "\" is damaged: its checksum does not hold");
    const ElementType type{static_cast<ElementType::Kind>(block.kind), block.element_bytes};
    if (!blocks_.emplace(name, Block{offset, block.bytes, block.checksum, type}).second)
      fail("damaged: block \"" + name + "\" stands there twice");
  }

  CheckpointTrailer trailer{};
  if (!source.read(&trailer, sizeof trailer)) fail("cannot be read");
  source.hash.update(&trailer, sizeof trailer - sizeof trailer.checksum);
  if (std::memcmp(trailer.magic, checkpoint_end, sizeof trailer.magic) != 0 ||
      trailer.file_bytes != source.size || trailer.blocks != blocks_.size())
    fail("cut off or damaged: its end is not where it should be");
  if (source.hash.value() != trailer.checksum) fail("damaged: the checksum of the file does not hold");
}

std::vector<std::string> CheckpointReader::names() const {
  std::vector<std::string> names;
  for (const auto &entry : blocks_)
    names.push_back(entry.first);
  return names;
}

const CheckpointReader::Block &CheckpointReader::block(const std::string &name) const {
  const auto found = blocks_.find(name);
  if (found == blocks_.end()) fail("has no block \"" + name + "\"");
  return found->second;
}

std::size_t CheckpointReader::bytes(const std::string &name) const {
  return static_cast<std::size_t>(block(name).bytes);
}

std::size_t CheckpointReader::elements(const std::string &name, ElementType type) const {
  const Block &wanted = block(name);
  if (!(wanted.type == type) || wanted.bytes % type.bytes != 0)
    fail("block \"" + name + "\" holds " + describe(wanted.type) + ", not " + describe(type));
  return static_cast<std::size_t>(wanted.bytes / type.bytes);
}

void CheckpointReader::get(const std::string &name, void *data, std::size_t bytes, ElementType type) const {
  elements(name, type);
  const Block &wanted = block(name);
  if (wanted.bytes != bytes)
    fail("block \"" + name + "\" has " + std::to_string(wanted.bytes) + " bytes where " +
         std::to_string(bytes) + " are needed");
  read_bytes(name, wanted, data);
}

void CheckpointReader::read_bytes(const std::string &name, const Block &wanted, void *data) const {
  if (wanted.bytes == 0) return;
  source_->stream.clear();
  source_->stream.seekg(static_cast<std::streamoff>(wanted.offset));
  if (!source_->read(data, static_cast<std::size_t>(wanted.bytes)) ||
      XXH64(data, static_cast<std::size_t>(wanted.bytes), 0) != wanted.checksum)
    fail("block \"" + name + "\" cannot be read, or changed while it was in use");
}

std::string CheckpointReader::text(const std::string &name) const {
  std::string text(elements(name, {ElementType::Kind::text, 1}), '\0');
  read_bytes(name, block(name), text.data());
  return text;
}

void CheckpointReader::check_columns(const std::string &prefix, const dem::Table &table) const {
  std::set<std::string> stored, wanted; // "name<tab>unit"
  std::istringstream list(text(prefix));
  for (std::string line; std::getline(list, line);)
    stored.insert(line);
  for (const auto &column : table.columns())
    wanted.insert(column->name() + '\t' + column->unit());
  const auto readable = [](std::string column) {
    const auto tab = column.find('\t');
    return column.substr(0, tab) + " (" + column.substr(tab + 1) + ")";
  };
  for (const std::string &column : wanted)
    if (stored.count(column) == 0)
      fail("table \"" + prefix + "\" has no column " + readable(column) + ", which this scene needs");
  for (const std::string &column : stored)
    if (wanted.count(column) == 0)
      fail("table \"" + prefix + "\" has a column " + readable(column) + ", which this scene does not use");
}

void CheckpointReader::read_table(const std::string &prefix, dem::Table &table) const {
  check_columns(prefix, table);
  const auto rows = value<std::uint64_t>(prefix + "/");
  for (const auto &column : table.columns()) {
    const std::string name = prefix + "/" + column->name();
    const std::size_t row_bytes = column->bytes_per_row();
    if (elements(name, {ElementType::Kind::raw, static_cast<std::uint32_t>(row_bytes)}) != rows)
      fail("block \"" + name + "\" has " + std::to_string(bytes(name) / row_bytes) +
           " rows where its table has " + std::to_string(rows));
  }
  table.resize(static_cast<std::size_t>(rows));
  for (const auto &column : table.columns()) {
    const std::string name = prefix + "/" + column->name();
    read_bytes(name, block(name), column->bytes());
  }
}

} // namespace platen::apps
