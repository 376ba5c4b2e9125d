#include "coupling/contact/closest_point.h"

#include <algorithm>
#include <cmath>

#include "coupling/contact/face_of_corners.h"

namespace platen::coupling {

namespace {

// A twist e = x0 - x1 + x2 - x3 below this fraction of the diagonals is round-off of a parallelogram.
constexpr double parallel_twist = 1e-14;
// A quad whose twist leaves its plane by more than this fraction of the diagonals may have several local
// minima.
constexpr double warped = 1e-9;
// Below this fraction of (sum of squares)^2 the two tangents do not span a plane: only edges are searched
// there.
constexpr double no_area = 1e-28;

// The sum w_i x_i, written so that a face in a coordinate plane gives that plane's coordinate without
// rounding.
Vector3 point_at(const Quad &q, double u, double v) {
  return q[0] + u * (q[1] - q[0]) + v * (q[3] - q[0]) + (u * v) * ((q[0] - q[1]) + (q[2] - q[3]));
}

ClosestPoint at(const Quad &q, double u, double v) {
  ClosestPoint c;
  c.u = u;
  c.v = v;
  c.weights = bilinear_weights(u, v);
  c.point = point_at(q, u, v);
  c.distance_squared = norm_squared(c.point);
  return c;
}

// Closest point of edge k; its ends are vertices.
ClosestPoint on_edge(const Quad &q, int k) {
  const std::size_t a = static_cast<std::size_t>(k), b = (a + 1) % 4;
  const Vector3 along = q[b] - q[a];
  const double length_squared = norm_squared(along);
  double s = length_squared > 0 ? -dot(q[a], along) / length_squared : 0.0;
  s = s > 0 ? std::min(s, 1.0) : 0.0; // also where the division overflowed to NaN
  ClosestPoint c;
  // Weights of exactly the two ends; 1 - s and s add up to 1 exactly (see bilinear_weights).
  c.weights[a] = 1.0 - s;
  c.weights[b] = s;
  c.point = s == 1.0 ? q[b] : q[a] + s * along;
  c.distance_squared = norm_squared(c.point);
  c.feature = s > 0 && s < 1 ? Feature::edge : Feature::vertex;
  c.local = s < 1 ? k : static_cast<int>(b);
  const double corner_u[4] = {0, 1, 1, 0}, corner_v[4] = {0, 0, 1, 1};
  c.u = corner_u[a] + s * (corner_u[b] - corner_u[a]);
  c.v = corner_v[a] + s * (corner_v[b] - corner_v[a]);
  return c;
}

ClosestPoint on_boundary(const Quad &q) {
  ClosestPoint best = on_edge(q, 0);
  for (int k = 1; k < 4; ++k) {
    const ClosestPoint c = on_edge(q, k);
    if (c.distance_squared < best.distance_squared) best = c;
  }
  return best;
}

// Where a flat quad is convex, the projection onto its plane decides between face and rim.
enum class Projection { inside, outside, unknown };

Projection projection_on_flat_quad(const Quad &q, const Vector3 &across) {
  Projection projection = Projection::inside;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vector3 edge = q[(k + 1) % 4] - q[k], next = q[(k + 2) % 4] - q[(k + 1) % 4];
    if (dot(cross(edge, next), across) < 0) return Projection::unknown;
    if (norm_squared(edge) > 0 && !(dot(cross(edge, -q[k]), across) > 0)) projection = Projection::outside;
  }
  return projection;
}

bool inside(double u, double v) {
  return u > 0 && u < 1 && v > 0 && v < 1;
}

// Projection onto the plane of a parallelogram. False where it falls on or outside the rim, or there is no
// plane.
bool project_parallelogram(const Quad &q, double &u, double &v) {
  const Vector3 a = q[1] - q[0], b = q[3] - q[0];
  const double aa = dot(a, a), bb = dot(b, b), ab = dot(a, b), determinant = norm_squared(cross(a, b));
  if (!(determinant > no_area * (aa + bb) * (aa + bb))) return false;
  const double ra = -dot(q[0], a), rb = -dot(q[0], b);
  u = (ra * bb - rb * ab) / determinant;
  v = (rb * aa - ra * ab) / determinant;
  return inside(u, v);
}

// Coordinates of the closest point on a flat convex quad, if inside: in the plane, (closest point - q0 - v f)
// and (e + v t) are parallel, a quadratic equation for v. A start for the descent, which finishes in a step
// or two.
void invert_flat_quad(const Quad &q, const Vector3 &twist, const Vector3 &across, double &u, double &v) {
  const Vector3 e = q[1] - q[0], f = q[3] - q[0], h = -q[0];
  const auto plane = [&](const Vector3 &a, const Vector3 &b) { return dot(cross(a, b), across); };
  const double square = -plane(f, twist), linear = plane(h, twist) - plane(f, e), constant = plane(h, e);
  const double discriminant = linear * linear - 4 * square * constant;
  if (!(discriminant >= 0)) return;
  const double both = linear + std::copysign(std::sqrt(discriminant), linear);
  if (both == 0) return;
  const double found = -2 * constant / both;
  const Vector3 along = e + found * twist;
  if (!(norm_squared(along) > 0)) return;
  const double at = dot(h - found * f, along) / norm_squared(along);
  if (inside(at, found)) u = at, v = found;
}

// Minimises 1/2 |x(u, v)|^2 inside the unit square from a start, by Newton steps on the exact Hessian where
// it is positive definite and damped Gauss-Newton steps elsewhere. False where the path ends at the rim.
bool descend(const Quad &q, const Vector3 &twist, double &u, double &v) {
  Vector3 r = point_at(q, u, v);
  double f = 0.5 * norm_squared(r);
  int unchecked = 0;
  for (int iteration = 0; iteration < 60 && unchecked < 4; ++iteration) {
    const Vector3 a = derivative_u(q, v), b = derivative_v(q, u);
    const double gu = dot(r, a), gv = dot(r, b);
    const double aa = dot(a, a), bb = dot(b, b), ab = dot(a, b), off = ab + dot(r, twist);
    const bool hold_u = (u <= 0 && gu > 0) || (u >= 1 && gu < 0);
    const bool hold_v = (v <= 0 && gv > 0) || (v >= 1 && gv < 0);
    if (hold_u && hold_v) return false;
    double du = 0, dv = 0;
    bool newton = false;
    if (hold_u || hold_v) {
      if (!hold_u) du = aa > 0 ? -gu / aa : 0;
      if (!hold_v) dv = bb > 0 ? -gv / bb : 0;
    } else if (aa * bb - off * off > 1e-12 * aa * bb) {
      const double d = aa * bb - off * off;
      du = -(gu * bb - gv * off) / d;
      dv = -(gv * aa - gu * off) / d;
      newton = true;
    } else {
      const double damping = 1e-3 * (aa + bb), d = (aa + damping) * (bb + damping) - ab * ab;
      if (!(d > 0)) return false;
      du = -(gu * (bb + damping) - gv * ab) / d;
      dv = -(gv * (aa + damping) - gu * ab) / d;
    }
    // Close to the minimum f no longer shows progress (it is flat there): the last steps are not checked.
    const bool last_steps = std::abs(gu * du + gv * dv) < 1e-9 * f;
    if (last_steps && newton) ++unchecked;
    double step = 1, nu = 0, nv = 0, nf = f;
    for (int halving = 0; halving < 40; ++halving, step *= 0.5) {
      nu = std::clamp(u + step * du, 0.0, 1.0);
      nv = std::clamp(v + step * dv, 0.0, 1.0);
      r = point_at(q, nu, nv);
      nf = 0.5 * norm_squared(r);
      if (last_steps || nf <= f) break;
    }
    const double moved = std::max(std::abs(nu - u), std::abs(nv - v));
    u = nu, v = nv, f = nf;
    // A full Newton step leaves an error of the order of its square.
    if (moved < (newton && step == 1 ? 1e-9 : 1e-15)) break;
  }
  return inside(u, v);
}

// The corners' largest distance from the plane with this normal through the query point.
double farthest(const Quad &q, const Vector3 &n) {
  return std::max(
      {std::abs(dot(q[0], n)), std::abs(dot(q[1], n)), std::abs(dot(q[2], n)), std::abs(dot(q[3], n))});
}

} // namespace

