#include "apps/bar/run_bar.h"

namespace platen::apps {

Rod BarResults::rod(bool effective) const {
  Rod rod =
      rod_at_rest(bar, pulled.axial_rigidity, pulled.poisson_ratio, effective ? bar.effective : bar.bounding);
  if (!effective) rod.mass_section = bar.bounding;
  return rod;
}

Rod BarResults::swinging_rod(bool effective) const {
  Rod swinging = rod(effective);
  swinging.length = bar.top - bar.low.z;
  return swinging;
}

const char *word(BarLoad load) {
  constexpr const char *words[] = {"all", "tension", "bending", "torsion", "impact", "none"};
  return words[static_cast<int>(load)];
}

} // namespace platen::apps
