#include "base/portable.h"

#include <cmath>
#include <limits>

namespace platen::portable {
namespace {

using Real = long double;
static_assert(std::numeric_limits<Real>::digits >= 64, "extended precision is what the accuracy rests on");

constexpr Real infinite = std::numeric_limits<Real>::infinity();
constexpr Real none = std::numeric_limits<Real>::quiet_NaN();

// Constants in parts: the product of an integer below 2^26 and a first part is exact.
constexpr Real ln2[] = {0x2c5c85fdf4p-38L, 0xe7bcd5e4f1d9cc02p-103L};
constexpr Real quarter_turn[] = {0x3243f6a888p-37L, 0x2d18469898p-76L, 0xcc51701b839a2520p-140L};
constexpr Real half_pi = 0xc90fdaa22168c235p-63L;
constexpr Real half_log_2pi = 0xeb3f8e4325f5a535p-64L;

Real nearest(Real x) {
  return static_cast<Real>(static_cast<long>(x + (x < 0 ? -0.5L : 0.5L)));
}

// Series end where the remainder is below 2^-68 of the sum.
Real exp_of(Real x) {
  if (x != x) return x;
  if (x > 12000) return infinite; // beyond the range of doubles, within that of Real
  if (x < -11000) return 0;
  const Real k = nearest(x / ln2[0]);
  const Real r = (x - k * ln2[0]) - k * ln2[1]; // |r| <= ln 2 / 2
  Real sum = 1;
  for (int n = 18; n > 0; --n)
    sum = 1 + r * sum / n;
  return std::ldexp(sum, static_cast<int>(k));
}

// ln x = e ln 2 + 2 artanh((m - 1) / (m + 1)), x = m 2^e, m about 1.
Real log_of(Real x) {
  if (x == 0) return -infinite;
  if (!(x > 0)) return none;
  if (x == infinite) return x;
  int e = 0;
  Real m = std::frexp(x, &e);
  if (m < 0.70710678L) m *= 2, --e;
  const Real s = (m - 1) / (m + 1), square = s * s;
  Real sum = 0;
  for (int n = 15; n > 0; --n)
    sum = square * (1.0L / (2 * n + 1) + sum);
  return e * ln2[0] + (2 * s + (2 * s * sum + e * ln2[1]));
}

struct SineCosine {
  Real sine, cosine;
};

SineCosine sine_cosine(double angle) {
  if (!std::isfinite(angle)) return {none, none};
  Real x = angle;
  if (std::abs(x) > 1e7L) x = std::fmod(angle, 4 * static_cast<double>(half_pi)); // exact, as fmod is
  const Real k = nearest(x / half_pi);
  const Real r = ((x - k * quarter_turn[0]) - k * quarter_turn[1]) - k * quarter_turn[2];
  const Real square = r * r;
  Real s = 0, c = 0;
  for (int n = 11; n > 0; --n) {
    s = -square / ((2 * n) * (2 * n + 1)) * (1 + s);
    c = -square / ((2 * n - 1) * (2 * n)) * (1 + c);
  }
  s = r + r * s, c = 1 + c;
  switch (static_cast<long>(k) & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

// For t in [0, 1]; the angle is halved twice.
Real arc_tangent(Real t) {
  for (int halving = 0; halving < 2; ++halving)
    t = t / (1 + std::sqrt(1 + t * t));
  const Real square = t * t;
  Real sum = 0;
  for (int n = 15; n > 0; --n)
    sum = -square * (1.0L / (2 * n + 1) + sum);
  return 4 * (t + t * sum);
}

Real angle_of(Real y, Real x) {
  if (x != x || y != y) return none;
  const Real a = std::abs(x), b = std::abs(y);
  if (a == 0 && b == 0) return 0;
  Real angle = b > a ? half_pi - arc_tangent(a / b) : arc_tangent(b / a);
  if (x < 0) angle = 2 * half_pi - angle;
  return y < 0 ? -angle : angle;
}

// Stirling's series, for z large enough to be as accurate as the rest, by Gamma(z + 1) = z Gamma(z).
Real gamma_of(Real x) {
  if (!(x >= 1)) return none;
  if (x > 172) return infinite;
  Real z = x, product = 1;
  for (; z < 24; z += 1)
    product *= z;
  const Real inverse = 1 / z, square = inverse * inverse;
  constexpr Real series[] = {1.0L / 12,   -1.0L / 360,      1.0L / 1260, -1.0L / 1680,
                             1.0L / 1188, -691.0L / 360360, 1.0L / 156};
  Real sum = 0;
  for (int n = 6; n >= 0; --n)
    sum = series[n] + square * sum;
  return exp_of((z - 0.5L) * log_of(z) - z + half_log_2pi + inverse * sum) / product;
}

} // namespace

double exp(double x) {
  return static_cast<double>(exp_of(x));
}

double log(double x) {
  return static_cast<double>(log_of(x));
}

double pow(double x, double y) {
  if (y == 0) return 1;
  return static_cast<double>(exp_of(y * log_of(x)));
}

double sin(double angle) {
  return static_cast<double>(sine_cosine(angle).sine);
}

double cos(double angle) {
  return static_cast<double>(sine_cosine(angle).cosine);
}

double tan(double angle) {
  const SineCosine of = sine_cosine(angle);
  return static_cast<double>(of.sine / of.cosine);
}

double acos(double x) {
  if (!(std::abs(x) <= 1)) return static_cast<double>(none);
  const Real c = x;
  return static_cast<double>(angle_of(std::sqrt((1 - c) * (1 + c)), c));
}

double atan2(double y, double x) {
  return static_cast<double>(angle_of(y, x));
}

double gamma(double x) {
  return static_cast<double>(gamma_of(x));
}

} // namespace platen::portable
