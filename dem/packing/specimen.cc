#include "dem/packing/specimen.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "base/pi.h"
#include "base/random.h"
#include "base/shortest_text.h"
#include "dem/packing/point_grid.h"

namespace platen::dem {
namespace {

std::uint64_t hash_of(const Vector3 &place, std::uint64_t seed) {
  for (const double x : {place.x, place.y, place.z}) {
    std::uint64_t word = 0;
    std::memcpy(&word, &x, sizeof word);
    word ^= seed;
    seed = split_mix(word);
  }
  return seed;
}

// Centres closer than this fraction of the smaller radius give no usable direction of contact.
constexpr double coincidence = 1e-9;

bool finite(const Vector3 &v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void require_positive(double value, const char *what) {
  if (!(value > 0) || !std::isfinite(value))
    throw std::invalid_argument(std::string("the ") + what + " of a specimen must be positive and finite");
}

std::string sphere(std::size_t i) {
  return "sphere " + std::to_string(i);
}

// Collects problems; beyond the first few it only counts them.
class ProblemList {
public:
  explicit ProblemList(std::size_t most) : most_(most) {}
  void add(const std::string &text) {
    if (texts_.size() < most_) texts_.push_back(text);
    ++count_;
  }
  bool empty() const { return count_ == 0; }
  std::vector<std::string> texts() const {
    std::vector<std::string> all = texts_;
    if (count_ > texts_.size()) all.push_back("and " + std::to_string(count_ - texts_.size()) + " more");
    return all;
  }

private:
  std::size_t most_, count_ = 0;
  std::vector<std::string> texts_;
};

// m, distance of a point from a notch, negative within it; infinite without one.
double notch_clearance(const Notch &notch, const Vector3 &p) {
  if (!notch.is_there()) return std::numeric_limits<double>::infinity();
  const double outside = std::abs(p.x) - 0.5 * notch.width, above = p.z - notch.depth;
  if (outside < 0 && above < 0) return std::max(outside, above);
  return std::hypot(std::max(outside, 0.0), std::max(above, 0.0));
}

void check_numbers(const Specimen &s, ProblemList &problems) {
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (!finite(s.centre[i])) problems.add(sphere(i) + " has a centre that is not finite");
    if (!std::isfinite(s.radius[i]) || !(s.radius[i] > 0))
      problems.add(sphere(i) + " has radius " + text_of(s.radius[i]) + " m; it must be positive and finite");
  }
}

void check_coincidence(const Specimen &s, ProblemList &problems) {
  const BoundingBox bounds = bounding_box(s);
  const double reach = coincidence * largest_radius(s);
  PointGrid grid(bounds.low, bounds.high, 2 * mean_radius(s), s.size() + 1000);
  for (std::size_t i = 0; i < s.size(); ++i) {
    grid.for_each_near(s.centre[i], reach, [&](int other) {
      const std::size_t j = static_cast<std::size_t>(other);
      if (norm(s.centre[i] - s.centre[j]) < coincidence * std::min(s.radius[i], s.radius[j]))
        problems.add("spheres " + std::to_string(j) + " and " + std::to_string(i) + " have the same centre");
    });
    grid.add(s.centre[i]);
  }
}

void check_walls(const Specimen &s, double tolerance, ProblemList &problems) {
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double outside = s.radius[i] - wall_clearance(s.shape, s.centre[i]);
    if (outside > tolerance)
      problems.add(sphere(i) + " reaches " + text_of(outside) + " m out of the shape (allowed " +
                   text_of(tolerance) + " m)");
  }
}

} // namespace

Shape cylinder(double radius, double height) {
  Shape shape;
  shape.kind = ShapeKind::cylinder;
  shape.radius = radius, shape.height = height;
  return shape;
}

Shape box(double width_x, double width_y, double height) {
  Shape shape;
  shape.kind = ShapeKind::box;
  shape.width_x = width_x, shape.width_y = width_y, shape.height = height;
  return shape;
}

Shape disc(double radius, double thickness) {
  Shape shape = box(2 * radius, thickness, 2 * radius);
  shape.kind = ShapeKind::disc;
  shape.radius = radius;
  return shape;
}

