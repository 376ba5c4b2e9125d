// Comma-separated tables with one header line, as the apps write them: numbers, and a few columns of words.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace platen::apps::report {

struct CsvTable {
  std::filesystem::path file;
  std::size_t rows = 0;
  std::map<std::string, std::vector<double>> numbers;    // by column; NaN where a field is empty
  std::map<std::string, std::vector<std::string>> words; // the columns that were asked for as words

  bool has(const std::string &column) const { return numbers.count(column) > 0; }
  // Throws InputError where the file has no such column.
  const std::vector<double> &column(const std::string &name) const;
};

// Reads `file`; columns named in `word_columns` are kept as text, all others must be numbers (or empty).
// A last line without line end is left out: the run that writes the file is still at it, or was killed there.
// Throws InputError (file, line) where the file is missing, has no header, or has a row that does not fit it.
CsvTable read_csv(const std::filesystem::path &file, const std::vector<std::string> &word_columns = {});

} // namespace platen::apps::report
