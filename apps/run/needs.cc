#include "apps/run/needs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <vector>

#include "apps/output/machine.h"
#include "apps/output/progress.h"
#include "apps/run/problem_setup.h"
#include "apps/run/specimen_setup.h"
#include "apps/scene/parameters.h"
#include "apps/scene/settings.h"
#include "base/pi.h"
#include "coupling/platens_of_test.h"

namespace platen::apps {
namespace {

// Resident memory that one more takes, from the peaks of dry runs of tests/apps/scenes/study.prm (74 spheres,
// 171 MB without): platens of 160 and 400 elements across where rigid (1210, 1190 bytes an element), of 80
// and 120 where explicit (3360, 3200; degree 2, 40 across: 47 000), of 40 and 60 where quasi-static (30 000,
// 14 900; degree 2, 40 across: 230 000); sleeves of 200 and 400 around (16 400, 16 600; eight through the
// wall 13 100). The constants lie below all of these, so that what would fit is not refused. Spheres:
// bench/results/step.md has 665 in columns alone.
constexpr double bytes_of_sphere = 500, bytes_of_rigid = 1100, bytes_of_sleeve = 12000;
constexpr std::array<double, 2> bytes_of_explicit{3000, 40000}, bytes_of_quasi_static{12000, 150000};
constexpr double least_packing_fraction = 0.5;

// Of a mesh file's elements those that are hexahedra, at the least: faces and lines are listed beside them.
constexpr double share_of_hexahedra = 0.5;

// Seconds of a step on two threads, measured in the same runs, lower bounds as well; and of a sphere
// (bench/results/step.md).
constexpr double seconds_of_sphere = 1e-7, seconds_of_rigid = 2e-9, seconds_of_explicit = 1e-7,
                 seconds_of_sleeve = 3e-7;

// Of the machine's memory, what a dry run may take to look at the first steps.
constexpr double share_of_dry_run = 0.125;

// The count that stands in the section of elements of a Gmsh file, 0 where there is none. Whether the file is
// sound is found when it is read.
double elements_in(const std::string &path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return 0;
  std::ifstream file(path, std::ios::binary);
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("$Elements", 0) != 0) continue;
    double first = 0, second = 0;
    file >> first; // 2.2: their number; 4.1: blocks, then their number
    const bool blocks = file.peek() == ' ' && file >> second;
    return blocks ? second : first;
  }
  return 0;
}

double bytes_of_cell(const coupling::PlatenSettings &p) {
  if (!p.elastic) return bytes_of_rigid;
  const auto degree = static_cast<std::size_t>(p.elastic->degree - 1);
  return (p.elastic->motion == fem::ElasticMotion::explicit_steps ? bytes_of_explicit
                                                                  : bytes_of_quasi_static)[degree];
}

double width_of(const dem::Shape &shape) {
  return shape.kind == dem::ShapeKind::box ? std::max(shape.width_x, shape.width_y) : 2 * shape.radius;
}

double plate_cells(const Scene &scene, const dem::Shape &shape, const coupling::PlatenTestSettings &of) {
  double cells = 0;
  for (const coupling::Side side : coupling::all_sides)
    if (of.platens.side(side) != nullptr && scene.platens.face(side).mesh_file.empty())
      cells += coupling::cells_of_platen(shape, of, side);
  return cells;
}

// Faces are as long as wide; 0 around: as wide as five spheres, so that the spheres count first.
double sleeve_cells(const Scene &scene, const dem::Shape &shape) {
  const coupling::SleeveSettings &sleeve = *scene.loading.cell->sleeve;
  const double girth = 2 * pi * shape.radius, around = sleeve.elements_around > 0
                                                           ? sleeve.elements_around
                                                           : girth / (5 * scene.specimen.sphere_radius);
  return around * (shape.height / girth * around) * sleeve.elements_through;
}

double spheres_in(const Scene &scene, const dem::Shape &shape) {
  return least_packing_fraction * shape.volume() /
         (4.0 / 3.0 * pi * std::pow(scene.specimen.sphere_radius, 3));
}

