#include "apps/bonds/interface_rig.h"

#include <algorithm>

#include "apps/bonds/bond_rig.h"
#include "base/pi.h"
#include "dem/packing/specimen.h"

namespace platen::apps {
namespace {

constexpr double step = 1; // s; places are led to, so that no time enters what the bond does

// Dashpots would act at speeds that mean nothing here.
dem::ModelSettings led_settings(const Scene &scene, double modulus) {
  dem::ModelSettings settings = rig_settings(scene, modulus, 0);
  settings.bond_dashpot = 0;
  return settings;
}

InterfaceSection section_of(const dem::Bonds &bonds, double modulus) {
  const double radius = bonds.bond_radius[0];
  return {std::get<dem::ElastoDamagePlastic>(bonds.law), bonds.rest_length[0], pi * radius * radius, modulus};
}

} // namespace

InterfaceRig::InterfaceRig(const Scene &scene, double modulus)
    : model_(touching_spheres(scene), led_settings(scene, modulus)),
      section_(section_of(*model_.bonds, modulus)) {
  const dem::Particles &p = model_.particles;
  (p.id[0] == 0 ? lower_ : upper_) = 1; // sphere 0 of the specimen is the upper one
}

void InterfaceRig::go(const InterfacePlace &to) {
  dem::Particles &p = model_.particles;
  const double here = p.position[upper_].z - p.position[lower_].z;
  const double distance = section_.length + to.opening;
  p.velocity[upper_] = {0, 0, (distance - here) / step};
  if (p.has_rotation())
    for (Vector3 &spin : *p.angular_velocity)
      spin = {0, -(to.slip - at_.slip) / (distance * step), 0};
  model_.begin_step(step);
  model_.compute_forces(step);
  const Vector3 held = p.force[upper_];
  const InterfaceLoad before = now_;
  now_ = {0 - held.z, 0 - held.x};
  work_ += 0.5 * ((before.normal + now_.normal) * (to.opening - at_.opening) +
                  (before.shear + now_.shear) * (to.slip - at_.slip));
  at_ = to;
  ++steps_;
  // At rest again, and free of loads: the next step begins by half a kick.
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.velocity[i] = p.force[i] = {};
    if (p.has_rotation()) (*p.angular_velocity)[i] = (*p.torque)[i] = {};
  }
}

InterfaceReading InterfaceRig::read() const {
  const dem::Bonds &b = *model_.bonds;
  const dem::BondResponse<double> response = b.response(0, model_.particles);
  const dem::BondTotals totals = b.interface_totals(model_.particles);
  InterfaceReading r;
  r.load = now_;
  r.tension_ratio = response.tension_ratio;
  r.shear_ratio = response.shear_ratio;
  r.tension_damage = (*b.tension_damage)[0];
  r.shear_damage = (*b.shear_damage)[0];
  r.plastic_closing = (*b.plastic)[0] / section_.normal_stiffness();
  r.work = work_;
  r.stored = totals.energy;
  r.dissipated = model_.works.fracture + totals.damage + totals.friction + totals.plastic;
  r.intact = static_cast<int>(model_.intact_bonds());
  return r;
}

} // namespace platen::apps
