#include "dem/packing/growth.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/pi.h"
#include "base/random.h"
#include "dem/packing/decompression.h"
#include "dem/packing/soft_spheres.h"

namespace platen::dem {

namespace {

constexpr int most_attempts = 4;
constexpr double radius_tolerance = 0.008;
constexpr std::size_t most_spheres = 5000000;

void require_sensible(const Shape &shape, double mean_radius, double spread) {
  require_valid(shape);
  if (shape.kind == ShapeKind::disc)
    throw std::invalid_argument("a disc is packed as the cylinder that it is once it stands");
  if (!(spread >= 0) || !(spread <= 1.9))
    throw std::invalid_argument("the radius spread of a packing must lie in [0, 1.9]");
  if (!(mean_radius > 0) || !std::isfinite(mean_radius))
    throw std::invalid_argument("the sphere radius of a packing must be positive and finite");
  if (2 * mean_radius * (1 + 0.5 * spread) > smallest_width(shape))
    throw std::invalid_argument("the largest sphere of the packing is wider than the shape");
}

double guessed_fraction(const Shape &shape, double mean_radius) {
  const double loss = wall_loss * mean_radius * surface_area(shape) / shape.volume();
  return bulk_fraction * std::max(0.5, 1 - loss);
}

std::size_t guessed_number(const Shape &shape, double mean_radius, double spread) {
  const double one = sphere_volume(mean_radius) * mean_cube(spread);
  const double n = std::round(guessed_fraction(shape, mean_radius) * shape.volume() / one);
  if (n > static_cast<double>(most_spheres))
    throw std::invalid_argument("the packing would need more than " + std::to_string(most_spheres) +
                                " spheres");
  return static_cast<std::size_t>(std::max(1.0, n));
}

double guessed_radius(const Shape &shape, std::size_t spheres, double spread) {
  double radius = 0;
  for (int k = 0; k < 20; ++k) // the wall loss depends only weakly on the radius: a fixed point
    radius = std::cbrt(guessed_fraction(shape, radius) * shape.volume() /
                       (4.0 / 3.0 * pi * mean_cube(spread) * static_cast<double>(spheres)));
  return std::min(radius, 0.5 * smallest_width(shape) / (1 + 0.5 * spread));
}

std::vector<Vector3> random_centres(const Shape &shape, const std::vector<double> &radius, Random &random) {
  const BoundingBox bounds = bounding_box(shape);
  std::vector<Vector3> centre(radius.size());
  for (std::size_t i = 0; i < centre.size(); ++i)
    do
      for (int k = 0; k < 3; ++k)
        centre[i][k] = random.uniform(bounds.low[k] + radius[i], bounds.high[k] - radius[i]);
    while (wall_clearance(shape, centre[i]) < radius[i] * (1 - 1e-12));
  return centre;
}

} // namespace

Specimen random_close_packing_of(const Shape &shape, std::size_t spheres, double spread, std::uint64_t seed,
                                 GrowthReport *report) {
  require_sensible(shape, 0.25 * smallest_width(shape), spread); // before the radius is estimated
  if (spheres == 0 || spheres > most_spheres)
    throw std::invalid_argument("the number of spheres of a packing must lie in [1, " +
                                std::to_string(most_spheres) + "]");
  const double guess = guessed_radius(shape, spheres, spread);
  require_sensible(shape, guess, spread);
  Random random(seed);
  std::vector<double> factor = radius_factors(spheres, spread, random);
  const Shape unit = scaled(shape, 1 / guess); // lengths in mean radii
  const std::vector<Vector3> centre = random_centres(unit, factor, random);
  SoftSpheres soft({unit, false}, centre, std::move(factor));
  soft.set_scale(overfull_scale());
  GrowthReport made;
  decompress(soft, random, made);

  Specimen specimen;
  specimen.shape = shape;
  const std::vector<Vector3> places = soft.centres();
  for (std::size_t i = 0; i < spheres; ++i) {
    specimen.centre.push_back(guess * places[i]);
    specimen.radius.push_back(guess * soft.scale() * soft.factor()[i]);
  }
  made.spheres = spheres;
  made.attempts = 1;
  made.mean_radius = mean_radius(specimen);
  made.packing_fraction = volume_of_spheres(specimen) / shape.volume();
  if (report) *report = made;
  return specimen;
}

Specimen random_close_packing(const Shape &shape, double mean_radius, double spread, std::uint64_t seed,
                              GrowthReport *report) {
  require_sensible(shape, mean_radius, spread);
  std::size_t n = guessed_number(shape, mean_radius, spread);
  long iterations = 0;
  Specimen best;
  GrowthReport best_report;
  double best_error = 0;
  int attempts = 0;
  while (attempts < most_attempts) {
    GrowthReport made;
    Specimen specimen = random_close_packing_of(shape, n, spread, seed, &made);
    ++attempts;
    iterations += made.iterations;
    const double ratio = made.mean_radius / mean_radius, error = std::abs(ratio - 1);
    if (attempts == 1 || error < best_error)
      best = std::move(specimen), best_report = made, best_error = error;
    if (best_error <= radius_tolerance) break;
    const double better = std::max(1.0, std::round(static_cast<double>(n) * ratio * ratio * ratio));
    if (static_cast<std::size_t>(better) == n) break; // whole numbers allow no better
    n = static_cast<std::size_t>(better);
  }
  best_report.attempts = attempts, best_report.iterations = iterations;
  if (report) *report = best_report;
  return best;
}

} // namespace platen::dem