// What takes memory, and the entry that decides how much. Counts and bytes are lower bounds: so much is there
// for certain.
struct Need {
  enum class Of { spheres, platens, sleeve } of;
  std::string entry, what;
  double count, bytes;
};

std::vector<Need> needs_of(const Scene &scene, const dem::Shape &shape,
                           const coupling::PlatenTestSettings &settings) {
  std::vector<Need> needs;
  const auto add = [&](Need::Of of, const std::string &entry, const std::string &what, double amount,
                       double bytes) {
    needs.push_back({of, entry, what, amount, bytes * amount});
  };
  if (scene.specimen.packing != PackingKind::file)
    add(Need::Of::spheres, "Specimen/Sphere radius", "spheres", spheres_in(scene, shape), bytes_of_sphere);
  const double cell = bytes_of_cell(settings.platens);
  add(Need::Of::platens, "Platens/Elements across", "elements of the platens",
      plate_cells(scene, shape, settings), cell);
  for (const coupling::Side side : coupling::all_sides)
    if (settings.platens.side(side) != nullptr)
      add(Need::Of::platens, section_of(side) + "/Mesh file", "elements of a platen",
          share_of_hexahedra * elements_in(scene.platens.face(side).mesh_file), cell);
  if (scene.loading.sleeved())
    add(Need::Of::sleeve,
        scene.loading.cell->sleeve->elements_around > 0 ? "Sleeve/Elements around"
                                                        : "Sleeve/Elements through",
        "elements of the sleeve", sleeve_cells(scene, shape), bytes_of_sleeve);
  return needs;
}

double bytes_of(const std::vector<Need> &needs) {
  return std::accumulate(needs.begin(), needs.end(), 0.0,
                         [](double sum, const Need &one) { return sum + one.bytes; });
}

double count_of(const std::vector<Need> &needs, Need::Of of) {
  return std::accumulate(needs.begin(), needs.end(), 0.0,
                         [of](double sum, const Need &one) { return one.of == of ? sum + one.count : sum; });
}

// Elements far below the spheres have nothing between their nodes that differs: memory and time for nothing.
void require_useful_elements(const Scene &scene, const dem::Shape &shape,
                             const coupling::PlatenTestSettings &settings) {
  constexpr double finest = 1.0 / 30; // over the mean radius
  const double radius = scene.specimen.sphere_radius;
  if (!(radius > 0)) return; // of a specimen from a file
  const coupling::PlatenSettings &p = settings.platens;
  const bool meshed =
      std::any_of(coupling::all_sides.begin(), coupling::all_sides.end(), [&](coupling::Side side) {
        return p.side(side) != nullptr && scene.platens.face(side).mesh_file.empty();
      });
  if (!meshed) return;
  const double width = p.overhang * width_of(shape), edge = width / p.elements_across;
  if (edge < finest * radius)
    refuse(scene, "Platens/Elements across",
           fmt::format(
               "makes elements of {:.3g} m, {:.2g} of the radius of the spheres, which feel nothing of them. "
               "Allowed: up to {:.0f}.",
               edge, edge / radius, std::floor(width / (finest * radius))));
}

// s, from nothing to the target strain, as far as the scene says; NaN where stages or a stress lead.
double duration(const Scene &scene, double height) {
  const Loading &loading = scene.loading;
  if (loading.staged() || loading.servo || loading.hydrostatic()) return not_given;
  if (!std::isnan(loading.rate)) return loading.target_strain * height / loading.rate;
  const double speed = std::sqrt(scene.model.bond_layout.modulus / scene.model.density);
  constexpr double closure = 1e-3; // in which a wave crosses so often
  return loading.wave_transits * height / speed * loading.target_strain / closure;
}

