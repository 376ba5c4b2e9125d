// A specimen under a small static compression between its platens: elastic moduli from a few linear solves
// instead of a hundred thousand steps.
#pragma once

#include "coupling/platen_test.h"
#include "dem/equilibrium.h"

namespace platen::coupling {

struct StaticPress {
  double stress = 0;         // Pa, mean of both platens over the nominal area, compression positive
  double strain_platen = 0;  // closure over the height
  double strain_gauge = 0;   // axial, of the middle half, compression positive
  double lateral_strain = 0; // of the middle half, extension positive
  double platen_modulus() const { return stress / strain_platen; } // Pa
  double youngs_modulus() const { return stress / strain_gauge; }  // Pa
  double poisson_ratio() const { return lateral_strain / strain_gauge; }
  std::size_t closed_top = 0, closed_bottom = 0; // spheres that the platens press
  int solves = 0, iterations = 0;                // for the set of contacts; of conjugate gradients in all
  std::vector<Vector3> displacement, turn;       // m, rad; of every particle; no turns without rotation
};

// Closes the platens by `strain` (positive) of the height on the intact network in its present state, which
// is not changed. A sphere that its platen touches now, or reaches during the closure, presses and, where
// there is friction, sticks; one in tension is released, until no sphere changes. Linear otherwise: stress is
// proportional to strain only where the set of contacts does not change. Glued ends carry tension too. Throws
// NumericsStopped where the set does not settle or no equilibrium is found.
StaticPress press_statically(PlatenTest &test, double strain, const dem::StaticSettings &settings = {});

// The same, and carries a test that has made no step to that strain (Experiment::carry): an explicit run
// begins there, at rest. Friction, if any, then has its part of slip. Also throws BadSetup.
StaticPress start_statically(PlatenTest &test, double strain, const dem::StaticSettings &settings = {});

} // namespace platen::coupling
