// Acoustic emission: cracks grouped into events, and how the number of events decreases with their size.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "base/archive.h"
#include "base/vector3.h"

namespace platen::dem {

// A broken bond.
struct CrackPulse {
  double time = 0;   // s
  Vector3 point;     // m
  double energy = 0; // J, released
};

void describe(Archive &archive, const std::string &name, std::vector<CrackPulse> &pulses);

struct EventWindow {
  double reach = 0; // m; two cracks belong to one event if they are this near in space and in time
  double time = 0;  // s
};
// A reach of `radii` mean sphere radii, and the time of a wave over `transits` times that distance. Defaults
// of scenes: 5 and 1. A crack unloads its neighbourhood over some diameters, and cannot make the next bond
// break before a wave arrives there. Smaller windows split events into cracks; larger ones join independent
// cracks once cracks are many, near and after the peak.
EventWindow event_window(double mean_radius, double wave_speed, double radii, double transits);

struct AcousticEvent {
  double time = 0, duration = 0; // s: of the first crack; from the first to the last
  Vector3 centre;                // m, mean of its cracks weighted by energy
  double size = 0;               // m, root mean square distance of its cracks from their mean position
  int cracks = 0;
  double energy = 0;    // J
  double magnitude = 0; // 1; NaN without energy
};

// Gutenberg and Richter's energy of earthquakes (1956, for surface waves), log10(E / J) = 4.8 + 1.5 M,
// extrapolated to small ones: M = (log10(E / J) - 4.8) / 1.5. NaN if the energy is not positive.
double magnitude_of(double energy);

// Single linkage: cracks joined by a chain of neighbours within the window are one event. Events are sorted
// by the time of their first crack. The order of the cracks does not change the result, to the last bit.
std::vector<AcousticEvent> gather_events(std::vector<CrackPulse> cracks, const EventWindow &window);

struct BValueRules {
  double bin = 0.1;            // of magnitude: step of the limits of the range
  double above_mode = 0.2;     // from the fullest bin to the first limit (Woessner and Wiemer 2005)
  int least_events = 50;       // in the range
  double least_fraction = 0.5; // fraction that the range contains of the events above the first limit
  double limit = std::numeric_limits<double>::quiet_NaN(); // NaN: found from the fullest bin
};

enum class PowerLaw {
  holds,
  few_events,  // fewer than the rules require
  not_followed // no range with enough events, a decade in number and a decade in energy follows the law
};

// b of log10 N(>= M) = a - b M, by maximum likelihood over the range of magnitudes from M_c to M_u in which
// that law holds. Without an upper end (Aki 1965)
//   b = (n - 1) / n log10(e) / (mean M - M_c),
// where the first factor removes the bias of few events, with the standard error of Shi and Bolt (1982),
// ln(10) b^2 sqrt(sum (M - mean M)^2 / (n (n - 1))). With an upper end (Page 1968) beta = ln(10) b solves
//   mean M - M_c = 1 / beta - L / (exp(beta L) - 1), L = M_u - M_c,
// with the error from the curvature of the likelihood. Magnitudes are not rounded, so Utsu's half bin below
// M_c is zero.
//
// The first M_c is the lower edge of the fullest bin (Wiemer and Wyss 2000) plus `above_mode`. Of all ranges
// that begin there or a number of bins higher, the one with the most events is taken whose law is not
// rejected: its distance from the events (Kolmogorov and Smirnov, with fitted parameter: Stephens 1974) is
// below the value that a tenth of such samples exceed; without an upper end the largest event is also as
// large as in 95 % of such catalogues. The range must contain the rules' fraction of the events above the
// first M_c, the rate must fall to a tenth over it and the energy grow tenfold: less shows no power law.
struct BValue {
  double b = std::numeric_limits<double>::quiet_NaN(), error = b; // NaN if no law holds
  double limit = b;                                               // M_c; if no law holds, the first one
  double upper = b;                                               // M_u; infinite: all above the limit
  double events = 0; // in the range; if no law holds, above the first M_c
  double above = 0;  // events above M_u
  PowerLaw law = PowerLaw::few_events;
  // Number of events of magnitude M and more, by the law; M within the range.
  double count(double magnitude) const;
};
BValue b_value(const std::vector<double> &magnitudes, const BValueRules &rules = {});

// "12 events from the magnitude of completeness on; a b-value needs 50"; empty if the law holds.
std::string reason_against(const BValue &value, const BValueRules &rules = {});

} // namespace platen::dem