Specimen laid_down(const Specimen &standing) {
  if (standing.shape.kind != ShapeKind::cylinder) return standing;
  Specimen lying = standing;
  lying.shape = disc(standing.shape.radius, standing.shape.height);
  // A quarter turn about x, (x, y, z) to (x, z, -y), and shifts.
  for (Vector3 &c : lying.centre)
    c = {c.x, c.z - 0.5 * standing.shape.height, standing.shape.radius - c.y};
  return lying;
}

Specimen laid_along_x(const Specimen &standing) {
  if (standing.shape.kind != ShapeKind::box) return standing;
  const Shape &was = standing.shape;
  Specimen lying = standing;
  lying.shape = box(was.height, was.width_y, was.width_x);
  // A quarter turn about y, (x, y, z) to (-z, y, x), and shifts.
  for (Vector3 &c : lying.centre)
    c = {0.5 * was.height - c.z, c.y, c.x + 0.5 * was.width_x};
  return lying;
}

Specimen notched(const Specimen &full, const Notch &notch) {
  for (const double length : {notch.depth, notch.width})
    if (!std::isfinite(length) || length < 0)
      throw std::invalid_argument("depth and width of a notch must be finite and not negative");
  if (!notch.is_there()) return full;
  if (full.shape.kind != ShapeKind::box) throw std::invalid_argument("only a box can be notched");
  Specimen cut;
  cut.shape = full.shape;
  cut.shape.notch = notch;
  for (std::size_t i = 0; i < full.size(); ++i) {
    if (notch.holds(full.centre[i])) continue;
    cut.centre.push_back(full.centre[i]);
    cut.radius.push_back(full.radius[i]);
  }
  return cut;
}

double lateral_perimeter(const Shape &shape) {
  return shape.kind == ShapeKind::cylinder ? 2 * pi * shape.radius : 2 * (shape.width_x + shape.width_y);
}

double surface_area(const Shape &shape) {
  if (shape.kind == ShapeKind::disc) return 2 * shape.volume() * (1 / shape.radius + 1 / shape.width_y);
  return lateral_perimeter(shape) * shape.height + 2 * shape.cross_section();
}

double smallest_width(const Shape &shape) {
  const double across =
      shape.kind == ShapeKind::cylinder ? 2 * shape.radius : std::min(shape.width_x, shape.width_y);
  return std::min(across, shape.height);
}

double wall_clearance(const Shape &shape, const Vector3 &p) {
  if (shape.kind == ShapeKind::disc)
    return std::min(shape.radius - std::hypot(p.x, p.z - shape.radius), 0.5 * shape.width_y - std::abs(p.y));
  const double ends = std::min(p.z, shape.height - p.z);
  if (shape.kind == ShapeKind::cylinder)
    return std::min(ends, shape.radius - std::sqrt(p.x * p.x + p.y * p.y));
  const double sides = std::min(0.5 * shape.width_x - std::abs(p.x), 0.5 * shape.width_y - std::abs(p.y));
  return std::min({ends, sides, notch_clearance(shape.notch, p)});
}

Shape scaled(Shape shape, double s) {
  shape.radius *= s, shape.width_x *= s, shape.width_y *= s, shape.height *= s;
  shape.notch.depth *= s, shape.notch.width *= s;
  return shape;
}

Vector3 periods(const Shape &box) {
  return {box.width_x, box.width_y, box.height};
}

Vector3 within(const Shape &box, const Vector3 &point) {
  const Vector3 period = periods(box), low = bounding_box(box).low;
  Vector3 place;
  for (int k = 0; k < 3; ++k)
    place[k] = point[k] - period[k] * std::floor((point[k] - low[k]) / period[k]);
  return place;
}

void require_valid(const Shape &shape) {
  require_positive(shape.height, "height");
  if (shape.kind == ShapeKind::cylinder) {
    require_positive(shape.radius, "radius");
  } else {
    require_positive(shape.width_x, "width along x");
    require_positive(shape.width_y, "width along y");
  }
}

