// An isotropic elastic material, or metal that yields.
#pragma once

#include <optional>
#include <string>

#include "base/require.h"
#include "fem/materials/j2_plasticity.h"

namespace platen::fem {

struct Material {
  double density;                          // kg/m^3, positive
  double young_modulus;                    // Pa, positive
  double poisson_ratio;                    // 1, between -1 and 1/2
  std::optional<Hardening> hardening = {}; // none: elastic
};

// Throws std::invalid_argument "WHO: ..." where a constant is out of range or NaN.
inline void check(const Material &material, const std::string &who) {
  require(material.density > 0, who + ": density must be positive");
  require(material.young_modulus > 0, who + ": Young's modulus must be positive");
  require(material.poisson_ratio > -1 && material.poisson_ratio < 0.5,
          who + ": Poisson ratio must lie in (-1, 0.5)");
  if (material.hardening) material.hardening->require_valid();
}

// Lame's constants lambda and mu (Pa).
struct Lame {
  double lambda, mu;
};
inline Lame lame(const Material &material) {
  const double e = material.young_modulus, nu = material.poisson_ratio;
  return {e * nu / ((1 + nu) * (1 - 2 * nu)), e / (2 * (1 + nu))};
}

} // namespace platen::fem
