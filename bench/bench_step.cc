// Speed of one step (step_scene.h says of what), in turn with the idealised loop on the same bonds. Prints
// seconds per stage, bytes per particle and the line "N M bond-steps/s" (median over repeats).
#include <CLI/CLI.hpp>

#include <array>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "apps/output/specimen_csv.h"
#include "base/clock.h"
#include "base/parallel.h"
#include "step_scene.h"

namespace {

using namespace platen;

struct Options {
  int particles = 22500, threads = 1, steps = 500, repeats = 5;
  bool baseline = false, avx2 = false, alone = false, gain = false;
  bench::Law law = bench::Law::parallel_bond;
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

void print_memory(const coupling::PlatenTest &problem, double before) {
  const double particles = static_cast<double>(problem.model.particles.size());
  std::printf(
      "memory: %.0f bytes per particle in columns and search, bonds included; process %.0f MB, %.0f "
      "MB before the scene\n",
      static_cast<double>(problem.bytes()) / particles, 1e-6 * static_cast<double>(apps::peak_memory_bytes()),
      1e-6 * before);
}

// The step and the idealised loop on one number of threads.
struct Series {
  int threads = 1;
  std::unique_ptr<bench::IdealisedLoop> loop; // null: alone
  std::vector<double> rates, idealised,
      share; // M bond-steps/s, and the first over the second, repeat by repeat
  std::array<double, dem::stage_count> stages{}; // s
  double seconds = 0;
  long steps = 0;
};

Series series_on(int threads, const Options &o, const coupling::PlatenTest &problem) {
  Series s;
  s.threads = threads;
  if (o.alone) return s;
  s.loop = std::make_unique<bench::IdealisedLoop>(bench::network_of(problem.model), threads);
  s.loop->run(o.steps / 5 + 1);
  return s;
}

// Who comes after another needs a moment until its threads have found their processors.
void repeat(Series &s, const Options &o, coupling::PlatenTest &problem) {
  const ThreadLimit limit(s.threads);
  const int settling = o.steps / 10 + 1;
  const double bonds = static_cast<double>(problem.model.bonds->size());
  bench::run(problem, settling);
  const dem::StageClock before = problem.model.clock;
  const auto start = Clock::now();
  bench::run(problem, o.steps);
  const double seconds = seconds_since(start);
  for (int k = 0; k < dem::stage_count; ++k) {
    const dem::Stage stage = static_cast<dem::Stage>(k);
    s.stages[static_cast<std::size_t>(k)] += problem.model.clock.seconds(stage) - before.seconds(stage);
  }
  s.seconds += seconds;
  s.steps += o.steps;
  s.rates.push_back(bonds * o.steps / seconds * 1e-6);
  if (!s.loop) return;
  s.loop->run(settling);
  s.idealised.push_back(bonds * o.steps / s.loop->run(o.steps) * 1e-6);
  s.share.push_back(s.rates.back() / s.idealised.back());
}

void print_stages(const Series &s) {
  const double per_step = 1e3 / static_cast<double>(s.steps);
  std::printf("%-12s %8s\n", "stage", "ms/step");
  for (std::size_t k = 0; k < s.stages.size(); ++k)
    if (s.stages[k] > 0) std::printf("%-12s %8.4f\n", dem::stage_names[k], s.stages[k] * per_step);
  std::printf("%-12s %8.4f\n", "all", s.seconds * per_step);
}

// What one sample of the energy ledger costs.
void print_ledger(const coupling::PlatenTest &problem) {
  constexpr int samples = 100;
  std::vector<double> seconds;
  for (int k = 0; k < samples; ++k) {
    const auto start = Clock::now();
    problem.energy();
    seconds.push_back(seconds_since(start));
  }
  const bench::Spread s = bench::spread(seconds);
  std::printf("one sample of the energy ledger: %.4f ms (%.4f ... %.4f)\n", 1e3 * s.median, 1e3 * s.smallest,
              1e3 * s.largest);
}

void print_idealised(const Series &s) {
  const bench::Spread i = bench::spread(s.idealised), part = bench::spread(s.share);
  std::printf("idealised loop in turn: %.2f M (%.2f ... %.2f); the step runs at %.3f of it (%.3f ... %.3f)\n",
              i.median, i.smallest, i.largest, part.median, part.smallest, part.largest);
}

// How much faster on several threads than on one, from the repeats' pairs.
void print_gain(const Series &one, const Series &several) {
  std::vector<double> step, idealised, share;
  for (std::size_t k = 0; k < one.rates.size(); ++k) {
    step.push_back(several.rates[k] / one.rates[k]);
    if (!one.loop) continue;
    idealised.push_back(several.idealised[k] / one.idealised[k]);
    share.push_back(step.back() / idealised.back());
  }
  const bench::Spread s = bench::spread(step);
  std::printf("one thread in turn: %.2f M; gain on %d threads %.3f (%.3f ... %.3f)\n",
              bench::spread(one.rates).median, several.threads, s.median, s.smallest, s.largest);
  if (!one.loop) return;
  const bench::Spread i = bench::spread(idealised), part = bench::spread(share);
  std::printf(
      "the idealised loop on one thread: %.2f M; gain %.3f (%.3f ... %.3f), of which the step reaches "
      "%.3f (%.3f ... %.3f)\n",
      bench::spread(one.idealised).median, i.median, i.smallest, i.largest, part.median, part.smallest,
      part.largest);
}

void measure(const Options &o, coupling::PlatenTest &problem, double memory_before) {
  Series several = series_on(o.threads, o, problem), one;
  if (o.gain) one = series_on(1, o, problem);
  bench::run(problem, o.steps / 5 + 1); // warm
  for (int r = 0; r < o.repeats; ++r) {
    if (o.gain) repeat(one, o, problem);
    repeat(several, o, problem);
  }
  print_stages(several);
  const dem::EnergyLedger energy = problem.energy();
  std::printf("energy: work %.4g J, residual %.2g of it; broken bonds %ld\n", energy.boundary,
              energy.residual() / energy.boundary, problem.model.broken_tension + problem.model.broken_shear);
  print_memory(problem, memory_before);
  print_ledger(problem);
  if (several.loop) print_idealised(several);
  if (o.gain) print_gain(one, several);
  const bench::Spread s = bench::spread(several.rates);
  std::printf("smallest %.2f, largest %.2f M bond-steps/s\n", s.smallest, s.largest);
  std::printf("%.2f M bond-steps/s\n", s.median);
}

} // namespace

int main(int argc, char **argv) {
  Options o;
  CLI::App app("Bond-steps per second of a bonded specimen between rigid platens.");
  app.add_option("--particles", o.particles, "spheres of 1 mm radius")->check(CLI::Range(100, 20000000));
  app.add_option("--threads", o.threads, "threads")->check(CLI::Range(1, 256));
  app.add_option("--steps", o.steps, "steps per repeat")->check(CLI::Range(1, 1000000));
  app.add_option("--repeats", o.repeats, "repeats; the median is printed")->check(CLI::Range(1, 1000));
  app.add_option("--specimen", o.read, "a packing from this file instead")->check(CLI::ExistingFile);
  app.add_option("--write-specimen", o.write, "write the packing to this file");
  app.add_option("--law", o.law, "law of the bonds")->transform(CLI::CheckedTransformer(bench::laws));
  app.add_flag("--baseline", o.baseline, "the kernels of plain x86-64");
  app.add_flag("--avx2", o.avx2, "the kernels of AVX2 (build the loop likewise: PLATEN_LOOP_PROCESSOR)")
      ->excludes("--baseline");
  app.add_flag("--gain", o.gain, "one thread in turn with --threads, and what the others gain");
  app.add_flag("--alone", o.alone, "without the idealised loop");
  CLI11_PARSE(app, argc, argv);

  const ThreadLimit limit(o.threads);
  const dem::Specimen specimen = specimen_for(o);
  coupling::PlatenTestSettings chosen = bench::elastic_press(o.law);
  if (o.baseline) chosen.model.instruction_set = dem::InstructionSet::baseline;
  if (o.avx2) {
    if (dem::best_instruction_set() == dem::InstructionSet::baseline) {
      std::fprintf(stderr, "bench_step: --avx2: this processor has no AVX2\n");
      return 2;
    }
    chosen.model.instruction_set = dem::InstructionSet::avx2;
  }
  const double before = static_cast<double>(apps::peak_memory_bytes());
  const auto start = Clock::now();
  coupling::PlatenTest problem(specimen, chosen);
  std::printf("set up in %.3g s\n", seconds_since(start));
  std::printf("%zu particles, %zu bonds, %d threads, %s kernels, step %.4g s\n",
              problem.model.particles.size(), problem.model.bonds->size(), o.threads,
              dem::name(chosen.model.instruction_set), problem.time_step());
  measure(o, problem, before);
  return 0;
}
