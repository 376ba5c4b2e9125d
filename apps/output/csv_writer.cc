#include "apps/output/csv_writer.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "apps/output/errors.h"
#include "apps/scene/rank.h"
#include "apps/scene/regular_file.h"

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
    : columns_(std::move(columns)), bytes_(length) {
  require_resumable(path, columns_, length);
  file_ = OutputFile(path, OutputFile::Mode::append);
  file_.truncate(length);
}

void require_resumable(const std::filesystem::path &path, const std::vector<std::string> &columns,
                       std::uint64_t length, const std::string &checkpoint) {
  const std::string of = checkpoint.empty() ? "" : " " + checkpoint;
  const auto refuse = [&](const std::string &fault) {
    throw CheckpointError(fmt::format(
        "{}: error: {}; put the file back as the run wrote it, or start the run anew with --overwrite",
        path.string(), fault));
  };
  std::ifstream stream = open_file(path);
  if (!stream) refuse("is missing or cannot be read");
  const std::string header = header_line(columns);
  std::string begin(header.size(), '\0');
  if (!stream.read(begin.data(), static_cast<std::streamsize>(begin.size())) || begin != header)
    refuse("its header line is not that of this run");
  stream.seekg(0, std::ios::end);
  if (const auto size = static_cast<std::uint64_t>(stream.tellg()); size < length)
    refuse(fmt::format("has {} bytes, it had {} at the checkpoint{}", size, length, of));
  char last = '\0';
  if (length >= header.size()) stream.seekg(static_cast<std::streamoff>(length) - 1).get(last);
  if (last != '\n')
    refuse(fmt::format("no row ends at byte {}, where the checkpoint{} continues", length, of));
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
}

WholeTable::~WholeTable() {
  if (this_rank().is_silent()) return;
  std::error_code ignored; // a finished one has another name
  std::filesystem::remove(path(), ignored);
}

} // namespace platen::apps
