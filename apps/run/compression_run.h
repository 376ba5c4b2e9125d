// One test between platens: its set-up, and the loop over what looks at it (observer.h).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/output/progress.h"
#include "apps/run/app_output.h"
#include "apps/run/checkpoints.h"
#include "apps/run/frames.h"
#include "apps/run/record.h"
#include "apps/run/run_messages.h"
#include "apps/run/summary_of_run.h"
#include "coupling/platen_test.h"

namespace platen::apps {

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
  void listen(std::function<void(const Sample &)> listener) { record_->listen(std::move(listener)); }

  coupling::PlatenTest &test() { return *test_; }
  const Results &results() const { return results_; }
  // Of the test as far as it has come; once it has ended, that of its end.
  Json summary(const std::string &status) const;

private:
  void set_up(const dem::Specimen &specimen, const FileMarks &marks);
  void require_memory(const dem::Shape &shape);
  void require_length() const;
  void start_pressed();
  FileMarks marks_of_checkpoint();
  FileMarks marks_of_files();
  FileMarks resume();
  std::string description() const {
    return description_of(scene_, *test_, specimen_state_, expected_steps_, output_.threads());
  }
  std::string resuming_command(const std::string &but = "") const;
  long steps_unobserved() const;
  void look_around();
  void observe();
  ProgressSample where() const;
  std::string ended_by() const { return apps::ended_by(scene_, *test_, results_); } // empty: it goes on
  RunCosts costs() const;

  const CommandLine &command_;
  const Scene &scene_;
  const bool resumes_;
  AppOutput output_;
  const OutputPaths &paths_ = output_.paths;
  RunLog &log_ = output_.log;
  dem::Exchange *ranks_ = nullptr; // of the test; null: alone
  std::unique_ptr<coupling::PlatenTest> test_;
  Results results_;
  SpecimenState specimen_state_;
  std::optional<Sample> as_packed_; // where the run does not begin there
  std::optional<RunMessages> messages_;
  std::optional<Record> record_;
  std::optional<Frames> frames_;
  std::optional<Checkpoints> checkpoints_;
  std::vector<Observer *> observers_; // these, in their order
  std::string counted_;               // of a dry run that is too large to be built
  std::string specimen_sum_;          // SHA-256 of specimen.csv
  Clock::time_point loop_start_ = Clock::now();
  double setup_seconds_ = 0, earlier_seconds_ = 0;
  double expected_steps_ = 1;
  long first_step_ = 0;
  Moment now_;
  bool failed_ = false, ending_ = false;
  Json changes_ = Json::array(); // on the way
  Json at_end_;                  // summary.json, once the test has ended; else null
};

} // namespace platen::apps