BoundingBox bounding_box(const Shape &shape) {
  const double x = shape.kind == ShapeKind::cylinder ? shape.radius : 0.5 * shape.width_x;
  const double y = shape.kind == ShapeKind::cylinder ? shape.radius : 0.5 * shape.width_y;
  return {{-x, -y, 0}, {x, y, shape.height}};
}

BoundingBox bounding_box(const Specimen &specimen) {
  BoundingBox bounds;
  for (std::size_t i = 0; i < specimen.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const double low = specimen.centre[i][k] - specimen.radius[i],
                   high = specimen.centre[i][k] + specimen.radius[i];
      bounds.low[k] = i == 0 ? low : std::min(bounds.low[k], low);
      bounds.high[k] = i == 0 ? high : std::max(bounds.high[k], high);
    }
  return bounds;
}

double mean_radius(const Specimen &specimen) {
  const double sum = std::accumulate(specimen.radius.begin(), specimen.radius.end(), 0.0);
  return specimen.radius.empty() ? 0.0 : sum / static_cast<double>(specimen.radius.size());
}

double smallest_radius(const Specimen &specimen) {
  return specimen.radius.empty() ? 0.0 : *std::min_element(specimen.radius.begin(), specimen.radius.end());
}

double largest_radius(const Specimen &specimen) {
  return specimen.radius.empty() ? 0.0 : *std::max_element(specimen.radius.begin(), specimen.radius.end());
}

double volume_of_spheres(const Specimen &specimen) {
  double sum = 0;
  for (const double r : specimen.radius)
    sum += r * r * r;
  return 4.0 / 3.0 * pi * sum;
}

std::vector<std::string> check_specimen(const Specimen &specimen, double wall_tolerance,
                                        std::size_t max_problems) {
  ProblemList problems(max_problems);
  if (specimen.radius.size() != specimen.centre.size()) {
    problems.add("there are " + std::to_string(specimen.centre.size()) + " centres but " +
                 std::to_string(specimen.radius.size()) + " radii");
    return problems.texts();
  }
  if (specimen.size() == 0) problems.add("there are no spheres");
  check_numbers(specimen, problems);
  if (!problems.empty()) return problems.texts(); // distances have no meaning with wrong numbers
  check_coincidence(specimen, problems);
  check_walls(specimen, wall_tolerance * mean_radius(specimen), problems);
  return problems.texts();
}

double depth_of_face(EndPreparation form, double height, const Shape &shape, const Vector3 &centre,
                     std::uint64_t seed) {
  const bool round = shape.kind == ShapeKind::cylinder;
  const double half = round ? shape.radius : 0.5 * shape.width_x;
  const double rim =
      round ? half * half : 0.25 * (shape.width_x * shape.width_x + shape.width_y * shape.width_y);
  const double outward = (centre.x * centre.x + centre.y * centre.y) / rim;
  switch (form) {
    case EndPreparation::convex:
      return height * outward;
    case EndPreparation::concave:
      return height * (1 - outward);
    case EndPreparation::not_parallel:
      return height * 0.5 * (1 + centre.x / half);
    case EndPreparation::rough:
      return height * Random(hash_of(centre, seed)).uniform();
    default:
      return 0;
  }
}

SpecimenEnds seat_ends(const Specimen &specimen, EndPreparation preparation, double end_layer) {
  if (!(end_layer >= 0) || !std::isfinite(end_layer))
    throw std::invalid_argument(
        "the end layer of a specimen must be finite and not negative (in mean radii)");
  SpecimenEnds ends;
  if (preparation == EndPreparation::as_packed) return ends;
  const double layer = end_layer * mean_radius(specimen);
  const auto seat = [&](EndSeats &end, std::size_t i, double gap) {
    if (gap > layer) return;
    end.particle.push_back(static_cast<int>(i));
    end.offset.push_back(gap);
  };
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const double z = specimen.centre[i].z, r = specimen.radius[i];
    seat(ends.bottom, i, z - r);
    seat(ends.top, i, specimen.shape.height - z - r);
  }
  return ends;
}

} // namespace platen::dem
