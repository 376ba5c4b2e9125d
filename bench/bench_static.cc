// Elastic moduli of the step benchmarks' specimen by static solves, beside the time that explicit steps would
// take, or beside explicit steps that are made.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <string>

#include "apps/output/specimen_csv.h"
#include "base/clock.h"
#include "base/parallel.h"
#include "coupling/static_press.h"
#include "dem/measure/gauge.h"
#include "dem/statics/network.h"
#include "static_ml.h"
#include "step_scene.h"

namespace {

using namespace platen;

template <class Work>
double seconds_of(const Work &work) {
  const auto start = Clock::now();
  work();
  return seconds_since(start);
}

// One solve with every sphere near the platens held, by our multigrid and by ML.
void compare_with_ml(coupling::PlatenTest &problem) {
  const dem::Particles &p = problem.model.particles;
  const dem::Bonds &bonds = *problem.model.bonds;
  dem::StaticCase load;
  for (const bool top : {false, true})
    for (const dem::GroundSpring &s :
         (top ? problem.top() : problem.bottom()).whole_springs(problem.model.particles))
      load.supports.push_back({s, {0, 0, top ? -1e-6 : 1e-6}});
  dem::StaticState ours;
  const double seconds = seconds_of([&] { ours = dem::solve_static(p, bonds, load); });

  auto a = dem::statics::assemble<6>(p, bonds, dem::statics::at_rest(bonds));
  std::vector<double> right(6 * p.size(), 0.0);
  for (const dem::Support &s : load.supports) {
    const std::size_t i = static_cast<std::size_t>(s.spring.particle);
    for (std::size_t k = a.begin[i]; k < a.begin[i + 1]; ++k)
      if (static_cast<std::size_t>(a.column[k]) == i) dem::statics::add_support<6>(p, s.spring, a.at(k));
    dem::statics::add_support_load<6>(p, s.spring, s.moved, &right[6 * i]);
  }
  const bench::MlSolution ml = bench::solve_by_ml(a, {p.position.begin(), p.position.end()},
                                                  {p.radius.begin(), p.radius.end()}, right, 1e-8);
  double difference = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    difference = std::max(difference, std::abs(ml.x[6 * i + 2] - ours.displacement[i].z));
  std::printf(
      "one solve: %.3g s (%d iterations); ML %.3g s + %.3g s (%d iterations); largest difference %.1e m\n",
      seconds, ours.iterations, ml.setup_seconds, ml.solve_seconds, ml.iterations, difference);
}

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
  const double seconds = seconds_of([&] { bench::run(problem, steps); });

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
  int particles = 10000, threads = 1, repeats = 3;
  double steps = 100000;
  bench::Law law = bench::Law::parallel_bond;
  std::string read;
  CLI::App app("Static solves against explicit steps.");
  app.add_option("--particles", particles, "spheres of 1 mm radius")->check(CLI::Range(100, 2000000));
  app.add_option("--threads", threads, "threads of steps and solves")->check(CLI::Range(1, 256));
  app.add_option("--steps", steps, "steps of the explicit run to compare with")->check(CLI::Range(1., 1e9));
  app.add_option("--repeats", repeats, "repeats; the median is printed")->check(CLI::Range(1, 1000));
  app.add_option("--law", law, "law of the bonds")->transform(CLI::CheckedTransformer(bench::laws));
  app.add_option("--specimen", read, "a packing from this file instead")->check(CLI::ExistingFile);
  double friction = 1e6, strain = 1e-5;
  app.add_option("--friction", friction,
                 "of the platens, in explicit steps; in static solves all of it sticks")
      ->check(CLI::Range(0., 1e9));
  app.add_option("--strain", strain, "closure of the platens over the height")->check(CLI::Range(1e-9, 1e-2));
  bool ml = false, explicitly_too = false;
  app.add_flag("--explicit", explicitly_too, "make all of the explicit steps and compare what they give");
  app.add_flag("--ml", ml, "compare a solve with Trilinos ML");
  CLI11_PARSE(app, argc, argv);

  const ThreadLimit limit(threads);
  const dem::Specimen specimen =
      read.empty() ? bench::close_packed(particles) : apps::read_specimen_csv(read).specimen;
  coupling::PlatenTestSettings settings = bench::elastic_press(law);
  settings.platens.top = settings.platens.bottom = {friction, friction};
  coupling::PlatenTest problem(specimen, settings);
  if (ml) compare_with_ml(problem);
  std::vector<double> still, step;
  coupling::StaticPress p;
  constexpr long timed = 100;
  for (int r = 0; r < repeats; ++r) {
    coupling::StaticPress now;
    still.push_back(seconds_of([&] { now = coupling::press_statically(problem, strain); }));
    if (r == 0) p = now; // before any step has moved the platens
    if (!explicitly_too) step.push_back(seconds_of([&] { bench::run(problem, timed); }) / timed);
  }
  const double seconds = bench::spread(still).median;
  std::printf("%s, %d threads\n", apps::this_machine().processor.c_str(), threads);
  std::printf("%zu particles, %zu bonds: E %.4g GPa (gauge), %.4g GPa (platens), nu %.4f\n",
              problem.model.particles.size(), problem.model.bonds->size(), 1e-9 * p.youngs_modulus(),
              1e-9 * p.platen_modulus(), p.poisson_ratio());
  std::printf("static: %.3g s (%d solves, %d iterations)\n", seconds, p.solves, p.iterations);
  if (explicitly_too) {
    compare_with_steps(specimen, settings, static_cast<long>(steps), problem.time_step(), p, seconds);
  } else {
    const double explicitly = bench::spread(step).median * steps;
    std::printf("%.0f explicit steps would take %.3g s (by %ld of them); ratio %.0f\n", steps, explicitly,
                timed, explicitly / seconds);
  }
  return 0;
}
