// One test between platens: its set-up, its schedule, its files.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "apps/io/csv_writer.h"
#include "apps/io/progress.h"
#include "apps/run/app_output.h"
#include "apps/run/fields.h"
#include "apps/run/history.h"
#include "apps/run/results.h"
#include "apps/run/specimen_check.h"
#include "apps/run/specimen_setup.h"
#include "apps/run/summary_of_run.h"
#include "coupling/platen_test.h"

namespace platen::apps {

// Rows of history.csv and frames for ParaView over the way to the target strain, where the scene leaves it
// open.
constexpr double automatic_rows = 600, automatic_frames = 24;

// How the platens meet the specimen: at the ends of its axis, or across it, at its rim.
enum class Pressed { along_axis, across_axis };

class CompressionRun {
public:
  // Checks the output folder and, but for a dry run, begins it. Throws InputError where the scene cannot be
  // run.
  CompressionRun(const CommandLine &command, const Scene &scene, Pressed pressed);
  int run(); // the exit status; throws NumericsError

private:
  KeepPacking keep_packing();
  void require_memory(const dem::Shape &shape);
  std::string description() const;
  double every(const Interval &interval, double automatic) const;
  bool due(const Interval &interval, double automatic) const;
  double steps_until_due(const Interval &interval, double automatic) const;
  long steps_unobserved() const;
  void open_files();
  void reopen_history();
  void loop();
  void start_pressed();
  void require_length() const;
  dem::InstructionSet instruction_set_of_checkpoint();
  void require_files_of_checkpoint();
  void sample();
  void keep(const Sample &s);
  std::string resuming_command(const std::string &but = "") const;
  void write_cracks();
  void checkpoint();
  bool checkpoint_due() const;
  void look_around();
  void tell_cut();
  bool keeps_checkpoints() const { return scene_.checkpoint.every.kind != Interval::Kind::none; }
  ProgressSample where() const;
  bool finished() const { return !ended_by().empty(); }
  std::string ended_by() const; // empty: it goes on
  void tell_unsettled(std::size_t from) const;
  void tell_path() const;
  void write_bond_stress() const;
  dem::EventWindow event_window() const;
  void write_events() const;
  void save_summary(const std::string &status);
  RunCosts costs() const;

  const CommandLine &command_;
  const Scene &scene_;
  Clock::time_point last_checkpoint_ = Clock::now(), loop_start_ = Clock::now();
  AppOutput output_;
  const OutputPaths &paths_ = output_.paths;
  RunLog &log_ = output_.log;
  dem::Exchange *ranks_ = nullptr; // of the test; null: alone
  std::unique_ptr<coupling::PlatenTest> test_;
  std::unique_ptr<Sampler> sampler_;
  std::optional<Sample> as_packed_; // where the run does not begin there
  Results results_;
  SpecimenState specimen_state_;
  std::optional<CsvWriter> history_, cracks_;
  std::optional<FieldSeries> fields_;
  std::string counted_;      // of a dry run that is too large to be built
  std::string specimen_sum_; // SHA-256 of specimen.csv
  double setup_seconds_ = 0, earlier_seconds_ = 0;
  double expected_steps_ = 1;
  long first_step_ = 0;
  int signal_ = 0;
  bool checkpoint_asked_ = false, failed_ = false;
};

} // namespace platen::apps
