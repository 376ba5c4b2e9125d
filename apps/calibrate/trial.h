// One answer of a packing to one choice of bonds: moduli by static solves, all else by a run of
// platen-compress or platen-brazilian.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/calibrate/choice.h"
#include "apps/calibrate/target_curve.h"
#include "apps/output/summary.h"
#include "dem/measure/bond_network.h"
#include "dem/packing/specimen.h"

namespace platen::apps {

// What a packing goes through for one target or several.
struct SpecimenTest {
  std::string name = "elastic";     // of its runs: "triaxial_strength_pa"
  std::string program = "";         // "compress" or "brazilian"; "" of a static solve
  std::vector<std::string> entries; // "Section/Key = value" over the scene
  std::vector<std::string> figures; // that are asked of its summary.json
  // Stresses are kept at `curve_points` equal steps of strain up to here, peak or not; 0: none are.
  double curve_strain = 0;
  bool curve_of_gauge = false; // else strain between the platens

  bool loads() const { return !program.empty(); }
};

struct TrialResult {
  std::string status = "done"; // or why there is no number
  Json summary = {};           // by the keys of summary.json; of a static solve the moduli alone
  std::vector<double> curve;   // Pa, where the test keeps them
  bool good() const { return status == "done"; }
  double number(const std::string &key) const { return number_in(summary, key); } // NaN: not measured
  // It was not quasi-static: what it bore is not the specimen's strength, and does not count.
  bool too_fast() const { return status.rfind(too_fast_words, 0) == 0; }
  static constexpr const char *too_fast_words = "too fast to be quasi-static";
};

// Moduli of the middle half, between the platens of the scene, at Calibrate/Strain.
TrialResult solve_statically(const Scene &scene, const dem::Specimen &specimen);
// Of the bonds of a scene, without a solve.
dem::NetworkModuli bounds_of(const Scene &scene, const dem::Specimen &specimen);

// Of trials.csv, whatever is asked for. All are known when the stress has fallen to four fifths of its peak.
extern const std::vector<std::string> usual_figures;
// What a run beside its test has in common with all trials: it writes what is read alone. One of usual
// figures ends when these are known, unless a curve is kept, without ledger and crack log; any other is as
// the scene has it, for its figure may depend on where it ends.
std::vector<std::string> entries_of_trials(const Scene &scene, const SpecimenTest &test);
// What a run that is done tells. A figure that is not valid has no number, and the status its reason.
TrialResult result_of(const SpecimenTest &test, const Json &summary, const std::filesystem::path &folder);

} // namespace platen::apps
