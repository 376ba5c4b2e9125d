#include "base/state.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <utility>

#include "base/shortest_text.h"

namespace platen {
namespace {

using Kind = BlockType::Kind;

template <class T>
T number_at(const char *bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

// Calls visit with the number at `bytes`, in its own type.
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

// Digits that restore the number to the last bit.
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

std::string unit_text(const BlockType &type) {
  return type.unit == "1" ? "" : " " + type.unit;
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

// "finite" means a finite square, too (Allowed::largest). "finite, > 0 kg", "0 ... 599", "finite, or nan".
std::string words_of(const Allowed &allowed, const BlockType &type) {
  if (allowed.length == Allowed::Length::one) return "a row of length 1";
  if (allowed.length == Allowed::Length::one_or_none) return "a row of length 1, or of zeros";
  const std::string range = allowed.range.text();
  const bool finite = type.kind == Kind::floating && !allowed.infinite_too &&
                      !(std::isfinite(allowed.range.low) && std::isfinite(allowed.range.high));
  return (finite ? range.empty() ? "finite numbers" : "finite, " : "") + range + unit_text(type) +
         (allowed.nan_too ? ", or nan" : "");
}

// The first of `count` numbers at `bytes` that is not allowed; `count` where all are allowed.
std::size_t first_fault(const Allowed &allowed, const BlockType &type, const char *bytes, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k)
    if (!visit_number(type, bytes + k * type.bytes,
                      [&](auto value) { return allowed.holds(static_cast<double>(value)); }))
      return k;
  return count;
}

double length_of_row(const BlockType &type, const char *bytes) {
  double sum = 0;
  for (std::size_t k = 0; k < type.numbers; ++k)
    sum += visit_number(type, bytes + k * type.bytes,
                        [](auto value) { return static_cast<double>(value) * static_cast<double>(value); });
  return std::sqrt(sum);
}

// Throws StateError for the first number of a block that is not allowed.
void require_allowed(const StateSource &source, const std::string &name, const StoredBlock &block,
                     const Allowed &allowed) {
  const BlockType &type = block.type;
  const bool all = !std::isfinite(allowed.range.low) && !std::isfinite(allowed.range.high) &&
                   (type.kind != Kind::floating || (allowed.nan_too && allowed.infinite_too));
  if (type.kind == Kind::text || (all && allowed.length == Allowed::Length::any)) return;
  const std::vector<char> bytes = bytes_of(source, name, block);
  const std::size_t count = block.rows * type.numbers, bad = first_fault(allowed, type, bytes.data(), count);
  if (bad < count) {
    const std::string place = type.numbers > 1 ? "number " + std::to_string(bad % type.numbers + 1) + " of " +
                                                     std::to_string(type.numbers) + ", "
                                               : "";
    refuse_row(name, bad / type.numbers, place + number_text(type, bytes.data() + bad * type.bytes),
               words_of(allowed, type));
  }
  if (allowed.length == Allowed::Length::any) return;
  for (std::size_t row = 0; row < block.rows; ++row)
    if (const double length = length_of_row(type, bytes.data() + row * type.bytes_per_row());
        !allowed.holds_length(length))
      refuse_row(name, row, "length " + shortest_text(length), words_of(allowed, type));
}

} // namespace

bool SavingArchive::block(const std::string &path, const BlockType &type, const Rows &rows, bool,
                          const Allowed &) {
  sink_.add(path, type, rows.data, rows.count);
  return true;
}

bool LoadingArchive::block(const std::string &path, const BlockType &type, const Rows &rows, bool may_lack,
                           const Allowed &allowed) {
  if (may_lack && !source_.find(path)) return false;
  const StoredBlock stored = require_block(source_, path, type);
  if (!rows.resize && stored.rows != rows.count)
    throw StateError("\"" + path + "\" has " + std::to_string(stored.rows) + " rows, " +
                     std::to_string(rows.count) + " are needed");
  requested_.insert(path);
  if (!reads()) require_allowed(source_, path, stored, allowed);
  if (!reads() && !rows.is_local) return true;
  void *data = rows.resize ? rows.resize(stored.rows) : rows.data;
  if (stored.rows > 0) source_.read(path, data);
  return true;
}

void LoadingArchive::require_all_requested() const {
  for (const std::string &name : source_.names())
    if (requested_.count(name) == 0)
      throw StateError("holds \"" + name + "\", which this program has no place for");
}

void refuse_row(const std::string &name, std::size_t row, const std::string &value,
                const std::string &allowed) {
  throw StateError("\"" + name + "\", row " + std::to_string(row) + ": " + value + ". Allowed: " + allowed +
                   ".");
}

void require_as_many(const StateSource &source, const std::string &name, const std::string &other) {
  const auto rows = [&](const std::string &of) { return source.find(of).value_or(StoredBlock{}).rows; };
  if (rows(name) != rows(other))
    throw StateError("\"" + other + "\" has " + std::to_string(rows(other)) + " rows, as many as \"" + name +
                     "\" are needed: " + std::to_string(rows(name)));
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
  BlockRange range{none, none, 0};
  const std::optional<StoredBlock> block = source.find(name);
  if (!block || block->type.kind == Kind::text) return range;
  const std::vector<char> bytes = bytes_of(source, name, *block);
  for (std::size_t at = 0; at < bytes.size(); at += block->type.bytes) {
    const double value =
        visit_number(block->type, bytes.data() + at, [](auto number) { return static_cast<double>(number); });
    range.not_numbers += std::isnan(value);
    range.least = std::fmin(range.least, value), range.largest = std::fmax(range.largest, value);
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
