#include "base/archive.h"

#include <cstdint>

namespace platen {

std::string describe(const BlockType &type) {
  using Kind = BlockType::Kind;
  if (type.kind == Kind::text) return "text";
  std::string words = std::to_string(type.bytes) + "-byte " +
                      (type.kind == Kind::floating           ? "floating-point numbers"
                       : type.kind == Kind::unsigned_integer ? "unsigned integers"
                                                             : "integers");
  if (type.unit != "1") words += " (" + type.unit + ")";
  if (type.numbers != 1) words += ", " + std::to_string(type.numbers) + " in a row";
  return words;
}

int Archive::version(int known) {
  std::int32_t stored = known;
  block(path("version"), block_type<std::int32_t>("1"), {&stored, 1, {}, true}, false, {});
  if (stored < 1 || stored > known)
    throw StateError("part \"" + path_.substr(0, path_.empty() ? 0 : path_.size() - 1) + "\" has version " +
                     std::to_string(stored) + ", this program knows versions up to " + std::to_string(known));
  return stored;
}

void Archive::text(const std::string &name, std::string &text) {
  const auto resize = [&text](std::size_t n) -> void * {
    text.resize(n);
    return text.data();
  };
  block(path(name), text_type(), {text.data(), text.size(), resize}, false, {});
}

void Archive::table(const std::string &name, Table &table) {
  const Scope scope(*this, name);
  columns_of(table, false);
}

void Archive::same_table(const std::string &name, Table &table) {
  const Scope scope(*this, name);
  columns_of(table, true);
}

void Archive::columns_of(Table &table, bool same_size) {
  std::uint64_t rows = table.size();
  block(path("size"), block_type<std::uint64_t>("1"), {&rows, 1, {}, true}, false, {});
  const std::size_t count = static_cast<std::size_t>(rows);
  if (same_size && count != table.size())
    throw StateError("table \"" + path_.substr(0, path_.size() - 1) + "\" has " + std::to_string(count) +
                     " rows, " + std::to_string(table.size()) + " are needed");
  if (reads()) table.resize(count);
  for (const auto &column : table.columns())
    if (!block(path(column->name()), column->type(), {column->bytes(), count, {}}, column->may_lack(),
               column->allowed()) &&
        reads())
      column->fill_lacking();
}

} // namespace platen
