#include "dem/skin.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

#include <voro++/voro++.hh>

#include "base/parallel.h"
#include "dem/packing/point_grid.h"

namespace platen::dem {
namespace {

// Ball over sphere radius. Below about 1.7 pores of a jammed packing show through.
constexpr double ball = 2;
// Edge of the cubes that tell outside from pores, in mean radii.
constexpr double cube_edge = 0.5;
// A corner of the solid of 32 faces lies less than this times the ball's radius from its centre.
constexpr double corner = 1.1;
constexpr int own_face = -11, platen_face = -12; // names of faces of a cell; neighbours have theirs, >= 0
constexpr std::size_t cells_at_once = 32;

// Towards the corners of an icosahedron and of a dodecahedron.
std::vector<Vector3> directions() {
  const double g = 0.5 * (1 + std::sqrt(5.0));
  std::vector<Vector3> all;
  for (const double s : {-1.0, 1.0})
    for (const double t : {-1.0, 1.0}) {
      for (const Vector3 &corner_of : {Vector3{0, s, t * g}, Vector3{0, s / g, t * g}})
        for (int turn = 0; turn < 3; ++turn)
          all.push_back({corner_of[turn % 3], corner_of[(turn + 1) % 3], corner_of[(turn + 2) % 3]});
      for (const double u : {-1.0, 1.0})
        all.push_back({s, t, u});
    }
  for (Vector3 &d : all)
    d *= 1 / norm(d);
  return all;
}

struct Balls {
  std::vector<int> row;
  std::vector<Vector3> centre;
  std::vector<double> radius; // m, of the ball
  double unit = 1, largest = 0;
};

Balls balls_of(const Particles &p, const std::vector<char> &body) {
  Balls b;
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!body[i]) continue;
    b.row.push_back(static_cast<int>(i));
    b.centre.push_back(p.position[i]);
    b.radius.push_back(ball * p.radius[i]);
    b.largest = std::max(b.largest, b.radius.back());
    sum += b.radius.back();
  }
  if (sum > 0) b.unit = sum / static_cast<double>(b.row.size());
  return b;
}

// Area of one ball's own surface in its cell of the power diagram, m^2. Lengths inside are over b.unit: the
// cell's tolerances are absolute.
Vector3 area_of(const Balls &b, std::size_t i, const PointGrid &grid, const std::vector<Vector3> &solid,
                const EndPlanes &planes) {
  const Vector3 x = b.centre[i];
  const double r = b.radius[i] / b.unit, box = 2 * corner * r;
  voro::voronoicell_neighbor cell;
  cell.init(-box, box, -box, box, -box, box);
  bool left = true;
  const auto cut = [&](const Vector3 &towards, double square, int name) {
    if (left) left = cell.nplane(towards.x, towards.y, towards.z, square, name);
  };
  // A plane at distance d along a unit vector is that of a twin at 2 d.
  for (const Vector3 &n : solid)
    cut(2 * r * n, 4 * r * r, own_face);
  constexpr double least = 1e-3; // a centre that has come through a platen keeps a sliver
  const double above = std::max(least, (planes.high - x.z) / b.unit),
               below = std::max(least, (x.z - planes.low) / b.unit);
  cut({0, 0, 2 * above}, 4 * above * above, platen_face);
  cut({0, 0, -2 * below}, 4 * below * below, platen_face);
  grid.for_each_near(x, b.radius[i] + b.largest, [&](int other) {
    const std::size_t j = static_cast<std::size_t>(other);
    const Vector3 d = (b.centre[j] - x) / b.unit;
    const double s = b.radius[j] / b.unit, square = norm_squared(d);
    if (j != i && square < (r + s) * (r + s)) cut(d, square + r * r - s * s, other);
  });
  if (!left) return {};
  std::vector<int> names;
  std::vector<double> areas, normals;
  cell.neighbors(names);
  cell.face_areas(areas);
  cell.normals(normals);
  Vector3 sum;
  for (std::size_t f = 0; f < names.size(); ++f)
    if (names[f] == own_face)
      sum += areas[f] * Vector3{normals[3 * f], normals[3 * f + 1], normals[3 * f + 2]};
  return b.unit * b.unit * sum;
}

} // namespace

Skin find_skin(const Particles &p, const std::vector<char> &body, const EndPlanes &planes) {
  const Balls b = balls_of(p, body);
  if (b.row.empty()) return {};
  const double edge = cube_edge * b.unit / ball;
  const Outside outside(b.centre, b.radius, planes, edge);
  Vector3 low = b.centre[0], high = low;
  for (const Vector3 &x : b.centre)
    for (int k = 0; k < 3; ++k)
      low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
  PointGrid grid(low, high, b.unit);
  for (const Vector3 &x : b.centre)
    grid.add(x);
  static const std::vector<Vector3> solid = directions();
  std::vector<Vector3> area(b.row.size());
  for_each(
      b.row.size(),
      [&](std::size_t i) {
        if (outside.within(b.centre[i], corner * b.radius[i] + edge))
          area[i] = area_of(b, i, grid, solid, planes);
      },
      cells_at_once);
  Skin skin;
  for (std::size_t i = 0; i < area.size(); ++i)
    if (norm_squared(area[i]) > 0) {
      skin.particle.push_back(b.row[i]);
      skin.area.push_back(area[i]);
    }
  return skin;
}

double balance(Skin &skin, const Particles &p) {
  Vector3 force, moment, centre;
  double weight = 0;
  const std::size_t n = skin.particle.size();
  const auto at = [&](std::size_t k) { return p.position[static_cast<std::size_t>(skin.particle[k])]; };
  for (std::size_t k = 0; k < n; ++k) {
    const double w = norm(skin.area[k]);
    weight += w;
    centre += w * at(k);
    force += skin.area[k];
  }
  if (n < 3) return 0;
  centre *= 1 / weight;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero(); // sum |a| (y.y 1 - y y)
  for (std::size_t k = 0; k < n; ++k) {
    const Vector3 y = at(k) - centre;
    const Eigen::Vector3d v(y.x, y.y, y.z);
    spread += norm(skin.area[k]) * (v.dot(v) * Eigen::Matrix3d::Identity() - v * v.transpose());
    moment += cross(y, skin.area[k]);
  }
  const Eigen::Vector3d turn = spread.fullPivLu().solve(Eigen::Vector3d(-moment.x, -moment.y, -moment.z));
  const Vector3 shift = force * (-1 / weight), w{turn.x(), turn.y(), turn.z()};
  for (std::size_t k = 0; k < n; ++k)
    skin.area[k] += norm(skin.area[k]) * (shift + cross(w, at(k) - centre));
  return norm(force) / weight;
}

} // namespace platen::dem
