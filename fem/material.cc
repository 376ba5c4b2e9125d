#include "fem/material.h"

#include <stdexcept>

namespace platen::fem {

void check(const Material &material, const std::string &who) {
  const auto require = [&](bool holds, const char *what) {
    if (!holds) throw std::invalid_argument(who + ": " + what);
  };
  require(material.density > 0, "density must be positive");
  require(material.young_modulus > 0, "Young's modulus must be positive");
  require(material.poisson_ratio > -1 && material.poisson_ratio < 0.5, "Poisson ratio must lie in (-1, 0.5)");
}

Lame lame(const Material &material) {
  const double e = material.young_modulus, nu = material.poisson_ratio;
  return {e * nu / ((1 + nu) * (1 - 2 * nu)), e / (2 * (1 + nu))};
}

} // namespace platen::fem
