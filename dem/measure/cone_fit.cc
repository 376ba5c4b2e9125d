#include "dem/measure/cone_fit.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace platen::dem {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>; // apex x, y, z; slopes of the axis; half-angle
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr int most_iterations = 100;
constexpr double settled = 1e-8;   // relative fall of the misfit that is not worth another iteration
constexpr double cauchy = 2;       // grains
constexpr double near_axis = 1e-9; // grains; nearer to the axis the direction outwards is noise
constexpr double smallest = 0.5;   // grains; the root of a smaller section is taken for its tangent

Cone cone_of(const Vector6 &q) {
  const Vector3 along{q[3], q[4], -1};
  return {{q[0], q[1], q[2]}, along / norm(along), q[5]};
}

Vector6 numbers_of(const Cone &c) {
  Vector6 q;
  q << c.apex.x, c.apex.y, c.apex.z, -c.axis.x / c.axis.z, -c.axis.y / c.axis.z, c.half_angle;
  return q;
}

// Of distance() by the six numbers.
Vector6 gradient(const Vector6 &q, const Cone &c, const Vector3 &x, double grain) {
  const Vector3 w = x - c.apex;
  const double depth = dot(w, c.axis), sine = std::sin(c.half_angle), cosine = std::cos(c.half_angle);
  const Vector3 across = w - depth * c.axis;
  const double radius = std::max(norm(across), near_axis * grain);
  const Vector3 normal = (cosine / radius) * across - sine * c.axis;
  // The axis turns, x and apex stay: depth changes by w . du, the radius by -(depth / radius) times that.
  const double by_depth = -(depth / radius * cosine + sine);
  const double length = std::sqrt(1 + q[3] * q[3] + q[4] * q[4]);
  Vector6 g;
  g << -normal.x, -normal.y, -normal.z, by_depth * (w.x - depth * c.axis.x) / length,
      by_depth * (w.y - depth * c.axis.y) / length, -radius * sine - depth * cosine;
  return g;
}

// What of a slice is in a body: volume and first moments.
struct Section {
  double all = 0;             // m^3, of all points
  double v = 0, x = 0, y = 0; // m^3, m^4
  Vector6 dv = Vector6::Zero(), dx = Vector6::Zero(), dy = Vector6::Zero();
};

struct Equations {
  Matrix6 matrix = Matrix6::Zero();
  Vector6 side = Vector6::Zero();
  double misfit = 0;
};

class Fit {
public:
  Fit(const std::vector<LabelledPoint> &points, const ConeFit &fit) : points_(points), fit_(fit) {
    for (const LabelledPoint &p : points_) {
      if (slice(p) >= piece_.size()) piece_.resize(slice(p) + 1);
      Section &s = piece_[slice(p)];
      s.all += p.weight;
      if (p.inside) s.v += p.weight, s.x += p.weight * p.x.x, s.y += p.weight * p.x.y;
    }
  }

  Equations equations(const Vector6 &q) const {
    const std::vector<Section> cone = sections(q);
    Equations e;
    for (std::size_t k = 0; k < cone.size(); ++k) {
      const Section &c = cone[k], &p = piece_[k];
      if (p.all == 0) continue;
      Vector6 row;
      const double seen = root(p, p.v, nullptr), laid = root(c, c.v, &row);
      add(e, laid - seen, row);
      if (p.v <= 0 || c.v < 1e-6 * p.all) continue;
      // A centre is worth as much as its section is wide.
      const double worth = std::sqrt(p.v / p.all) / fit_.grain;
      add(e, worth * (c.x / c.v - p.x / p.v), worth * (c.dx - c.x / c.v * c.dv) / c.v);
      add(e, worth * (c.y / c.v - p.y / p.v), worth * (c.dy - c.y / c.v * c.dv) / c.v);
    }
    return e;
  }

private:
  std::size_t slice(const LabelledPoint &p) const {
    return static_cast<std::size_t>(std::max(0.0, p.x.z / fit_.thickness));
  }

  std::vector<Section> sections(const Vector6 &q) const {
    std::vector<Section> all(piece_.size());
    const Cone c = cone_of(q);
    const double sharpness = 2 / fit_.grain;
    for (const LabelledPoint &p : points_) {
      Section &s = all[slice(p)];
      s.all += p.weight;
      const double far = sharpness * c.distance(p.x);
      if (far > 40) continue;
      const double m = 1 / (1 + std::exp(far)), v = p.weight * m;
      s.v += v, s.x += v * p.x.x, s.y += v * p.x.y;
      if (far < -40) continue;
      const Vector6 dv = (-v * (1 - m) * sharpness) * gradient(q, c, p.x, fit_.grain);
      s.dv += dv, s.dx += dv * p.x.x, s.dy += dv * p.x.y;
    }
    return all;
  }

  // Equivalent radius of a section in grains, and its derivative.
  double root(const Section &s, double volume, Vector6 *row) const {
    const double scale = fit_.width / fit_.grain, low = smallest / scale;
    const double share = volume / s.all, least = low * low;
    const double value = share > least ? std::sqrt(share) : 0.5 * (share / low + low);
    if (row != nullptr) *row = s.dv * (scale * 0.5 / (share > least ? value : low) / s.all);
    return scale * value;
  }

  static void add(Equations &e, double residual, const Vector6 &row) {
    const double r = residual / cauchy, weight = 1 / (1 + r * r);
    e.misfit += std::log1p(r * r);
    e.matrix += weight * row * row.transpose();
    e.side -= weight * residual * row;
  }

  const std::vector<LabelledPoint> &points_;
  ConeFit fit_;
  std::vector<Section> piece_;
};

} // namespace

double Cone::distance(const Vector3 &point) const {
  const Vector3 w = point - apex;
  const double depth = dot(w, axis);
  return norm(w - depth * axis) * std::cos(half_angle) - depth * std::sin(half_angle);
}

Cone fit_cone(const std::vector<LabelledPoint> &points, const Cone &start, const ConeFit &settings) {
  const Fit fit(points, settings);
  Vector6 q = numbers_of(start);
  Equations now = fit.equations(q);
  double damping = 1e-3;
  for (int k = 0; k < most_iterations && damping < 1e9; ++k) {
    Matrix6 damped = now.matrix;
    damped.diagonal() *= 1 + damping;
    const Vector6 next = q + damped.ldlt().solve(now.side);
    if (!next.allFinite()) break;
    const Equations then = fit.equations(next);
    if (!(then.misfit < now.misfit)) {
      damping *= 10;
      continue;
    }
    const bool done = now.misfit - then.misfit < settled * now.misfit;
    q = next;
    now = then;
    damping *= 0.1;
    if (done) break;
  }
  return cone_of(q);
}

} // namespace platen::dem
