// An isotropic elastic material.
#pragma once

#include <array>
#include <string>

namespace platen::fem {

struct Material {
  double density;       // kg/m^3, positive
  double young_modulus; // Pa, positive
  double poisson_ratio; // 1, between -1 and 1/2
};

// Throws std::invalid_argument "WHO: ..." where a constant is out of range or no number.
void check(const Material &material, const std::string &who);

// Lame's constants lambda and mu (Pa).
struct Lame {
  double lambda, mu;
};
Lame lame(const Material &material);

} // namespace platen::fem
