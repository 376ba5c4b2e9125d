// Stress of the neo-Hookean law at one point with its own J in both parts. F must not be inverted.
#pragma once

#include "fem/materials/neo_hookean.h"

namespace platen::fem {

// Kirchhoff's, Pa; over J it is Cauchy's.
inline Tensor kirchhoff(const NeoHookean &law, const Tensor &f) {
  const double j = determinant(f), shape = law.shape_factor(j), third = squared_norm(f) / 3;
  Tensor tau{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const double b = f[3 * i] * f[3 * k] + f[3 * i + 1] * f[3 * k + 1] + f[3 * i + 2] * f[3 * k + 2];
      tau[3 * i + k] = shape * (b - (i == k ? third : 0.0)) + (i == k ? j * law.volume_stress(j) : 0.0);
    }
  return tau;
}

} // namespace platen::fem
