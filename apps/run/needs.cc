#include "apps/run/needs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

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

double cells_of_mesh(const Scene &scene, coupling::Side side) {
  const std::string &file = scene.platens.face(side).mesh_file;
  return file.empty() ? 0 : share_of_hexahedra * elements_in(file);
}

double platen_cells(const Scene &scene, const dem::Shape &shape, const coupling::PlatenTestSettings &of) {
  double cells = 0;
  for (const coupling::Side side : coupling::all_sides)
    if (of.platens.side(side) != nullptr)
      cells += scene.platens.face(side).mesh_file.empty() ? coupling::cells_of_platen(shape, of, side)
                                                          : cells_of_mesh(scene, side);
  return cells;
}

// Faces are as long as wide; 0 around: as wide as five spheres, so that the spheres count first.
double sleeve_cells(const Scene &scene, const dem::Shape &shape, double around) {
  if (!scene.loading.sleeved()) return 0;
  if (around == 0) around = 2 * pi * shape.radius / (5 * scene.specimen.sphere_radius);
  const double along = shape.height / (2 * pi * shape.radius) * around;
  return around * along * scene.loading.cell->sleeve->elements_through;
}

double spheres_in(const Scene &scene, const dem::Shape &shape) {
  return least_packing_fraction * shape.volume() /
         (4.0 / 3.0 * pi * std::pow(scene.specimen.sphere_radius, 3));
}

Needs needs_of(const Scene &scene, const dem::Shape &shape, const coupling::PlatenTestSettings &settings,
               double around) {
  Needs n;
  if (scene.specimen.packing != PackingKind::file) n.spheres = spheres_in(scene, shape);
  n.platen_cells = platen_cells(scene, shape, settings);
  n.sleeve_cells = sleeve_cells(scene, shape, around);
  n.sphere_bytes = bytes_of_sphere * n.spheres;
  n.platen_bytes = bytes_of_cell(settings.platens) * n.platen_cells;
  n.sleeve_bytes = bytes_of_sleeve * n.sleeve_cells;
  return n;
}

double elements_around(const Scene &scene) {
  return scene.loading.sleeved() ? scene.loading.cell->sleeve->elements_around : 0;
}

// The largest whole number up to `most` for which `fits`; 0 where none does.
int largest(int most, const std::function<bool(int)> &fits) {
  int low = 0, high = most + 1;
  while (high - low > 1) {
    const int middle = low + (high - low) / 2;
    (fits(middle) ? low : high) = middle;
  }
  return low;
}

// What the refused entry may be, where anything else stays as it is.
std::string allowed(int most) {
  return most > 0 ? fmt::format("up to {}", most) : "none with all else as it is";
}

[[noreturn]] void refuse_elements(const Scene &scene, const std::string &entry, const std::string &of,
                                  double cells, double bytes, double memory, const std::string &may_be) {
  refuse(
      scene, entry,
      fmt::format("asks for {:.2g} elements of {}, which take {:.3g} GB of memory or more. Allowed: {}, as "
                  "this machine's memory of {:.3g} GB holds.",
                  cells, of, 1e-9 * bytes, may_be, 1e-9 * memory));
}

void refuse_platens(const Scene &scene, const dem::Shape &shape, const coupling::PlatenTestSettings &settings,
                    const Needs &needs, double memory) {
  for (const coupling::Side side : coupling::all_sides)
    if (settings.platens.side(side) != nullptr && cells_of_mesh(scene, side) > 0.5 * needs.platen_cells)
      refuse_elements(scene, section_of(side) + "/Mesh file", "a platen", cells_of_mesh(scene, side),
                      needs.platen_bytes, memory, "a coarser mesh");
  const int most = largest(settings.platens.elements_across, [&](int across) {
    if (across < 3) return true; // fewer than a round plate can have
    coupling::PlatenTestSettings fewer = settings;
    fewer.platens.elements_across = across;
    return needs_of(scene, shape, fewer, elements_around(scene)).bytes() <= memory;
  });
  refuse_elements(scene, "Platens/Elements across", "the platens", needs.platen_cells, needs.platen_bytes,
                  memory, allowed(most < 3 ? 0 : most));
}

