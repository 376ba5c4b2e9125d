// A prismatic bar by strength of materials: the sizes of loads, and what platen-bar compares its tests with.
// SI units.
#pragma once

#include <cmath>

#include "apps/bar/bar_section.h"
#include "base/pi.h"

namespace platen::apps {

// Round, or rectangular. Second moments as the strength of a section and (mass) as its inertia.
struct CrossSection {
  bool round = true;
  double radius = 0;               // m, round
  double width_x = 0, width_y = 0; // m, rectangular

  double area() const { return round ? pi * radius * radius : width_x * width_y; } // m^2
  double second_moment(bool along_x) const; // m^4, of bending in the x direction, or in y
  double polar_moment() const { return second_moment(true) + second_moment(false); } // m^4
  // m^4: T = G J twist / length. Round: the polar moment; rectangular: Saint-Venant's series.
  double torsion_constant() const;
  // m, from the axis to the skin
  double skin(bool along_x) const { return round ? radius : 0.5 * (along_x ? width_x : width_y); }
  // Of shear in bending (Cowper 1966).
  double shear_factor(double nu) const {
    return round ? 6 * (1 + nu) / (7 + 6 * nu) : 10 * (1 + nu) / (12 + 11 * nu);
  }
};
// With the same mean squares of x and y as a section of mean squares xx and yy (m^2).
CrossSection section_of_gyration(bool round, double xx, double yy);

// A bar with its end at 0 clamped, the other one free. Its rigidities may rest on another section than its
// inertia of rotation.
struct Rod {
  double length = 0;          // m
  double axial_rigidity = 0;  // N, E A
  double poisson_ratio = 0;   // G = E / (2 (1 + nu))
  double mass_per_length = 0; // kg/m
  CrossSection section;       // that carries forces
  CrossSection mass_section;  // of inertia of rotation
  bool along_x = true;        // the direction in which it is bent

  // E I, N m^2; kappa G A, N; G J, N m^2.
  double bending_rigidity() const { return axial_rigidity * section.second_moment(along_x) / section.area(); }
  double shear_rigidity() const {
    return section.shear_factor(poisson_ratio) * axial_rigidity / (2 * (1 + poisson_ratio));
  }
  double torsion_rigidity() const {
    return axial_rigidity / (2 * (1 + poisson_ratio)) * section.torsion_constant() / section.area();
  }

  // Of long axial waves, m/s.
  double wave_speed() const { return std::sqrt(axial_rigidity / mass_per_length); }

  // Of tension, bending and torsion: the load (N, N m) that strains the skin at the clamp so much; how far
  // the free end moves along a load (m, rad); the lowest frequency (1/s). Bending is Timoshenko's, with shear
  // and inertia of rotation.
  double load_of_strain(BarLoad load, double strain) const;
  double response(BarLoad load, double size) const;
  double frequency(BarLoad load) const;

private:
  double bending_frequency() const;
};

} // namespace platen::apps
