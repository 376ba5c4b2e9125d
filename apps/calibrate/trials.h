// The trials of a calibration. Runs keep their results in the output folder, so that none is made twice.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "apps/calibrate/trial.h"
#include "apps/many/runs.h"
#include "apps/output/output_folder.h"
#include "apps/output/run_log.h"
#include "apps/scene/command_line.h"

namespace platen::apps {

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
