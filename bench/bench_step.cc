// Speed of one step (workload.h says of what), on several numbers of threads in turn. Prints milliseconds of
// each stage, bytes per particle and the line "N M bond-steps/s" (median over repeats) of the last number.
#include <array>
#include <cstdio>

#include "apps/output/machine.h"
#include "base/parallel.h"
#include "workload.h"

namespace {

using namespace platen;

struct Series {
  int threads = 1;
  std::vector<double> rates;                     // M bond-steps/s
  std::array<double, dem::stage_count> stages{}; // s
  double seconds = 0;
};

// What comes after another number of threads needs a moment until its threads have found their processors.
void repeat(Series &s, long steps, coupling::PlatenTest &problem) {
  const ThreadLimit limit(s.threads);
  bench::run(problem, steps / 10 + 1);
  const dem::StageClock before = problem.model.clock;
  const double seconds = bench::seconds_of([&] { bench::run(problem, steps); });
  for (std::size_t k = 0; k < s.stages.size(); ++k) {
    const dem::Stage stage = static_cast<dem::Stage>(k);
    s.stages[k] += problem.model.clock.seconds(stage) - before.seconds(stage);
  }
  s.seconds += seconds;
  s.rates.push_back(static_cast<double>(problem.model.bonds->size() * static_cast<std::size_t>(steps)) /
                    seconds * 1e-6);
}

void print(const char *what, const std::vector<double> &values) {
  const bench::Spread s = bench::spread(values);
  std::printf("%s %.4g (%.4g ... %.4g)\n", what, s.median, s.smallest, s.largest);
}

void print_stages(const Series &s, long steps) {
  const double per_step = 1e3 / static_cast<double>(steps);
  std::printf("%-12s %8s\n", "stage", "ms/step");
  for (std::size_t k = 0; k < s.stages.size(); ++k)
    if (s.stages[k] > 0) std::printf("%-12s %8.4f\n", dem::stage_names[k], s.stages[k] * per_step);
  std::printf("%-12s %8.4f\n", "all", s.seconds * per_step);
}

void measure(const bench::Workload &o, const std::vector<int> &threads, coupling::PlatenTest &problem) {
  std::vector<Series> all(threads.size());
  for (std::size_t k = 0; k < all.size(); ++k)
    all[k].threads = threads[k];
  bench::run(problem, o.steps / 5 + 1); // warm
  for (int r = 0; r < o.repeats; ++r)
    for (Series &s : all)
      repeat(s, o.steps, problem);
  const dem::EnergyLedger energy = problem.energy();
  std::printf("energy: work %.4g J, residual %.2g of it; broken bonds %ld\n", energy.boundary,
              energy.residual() / energy.boundary, problem.model.broken_tension + problem.model.broken_shear);
  std::printf("memory: %.0f bytes per particle in columns and search, bonds included; process %.0f MB\n",
              static_cast<double>(problem.bytes()) / static_cast<double>(problem.model.particles.size()),
              1e-6 * static_cast<double>(apps::peak_memory_bytes()));
  std::vector<double> ledger;
  for (int k = 0; k < 100; ++k)
    ledger.push_back(1e3 * bench::seconds_of([&] { problem.energy(); }));
  print("one sample of the energy ledger, ms:", ledger);
  for (const Series &s : all) {
    std::printf("\n%d threads\n", s.threads);
    print_stages(s, static_cast<long>(o.steps) * o.repeats);
    std::vector<double> gain;
    for (std::size_t k = 0; k < s.rates.size(); ++k)
      gain.push_back(s.rates[k] / all[0].rates[k]);
    if (&s != &all[0]) print("times the speed of the first:", gain);
    print("M bond-steps/s:", s.rates);
  }
  std::printf("%.2f M bond-steps/s\n", bench::spread(all.back().rates).median);
}

} // namespace

int main(int argc, char **argv) {
  bench::Workload o;
  o.steps = 500;
  std::vector<int> threads{1};
  bool baseline = false, avx2 = false;
  bench::read_arguments(
      argc, argv, "Bond-steps per second of a bonded specimen between rigid platens.",
      o.arguments(true, {{"--threads", &threads, "threads; several numbers: in turn", 1, 256},
                         {"--baseline", &baseline, "the kernels of plain x86-64"},
                         {"--avx2", &avx2, "the kernels of AVX2"}}));
  if (baseline && avx2) {
    std::fprintf(stderr, "bench_step: --avx2 excludes --baseline\n");
    return 2;
  }

  coupling::PlatenTestSettings chosen = o.press();
  if (baseline) chosen.model.instruction_set = dem::InstructionSet::baseline;
  if (avx2 && dem::best_instruction_set() == dem::InstructionSet::baseline) {
    std::fprintf(stderr, "bench_step: --avx2: this processor has no AVX2\n");
    return 2;
  }
  if (avx2) chosen.model.instruction_set = dem::InstructionSet::avx2;
  const ThreadLimit limit(*std::max_element(threads.begin(), threads.end()));
  const dem::Specimen specimen = o.specimen();
  const auto start = Clock::now();
  coupling::PlatenTest problem(specimen, chosen);
  std::printf("%zu particles, %zu bonds, %s kernels, step %.4g s, set up in %.3g s\n",
              problem.model.particles.size(), problem.model.bonds->size(),
              dem::name(chosen.model.instruction_set), problem.time_step(), seconds_since(start));
  measure(o, threads, problem);
  return 0;
}
