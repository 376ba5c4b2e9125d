// Static solves of a platen by UMFPACK and by conjugate gradients with smoothed aggregation: seconds to set
// up and to solve, by size.
#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

#include "base/clock.h"
#include "base/parallel.h"
#include "fem/elastic_model.h"
#include "fem/static_equations.h"

namespace {

using namespace platen;

struct Cost {
  double setup, solve;
  int iterations;
  std::vector<Vector3> x;
};

// Loads that change a little from solve to solve, as those of contacts do; each starts from the last answer.
Cost measure(const fem::ElasticModel &model, const fem::Fixed &fixed, fem::LinearSolver kind, int solves) {
  Cost cost{};
  auto start = Clock::now();
  const fem::StaticEquations solver(model.stiffness, model.nodes, fixed, kind);
  cost.setup = seconds_since(start);
  cost.x.assign(model.nodes.size(), Vector3{});
  for (int k = 0; k < solves; ++k) {
    const auto load = fem::body_load(model, [&](const Vector3 &p) {
      return Vector3{0, 1e5, 1e6 * (1 + 0.1 * std::sin(300 * p[0] + 0.1 * k) * std::cos(200 * p[1]))};
    });
    start = Clock::now();
    solver.solve(model.stiffness, load, cost.x);
    cost.solve += seconds_since(start) / solves;
  }
  cost.iterations = solver.iterations();
  return cost;
}

} // namespace

int main(int argc, char **argv) {
  CLI::App app("Static solves of a steel platen (60 mm across, 20 mm thick) by size and solver");
  int threads = 1, solves = 10, degree = 1, largest_direct = 32;
  std::vector<int> across = {8, 16, 32, 64};
  app.add_option("-t,--threads", threads, "threads; 0: all");
  app.add_option("--solves", solves, "solves per set-up")->check(CLI::PositiveNumber);
  app.add_option("--degree", degree, "1 or 2")->check(CLI::Range(1, 2));
  app.add_option("--across", across, "elements across");
  app.add_option("--largest-direct", largest_direct, "elements across that UMFPACK is still asked for");
  CLI11_PARSE(app, argc, argv);
  try {
    const ThreadLimit limit(threads);
    std::printf("across degree nodes solver setup_s solve_s iterations difference\n");
    for (const int n : across) {
      const fem::ElasticModel model =
          fem::make_elastic_model(fem::make_grid(fem::CylinderPlate{0.03, 0.02, 0, n, std::max(1, n / 3)}),
                                  degree, {{7850, 210e9, 0.3}});
      fem::Fixed fixed(model.nodes.size(), {0, 0, 0});
      for (const int i : fem::nodes_on(model, fem::high_end_tag))
        fixed[static_cast<std::size_t>(i)] = {1, 1, 1};
      std::vector<Vector3> first;
      for (const fem::LinearSolver kind : {fem::LinearSolver::multigrid, fem::LinearSolver::direct}) {
        if (kind == fem::LinearSolver::direct && n > largest_direct) continue;
        const Cost cost = measure(model, fixed, kind, solves);
        double difference = 0, size = 0;
        for (std::size_t i = 0; i < first.size(); ++i) {
          difference = std::max(difference, norm(first[i] - cost.x[i]));
          size = std::max(size, norm(first[i]));
        }
        std::printf("%d %d %zu %s %.4f %.5f %d %.1e\n", n, degree, model.nodes.size(),
                    kind == fem::LinearSolver::direct ? "direct" : "multigrid", cost.setup, cost.solve,
                    cost.iterations, size > 0 ? difference / size : 0.0);
        std::fflush(stdout);
        if (first.empty()) first = cost.x;
      }
    }
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_platen_solve: %s\n", error.what());
    return 1;
  }
}
