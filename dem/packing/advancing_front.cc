#include "dem/packing/advancing_front.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "dem/packing/point_grid.h"

namespace platen::dem {
namespace {

RadiusDistribution checked(const RadiusDistribution &radii) {
  if (!(radii.small > 0) || !(radii.large >= radii.small) || !std::isfinite(radii.large))
    throw std::invalid_argument("sphere radii must be positive, finite, and the smaller given first");
  if (!(radii.fraction_of_large >= 0) || !(radii.fraction_of_large <= 1))
    throw std::invalid_argument("the fraction of large spheres must lie in [0, 1]");
  return radii;
}

// Overlap that round-off may cause, in radii; a hundred times below the promised limit (1e-9).
constexpr double round_off = 1e-11;
constexpr double touching = 1e-6; // relative gap below which two placed spheres touch
// If only a few spheres fit, the position of the first ones determines how many: the fullest of several
// starts is kept.
constexpr std::size_t few = 200;
constexpr int starts_of_few = 100;
constexpr int orientations_tried = 1000; // of the first spheres, before one sphere fewer is tried

struct Ball {
  Vector3 centre;
  double radius;
};

// The two positions, mirrored at the plane of the three centres, of a sphere of radius r that touches a, b
// and c. Returns false if there is none.
bool touching_places(const Ball &a, const Ball &b, const Ball &c, double r, Vector3 place[2]) {
  const double from_a = a.radius + r, from_b = b.radius + r, from_c = c.radius + r;
  const Vector3 ab = b.centre - a.centre, ac = c.centre - a.centre;
  const double d = norm(ab);
  const Vector3 ex = ab / d;
  const double i = dot(ex, ac);
  const Vector3 across = ac - i * ex;
  const double j = norm(across);
  if (j < 1e-6 * from_a) return false; // three centres in a line: no definite place
  const Vector3 ey = across / j;
  const double x = (from_a * from_a - from_b * from_b + d * d) / (2 * d);
  const double y = (from_a * from_a - from_c * from_c + i * i + j * j - 2 * i * x) / (2 * j);
  const double height_squared = from_a * from_a - x * x - y * y;
  if (height_squared < 0) return false;
  const Vector3 in_plane = a.centre + x * ex + y * ey, up = std::sqrt(height_squared) * cross(ex, ey);
  place[0] = in_plane + up, place[1] = in_plane - up;
  return true;
}

class Front {
public:
  Front(const Shape &shape, const RadiusDistribution &radii, std::uint64_t seed)
      : shape_(shape),
        radii_(radii),
        random_(seed),
        grid_(bounding_box(shape).low, bounding_box(shape).high, 2 * radii.large) {}

  Specimen fill() {
    next_radius_ = radii_.draw(random_);
    place_first();
    for (std::size_t oldest = 0; oldest < balls_.size(); ++oldest)
      surround(balls_[oldest]);
    Specimen specimen;
    specimen.shape = shape_;
    for (const Ball &ball : balls_)
      specimen.centre.push_back(ball.centre), specimen.radius.push_back(ball.radius);
    return specimen;
  }

private:
  void place_first();
  void surround(Ball base); // by value: the list it comes from grows
  void gather_around(const Ball &base);
  bool add_touching(const Ball &base, std::size_t a, std::size_t b);
  bool free_at(const Vector3 &place) const;
  void add(const Ball &ball) {
    balls_.push_back(ball);
    grid_.add(ball.centre);
  }

