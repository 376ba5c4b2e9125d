#include "dem/packing/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/pi.h"
#include "dem/cell_grid.h"

namespace platen::dem {
namespace {

// Eight Gauss-Legendre points on [-1, 1] (Abramowitz and Stegun, table 25.4), used on several equal pieces
// because a cut sphere's slices have kinks.
constexpr double gauss_point[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                   0.9602898564975363};
constexpr double gauss_weight[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                    0.1012285362903763};
constexpr int pieces = 3;

template <class Function>
double integral(double from, double to, const Function &f) {
  const double half = 0.5 * (to - from) / pieces;
  double sum = 0;
  for (int piece = 0; piece < pieces; ++piece) {
    const double middle = from + (2 * piece + 1) * half;
    for (int k = 0; k < 4; ++k)
      sum += gauss_weight[k] * (f(middle - half * gauss_point[k]) + f(middle + half * gauss_point[k]));
  }
  return half * sum;
}

// Common area (m^2) of two discs of radii a and b; d is the distance of their centres, m.
double common_area_of_discs(double a, double b, double d) {
  const double small = std::min(a, b);
  if (d <= std::abs(a - b)) return pi * small * small;
  if (d >= a + b) return 0;
  const double angle_a = std::acos(std::clamp((d * d + a * a - b * b) / (2 * d * a), -1.0, 1.0));
  const double angle_b = std::acos(std::clamp((d * d + b * b - a * a) / (2 * d * b), -1.0, 1.0));
  return a * a * (angle_a - 0.5 * std::sin(2 * angle_a)) + b * b * (angle_b - 0.5 * std::sin(2 * angle_b));
}

// Part of a disc inside the rectangle [-half_x, half_x] x [-half_y, half_y].
double area_in_rectangle(double x, double y, double r, double half_x, double half_y) {
  const bool inside = std::abs(x) + r <= half_x && std::abs(y) + r <= half_y;
  if (inside) return pi * r * r;
  // Along the angle t with x' = x + r sin t the chord r cos t is smooth up to both ends.
  const double low = std::max((-half_x - x) / r, -1.0), high = std::min((half_x - x) / r, 1.0);
  if (low >= high) return 0;
  return integral(std::asin(low), std::asin(high), [&](double t) {
    const double half_chord = r * std::cos(t);
    return r * std::cos(t) *
           std::max(0.0, std::min(y + half_chord, half_y) - std::max(y - half_chord, -half_y));
  });
}

// Radius of the slice whose rim just touches the side wall, for a centre inside or outside.
double clearance_of_side(const Shape &shape, const Vector3 &c, double from_axis) {
  if (shape.kind == ShapeKind::cylinder) return std::abs(shape.radius - from_axis);
  return std::min(std::abs(0.5 * shape.width_x - std::abs(c.x)),
                  std::abs(0.5 * shape.width_y - std::abs(c.y)));
}

constexpr int contacts_that_hold = 4; // a frictionless sphere needs four to be at rest in space

// The shape of the core: every wall and end moved inwards by margin (m); dimensions <= 0 if nothing remains.
// Its z axis starts at 0 like that of every shape: shift centres by -margin along z to use it.
Shape core_of(const Shape &shape, double margin) {
  Shape core = shape;
  core.height -= 2 * margin;
  if (shape.kind == ShapeKind::cylinder) core.radius -= margin;
  if (shape.kind == ShapeKind::box) core.width_x -= 2 * margin, core.width_y -= 2 * margin;
  return core;
}

bool has_core(const Shape &core) {
  return smallest_width(core) > 0;
}

void judge_contacts(const Specimen &s, const QualityMeasure &measure, PackingQuality &quality) {
  const double tolerance = measure.gap_tolerance * quality.mean_radius;
  const double margin = measure.core_margin * quality.mean_radius;
  const bool core = has_core(core_of(s.shape, margin));
  const auto in_core = [&](const Vector3 &p) { return wall_clearance(s.shape, p) >= margin; };
  std::vector<int> contacts(s.size());
  std::vector<Vector3> axes;
  std::size_t overlapping = 0, core_ends = 0;
  for (const TouchingPair &pair : touching_pairs(s, tolerance)) {
    const int i = pair.first, j = pair.second;
    ++quality.contacts, ++contacts[i], ++contacts[j];
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
    if (wall_clearance(s.shape, s.centre[i]) - s.radius[i] <= tolerance) ++contacts[i];
    if (contacts[i] < contacts_that_hold) ++quality.rattlers;
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

double clipped_volume(const Vector3 &c, double r, const Shape &shape) {
  const double clearance = wall_clearance(shape, c);
  if (clearance >= r) return sphere_volume(r);
  if (clearance <= -r) return 0;
  const double low = std::max(-c.z / r, -1.0), high = std::min((shape.height - c.z) / r, 1.0);
  if (low >= high) return 0;
  const double from_axis = std::sqrt(c.x * c.x + c.y * c.y);
  const auto slice = [&](double t) { // at the height r sin t, where the slice is a disc of radius r cos t
    const double disc = r * std::cos(t);
    return disc * (shape.kind == ShapeKind::cylinder
                       ? common_area_of_discs(disc, shape.radius, from_axis)
                       : area_in_rectangle(c.x, c.y, disc, 0.5 * shape.width_x, 0.5 * shape.width_y));
  };
  // The slices have a kink where their rim first touches the wall; no piece of the integral crosses it.
  const double kink = std::acos(std::clamp(clearance_of_side(shape, c, from_axis) / r, 0.0, 1.0));
  const double start = std::asin(low), end = std::asin(high);
  const double first = std::clamp(-kink, start, end), second = std::clamp(kink, start, end);
  return integral(start, first, slice) + integral(first, second, slice) + integral(second, end, slice);
}

std::vector<TouchingPair> touching_pairs(const Specimen &s, double gap) {
  // Slightly wider than the gap, so that the test below alone decides.
  const double margin = gap + 1e-9 * (gap + largest_radius(s));
  std::vector<TouchingPair> pairs;
  for (const auto &[i, j] : near_pairs(s.centre.data(), s.radius.data(), s.size(), margin)) {
    const double between = norm(s.centre[j] - s.centre[i]) - s.radius[j] - s.radius[i];
    if (between <= gap) pairs.push_back({i, j, between});
  }
  return pairs;
}

PackingQuality judge_packing(const Specimen &specimen, const QualityMeasure &measure) {
  if (!(measure.gap_tolerance >= 0) || !(measure.core_margin >= 0))
    throw std::invalid_argument("the gap tolerance and the core margin of a packing must not be negative");
  require_valid(specimen.shape);
  const std::vector<std::string> problems = check_specimen(specimen, std::numeric_limits<double>::infinity(),
                                                           1); // walls and overlaps are measured, not refused
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
