// What a break costs in specimens of several sizes, which should be the same: the bond's force passes to its
// contact, and the next loop over contacts has the new row.
#include <cstdio>
#include <vector>

#include "base/clock.h"
#include "base/parallel.h"
#include "base/random.h"
#include "workload.h"

using namespace platen;

namespace {

void measure(int particles, int breaks) {
  bench::Workload workload;
  workload.particles = particles;
  coupling::PlatenTest test(workload.specimen(), workload.press());
  bench::run(test, 3);
  dem::Model &model = test.model;
  const auto &search = model.contacts->search_state();
  const double dt = test.time_step();
  Random random(1);
  double of_break = 0, of_loop = 0;
  const std::size_t moved = search.bytes_moved();
  for (int done = 0; done < breaks;) {
    const int row = static_cast<int>(random.uniform(0, static_cast<double>(model.bonds->size())));
    if (model.bonds->normal_stiffness[row] == 0) continue;
    const auto start = Clock::now();
    std::vector<dem::BrokenBond> broken =
        model.bonds->break_rows({{row, dem::BondState::broken_in_tension}}, model.particles, model.time);
    model.contacts->take_over(model.particles, *model.bonds, broken, dt);
    of_break += seconds_since(start);
    const auto loop = Clock::now();
    model.contacts->compute(model.particles, dt);
    of_loop += seconds_since(loop);
    ++done;
  }
  std::printf(
      "%8zu spheres: %6.1f us a break, %6.1f us the loop over contacts after it, %6.0f bytes moved in "
      "lists\n",
      model.particles.size(), 1e6 * of_break / breaks, 1e6 * of_loop / breaks,
      static_cast<double>(search.bytes_moved() - moved) / breaks);
}

} // namespace

int main(int argc, char **argv) {
  std::vector<int> particles{20000, 80000, 320000};
  int breaks = 400;
  bench::read_arguments(
      argc, argv, "What a break of a bond costs, by the size of the specimen.",
      {{"--particles", &particles, "spheres of each specimen", 100, 2e7},
       {"--breaks", &breaks, "bonds that are broken in each, one after the other", 1, 1e6}});
  const ThreadLimit one(1);
  for (const int n : particles)
    measure(n, breaks);
}
