#include "dem/measure/moduli.h"

namespace platen::dem {

NetworkModuli network_moduli(const Bonds &bonds, double volume) {
  // The mean ratio k = K_s / (k_n A) by differences from the first, which are round-off where a law has one
  // ratio.
  double axial = 0, difference = 0, first = 0;
  for (std::size_t row = 0; row < bonds.size(); ++row) {
    const double l = bonds.rest_length[row];
    const BondStiffness s = bonds.stiffness(row);
    if (s.axial == 0) continue;
    const double ratio = s.shear / s.axial;
    if (axial == 0) first = ratio;
    axial += l * l * s.axial;
    difference += l * l * s.axial * (ratio - first);
  }
  if (axial == 0) return {};
  const double stiffness = axial / volume, k = first + difference / axial;
  return {stiffness / 3 * (2 + 3 * k) / (4 + k), (1 - k) / (4 + k), stiffness / 3 * 5 * k / (2 + 3 * k),
          (1 - k) / (2 + 3 * k)};
}

} // namespace platen::dem
