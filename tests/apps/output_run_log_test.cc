#include <sstream>

#include "apps/output/errors.h"
#include "apps/output/run_log.h"
#include "scratch_folder.h"

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
      EXPECT_TRUE(contains(file, line)) << file;
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
  EXPECT_TRUE(contains(lines[2], "UTC: platen-compress case.prm -t 2")) << lines[2];
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

} // namespace
} // namespace platen::apps
