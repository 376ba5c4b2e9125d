// Strength under pressure of a study of platens with several cells: the line of failure of each packing,
// Mohr's circles, and what codes and laboratories give.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/report/platen_study.h"

namespace platen::apps::report {

// sigma1 = q + k sigma3 by least squares over the pressures of one packing, and the same as Mohr-Coulomb:
// sin(phi) = (k - 1) / (k + 1), c = q / (2 sqrt(k)).
struct FailureLine {
  unsigned long seed = 0;
  int pressures = 0;
  double q = 0, k = 0;          // MPa, 1
  double cohesion = 0, phi = 0; // MPa, degrees; NaN where k is below 1 or q below 0
};
// NaN throughout where the pressures (MPa) are not two or more.
FailureLine line_through(const std::vector<double> &pressure, const std::vector<double> &strength);

struct EnvelopePoint {
  double pressure = 0; // MPa
  Spread strength{};   // MPa, over the packings
  int packings = 0;
};

struct Envelope {
  std::string label; // "dry steel, height/width 2"
  std::vector<EnvelopePoint> points;
  std::vector<FailureLine> lines; // one a packing
  Spread q{}, k{}, cohesion{}, phi{};
  double unconfined() const; // MPa, mean strength without pressure; NaN where none was tested
};

// EN 1998-3 (after Newman): f_cc = f_c (1 + 3.7 (p / f_c)^0.86); Richart, Brandtzaeg and Brown 1928: f_cc =
// f_c
// + 4.1 p. MPa.
double strength_en_1998_3(double unconfined, double pressure);
double strength_richart(double unconfined, double pressure);

// By platens, slenderness and spheres, those with two pressures or more. Runs count that came to their end,
// of cases whose runs all had a peak; others are remarks.
std::vector<Envelope> envelopes_of(const StudyResults &study, const std::filesystem::path &folder,
                                   std::vector<std::string> &remarks);

TableOfFigures table_of(const Envelope &envelope);
TableOfFigures table_of_lines(const Envelope &envelope);

// Needs an X server; throws OutputError.
void draw_envelope(const StudyResults &study, const Envelope &envelope, const std::filesystem::path &png);

} // namespace platen::apps::report