  Shape shape_;
  RadiusDistribution radii_;
  Random random_;
  PointGrid grid_;
  std::vector<Ball> balls_;
  std::vector<Ball> around_; // without the present base
  double next_radius_ = 0;
};

// A touching triangle, in a random orientation that fits, about the middle of the shape; two spheres or one
// if three do not fit.
void Front::place_first() {
  const double r[3] = {next_radius_, radii_.draw(random_), radii_.draw(random_)};
  const Vector3 middle{0, 0, 0.5 * shape_.height};
  for (int count = 3; count >= 1; --count)
    for (int attempt = 0; attempt < orientations_tried; ++attempt) {
      const Vector3 ex = random_.direction(), other = random_.direction();
      const Vector3 normal = cross(ex, other);
      if (norm(normal) < 1e-3) continue;
      const Vector3 ey = cross(normal / norm(normal), ex);
      const double d = r[0] + r[1], from_a = r[0] + r[2], from_b = r[1] + r[2];
      const double x = (from_a * from_a - from_b * from_b + d * d) / (2 * d);
      const Vector3 corner[3] = {{}, d * ex, x * ex + std::sqrt(from_a * from_a - x * x) * ey};
      Vector3 centroid;
      for (int k = 0; k < count; ++k)
        centroid += corner[k] / count;
      bool fits = true;
      for (int k = 0; k < count; ++k)
        fits = fits && wall_clearance(shape_, middle + corner[k] - centroid) >= r[k];
      if (!fits) continue;
      for (int k = 0; k < count; ++k)
        add({middle + corner[k] - centroid, r[k]});
      next_radius_ = radii_.draw(random_);
      return;
    }
  throw std::invalid_argument("not even one sphere fits into the shape");
}

void Front::gather_around(const Ball &base) {
  around_.clear();
  const double reach = base.radius + 2 * next_radius_;
  grid_.for_each_near(base.centre, reach + radii_.large, [&](int j) {
    const Ball &ball = balls_[j];
    const double distance_squared = norm_squared(ball.centre - base.centre);
    if (distance_squared > 0 && distance_squared < (reach + ball.radius) * (reach + ball.radius))
      around_.push_back(ball);
  });
  // Partners that touch the base come first: a place in the corner of three touching spheres is taken before
  // one that bridges a gap. Otherwise the order is random.
  random_.shuffle(around_);
  std::stable_partition(around_.begin(), around_.end(), [&](const Ball &ball) {
    const double limit = (base.radius + ball.radius) * (1 + touching);
    return norm_squared(ball.centre - base.centre) < limit * limit;
  });
}

bool Front::free_at(const Vector3 &place) const {
  if (wall_clearance(shape_, place) < next_radius_) return false;
  for (const Ball &ball : around_) {
    const double limit = (ball.radius + next_radius_) * (1 - round_off);
    if (norm_squared(ball.centre - place) < limit * limit) return false;
  }
  return true;
}

// Every sphere that could overlap a place touching the base is among those around it, and so are all
// partners.
bool Front::add_touching(const Ball &base, std::size_t a, std::size_t b) {
  const double reach = around_[a].radius + around_[b].radius + 2 * next_radius_;
  if (norm_squared(around_[a].centre - around_[b].centre) > reach * reach) return false;
  Vector3 place[2];
  if (!touching_places(base, around_[a], around_[b], next_radius_, place)) return false;
  for (const Vector3 &p : place) {
    if (!free_at(p)) continue;
    add({p, next_radius_});
    around_.push_back(balls_.back()); // a partner of further places, and an obstacle to them
    next_radius_ = radii_.draw(random_);
    return true;
  }
  return false;
}

void Front::surround(Ball base) {
  bool new_radius = true;
  while (new_radius) { // places that do not fit the last radius may fit the next; larger ones reach further
    new_radius = false;
    const double radius = next_radius_;
    gather_around(base);
    for (std::size_t a = 1; a < around_.size() && !new_radius; ++a)
      for (std::size_t b = 0; b < a && !new_radius; ++b)
        while (!new_radius && add_touching(base, a, b))
          new_radius = next_radius_ != radius;
  }
}

} // namespace

double RadiusDistribution::draw(Random &random) const {
  if (kind == Kind::equal) return small;
  const double u = random.uniform();
  if (kind == Kind::two_sizes) return u < fraction_of_large ? large : small;
  return small + (large - small) * u;
}

RadiusDistribution equal_radii(double radius) {
  return checked({RadiusDistribution::Kind::equal, radius, radius, 0});
}

RadiusDistribution two_radii(double small, double large, double fraction_of_large) {
  return checked({RadiusDistribution::Kind::two_sizes, small, large, fraction_of_large});
}

RadiusDistribution uniform_radii_of_spread(double mean, double spread) {
  return checked(
      {RadiusDistribution::Kind::uniform, mean * (1 - 0.5 * spread), mean * (1 + 0.5 * spread), 0});
}

Specimen advancing_front(const Shape &shape, const RadiusDistribution &radii, std::uint64_t seed) {
  require_valid(shape);
  Random starts(seed);
  Specimen fullest = Front(shape, radii, starts.next()).fill();
  for (int start = 1; start < starts_of_few && fullest.size() < few; ++start) {
    Specimen other = Front(shape, radii, starts.next()).fill();
    if (volume_of_spheres(other) > volume_of_spheres(fullest)) fullest = std::move(other);
  }
  return fullest;
}

} // namespace platen::dem
