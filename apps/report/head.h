// What stands above the figures of a page: whether it came out as its scene expects, and what was tested.
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "apps/output/summary.h"
#include "apps/report/report.h"

namespace platen::apps::report {

// A folder of results, as far as the head of a page needs it.
struct Results {
  std::string name; // of its folder, above its column
  std::filesystem::path folder;
  Json summary;
  double mean_radius = not_told;     // m, of the spheres
  std::vector<std::string> friction; // of each platen: "top 0.57"; empty where it is no test between platens
  static constexpr double not_told = std::numeric_limits<double>::quiet_NaN();
};

// The summary.json of the folder, null where it is missing or damaged.
Results results_in(const std::filesystem::path &folder);
Results results_of(const Run &run);

// What page and pictures are called: the title of the scene file, as long as it holds. Where an option has
// set entries of the test or the specimen to something else, and no other title, that may name what was not
// tested: the folder's name then, and that its scene was changed.
std::string true_title(const std::string &title, const std::filesystem::path &folder, const Json &summary);

// Puts both above the figures. The verdict: what each scene expects, what was found, what is not met first;
// how a run ended that is not done; why it was too fast. The facts: number of spheres and bonds, mean radius,
// seed, friction of the platens, title of the scene file and all that was overridden in it.
void add_head(const std::vector<Results> &all, Album &album);
void add_head(const std::filesystem::path &folder, Album &album); // of one folder, no run between platens
std::string verdict_in_words(const std::vector<Results> &all);    // a sentence; "" where nothing is expected
TableOfFigures table_of_verdict(const std::vector<Results> &all); // no rows where there is none
TableOfFigures table_of_facts(const std::vector<Results> &all);

} // namespace platen::apps::report
