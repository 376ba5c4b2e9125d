#include "apps/report/csv.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>

#include "apps/output/numbers.h"
#include "apps/scene/errors.h"
#include "apps/scene/regular_file.h"

namespace platen::apps::report {
namespace {

std::vector<std::string> fields_of(const std::string &line) {
  std::vector<std::string> fields = cells_of(line);
  for (std::string &field : fields)
    field = std::string(trimmed(field));
  return fields;
}

// All whole lines; an unfinished last one is dropped.
std::vector<std::string> whole_lines(const std::filesystem::path &file) {
  std::ifstream stream = open_file(file);
  if (!stream) throw InputError(file.string() + ": cannot be read");
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    if (stream.eof() && !lines.empty()) break;
    lines.push_back(line);
  }
  return lines;
}

} // namespace

const std::vector<double> &CsvTable::column(const std::string &name) const {
  const auto found = numbers.find(name);
  if (found == numbers.end()) throw InputError(file.string() + ": no column " + name);
  return found->second;
}

CsvTable read_csv(const std::filesystem::path &file, const std::vector<std::string> &word_columns) {
  const std::vector<std::string> lines = whole_lines(file);
  if (lines.empty() || trimmed(lines[0]).empty()) throw InputError(file.string() + ": empty, no header line");
  const std::vector<std::string> header = fields_of(lines[0]);

  const auto is_word = [&](const std::string &column) {
    return std::find(word_columns.begin(), word_columns.end(), column) != word_columns.end();
  };
  CsvTable table;
  table.file = file;
  for (const std::string &column : header) // a table without rows still has its columns
    is_word(column) ? table.words[column].clear() : table.numbers[column].clear();
  for (std::size_t line = 1; line < lines.size(); ++line) {
    if (trimmed(lines[line]).empty()) continue;
    const std::string where = file.string() + ":" + std::to_string(line + 1) + ": ";
    const std::vector<std::string> fields = fields_of(lines[line]);
    if (fields.size() != header.size())
      throw InputError(where + std::to_string(fields.size()) + " fields, but the header names " +
                       std::to_string(header.size()));
    for (std::size_t k = 0; k < header.size(); ++k) {
      const std::optional<double> number =
          fields[k].empty() ? std::numeric_limits<double>::quiet_NaN() : number_of(fields[k]);
      if (is_word(header[k]))
        table.words[header[k]].push_back(fields[k]);
      else if (number)
        table.numbers[header[k]].push_back(*number);
      else
        throw InputError(where + header[k] + ": \"" + fields[k] + "\" is not a number");
    }
    ++table.rows;
  }
  return table;
}

} // namespace platen::apps::report
