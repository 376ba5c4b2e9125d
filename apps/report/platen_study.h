// The output folder of a study of platens (friction, slenderness), read as far as a report needs it; its
// pictures and its page.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "apps/output/seed_statistics.h"
#include "apps/report/report.h"

namespace platen::apps::report {

// A number with its scatter, or the range of a laboratory.
struct Spread {
  double mean, low, high; // NaN where nothing was measured
  int packings = 0;       // that it is of; 0: of none, or not told
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
  bool outside = false;   // the laboratory's range
  std::string reason;     // why there is none; "" where there may be one
};

struct LaboratoryPoint {
  std::string effect, source;
  bool free_ends;
  double slenderness;
  Spread ratio;
};

struct StudyResults {
  std::string title;
  std::filesystem::path folder;
  std::vector<StudiedCase> cases;
  std::vector<StudiedRatio> ratios;
  std::vector<LaboratoryPoint> laboratory;
  std::vector<std::string> remarks;

  const StudiedRatio *ratio_of(std::size_t of, const std::string &effect) const; // null: not measured
};

// Whether the folder is one of a study.
bool holds_study(const std::filesystem::path &folder);

// What study.json holds. Throws InputError where it is missing, damaged, or of a study that has not ended.
Json finished_study(const std::filesystem::path &folder);
// The title of the scene, else the folder's name.
std::string title_of_study(const std::filesystem::path &folder);
// "2 of 9 runs failed and count in no mean", as a remark where any did.
void add_failed_runs(const Json &study, std::vector<std::string> &remarks);
// What the bars of a study's picture are: "; bars: standard deviation over the packings", their range where
// there are fewer than five, or that there is one packing, whose scatter nobody knows. `packings`: the most
// of any case.
std::string words_of_scatter(int packings);
// In multiples of a unit: the mean and the standard deviation to both sides of five packings and more, of
// fewer the mean and their range; low and high are the mean where neither is known.
Spread over_seeds(const Json &statistics, double unit);
Spread spread_of(const SeedStatistics &statistics);
// "41.0 +- 0.9"; of fewer than five packings "40.1 ... 41.9, 3 packings"; "-" of nothing.
std::string words(const Spread &spread, int digits);
// Why figures of a case do not count, from the summaries of its runs: "3 of 3 runs: no peak reached, ...".
// Empty where the runs' folders are not there or say nothing.
std::string reasons_in_runs(const std::filesystem::path &folder, const std::string &name,
                            const std::string &figure);
// NaN where it is null.
double number_or_nan(const Json &value);

// Of a study of platens. Throws InputError as above, and where it is of another kind.
StudyResults read_study(const std::filesystem::path &folder);

// A row for each case: strength, and each ratio beside the laboratory's.
TableOfFigures table_of_study(const StudyResults &study);

// Strength, and its gain over free ends, against the coefficient of friction: a curve for each slenderness,
// bars of scatter, the laboratory's figures at dry steel. Platens that hold otherwise than by friction are
// left out. `cases` are alike but for platens and slenderness. Needs an X server; throws OutputError.
void draw_friction(const StudyResults &study, const std::vector<std::size_t> &cases,
                   const std::filesystem::path &png);

// Strength, and its ratio to that at slenderness 2, against height over width: a curve for each kind of
// platens. As above.
void draw_slenderness(const StudyResults &study, const std::vector<std::size_t> &cases,
                      const std::filesystem::path &png);

// Draws what the study varied into `folder` (made where it is not there), for each sphere radius and pressure
// apart, puts pictures and table on the page report.html there, and prints the same. Needs an X server;
// throws OutputError.
void write_study_report(const StudyResults &study, const std::filesystem::path &folder, std::ostream &out);

} // namespace platen::apps::report
