// Hardening of structural steel from its yield and ultimate strength, in four lines of engineering stress and
// strain (Yun, Gardner: Stress-strain curves for hot-rolled steels, J. Constr. Steel Res. 133, 2017), as
// prEN 1993-1-14 has them:
//   (f_y/E, f_y), (e_sh, f_y), (C1 e_u, f_C1), (e_u, f_u)
//   e_sh = .1 f_y/f_u - .055 within .015 ... .03,   e_u = .6 (1 - f_y/f_u), at least .06
//   C1 = (e_sh + .25 (e_u - e_sh))/e_u,   C2 = (e_sh + .4 (e_u - e_sh))/e_u
//   f_C1 = f_y + (C1 e_u - e_sh) (f_u - f_y)/(C2 e_u - e_sh)
// turned into true stress f (1 + e) over true plastic strain ln(1 + e) - f (1 + e)/E.
#pragma once

#include <algorithm>

#include "base/portable.h"
#include "fem/materials/j2_plasticity.h"

namespace platen::fem {

// Pa; f_u >= f_y. Constant beyond e_u.
inline Hardening structural_steel(double yield_strength, double ultimate_strength, double young_modulus) {
  const double ratio = yield_strength / ultimate_strength;
  const double plateau = std::clamp(0.1 * ratio - 0.055, 0.015, 0.03),
               last = std::max(0.6 * (1 - ratio), 0.06);
  const double kink = plateau + 0.25 * (last - plateau), slope_to = plateau + 0.4 * (last - plateau);
  const double at_kink =
      yield_strength + (kink - plateau) * (ultimate_strength - yield_strength) / (slope_to - plateau);
  Hardening hardening;
  hardening.points[0] = {0, yield_strength};
  hardening.count = 1;
  for (const auto &[strain, stress] :
       {std::pair{plateau, yield_strength}, {kink, at_kink}, {last, ultimate_strength}}) {
    const double true_stress = stress * (1 + strain);
    hardening.points[hardening.count++] = {portable::log(1 + strain) - true_stress / young_modulus,
                                           true_stress};
  }
  return hardening;
}

} // namespace platen::fem
