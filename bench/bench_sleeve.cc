// What a sleeve costs: explicit steps by size. The sleeve of a 150 x 300 mm specimen, 3 mm of rubber, ends
// fixed, blown up a little; one line per mesh: cells, unknowns, time of a step per cell, stable step.
#include <cmath>
#include <cstdio>
#include <vector>

#include "arguments.h"
#include "base/clock.h"
#include "base/parallel.h"
#include "base/pi.h"
#include "fem/hyperelastic_solid.h"

namespace {

using namespace platen;
using namespace platen::fem;

// Wider by this at mid-height, about where the pressure inside rests: membrane stress over Young's modulus.
constexpr double pressure = 5e3, radius = 0.075, wall = 0.003, height = 0.3, young = 3e6; // Pa, m
constexpr double wider = pressure * radius / wall / young;
constexpr double step_share = 0.9; // of the stable step: it rings from there

// r^2 grows by the same amount all through the wall, which keeps its volume.
std::vector<Vector3> blown_up(const HyperelasticSolid &solid) {
  std::vector<Vector3> displacement;
  for (const Vector3 &x : solid.mesh().nodes) {
    const double more = 2 * wider * radius * radius * std::sin(pi * x[2] / height);
    const double share = std::sqrt(1 + more / (x[0] * x[0] + x[1] * x[1])) - 1;
    displacement.push_back({share * x[0], share * x[1], 0});
  }
  return displacement;
}

void measure(int around, int along, int through, double poisson, int steps) {
  HyperelasticSolid solid(make_grid(Tube{radius, wall, 0, height, around, along, through}),
                          {1100, NeoHookean::from_young(young, poisson)}, {inner_tag});
  solid.prescribe(solid.nodes_of(low_end_tag), {true, true, true});
  solid.prescribe(solid.nodes_of(high_end_tag), {true, true, true});
  solid.set_pressure(inner_tag, pressure);
  solid.set_displacement(blown_up(solid));
  const double limit = solid.stable_step(), dt = step_share * limit;
  const Clock::time_point start = Clock::now();
  for (int k = 0; k < steps; ++k) {
    solid.half_kick(dt);
    solid.drift(dt);
    solid.update_forces();
    solid.half_kick(dt);
  }
  const double step = seconds_since(start) / steps;
  const std::size_t cells = solid.mesh().cells.size();
  std::printf("%3d x %3d x %d nu %.4f %7zu cells %8zu unknowns %7.2f us/cell/step dt %.3g s\n", around, along,
              through, poisson, cells, 3 * solid.mesh().nodes.size(), 1e6 * step / static_cast<double>(cells),
              limit);
}

} // namespace

int main(int count, char **arguments) {
  int threads = 1, steps = 100;
  platen::bench::read_arguments(count, arguments, "Cost of a sleeve: explicit steps by size.",
                                {{"-t,--threads", &threads, "threads, 0: all", 0, 256},
                                 {"-s,--steps", &steps, "explicit steps per mesh", 1, 1e9}});
  const platen::ThreadLimit limit(threads);
  for (const double poisson : {0.49, 0.4995}) {
    measure(32, 20, 1, poisson, steps);
    measure(64, 40, 1, poisson, steps);
    measure(64, 40, 2, poisson, steps);
    measure(96, 60, 2, poisson, steps);
  }
}
