// What a run says on the screen and in run.log, and its progress.
#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "apps/output/errors.h"
#include "apps/output/progress.h"
#include "apps/output/run_log.h"
#include "apps/scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

class Log : public ScratchFolder {
protected:
  fs::path path_ = folder_ / "run.log";
  std::ostringstream output_, errors_;
  const RunHeader header_{"platen-compress 0.1.0 (abc123)\nbuilt with g++", "platen-compress case.prm -t 2",
                          2};

  static void say_all(RunLog &log) {
    log.info("packed {} spheres", 12);
    log.detail("cells {}", 5);
    log.warning("speed is {} m/s", 0.5);
    log.error("no room");
  }
};

TEST_F(Log, is_as_loud_as_asked_on_the_screen_and_complete_in_the_file) {
  struct Case {
    Loudness loudness;
    std::string output, errors;
    bool detail_in_file;
  };
  for (const Case &c :
       {Case{Loudness::quiet, "", "error: no room\n", false},
        Case{Loudness::normal, "packed 12 spheres\n", "warning: speed is 0.5 m/s\nerror: no room\n", false},
        Case{Loudness::verbose, "packed 12 spheres\ncells 5\n", "warning: speed is 0.5 m/s\nerror: no room\n",
             true}}) {
    output_.str("");
    errors_.str("");
    RunLog log(c.loudness, output_, errors_);
    log.open(path_, false, header_);
    say_all(log);
    EXPECT_EQ(output_.str(), c.output);
    EXPECT_EQ(errors_.str(), c.errors);
    const std::string file = content_of(path_);
    for (const char *line : {"packed 12 spheres\n", "warning: speed is 0.5 m/s\n", "error: no room\n"})
      EXPECT_TRUE(contains(file, line));
    EXPECT_EQ(contains(file, "cells 5"), c.detail_in_file);
  }
}

TEST_F(Log, begins_with_version_command_machine_and_threads) {
  RunLog log(Loudness::quiet, output_, errors_);
  log.info("said before the folder was known");
  log.open(path_, false, header_);
  log.info("said later");
  std::istringstream file(content_of(path_));
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);)
    lines.push_back(line);
  ASSERT_EQ(lines.size(), 7u);
  EXPECT_EQ(lines[0], "platen-compress 0.1.0 (abc123)");
  EXPECT_TRUE(contains(lines[2], "UTC: platen-compress case.prm -t 2"));
  EXPECT_TRUE(contains(lines[3], "machine ") && contains(lines[3], " cores")) << lines[3];
  EXPECT_EQ(lines[4], "threads 2");
  EXPECT_EQ(lines[5], "said before the folder was known");
  EXPECT_EQ(lines[6], "said later");
}

TEST_F(Log, of_a_resumed_run_goes_on_after_the_former_one) {
  {
    RunLog log(Loudness::quiet, output_, errors_);
    log.open(path_, false, header_);
    log.info("first run");
  }
  const std::string before = content_of(path_);
  RunLog log(Loudness::quiet, output_, errors_);
  log.open(path_, true, header_);
  log.info("second run");
  const std::string after = content_of(path_);
  EXPECT_EQ(after.substr(0, before.size()), before);
  EXPECT_TRUE(contains(after.substr(before.size()), "threads 2"));
  EXPECT_TRUE(contains(after.substr(before.size()), "second run"));
}

TEST_F(Log, that_cannot_be_written_stops_the_run_once_and_still_talks) {
  fs::create_symlink("/dev/full", path_);
  RunLog log(Loudness::normal, output_, errors_);
  EXPECT_TRUE(contains(message_of<OutputError>([&] { log.open(path_, false, header_); }), "No space left"));
  EXPECT_NO_THROW(log.error("the disk is full"));
  EXPECT_NO_THROW(log.info("going home"));
  EXPECT_EQ(errors_.str(), "error: the disk is full\n");
  EXPECT_EQ(output_.str(), "going home\n");
}

