// The stiffness of a bonded network, in displacements (m) and, where particles turn, rotations times the
// radius.
#pragma once

#include "dem/bonds.h"
#include "dem/particles.h"
#include "dem/stable_step.h"
#include "dem/statics/block_product.h"

namespace platen::dem::statics {

// Stiffness of all bonds in their present directions, with these stiffnesses of their rows and without the
// effect of their present forces. Every particle has its diagonal block.
template <int n>
BlockMatrix<n, double> assemble(const Particles &particles, const Bonds &bonds,
                                const std::vector<BondStiffness> &of_rows);
// N/m, N m, for each row at rest.
std::vector<BondStiffness> at_rest(const Bonds &bonds);

// Stiffness of a spring to a body; n x n by columns.
template <int n>
void add_support(const Particles &particles, const GroundSpring &spring, double *block);
// The forces (torques over the radius) on the particle by the displacement of the body.
template <int n>
void add_support_load(const Particles &particles, const GroundSpring &spring, const Vector3 &moved,
                      double *load);

} // namespace platen::dem::statics