// s, no step is longer: the time of a wave through the smallest sphere, and through an elastic platen's
// smallest element where it is explicit.
double longest_step(const Scene &scene, const dem::Shape &shape, const coupling::PlatenTestSettings &of) {
  const coupling::PlatenSettings &p = of.platens;
  double step = 2 * scene.specimen.sphere_radius *
                std::sqrt(scene.model.mass_scaling * scene.model.density / scene.model.bond_layout.modulus);
  if (p.elastic && p.elastic->motion == fem::ElasticMotion::explicit_steps) {
    const double edge = p.overhang * width_of(shape) / p.elements_across;
    step = std::min(step, edge * std::sqrt(p.material.density / p.material.young_modulus));
  }
  return step;
}

// s, on two threads.
double seconds_of_step(const std::vector<Need> &needs, const coupling::PlatenTestSettings &of) {
  const bool steps_elements =
      of.platens.elastic && of.platens.elastic->motion == fem::ElasticMotion::explicit_steps;
  return seconds_of_sphere * count_of(needs, Need::Of::spheres) +
         seconds_of_sleeve * count_of(needs, Need::Of::sleeve) +
         (steps_elements ? seconds_of_explicit : seconds_of_rigid) * count_of(needs, Need::Of::platens);
}

} // namespace

CountedCosts counted_costs(const Scene &scene, const dem::Shape &shape) {
  const coupling::PlatenTestSettings settings = settings_without_files(scene);
  const std::vector<Need> needs = needs_of(scene, shape, settings);
  return {count_of(needs, Need::Of::spheres), bytes_of(needs),
          seconds_of_step(needs, settings) * duration(scene, shape.height) /
              longest_step(scene, shape, settings)};
}

CountedCosts counted_costs(const Scene &scene) {
  try {
    if (scene.specimen.packing != PackingKind::file && !scene.loading.bending())
      return counted_costs(scene, specimen_shape(scene));
  } catch (const std::exception &) { // which its run will report
  }
  return {not_given, not_given, not_given};
}

void require_memory(const Scene &scene, const dem::Shape &shape) {
  if (scene.specimen.packing != PackingKind::file) check_count(scene, shape);
  const auto memory = static_cast<double>(this_machine().memory_bytes);
  const coupling::PlatenTestSettings settings = settings_without_files(scene);
  const std::vector<Need> needs = needs_of(scene, shape, settings);
  const double bytes = bytes_of(needs);
  if (memory == 0 || bytes <= memory) return require_useful_elements(scene, shape, settings);
  const Need &most = *std::max_element(needs.begin(), needs.end(),
                                       [](const Need &a, const Need &b) { return a.bytes < b.bytes; });
  refuse(
      scene, most.entry,
      fmt::format("asks for {:.2g} {}, which take {:.3g} GB of memory or more, of {:.3g} GB in all. Allowed: "
                  "fewer, so that all fits into this machine's memory of {:.3g} GB.",
                  most.count, most.what, 1e-9 * most.bytes, 1e-9 * bytes, 1e-9 * memory));
}

std::string counted_estimate(const Scene &scene, const dem::Shape &shape) {
  const auto memory = static_cast<double>(this_machine().memory_bytes);
  const std::vector<Need> needs = needs_of(scene, shape, settings_without_files(scene));
  if (memory == 0 || bytes_of(needs) <= share_of_dry_run * memory) return "";
  const double seconds = counted_costs(scene, shape).seconds;
  return fmt::format(
      "  counted, not built: {:.2g} spheres, {:.2g} elements of platens, {:.2g} of a sleeve\n"
      "  estimate: {}, memory {:.0f} MB or more; a dry run builds no more than an eighth of the memory, "
      "{:.0f} MB\n",
      count_of(needs, Need::Of::spheres), count_of(needs, Need::Of::platens),
      count_of(needs, Need::Of::sleeve),
      std::isnan(seconds) ? "time not counted" : duration_text(seconds) + " or more", 1e-6 * bytes_of(needs),
      1e-6 * share_of_dry_run * memory);
}

} // namespace platen::apps
