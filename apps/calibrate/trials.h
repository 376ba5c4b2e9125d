// The trials of a calibration: packings and results are kept in the output folder, so that none is made
// twice.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/calibrate/trial.h"
#include "apps/output/csv_writer.h"
#include "apps/output/output_folder.h"
#include "apps/output/run_log.h"

namespace platen::apps {

struct Trial {
  SpecimenTest test;
  unsigned long seed = 1; // of the packing
  Choice choice;
};

// Packings that a calibration is made on, and those that it is judged by.
std::vector<unsigned long> training_seeds(const Scene &scene);
std::vector<unsigned long> unseen_seeds(const Scene &scene, std::size_t round = 0); // others in each round

class Trials {
public:
  // `resume`: trials.csv of the folder is read; rows that are whole and as they were written count (their
  // checksum), for the others it is told that they are made again; so it is for packings. Throws InputError
  // where it is not such a table.
  Trials(const Scene &scene, const OutputPaths &paths, bool resume, RunLog &log);

  // Results in the order of the trials. What trials.csv knows is taken from there; the rest runs, as many at
  // a time as there are threads, and is written in the order of the trials as soon as it and all before it
  // are done. Packings are made on the way. Throws Stopped after a signal.
  std::vector<TrialResult> operator()(const std::vector<Trial> &trials);
  const dem::Specimen &packing(unsigned long seed); // of the scene's own form

  long made() const { return made_; }     // here, not read
  long failed() const { return failed_; } // of all that were asked for

private:
  using PackingName = std::pair<std::string, unsigned long>; // form and seed
  static PackingName packing_of(const Trial &trial) { return {trial.test.form(), trial.seed}; }
  // Makes what packings are missing, several at a time.
  void pack(const std::vector<Trial> &trials);
  TrialResult run(const Trial &trial) const;
  void read();
  void read_packing_sums();
  void write_packing_sums() const;
  void keep(const Trial &trial, const TrialResult &result);

  const Scene &scene_;
  OutputPaths paths_;
  RunLog &log_;
  std::map<PackingName, dem::Specimen> packings_;
  std::map<std::string, std::string> packing_sums_; // file to SHA-256: of those that can be read back
  std::map<std::string, TrialResult> known_;
  std::optional<CsvWriter> table_;
  long made_ = 0, failed_ = 0;
};

} // namespace platen::apps
