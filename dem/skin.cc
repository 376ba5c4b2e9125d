#include "dem/skin.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

#include <voro++/voro++.hh>

#include "base/parallel.h"
#include "dem/eigen.h"
#include "dem/packing/point_grid.h"

namespace platen::dem {
namespace {

// Ball radius over sphere radius. Below about 1.7, pores of a jammed packing appear in the skin.
constexpr double ball = 2;
// Edge of the cubes that separate outside from pores, in mean radii.
constexpr double cube_edge = 0.5;
// Corners of the solid of 32 faces lie less than this times the ball's radius from its centre.
constexpr double corner = 1.1;
constexpr int own_face = -11, platen_face = -12; // names of cell faces; those to neighbours are >= 0
constexpr std::size_t cells_at_once = 32;

// Unit vectors to the corners of an icosahedron and of a dodecahedron.
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

// Area of one ball's own surface in its cell of the power diagram, m^2. Internal lengths are divided by
// b.unit, because the cell's tolerances are absolute.
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
  // A plane at distance d along a unit vector is that of an equal ball at 2 d.
  for (const Vector3 &n : solid)
    cut(2 * r * n, 4 * r * r, own_face);
  constexpr double least = 1e-3; // a centre behind a platen keeps a thin cell
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

Outside::Outside(const std::vector<Vector3> &centres, const std::vector<double> &radii,
                 const EndPlanes &planes, double edge)
    : edge_(edge) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Vector3 low{far, far, planes.low}, high{-far, -far, planes.high};
  for (std::size_t i = 0; i < centres.size(); ++i)
    for (int k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], centres[i][k] - radii[i]);
      high[k] = std::max(high[k], centres[i][k] + radii[i]);
    }
  if (centres.empty()) return;
  // Two cubes of free space on every side, where the flood fill begins.
  for (int k = 0; k < 2; ++k)
    low[k] -= 2 * edge, high[k] += 2 * edge;
  low_ = low;
  for (int k = 0; k < 3; ++k)
    n_[k] = std::max(1, static_cast<int>(std::ceil((high[k] - low[k]) / edge)));
  cubes_.assign(static_cast<std::size_t>(n_[0]) * n_[1] * n_[2], Cube::pore);
  for (std::size_t i = 0; i < centres.size(); ++i)
    visit_near(centres[i], radii[i], [&](std::size_t cube) {
      cubes_[cube] = Cube::solid;
      return true;
    });
  flood();
}

// Calls visit(cube) for the cubes whose centre lies within `reach`, until it returns false.
template <class Visit>
void Outside::visit_near(const Vector3 &point, double reach, const Visit &visit) const {
  int first[3], last[3], at[3];
  for (int k = 0; k < 3; ++k) {
    first[k] = std::max(0, static_cast<int>(std::ceil((point[k] - reach - low_[k]) / edge_ - 0.5)));
    last[k] = std::min(n_[k] - 1, static_cast<int>(std::floor((point[k] + reach - low_[k]) / edge_ - 0.5)));
  }
  for (at[2] = first[2]; at[2] <= last[2]; ++at[2])
    for (at[1] = first[1]; at[1] <= last[1]; ++at[1])
      for (at[0] = first[0]; at[0] <= last[0]; ++at[0]) {
        Vector3 away;
        for (int k = 0; k < 3; ++k)
          away[k] = low_[k] + (at[k] + 0.5) * edge_ - point[k];
        if (norm_squared(away) <= reach * reach && !visit(index(at))) return;
      }
}

void Outside::flood() {
  std::vector<int> front; // x, y, z of cubes whose neighbours are to be checked
  const auto take = [&](int x, int y, int z) {
    const int at[3] = {x, y, z};
    for (int k = 0; k < 3; ++k)
      if (at[k] < 0 || at[k] >= n_[k]) return;
    Cube &cube = cubes_[index(at)];
    if (cube != Cube::pore) return;
    cube = Cube::outside;
    front.insert(front.end(), {x, y, z});
  };
  for (int z = 0; z < n_[2]; ++z)
    take(0, 0, z);
  while (!front.empty()) {
    const std::size_t n = front.size();
    const int x = front[n - 3], y = front[n - 2], z = front[n - 1];
    front.resize(n - 3);
    take(x - 1, y, z), take(x + 1, y, z);
    take(x, y - 1, z), take(x, y + 1, z);
    take(x, y, z - 1), take(x, y, z + 1);
  }
}

bool Outside::within(const Vector3 &point, double reach) const {
  bool found = false;
  visit_near(point, reach, [&](std::size_t cube) {
    found = cubes_[cube] == Cube::outside;
    return !found;
  });
  return found;
}

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
  const auto at = [&](std::size_t k) { return p.position[skin.particle[k]]; };
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
    const Eigen::Vector3d v = eigen(y);
    spread += norm(skin.area[k]) * (v.dot(v) * Eigen::Matrix3d::Identity() - v * v.transpose());
    moment += cross(y, skin.area[k]);
  }
  const Eigen::Vector3d turn = spread.fullPivLu().solve(eigen(-moment));
  const Vector3 shift = force * (-1 / weight), w{turn.x(), turn.y(), turn.z()};
  for (std::size_t k = 0; k < n; ++k)
    skin.area[k] += norm(skin.area[k]) * (shift + cross(w, at(k) - centre));
  return norm(force) / weight;
}

} // namespace platen::dem
