#include "coupling/platen_cover.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace platen::coupling {
namespace {

using Point = std::array<double, 2>;

// Points along each width of the end: the error of a rectangle's fraction is a part of its rim.
constexpr int points_across = 512;
// Faces count whose normal is within 60 degrees of the direction to the specimen.
constexpr double least_cosine = 0.5;

// Twice the area of a, b, p, positive for a left turn.
double turn(const Point &a, const Point &b, const Point &p) {
  return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

// A face of the platen, projected on the end.
struct Outline {
  std::array<Point, 4> corners;
  Point low, high;

  bool holds(const Point &p) const {
    if (p[0] < low[0] || p[0] > high[0] || p[1] < low[1] || p[1] > high[1]) return false;
    bool left = true, right = true; // of all edges; outlines have either orientation
    for (std::size_t k = 0; k < 4; ++k) {
      const double side = turn(corners[k], corners[(k + 1) % 4], p);
      left = left && side >= 0;
      right = right && side <= 0;
    }
    return left || right;
  }
};

Outline rectangle(const Point &low, const Point &high) {
  return {{Point{low[0], low[1]}, Point{high[0], low[1]}, Point{high[0], high[1]}, Point{low[0], high[1]}},
          low,
          high};
}

std::vector<Outline> outlines_of(const fem::SurfaceMesh &surface, Side side, double plane, double depth) {
  const int axis = axis_of(side);
  const Vector3 towards = inward(side);
  std::vector<Outline> outlines;
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const Vector3 area = fem::face_area_vector(surface, f);
    if (!(dot(area, towards) > least_cosine * norm(area))) continue;
    Outline outline;
    bool near = false;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector3 &x = surface.vertices[static_cast<std::size_t>(surface.faces[f][k])];
      outline.corners[k] = {x[(axis + 1) % 3], x[(axis + 2) % 3]};
      near = near || std::abs(x[axis] - plane) <= depth;
    }
    if (!near) continue;
    outline.low = outline.high = outline.corners[0];
    for (const Point &corner : outline.corners)
      for (const std::size_t k : {0, 1}) {
        outline.low[k] = std::min(outline.low[k], corner[k]);
        outline.high[k] = std::max(outline.high[k], corner[k]);
      }
    outlines.push_back(outline);
  }
  return outlines;
}

// Middles of the cells of a grid over the end of the specimen.
class PointsOfEnd {
public:
  PointsOfEnd(const dem::Shape &shape, int axis)
      : radius_(shape.kind == dem::ShapeKind::cylinder ? shape.radius : 0),
        width_{width_of_end(shape, (axis + 1) % 3), width_of_end(shape, (axis + 2) % 3)},
        low_{lowest(shape, (axis + 1) % 3), lowest(shape, (axis + 2) % 3)} {}

  // Fraction of the end's points that lie in any of these outlines.
  double fraction_in(const std::vector<Outline> &outlines) const {
    std::vector<char> inside(static_cast<std::size_t>(points_across) * points_across, 0);
    for (const Outline &outline : outlines)
      for (int i = first(outline.low[0], 0); i <= last(outline.high[0], 0); ++i)
        for (int j = first(outline.low[1], 1); j <= last(outline.high[1], 1); ++j)
          if (outline.holds(point(i, j))) inside[static_cast<std::size_t>(i) * points_across + j] = 1;
    double of_all = 0, count = 0;
    for (int i = 0; i < points_across; ++i)
      for (int j = 0; j < points_across; ++j) {
        const Point p = point(i, j);
        if (radius_ > 0 && std::hypot(p[0], p[1]) > radius_) continue;
        ++of_all;
        count += inside[static_cast<std::size_t>(i) * points_across + j];
      }
    return count / of_all;
  }

private:
  static double lowest(const dem::Shape &shape, int axis) {
    return shape.kind == dem::ShapeKind::cylinder && axis != 2 ? -shape.radius : extent(shape, axis)[0];
  }
  Point point(int i, int j) const {
    return {low_[0] + width_[0] * (i + 0.5) / points_across, low_[1] + width_[1] * (j + 0.5) / points_across};
  }
  // Cells that a range may touch.
  int first(double x, std::size_t k) const {
    return static_cast<int>(
        std::clamp((x - low_[k]) / width_[k] * points_across - 1, 0.0, 1.0 * points_across));
  }
  int last(double x, std::size_t k) const {
    return static_cast<int>(
        std::clamp((x - low_[k]) / width_[k] * points_across + 1, -1.0, points_across - 1.0));
  }

  double radius_; // m; 0: a rectangle
  Point width_, low_;
};

} // namespace

PlatenCover cover_of(const dem::Shape &shape, const fem::SurfaceMesh &surface, Side side, double plane,
                     double depth, double edge) {
  PlatenCover cover;
  const std::vector<Outline> outlines = outlines_of(surface, side, plane, depth);
  if (outlines.empty()) return cover;
  constexpr double most = std::numeric_limits<double>::infinity();
  Point low{most, most}, high{-most, -most};
  for (const Outline &outline : outlines)
    for (const std::size_t k : {0, 1}) {
      low[k] = std::min(low[k], outline.low[k]);
      high[k] = std::max(high[k], outline.high[k]);
    }
  cover.extent = {high[0] - low[0], high[1] - low[1]};
  const PointsOfEnd points(shape, axis_of(side));
  cover.facing = points.fraction_in(outlines);
  cover.within_reach =
      points.fraction_in({rectangle({low[0] - edge, low[1] - edge}, {high[0] + edge, high[1] + edge})});
  return cover;
}

} // namespace platen::coupling
