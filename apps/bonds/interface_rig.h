// Leads two spheres that an elasto-damage-plastic bond joins, from place to place without inertia: what such
// a bond remembers is the path that the test states, not the swings of free spheres. The bond itself is the
// model's own, brought on by its kernels.
#pragma once

#include "apps/bonds/interface_forms.h"
#include "apps/scene/scene.h"
#include "dem/model.h"

namespace platen::apps {

// Of the one bond, as it stands.
struct InterfaceReading {
  InterfaceLoad load;                          // N, that holds the driven sphere
  double tension_ratio = 0, shear_ratio = 0;   // elastic stress over strength
  double tension_damage = 0, shear_damage = 0; // 1
  double plastic_closing = 0;                  // m, that stays when it is unloaded
  double work = 0, stored = 0, dissipated = 0; // J; work by the trapezoid between places
  int intact = 0;
};

class InterfaceRig {
public:
  // Throws InputError where this build leaves out what the scene asks for.
  InterfaceRig(const Scene &scene, double modulus);

  // Moves the upper sphere along the line of centres, and turns both about the same axis so that their
  // surfaces slide on each other by the slip at a distance that stays.
  void go(const InterfacePlace &to);
  InterfaceReading read() const;

  const InterfaceSection &section() const { return section_; }
  dem::Model &model() { return model_; }
  long steps() const { return steps_; }

private:
  dem::Model model_;
  InterfaceSection section_;
  std::size_t upper_ = 0, lower_ = 0; // rows
  InterfacePlace at_;
  InterfaceLoad now_;
  double work_ = 0;
  long steps_ = 0;
};

} // namespace platen::apps
