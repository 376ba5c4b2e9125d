#include "dem/measure/moduli.h"

namespace platen::dem {

NetworkModuli network_moduli(const Bonds &bonds, double volume) {
  constexpr double pi = 3.14159265358979323846;
  double sum = 0;
  for (std::size_t k = 0; k < bonds.size(); ++k) {
    const double rb = bonds.bond_radius[k], l = bonds.rest_length[k];
    sum += l * l * bonds.normal_stiffness[k] * pi * rb * rb;
  }
  const double stiffness = sum / volume, k = bonds.law.parameters.stiffness_ratio;
  return {stiffness / 3 * (2 + 3 * k) / (4 + k), (1 - k) / (4 + k), stiffness / 3 * 5 * k / (2 + 3 * k),
          (1 - k) / (2 + 3 * k)};
}

} // namespace platen::dem
