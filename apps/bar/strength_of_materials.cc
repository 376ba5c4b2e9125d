#include "apps/bar/strength_of_materials.h"

#include <algorithm>
#include <cmath>

#include "base/pi.h"

namespace platen::apps {
namespace {

constexpr double first_root = 1.875104068711961; // of cos x cosh x = -1

// The frequency equation of Timoshenko's beam, clamped and free (Huang 1961, J. Appl. Mech. 28:579), below
// the cut-off b r s = 1. b^2 = m l^4 omega^2 / E I, r^2 and s^2 of inertia of rotation and shear.
double clamped_free(double b, double r2, double s2) {
  const double b2 = b * b, split = std::sqrt((r2 - s2) * (r2 - s2) + 4 / b2);
  const double alpha = std::sqrt(0.5 * (split - r2 - s2)), beta = std::sqrt(0.5 * (split + r2 + s2));
  const double difference = r2 - s2;
  return 2 + (b2 * difference * difference + 2) * std::cosh(b * alpha) * std::cos(b * beta) -
         b * (r2 + s2) / std::sqrt(1 - b2 * r2 * s2) * std::sinh(b * alpha) * std::sin(b * beta);
}

} // namespace

double CrossSection::second_moment(bool along_x) const {
  if (round) return 0.25 * pi * radius * radius * radius * radius;
  const double depth = along_x ? width_x : width_y, width = along_x ? width_y : width_x;
  return width * depth * depth * depth / 12;
}

double CrossSection::torsion_constant() const {
  if (round) return polar_moment();
  const double a = std::max(width_x, width_y), b = std::min(width_x, width_y);
  double sum = 0; // Timoshenko and Goodier, Theory of Elasticity, art. 109
  for (int n = 39; n > 0; n -= 2)
    sum += std::tanh(0.5 * n * pi * a / b) / std::pow(n, 5);
  return a * b * b * b * (1.0 / 3 - 64 / std::pow(pi, 5) * (b / a) * sum);
}

CrossSection section_of_gyration(bool round, double xx, double yy) {
  if (round) return {true, std::sqrt(2 * (xx + yy)), 0, 0};
  return {false, 0, std::sqrt(12 * xx), std::sqrt(12 * yy)};
}

double Rod::load_of_strain(BarLoad load, double strain) const {
  const double skin = section.skin(along_x);
  if (load == BarLoad::tension) return strain * axial_rigidity;
  if (load == BarLoad::bending) return strain * bending_rigidity() / (skin * length);
  return strain * torsion_rigidity() / skin;
}

double Rod::response(BarLoad load, double size) const {
  if (load == BarLoad::tension) return size * length / axial_rigidity;
  if (load == BarLoad::bending)
    return size * length * length * length / (3 * bending_rigidity()) + size * length / shear_rigidity();
  return size * length / torsion_rigidity();
}

double Rod::frequency(BarLoad load) const {
  if (load == BarLoad::tension) return wave_speed() / (4 * length);
  if (load == BarLoad::bending) return bending_frequency();
  const double inertia = mass_per_length * mass_section.polar_moment() / mass_section.area();
  return std::sqrt(torsion_rigidity() / inertia) / (4 * length);
}

double Rod::bending_frequency() const {
  const double l2 = length * length;
  const double r2 = mass_section.second_moment(along_x) / mass_section.area() / l2,
               s2 = bending_rigidity() / (shear_rigidity() * l2);
  // Both slow the beam down: the root lies below that of Euler and Bernoulli, and the function changes its
  // sign once on the way up.
  double low = 1e-3, high = std::min(first_root * first_root, 0.999 / std::sqrt(r2 * s2));
  const double sign = clamped_free(low, r2, s2);
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    (clamped_free(middle, r2, s2) * sign > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high) / (2 * pi * l2) * std::sqrt(bending_rigidity() / mass_per_length);
}

} // namespace platen::apps
