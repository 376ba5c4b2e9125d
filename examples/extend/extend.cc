// Crushes a small cylinder bare, in a jacket and with bonds that break by their energy, and loads another in
// cycles of stress: a boundary, a measure, a bond law and a loading stage that are not part of the library.
// Ends with 1 where they do not do what they are for.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include <base/state.h>
#include <coupling/platen_test.h>
#include <dem/packing/growth.h>

#include "crack_height.h"
#include "energy_bond.h"
#include "jacket.h"
#include "stress_cycles.h"

using namespace platen;

namespace {

coupling::PlatenTestSettings concrete() {
  coupling::PlatenTestSettings settings;
  settings.model.bond_layout.modulus = 36e9; // Pa
  dem::ParallelBond::Parameters bond;
  bond.tensile_strength = 9.5e6; // Pa
  bond.shear_strength = 26.6e6;
  bond.friction_angle = 0.7854; // 45 degrees
  bond.moment_contribution = 0.3;
  settings.model.bond = bond;
  settings.model.contact = dem::ContactSettings{};
  settings.ends = coupling::Ends::ground;
  settings.end_layer = 0.3;
  settings.platens.thickness = 2e-3; // m
  settings.loading.rate = 0.05;      // m/s
  settings.loading.target_strain = 0.006;
  return settings;
}

struct Crushed {
  double strength = 0, pressure = 0; // Pa, largest
  double cracks = 0, residual = 0;   // 1
};

Crushed crush(coupling::PlatenTest &test) {
  Crushed result;
  while (!test.program().finished()) {
    test.advance(16);
    test.model.take_cracks();
    result.strength = std::max(result.strength, test.axial_stress());
    result.pressure = std::max(result.pressure, test.confining_pressure());
  }
  result.cracks = mean_crack_height(test.model.particles, *test.model.bonds, test.shape());
  const dem::EnergyLedger energy = test.energy();
  result.residual = std::abs(energy.residual()) / energy.boundary;
  return result;
}

bool check(bool holds, const char *what) {
  if (!holds) std::printf("does not hold: %s\n", what);
  return holds;
}

} // namespace

int main() {
  const dem::Specimen specimen = dem::random_close_packing(dem::cylinder(5e-3, 10e-3), 0.8e-3, 0.25, 1);

  // A boundary: added to those that the settings of a test make.
  coupling::PlatenTestSettings settings = concrete();
  coupling::PlatenTest bare(specimen, settings);
  settings.boundaries.push_back([](const coupling::PlatenTest &test) -> std::unique_ptr<coupling::Boundary> {
    return std::make_unique<Jacket>(test.model.particles, test.shape(), Jacket::Parameters{200e9, 0.1e-3});
  });
  coupling::PlatenTest jacketed(specimen, settings);
  const Crushed one = crush(bare), other = crush(jacketed);
  std::printf(
      "bare %.1f MPa, in a jacket %.1f MPa at up to %.1f MPa of pressure; cracks at %.2f and %.2f of "
      "the height; energy balance closes to %.1e\n",
      1e-6 * one.strength, 1e-6 * other.strength, 1e-6 * other.pressure, one.cracks, other.cracks,
      other.residual);

  // A bond law: in place of one of the library.
  settings = concrete();
  settings.model.bond = dem::outside_law(EnergyBond{0.4, 5});
  coupling::PlatenTest weaker(specimen, settings);
  settings.model.bond = dem::outside_law(EnergyBond{0.4, 20});
  coupling::PlatenTest tougher(specimen, settings);
  const Crushed weak = crush(weaker), tough = crush(tougher);
  std::printf(
      "bonds that break by energy: %.1f MPa at 5 J/m2, %.1f MPa at 20 J/m2; energy balance closes to %.1e\n",
      1e-6 * weak.strength, 1e-6 * tough.strength, tough.residual);
  // One of the library's own from outside, for comparison.
  settings = concrete();
  const auto seconds = [](coupling::PlatenTest &test, Crushed &result) {
    const auto start = std::chrono::steady_clock::now();
    result = crush(test);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  coupling::PlatenTest inside(specimen, settings);
  settings.model.bond =
      dem::outside_law(SameBond(std::get<dem::ParallelBond::Parameters>(*concrete().model.bond)));
  coupling::PlatenTest outside(specimen, settings);
  Crushed same, own;
  const double of_own = seconds(inside, own), of_same = seconds(outside, same);
  std::printf("the library's parallel bond, and the same from outside: %.3f s and %.3f s\n", of_own, of_same);

  // A loading stage: in place of those that the settings describe.
  settings = concrete();
  settings.stages.push_back([](const coupling::PlatenTest &test) -> std::unique_ptr<coupling::Stage> {
    StressCycles::Parameters cycles;
    cycles.rate = 0.02;
    cycles.high = 8e6, cycles.low = 2e6;
    cycles.cycles = 3;
    cycles.height = test.shape().height;
    cycles.modulus = 20e9;
    return std::make_unique<StressCycles>(cycles);
  });
  coupling::PlatenTest cycled(specimen, settings);
  double highest = 0, last = 0;
  while (!cycled.program().finished()) {
    cycled.advance(1);
    last = cycled.axial_stress();
    highest = std::max(highest, last);
  }
  std::printf("three cycles: up to %.2f MPa, the last one down to %.2f MPa\n", 1e-6 * highest, 1e-6 * last);
  const State state = state_of(cycled); // and it is in every checkpoint
  const int done = rows_of<int>(state, "state/program/stage_1/cycles_done").front();

  bool holds = check(other.strength > 1.2 * one.strength, "a jacket strengthens");
  holds = check(other.pressure > 1e6, "the jacket presses") && holds;
  holds = check(other.residual < 0.01, "the energy balance closes with it") && holds;
  holds = check(weak.strength > 1e6 && tough.strength > 1.5 * weak.strength &&
                    tough.strength < 2.5 * weak.strength,
                "four times the fracture energy is twice the strength") &&
          holds;
  holds = check(weak.residual < 0.01 && tough.residual < 0.01, "the energy balance closes with it") && holds;
  holds = check(same.strength == own.strength && same.residual == own.residual,
                "a law from outside gives the bits of "
                "one inside") &&
          holds;
  holds = check(one.cracks > 0 && one.cracks < 1, "cracks lie in the specimen") && holds;
  holds =
      check(highest > 8e6 && highest < 8.4e6 && last <= 2e6, "the stress cycles between its bounds") && holds;
  holds = check(done == 3, "the state of the stage is kept by name") && holds;
  std::printf(holds ? "all holds\n" : "");
  return holds ? 0 : 1;
}
