// The output folder of a study, read as far as a report needs it.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/report/comparison.h"

namespace platen::apps::report {

// A number with its scatter, or the range of a laboratory.
struct Spread {
  double mean, low, high; // NaN where nothing was measured
};

struct StudiedCase {
  std::string name, surface;      // "dry_steel_slenderness_2", "dry steel"
  double friction, slenderness;   // 1; friction NaN where platens hold otherwise
  double sphere_radius, pressure; // m, Pa
  Spread strength;                // MPa, mean and standard deviation over the seeds
  int without_peak = 0;           // runs whose stress did not fall: the strength is what they bore
  int runs = 0;                   // that came to their end
  bool plain = true;              // what holds is friction alone: no brush, no sheet
};

struct StudiedRatio {
  std::string effect; // "gain over free ends", "strength over that at slenderness 2", "cube over prism"
  std::size_t of = 0, over = 0; // StudyResults::cases
  Spread ratio;
  std::string laboratory; // "1.42 (1.21 to 1.59)"; "-" where none is known
};

struct LaboratoryPoint {
  std::string effect, source;
  bool free_ends;
  double slenderness;
  Spread ratio;
};

struct StudyResults {
  std::string title, kind; // kind: friction, slenderness
  std::vector<StudiedCase> cases;
  std::vector<StudiedRatio> ratios;
  std::vector<LaboratoryPoint> laboratory;
  std::vector<std::string> remarks;

  const StudiedRatio *ratio_of(std::size_t of, const std::string &effect) const; // null: not measured
};

// Whether the folder is one of a study.
bool holds_study(const std::filesystem::path &folder);

// What study.json holds. Throws InputError where it is missing, damaged, or of a study that has not ended.
nlohmann::json finished_study(const std::filesystem::path &folder);
// The title of the scene, else the folder's name.
std::string title_of_study(const std::filesystem::path &folder);

// Of a study of platens. Throws InputError as above, and where it is of another kind.
StudyResults read_study(const std::filesystem::path &folder);

// A row for each case: strength, and each ratio beside the laboratory's.
TableOfFigures table_of_study(const StudyResults &study);

} // namespace platen::apps::report
