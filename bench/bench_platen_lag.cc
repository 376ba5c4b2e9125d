// What platens without inertia cost when they come after their loads: the peak of a small cylinder crushed
// between sheets of ever softer material, solved for every 5 and 20 steps, beside the same with inertia. The
// bound of fifteen wave transits, beyond which platen-compress refuses, stands on it (docs/theory.md, 10.1).
#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

#include "base/parallel.h"
#include "coupling/platen_test.h"
#include "dem/packing/advancing_front.h"

namespace {

using namespace platen;

constexpr double steel = 210e9; // Pa
constexpr long most_steps = 12000;

coupling::PlatenTestSettings crushing(double young, int steps_per_solve) {
  coupling::PlatenTestSettings s;
  s.model.bond_layout.modulus = 36e9;
  s.model.bond_layout.gap.value = 0.05;
  s.model.bond = dem::ParallelBond::Parameters{0.4, 2e6, 6e6, 0.7853981633974483, 0.3};
  s.model.contact = dem::ContactSettings{};
  s.model.contact->damping = 0;
  s.model.local_damping = 0.3;
  s.ends = coupling::Ends::ground;
  s.end_layer = 0.5;
  s.seat = true;
  s.loading.rate = 0.5;
  s.loading.ramp = 5e-6;
  s.platens.damping = 0.1;
  s.platens.top = s.platens.bottom = {0.3, 0.2};
  s.platens.thickness = 4e-3;
  s.platens.material.young_modulus = steel;
  s.platens.elastic = coupling::ElasticPlatens{};
  using fem::ElasticMotion;
  s.platens.elastic->motion =
      steps_per_solve == 0 ? ElasticMotion::explicit_steps : ElasticMotion::quasi_static;
  s.platens.elastic->steps_per_solve = std::max(1, steps_per_solve);
  s.platens.elastic->pad_thickness = 1e-3;
  s.platens.elastic->pad = {1200, young, 0.45};
  return s;
}

void crush(const dem::Specimen &cylinder, double young, int steps_per_solve) {
  coupling::PlatenTest test(cylinder, crushing(young, steps_per_solve));
  double peak = 0, work = 0, most = 0;
  while (test.steps() < most_steps && !(test.axial_stress() < 0.5 * peak && peak > 1e6)) {
    test.advance(20);
    test.model.take_cracks();
    if (test.axial_stress() > peak) peak = test.axial_stress(), work = test.energy().boundary;
    most = std::max(most, std::abs(test.energy().unbalanced));
  }
  std::printf("| %g | %d | %.2g | %.3g | %.2g | %.2g |\n", 1e-9 * young, steps_per_solve,
              test.seconds_behind() / test.facts().wave_transit, 1e-6 * peak, most / work,
              test.energy().residual() / work);
  std::fflush(stdout);
}

} // namespace

int main(int argc, char **argv) {
  CLI::App app("Platens without inertia that come after their loads, by the softness of a sheet on them");
  int threads = 1;
  std::vector<double> moduli = {210, 20, 5, 1, 0.3, 0.1};
  app.add_option("-t,--threads", threads, "threads; 0: all");
  app.add_option("--moduli", moduli, "of the sheet, GPa");
  CLI11_PARSE(app, argc, argv);
  try {
    const ThreadLimit limit(threads);
    const dem::Specimen cylinder = dem::advancing_front(
        dem::cylinder(6e-3, 14e-3), {dem::RadiusDistribution::Kind::uniform, 0.7e-3, 1e-3}, 5);
    std::printf(
        "| sheet, GPa | steps per solve (0: with inertia) | behind, wave transits | peak, MPa | left over, "
        "of "
        "the work | residual |\n| --- | --- | --- | --- | --- | --- |\n");
    for (const double modulus : moduli)
      for (const int each : {0, 5, 20})
        crush(cylinder, 1e9 * modulus, each);
  } catch (const std::exception &e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
