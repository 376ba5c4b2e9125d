// What a sleeve costs: explicit steps and iterations of Newton's method by size. The sleeve of a 150 x 300 mm
// specimen, 3 mm of rubber, ends held, blown up a little; one line per mesh: cells, unknowns, time of a step
// per cell, stable step, time of an iteration of the equilibrium.
#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdio>

#include "fem/hyperelastic_solid.h"
#include "fem/threads.h"

namespace {

using namespace platen::fem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void measure(int around, int along, int through, double poisson, int steps) {
  HyperelasticSolid solid(make_grid(Tube{0.075, 0.003, 0, 0.3, around, along, through}),
                          {1100, NeoHookean::from_young(3e6, poisson)}, {inner_tag});
  solid.lead(solid.nodes_of(low_end_tag), {true, true, true});
  solid.lead(solid.nodes_of(high_end_tag), {true, true, true});
  Clock::time_point start = Clock::now();
  const EquilibriumReport report = solid.solve({{{inner_tag, 5e3}}, {}});
  const double iteration = seconds_since(start) / report.iterations;
  const double dt = solid.stable_step();
  start = Clock::now();
  for (int k = 0; k < steps; ++k) {
    solid.half_kick(dt);
    solid.drift(dt);
    solid.update_forces();
    solid.half_kick(dt);
  }
  const double step = seconds_since(start) / steps;
  const std::size_t cells = solid.mesh().cells.size();
  std::printf(
      "%3d x %3d x %d nu %.4f %7zu cells %8zu unknowns %7.2f us/cell/step dt %.3g s %8.3f s/iteration (%d)\n",
      around, along, through, poisson, cells, 3 * solid.mesh().nodes.size(),
      1e6 * step / static_cast<double>(cells), dt, iteration, report.iterations);
}

} // namespace

int main(int count, char **arguments) {
  CLI::App app{"Cost of a sleeve: explicit steps and Newton iterations by size"};
  int threads = 1, steps = 100;
  app.add_option("-t,--threads", threads, "threads, 0: all")->capture_default_str();
  app.add_option("-s,--steps", steps, "explicit steps per mesh")->capture_default_str();
  CLI11_PARSE(app, count, arguments);
  limit_threads(threads);
  for (const double poisson : {0.49, 0.4995}) {
    measure(32, 20, 1, poisson, steps);
    measure(64, 40, 1, poisson, steps);
    measure(64, 40, 2, poisson, steps);
    measure(96, 60, 2, poisson, steps);
  }
}
