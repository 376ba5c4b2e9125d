// Speed of one step on several ranks beside one process, in turn and in one run: mpirun -n 2 bench_ranks.
// Prints what N ranks of one thread gain over one thread, and over N threads; what one rank costs beside the
// plain program; messages and bytes of a step beside the formula; and how much of the exchange is hidden.
#include <mpi.h>
#include <unistd.h>

#include <cstdio>
#include <memory>

#include "base/parallel.h"
#include "dist/ranks.h"
#include "workload.h"

namespace {

using namespace platen;

int rank = 0, ranks = 1;

// Ranks that have nothing to do sleep, so that the others have the machine.
void wait_for_all() {
  constexpr useconds_t glance = 200;
  MPI_Request all = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &all);
  int done = 0;
  while (MPI_Test(&all, &done, MPI_STATUS_IGNORE) == MPI_SUCCESS && !done)
    ::usleep(glance);
}

double seconds_of(coupling::PlatenTest &test, long steps, int threads) {
  const ThreadLimit limit(threads);
  bench::run(test, steps / 10 + 1);
  return bench::seconds_of([&] { bench::run(test, steps); });
}

struct Problem {
  std::unique_ptr<coupling::PlatenTest> test;
  const dist::Ranks *ranks = nullptr;
};

Problem problem_of(const dem::Specimen &specimen, MPI_Comm over) {
  Problem p{std::make_unique<coupling::PlatenTest>(specimen, bench::Workload().press()), nullptr};
  if (over == MPI_COMM_NULL) return p;
  auto exchange = std::make_unique<dist::Ranks>(over);
  p.ranks = exchange.get();
  p.test->share(std::move(exchange));
  return p;
}

// Seconds a step of the exchange by itself: all messages and the reduction, with nothing beside them.
double exchange_alone(coupling::PlatenTest &test, int times) {
  dem::Model &model = test.model;
  dem::Exchange &exchange = *model.exchange();
  MPI_Barrier(MPI_COMM_WORLD);
  const auto start = Clock::now();
  for (int k = 0; k < times; ++k) {
    exchange.send_motion(model.particles);
    exchange.start_sums({});
    exchange.receive_motion(model.particles);
    exchange.finish_sums();
    exchange.send_bond_ghosts(model.bonds->blocks);
    if (model.contacts) exchange.send_contact_ghosts(model.contacts->blocks());
    exchange.receive_ghosts(&model.bonds->blocks, model.contacts ? &model.contacts->blocks() : nullptr);
  }
  return seconds_since(start) / times;
}

// Of each rank, and of the plain program on rank 0.
void print_stages(const dem::StageClock &of, long steps, const char *whose) {
  std::printf("%s, ms a step:", whose);
  for (int k = 0; k < dem::stage_count; ++k)
    if (const double s = of.seconds(static_cast<dem::Stage>(k)); s > 0)
      std::printf(" %s %.4f", dem::stage_names[static_cast<std::size_t>(k)],
                  1e3 * s / static_cast<double>(steps));
  std::printf("\n");
  std::fflush(stdout);
}

void print_spread(const char *what, std::vector<double> values) {
  const bench::Spread s = bench::spread(std::move(values));
  std::printf("%-52s %.3f (%.3f ... %.3f)\n", what, s.median, s.smallest, s.largest);
}

void print_traffic(const Problem &p, const dist::Traffic &before, const dist::Traffic &now, double seconds,
                   double alone) {
  const double steps = static_cast<double>(now.steps - before.steps);
  double own[3] = {(now.bytes - before.bytes) / steps,
                   static_cast<double>(now.messages - before.messages) / steps,
                   (now.waited - before.waited) / steps};
  double formula[2] = {p.ranks->expected_bytes(), static_cast<double>(p.ranks->expected_messages())};
  std::size_t closed = 0; // contacts of platens, whose loads go to all
  for (const auto &boundary : p.test->boundaries())
    closed += boundary->closed();
  constexpr double bytes_of_load = 152;
  const double counts = 8 * static_cast<double>(p.test->boundaries().size());
  if (rank == 0) formula[0] += (ranks - 1) * (bytes_of_load * static_cast<double>(closed) + ranks * counts);
  formula[1] += ranks - 1;
  double most_waited = own[2];
  MPI_Allreduce(MPI_IN_PLACE, own, 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  MPI_Allreduce(MPI_IN_PLACE, formula, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  MPI_Allreduce(MPI_IN_PLACE, &most_waited, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  if (rank != 0) return;
  std::printf("a step of all ranks: %.1f messages, %.0f bytes; formula: %.1f messages, %.0f bytes\n", own[1],
              own[0], formula[1], formula[0]);
  std::printf(
      "a step takes %.4f ms; its exchange alone %.4f ms; waited %.4f ms on the mean, %.4f at most: "
      "hidden %.2f of the exchange\n",
      1e3 * seconds, 1e3 * alone, 1e3 * own[2] / ranks, 1e3 * most_waited, 1 - own[2] / ranks / alone);
}

void measure(const bench::Workload &o) {
  const dem::Specimen specimen = o.specimen();
  Problem alone, one, all = problem_of(specimen, MPI_COMM_WORLD);
  if (rank == 0) {
    alone = problem_of(specimen, MPI_COMM_NULL);
    one = problem_of(specimen, MPI_COMM_SELF);
    std::printf("%zu particles, %zu bonds, %d ranks\n", specimen.size(), alone.test->model.bonds->size(),
                ranks);
  }
  seconds_of(*all.test, o.steps, 1);
  if (rank == 0) std::printf("%s\n", dist::describe(all.ranks->partition()).c_str());
  std::vector<double> over_one, over_threads, cost_of_one, on_ranks;
  const dist::Traffic before = all.ranks->traffic();
  for (int r = 0; r < o.repeats; ++r) {
    double on_one = 0, on_threads = 0, by_one_rank = 0;
    if (rank == 0) {
      on_one = seconds_of(*alone.test, o.steps, 1);
      by_one_rank = seconds_of(*one.test, o.steps, 1);
      on_threads = seconds_of(*alone.test, o.steps, ranks);
    }
    wait_for_all();
    const double seconds = seconds_of(*all.test, o.steps, 1);
    wait_for_all();
    over_one.push_back(on_one / seconds);
    over_threads.push_back(on_threads / seconds);
    cost_of_one.push_back(by_one_rank / on_one);
    on_ranks.push_back(seconds / o.steps);
  }
  const dist::Traffic now = all.ranks->traffic();
  const double step = bench::spread(on_ranks).median, exchange = exchange_alone(*all.test, 200);
  if (rank == 0) {
    print_spread("ranks over one thread of one process", over_one);
    print_spread("ranks over as many threads of one process", over_threads);
    print_spread("one rank: seconds over those of the plain program", cost_of_one);
  }
  print_traffic(all, before, now, step, exchange);
  if (rank == 0) print_stages(one.test->model.clock, one.test->steps(), "one rank");
  for (int r = 0; r < ranks; ++r) {
    MPI_Barrier(MPI_COMM_WORLD);
    if (r == rank)
      print_stages(all.test->model.clock, all.test->steps(), ("rank " + std::to_string(rank)).c_str());
  }
}

} // namespace

int main(int argc, char **argv) {
  bench::Workload o;
  o.steps = 200, o.repeats = 21;
  bench::read_arguments(argc, argv, "Steps of a bonded specimen on several ranks, beside one process.",
                        o.arguments(false));
  int level = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  measure(o);
  MPI_Finalize();
  return 0;
}
