// The neo-Hookean law of rubber at finite strain, split into a part of shape and a part of volume:
//   W(F) = mu/2 (J^(-2/3) tr F'F - 3) + U(J),   U(J) = kappa/2 ((J^2 - 1)/2 - ln J),   J = det F
// (Simo, Hughes: Computational Inelasticity, 1998, section 9.2). U grows without bound as J goes to 0 or
// infinity; for small strains the law is Hooke's with shear modulus mu and bulk modulus kappa. The two parts
// are separate because the element takes J at its points for the first and its mean for the second.
#pragma once

#include <array>
#include <cmath>
#include <stdexcept>

#include "base/portable.h"

namespace platen::fem {

using Tensor = std::array<double, 9>; // 3 x 3, row by row

constexpr Tensor identity_tensor = {1, 0, 0, 0, 1, 0, 0, 0, 1};

// Cofactors: the derivative of det F by F, det F times the inverse transposed. Defined for any F.
inline Tensor cofactor(const Tensor &f) {
  return {f[4] * f[8] - f[5] * f[7], f[5] * f[6] - f[3] * f[8], f[3] * f[7] - f[4] * f[6],
          f[2] * f[7] - f[1] * f[8], f[0] * f[8] - f[2] * f[6], f[1] * f[6] - f[0] * f[7],
          f[1] * f[5] - f[2] * f[4], f[2] * f[3] - f[0] * f[5], f[0] * f[4] - f[1] * f[3]};
}
inline double determinant(const Tensor &f, const Tensor &cof) {
  return f[0] * cof[0] + f[1] * cof[1] + f[2] * cof[2];
}
inline double determinant(const Tensor &f) {
  return determinant(f, cofactor(f));
}
inline double squared_norm(const Tensor &f) {
  double sum = 0;
  for (const double x : f)
    sum += x * x;
  return sum;
}

// Volume ratio at which an element counts as inverted. Zero is the limit of the law; rubber never comes so
// close to it, and the next step would cross it.
constexpr double inverted_share = 0.01;

// Call it before the law is used: a ratio that is not larger than `inverted_share`, or NaN, is inverted.
inline bool is_inverted(double volume_ratio) {
  return !(volume_ratio > inverted_share);
}

struct NeoHookean {
  double shear_modulus; // Pa, mu
  double bulk_modulus;  // Pa, kappa

  // Both throw std::invalid_argument where a constant is out of range. Young's modulus in Pa, Poisson ratio
  // between -1 and 1/2: .4995 is a bulk modulus of 1000 shear moduli.
  static NeoHookean from_moduli(double shear_modulus, double bulk_modulus) {
    if (!(shear_modulus > 0) || !(bulk_modulus > 0) || std::isinf(shear_modulus) || std::isinf(bulk_modulus))
      throw std::invalid_argument("neo-Hookean law: shear and bulk modulus must be positive");
    return {shear_modulus, bulk_modulus};
  }
  static NeoHookean from_young(double young_modulus, double poisson_ratio) {
    if (!(young_modulus > 0) || std::isinf(young_modulus))
      throw std::invalid_argument("neo-Hookean law: Young's modulus must be positive");
    if (!(poisson_ratio > -1 && poisson_ratio < 0.5))
      throw std::invalid_argument("neo-Hookean law: Poisson ratio must lie in (-1, 0.5)");
    return from_moduli(young_modulus / (2 * (1 + poisson_ratio)),
                       young_modulus / (3 * (1 - 2 * poisson_ratio)));
  }

  // J^(-2/3) mu: the factor of F in the shape stress.
  double shape_factor(double j) const {
    const double root = std::cbrt(j);
    return shear_modulus / (root * root);
  }
  double volume_energy(double j) const { // J/m^3
    return 0.5 * bulk_modulus * (0.5 * (j * j - 1) - portable::log(j));
  }
  double volume_stress(double j) const { return 0.5 * bulk_modulus * (j - 1 / j); }        // Pa, U'(J)
  double volume_modulus(double j) const { return 0.5 * bulk_modulus * (1 + 1 / (j * j)); } // Pa, U''(J)
};

} // namespace platen::fem
