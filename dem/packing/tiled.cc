#include "dem/packing/tiled.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/random.h"
#include "dem/packing/decompression.h"
#include "dem/packing/periodic_growth.h"
#include "dem/packing/soft_spheres.h"

namespace platen::dem {
namespace {

// visit(centre, number in the tile) for every sphere of the tiles on the shape; lengths in mean radii.
template <class Visit>
void for_each_of_tiles(const Specimen &tile, const Shape &shape, const Visit &visit) {
  const BoundingBox bounds = bounding_box(shape);
  const double period = tile.shape.height;
  std::array<int, 3> from{}, to{};
  for (int k = 0; k < 3; ++k) {
    from[k] = static_cast<int>(std::floor(bounds.low[k] / period - 0.5));
    to[k] = static_cast<int>(std::ceil(bounds.high[k] / period + 0.5));
  }
  for (int z = from[2]; z <= to[2]; ++z)
    for (int y = from[1]; y <= to[1]; ++y)
      for (int x = from[0]; x <= to[0]; ++x) {
        const Vector3 at{x * period, y * period, z * period};
        for (std::size_t i = 0; i < tile.size(); ++i)
          visit(tile.centre[i] + at, i);
      }
}

void require_tiles(const Shape &shape, double mean_radius, double spread, std::size_t tile_spheres) {
  require_valid(shape);
  if (shape.kind == ShapeKind::disc)
    throw std::invalid_argument("tiles fill a cylinder or a box; a disc is a cylinder laid down");
  if (!(mean_radius > 0) || !std::isfinite(mean_radius))
    throw std::invalid_argument("the sphere radius of a packing must be positive and finite");
  const double tiles = tiles_in(shape, mean_radius, spread, tile_spheres);
  if (!(tiles >= fewest_tiles))
    throw std::invalid_argument("the specimen holds " + std::to_string(tiles) +
                                " tiles; a packing of tiles needs two or more");
  if (tiles * static_cast<double>(tile_spheres) > static_cast<double>(most_tiled_spheres))
    throw std::invalid_argument("the packing would need more than " + std::to_string(most_tiled_spheres) +
                                " spheres");
}

} // namespace

double tiles_in(const Shape &shape, double mean_radius, double spread, std::size_t tile_spheres) {
  return bulk_fraction * shape.volume() /
         (sphere_volume(mean_radius) * mean_cube(spread) * static_cast<double>(tile_spheres));
}

Specimen tiled_close_packing(const Shape &shape, double mean, double spread, std::size_t tile_spheres,
                             std::uint64_t seed, TilingReport *report, double at_rest) {
  require_tiles(shape, mean, spread, tile_spheres);
  if (!(at_rest > 0) || !(at_rest <= 0.1))
    throw std::invalid_argument("the residual force at which a packing is at rest must lie in (0, 0.1]");
  TilingReport made;
  Random random(seed);
  Specimen tile = periodic_close_packing(box(1, 1, 1), tile_spheres, spread, random.next(), &made.tile);
  const double to_mean_radii = 1 / made.tile.mean_radius;
  tile.shape = scaled(tile.shape, to_mean_radii);
  for (std::size_t i = 0; i < tile.size(); ++i)
    tile.centre[i] *= to_mean_radii, tile.radius[i] *= to_mean_radii;
  const Shape unit = scaled(shape, 1 / mean);
  std::vector<Vector3> centre;
  std::vector<double> factor;
  for_each_of_tiles(tile, unit, [&](const Vector3 &at, std::size_t i) {
    if (wall_clearance(unit, at) > wall_loss) centre.push_back(at), factor.push_back(tile.radius[i]);
  });
  SoftSpheres soft({unit, false}, centre, std::move(factor));
  soft.set_scale(overfull_scale());
  decompress(soft, random, made.specimen, at_rest);
  Specimen specimen;
  specimen.shape = shape;
  specimen.centre = soft.centres();
  for (Vector3 &c : specimen.centre)
    c *= mean;
  for (const double f : soft.factor())
    specimen.radius.push_back(mean * soft.scale() * f);
  made.specimen.spheres = specimen.size();
  made.specimen.attempts = 1;
  made.specimen.mean_radius = mean_radius(specimen);
  made.specimen.packing_fraction = volume_of_spheres(specimen) / shape.volume();
  made.period = mean * tile.shape.height;
  made.tiles = shape.volume() / (made.period * made.period * made.period);
  if (report) *report = made;
  return specimen;
}

} // namespace platen::dem
