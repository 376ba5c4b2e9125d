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

double Section::area() const {
  return round ? pi * radius * radius : width_x * width_y;
}

double Section::second_moment(bool along_x) const {
  if (round) return 0.25 * pi * radius * radius * radius * radius;
  const double depth = along_x ? width_x : width_y, width = along_x ? width_y : width_x;
  return width * depth * depth * depth / 12;
}

double Section::polar_moment() const {
  return second_moment(true) + second_moment(false);
}

double Section::torsion_constant() const {
  if (round) return polar_moment();
  const double a = std::max(width_x, width_y), b = std::min(width_x, width_y);
  double sum = 0; // Timoshenko and Goodier, Theory of Elasticity, art. 109
  for (int n = 39; n > 0; n -= 2)
    sum += std::tanh(0.5 * n * pi * a / b) / std::pow(n, 5);
  return a * b * b * b * (1.0 / 3 - 64 / std::pow(pi, 5) * (b / a) * sum);
}

double Section::skin(bool along_x) const {
  return round ? radius : 0.5 * (along_x ? width_x : width_y);
}

double Section::shear_factor(double nu) const {
  return round ? 6 * (1 + nu) / (7 + 6 * nu) : 10 * (1 + nu) / (12 + 11 * nu);
}

Section section_of_gyration(bool round, double xx, double yy) {
  if (round) return {true, std::sqrt(2 * (xx + yy)), 0, 0};
  return {false, 0, std::sqrt(12 * xx), std::sqrt(12 * yy)};
}

double Rod::bending_rigidity() const {
  return axial_rigidity * section.second_moment(along_x) / section.area();
}
double Rod::shear_rigidity() const {
  return section.shear_factor(poisson_ratio) * axial_rigidity / (2 * (1 + poisson_ratio));
}
double Rod::torsion_rigidity() const {
  return axial_rigidity / (2 * (1 + poisson_ratio)) * section.torsion_constant() / section.area();
}

double Rod::stretch(double force) const {
  return force * length / axial_rigidity;
}
double Rod::deflection(double force) const {
  return force * length * length * length / (3 * bending_rigidity());
}
double Rod::deflection_with_shear(double force) const {
  return deflection(force) + force * length / shear_rigidity();
}
double Rod::twist(double torque) const {
  return torque * length / torsion_rigidity();
}

double Rod::axial_frequency() const {
  return wave_speed() / (4 * length);
}
double Rod::bending_frequency() const {
  return first_root * first_root / (2 * pi * length * length) *
         std::sqrt(bending_rigidity() / mass_per_length);
}
double Rod::bending_frequency_with_shear() const {
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
double Rod::torsion_frequency() const {
  const double inertia = mass_per_length * mass_section.polar_moment() / mass_section.area();
  return std::sqrt(torsion_rigidity() / inertia) / (4 * length);
}
double Rod::wave_speed() const {
  return std::sqrt(axial_rigidity / mass_per_length);
}

} // namespace platen::apps
