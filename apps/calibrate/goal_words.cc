// What targets are called.
#include <fmt/format.h>

#include "apps/calibrate/calibrate_section.h"
#include "apps/calibrate/goals.h"

namespace platen::apps {

std::string key_of(TargetKind kind) {
  switch (kind) {
    case TargetKind::young_modulus:
      return "youngs_modulus_gauge_pa";
    case TargetKind::poisson_ratio:
      return "poisson_ratio";
    case TargetKind::strength:
      return "compressive_strength_pa";
    case TargetKind::strain_at_peak:
      return "strain_at_peak_platen";
    case TargetKind::tension:
      return "tensile_strength_pa";
    case TargetKind::splitting:
      return "splitting_strength_pa";
    case TargetKind::strength_at_pressure:
      return "triaxial_strength_pa";
    case TargetKind::gain_by_friction:
      return "gain_by_friction";
    case TargetKind::cube_over_prism:
      return "cube_over_prism";
    case TargetKind::slenderness:
      return "strength_over_slender";
    case TargetKind::secant_ratio:
      return "secant_poisson_ratio";
    default:
      return "curve_miss";
  }
}

std::string words_of(const Target &t) {
  std::string text;
  switch (t.kind) {
    case TargetKind::young_modulus:
      return "Young's modulus, GPa";
    case TargetKind::poisson_ratio:
      return "Poisson's ratio";
    case TargetKind::strength:
      text = "compressive strength, MPa";
      break;
    case TargetKind::strain_at_peak:
      text = "strain at peak, mm/m";
      break;
    case TargetKind::tension:
      return "tensile strength, MPa";
    case TargetKind::splitting:
      text = "splitting strength, MPa";
      break;
    case TargetKind::strength_at_pressure:
      text = fmt::format("strength at {:.4g} MPa, MPa", 1e-6 * t.pressure);
      break;
    case TargetKind::gain_by_friction:
      text = "gain by friction";
      break;
    case TargetKind::cube_over_prism:
      return "cube over prism";
    case TargetKind::slenderness:
      text = "strength over that at h/w 2";
      break;
    case TargetKind::secant_ratio:
      text = "Poisson's ratio to 40 % of the strength";
      break;
    default:
      text = "miss of the curve";
  }
  if (t.box) text += ", box";
  if (given(t.slenderness)) text += fmt::format(", h/w {:.3g}", t.slenderness);
  return text;
}

double unit_on_screen(TargetKind kind) {
  if (kind == TargetKind::young_modulus) return 1e9;
  if (kind == TargetKind::strain_at_peak) return 1e-3;
  const std::string key = key_of(kind), pascal = "_pa";
  return key.size() > pascal.size() && key.substr(key.size() - pascal.size()) == pascal ? 1e6 : 1;
}

} // namespace platen::apps
