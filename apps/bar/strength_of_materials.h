// A prismatic bar by strength of materials: what the tests of platen-bar are held against. SI units.
#pragma once

namespace platen::apps {

// Round, or rectangular. Second moments as the strength of a section and (mass) as its inertia.
struct Section {
  bool round = true;
  double radius = 0;               // m, round
  double width_x = 0, width_y = 0; // m, rectangular

  double area() const;                      // m^2
  double second_moment(bool along_x) const; // m^4, of bending in the x direction, or in y
  double polar_moment() const;              // m^4
  // m^4: T = G J twist / length. Round: the polar moment; rectangular: Saint-Venant's series.
  double torsion_constant() const;
  double skin(bool along_x) const; // m, from the axis to the skin
  // Of shear in bending (Cowper 1966).
  double shear_factor(double poisson_ratio) const;
};
// With the same mean squares of x and y as a section of mean squares xx and yy (m^2).
Section section_of_gyration(bool round, double xx, double yy);

// A bar with its end at 0 clamped, the other one free. Its rigidities may rest on another section than its
// inertia of rotation.
struct Rod {
  double length = 0;          // m
  double axial_rigidity = 0;  // N, E A
  double poisson_ratio = 0;   // G = E / (2 (1 + nu))
  double mass_per_length = 0; // kg/m
  Section section;            // that carries forces
  Section mass_section;       // of inertia of rotation
  bool along_x = true;        // the way in which it is bent

  double bending_rigidity() const; // N m^2, E I
  double shear_rigidity() const;   // N, kappa G A
  double torsion_rigidity() const; // N m^2, G J

  double stretch(double force) const;               // m, of the free end under an axial force (N)
  double deflection(double force) const;            // m, across; Euler and Bernoulli
  double deflection_with_shear(double force) const; // m, Timoshenko
  double twist(double torque) const;                // rad

  // Lowest frequencies, 1/s.
  double axial_frequency() const;              // c / 4 l
  double bending_frequency() const;            // Euler and Bernoulli
  double bending_frequency_with_shear() const; // Timoshenko, shear and inertia of rotation
  double torsion_frequency() const;
  double wave_speed() const; // m/s, of long axial waves
};

} // namespace platen::apps
