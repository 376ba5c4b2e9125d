// The trials of a calibration: answers of a packing to a choice of bonds, moduli by static solves, all else
// by runs of platen-compress or platen-brazilian. Runs keep their results in the output folder, so that none
// is made twice.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "apps/calibrate/choice.h"
#include "apps/calibrate/curve.h"
#include "apps/many/runs.h"
#include "apps/output/output_folder.h"
#include "apps/output/run_log.h"
#include "apps/scene/command_line.h"
#include "dem/measure/bond_network.h"

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
dem::NetworkModuli network_bounds(const Scene &scene, const dem::Specimen &specimen);

// Of trials.csv, whatever is asked for. All are known when the stress has fallen to four fifths of its peak.
extern const std::vector<std::string> usual_figures;
// What a run beside its test has in common with all trials: it writes what is read alone. One of usual
// figures ends when these are known, unless a curve is kept, without ledger and crack log; any other is as
// the scene has it, for its figure may depend on where it ends.
std::vector<std::string> entries_of_trials(const Scene &scene, const SpecimenTest &test);
// What a run that is done tells. A figure that is not valid has no number, and the status its reason.
TrialResult result_of(const SpecimenTest &test, const Json &summary, const std::filesystem::path &folder);

struct Trial {
  SpecimenTest test;
  unsigned long seed = 1; // of the packing
  Choice choice;
};

// Packings that a calibration is made on, and those that it is judged by.
std::vector<unsigned long> training_seeds(const Scene &scene);
std::vector<unsigned long> unseen_seeds(const Scene &scene, std::size_t round = 0); // others in each round

// Entries of the scene with which a test is made of the scene's own bonds, over those of the command line.
std::vector<std::string> entries_of(const Scene &scene, const CommandLine &command, const SpecimenTest &test,
                                    const Choice &choice, unsigned long seed);

class Trials {
public:
  Trials(const CommandLine &command, const Scene &scene, const OutputPaths &paths, int threads, RunLog &log);

  // Results in the order of the trials. Each run is a process with an output folder of its own below runs/;
  // one that is whole there, of this scene and these entries, is kept (carry_out). Static solves are made
  // here and made again by --resume. trials.csv is written anew. Throws Stopped after a signal.
  std::vector<TrialResult> operator()(const std::vector<Trial> &trials);
  const dem::Specimen &packing(unsigned long seed); // of the scene's own form
  Scene with(const Choice &choice, unsigned long seed) const;

  long made() const { return made_; }     // here, not read
  long failed() const { return failed_; } // of all that were asked for

private:
  std::string key_of(const Trial &trial) const;
  void solve(const std::vector<Trial> &trials);
  void run(const std::vector<Trial> &trials);
  dem::Specimen packed(const Scene &scene) const;
  void keep(const Trial &trial, TrialResult result);
  void write() const;

  const CommandLine &command_;
  const Scene &scene_;
  OutputPaths paths_;
  std::string shared_; // folder of packings; "": the user's cache has them
  int threads_;
  RunLog &log_;
  std::map<unsigned long, dem::Specimen> packings_;
  std::vector<std::string> choices_; // entries of those that were tried, by number less one
  std::map<std::string, TrialResult> known_;
  std::vector<Trial> asked_; // what is known, in the order in which it was asked for
  long made_ = 0, failed_ = 0;
};

} // namespace platen::apps
