// Frequencies of oscillations and times of passing pulses, from evenly spaced samples.
#pragma once

#include <vector>

namespace platen::dem {

// The frequency (1/s) between `low` and `high` with the largest part in the samples, which are `step` seconds
// apart: the peak of their Fourier transform under a Hann window, at any frequency, not only at multiples of
// 1/T. A single line is found to about 1e-4 of 1/T from some five periods on; of several lines the largest,
// if they are 4/T apart. NaN with fewer than 8 samples, or without oscillation.
double main_frequency(const std::vector<double> &samples, double step, double low, double high);

// Time at which a short pulse passes, s after the first sample: the centre of gravity of its velocities
// (m/s), smoothed by a Hann window of length `smoothing` (s), over 0.6 of that to either side. If a pulse
// spreads by dispersion, this point keeps the speed of long waves, whatever the shape of the pulse: the delay
// of the centre of gravity is the slope of the phase at frequency 0. Smoothing removes the wake of short
// waves, which would last longer than the samples. `expected` (s) is a first guess. NaN if samples end before
// the window, or no pulse passes. Before the first sample all is at rest.
double passing_time(const std::vector<double> &velocity, double step, double smoothing, double expected);

} // namespace platen::dem
