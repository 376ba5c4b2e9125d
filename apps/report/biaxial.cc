#include "apps/report/biaxial.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "apps/report/chart.h"

namespace platen::apps::report {
namespace {

constexpr double no_stress = 0.02; // of the largest one: below it a side counts as free

// Equal stresses on two pairs of sides, brushes: 1.16 of the uniaxial strength. The one figure of the source
// that has been read, in its abstract.
constexpr double published_ratio = 1.16;
constexpr const char *published_source = "Kupfer, Hilsdorf and Ruesch 1969, brushes";

// What platens are: runs are compared where all of it is alike.
std::string platens_of(const Run &run) {
  std::string text;
  for (const char *entry : {"Surface", "Kind", "Friction static", "Friction dynamic", "Top/Surface",
                            "Top/Friction static", "Top/Friction dynamic", "Top/Mesh file"})
    text += scene_entry(run.folder / "scene.prm", std::string("Platens/") + entry) + "; ";
  return text;
}

std::string surface_of(const Run &run) {
  const auto entry = [&](const char *key) {
    return scene_entry(run.folder / "scene.prm", std::string("Platens/") + key);
  };
  const std::string word = entry("Surface"), mesh = entry("Top/Mesh file");
  const std::string surface =
      word.empty() || word == "custom" ? "friction " + entry("Friction static") : word;
  if (!mesh.empty()) return surface + ", mesh " + std::filesystem::path(mesh).stem().string();
  return entry("Kind") == "deformable" ? surface + ", elastic" : surface;
}

bool has_failed(const Run &run) {
  const auto told = run.summary.find("peak_reached");
  return told != run.summary.end() && told->is_boolean() ? told->get<bool>()
                                                         : run.moments.post_peak_time.has_value();
}

std::array<double, 3> stresses_at_peak(const Run &run) { // Pa, the largest first
  const auto columns = axis_stresses(run);
  std::array<double, 3> stresses{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    stresses[axis] = columns[axis][run.moments.peak_row];
  std::sort(stresses.rbegin(), stresses.rend());
  return stresses;
}

} // namespace

BiaxialStrengths biaxial_strengths(const std::vector<Run> &runs) {
  BiaxialStrengths strengths;
  std::map<std::string, double> uniaxial; // Pa, by platens
  for (const Run &run : runs) {
    const std::array<double, 3> s = stresses_at_peak(run);
    if (has_failed(run) && s[0] > 0 && s[1] < no_stress * s[0]) uniaxial.emplace(platens_of(run), s[0]);
  }
  for (const Run &run : runs) {
    const std::array<double, 3> s = stresses_at_peak(run);
    const bool bare = s[1] < no_stress * s[0];
    if (!has_further_sides(run) && !bare) continue; // in a cell
    const auto reference = uniaxial.find(platens_of(run));
    const std::string why = !has_failed(run)                    ? "has not failed"
                            : s[2] >= no_stress * s[0] && !bare ? "is pressed along three axes"
                            : reference == uniaxial.end()
                                ? "has no run beside it with the same platens and free sides"
                                : "";
    if (why.empty())
      strengths.points.push_back(
          {run.name, surface_of(run), s[0] / reference->second, bare ? 0 : s[1] / reference->second});
    else if (has_further_sides(run))
      strengths.left_out.push_back(run.name + " " + why + ": it is not in the picture of biaxial strengths");
  }
  return strengths;
}

bool tells_envelope(const BiaxialStrengths &strengths) {
  return std::any_of(strengths.points.begin(), strengths.points.end(),
                     [](const BiaxialPoint &point) { return point.second > 0; });
}

void draw_biaxial(const BiaxialStrengths &strengths, const std::filesystem::path &png) {
  Chart chart;
  std::map<std::string, std::vector<BiaxialPoint>> by_surface;
  for (const BiaxialPoint &point : strengths.points)
    by_surface[point.surface].push_back(point);
  std::size_t count = 0;
  double most = published_ratio;
  for (auto &[surface, points] : by_surface) {
    std::sort(points.begin(), points.end(), [](const BiaxialPoint &a, const BiaxialPoint &b) {
      return a.second * b.first < b.second * a.first;
    });
    Curve curve{surface, {}, {}, run_colour(count)};
    for (const BiaxialPoint &point : points) {
      curve.x.push_back(point.first), curve.y.push_back(point.second);
      chart.marks.push_back({point.first, point.second, "", run_colour(count), MarkShape::circle});
      most = std::max(most, point.first);
    }
    chart.curves.push_back(std::move(curve));
    ++count;
  }
  const double end = round_ticks(0, 1.1 * most, 6).back();
  chart.curves.push_back({"equal stresses", {0, end}, {0, end}, colours::grey, Stroke::dashed, 3});
  chart.marks.push_back(
      {published_ratio, published_ratio, published_source, colours::black, MarkShape::diamond});
  chart.x_range = chart.y_range = {0, end};
  chart.x_title = "Largest stress at failure over uniaxial strength";
  chart.y_title = "Second stress over it";
  save_charts("Strength under two stresses", "Over the uniaxial strength between the same platens", {chart},
              {1100}, png);
}

} // namespace platen::apps::report
