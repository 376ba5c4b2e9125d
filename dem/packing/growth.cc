#include "dem/packing/growth.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/pi.h"
#include "base/random.h"
#include "dem/packing/soft_spheres.h"

namespace platen::dem {

namespace {

// Packing fraction of a large jammed packing, and its loss at walls in units of mean radius times surface
// over volume: fitted to this program's own packings, used only to guess the number of spheres.
constexpr double bulk_fraction = 0.6465, wall_loss = 0.29;
// The first state at rest is over-full by this fraction; low enough to stay amorphous, high enough to be
// solid.
constexpr double overfill = 0.03;
constexpr double final_overlap = 5e-5; // mean, in mean radii: contacts are known, positions are not strained
constexpr double overlap_step = 0.4;   // each stage aims at this part of the last mean overlap
// Residual force over mean contact force at which a stage is at rest. Looser stages overshoot: the system
// still creeps towards denser states, and the last stage then takes far longer.
constexpr double at_rest = 4e-3;
constexpr double seating_force = 0.1; // on loose spheres, in mean contact forces: too weak to move the others
constexpr double first_back = 2e-4; // relative growth after shrinking too far; doubled while it does not help
constexpr double flattest = 0.5, steepest = 4.0; // bounds of the slope of mean overlap over relative size
constexpr int most_stages = 200, most_attempts = 4;
constexpr long most_iterations = 200000; // of one stage
constexpr double radius_tolerance = 0.008;
constexpr std::size_t most_spheres = 5000000;

void require_sensible(const Shape &shape, double mean_radius, double spread) {
  require_valid(shape);
  if (!(spread >= 0) || !(spread <= 1.9))
    throw std::invalid_argument("the radius spread of a packing must lie in [0, 1.9]");
  if (!(mean_radius > 0) || !std::isfinite(mean_radius))
    throw std::invalid_argument("the sphere radius of a packing must be positive and finite");
  if (2 * mean_radius * (1 + 0.5 * spread) > smallest_width(shape))
    throw std::invalid_argument("the largest sphere of the packing is wider than the shape");
}

// Mean of factor^3 for factors even between 1 - spread/2 and 1 + spread/2.
double mean_cube(double spread) {
  return 1 + 0.25 * spread * spread;
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
  for (int k = 0; k < 20; ++k) // the wall loss depends on the radius weakly: a fixed point
    radius = std::cbrt(guessed_fraction(shape, radius) * shape.volume() /
                       (4.0 / 3.0 * pi * mean_cube(spread) * static_cast<double>(spheres)));
  return std::min(radius, 0.5 * smallest_width(shape) / (1 + 0.5 * spread));
}

// One radius from each of n equal slices of the distribution, in random order: the mean is exact for any
// seed.
std::vector<double> radius_factors(std::size_t n, double spread, Random &random) {
  std::vector<double> factor(n);
  for (std::size_t i = 0; i < n; ++i)
    factor[i] = 1 + spread * ((static_cast<double>(i) + 0.5) / static_cast<double>(n) - 0.5);
  random.shuffle(factor);
  return factor;
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

Shape scaled(Shape shape, double s) {
  shape.radius *= s, shape.width_x *= s, shape.width_y *= s, shape.height *= s;
  return shape;
}

// Shrinks an over-full system at rest until its mean overlap is final_overlap, then seats the loose spheres.
// Returns the number of stages and adds to the iterations.
int decompress(SoftSpheres &spheres, Random &random, GrowthReport &made) {
  double slope = 1.8; // mean overlap lost per relative loss of size; measured as soon as two stages are known
  double last_scale = 0, last_overlap = 0;
  double target = 0, back = first_back;
  for (int stage = 1; stage <= most_stages; ++stage) {
    const bool last = target > 0 && target <= final_overlap;
    made.iterations += spheres.relax(at_rest, 1e-3 * final_overlap, most_iterations);
    const Overlaps state = spheres.overlaps();
    const double scale = spheres.scale(), overlap = state.mean / scale;
    if (overlap < 0.05 * final_overlap) { // shrunk too far: nothing is pressed any more
      spheres.set_scale(scale * (1 + back));
      back *= 2, target = 0, last_overlap = 0;
      slope = std::min(1.25 * slope, steepest);
      continue;
    }
    back = first_back;
    if (last && overlap <= 1.5 * final_overlap) {
      made.loose_spheres = spheres.press_loose_spheres(seating_force * overlap, random);
      made.iterations += spheres.relax(at_rest, 0, most_iterations);
      return stage;
    }
    if (last_overlap > 1.5 * overlap && last_scale > scale)
      slope = std::clamp((last_overlap - overlap) / (1 - scale / last_scale), flattest, steepest);
    target = std::max(overlap_step * overlap, final_overlap);
    if (overlap <= 1.5 * final_overlap) target = final_overlap;
    last_scale = scale, last_overlap = overlap;
    spheres.set_scale(scale * (1 - std::max(0.0, overlap - target) / slope));
  }
  throw std::runtime_error("the sphere packing did not jam");
}

} // namespace

Specimen random_close_packing_of(const Shape &shape, std::size_t spheres, double spread, std::uint64_t seed,
                                 GrowthReport *report) {
  require_valid(shape);
  if (spheres == 0 || spheres > most_spheres)
    throw std::invalid_argument("the number of spheres of a packing must lie in [1, " +
                                std::to_string(most_spheres) + "]");
  const double guess = guessed_radius(shape, spheres, spread);
  require_sensible(shape, guess, spread);
  Random random(seed);
  std::vector<double> factor = radius_factors(spheres, spread, random);
  const Shape unit = scaled(shape, 1 / guess); // lengths in mean radii
  std::vector<Vector3> centre = random_centres(unit, factor, random);
  SoftSpheres soft(unit, std::move(centre), std::move(factor));
  soft.set_scale(std::cbrt(1 + overfill / bulk_fraction));
  GrowthReport made;
  made.stages = decompress(soft, random, made);

  Specimen specimen;
  specimen.shape = shape;
  for (std::size_t i = 0; i < spheres; ++i) {
    specimen.centre.push_back(guess * soft.centre()[i]);
    specimen.radius.push_back(guess * soft.scale() * soft.factor()[i]);
  }
  const Overlaps state = soft.overlaps();
  made.spheres = spheres;
  made.attempts = 1;
  made.mean_radius = mean_radius(specimen);
  made.packing_fraction = volume_of_spheres(specimen) / shape.volume();
  made.contacts_per_sphere = 2.0 * static_cast<double>(state.pairs) / static_cast<double>(spheres);
  made.mean_overlap = state.mean / soft.scale(), made.max_overlap = state.max / soft.scale();
  made.residual_force = state.mean > 0 ? state.residual_force / state.mean : 0;
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
