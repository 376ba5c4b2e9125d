#include "limit/bandwidth.h"

#include <chrono>
#include <memory>
#include <stdexcept>

#include "base/parallel.h"

namespace platen::bench {

std::vector<double> triad_bandwidth(int threads, std::size_t elements, int repeats) {
  // Not initialised here: each thread touches its share first, so that the memory is near it.
  const std::unique_ptr<double[]> a(new double[elements]), b(new double[elements]), c(new double[elements]);
  const ThreadLimit limit(threads);
  const std::size_t shares = static_cast<std::size_t>(threads);
  const auto each_share = [&](const auto &body) {
    at_once(shares, [&](std::size_t k) { body(k * elements / shares, (k + 1) * elements / shares); });
  };
  each_share([&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      a[k] = 0, b[k] = 1, c[k] = 2;
  });
  std::vector<double> rates;
  for (int r = 0; r < repeats; ++r) {
    const double s = r;
    const auto start = std::chrono::steady_clock::now();
    each_share([&](std::size_t begin, std::size_t end) {
      double *const to = a.get();
      const double *const from = b.get(), *const scaled = c.get();
      for (std::size_t k = begin; k < end; ++k)
        to[k] = from[k] + s * scaled[k];
    });
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    if (a[elements - 1] != 1 + 2 * s) throw std::logic_error("the triad was not computed");
    rates.push_back(24.0 * static_cast<double>(elements) / seconds.count());
  }
  return rates;
}

} // namespace platen::bench
