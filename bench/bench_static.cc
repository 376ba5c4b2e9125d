// Elastic moduli of the step benchmarks' specimen by static solves, beside the time that explicit steps would
// take.
#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdio>
#include <string>

#include "apps/io/specimen_csv.h"
#include "coupling/static_press.h"
#include "dem/parallel.h"
#include "dem/statics/network.h"
#include "static_ml.h"
#include "step_scene.h"

namespace {

using namespace platen;

template <class Work>
double seconds_of(const Work &work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// One solve with every sphere near the platens held, by our multigrid and by ML.
void compare_with_ml(coupling::Problem &problem) {
  const dem::Particles &p = problem.model.particles;
  const dem::Bonds &bonds = *problem.model.bonds;
  dem::StaticCase load;
  for (const bool top : {false, true})
    for (const dem::GroundSpring &s : problem.springs_at(top))
      load.supports.push_back({s, {0, 0, top ? -1e-6 : 1e-6}});
  dem::StaticState ours;
  const double seconds = seconds_of([&] { ours = dem::solve_static(p, bonds, load); });

  auto a = dem::statics::assemble<6>(
      p.size(), bonds, [&](std::size_t row) { return dem::statics::material_stiffness<6>(p, bonds, row); });
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
  bool ml = false;
  app.add_flag("--ml", ml, "compare a solve with Trilinos ML");
  CLI11_PARSE(app, argc, argv);

  const dem::ThreadLimit limit(threads);
  coupling::Problem problem(
      read.empty() ? bench::close_packed(particles) : apps::read_specimen_csv(read).specimen,
      bench::elastic_press(law));
  if (ml) compare_with_ml(problem);
  std::vector<double> still, step;
  coupling::StaticPress p;
  constexpr long timed = 100;
  for (int r = 0; r < repeats; ++r) {
    still.push_back(seconds_of([&] { p = coupling::press_statically(problem, 1e-5); }));
    step.push_back(seconds_of([&] { bench::run(problem, timed); }) / timed);
  }
  const double seconds = bench::spread(still).median, explicitly = bench::spread(step).median * steps;
  std::printf("%s, %d threads\n", bench::machine().c_str(), threads);
  std::printf("%zu particles, %zu bonds: E %.4g GPa (gauge), %.4g GPa (platens), nu %.4f\n",
              problem.model.particles.size(), problem.model.bonds->size(), 1e-9 * p.youngs_modulus(),
              1e-9 * p.platen_modulus(), p.poisson_ratio());
  std::printf("static: %.3g s (%d solves, %d iterations); %.0f explicit steps: %.3g s; ratio %.0f\n", seconds,
              p.solves, p.iterations, steps, explicitly, explicitly / seconds);
  return 0;
}