TEST_F(Log, records_without_printing) {
  RunLog log(Loudness::verbose, output_, errors_);
  log.open(path_, false, header_);
  log.record("printed elsewhere");
  EXPECT_TRUE(contains(content_of(path_), "printed elsewhere\n"));
  EXPECT_EQ(output_.str() + errors_.str(), "");
}

// A screen and a clock under the test's control.
class ProgressLine : public ScratchFolder {
protected:
  fs::path path_ = folder_ / "run.log";
  std::ostringstream output_, errors_;
  double now_ = 1000; // s

  ProgressScreen screen(bool redraws, int columns = 200) {
    ProgressScreen screen;
    screen.stream = &errors_;
    screen.redraws = redraws;
    screen.columns = columns;
    screen.clock = [this] { return now_; };
    return screen;
  }
  // 100 steps/s, done after 100 s.
  ProgressSample sample(double start = 1000) const {
    ProgressSample s;
    s.fraction = (now_ - start) / 100;
    s.step = static_cast<std::uint64_t>((now_ - start) * 100 + 0.5);
    s.time = (now_ - start) * 1e-5;
    s.strain = (now_ - start) * 1e-5;
    s.stress = (now_ - start) * 1e6;
    s.broken_bonds = static_cast<long long>(now_ - start);
    return s;
  }
  void run(Progress &progress, double seconds) {
    const double end = now_ + seconds;
    for (; now_ < end - 1e-9; now_ += 0.125)
      if (progress.due()) progress.update(sample());
  }
  static int count(const std::string &text, char c) {
    return static_cast<int>(std::count(text.begin(), text.end(), c));
  }
};

TEST_F(ProgressLine, tells_all_every_ten_seconds_where_no_terminal_is) {
  RunLog log(Loudness::normal, output_, errors_);
  Progress progress(log, screen(false));
  run(progress, 9.9);
  EXPECT_EQ(errors_.str(), "");
  run(progress, 41); // lines at 10, 20, 30, 40, 50 s
  const std::string text = errors_.str();
  EXPECT_EQ(count(text, '\n'), 5);
  EXPECT_EQ(count(text, '\r') + count(text, '\033'), 0);
  EXPECT_EQ(text.substr(0, text.find('\n')),
            " 10.0 %  time 100 us  strain 0.0100 %  stress 10 MPa  broken 10  100 steps/s  left 1 min 30 s");
}

TEST_F(ProgressLine, redraws_one_line_on_a_terminal) {
  RunLog log(Loudness::normal, output_, errors_);
  Progress progress(log, screen(true));
  run(progress, 30);
  EXPECT_EQ(count(errors_.str(), '\n'), 0);
  const int drawn = count(errors_.str(), '\r');
  EXPECT_GT(drawn, 100); // at most five a second, here every 0.25 s
  EXPECT_LE(drawn, 151);
  EXPECT_TRUE(contains(errors_.str(), "steps/s  left "));
  progress.finish(sample());
  EXPECT_EQ(count(errors_.str(), '\n'), 1);
}

TEST_F(ProgressLine, makes_room_for_messages) {
  RunLog log(Loudness::normal, output_, errors_);
  Progress progress(log, screen(true));
  run(progress, 1);
  const std::size_t before = errors_.str().size();
  log.warning("a word");
  EXPECT_EQ(errors_.str().substr(before), "\r\033[Kwarning: a word\n");
  log.warning("another");
  EXPECT_EQ(errors_.str().substr(before), "\r\033[Kwarning: a word\nwarning: another\n");
}

TEST_F(ProgressLine, is_never_wider_than_the_terminal) {
  for (const int columns : {1, 10, 25, 40, 80}) {
    errors_.str("");
    RunLog log(Loudness::normal, output_, errors_);
    Progress progress(log, screen(true, columns));
    run(progress, 20);
    std::istringstream lines(errors_.str());
    for (std::string line; std::getline(lines, line, '\r');) {
      const std::string shown = line.substr(0, line.find("\033[K"));
      EXPECT_LT(shown.size(), static_cast<std::size_t>(std::max(columns, 2))) << shown;
    }
  }
}

