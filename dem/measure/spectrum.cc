#include "dem/measure/spectrum.h"

#include <cmath>
#include <complex>
#include <limits>

namespace platen::dem {
namespace {

constexpr double pi = 3.14159265358979323846;

class Transform {
public:
  Transform(const std::vector<double> &samples, double step) : step_(step) {
    const std::size_t n = samples.size();
    double weight = 0, mean = 0;
    for (std::size_t k = 0; k < n; ++k) {
      weight += window(k, n);
      mean += window(k, n) * samples[k];
    }
    mean /= weight;
    for (std::size_t k = 0; k < n; ++k)
      values_.push_back(window(k, n) * (samples[k] - mean));
  }
  // |sum w x exp(-i omega t)|^2
  double power(double frequency) const {
    const std::complex<double> turn = std::polar(1.0, -2 * pi * frequency * step_);
    std::complex<double> sum = 0; // Horner's rule, from the last sample
    for (std::size_t k = values_.size(); k-- > 0;)
      sum = sum * turn + values_[k];
    return std::norm(sum);
  }

private:
  static double window(std::size_t k, std::size_t n) {
    return 0.5 - 0.5 * std::cos(2 * pi * (static_cast<double>(k) + 0.5) / static_cast<double>(n));
  }
  double step_;
  std::vector<double> values_;
};

} // namespace

double main_frequency(const std::vector<double> &samples, double step, double low, double high) {
  if (samples.size() < 8) return std::numeric_limits<double>::quiet_NaN();
  const Transform transform(samples, step);
  // A quarter of the spacing of lines that can be told apart: no peak is missed.
  const double grid = 0.25 / (step * static_cast<double>(samples.size()));
  double best = low, most = 0;
  for (double f = low; f <= high; f += grid)
    if (const double p = transform.power(f); p > most) most = p, best = f;
  if (!(most > 0)) return std::numeric_limits<double>::quiet_NaN();
  // Golden section between the neighbours.
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  double a = best - grid, b = best + grid;
  while (b - a > 1e-10 * best) {
    const double x = b - golden * (b - a), y = a + golden * (b - a);
    if (transform.power(x) > transform.power(y))
      b = y;
    else
      a = x;
  }
  return 0.5 * (a + b);
}

} // namespace platen::dem
