// How large a specimen this machine takes: set up, stepped and kept in a checkpoint, in one process or on
// ranks (mpirun -n 2 bench_size). Prints seconds and bytes a particle of each stage.
#include <mpi.h>

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "apps/output/checkpoint_folder.h"
#include "apps/output/machine.h"
#include "apps/run/ranks.h"
#include "apps/scene/rank.h"
#include "base/clock.h"
#include "base/parallel.h"
#include "dist/ranks.h"
#include "dist/session.h"
#include "step_scene.h"

namespace {

using namespace platen;

constexpr int most_packed = 50000; // beyond, tiles that repeat themselves

struct Options {
  int particles = 1000000, threads = 1;
  long steps = 20;
  std::string folder = "bench_size_checkpoint";
};

class Stages {
public:
  explicit Stages(double particles) : particles_(particles) {}
  void done(const char *what, long times = 1) {
    const double seconds = seconds_since(start_) / static_cast<double>(times);
    const double peak = static_cast<double>(apps::peak_memory_bytes());
    if (!apps::this_rank().is_silent())
      std::printf("%-28s %10.4g s   largest memory so far %8.0f MB, %6.0f bytes a particle\n", what, seconds,
                  1e-6 * peak, peak / particles_);
    std::fflush(stdout);
    start_ = Clock::now();
  }

private:
  double particles_;
  Clock::time_point start_ = Clock::now();
};

void measure(const Options &o) {
  const ThreadLimit limit(o.threads);
  Stages stage(o.particles);
  std::unique_ptr<coupling::PlatenTest> test;
  std::size_t bonds = 0;
  {
    const dem::Specimen specimen =
        (o.particles > most_packed ? bench::repeated(o.particles) : bench::close_packed(o.particles));
    stage.done("packing");
    test = std::make_unique<coupling::PlatenTest>(specimen, bench::elastic_press());
    bonds = test->model.bonds->size();
  }
  stage.done("bonds, contacts, time step");
  if (apps::this_rank().of > 1) test->share(std::make_unique<dist::Ranks>(MPI_COMM_WORLD));
  bench::run(*test, 1);
  stage.done("first step");
  bench::run(*test, o.steps);
  stage.done("a step", o.steps);
  const auto fill = [&](StateSink &to) { save_part(to, "test", *test); };
  const auto number = static_cast<std::uint64_t>(test->steps());
  test->settle_state();
  if (test->model.is_cut())
    apps::write_checkpoint_of_ranks(test->model, "test/specimen/", o.folder, number, fill);
  else
    apps::write_checkpoint(o.folder, number, fill);
  const std::filesystem::path file = apps::newest_whole_checkpoint(o.folder).path;
  stage.done("checkpoint");
  if (apps::this_rank().is_silent()) return;
  std::printf(
      "%zu particles, %zu bonds, %d ranks of %d threads; %.0f bytes a particle in columns and search; "
      "checkpoint %.0f bytes a particle\n",
      test->model.particles.size(), bonds, apps::this_rank().of, o.threads,
      static_cast<double>(test->bytes()) / o.particles,
      static_cast<double>(std::filesystem::file_size(file)) / o.particles);
}

} // namespace

int main(int argc, char **argv) {
  const dist::Session session;
  apps::this_rank() = {session.rank(), session.ranks(), session.ranks_here(), dist::Session::end_all};
  Options o;
  CLI::App app("Set-up, steps and checkpoint of a large specimen.");
  app.add_option("--particles", o.particles, "spheres of 1 mm radius")->check(CLI::Range(1000, 100000000));
  app.add_option("--threads", o.threads, "threads of each rank")->check(CLI::Range(1, 256));
  app.add_option("--steps", o.steps, "steps")->check(CLI::Range(1, 1000000));
  app.add_option("--folder", o.folder, "where the checkpoint goes");
  CLI11_PARSE(app, argc, argv);
  measure(o);
  return 0;
}