TEST_F(ProgressLine, is_silent_when_quiet_but_recorded) {
  for (const bool redraws : {false, true}) {
    RunLog log(Loudness::quiet, output_, errors_);
    log.open(path_, false, {"version", "command", 1});
    now_ = 1000;
    Progress progress(log, screen(redraws));
    run(progress, 25);
    progress.finish(sample());
    EXPECT_EQ(errors_.str() + output_.str(), "");
    EXPECT_TRUE(contains(content_of(path_), " 20.0 %  time"));
  }
}

TEST_F(ProgressLine, of_a_terminal_is_recorded_every_ten_seconds) {
  RunLog log(Loudness::normal, output_, errors_);
  log.open(path_, false, {"version", "command", 1});
  Progress progress(log, screen(true));
  run(progress, 35);
  const std::string text = content_of(path_);
  for (const char *line : {"\n 10.0 %", "\n 20.0 %", "\n 30.0 %"})
    EXPECT_TRUE(contains(text, line));
  EXPECT_EQ(count(text, '%'), 6); // percent and strain of three lines
}

TEST_F(ProgressLine, leaves_out_what_is_not_known) {
  RunLog log(Loudness::normal, output_, errors_);
  Progress progress(log, screen(false));
  ProgressSample bare;
  progress.update(bare);
  now_ += 10;
  bare.fraction = 0.5;
  progress.update(bare);
  EXPECT_EQ(errors_.str(), " 50.0 %  left 10 s\n");
}

TEST_F(ProgressLine, of_a_resumed_run_expects_the_rest_at_the_pace_since_then) {
  RunLog log(Loudness::normal, output_, errors_);
  Progress progress(log, screen(false));
  ProgressSample s;
  s.fraction = 0.5; // resumed half-way
  s.step = 1000000;
  progress.update(s);
  now_ += 10;
  s.fraction = 0.6;
  s.step += 1000;
  progress.update(s);
  EXPECT_EQ(errors_.str(), " 60.0 %  100 steps/s  left 40 s\n");
}

TEST_F(ProgressLine, follows_a_change_of_pace) {
  RunLog log(Loudness::normal, output_, errors_);
  Progress progress(log, screen(false));
  ProgressSample s;
  for (int k = 0; k <= 40; ++k, now_ += 1) { // 1000 steps/s for 20 s, then 10
    progress.update(s);
    s.step += k < 20 ? 1000 : 10;
  }
  const std::string text = errors_.str();
  EXPECT_TRUE(contains(text.substr(0, text.find('\n')), "1e+03 steps/s") ||
              contains(text.substr(0, text.find('\n')), "1000 steps/s"))
      << text;
  EXPECT_TRUE(contains(text.substr(text.rfind(' ', text.rfind(" steps/s") - 1)), " 10 steps/s")) << text;
}

TEST(ProgressScreens, honour_no_colour_and_need_a_terminal) {
  setenv("NO_COLOR", "1", 1);
  EXPECT_FALSE(standard_screen().colour);
  unsetenv("NO_COLOR");
  setenv("TERM", "dumb", 1);
  EXPECT_FALSE(standard_screen().redraws);
}

TEST(ProgressText, gives_three_digits_and_a_prefix) {
  EXPECT_EQ(with_prefix(0, "s"), "0 s");
  EXPECT_EQ(with_prefix(1.2345e-3, "s"), "1.23 ms");
  EXPECT_EQ(with_prefix(-45.18e6, "Pa"), "-45.2 MPa");
  EXPECT_EQ(with_prefix(999.6, "Pa"), "1 kPa");
  EXPECT_EQ(with_prefix(999.4, "Pa"), "999 Pa");
  EXPECT_EQ(with_prefix(3e-12, "s"), "0.003 ns");
  EXPECT_EQ(with_prefix(5e13, "Pa"), "5e+04 GPa");
}

TEST(ProgressText, gives_durations_as_people_say_them) {
  EXPECT_EQ(duration_text(-3), "0 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(59.6), "1 min 00 s");
  EXPECT_EQ(duration_text(185), "3 min 05 s");
  EXPECT_EQ(duration_text(7800), "2 h 10 min");
}

} // namespace
} // namespace platen::apps
