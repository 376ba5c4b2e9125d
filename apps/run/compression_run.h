// One test between platens: its set-up, its schedule, its files.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "apps/output/csv_writer.h"
#include "apps/output/progress.h"
#include "apps/run/app_output.h"
#include "apps/run/fields.h"
#include "apps/run/file_marks.h"
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

  // The same in pieces, for who does something between them. begin(), pass() until finished() or false,
  // end(). A pass makes up to 16 steps, to the next that something is written after; false where a signal has
  // stopped the run.
  void begin();
  bool pass();
  bool finished() const { return !ended_by().empty(); }
  int end(); // the exit status
  // Nothing more is written: the folder is free for another run.
  void release() { output_.release(); }
  // After something has been thrown: summary.json says that the run failed.
  void give_up();
  // From the next step on, what another scene has of entries that can change on the way: friction of platens
  // and grains, the axial rate, where to stop, intervals of output and checkpoints. Told in run.log and
  // summary.json. Throws InputError, and has changed nothing, where it differs in anything else. Who calls it
  // then gives scene() the new one.
  void change(const Scene &now);
  // Called after each row of history.csv.
  void listen(std::function<void(const Sample &)> listener) { listener_ = std::move(listener); }

  coupling::PlatenTest &test() { return *test_; }
  const Results &results() const { return results_; }
  // Of the test as far as it has come; once it has ended, that of its end.
  Json summary(const std::string &status) const;

private:
  KeepPacking keep_packing();
  void require_memory(const dem::Shape &shape);
  std::string description() const;
  double every(const Interval &interval, double automatic) const;
  bool due(const Interval &interval, double automatic) const;
  double steps_until_due(const Interval &interval, double automatic) const;
  long steps_unobserved() const;
  void open_files();
  void loop();
  void start_pressed();
  void require_length() const;
  dem::InstructionSet instruction_set_of_checkpoint();
  FileMarks marks_of_checkpoint();
  void require_tables(const FileMarks &marks) const;
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
  std::string ended_by() const; // empty: it goes on
  void tell_misses(std::size_t from) const;
  void tell_path() const;
  void tell_doubts(const Json &summary);
  void finish_files();
  void write_bond_stress() const;
  dem::EventWindow event_window() const;
  void write_events() const;
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
  bool checkpoint_asked_ = false, failed_ = false, ending_ = false;
  bool tells_cut_ = false;       // once, after the first steps on ranks
  Json changes_ = Json::array(); // on the way
  Json at_end_;                  // summary.json, once the test has ended; else null
  std::function<void(const Sample &)> listener_;
};

} // namespace platen::apps
