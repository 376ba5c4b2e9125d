// A wrap of fibres in resin around a specimen (fem/materials/fibres.h): layers in the hoop direction, whose
// last turn laps over its own beginning.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/describe.h"
#include "base/pi.h"
#include "base/portable.h"
#include "fem/materials/fibres.h"

namespace platen::coupling {

struct WrapSettings {
  double axial_modulus = 0;          // Pa, of the laminate along the axis; 0: that of the resin
  double resin_modulus = 3e9;        // Pa
  double rupture_strain = not_given; // 1, nominal, of the hoop
  int layers = 1;
  double overlap = 0; // m, along the hoop, from y = 0, x > 0 on

  // Of elements of this width (m) on this radius (m); `hoop_modulus`: Pa, of the laminate.
  fem::Fibres fibres(double hoop_modulus, double radius, double width) const {
    const double more = 1.0 / layers, lapped = overlap;
    const auto layout = [=](const Vector3 &middle) {
      const double r = std::hypot(middle.x, middle.y);
      double along = portable::atan2(middle.y, middle.x) * radius; // m, of the middle on the hoop
      if (along < 0) along += 2 * pi * radius;
      const double covered = std::min(lapped, along + 0.5 * width) - (along - 0.5 * width);
      return fem::FibreCell{{Vector3{-middle.y / r, middle.x / r, 0}, Vector3{0, 0, 1}},
                            1 + more * std::clamp(covered / width, 0.0, 1.0)};
    };
    return {
        {hoop_modulus - resin_modulus, std::max(axial_modulus - resin_modulus, 0.0)}, rupture_strain, layout};
  }

  static constexpr const char *name = "sleeve.wrap";
  template <class Visitor, class Self>
  static void describe(Visitor &&v, Self &p);
};

template <class Visitor, class Self>
void WrapSettings::describe(Visitor &&v, Self &p) {
  v("rupture_strain", p.rupture_strain, "1", above_up_to(0, 0.1),
    "Of a wrap: hoop strain at which an element of it tears. Wraps on concrete tear below the strain of "
    "coupons.");
  v("axial_modulus", p.axial_modulus, "Pa", at_least(0),
    "Young modulus of a wrap along the axis; 0: that of the resin, as of fibres around the hoop alone.");
  v("resin_modulus", p.resin_modulus, "Pa", above(0), "Young modulus of the resin between the fibres.");
  v("layers", p.layers, between(1, 100), "Layers in the thickness of the wrap.");
  v("overlap", p.overlap, "m", at_least(0),
    "Length of the hoop over which the last layer laps over the first: one layer more there.");
}

} // namespace platen::coupling
