// Folders of apps that crush nothing: packings, bond tests, bars. Their pictures and pages.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "apps/output/summary.h"
#include "apps/report/chart.h"
#include "apps/report/report.h"
#include "dem/packing/specimen.h"

namespace platen::apps::report {

// What summary.json says of its app; of a folder without one that holds specimen.csv and no history.csv,
// "platen-pack". Empty where nothing tells.
std::string app_of(const std::filesystem::path &folder);

// Reads `folder`, calls `ensure_display`, and draws and writes the page into `pictures`.
using Reader = std::function<void(const std::filesystem::path &folder, const std::filesystem::path &pictures,
                                  const std::function<void()> &ensure_display, std::ostream &out)>;
// Of packings, bond tests and bars; null of any other folder. Readers throw InputError where a file is
// missing or damaged, OutputError where a picture cannot be written.
Reader reader_of(const std::filesystem::path &folder);

void write_pack_report(const std::filesystem::path &folder, const std::filesystem::path &pictures,
                       const std::function<void()> &ensure_display, std::ostream &out);
void write_bonds_report(const std::filesystem::path &folder, const std::filesystem::path &pictures,
                        const std::function<void()> &ensure_display, std::ostream &out);
void write_bar_report(const std::filesystem::path &folder, const std::filesystem::path &pictures,
                      const std::function<void()> &ensure_display, std::ostream &out);

// What those share: the summary (empty where it is missing or damaged), the title of the scene, the numbers
// of the summary as they stand there.
Json summary_of(const std::filesystem::path &folder);
std::string title_of(const Json &summary, const std::filesystem::path &folder);
TableOfFigures numbers_of(const Json &summary, const std::vector<std::string> &left_out);

// Numbers of a packing, for its pictures.

// Shares of values in `bins` even intervals from the least to the largest (one where all are the same).
struct Histogram {
  std::vector<double> middle, share;
};
Histogram histogram_of(const std::vector<double> &values, int bins);

// Volume of spheres over the volume of each of `slices` even slices from the bottom to the top of a cylinder
// or a box; exact, where no spheres overlap.
struct DensityProfile {
  std::vector<double> height, density; // m, 1
};
DensityProfile density_profile(const dem::Specimen &specimen, int slices);

// Neighbours of each sphere within a gap of `gap` mean radii.
std::vector<double> neighbours_of(const dem::Specimen &specimen, double gap);

} // namespace platen::apps::report
