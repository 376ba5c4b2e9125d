// Elastic moduli of the step benchmarks' specimen by static solves, beside the time that explicit steps would
// take, or beside explicit steps that are made.
#include <cstdio>

#include "apps/output/machine.h"
#include "base/parallel.h"
#include "coupling/static_press.h"
#include "dem/measure/gauge.h"
#include "workload.h"

namespace {

using namespace platen;

// What platens and gauge say of a specimen that has been pressed.
struct Moduli {
  double gauge = 0, platens = 0, poisson_ratio = 0; // Pa, Pa, 1
};

double percent_off(double a, double b) {
  return 100 * (a / b - 1);
}

// The same strain by so many steps: platens that start smoothly over the first half of the run and then keep
// their speed, thousands of wave transits for the whole test.
void compare_with_steps(const dem::Specimen &specimen, coupling::PlatenTestSettings settings, long steps,
                        double time_step, const coupling::StaticPress &still, double still_seconds) {
  settings.loading.ramp = 0.5 * static_cast<double>(steps) * time_step;
  settings.loading.rate = still.strain_platen * specimen.shape.height /
                          (static_cast<double>(steps) * time_step - 0.5 * settings.loading.ramp);
  coupling::PlatenTest problem(specimen, settings);
  const dem::Gauge gauge(problem.model.particles, problem.shape(), problem.model.bonds.get());
  const double seconds = bench::seconds_of([&] { bench::run(problem, steps); });

  const dem::GaugeStrain strain = gauge.strain(problem.model.particles);
  const double stress = 0.5 * (problem.stress_top() + problem.stress_bottom());
  const Moduli made{stress / -strain.axial, stress / problem.closure_strain(),
                    -strain.lateral() / strain.axial};
  const dem::EnergyLedger energy = problem.energy();
  std::printf("explicit: %ld steps of %.3g s in %.4g s, to a strain of %.4g at %.3g m/s\n", steps,
              problem.time_step(), seconds, problem.closure_strain(), settings.loading.rate);
  std::printf("  E %.6g GPa (gauge), %.6g GPa (platens), nu %.6f; static %.6g, %.6g, %.6f\n",
              1e-9 * made.gauge, 1e-9 * made.platens, made.poisson_ratio, 1e-9 * still.youngs_modulus(),
              1e-9 * still.platen_modulus(), still.poisson_ratio());
  std::printf("  static against explicit: %+.4f %%, %+.4f %%, %+.4f %%; ratio of the seconds %.0f\n",
              percent_off(still.youngs_modulus(), made.gauge),
              percent_off(still.platen_modulus(), made.platens),
              percent_off(still.poisson_ratio(), made.poisson_ratio), seconds / still_seconds);
  std::printf("  contacts of the platens: %zu + %zu, static %zu + %zu; touching grains %zu; cracks %ld\n",
              problem.bottom().layer().closed, problem.top().layer().closed, still.closed_bottom,
              still.closed_top, problem.model.contacts->touching_count(),
              problem.model.broken_tension + problem.model.broken_shear);
  std::printf("  kinetic over internal energy %.1e, unbalanced over bond force %.1e\n",
              energy.kinetic / (energy.bonds + energy.contacts), problem.unbalanced_ratio());
}

} // namespace

int main(int argc, char **argv) {
  bench::Workload o;
  o.particles = 10000, o.steps = 100000, o.repeats = 3;
  int threads = 1;
  double friction = 1e6, strain = 1e-5;
  bool explicitly_too = false;
  bench::read_arguments(
      argc, argv, "Static solves against explicit steps.",
      o.arguments(true, {{"--threads", &threads, "threads of steps and solves", 1, 256},
                         {"--friction", &friction,
                          "of the platens, in explicit steps; in static solves all of it sticks", 0, 1e9},
                         {"--strain", &strain, "closure of the platens over the height", 1e-9, 1e-2},
                         {"--explicit", &explicitly_too,
                          "make all of the explicit steps and compare what they give"}}));

  const ThreadLimit limit(threads);
  const dem::Specimen specimen = o.specimen();
  coupling::PlatenTestSettings settings = o.press();
  settings.platens.top = settings.platens.bottom = {friction, friction};
  coupling::PlatenTest problem(specimen, settings);
  std::vector<double> still, step;
  coupling::StaticPress p;
  constexpr long timed = 100;
  for (int r = 0; r < o.repeats; ++r) {
    coupling::StaticPress now;
    still.push_back(bench::seconds_of([&] { now = coupling::press_statically(problem, strain); }));
    if (r == 0) p = now; // before any step has moved the platens
    if (!explicitly_too) step.push_back(bench::seconds_of([&] { bench::run(problem, timed); }) / timed);
  }
  const double seconds = bench::spread(still).median;
  std::printf("%s, %d threads\n", apps::this_machine().processor.c_str(), threads);
  std::printf("%zu particles, %zu bonds: E %.4g GPa (gauge), %.4g GPa (platens), nu %.4f\n",
              problem.model.particles.size(), problem.model.bonds->size(), 1e-9 * p.youngs_modulus(),
              1e-9 * p.platen_modulus(), p.poisson_ratio());
  std::printf("static: %.3g s (%d solves, %d iterations)\n", seconds, p.solves, p.iterations);
  if (explicitly_too) {
    compare_with_steps(specimen, settings, o.steps, problem.time_step(), p, seconds);
    return 0;
  }
  const double explicitly = bench::spread(step).median * o.steps;
  std::printf("%d explicit steps would take %.3g s (by %ld of them); ratio %.0f\n", o.steps, explicitly,
              timed, explicitly / seconds);
  return 0;
}
