// What a search has found, for the screen, for summary.json and as curves.
#pragma once

#include "apps/calibrate/analysis.h"
#include "apps/output/output_folder.h"
#include "apps/output/summary.h"

namespace platen::apps {

// A choice, and what it makes of the packings that it was found on and of others.
struct Judged {
  Found found;
  Analysis analysis;
  Measured training, unseen;
  bool verified() const { return !unseen.numbers.empty(); }
  const Measured &last() const { return verified() ? unseen : training; }
};

// "target 3: tension: 4.5 MPa (tolerance 2 %)", a line each.
std::string wishes(const Goals &goals);
// "strength_pa, MPa 43.1 +- 1.2" on some packings; of a curve what it is judged by.
std::string measured_text(const Goals &goals, std::size_t goal, const Measured &measured);
// Wanted, calibrated on, unseen, off; a line a goal.
std::string table_of(const Goals &goals, const Judged &judged);
// What each target that is beyond its tolerance lacks: wanted, got, off, tolerance; a line each.
std::vector<std::string> gaps(const Goals &goals, const Judged &judged);
// Sensitivities, correlations, what is not determined, what was missed, which bounds hold.
std::string findings(const Goals &goals, const Judged &judged);

void tell_found(const Goals &goals, const Judged &judged, Json &summary);

// curve.csv (curve_2.csv ...) of each wanted curve: strain, the user's stress, the found ones'.
void write_curves(const Goals &goals, const Judged &judged, const OutputPaths &paths);

} // namespace platen::apps
