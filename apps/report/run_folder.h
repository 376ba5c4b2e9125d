// An output folder of a run, read as far as a report needs it.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/report/csv.h"
#include "apps/report/frames.h"
#include "apps/report/moments.h"

namespace platen::apps::report {

struct Run {
  std::filesystem::path folder;
  std::string name;  // last part of the path, for legends
  std::string title; // Scene / Title; the name where the scene gives none
  CsvTable history;
  Moments moments;
  nlohmann::json summary;                         // null where the run wrote none
  std::optional<CsvTable> cracks;                 // "mode" as words
  std::optional<CsvTable> events;                 // acoustic ones
  FrameSeries specimen, bonds, platens, contacts; // empty where the run wrote none
  std::vector<std::string> remarks;               // what is not there, one sentence each

  // Time at which cracks are looked at: the fall to 0.8 of the peak, or the end where it did not come.
  double pattern_time() const { return moments.post_peak_time.value_or(moments.end_time); }
  // The same in words, for captions: "the fall to 0.8 of the peak" or "the end".
  std::string pattern_words() const;
};

// Reads history, summary, cracks and the lists of frames. Only history.csv must be there; what else is
// missing becomes a remark. Throws InputError where the folder or the history is missing, or any file is
// damaged.
Run read_run(const std::filesystem::path &folder);

} // namespace platen::apps::report
