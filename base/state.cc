#include "base/state.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <utility>

namespace platen {
namespace {

using Kind = BlockType::Kind;

template <class T>
T number_at(const char *bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

// Calls visit with the number that stands at `bytes`, as what it is.
template <class Visit>
auto visit_number(const BlockType &type, const char *bytes, const Visit &visit) {
  if (type.kind == Kind::floating)
    return visit(type.bytes == 4 ? static_cast<double>(number_at<float>(bytes)) : number_at<double>(bytes));
  const bool is_signed = type.kind == Kind::signed_integer;
  switch (type.bytes) {
    case 1:
      return is_signed ? visit(number_at<std::int8_t>(bytes)) : visit(number_at<std::uint8_t>(bytes));
    case 2:
      return is_signed ? visit(number_at<std::int16_t>(bytes)) : visit(number_at<std::uint16_t>(bytes));
    case 4:
      return is_signed ? visit(number_at<std::int32_t>(bytes)) : visit(number_at<std::uint32_t>(bytes));
    default:
      return is_signed ? visit(number_at<std::int64_t>(bytes)) : visit(number_at<std::uint64_t>(bytes));
  }
}

// Digits that give the number back to the last bit.
std::string number_text(const BlockType &type, const char *bytes) {
  return visit_number(type, bytes, [](auto value) -> std::string {
    if constexpr (std::is_floating_point_v<decltype(value)>) {
      char text[32];
      std::snprintf(text, sizeof text, "%.17g", value);
      return text;
    } else {
      return std::to_string(value);
    }
  });
}

std::vector<char> bytes_of(const StateSource &source, const std::string &name, const StoredBlock &block) {
  std::vector<char> bytes(block.rows * block.type.bytes_per_row());
  if (!bytes.empty()) source.read(name, bytes.data());
  return bytes;
}

StoredBlock require_block(const StateSource &source, const std::string &name, const BlockType &type) {
  const std::optional<StoredBlock> stored = source.find(name);
  if (!stored) throw StateError("lacks \"" + name + "\"");
  if (!(stored->type == type))
    throw StateError("\"" + name + "\" holds " + describe(stored->type) + ", not " + describe(type));
  return *stored;
}

std::string difference_of_rows(const std::string &name, const BlockType &type, const std::vector<char> &a,
                               const std::vector<char> &b) {
  if (type.kind == Kind::text)
    return name + ": \"" + std::string(a.begin(), a.end()) + "\" and \"" + std::string(b.begin(), b.end()) +
           "\"";
  const auto place = static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin()).first - a.begin());
  const std::size_t number = place / type.bytes, first = number * type.bytes;
  std::string where = name + ", row " + std::to_string(number / type.numbers);
  if (type.numbers > 1)
    where += ", number " + std::to_string(number % type.numbers + 1) + " of " + std::to_string(type.numbers);
  const std::string unit = type.unit == "1" ? "" : " " + type.unit;
  return where + ": " + number_text(type, a.data() + first) + " and " + number_text(type, b.data() + first) +
         unit;
}

} // namespace

bool SavingArchive::block(const std::string &path, const BlockType &type, const Rows &rows, bool) {
  sink_.add(path, type, rows.data, rows.count);
  return true;
}

std::optional<StoredBlock> LoadingArchive::wanted(const std::string &path, const BlockType &type,
                                                  bool may_lack) const {
  if (may_lack && !source_.find(path)) return std::nullopt;
  return require_block(source_, path, type);
}

void LoadingArchive::expect(const std::string &path, const BlockType &type, std::size_t rows, bool may_lack) {
  const std::optional<StoredBlock> stored = wanted(path, type, may_lack);
  if (stored && stored->rows != rows)
    throw StateError("\"" + path + "\" has " + std::to_string(stored->rows) + " rows, " +
                     std::to_string(rows) + " are needed");
}

bool LoadingArchive::block(const std::string &path, const BlockType &type, const Rows &rows, bool may_lack) {
  const std::optional<StoredBlock> stored = wanted(path, type, may_lack);
  if (!stored) return false;
  if (!rows.resize) expect(path, type, rows.count, may_lack);
  void *data = rows.resize ? rows.resize(stored->rows) : rows.data;
  if (stored->rows > 0) source_.read(path, data);
  read_[path] = true;
  return true;
}

void LoadingArchive::require_all_read() const {
  for (const std::string &name : source_.names())
    if (read_.count(name) == 0)
      throw StateError("holds \"" + name + "\", which this program has no place for");
}

void State::add(const std::string &name, const BlockType &type, const void *data, std::size_t rows) {
  const char *first = static_cast<const char *>(data);
  std::vector<char> bytes;
  if (rows > 0) bytes.assign(first, first + rows * type.bytes_per_row());
  if (!blocks_.emplace(name, Block{{type, rows}, std::move(bytes)}).second)
    throw std::logic_error("state: \"" + name + "\" is described twice");
  names_.push_back(name);
}

std::vector<std::string> State::names() const {
  return names_;
}

std::optional<StoredBlock> State::find(const std::string &name) const {
  const auto found = blocks_.find(name);
  return found == blocks_.end() ? std::nullopt : std::optional(found->second.stored);
}

void State::read(const std::string &name, void *data) const {
  const std::vector<char> &bytes = blocks_.at(name).bytes;
  if (!bytes.empty()) std::memcpy(data, bytes.data(), bytes.size());
}

void add_text(StateSink &sink, const std::string &name, const std::string &text) {
  sink.add(name, text_type(), text.data(), text.size());
}

std::string text_of(const StateSource &source, const std::string &name) {
  std::string text(rows_of_type(source, name, text_type()), '\0');
  if (!text.empty()) source.read(name, text.data());
  return text;
}

std::size_t rows_of_type(const StateSource &source, const std::string &name, const BlockType &type) {
  return require_block(source, name, type).rows;
}

BlockRange range_of(const StateSource &source, const std::string &name) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  BlockRange range{none, none};
  const std::optional<StoredBlock> block = source.find(name);
  if (!block || block->type.kind == Kind::text) return range;
  const std::vector<char> bytes = bytes_of(source, name, *block);
  for (std::size_t at = 0; at < bytes.size(); at += block->type.bytes) {
    const double value =
        visit_number(block->type, bytes.data() + at, [](auto number) { return static_cast<double>(number); });
    range = {std::fmin(range.least, value), std::fmax(range.largest, value)};
  }
  return range;
}

std::optional<std::string> first_difference(const StateSource &a, const StateSource &b) {
  for (const std::string &name : a.names()) {
    const StoredBlock one = *a.find(name);
    const std::optional<StoredBlock> other = b.find(name);
    if (!other) return name + ": only the first has it";
    if (!(one.type == other->type)) return name + ": " + describe(one.type) + " and " + describe(other->type);
    const std::vector<char> left = bytes_of(a, name, one), right = bytes_of(b, name, *other);
    const bool is_text = one.type.kind == Kind::text;
    if (one.rows != other->rows && !is_text)
      return name + ": " + std::to_string(one.rows) + " and " + std::to_string(other->rows) + " rows";
    if (left != right) return difference_of_rows(name, one.type, left, right);
  }
  for (const std::string &name : b.names())
    if (!a.find(name)) return name + ": only the second has it";
  return std::nullopt;
}

} // namespace platen
