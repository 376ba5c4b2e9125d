#include "apps/io/csv_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "apps/io/errors.h"
#include "apps/scene/rank.h"

namespace platen::apps {
namespace {

// Quoted where a comma, a quote or a line end would break the row (RFC 4180).
void append_text(std::string &line, std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    line += text;
    return;
  }
  line += '"';
  for (const char c : text) {
    if (c == '"') line += '"';
    line += c;
  }
  line += '"';
}

std::string line_of(const std::vector<CsvCell> &cells) {
  std::string line;
  for (const CsvCell &cell : cells) {
    if (&cell != &cells.front()) line += ',';
    cell.append_to(line);
  }
  return line + '\n';
}

std::string header_line(const std::vector<std::string> &columns) {
  return line_of({columns.begin(), columns.end()});
}

// Throws CheckpointError unless `path` begins with the header and has a line end before byte `length`.
void check_resumable(const std::filesystem::path &path, const std::string &header, std::uint64_t length) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw CheckpointError(path.string() + ": missing or unreadable, the run cannot go on with it");
  std::string begin(header.size(), '\0');
  if (!stream.read(begin.data(), static_cast<std::streamsize>(begin.size())) || begin != header)
    throw CheckpointError(path.string() + ": its header line is not that of this run");
  stream.seekg(0, std::ios::end);
  const auto size = static_cast<std::uint64_t>(stream.tellg());
  if (size < length)
    throw CheckpointError(
        fmt::format("{}: has {} bytes, the checkpoint goes on after {}", path.string(), size, length));
  char last = '\0';
  if (length >= header.size()) stream.seekg(static_cast<std::streamoff>(length) - 1).get(last);
  if (last != '\n')
    throw CheckpointError(
        fmt::format("{}: no row ends at byte {}, where the checkpoint goes on", path.string(), length));
}

Sha256 sum_of_begin(const std::filesystem::path &path, std::uint64_t length) {
  std::ifstream stream(path, std::ios::binary);
  std::string chunk(1 << 16, '\0');
  Sha256 sum;
  while (length > 0 && stream) {
    stream.read(chunk.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(chunk.size(), length)));
    const auto got = static_cast<std::size_t>(stream.gcount());
    sum.update(std::string_view(chunk).substr(0, got));
    length -= got;
  }
  return sum;
}

} // namespace

void CsvCell::append_to(std::string &line) const {
  if (const double *number = std::get_if<double>(&value_)) {
    if (!std::isnan(*number)) fmt::format_to(std::back_inserter(line), "{}", *number);
  } else if (const long long *count = std::get_if<long long>(&value_)) {
    fmt::format_to(std::back_inserter(line), "{}", *count);
  } else {
    append_text(line, std::get<std::string_view>(value_));
  }
}

CsvWriter::CsvWriter(const std::filesystem::path &path, std::vector<std::string> columns)
    : columns_(std::move(columns)), file_(path) {
  try {
    write(header_line(columns_));
  } catch (const OutputError &) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) std::filesystem::remove(path, ignored);
    throw;
  }
}

CsvWriter::CsvWriter(const std::filesystem::path &path, std::vector<std::string> columns,
                     std::uint64_t length)
    : columns_(std::move(columns)) {
  bytes_ = length;
  if (this_rank().is_silent()) return;
  check_resumable(path, header_line(columns_), length);
  sum_ = sum_of_begin(path, length);
  file_ = OutputFile(path, OutputFile::Mode::append);
  file_.truncate(length);
}

void CsvWriter::sync() {
  file_.require_alone(bytes_);
  file_.sync();
}

void CsvWriter::row(const std::vector<CsvCell> &cells) {
  if (cells.size() != columns_.size())
    throw std::logic_error(
        fmt::format("{}: a row of {} values for {} columns", path().string(), cells.size(), columns_.size()));
  write(line_of(cells));
}

void CsvWriter::write(const std::string &line) {
  file_.require_alone(bytes_);
  try {
    file_.write(line);
  } catch (const OutputError &) {
    file_.try_truncate(bytes_);
    throw;
  }
  bytes_ += line.size();
  sum_.update(line);
}

WholeTable::~WholeTable() {
  if (this_rank().is_silent()) return;
  std::error_code ignored; // a finished one has another name
  std::filesystem::remove(path(), ignored);
}

} // namespace platen::apps
