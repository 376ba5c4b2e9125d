// Frequencies of what oscillates and times of what passes, from even samples.
#pragma once

#include <vector>

namespace platen::dem {

// The frequency (1/s) between `low` and `high` whose share in the samples, `step` seconds apart, is largest:
// the peak of their Fourier transform under a Hann window, taken at any frequency, not at multiples of 1/T
// alone. A single line is found to about 1e-4 of 1/T from some five periods on; of several lines the largest,
// where they lie 4/T apart. NaN where there are fewer than 8 samples, or nothing oscillates.
double main_frequency(const std::vector<double> &samples, double step, double low, double high);

// When a short pulse passes, s after the first sample: its velocities (m/s), smoothed by a Hann window as
// long as `smoothing` (s), have their centre of gravity then, over 0.6 of that to either side. A pulse that
// spreads by dispersion keeps to the speed of long waves in this point, whatever its shape: the delay of
// the centre of gravity is the slope of the phase at frequency 0. Smoothing takes out the wake of short
// waves, which would outlast the samples. `expected` (s) is a first guess. NaN where samples end before the
// window does, or nothing passes. What comes before the first sample is at rest.
double passing_time(const std::vector<double> &velocity, double step, double smoothing, double expected);

} // namespace platen::dem