double single_closest_within(const Quad &q, const Vector3 &n) {
  const dem::Triple<double> corners[4] = {dem::triple_of(q[0]), dem::triple_of(q[1]), dem::triple_of(q[2]),
                                          dem::triple_of(q[3])};
  return face_setup::single_closest<dem::OfScalars>(corners, dem::triple_of((q[0] - q[1]) + (q[2] - q[3])),
                                                    dem::triple_of(n));
}

double preference(const ClosestPoint &point) {
  constexpr double per_feature = 1e-14;
  return point.distance_squared * (1 + per_feature * static_cast<int>(point.feature));
}

std::array<double, 4> bilinear_weights(double u, double v) {
  std::array<double, 4> w = {(1 - u) * (1 - v), u * (1 - v), u * v, 0};
  // For s in [0, 1], s + fl(1 - s) rounds to 1: the error of 1 - s is at most half a unit in the last place
  // below 1, a tie that goes to the even 1. So the sum is exact, but w_3 may be of round-off size instead of
  // zero.
  w[3] = 1 - ((w[0] + w[1]) + w[2]);
  return w;
}

Vector3 derivative_u(const Quad &f, double v) {
  return (1 - v) * (f[1] - f[0]) + v * (f[2] - f[3]);
}

Vector3 derivative_v(const Quad &f, double u) {
  return (1 - u) * (f[3] - f[0]) + u * (f[2] - f[1]);
}

