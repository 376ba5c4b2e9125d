// Mean stress and strain in a part of a specimen, for the moduli of what fills it.
#pragma once

#include <array>
#include <vector>

#include "dem/bonds.h"
#include "dem/packing/specimen.h"
#include "dem/particles.h"

namespace platen::dem {

// A box or cylinder about the z axis, its lower end at `bottom` (m).
struct Region {
  Shape shape;
  double bottom = 0;
  bool holds(const Vector3 &point) const;
  // Share of the way from `from` to `to` that lies inside.
  double share_inside(const Vector3 &from, const Vector3 &to) const;
};

using Tensor = std::array<std::array<double, 3>, 3>;

// (1/V) sum over bonds of (the part of their length inside) (x) force, symmetric part, Pa, tension positive:
// the exact mean stress of forces that run along straight lines from centre to centre, so that no packing
// fraction enters. For small motion (m, rad, one row per particle) from where bonds were made.
Tensor mean_stress(const Region &region, const Particles &particles, const Bonds &bonds,
                   const std::vector<Vector3> &displacement, const std::vector<Vector3> &turn);

// Symmetric part of the best-fit gradient of displacement on reference position over the particles with their
// centres inside; not numbers where they are too few. `counted` says of each row whether it is looked at, for
// loose spheres stay behind; empty: all are.
Tensor mean_strain(const Region &region, const Particles &particles, const std::vector<Vector3> &displacement,
                   const std::vector<char> &counted = {});

// Isotropic moduli that are nearest to six pairs of strain and stress that span all strains: stiffness C from
// stress = C strain, then its mean over all directions (Voigt). `anisotropy`: largest difference of a
// component of C from the isotropic one, over the largest component. All NaN where strains are not
// independent.
struct Moduli {
  double youngs = 0, poisson = 0; // Pa, 1
  double anisotropy = 0;
};
Moduli isotropic_moduli(const std::array<Tensor, 6> &strain, const std::array<Tensor, 6> &stress);

} // namespace platen::dem
