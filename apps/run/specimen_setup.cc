#include "apps/run/specimen_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/output/machine.h"
#include "apps/output/specimen_csv.h"
#include "apps/scene/parameters.h"
#include "apps/scene/units.h"
#include "base/pi.h"
#include "dem/packing/advancing_front.h"
#include "dem/packing/growth.h"
#include "dem/packing/periodic_growth.h"
#include "dem/packing/tiled.h"

namespace platen::apps {
namespace {

// Spheres of a file may reach this far out of the shape, in mean radii: rounded coordinates, soft packings.
constexpr double file_wall_tolerance = 0.01;
// Relative difference of lengths that the scene and the specimen file both state.
constexpr double same_length = 1e-6;

dem::RadiusDistribution radii(const SpecimenSection &specimen) {
  const double mean = specimen.sphere_radius;
  switch (specimen.radius_distribution) {
    case RadiusKind::equal:
      return dem::equal_radii(mean);
    case RadiusKind::uniform:
      return dem::uniform_radii_of_spread(mean, specimen.radius_spread);
    case RadiusKind::two_sizes:
      break;
  }
  const double ratio = specimen.second_radius_ratio, fraction_of_small = specimen.second_fraction;
  const double large = mean / (1 - fraction_of_small * (1 - ratio));
  return dem::two_radii(ratio * large, large, 1 - fraction_of_small);
}

void check_length(const Scene &scene, const char *path, double wanted, double found) {
  if (std::isnan(wanted) || std::abs(wanted - found) <= same_length * found) return;
  refuse(scene, path,
         "contradicts the shape that " + scene.specimen.file + " states, " + shortest_text(found) + " m.");
}

bool same_kind(SpecimenShape wanted, dem::ShapeKind found) {
  if (wanted == SpecimenShape::disc) return found != dem::ShapeKind::box;
  return wanted == SpecimenShape::bar || (wanted == SpecimenShape::box) == (found == dem::ShapeKind::box);
}

// The shape of a file holds; what the scene states of it must agree.
void check_shape(const Scene &scene, const dem::Shape &found) {
  const SpecimenSection &wanted = scene.specimen;
  const bool states = scene.parameters && scene.parameters->at("Specimen/Shape").changed();
  if (states && !same_kind(wanted.shape, found.kind))
    refuse(scene, "Specimen/Shape", "contradicts the shape that " + wanted.file + " states.");
  const bool lying = found.kind == dem::ShapeKind::disc;
  check_length(scene, "Specimen/Height", wanted.height, lying ? found.width_y : found.height);
  if (found.kind != dem::ShapeKind::box) {
    check_length(scene, "Specimen/Radius", wanted.radius, found.radius);
  } else {
    check_length(scene, "Specimen/Width x", wanted.width_x, found.width_x);
    check_length(scene, "Specimen/Width y", wanted.width_y, found.width_y);
  }
}

dem::Specimen read_specimen(const Scene &scene) {
  SpecimenFile file = read_specimen_file(scene.specimen.file, scene.specimen.form);
  if (file.states_shape) {
    check_shape(scene, file.specimen.shape);
  } else if (!scene.specimen.form.filled) {
    file.specimen.shape = specimen_shape(scene);
    const dem::Shape &shape = file.specimen.shape;
    const bool whole =
        shape.height > 0 &&
        (shape.kind == dem::ShapeKind::cylinder ? shape.radius > 0 : shape.width_x > 0 && shape.width_y > 0);
    if (!whole)
      refuse(scene, "Specimen/File",
             "states no shape: the scene has to give Specimen/Height and Radius, or Width x and Width y; or "
             "none of them, for what the spheres reach.");
  }
  const std::vector<std::string> problems = dem::check_specimen(file.specimen, file_wall_tolerance, 4);
  if (problems.empty()) return std::move(file.specimen);
  std::string all = "holds no sound specimen:";
  for (const std::string &problem : problems)
    all += "\n  " + problem;
  refuse(scene, "Specimen/File", all);
}

} // namespace

void check_phases(const Scene &scene, const dem::Specimen &specimen) {
  const PhasesSection &phases = scene.phases;
  if (phases.by == PhasesBy::radius && (dem::largest_radius(specimen) <= phases.phases.radius_above ||
                                        dem::smallest_radius(specimen) > phases.phases.radius_above))
    refuse(scene, "Phases/Radius above",
           "leaves one phase empty: the radii are " + shortest_text(dem::smallest_radius(specimen)) +
               " ... " + shortest_text(dem::largest_radius(specimen)) + " m.");
  if (phases.by != PhasesBy::file) return;
  const std::vector<int> ids = read_id_list(phases.file, specimen.size());
  if (ids.empty() || ids.size() == specimen.size())
    refuse(
        scene, "Phases/File",
        ids.empty() ? "names no sphere: the aggregate is empty." : "names all spheres: the matrix is empty.");
}

namespace {

// A slip of a unit asks for spheres without number, and the system ends what takes all memory without a word.
// Both constants are on the safe side: bench/results/step.md has 665 bytes a sphere in columns alone.
constexpr double least_packing_fraction = 0.5, least_bytes = 500, most_spheres = 2e8;

bool tiled(const SpecimenSection &specimen) {
  return specimen.packing == PackingKind::random_close && specimen.tile_spheres > 0;
}

double spread_of(const SpecimenSection &specimen) {
  return specimen.radius_distribution == RadiusKind::equal ? 0.0 : specimen.radius_spread;
}

void check_tiles(const Scene &scene, const dem::Shape &shape) {
  const SpecimenSection &specimen = scene.specimen;
  if (!tiled(specimen)) return;
  const auto least = static_cast<double>(dem::fewest_periodic_spheres);
  const double one = tiling_of(scene, shape).tiles * specimen.tile_spheres; // spheres of the specimen
  const double most = std::floor(one / dem::fewest_tiles / 100) * 100;
  if (specimen.tile_spheres >= least && specimen.tile_spheres <= most) return;
  const std::string why = specimen.tile_spheres < least
                              ? "would meet itself"
                              : fmt::format("is a large part of the specimen, which has some {:.2g}", one);
  refuse(scene, "Specimen/Tile spheres",
         most < least
             ? why + ". Allowed: 0, which grows the specimen as a whole."
             : fmt::format("{}. Allowed: {:.0f} ... {:.0f}, or 0, which grows the specimen as a whole.", why,
                           least, most));
}

} // namespace

Tiling tiling_of(const Scene &scene, const dem::Shape &shape) {
  const SpecimenSection &specimen = scene.specimen;
  if (!tiled(specimen)) return {};
  const double tiles = dem::tiles_in(shape, specimen.sphere_radius, spread_of(specimen),
                                     static_cast<std::size_t>(specimen.tile_spheres));
  return {tiles, std::cbrt(shape.volume() / tiles)};
}

std::string text_of(const Tiling &tiling) {
  if (tiling.tiles == 0) return {};
  return fmt::format(
      "  packing of {:.3g} tiles, the same again every {:.4g} mm along x, y and z: figures scatter "
      "as those of one tile\n",
      tiling.tiles, 1e3 * tiling.period);
}

void check_count(const Scene &scene, const dem::Shape &shape) {
  check_tiles(scene, shape);
  const double radius = scene.specimen.sphere_radius;
  const double room = least_packing_fraction * shape.volume() / (4.0 / 3.0 * pi);
  const double spheres = room / std::pow(radius, 3);
  const auto memory = static_cast<double>(this_machine().memory_bytes);
  const double most = memory > 0 ? std::min(memory / least_bytes, most_spheres) : most_spheres;
  if (spheres <= most) return;
  refuse(scene, "Specimen/Sphere radius",
         fmt::format(
             "is too small: {:.2g} spheres or more fill the specimen. Allowed: {:.2g} m or more, as many as "
             "this machine's memory of {:.3g} GB holds.",
             spheres, std::cbrt(room / most), 1e-9 * memory));
}

namespace {

dem::Specimen place_spheres(const Scene &scene) {
  const SpecimenSection &specimen = scene.specimen;
  if (specimen.packing == PackingKind::file) return read_specimen(scene);
  const dem::Shape shape = specimen_shape(scene);
  check_count(scene, shape);
  if (specimen.packing == PackingKind::advancing_front)
    return dem::advancing_front(shape, radii(specimen), scene.general.seed);
  if (specimen.radius_distribution == RadiusKind::two_sizes)
    refuse(
        scene, "Specimen/Radius distribution",
        "does not go with Specimen/Packing = random close. Allowed: equal, uniform; or Packing = advancing "
        "front.");
  if (tiled(specimen))
    return dem::tiled_close_packing(shape, specimen.sphere_radius, spread_of(specimen),
                                    static_cast<std::size_t>(specimen.tile_spheres), scene.general.seed);
  return dem::random_close_packing(shape, specimen.sphere_radius, spread_of(specimen), scene.general.seed);
}

} // namespace

void require_room(const Scene &scene) {
  if (scene.specimen.packing != PackingKind::file) check_count(scene, specimen_shape(scene));
}

dem::Specimen make_specimen(const Scene &scene) {
  dem::Specimen specimen = place_spheres(scene);
  check_phases(scene, specimen);
  return specimen;
}

dem::Specimen make_bonded_specimen(const Scene &scene, const KeepPacking &keep) {
  const bool packs = scene.specimen.packing != PackingKind::file;
  dem::Specimen specimen = keep && packs ? keep([&] { return place_spheres(scene); }) : place_spheres(scene);
  check_phases(scene, specimen);
  const Gap &gap = scene.model.bond_layout.gap;
  if (scene.bond.bonded() && !gap.relative && gap.value > dem::smallest_radius(specimen))
    refuse(scene, "Bond/Gap",
           "is more than the smallest radius, " + shortest_text(dem::smallest_radius(specimen)) +
               " m: spheres as far apart have others between them. Allowed: up to that.");
  return specimen;
}

} // namespace platen::apps
