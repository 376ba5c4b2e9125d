// The settings of a sleeve of rubber, a tube of metal or a wrap of fibres (coupling/boundaries/sleeve.h).
#pragma once

#include <optional>

#include "base/describe.h"
#include "coupling/contact/contact_layer.h"
#include "coupling/metal_settings.h"
#include "coupling/wrap_settings.h"

namespace platen::coupling {

struct SleeveSettings {
  double thickness = 3e-3;       // m
  double young_modulus = 1.5e6;  // Pa, of the unstrained rubber
  double poisson_ratio = 0.4995; // 1
  double density = 1100;         // kg/m^3
  // Around 0: faces five mean radii wide, to bridge the gaps between spheres; along 0: as long as wide.
  int elements_around = 0, elements_along = 0, elements_through = 1;
  bool bonded_rims = true;            // fixed to the platens' rims; else they slide along them
  std::optional<MetalSettings> metal; // a tube that yields
  std::optional<WrapSettings> wrap;   // of the hoop modulus `young_modulus`; neither: rubber
  double gap = 0;                     // m, between its inner face and the specimen
  // m, by which each end stands off its platen: it is free then; 0: platens hold the ends.
  double clearance = 0;
  // m, by which each end of the specimen stands off its platen, so that the sleeve alone is loaded. With a
  // clearance too, that is of the upper ends and this of the lower ones: the specimen is pushed out.
  double recess = 0;
  // Of its contacts, multiple of the mean bond's; 0: computed from a cell's pressure, else 1.
  double stiffness = 0;
  double seat_layer = 1; // mean radii: spheres up to this depth are seated flush with its inner face
  // Of the sleeve alone; its inertia has hardly any effect. 0: chosen for a cheap run, once the time step of
  // the particles is known; 1 until then.
  double mass_scaling = 0;
  double mass_damping = 1000;           // 1/s, decay rate of its velocities
  double safety = 0.5;                  // interval over its limit
  int most_steps = 200;                 // of the particles in an interval
  double seat_depth = 0;                // m, the same; 0: none. Of tests by the seat layer
  SurfaceContact contact = of_rubber(); // of its inner face with the particles

  static SurfaceContact of_rubber() {
    SurfaceContact contact;
    contact.friction_static = 0.5;
    contact.damping = 0.2;
    return contact;
  }

  static constexpr const char *name = "sleeve";
  template <class Visitor, class Self>
  static void describe(Visitor &&v, Self &p);
};

template <class Visitor, class Self>
void SleeveSettings::describe(Visitor &&v, Self &p) {
  v("thickness", p.thickness, "m", above(0), "Wall of the sleeve (Confinement = sleeve).");
  v("young_modulus", p.young_modulus, "Pa", above(0),
    "Young modulus of the unstrained wall; of a wrap along the hoop.");
  v("poisson_ratio", p.poisson_ratio, "1", from_to_below(0, 0.5),
    "Poisson ratio of the unstrained wall, of the resin of a wrap. Of rubber: the nearer to one half, the "
    "less the pressure squeezes it and the shorter its steps.");
  v("density", p.density, "kg/m3", above(0), "Density of the wall.");
  v("bonded_rims", p.bonded_rims, Words<bool>{{"bonded", true}, {"sliding", false}},
    "How the ends go with the platens: held on all sides, or along the axis alone.");
  v("elements_around", p.elements_around, between(0, 10000),
    "Finite elements around the sleeve, and along it as wide; 0: five mean radii wide. Faces have to bridge "
    "the gaps between the spheres of the skin.");
  v("elements_through", p.elements_through, between(1, 20), "The same through its wall.");
  v("friction", p.contact.friction_static, "1", between(0, 5), "Coefficient of friction of grains on it.");
  v("contact_damping", p.contact.damping, "1", between(0, 1),
    "Fraction of critical damping of grains on it.");
  v("gap", p.gap, "m", at_least(0), "Between the specimen and the inner face of a tube or wrap.");
  v("clearance", p.clearance, "m", at_least(0),
    "By which each end of a tube or wrap stands off its platen, so that the specimen alone is loaded; 0: "
    "platens press both together.");
  v("recess", p.recess, "m", at_least(0),
    "By which each end of the specimen stands off its platen, so that the tube alone is loaded; with a "
    "clearance too the specimen is pushed out: it stands off the lower platen, the tube off the upper one.");
  v("bond_strength", p.contact.bond.strength, "Pa", at_least(0),
    "Cohesion in shear of the spheres that lie flush with it, until it breaks; 0: they only rub.");
  v("bond_tension", p.contact.bond.tension, "Pa", above(0),
    "The same in tension; as in shear where not given.");
  v("bond_slip", p.contact.bond.slip, "m", at_least(0),
    "Slip, or opening, over which the bond falls to nothing in a straight line; 0: it breaks at once.");
  v("stiffness", p.stiffness, "1", between(0, 1000),
    "Penalty stiffness of grains on it, as a multiple of the mean bond's; 0: that of the bond for a tube or "
    "wrap; for rubber by the pressure, which then presses a sphere in by some 4 % of its radius.");
  v("seat_layer", p.seat_layer, "1", between(0, 10),
    "Grains whose surface lies no deeper, in mean radii, lie flush with it from the start.");
  v("mass_damping", p.mass_damping, "1", at_least(0), "Rate at which its own velocities die away, 1/s.");
  v("mass_scaling", p.mass_scaling, "1", at_least(0),
    "Factor on its mass, 1 or more; 0: such that it is stepped about once in eight steps, a tube or wrap "
    "once in four.");
}

} // namespace platen::coupling
