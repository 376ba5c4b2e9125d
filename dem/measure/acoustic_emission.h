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
  double bin = 0.1;         // of magnitude: steps of the ends of the range
  double above_mode = 0.2;  // from the fullest bin to the first limit (Woessner and Wiemer 2005)
  int least_events = 50;    // in the range
  double least_share = 0.5; // of the events from the first limit on that the range holds
  double limit = std::numeric_limits<double>::quiet_NaN(); // not a number: found from the fullest bin
};

enum class PowerLaw {
  holds,
  few_events,  // fewer than the rules want
  not_followed // no range that holds enough events, a decade of their number and one of energy follows it
};

// b of log10 N(>= M) = a - b M, where that law holds: over a range of magnitudes from M_c on to M_u, by
// maximum likelihood. Without an upper end (Aki 1965)
//   b = (n - 1) / n log10(e) / (mean M - M_c),
// where the first factor takes out the bias of few events, with the standard error of Shi and Bolt (1982),
// ln(10) b^2 sqrt(sum (M - mean M)^2 / (n (n - 1))). With one (Page 1968) beta = ln(10) b solves
//   mean M - M_c = 1 / beta - L / (exp(beta L) - 1), L = M_u - M_c,
// with the error of the likelihood's curvature. Magnitudes are not rounded, so Utsu's half bin below M_c is
// none.
//
// The first M_c is the lower edge of the fullest bin (Wiemer and Wyss 2000) and `above_mode` on. Of all
// ranges that begin there or a number of bins later, the one with the most events is taken whose law is not
// refused: its distance from the events (Kolmogorov and Smirnov's, its parameter fitted: Stephens 1974) is
// one that a tenth of such samples pass; without an upper end also the largest event is as large as 95 % of
// such catalogues have it. It must hold the rules' share of the events from the first M_c on, and its rate
// must fall to a tenth while the energy grows tenfold: less is no power law.
struct BValue {
  double b = std::numeric_limits<double>::quiet_NaN(), error = b; // NaN where no law holds
  double limit = b;                                               // M_c; where no law holds, the first one
  double upper = b;                                               // M_u; infinite: all from the limit on
  double events = 0; // of the range; where no law holds, from the first M_c on
  double above = 0;  // events beyond M_u
  PowerLaw law = PowerLaw::few_events;
  // Events of magnitude M and more, by the law; M within the range.
  double count(double magnitude) const;
};
BValue b_value(const std::vector<double> &magnitudes, const BValueRules &rules = {});

// "of 12 events from the magnitude of completeness on; 50 are wanted"; empty where the law holds.
std::string reason_against(const BValue &value, const BValueRules &rules = {});

} // namespace platen::dem
