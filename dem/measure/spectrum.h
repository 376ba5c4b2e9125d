// Frequencies of what swings, from even samples.
#pragma once

#include <vector>

namespace platen::dem {

// The frequency (1/s) between `low` and `high` whose share in the samples, `step` seconds apart, is largest:
// the peak of their Fourier transform under a Hann window, taken at any frequency, not at multiples of 1/T
// alone. A single line is found to about 1e-4 of 1/T from some five periods on; of several lines the largest,
// where they lie 4/T apart. NaN where there are fewer than 8 samples, or nothing swings.
double main_frequency(const std::vector<double> &samples, double step, double low, double high);

} // namespace platen::dem
