// Body of the layer kernels; the including file sets PLATEN_LANES and PLATEN_KERNEL. Compiled without
// contraction, as the rest of the layer is.
#include "coupling/contact/layer_kernel.h"
#include "coupling/contact/mesh_indentation.h"
#include "dem/kernels/lane_friction.inc.h"

namespace platen::coupling::kernels {
namespace {

using dem::choose;
using dem::cross;
using dem::dot;
using dem::no_vector;
using dem::Rotation;
using dem::scale;
using dem::Triple;
using dem::kernels::gather;
using dem::kernels::LaneMask;
using dem::kernels::lanes;
using Simd = dem::kernels::Simd;
using How = dem::kernels::OfLanes;

// Lanes from `count` on repeat the last row and are not written.
struct Rows {
  int row[lanes], particle[lanes], count;
  bool follow; // contiguous in memory, and fill the SIMD vector
  int face[lanes];
};

// Columns of the layer: most rows are adjacent.
template <class T>
PLATEN_INLINE auto read(const T *column, const Rows &r) {
  return r.follow ? dem::kernels::load(column + r.row[0]) : gather(column, r.row);
}
PLATEN_INLINE void write(double *column, const Rows &r, const Simd &a) {
  if (!r.follow) return dem::kernels::scatter(column, r.row, r.count, a);
  for (int l = 0; l < lanes; ++l)
    column[r.row[0] + l] = a.v[l];
}
PLATEN_INLINE void write(Vector3 *column, const Rows &r, const Triple<Simd> &a) {
  if (!r.follow) return dem::kernels::scatter(column, r.row, r.count, a);
  dem::kernels::store(column + r.row[0], a);
}

// The closest points of a SIMD vector.
struct Points {
  Triple<Simd> arm, normal, along_u, along_v, place; // m, 1, m, m, m
  Simd u, v, distance;
};
template <class Columns>
PLATEN_INLINE Triple<Simd> vector_at(const Columns &from, std::size_t first) {
  return {dem::kernels::load(&from[0][first]), dem::kernels::load(&from[1][first]),
          dem::kernels::load(&from[2][first])};
}
PLATEN_INLINE Points points_at(const SurfacePoints &from, std::size_t first) {
  return {vector_at(from.arm, first),         vector_at(from.normal, first),
          vector_at(from.along_u, first),     vector_at(from.along_v, first),
          vector_at(from.place, first),       dem::kernels::load(&from.u[first]),
          dem::kernels::load(&from.v[first]), dem::kernels::load(&from.distance[first])};
}

struct SurfaceMotions {
  Triple<Simd> velocity; // m/s
  Simd spin;             // rad/s about the normal
};

// surface_motion() (transfer.h).
PLATEN_INLINE SurfaceMotions motion_of(const LayerSurface &surface, const int *faces, const Points &p) {
  const int *corners[lanes];
  for (int l = 0; l < lanes; ++l)
    corners[l] = surface.corner + 4 * faces[l];
  const auto of_corner = [&](int corner) {
    dem::kernels::Row rows[lanes];
    for (int l = 0; l < lanes; ++l)
      rows[l] = dem::kernels::load_vector(surface.velocity + corners[l][corner]);
    return dem::kernels::to_vectors(rows);
  };
  const Triple<Simd> v[4] = {of_corner(0), of_corner(1), of_corner(2), of_corner(3)};
  const Triple<Simd> along = v[1] - v[0];
  const Triple<Simd> by_u = scale(Simd(Simd(1.0) - p.v), along) + scale(p.v, v[2] - v[3]);
  const Triple<Simd> by_v = scale(Simd(Simd(1.0) - p.u), v[3] - v[0]) + scale(p.u, v[2] - v[1]);
  const Simd turning = dot(by_u, p.along_v) - dot(by_v, p.along_u), zero = Simd(0.0);
  const Simd area = dem::length<How>(cross(p.along_u, p.along_v));
  return {v[0] + (scale(p.u, along) + scale(p.v, by_v)),
          How::choose(How::above(area, zero), Simd(0.5) * turning / area, zero)};
}

// ContactLayer::spring().
PLATEN_INLINE Simd stiffness_at(const LayerSurface &surface, double stiffness, const int *faces,
                                const Rotation<Simd> &weights) {
  if (surface.compliance == nullptr) return Simd(stiffness);
  dem::kernels::LongRow above[lanes], below[lanes];
  for (int l = 0; l < lanes; ++l) {
    above[l] = dem::kernels::load_long_row(surface.compliance + 16 * faces[l]);
    below[l] = dem::kernels::load_long_row(surface.compliance + 16 * faces[l] + 8);
  }
  const Rotation<Simd> c[4] = {dem::kernels::first_columns(above), dem::kernels::second_columns(above),
                               dem::kernels::first_columns(below), dem::kernels::second_columns(below)};
  return in_series_with_indentation<How>(Simd(stiffness), indentation_of(weights, c));
}

struct Push {
  LaneMask active;
  Triple<Simd> shear;
  Simd normal_force, elastic, friction_loss, damping_loss, slip;
};

// The friction spring in the present plane, with its energy and its loss.
PLATEN_INLINE void rub(const LayerColumns &c, const LayerStep &s, const Rows &r, const Points &p,
                       const Triple<Simd> &spring, const Triple<Simd> &slide, const Simd &spin,
                       const Simd &k_t, Push &push) {
  const Simd zero = Simd(0.0);
  const Triple<Simd> before = read(c.normal, r);
  const LaneMask touched = How::above(dot(before, before), zero);
  const Triple<Simd> turned = dem::kernels::spin_in_plane(
      dem::carried_with_plane<How>(spring, before, p.normal), p.normal, Simd(spin * Simd(s.dt)));
  int slid[lanes];
  for (int l = 0; l < lanes; ++l)
    slid[l] = c.sliding[r.row[l]];
  const LaneMask slides = dem::kernels::set_lanes_of(r.follow ? c.sliding + r.row[0] : slid);
  const Simd slides_above =
      How::choose(slides, Simd(s.friction.friction_dynamic), Simd(s.friction.friction_static));
  const auto f =
      dem::spring_with_friction<How>(choose<How>(touched, turned, spring), scale(Simd(-s.dt), slide),
                                     push.normal_force, k_t, slides_above, Simd(s.friction.friction_dynamic));
  push.shear = f.spring;
  push.friction_loss = f.dissipated;
  push.elastic = push.elastic + Simd(0.5) * dot(f.spring, f.spring) / k_t;
  push.slip = How::choose(push.active, read(c.slip, r) + f.slip, zero);
  write(c.spring, r, f.spring);
  dem::kernels::scatter(c.sliding, r.row, r.count, f.slides);
  write(c.slip, r, push.slip);
  write(c.normal, r, choose<How>(push.active, p.normal, no_vector<Simd>()));
}

PLATEN_INLINE Push push_lanes(const LayerColumns &c, const LayerSurface &surface, const LayerStep &s,
                              const Rows &r, const Points &p, const Simd &k_n) {
  const Simd zero = Simd(0.0), dt = Simd(s.dt);
  const Simd gap = p.distance - gather(c.radius, r.particle) - read(c.offset, r);
  Push push;
  push.active = How::above(zero, gap);
  SurfaceMotions face;
  if (surface.only_shifted) {
    const Vector3 &all = surface.velocity[0];
    face = {{Simd(all.x), Simd(all.y), Simd(all.z)}, zero};
  } else {
    face = motion_of(surface, r.face, p);
  }
  Triple<Simd> v = gather(c.velocity, r.particle);
  if (c.angular_velocity != nullptr) v = v + cross(gather(c.angular_velocity, r.particle), p.arm);
  v = v - face.velocity;
  const Simd opening = dot(v, p.normal);
  const Triple<Simd> slide = v - scale(opening, p.normal);
  const Simd pressing = -k_n * gap;
  Simd damped = pressing;
  if (s.damping > 0)
    damped =
        pressing - Simd(2 * s.damping) * How::root(Simd(s.stiffness) * gather(c.mass, r.particle)) * opening;
  damped = How::choose(How::above(damped, zero), damped, zero);
  push.normal_force = How::choose(push.active, damped, zero);
  const Simd dashpot = How::choose(push.active, damped - pressing, zero), before = read(c.dashpot, r);
  push.elastic = How::choose(push.active, Simd(0.5) * k_n * gap * gap, zero);
  push.damping_loss = Simd(-0.5) * (before + dashpot) * opening * dt;
  write(c.dashpot, r, dashpot);
  push.friction_loss = push.slip = zero;
  push.shear = no_vector<Simd>();
  if (c.spring != nullptr) {
    rub(c, s, r, p, read(c.spring, r), slide, face.spin, Simd(Simd(s.tangential_ratio) * k_n), push);
  }
  // An open contact has released its springs in this step.
  const Simd until = Simd(s.travelled) + Simd(1 - idle_margin) * gap;
  write(c.idle_until, r, How::choose(push.active, zero, until));
  return push;
}

// Writes four numbers at once; a member that the fourth overwrites is written later. `first`: of the results.
PLATEN_INLINE void keep(const Rows &r, const Points &p, const Rotation<Simd> &weights, const Push &push,
                        const LayerResults &results, std::size_t first) {
  const Triple<Simd> force = scale(push.normal_force, p.normal) + push.shear;
  const Triple<Simd> &point = p.place;
  dem::kernels::Row forces[lanes], torques[lanes], sums[lanes], places[lanes], normals[lanes],
      corner_weights[lanes];
  dem::kernels::to_rows(weights, corner_weights);
  dem::kernels::to_rows(force, forces);
  const Triple<Simd> torque = cross(p.arm, force);
  dem::kernels::to_rows(Rotation<Simd>{torque.x, torque.y, torque.z, push.normal_force}, torques);
  const Simd depth = How::choose(push.active, Simd(0.0), Simd(-1.0));
  dem::kernels::to_rows(Rotation<Simd>{push.elastic, push.friction_loss, push.damping_loss, depth}, sums);
  dem::kernels::to_rows(Rotation<Simd>{point.x, point.y, point.z, p.normal.x}, places);
  dem::kernels::to_rows(Rotation<Simd>{point.z, p.normal.x, p.normal.y, p.normal.z}, normals);
  const unsigned active = dem::kernels::bits_of(push.active);
  RowLoad *const load = results.load + first;
  RowContact *const contact = results.contact + first;
  const auto keep_lane = [&](int l) __attribute__((always_inline)) {
    load[l].particle = active >> l & 1u ? r.particle[l] : -1;
    load[l].face = r.face[l];
    dem::kernels::store_row(&load[l].force.x, forces[l]);
    dem::kernels::store_row(load[l].weights.data(), corner_weights[l]);
    dem::kernels::store_row(&results.torque[first + static_cast<std::size_t>(l)].torque.x, torques[l]);
    dem::kernels::store_row(&results.work[first + static_cast<std::size_t>(l)].elastic, sums[l]);
    dem::kernels::store_row(&contact[l].point.x, places[l]);
    dem::kernels::store_row(&contact[l].point.z, normals[l]);
  };
  if (r.count < lanes) {
    for (int l = 0; l < r.count; ++l)
      keep_lane(l);
    return;
  }
#pragma GCC unroll 8
  for (int l = 0; l < lanes; ++l) // straight from registers
    keep_lane(l);
}

} // namespace

void PLATEN_KERNEL(const LayerColumns &c, const LayerSurface &surface, const LayerStep &s,
                   const SurfacePoints &points, const std::size_t *row, std::size_t count,
                   const LayerResults &results) {
  for (std::size_t first = 0; first < count; first += lanes) {
    Rows r;
    r.count = static_cast<int>(count - first < lanes ? count - first : lanes);
    for (int l = 0; l < lanes; ++l) {
      const std::size_t k = first + static_cast<std::size_t>(l < r.count ? l : r.count - 1);
      r.row[l] = static_cast<int>(row[k]);
      r.particle[l] = c.particle[row[k]];
      r.face[l] = points.face[k];
    }
    r.follow = r.count == lanes && r.row[lanes - 1] - r.row[0] == lanes - 1; // they ascend
    const Points p = points_at(points, first);
    const auto &w = points.weights;
    const Rotation<Simd> weights{dem::kernels::load(&w[0][first]), dem::kernels::load(&w[1][first]),
                                 dem::kernels::load(&w[2][first]), dem::kernels::load(&w[3][first])};
    const Simd k_n = stiffness_at(surface, s.stiffness, r.face, weights);
    keep(r, p, weights, push_lanes(c, surface, s, r, p, k_n), results, first);
  }
}

} // namespace platen::coupling::kernels
