#include "apps/bar/bar.h"

#include <cmath>
#include <stdexcept>

#include "dem/measure/bond_network.h"
#include "dem/measure/fragments.h"

namespace platen::apps {
namespace {

using dem::Particles;

// Part of the length, about the middle, over which sections are measured.
constexpr double measured_share = 0.5;

// Half the thickness of the slices at a quarter and half of the length, in mean radii.
constexpr double slice = 2;

// Those of the piece that `within` takes.
template <class Within>
BarEnd spheres_of(const Particles &p, const std::vector<char> &in_piece, const Within &within) {
  BarEnd end;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (in_piece[i] && within(i)) {
      end.rows.push_back(i);
      end.z += p.reference_position[i].z;
    }
  end.z /= static_cast<double>(end.rows.size());
  return end;
}

BarEnd end_within(const Particles &p, const std::vector<char> &in_piece, double plane, double depth,
                  int sign) {
  BarEnd end = spheres_of(p, in_piece, [&](std::size_t i) {
    return sign * (plane - p.reference_position[i].z) - p.radius[i] <= depth;
  });
  if (end.rows.empty())
    throw std::invalid_argument("no bonded sphere lies within Bar test/End depth of an end of the bar");
  return end;
}

// Mean distance of the centres within `depth` of a wall at that distance; a mean radius before the wall where
// there are none.
template <class Distance>
double outermost(const Particles &p, double wall, double mean_radius, double depth,
                 const Distance &distance) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double x = distance(p.reference_position[i]);
    if (wall - x - p.radius[i] > depth) continue;
    sum += x;
    ++count;
  }
  return count > 0 ? sum / count : wall - mean_radius;
}

CrossSection bounding_section(const Particles &p, const dem::Shape &shape, double mean_radius, double depth) {
  const auto width = [&](int axis, double half) {
    double sum = 2 * mean_radius;
    for (const int sign : {1, -1})
      sum += outermost(p, half, mean_radius, depth, [&](const Vector3 &x) { return sign * x[axis]; });
    return sum;
  };
  if (shape.kind == dem::ShapeKind::box)
    return {false, 0, width(0, 0.5 * shape.width_x), width(1, 0.5 * shape.width_y)};
  const auto from_axis = [](const Vector3 &x) { return std::hypot(x.x, x.y); };
  return {true, mean_radius + outermost(p, shape.radius, mean_radius, depth, from_axis), 0, 0};
}

double own_inertia(const Particles &p, std::size_t i) { // over the mass
  return p.has_rotation() ? 0.4 * p.radius[i] * p.radius[i] : 0;
}

// Shares of a sphere in the loads and motions of its end: its volume (the mass may be that of a clamp).
double weight(const Particles &p, std::size_t i) {
  return p.radius[i] * p.radius[i] * p.radius[i];
}

struct EndSums {
  double weight = 0, turning = 0;
  Vector3 middle;
};
EndSums sums_of(const Particles &p, const BarEnd &end) {
  EndSums s;
  for (const std::size_t i : end.rows) {
    s.weight += weight(p, i);
    s.middle += weight(p, i) * p.reference_position[i];
  }
  s.middle *= 1 / s.weight;
  for (const std::size_t i : end.rows) {
    const Vector3 r = p.reference_position[i] - s.middle;
    s.turning += weight(p, i) * (r.x * r.x + r.y * r.y + own_inertia(p, i));
  }
  return s;
}

} // namespace

BarGeometry measure_bar(const Particles &p, const dem::Bonds &bonds, const dem::Shape &shape, double depth,
                        bool along_x) {
  BarGeometry g;
  g.along_x = along_x;
  double mass = 0;
  const dem::Fragments pieces = dem::find_fragments(p, &bonds);
  for (std::size_t i = 0; i < p.size(); ++i) {
    g.mean_radius += p.radius[i] / static_cast<double>(p.size());
    g.in_piece.push_back(pieces.of_particle[i] == 0);
    if (g.in_piece[i])
      mass += p.mass[i];
    else
      ++g.loose;
  }
  const double layer = depth * g.mean_radius;
  g.low = end_within(p, g.in_piece, 0, layer, -1);
  g.high = end_within(p, g.in_piece, shape.height, layer, 1);
  g.bottom = g.low.z - g.mean_radius;
  g.top = g.high.z + g.mean_radius;
  const auto slice_at = [&](double z) {
    return spheres_of(p, g.in_piece, [&](std::size_t i) {
      return std::abs(p.reference_position[i].z - z) <= slice * g.mean_radius;
    });
  };
  g.quarter = slice_at(g.top - 0.25 * g.length());
  g.half = slice_at(g.top - 0.5 * g.length());
  g.bounding = bounding_section(p, shape, g.mean_radius, layer);
  const double middle = 0.5 * (g.bottom + g.top), reach = 0.5 * measured_share * g.length();
  const dem::Gyration force = dem::bond_gyration(p, bonds, middle - reach, middle + reach),
                      inertia = dem::mass_gyration(p, middle - reach, middle + reach);
  g.effective = section_of_gyration(g.bounding.round, force.xx, force.yy);
  g.mass = section_of_gyration(g.bounding.round, inertia.xx, inertia.yy);
  g.mass_per_length = mass / g.length();
  return g;
}

void add_force(dem::StaticCase &load, const Particles &p, const BarEnd &end, const Vector3 &force) {
  load.force.resize(p.size());
  const EndSums s = sums_of(p, end);
  for (const std::size_t i : end.rows)
    load.force[i] += weight(p, i) / s.weight * force;
}

void add_torque(dem::StaticCase &load, const Particles &p, const BarEnd &end, double torque) {
  load.force.resize(p.size());
  load.torque.resize(p.size());
  const EndSums s = sums_of(p, end);
  for (const std::size_t i : end.rows) {
    const Vector3 r = p.reference_position[i] - s.middle;
    const double share = torque * weight(p, i) / s.turning;
    load.force[i] += share * Vector3{-r.y, r.x, 0};
    load.torque[i] += share * Vector3{0, 0, own_inertia(p, i)};
  }
}

EndMotion motion_of(const Particles &p, const BarEnd &end, const std::vector<Vector3> &displacement,
                    const std::vector<Vector3> &turn) {
  const EndSums s = sums_of(p, end);
  EndMotion m;
  for (const std::size_t i : end.rows)
    m.moved += weight(p, i) / s.weight * displacement[i];
  for (const std::size_t i : end.rows) {
    const Vector3 r = p.reference_position[i] - s.middle, &u = displacement[i];
    m.twist += weight(p, i) / s.turning *
               (r.x * u.y - r.y * u.x + (turn.empty() ? 0 : own_inertia(p, i) * turn[i].z));
  }
  return m;
}

EndMotion motion_of(const Particles &p, const BarEnd &end) {
  std::vector<Vector3> displacement(p.size()), turn(p.has_rotation() ? p.size() : 0);
  for (const std::size_t i : end.rows) {
    displacement[i] = p.position[i] - p.reference_position[i];
    if (p.has_rotation()) {
      const Quaternion &q = (*p.orientation)[i];
      turn[i] = (q.w < 0 ? -2.0 : 2.0) * vector_part(q);
    }
  }
  return motion_of(p, end, displacement, turn);
}

} // namespace platen::apps
