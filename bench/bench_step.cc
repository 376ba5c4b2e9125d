// Speed of one step (step_scene.h says of what), in turn with the idealised loop on the same bonds. Prints
// seconds per stage, bytes per particle and the line "N M bond-steps/s" (median over repeats).
#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdio>
#include <memory>

#include "apps/io/specimen_csv.h"
#include "dem/parallel.h"
#include "step_scene.h"

namespace {

using namespace platen;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Options {
  int particles = 22500, threads = 1, steps = 500, repeats = 5;
  bool baseline = false, alone = false;
  std::string read, write;
};

dem::Specimen specimen_for(const Options &o) {
  const auto start = Clock::now();
  dem::Specimen specimen =
      o.read.empty() ? bench::close_packed(o.particles) : apps::read_specimen_csv(o.read).specimen;
  std::printf("%s in %.3g s\n", o.read.empty() ? "packed" : "read", seconds_since(start));
  if (!o.write.empty()) apps::write_specimen_csv(o.write, specimen);
  return specimen;
}

void print_stages(const dem::StageClock &clock, const dem::StageClock &before, double steps, double step) {
  std::printf("%-12s %8s\n", "stage", "ms/step");
  for (int k = 0; k < dem::stage_count; ++k) {
    const dem::Stage stage = static_cast<dem::Stage>(k);
    const double spent = clock.seconds(stage) - before.seconds(stage);
    if (spent > 0)
      std::printf("%-12s %8.4f\n", dem::stage_names[static_cast<std::size_t>(k)], 1e3 * spent / steps);
  }
  std::printf("%-12s %8.4f\n", "all", 1e3 * step);
}

void print_memory(const coupling::Problem &problem, double before) {
  const double particles = static_cast<double>(problem.model.particles.size());
  std::printf(
      "memory: %.0f bytes per particle in columns and search, bonds included; process %.0f MB, %.0f "
      "MB before the scene\n",
      static_cast<double>(problem.bytes()) / particles, 1e-6 * bench::peak_memory(), 1e-6 * before);
}

void measure(const Options &o, coupling::Problem &problem, double memory_before) {
  const double bonds = static_cast<double>(problem.model.bonds->size());
  std::unique_ptr<bench::IdealisedLoop> loop;
  if (!o.alone) {
    loop = std::make_unique<bench::IdealisedLoop>(bench::network_of(problem.model), o.threads);
    loop->run(o.steps / 5 + 1);
  }
  bench::run(problem, o.steps / 5 + 1); // warm
  const dem::StageClock before = problem.model.clock;
  std::vector<double> rates, idealised, share;
  double measured = 0;
  // Who comes after the other needs a moment until its threads have found their processors.
  const int settling = o.steps / 10 + 1;
  for (int r = 0; r < o.repeats; ++r) {
    bench::run(problem, settling);
    const auto start = Clock::now();
    bench::run(problem, o.steps);
    const double seconds = seconds_since(start);
    measured += seconds;
    rates.push_back(bonds * o.steps / seconds * 1e-6);
    if (!loop) continue;
    loop->run(settling);
    idealised.push_back(bonds * o.steps / loop->run(o.steps) * 1e-6);
    share.push_back(rates.back() / idealised.back());
  }
  print_stages(problem.model.clock, before, static_cast<double>(o.steps + settling) * o.repeats,
               measured / (static_cast<double>(o.steps) * o.repeats));
  const dem::EnergyLedger energy = problem.energy();
  std::printf("energy: work %.4g J, residual %.2g of it; broken bonds %ld\n", energy.boundary,
              energy.residual() / energy.boundary, problem.model.broken_tension + problem.model.broken_shear);
  print_memory(problem, memory_before);
  const bench::Spread s = bench::spread(rates);
  if (loop) {
    const bench::Spread i = bench::spread(idealised), part = bench::spread(share);
    std::printf(
        "idealised loop in turn: %.2f M (%.2f ... %.2f); the step runs at %.3f of it (%.3f ... %.3f)\n",
        i.median, i.smallest, i.largest, part.median, part.smallest, part.largest);
  }
  std::printf("smallest %.2f, largest %.2f M bond-steps/s\n", s.smallest, s.largest);
  std::printf("%.2f M bond-steps/s\n", s.median);
}

} // namespace

int main(int argc, char **argv) {
  Options o;
  CLI::App app("Bond-steps per second of a bonded specimen between rigid platens.");
  app.add_option("--particles", o.particles, "spheres of 1 mm radius")->check(CLI::Range(100, 2000000));
  app.add_option("--threads", o.threads, "threads")->check(CLI::Range(1, 256));
  app.add_option("--steps", o.steps, "steps per repeat")->check(CLI::Range(1, 1000000));
  app.add_option("--repeats", o.repeats, "repeats; the median is printed")->check(CLI::Range(1, 1000));
  app.add_option("--specimen", o.read, "a packing from this file instead")->check(CLI::ExistingFile);
  app.add_option("--write-specimen", o.write, "write the packing to this file");
  app.add_flag("--baseline", o.baseline, "the kernels of plain x86-64");
  app.add_flag("--alone", o.alone, "without the idealised loop");
  CLI11_PARSE(app, argc, argv);

  const dem::ThreadLimit limit(o.threads);
  const dem::Specimen specimen = specimen_for(o);
  coupling::ProblemSettings chosen = bench::elastic_press();
  if (o.baseline) chosen.model.instruction_set = dem::InstructionSet::baseline;
  const double before = bench::peak_memory();
  const auto start = Clock::now();
  coupling::Problem problem(specimen, chosen);
  std::printf("set up in %.3g s\n", seconds_since(start));
  std::printf("%zu particles, %zu bonds, %d threads, %s kernels, step %.4g s\n",
              problem.model.particles.size(), problem.model.bonds->size(), o.threads,
              dem::name(chosen.model.instruction_set), problem.time_step());
  measure(o, problem, before);
  return 0;
}
