#include "dem/packing/periodic_growth.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/random.h"
#include "dem/packing/decompression.h"
#include "dem/packing/soft_spheres.h"

namespace platen::dem {
namespace {

void require_box(const Shape &box, std::size_t spheres) {
  require_valid(box);
  if (box.kind != ShapeKind::box) throw std::invalid_argument("a packing that repeats itself needs a box");
  const Vector3 period = periods(box);
  if (2 * smallest_width(box) < std::max({period.x, period.y, period.z}))
    throw std::invalid_argument("no edge of a box that repeats itself may be under half of the longest");
  if (spheres < fewest_periodic_spheres || spheres > most_periodic_spheres)
    throw std::invalid_argument("the number of spheres of a packing that repeats itself must lie in [" +
                                std::to_string(fewest_periodic_spheres) + ", " +
                                std::to_string(most_periodic_spheres) + "]");
}

} // namespace

Specimen periodic_close_packing_from(const Shape &box, const std::vector<Vector3> &places,
                                     const std::vector<double> &factors, std::uint64_t seed,
                                     GrowthReport *report) {
  require_box(box, places.size());
  double cubes = 0;
  for (const double f : factors)
    cubes += f * f * f;
  const double guess = std::cbrt(bulk_fraction * box.volume() / (sphere_volume(1) * cubes));
  const Shape unit = scaled(box, 1 / guess); // lengths in mean radii
  std::vector<Vector3> centre;
  for (const Vector3 &p : places)
    centre.push_back(within(unit, (1 / guess) * p));
  SoftSpheres soft({unit, true}, centre, factors);
  soft.set_scale(overfull_scale());
  Random random(seed);
  GrowthReport made;
  decompress(soft, random, made);

  Specimen packing;
  packing.shape = box;
  for (const Vector3 &c : soft.centres())
    packing.centre.push_back(guess * c);
  for (const double f : soft.factor())
    packing.radius.push_back(guess * soft.scale() * f);
  made.spheres = packing.size();
  made.attempts = 1;
  made.mean_radius = mean_radius(packing);
  made.packing_fraction = volume_of_spheres(packing) / box.volume();
  if (report) *report = made;
  return packing;
}

Specimen periodic_close_packing(const Shape &box, std::size_t spheres, double spread, std::uint64_t seed,
                                GrowthReport *report) {
  require_box(box, spheres);
  if (!(spread >= 0) || !(spread <= 1.9))
    throw std::invalid_argument("the radius spread of a packing must lie in [0, 1.9]");
  Random random(seed);
  const std::vector<double> factors = radius_factors(spheres, spread, random);
  const BoundingBox bounds = bounding_box(box);
  std::vector<Vector3> places(spheres);
  for (Vector3 &p : places)
    for (int k = 0; k < 3; ++k)
      p[k] = random.uniform(bounds.low[k], bounds.high[k]);
  return periodic_close_packing_from(box, places, factors, random.next(), report);
}

} // namespace platen::dem
