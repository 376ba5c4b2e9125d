#include "dem/measure/solid_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "dem/packing/point_grid.h"

namespace platen::dem {
namespace {

// Lengths in radii of the largest sphere.
constexpr double hole = 1.0;     // of a ball that fits
constexpr double at_ball = 1.3;  // from its middle to the surfaces of spheres next to it
constexpr double searched = 1.5; // from a surface: points further from all belong to no sphere
constexpr double step = 1.0 / 3; // between points
constexpr double most_points = 2e6;
// If fewer spheres are away from holes, each fills a cube, the loosest shape that fills space.
constexpr std::size_t fewest_away = 8;
constexpr double loosest = 8; // volume over r^3

constexpr double inside = 2; // from walls to spheres that these do not order

// For one point: its sphere, -1 for none; its distance from the surface of that sphere, m.
struct Owned {
  int sphere = -1;
  float excess = 0;
};

// Points in the middle of equal cells over the box of the shape, layer by layer along the axis.
class Raster {
public:
  Raster(const Specimen &specimen, int axis, double unit)
      : specimen_(specimen),
        order_{(axis + 1) % 3, (axis + 2) % 3, axis},
        bounds_(bounding_box(specimen.shape)),
        unit_(unit),
        grid_(bounds_.low, bounds_.high, 2 * unit) {
    const Vector3 extent = bounds_.high - bounds_.low;
    const double edge = std::max(step * unit, std::cbrt(extent.x * extent.y * extent.z / most_points));
    for (int k = 0; k < 3; ++k)
      cells_[k] = static_cast<std::size_t>(std::max(1.0, std::ceil(extent[k] / edge - 1e-6)));
    for (const Vector3 &c : specimen.centre)
      grid_.add(c);
    points_.resize(layers() * per_layer());
    at_hole_.resize(layers());
    for_each(
        layers(), [&](std::size_t layer) { fill(layer); }, 1);
  }
  std::size_t layers() const { return cells_[order_[2]]; }
  std::size_t per_layer() const { return cells_[order_[0]] * cells_[order_[1]]; }
  double layer_height() const {
    return (bounds_.high[order_[2]] - bounds_.low[order_[2]]) / static_cast<double>(layers());
  }
  const std::vector<Owned> &points() const { return points_; }
  std::vector<char> at_hole() const { // by sphere
    std::vector<char> marked(specimen_.size(), 0);
    for (const std::vector<int> &spheres : at_hole_)
      for (const int i : spheres)
        marked[i] = 1;
    return marked;
  }

  static constexpr int outside = -2; // of the shape

private:
  double place(int k, std::size_t cell) const {
    const double fraction = (static_cast<double>(cell) + 0.5) / static_cast<double>(cells_[k]);
    return bounds_.low[k] + fraction * (bounds_.high[k] - bounds_.low[k]);
  }
  void fill(std::size_t layer) {
    Owned *to = &points_[layer * per_layer()];
    Vector3 p;
    p[order_[2]] = place(order_[2], layer);
    for (std::size_t b = 0; b < cells_[order_[1]]; ++b) {
      p[order_[1]] = place(order_[1], b);
      for (std::size_t a = 0; a < cells_[order_[0]]; ++a, ++to) {
        p[order_[0]] = place(order_[0], a);
        const double clearance = wall_clearance(specimen_.shape, p);
        if (clearance < 0) {
          to->sphere = outside;
          continue;
        }
        *to = owned(p);
        if (std::min(clearance, static_cast<double>(to->excess)) <= hole * unit_) continue;
        grid_.for_each_near(p, unit_ + at_ball * unit_, [&](int i) {
          if (norm(p - specimen_.centre[i]) - specimen_.radius[i] <= at_ball * unit_)
            at_hole_[layer].push_back(i);
        });
      }
    }
  }
  Owned owned(const Vector3 &p) const {
    Owned found;
    double least = 0;
    const double reach = unit_ + searched * unit_;
    grid_.for_each_near(p, reach, [&](int i) {
      const double r = specimen_.radius[i], square = norm_squared(p - specimen_.centre[i]);
      if (found.sphere >= 0 && square - r * r >= least) return;
      const double excess = std::sqrt(square) - r;
      if (excess > searched * unit_) return;
      found.sphere = i, found.excess = static_cast<float>(excess), least = square - r * r;
    });
    return found;
  }

