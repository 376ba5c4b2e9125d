// Builds a specimen in code, crushes it between dry platens and prints its strength.
#include <algorithm>
#include <cstdio>

#include <coupling/platen_test.h>
#include <dem/packing/growth.h>

using namespace platen;

int main() {
  const dem::Specimen specimen = dem::random_close_packing(dem::cylinder(5e-3, 10e-3), 0.8e-3, 0.25, 1);

  coupling::PlatenTestSettings settings;
  settings.model.bond_layout.modulus = 36e9;
  settings.model.bond_layout.gap.value = 0.05; // of the smaller radius
  settings.model.bond =
      dem::ParallelBond::Parameters{0.4, 9.5e6, 26.6e6, 0.7853981633974483, 0.3}; // 45 degrees
  settings.model.contact = dem::ContactSettings{};
  settings.ends = coupling::Ends::ground;
  settings.end_layer = 0.3;
  settings.platens.top = settings.platens.bottom = {0.57, 0.57};
  settings.platens.thickness = 2e-3;
  settings.loading.rate = 0.05;

  coupling::PlatenTest problem(specimen, settings);
  double strength = 0;
  for (double stress = 0; problem.closure_strain() < 0.01 && stress >= 0.5 * strength;) {
    problem.step();
    stress = 0.5 * (problem.stress_top() + problem.stress_bottom());
    strength = std::max(strength, stress);
  }
  std::printf("%zu spheres: %.1f MPa\n", specimen.size(), 1e-6 * strength);
  return strength > 0 ? 0 : 1;
}
