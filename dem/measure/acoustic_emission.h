// Acoustic emission: cracks gathered into events, and how the number of events falls with their size.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "base/archive.h"
#include "base/vector3.h"

namespace platen::dem {

// A bond that broke.
struct CrackPulse {
  double time = 0;   // s
  Vector3 point;     // m
  double energy = 0; // J, released
};

// Two cracks are of one event where they are this near in space and in time.
void describe(Archive &archive, const std::string &name, std::vector<CrackPulse> &pulses);

struct EventWindow {
  double reach = 0; // m
  double time = 0;  // s
};
// `radii` mean sphere radii, and the time that a wave takes over `transits` times that distance. Defaults of
// scenes: 5 and 1. A crack unloads its neighbourhood, over some diameters, and can make the next one break no
// sooner than a wave gets there. Smaller windows take events apart into cracks; larger ones join strangers
// once cracks are many, near and after the peak.
EventWindow event_window(double mean_radius, double wave_speed, double radii, double transits);

struct AcousticEvent {
  double time = 0, duration = 0; // s, of the first crack; to the last
  Vector3 centre;                // m, mean of its cracks weighed by energy
  double size = 0;               // m, root mean square distance of its cracks from their mean place
  int cracks = 0;
  double energy = 0;    // J
  double magnitude = 0; // 1; NaN without energy
};

// Gutenberg and Richter's energy of earthquakes (1956, for surface waves), log10(E / J) = 4.8 + 1.5 M,
// carried on to small ones: M = (log10(E / J) - 4.8) / 1.5. NaN where the energy is not positive.
double magnitude_of(double energy);

// Single linkage: cracks joined by a chain of neighbours within the window are one event. By the time of
// their first crack. The order of the cracks does not matter, to the last bit.
std::vector<AcousticEvent> gather_events(std::vector<CrackPulse> cracks, const EventWindow &window);

struct BValueRules {
  double bin = 0.1;        // of magnitude, to find the limit
  double above_mode = 0.2; // from the fullest bin to the limit (Woessner and Wiemer 2005)
  int least_events = 50;   // at and above the limit
  double limit = std::numeric_limits<double>::quiet_NaN(); // not a number: found from the fullest bin
};

// b of log10 N(>= M) = a - b M, from the events at and above the limit M_c, by maximum likelihood (Aki 1965):
//   b = (n - 1) / n log10(e) / (mean M - M_c).
// The first factor takes out the bias of few events. Magnitudes are not rounded, so Utsu's half bin below M_c
// is none. M_c is the lower edge of the fullest bin (Wiemer and Wyss 2000) and `above_mode` on.
// Standard error by Shi and Bolt (1982): ln(10) b^2 sqrt(sum (M - mean M)^2 / (n (n - 1))).
// Numbers are NaN where there are fewer events than the rules want.
struct BValue {
  double b = std::numeric_limits<double>::quiet_NaN(), error = b, limit = b;
  double events = 0; // at and above the limit
};
BValue b_value(const std::vector<double> &magnitudes, const BValueRules &rules = {});

} // namespace platen::dem