  const Specimen &specimen_;
  std::array<int, 3> order_;
  BoundingBox bounds_;
  double unit_; // m
  PointGrid grid_;
  std::array<std::size_t, 3> cells_{};
  std::vector<Owned> points_;
  std::vector<std::vector<int>> at_hole_; // by layer of the ball's middle
};

// Points of each sphere at a hole, nearest first.
struct Near {
  float excess = 0;
  std::size_t point = 0;
};

std::vector<double> fractions_of_layers(const Specimen &specimen, const Raster &raster, double unit) {
  const std::vector<Owned> &points = raster.points();
  std::vector<double> part(specimen.size(), 0); // of the space of each sphere, in points
  const std::vector<char> at_hole = raster.at_hole();
  for (const Owned &p : points)
    if (p.sphere >= 0) ++part[p.sphere];
  const double point_volume =
      specimen.shape.volume() /
      static_cast<double>(std::count_if(points.begin(), points.end(),
                                        [](const Owned &p) { return p.sphere != Raster::outside; }));
  const double per_cube = [&] {
    for (const double margin : {inside * unit, 0.0}) {
      double filled = 0, cubes = 0;
      std::size_t away = 0;
      for (std::size_t i = 0; i < specimen.size(); ++i) {
        if (at_hole[i] || wall_clearance(specimen.shape, specimen.centre[i]) < margin) continue;
        const double r = specimen.radius[i];
        filled += part[i], cubes += r * r * r, ++away;
      }
      if (away >= fewest_away) return filled / cubes;
    }
    return loosest / point_volume;
  }();

  std::vector<double> all(raster.layers(), 0), solid(raster.layers(), 0);
  std::vector<std::vector<Near>> near(specimen.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Owned &p = points[k];
    if (p.sphere == Raster::outside) continue;
    const std::size_t layer = k / raster.per_layer();
    ++all[layer];
    if (p.sphere < 0) continue;
    if (at_hole[p.sphere])
      near[p.sphere].push_back({p.excess, k});
    else
      ++solid[layer];
  }
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    std::sort(near[i].begin(), near[i].end(), [](const Near &a, const Near &b) {
      return a.excess < b.excess || (a.excess == b.excess && a.point < b.point);
    });
    const double r = specimen.radius[i];
    double left = per_cube * r * r * r;
    for (std::size_t n = 0; n < near[i].size() && left > 0; ++n, --left)
      solid[near[i][n].point / raster.per_layer()] += std::min(left, 1.0);
  }
  for (std::size_t layer = 0; layer < solid.size(); ++layer)
    solid[layer] = all[layer] > 0 ? solid[layer] / all[layer] : 0;
  return solid;
}

// The part of the shape within the outermost spheres across the axis; the spheres in its frame.
Specimen enveloped(const Specimen &full, int axis) {
  Specimen s = full;
  if (s.shape.kind == ShapeKind::box) {
    const BoundingBox walls = bounding_box(s.shape), spheres = bounding_box(s);
    Vector3 low = walls.low, high = walls.high;
    for (const int k : {(axis + 1) % 3, (axis + 2) % 3})
      low[k] = std::max(low[k], spheres.low[k]), high[k] = std::min(high[k], spheres.high[k]);
    s.shape = box(high.x - low.x, high.y - low.y, high.z - low.z);
    s.shape.notch = {std::max(0.0, full.shape.notch.depth - low.z), full.shape.notch.width};
    for (Vector3 &c : s.centre)
      c -= {0.5 * (low.x + high.x), 0.5 * (low.y + high.y), low.z};
    return s;
  }
  double radius = 0, half = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    radius = std::max(radius, std::hypot(s.centre[i].x, s.centre[i].y) + s.radius[i]);
    half = std::max(half, std::abs(s.centre[i].y) + s.radius[i]);
  }
  if (s.shape.kind == ShapeKind::disc)
    s.shape.width_y = std::min(s.shape.width_y, 2 * half);
  else
    s.shape.radius = std::min(s.shape.radius, radius);
  return s;
}

} // namespace

SolidSection solid_section(const Specimen &full, int axis) {
  SolidSection section;
  if (full.size() == 0) return section;
  const Specimen specimen = enveloped(full, axis);
  const double reached = specimen.shape.volume() / full.shape.volume(); // of the section
  const double unit = largest_radius(specimen);
  const Raster raster(specimen, axis, unit);
  const std::vector<double> fractions = fractions_of_layers(specimen, raster, unit);
  const auto diameter = static_cast<std::size_t>(std::max(1.0, std::round(2 * unit / raster.layer_height())));
  const bool short_one = fractions.size() < 4 * diameter;
  const std::size_t slice = short_one ? fractions.size() : diameter, first = short_one ? 0 : diameter,
                    last = fractions.size() - first - slice;
  double sum = 0;
  for (std::size_t k = first; k <= last; ++k) {
    double fraction = 0;
    for (std::size_t l = k; l < k + slice; ++l)
      fraction += fractions[l];
    fraction *= reached / static_cast<double>(slice);
    sum += fraction;
    section.least = std::isnan(section.least) ? fraction : std::min(section.least, fraction);
    section.largest = std::isnan(section.largest) ? fraction : std::max(section.largest, fraction);
  }
  section.mean = sum / static_cast<double>(last - first + 1);
  return section;
}

} // namespace platen::dem
