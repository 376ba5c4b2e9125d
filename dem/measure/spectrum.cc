#include "dem/measure/spectrum.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "base/pi.h"

namespace platen::dem {
namespace {

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

// Under a Hann window of n samples about each time k - (n - 1) / 2, from k = 0 on.
std::vector<double> smoothed(const std::vector<double> &values, std::size_t n) {
  std::vector<double> window(n), result(values.size());
  for (std::size_t j = 0; j < n; ++j)
    window[j] = 1 - std::cos(2 * pi * (static_cast<double>(j) + 0.5) / static_cast<double>(n));
  for (std::size_t k = 0; k < values.size(); ++k)
    for (std::size_t j = 0; j < n && j <= k; ++j)
      result[k] += window[j] * values[k - j];
  return result;
}

} // namespace

double passing_time(const std::vector<double> &velocity, double step, double smoothing, double expected) {
  constexpr double reach = 0.6;   // of the smoothing, to either side of the time
  constexpr int corrections = 20; // of the guess; each leaves less than a fifth of the error
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::size_t n = static_cast<std::size_t>(smoothing / step);
  if (n < 2) return none;
  const std::vector<double> smooth = smoothed(velocity, n);
  const double shift = 0.5 * static_cast<double>(n - 1) * step;
  double time = expected;
  for (int correction = 0; correction < corrections; ++correction) {
    double sum = 0, moment = 0;
    for (std::size_t k = 0; k < smooth.size(); ++k) {
      // Samples at the edge count by their fraction in the window, so that the time does not jump.
      const double t = static_cast<double>(k) * step - shift, rim = reach * smoothing - std::abs(t - time);
      const double fraction = std::min(1.0, std::max(0.0, rim / step + 0.5));
      sum += fraction * smooth[k];
      moment += fraction * smooth[k] * t;
    }
    time = moment / sum;
  }
  const double last = static_cast<double>(smooth.size()) * step - shift;
  return time + reach * smoothing < last ? time : none;
}

double main_frequency(const std::vector<double> &samples, double step, double low, double high) {
  if (samples.size() < 8) return std::numeric_limits<double>::quiet_NaN();
  const Transform transform(samples, step);
  // A quarter of the spacing of distinguishable lines: no peak is missed.
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
