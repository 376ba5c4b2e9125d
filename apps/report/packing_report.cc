// Pictures of a packing: sizes, neighbours, density over the height.
#include "apps/report/other_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <ostream>

#include "apps/output/specimen_csv.h"
#include "apps/report/head.h"
#include "apps/scene/errors.h"
#include "base/pi.h"
#include "dem/packing/quality.h"

namespace platen::apps::report {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> costs{"steps",
                                     "time_step_s",
                                     "threads",
                                     "wall_seconds",
                                     "setup_seconds",
                                     "particle_steps_per_second",
                                     "peak_memory_bytes"};

void draw_sizes(const std::string &title, const dem::Specimen &specimen, const fs::path &png) {
  constexpr int bins = 24;
  constexpr double bonded_gap = 0.05; // mean radii, what a bond of the house's scenes reaches
  const Histogram sizes =
      histogram_of(scaled({specimen.radius.begin(), specimen.radius.end()}, mm_per_m), bins);
  Chart size = chart_with_axes("Sphere radius (mm)", "Share of the spheres (%)");
  size.curves.push_back({"", sizes.middle, scaled(sizes.share, 100), colours::blue, Stroke::solid, 5});
  if (sizes.middle.size() == 1) size.marks.push_back({sizes.middle[0], 100, "one size", colours::blue});
  size.x_range = snug_x_range(size);

  Chart neighbours = chart_with_axes("Neighbours of a sphere", "Share of the spheres (%)");
  std::size_t colour = 0;
  for (const double gap : {1e-3, bonded_gap}) {
    std::map<int, double> count;
    const std::vector<double> of = neighbours_of(specimen, gap);
    for (const double one : of)
      count[static_cast<int>(one)] += 100 / static_cast<double>(of.size());
    const double mean = std::accumulate(of.begin(), of.end(), 0.0) / static_cast<double>(of.size());
    Curve curve{fmt::format("within a gap of {:g} mean radii: {:.2f} in the mean", gap, mean),
                {},
                {},
                run_colour(colour)};
    for (int k = 0; !count.empty() && k <= count.rbegin()->first; ++k) {
      curve.x.push_back(k), curve.y.push_back(count[k]);
      neighbours.marks.push_back({static_cast<double>(k), count[k], "", run_colour(colour)});
    }
    neighbours.curves.push_back(std::move(curve));
    ++colour;
  }
  save_charts(title, fmt::format("{} spheres: sizes and neighbours", specimen.size()), {size, neighbours},
              {600, 600}, png);
}

void draw_density(const std::string &title, const dem::Specimen &specimen, const fs::path &png) {
  double mean_radius = 0;
  for (const double radius : specimen.radius)
    mean_radius += radius / static_cast<double>(specimen.size());
  const int slices = std::clamp(static_cast<int>(std::lround(specimen.shape.height / mean_radius)), 8, 200);
  const DensityProfile profile = density_profile(specimen, slices);
  Chart chart = chart_with_axes("Height above the bottom (mm)", "Share of the volume that is filled");
  chart.curves.push_back({"slices of about a mean radius", scaled(profile.height, mm_per_m), profile.density,
                          colours::blue, Stroke::solid, 4});
  const double mean =
      std::accumulate(profile.density.begin(), profile.density.end(), 0.0) / static_cast<double>(slices);
  chart.curves.push_back({fmt::format("mean {:.3f}", mean),
                          {0, specimen.shape.height * mm_per_m},
                          {mean, mean},
                          colours::grey,
                          Stroke::dashed,
                          3});
  save_charts(title, "Packing over the height", {chart}, {700}, png);
}

} // namespace

void write_pack_report(const fs::path &folder, const fs::path &pictures,
                       const std::function<void()> &ensure_display, std::ostream &out) {
  const SpecimenFile file = read_specimen_csv(folder / "specimen.csv");
  const Json summary = summary_of(folder);
  const std::string title = title_of(summary, folder);
  ensure_display();
  Album album(pictures);
  add_head(folder, album);
  std::vector<std::string> remarks;
  album.begin("The packing");
  album.add("sizes.png", "How large the spheres are, and how many neighbours they have.", draw_sizes, title,
            file.specimen);
  if (file.states_shape && file.specimen.shape.kind != dem::ShapeKind::disc)
    album.add("density.png",
              "Share of each slice that spheres fill, from the bottom to the top: at flat walls it falls and "
              "swings over a few spheres.",
              draw_density, title, file.specimen);
  else
    remarks.emplace_back("density over the height is drawn of cylinders and boxes alone");
  if (summary.empty()) remarks.emplace_back("summary.json is not there or damaged: its figures are left out");
  for (const std::string &remark : remarks)
    out << remark << '\n';
  album.finish(title, numbers_of(summary, costs), remarks, out);
}

Histogram histogram_of(const std::vector<double> &values, int bins) {
  Histogram histogram;
  if (values.empty()) return histogram;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (*low == *high) return {{*low}, {1}};
  const double width = (*high - *low) / bins;
  for (int k = 0; k < bins; ++k)
    histogram.middle.push_back(*low + (k + 0.5) * width);
  histogram.share.assign(static_cast<std::size_t>(bins), 0.0);
  for (const double value : values)
    histogram.share[static_cast<std::size_t>(std::min(bins - 1, static_cast<int>((value - *low) / width)))] +=
        1 / static_cast<double>(values.size());
  return histogram;
}

DensityProfile density_profile(const dem::Specimen &specimen, int slices) {
  DensityProfile profile;
  const double thick = specimen.shape.height / slices, area = specimen.shape.cross_section();
  profile.density.assign(static_cast<std::size_t>(slices), 0.0);
  for (int k = 0; k < slices; ++k)
    profile.height.push_back((k + 0.5) * thick);
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const double r = specimen.radius[i], z = specimen.centre[i].z;
    const auto part = [&](double up_to) { // of the sphere, below a height
      const double h = std::clamp(up_to - z, -r, r);
      return pi * (r * r * (h + r) - (h * h * h + r * r * r) / 3);
    };
    const int first = std::max(0, static_cast<int>(std::floor((z - r) / thick))),
              last = std::min(slices - 1, static_cast<int>(std::floor((z + r) / thick)));
    for (int k = first; k <= last; ++k)
      profile.density[static_cast<std::size_t>(k)] +=
          (part((k + 1) * thick) - part(k * thick)) / (area * thick);
  }
  return profile;
}

std::vector<double> neighbours_of(const dem::Specimen &specimen, double gap) {
  const double mean = std::accumulate(specimen.radius.begin(), specimen.radius.end(), 0.0) /
                      static_cast<double>(specimen.size());
  std::vector<double> neighbours(specimen.size(), 0.0);
  for (const dem::TouchingPair &pair : dem::touching_pairs(specimen, gap * mean))
    ++neighbours[static_cast<std::size_t>(pair.first)], ++neighbours[static_cast<std::size_t>(pair.second)];
  return neighbours;
}

} // namespace platen::apps::report