void refuse_sleeve(const Scene &scene, const dem::Shape &shape, const coupling::PlatenTestSettings &settings,
                   const Needs &needs, double memory) {
  const double around = elements_around(scene);
  const int most = largest(static_cast<int>(around), [&](int fewer) {
    return needs_of(scene, shape, settings, std::max(1, fewer)).bytes() <= memory;
  });
  const bool given = around > 0;
  refuse_elements(scene, given ? "Sleeve/Elements around" : "Sleeve/Elements through", "the sleeve",
                  needs.sleeve_cells, needs.sleeve_bytes, memory, given ? allowed(most) : "fewer");
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
double seconds_of_step(const Needs &needs, const coupling::PlatenTestSettings &of) {
  const bool steps_elements =
      of.platens.elastic && of.platens.elastic->motion == fem::ElasticMotion::explicit_steps;
  return seconds_of_sphere * needs.spheres + seconds_of_sleeve * needs.sleeve_cells +
         (steps_elements ? seconds_of_explicit : seconds_of_rigid) * needs.platen_cells;
}

} // namespace

CountedCosts counted_costs(const Scene &scene, const dem::Shape &shape) {
  const coupling::PlatenTestSettings settings = settings_without_files(scene);
  const Needs needs = needs_of(scene, shape, settings, elements_around(scene));
  return {needs.spheres, needs.bytes(),
          seconds_of_step(needs, settings) * duration(scene, shape.height) /
              longest_step(scene, shape, settings)};
}

CountedCosts counted_costs(const Scene &scene) {
  try {
    if (scene.specimen.packing != PackingKind::file && !scene.loading.bending())
      return counted_costs(scene, specimen_shape(scene));
  } catch (const std::exception &) { // which its run will tell
  }
  return {not_given, not_given, not_given};
}

Needs needs_of(const Scene &scene, const dem::Shape &shape) {
  return needs_of(scene, shape, settings_without_files(scene), elements_around(scene));
}

void require_memory(const Scene &scene, const dem::Shape &shape) {
  if (scene.specimen.packing != PackingKind::file) check_count(scene, shape);
  const auto memory = static_cast<double>(this_machine().memory_bytes);
  const coupling::PlatenTestSettings settings = settings_without_files(scene);
  const Needs needs = needs_of(scene, shape, settings, elements_around(scene));
  if (memory == 0 || needs.bytes() <= memory) return require_useful_elements(scene, shape, settings);
  if (needs.platen_bytes >= std::max(needs.sphere_bytes, needs.sleeve_bytes))
    refuse_platens(scene, shape, settings, needs, memory);
  if (needs.sleeve_bytes >= needs.sphere_bytes) refuse_sleeve(scene, shape, settings, needs, memory);
  refuse(
      scene, "Specimen/Sphere radius",
      fmt::format("asks for {:.2g} spheres, which take {:.3g} GB of memory or more, and finite elements "
                  "that take {:.3g} GB. Allowed: larger spheres or fewer elements, as this machine's memory "
                  "of {:.3g} GB holds.",
                  needs.spheres, 1e-9 * needs.sphere_bytes, 1e-9 * (needs.platen_bytes + needs.sleeve_bytes),
                  1e-9 * memory));
}

std::string counted_estimate(const Scene &scene, const dem::Shape &shape) {
  const auto memory = static_cast<double>(this_machine().memory_bytes);
  const coupling::PlatenTestSettings settings = settings_without_files(scene);
  const Needs needs = needs_of(scene, shape, settings, elements_around(scene));
  if (memory == 0 || needs.bytes() <= share_of_dry_run * memory) return "";
  const double step = seconds_of_step(needs, settings),
               steps = duration(scene, shape.height) / longest_step(scene, shape, settings);
  const std::string time = std::isnan(steps) ? "time not counted"
                                             : fmt::format("{} or more ({:.2g} steps or more)",
                                                           duration_text(step * steps), steps);
  return fmt::format(
      "  counted, not built: {:.2g} spheres, {:.2g} elements of platens, {:.2g} of a sleeve\n"
      "  estimate: {}, memory {:.0f} MB or more; a dry run builds no more than an eighth of the memory, "
      "{:.0f} "
      "MB\n",
      needs.spheres, needs.platen_cells, needs.sleeve_cells, time, 1e-6 * needs.bytes(),
      1e-6 * share_of_dry_run * memory);
}

} // namespace platen::apps
