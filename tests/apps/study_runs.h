// platen-study as a user runs it, on specimens of a hundred spheres.
#pragma once

#include <algorithm>
#include <sstream>

#include "apps/program.h"
#include "apps/scratch_folder.h"

namespace platen::apps::testing {

// The texts of one column.
inline std::vector<std::string> words_in(const fs::path &csv, const std::string &name) {
  std::istringstream rows(content_of(csv));
  std::vector<std::string> words;
  std::size_t column = 0;
  for (std::string row; std::getline(rows, row);) {
    std::istringstream cells(row);
    std::vector<std::string> parts;
    for (std::string part; std::getline(cells, part, ',');)
      parts.push_back(part);
    if (words.empty())
      column = static_cast<std::size_t>(std::find(parts.begin(), parts.end(), name) - parts.begin());
    words.push_back(column < parts.size() ? parts[column] : "");
  }
  if (!words.empty()) words.erase(words.begin());
  return words;
}

inline std::vector<std::string> with(std::vector<std::string> options, const std::string &option) {
  options.push_back(option);
  return options;
}

class Study : public ScratchFolder {
protected:
  // One run at a time where `options` do not say otherwise.
  std::vector<std::string> command(const std::string &name, const std::vector<std::string> &options,
                                   const std::string &kind = "size") const {
    std::vector<std::string> all{PLATEN_STUDY_PROGRAM, kind, test_scene("study.prm"), "-o", name};
    if (std::find(options.begin(), options.end(), "-t") == options.end()) all.insert(all.end(), {"-t", "1"});
    all.insert(all.end(), options.begin(), options.end());
    return all;
  }
  Outcome run(const std::string &name, const std::vector<std::string> &options,
              const std::string &kind = "size") const {
    Outcome outcome;
    outcome.status = Program(command(name, options, kind), folder_).wait();
    outcome.out = content_of(folder_ / "out.txt");
    outcome.error = content_of(folder_ / "error.txt");
    return outcome;
  }
  std::string table(const std::string &name) const { return content_of(folder_ / name / "study.csv"); }
  nlohmann::json json(const std::string &name) const {
    return nlohmann::json::parse(content_of(folder_ / name / "study.json"));
  }
};

} // namespace platen::apps::testing
