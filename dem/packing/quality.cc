#include "dem/packing/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

#include "base/pi.h"
#include "dem/packing/point_grid.h"
#include "dem/packing/sphere_clipping.h"

namespace platen::dem {

namespace {

constexpr int contacts_that_hold = 4; // a frictionless sphere needs four to be at rest in space

bool has_core(const Shape &core) {
  return smallest_width(core) > 0;
}

void judge_contacts(const Specimen &s, const QualityMeasure &measure, PackingQuality &quality) {
  const double tolerance = measure.gap_tolerance * quality.mean_radius;
  const double margin = measure.core_margin * quality.mean_radius;
  const bool core = has_core(core_of(s.shape, margin));
  const auto in_core = [&](const Vector3 &p) { return wall_clearance(s.shape, p) >= margin; };
  std::vector<int> held(s.size());
  std::vector<Vector3> axes;
  std::size_t overlapping = 0, core_ends = 0;
  for (const TouchingPair &pair : touching_pairs(s, tolerance)) {
    const std::size_t i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
    ++quality.contacts, ++held[i], ++held[j];
    core_ends += (in_core(s.centre[i]) ? 1 : 0) + (in_core(s.centre[j]) ? 1 : 0);
    if (!core || in_core(0.5 * (s.centre[i] + s.centre[j]))) axes.push_back(s.centre[j] - s.centre[i]);
    if (pair.gap >= 0) continue;
    ++overlapping;
    quality.mean_overlap -= pair.gap;
    quality.max_overlap = std::max(quality.max_overlap, -pair.gap / quality.mean_radius);
  }
  if (overlapping > 0) quality.mean_overlap /= static_cast<double>(overlapping) * quality.mean_radius;
  quality.coordination_number = 2.0 * static_cast<double>(quality.contacts) / static_cast<double>(s.size());
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (core && in_core(s.centre[i])) ++quality.core_spheres;
    if (wall_clearance(s.shape, s.centre[i]) - s.radius[i] <= tolerance) ++held[i];
    if (held[i] < contacts_that_hold) ++quality.rattlers;
  }
  quality.core_coordination_number =
      quality.core_spheres > 0 ? static_cast<double>(core_ends) / static_cast<double>(quality.core_spheres)
                               : std::numeric_limits<double>::quiet_NaN();
  quality.directions = count_axes(axes);
  quality.isotropy_chi_squared = isotropy_chi_squared(quality.directions);
}

void judge_walls(const Specimen &s, const QualityMeasure &measure, PackingQuality &quality) {
  const double tolerance = measure.gap_tolerance * quality.mean_radius, section = s.shape.cross_section();
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double z = s.centre[i].z, r = s.radius[i], circle = pi * r * r / section;
    const double outside = r - wall_clearance(s.shape, s.centre[i]);
    quality.max_wall_overlap = std::max(quality.max_wall_overlap, outside / quality.mean_radius);
    if (z - r <= tolerance) ++quality.touching_bottom, quality.cover_bottom += circle;
    if (s.shape.height - z - r <= tolerance) ++quality.touching_top, quality.cover_top += circle;
  }
}

double core_fraction(const Specimen &s, double margin) {
  const Shape core = core_of(s.shape, margin);
  if (!has_core(core)) return std::numeric_limits<double>::quiet_NaN();
  double volume = 0;
  for (std::size_t i = 0; i < s.size(); ++i)
    volume += clipped_volume(s.centre[i] - Vector3{0, 0, margin}, s.radius[i], core);
  return volume / core.volume();
}

} // namespace

std::vector<TouchingPair> touching_pairs(const Specimen &s, double gap) {
  const BoundingBox bounds = bounding_box(s);
  const double largest = largest_radius(s);
  PointGrid grid(bounds.low, bounds.high, 2 * largest + gap, 4 * s.size() + 1000);
  std::vector<TouchingPair> pairs;
  for (std::size_t i = 0; i < s.size(); ++i) {
    grid.for_each_near(s.centre[i], s.radius[i] + largest + gap, [&](int other) {
      const std::size_t j = static_cast<std::size_t>(other);
      const double between = norm(s.centre[i] - s.centre[j]) - s.radius[i] - s.radius[j];
      if (between <= gap) pairs.push_back({other, static_cast<int>(i), between});
    });
    grid.add(s.centre[i]);
  }
  std::sort(pairs.begin(), pairs.end(), [](const TouchingPair &a, const TouchingPair &b) {
    return std::tie(a.first, a.second) < std::tie(b.first, b.second);
  });
  return pairs;
}

Shape core_of(const Shape &shape, double margin) {
  Shape core = shape;
  core.height -= 2 * margin;
  if (shape.kind == ShapeKind::cylinder) core.radius -= margin;
  if (shape.kind == ShapeKind::box) core.width_x -= 2 * margin, core.width_y -= 2 * margin;
  return core;
}

PackingQuality judge_packing(const Specimen &specimen, const QualityMeasure &measure) {
  if (!(measure.gap_tolerance >= 0) || !(measure.core_margin >= 0))
    throw std::invalid_argument("the gap tolerance and the core margin of a packing must not be negative");
  require_valid(specimen.shape);
  const std::vector<std::string> problems = check_specimen(specimen, std::numeric_limits<double>::infinity(),
                                                           1); // walls and overlaps are judged, not refused
  if (!problems.empty()) throw std::invalid_argument("the packing cannot be judged: " + problems.front());
  PackingQuality quality;
  quality.spheres = specimen.size();
  quality.mean_radius = mean_radius(specimen);
  quality.packing_fraction = volume_of_spheres(specimen) / specimen.shape.volume();
  quality.core_packing_fraction = core_fraction(specimen, measure.core_margin * quality.mean_radius);
  judge_contacts(specimen, measure, quality);
  judge_walls(specimen, measure, quality);
  return quality;
}

} // namespace platen::dem
