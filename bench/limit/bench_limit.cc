// What this machine could do at most: its memory bandwidth, and the idealised bonded loop that the rate of
// bench_step is compared against (idealised_loop.h says what it holds).
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "limit/bandwidth.h"
#include "limit/idealised_loop.h"
#include "step_scene.h"

namespace {

using namespace platen;

// The network of bench_step.
bench::Network network_for(int particles) {
  const dem::Model model(bench::close_packed(particles), bench::elastic_press().model);
  return bench::network_of(model);
}

void print_bandwidth(int threads, std::size_t megabytes, int repeats) {
  std::printf("triad a = b + s c, three arrays of %zu MB, 24 bytes per element (32 with write allocate):\n",
              megabytes);
  for (int t = 1; t <= threads; t = t < threads ? std::min(2 * t, threads) : t + 1) {
    const bench::Spread s = bench::spread(bench::triad_bandwidth(t, megabytes * 1000000 / 8, repeats));
    std::printf("bandwidth: %.1f GB/s on %d thread%s (%.1f ... %.1f)\n", s.median * 1e-9, t,
                t == 1 ? "" : "s", s.smallest * 1e-9, s.largest * 1e-9);
  }
}

void print_loop(const bench::Network &network, int threads, int steps, int repeats) {
  using Loop = bench::IdealisedLoop;
  Loop loop(network, threads);
  const double before = loop.check().kinetic_energy; // the bonds are not strained yet
  loop.run(steps / 5 + 1);                           // warm
  std::vector<double> rates;
  for (int r = 0; r < repeats; ++r)
    rates.push_back(static_cast<double>(loop.bonds()) * steps / loop.run(steps));
  const bench::Spread s = bench::spread(rates);
  const double particles = static_cast<double>(loop.particles()) / static_cast<double>(loop.bonds());
  std::printf(
      "idealised loop: %.1f M bond-steps/s on %d thread%s (%.1f ... %.1f), %.1f Gflop/s in bonds, %.1f "
      "GB/s\n",
      s.median * 1e-6, threads, threads == 1 ? "" : "s", s.smallest * 1e-6, s.largest * 1e-6,
      s.median * Loop::flops_per_bond * 1e-9,
      s.median * (Loop::bytes_per_bond + particles * Loop::bytes_per_particle) * 1e-9);
  const Loop::Check check = loop.check();
  std::printf("  energy %.4f of the first, momentum %.1e of the sum of momenta\n",
              (check.kinetic_energy + check.bond_energy) / before, check.momentum / check.sum_of_momenta);
}

} // namespace

int main(int argc, char **argv) {
  int particles = 22500, threads = 1, steps = 200, repeats = 9;
  std::size_t megabytes = 256;
  CLI::App app("Memory bandwidth and rate of an idealised bonded loop: what this machine could do at most.");
  app.add_option("--particles", particles, "spheres of 1 mm radius")->check(CLI::Range(100, 2000000));
  app.add_option("--threads", threads, "threads; one alone is measured too")->check(CLI::Range(1, 256));
  app.add_option("--steps", steps, "steps per repeat")->check(CLI::Range(1, 1000000));
  app.add_option("--repeats", repeats, "repeats; the median is printed")->check(CLI::Range(1, 1000));
  app.add_option("--megabytes", megabytes, "of each array of the triad; several times the caches")
      ->check(CLI::Range(1, 100000));
  CLI11_PARSE(app, argc, argv);

  print_bandwidth(threads, megabytes, repeats);
  const bench::Network network = network_for(particles);
  std::printf("%zu particles, %zu bonds; per bond %d flops and %d bytes streamed, per particle %d bytes\n",
              network.position.size(), network.first.size(), bench::IdealisedLoop::flops_per_bond,
              bench::IdealisedLoop::bytes_per_bond, bench::IdealisedLoop::bytes_per_particle);
  print_loop(network, 1, steps, repeats);
  if (threads > 1) print_loop(network, threads, steps, repeats);
  return 0;
}
