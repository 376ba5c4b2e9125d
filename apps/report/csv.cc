#include "apps/report/csv.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

std::string trimmed(const std::string &text) {
  const auto first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> fields_of(const std::string &line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');)
    fields.push_back(trimmed(field));
  if (!line.empty() && line.back() == ',') fields.emplace_back();
  return fields;
}

double number_of(const std::string &field, const std::string &where) {
  if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
  char *end = nullptr;
  const double value = std::strtod(field.c_str(), &end);
  if (*end != '\0') throw InputError(where + "\"" + field + "\" is not a number");
  return value;
}

// All whole lines; an unfinished last one is dropped.
std::vector<std::string> whole_lines(const std::filesystem::path &file) {
  std::ifstream stream(file);
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

  CsvTable table;
  table.file = file;
  for (std::size_t number = 1; number < lines.size(); ++number) {
    if (trimmed(lines[number]).empty()) continue;
    const std::string where = file.string() + ":" + std::to_string(number + 1) + ": ";
    const std::vector<std::string> fields = fields_of(lines[number]);
    if (fields.size() != header.size())
      throw InputError(where + std::to_string(fields.size()) + " fields, but the header names " +
                       std::to_string(header.size()));
    for (std::size_t k = 0; k < header.size(); ++k) {
      if (std::find(word_columns.begin(), word_columns.end(), header[k]) != word_columns.end())
        table.words[header[k]].push_back(fields[k]);
      else
        table.numbers[header[k]].push_back(number_of(fields[k], where + header[k] + ": "));
    }
    ++table.rows;
  }
  for (const std::string &name : header) { // a table without rows still has its columns
    if (std::find(word_columns.begin(), word_columns.end(), name) != word_columns.end())
      table.words[name];
    else
      table.numbers[name];
  }
  return table;
}

} // namespace platen::apps::report
