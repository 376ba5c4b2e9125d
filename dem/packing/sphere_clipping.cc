#include "dem/packing/sphere_clipping.h"

#include <algorithm>
#include <cmath>

#include "base/pi.h"

namespace platen::dem {

namespace {

// Eight Gauss-Legendre points on [-1, 1] (Abramowitz and Stegun, table 25.4), used on several equal pieces
// because a cut sphere's slices have kinks.
constexpr double gauss_point[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                   0.9602898564975363};
constexpr double gauss_weight[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                    0.1012285362903763};
constexpr int pieces = 3;

template <class Function>
double integral(double from, double to, const Function &f) {
  const double half = 0.5 * (to - from) / pieces;
  double sum = 0;
  for (int piece = 0; piece < pieces; ++piece) {
    const double middle = from + (2 * piece + 1) * half;
    for (int k = 0; k < 4; ++k)
      sum += gauss_weight[k] * (f(middle - half * gauss_point[k]) + f(middle + half * gauss_point[k]));
  }
  return half * sum;
}

// Part of a disc inside the rectangle [-half_x, half_x] x [-half_y, half_y].
double area_in_rectangle(double x, double y, double r, double half_x, double half_y) {
  const bool inside = std::abs(x) + r <= half_x && std::abs(y) + r <= half_y;
  if (inside) return pi * r * r;
  // Along the angle t with x' = x + r sin t the chord r cos t is smooth up to both ends.
  const double low = std::max((-half_x - x) / r, -1.0), high = std::min((half_x - x) / r, 1.0);
  if (low >= high) return 0;
  return integral(std::asin(low), std::asin(high), [&](double t) {
    const double half_chord = r * std::cos(t);
    return r * std::cos(t) *
           std::max(0.0, std::min(y + half_chord, half_y) - std::max(y - half_chord, -half_y));
  });
}

// Radius of the slice whose rim just meets the side wall, for a centre within it or not.
double clearance_of_side(const Shape &shape, const Vector3 &c, double from_axis) {
  if (shape.kind == ShapeKind::cylinder) return std::abs(shape.radius - from_axis);
  return std::min(std::abs(0.5 * shape.width_x - std::abs(c.x)),
                  std::abs(0.5 * shape.width_y - std::abs(c.y)));
}

} // namespace

double shared_area_of_discs(double a, double b, double d) {
  const double small = std::min(a, b);
  if (d <= std::abs(a - b)) return pi * small * small;
  if (d >= a + b) return 0;
  const double angle_a = std::acos(std::clamp((d * d + a * a - b * b) / (2 * d * a), -1.0, 1.0));
  const double angle_b = std::acos(std::clamp((d * d + b * b - a * a) / (2 * d * b), -1.0, 1.0));
  return a * a * (angle_a - 0.5 * std::sin(2 * angle_a)) + b * b * (angle_b - 0.5 * std::sin(2 * angle_b));
}

double clipped_volume(const Vector3 &c, double r, const Shape &shape) {
  const double clearance = wall_clearance(shape, c);
  if (clearance >= r) return 4.0 / 3.0 * pi * r * r * r;
  if (clearance <= -r) return 0;
  const double low = std::max(-c.z / r, -1.0), high = std::min((shape.height - c.z) / r, 1.0);
  if (low >= high) return 0;
  const double from_axis = std::sqrt(c.x * c.x + c.y * c.y);
  const auto slice = [&](double t) { // at the height r sin t, where the slice is a disc of radius r cos t
    const double disc = r * std::cos(t);
    return disc * (shape.kind == ShapeKind::cylinder
                       ? shared_area_of_discs(disc, shape.radius, from_axis)
                       : area_in_rectangle(c.x, c.y, disc, 0.5 * shape.width_x, 0.5 * shape.width_y));
  };
  // The slices have a kink where their rim first meets the wall; no piece of the integral lies across it.
  const double kink = std::acos(std::clamp(clearance_of_side(shape, c, from_axis) / r, 0.0, 1.0));
  const double start = std::asin(low), end = std::asin(high);
  const double first = std::clamp(-kink, start, end), second = std::clamp(kink, start, end);
  return integral(start, first, slice) + integral(first, second, slice) + integral(second, end, slice);
}

} // namespace platen::dem
