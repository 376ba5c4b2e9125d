// Speed of one step: equal spheres, close packed, bonds with normal, shear, bending and twisting, failure
// checks, local damping and energy book on, between two rigid platens that press them elastically. Prints
// seconds per stage and the line "N M bond-steps/s" (median over repeats).
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "coupling/problem.h"
#include "dem/packing/growth.h"
#include "dem/packing/specimen.h"
#include "dem/parallel.h"

namespace {

using namespace platen;

// A cylinder twice as high as wide that holds about `count` spheres of radius 1 mm at the packing fraction
// that growth between walls reaches.
dem::Shape shape_for(int count) {
  constexpr double sphere = 4.0 / 3.0 * 3.14159265358979323846 * 1e-9, fraction = 0.615;
  dem::Shape shape;
  shape.radius = std::cbrt(count * sphere / fraction / (4 * 3.14159265358979323846));
  shape.height = 4 * shape.radius;
  return shape;
}

coupling::ProblemSettings settings() {
  coupling::ProblemSettings s;
  s.model.bond_layout.modulus = 40e9;
  s.model.bond_layout.gap = 0.1;
  s.model.bond = dem::ParallelBond::Parameters{0.4, 1e9, 4e9, 1.0, 0.3}; // strong: the elastic stage is timed
  s.model.contact = dem::ContactSettings{};
  s.model.contact->friction = 0.5;
  s.model.local_damping = 0.5;
  s.ends = coupling::Ends::ground;
  s.end_layer = 0.3;
  s.platens.top = s.platens.bottom = {0.57, 0.57};
  s.platens.damping = 0;
  s.platens.thickness = 5e-3;
  s.loading.rate = 0.05;
  return s;
}

void run(coupling::Problem &problem, long steps) {
  while (steps > 0)
    steps -= problem.advance(steps);
}

} // namespace

int main(int argc, char **argv) {
  int particles = 22500, threads = 1, steps = 500, repeats = 5;
  bool baseline = false;
  CLI::App app("Bond-steps per second of a bonded cylinder between rigid platens.");
  app.add_option("--particles", particles, "spheres of 1 mm radius")->check(CLI::Range(100, 2000000));
  app.add_option("--threads", threads, "threads")->check(CLI::Range(1, 256));
  app.add_option("--steps", steps, "steps per repeat")->check(CLI::Range(1, 1000000));
  app.add_option("--repeats", repeats, "repeats; the median is printed")->check(CLI::Range(1, 1000));
  app.add_flag("--baseline", baseline, "the kernels of plain x86-64");
  CLI11_PARSE(app, argc, argv);

  const dem::ThreadLimit limit(threads);
  const dem::Specimen specimen =
      dem::random_close_packing_of(shape_for(particles), static_cast<std::size_t>(particles), 0.0, 1);
  coupling::ProblemSettings chosen = settings();
  if (baseline) chosen.model.instruction_set = dem::InstructionSet::baseline;
  coupling::Problem problem(specimen, chosen);
  const double bonds = static_cast<double>(problem.model.bonds->size());
  std::printf("%zu particles, %.0f bonds, %d threads, %s kernels, step %.4g s\n",
              problem.model.particles.size(), bonds, threads, dem::name(chosen.model.instruction_set),
              problem.time_step());
  run(problem, steps / 5); // warm
  std::vector<double> rates;
  double measured = 0;
  std::vector<double> before(dem::stage_count), after(dem::stage_count);
  for (int k = 0; k < dem::stage_count; ++k)
    before[static_cast<std::size_t>(k)] = problem.model.clock.seconds(static_cast<dem::Stage>(k));
  for (int r = 0; r < repeats; ++r) {
    const auto start = std::chrono::steady_clock::now();
    run(problem, steps);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    measured += seconds;
    rates.push_back(bonds * steps / seconds * 1e-6);
  }
  const double per_step = 1e3 / (static_cast<double>(steps) * repeats);
  std::printf("%-12s %8s\n", "stage", "ms/step");
  for (int k = 0; k < dem::stage_count; ++k) {
    const double stage =
        problem.model.clock.seconds(static_cast<dem::Stage>(k)) - before[static_cast<std::size_t>(k)];
    if (stage > 0)
      std::printf("%-12s %8.4f\n", dem::stage_names[static_cast<std::size_t>(k)], stage * per_step);
  }
  std::printf("%-12s %8.4f\n", "all", measured * per_step);
  const dem::EnergyLedger energy = problem.energy();
  std::printf("energy: work %.4g J, residual %.2g of it; broken bonds %ld\n", energy.boundary,
              energy.residual() / energy.boundary, problem.model.broken_tension + problem.model.broken_shear);
  std::sort(rates.begin(), rates.end());
  std::printf("smallest %.2f, largest %.2f M bond-steps/s\n", rates.front(), rates.back());
  std::printf("%.2f M bond-steps/s\n", rates[rates.size() / 2]);
  return 0;
}
