// Comma-separated tables: those that grow row by row as a run goes on (history.csv, cracks.csv), and those
// that are written at one go (events.csv).
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "apps/output/file.h"

namespace platen::apps {

// One cell: a number, or a word (std::string, literal). The shortest text that reads back to the same double
// is written, without regard to the locale; what was not measured is NaN, an empty cell.
class CsvCell {
public:
  template <class T, class = std::enable_if_t<std::is_arithmetic_v<T>>>
  CsvCell(T value) {
    if constexpr (std::is_floating_point_v<T>)
      value_ = static_cast<double>(value);
    else
      value_ = static_cast<long long>(value);
  }
  CsvCell(std::string_view text) : value_(text) {}
  CsvCell(const std::string &text) : value_(std::string_view(text)) {}
  CsvCell(const char *text) : value_(std::string_view(text)) {}
  void append_to(std::string &line) const;

private:
  std::variant<double, long long, std::string_view> value_; // text is not kept
};

// Each row reaches the file before row() returns. Failures throw OutputError, and the row that failed is
// taken off again, so that the file ends with a whole row. A file that another program has removed, replaced,
// shortened or lengthened in between is a failure too, found by the next row or by sync().
class CsvWriter {
public:
  // A new file with its header line; one that is there is replaced. None is left where not even that can be
  // written.
  CsvWriter(const std::filesystem::path &path, std::vector<std::string> columns);
  // Continues a file after its first `length` bytes, as a checkpoint states them (bytes()); what follows them
  // is cut off, so that the rows of the resumed run are at the same places as those of an uninterrupted one.
  // Throws CheckpointError as require_resumable does.
  CsvWriter(const std::filesystem::path &path, std::vector<std::string> columns, std::uint64_t length);

  // One value for each column, else std::logic_error.
  void row(const std::vector<CsvCell> &cells);
  std::uint64_t bytes() const { return bytes_; } // of header and whole rows
  // Waits until the disk has all rows: before a checkpoint that states bytes().
  void sync();
  const std::filesystem::path &path() const { return file_.path(); }

private:
  void write(const std::string &line);
  std::vector<std::string> columns_;
  OutputFile file_;
  std::uint64_t bytes_ = 0;
};

// Throws CheckpointError, with what to do, if a table cannot be continued after its first `length` bytes: it
// is missing, shorter, has other columns, or no row ends there. `checkpoint`: the file that says the length.
void require_resumable(const std::filesystem::path &path, const std::vector<std::string> &columns,
                       std::uint64_t length, const std::string &checkpoint = "");

// A table that is written at one go: it stands under its name with all rows or not at all. Failures throw
// OutputError, and a former file stays.
class WholeTable : public CsvWriter {
public:
  WholeTable(const std::filesystem::path &path, std::vector<std::string> columns)
      : CsvWriter(part_path(path), std::move(columns)), whole_(path) {}
  ~WholeTable(); // without finish(): nothing is left
  void finish() { make_current(path(), whole_); }

private:
  std::filesystem::path whole_;
};

} // namespace platen::apps
