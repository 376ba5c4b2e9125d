// What the bonded network alone says of its elastic moduli, before anything is loaded.
#pragma once

#include "dem/bonds.h"
#include "dem/particles.h"

namespace platen::dem {

struct NetworkModuli {
  double young_voigt = 0, poisson_voigt = 0; // affine motion: an upper bound on E; Pa, 1
  double young_reuss = 0, poisson_reuss = 0; // static: an estimate, not a bound
};

// Isotropic network, sum over bonds of l^2 k_n / V = K, k = k_s/k_n: Voigt E = (K/3)(2 + 3k)/(4 + k),
// nu = (1 - k)/(4 + k); Reuss E = (K/3) 5k/(2 + 3k), nu = (1 - k)/(2 + 3k). `volume` of the specimen, m^3.
NetworkModuli network_moduli(const Bonds &bonds, double volume);

} // namespace platen::dem
