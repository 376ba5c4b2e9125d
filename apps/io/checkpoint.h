// A checkpoint file: named blocks of plain bytes, each with its length, its type and a checksum, and a
// checksum over the whole file. Layout, native byte order:
//   header   "PLATENCP", format version (4 bytes), byte order mark (4)
//   block    lengths and checksum (checkpoint_format.h), name, bytes; as many as there are
//   trailer  "PLATENND", number of blocks, length of the file, XXH64 of all that stands before (8 each)
// Values are stored byte for byte, so that a run goes on bitwise as if it had never stopped. Structs
// (Vector3, laws' states) must be trivially copyable and free of padding: padding bytes are undefined, and
// would make equal states give unequal files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "apps/io/errors.h"
#include "apps/io/file.h"
#include "dem/table.h"

namespace platen::apps {

// What the elements of a block are: a block is read back only as what it was written.
struct ElementType {
  enum class Kind : std::uint8_t { raw = 0, signed_number = 1, unsigned_number = 2, floating = 3, text = 4 };
  Kind kind = Kind::raw; // raw: structs, of which the size alone is known
  std::uint32_t bytes = 1;
  bool operator==(const ElementType &other) const { return kind == other.kind && bytes == other.bytes; }
};

template <class T>
constexpr ElementType element_type() {
  static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> && !std::is_array_v<T>,
                "a checkpoint holds plain values");
  using Kind = ElementType::Kind;
  constexpr Kind kind = std::is_floating_point_v<T>                ? Kind::floating
                        : std::is_enum_v<T> || std::is_signed_v<T> ? Kind::signed_number
                        : std::is_integral_v<T>                    ? Kind::unsigned_number
                                                                   : Kind::raw;
  return {kind, sizeof(T)};
}

class CheckpointHash; // running XXH64, defined in checkpoint_format.h

// Writes blocks straight to the file, nothing is collected in memory. Failures throw OutputError; a file
// without finish() is not a checkpoint. Use it through write_checkpoint (checkpoint_folder.h), which keeps
// the former ones.
class CheckpointWriter {
public:
  explicit CheckpointWriter(const std::filesystem::path &path);
  ~CheckpointWriter();

  // Names are unique; by custom "group/quantity". A name given twice throws std::logic_error.
  void add(const std::string &name, const void *data, std::size_t bytes, ElementType type = {});
  template <class T>
  void add(const std::string &name, const std::vector<T> &values) {
    static_assert(!std::is_same_v<T, bool>, "a vector<bool> has no bytes of its own; use vector<char>");
    add(name, values.data(), values.size() * sizeof(T), element_type<T>());
  }
  template <class T, class = std::enable_if_t<std::is_trivially_copyable_v<T>>>
  void add(const std::string &name, const T &value) {
    add(name, &value, sizeof(T), element_type<T>());
  }
  void add_text(const std::string &name, std::string_view text);
  // Every column as "prefix/column", and a list of the columns.
  void add_table(const std::string &prefix, const dem::Table &table);
  // Writes the trailer and waits until the disk has all.
  void finish();

private:
  void put(const void *bytes, std::size_t count);
  void flush();
  OutputFile file_;
  std::vector<char> buffer_; // small blocks are collected, large ones go past it
  std::unique_ptr<CheckpointHash> hash_;
  std::uint64_t length_ = 0;
  std::vector<std::string> names_;
};

// Opens a checkpoint and verifies every byte of it; throws CheckpointError that says what is wrong. Blocks
// are read from the file when asked for, and checked again. A block that is missing, or of another type or
// size than asked for, throws CheckpointError with its name.
class CheckpointReader {
public:
  explicit CheckpointReader(const std::filesystem::path &path);
  ~CheckpointReader();

  const std::filesystem::path &path() const { return path_; }
  bool has(const std::string &name) const { return blocks_.count(name) > 0; }
  std::vector<std::string> names() const;
  std::size_t bytes(const std::string &name) const;

  void get(const std::string &name, void *data, std::size_t bytes, ElementType type = {}) const;
  template <class T>
  void get(const std::string &name, std::vector<T> &values) const {
    std::vector<T> read(elements(name, element_type<T>()));
    get(name, read.data(), read.size() * sizeof(T), element_type<T>());
    values.swap(read);
  }
  template <class T, class = std::enable_if_t<std::is_trivially_copyable_v<T>>>
  void get(const std::string &name, T &value) const {
    get(name, &value, sizeof(T), element_type<T>());
  }
  template <class T>
  T value(const std::string &name) const {
    T read{};
    get(name, read);
    return read;
  }
  std::string text(const std::string &name) const;
  // Fills a table that has its columns already, matched by name; its length becomes the stored one. Throws,
  // and leaves the table alone, where a column is missing, is one too many, or has rows of another size or
  // unit.
  void read_table(const std::string &prefix, dem::Table &table) const;

private:
  struct Block {
    std::uint64_t offset = 0, bytes = 0, checksum = 0;
    ElementType type;
  };
  struct Source;
  void verify();
  [[noreturn]] void fail(const std::string &what) const;
  const Block &block(const std::string &name) const;
  std::size_t elements(const std::string &name, ElementType type) const;
  void read_bytes(const std::string &name, const Block &block, void *data) const;
  void check_columns(const std::string &prefix, const dem::Table &table) const;

  std::filesystem::path path_;
  std::unique_ptr<Source> source_;
  std::map<std::string, Block> blocks_;
};

} // namespace platen::apps