Vector3 bilinear_normal(const Quad &q, double u, double v) {
  const Vector3 a = derivative_u(q, v), b = derivative_v(q, u);
  Vector3 n = cross(a, b);
  const double scale = norm_squared(q[2] - q[0]) + norm_squared(q[3] - q[1]);
  // At a collapsed edge the tangents vanish; the mean normal is used instead.
  if (!(norm(n) > 1e-14 * scale)) n = cross(q[2] - q[0], q[3] - q[1]);
  const double length = norm(n);
  return length > 1e-14 * scale ? n / length : Vector3{};
}

ClosestPoint closest_point(const Quad &q) {
  const Vector3 twist = (q[0] - q[1]) + (q[2] - q[3]);
  const Vector3 first = q[2] - q[0], second = q[3] - q[1];
  const double size = std::max(norm(first), norm(second));
  double u = 0.5, v = 0.5;
  if (norm(twist) <= parallel_twist * size)
    return project_parallelogram(q, u, v) ? at(q, u, v) : on_boundary(q);

  const Vector3 across = cross(first, second);
  const double area = norm(across);
  const bool flat = area > 0 && std::abs(dot(twist, across)) <= warped * size * area;
  const Projection projection = flat ? projection_on_flat_quad(q, across) : Projection::unknown;
  if (projection == Projection::outside) return on_boundary(q);
  // A flat convex quad has one minimum.
  if (projection == Projection::inside) invert_flat_quad(q, twist, across, u, v);
  if (projection == Projection::inside && descend(q, twist, u, v)) return at(q, u, v);
  const Vector3 normal = area > 0 ? across / area : Vector3{};
  if (!flat && area > 0 && farthest(q, normal) < single_closest_within(q, normal)) {
    invert_flat_quad(q, twist, across, u, v);
    return descend(q, twist, u, v) ? at(q, u, v) : on_boundary(q);
  }

  ClosestPoint best = on_boundary(q);
  const auto try_from = [&](double start_u, double start_v) {
    u = start_u, v = start_v;
    if (!descend(q, twist, u, v)) return;
    const ClosestPoint c = at(q, u, v);
    if (preference(c) < preference(best)) best = c;
  };
  for (const double start_u : {0.125, 0.5, 0.875})
    for (const double start_v : {0.125, 0.5, 0.875})
      try_from(start_u, start_v);
  return best;
}

} // namespace platen::coupling
