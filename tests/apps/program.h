// Runs the apps as a user or a batch system does: as a process, watched, stopped and judged by what it
// leaves.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace platen::apps::testing {

// A started program. Its output goes to `out` and `error`; standard input is empty.
class Program {
public:
  // Starts `command` (program and arguments, no shell) with the working folder `folder`.
  Program(const std::vector<std::string> &command, const std::filesystem::path &folder);
  ~Program(); // kills a program that still runs
  Program(const Program &) = delete;
  Program &operator=(const Program &) = delete;

  pid_t id() const { return id_; }
  void send(int signal) const;
  bool running();
  // Waits for the end; the exit status, or minus the number of the signal that ended it.
  int wait();
  // Waits until `met` holds; false where the program ended before.
  bool wait_until(const std::function<bool()> &met);

private:
  pid_t id_ = -1;
  bool ended_ = false;
  int status_ = -1;
};

struct Outcome {
  int status = -1; // exit status, or minus the number of the signal
  std::string out, error;
};
// Runs a program to its end in `folder`; platen-compress with arguments.
Outcome run_program(const std::vector<std::string> &command, const std::filesystem::path &folder);
Outcome run_compress(const std::vector<std::string> &arguments, const std::filesystem::path &folder);
std::vector<std::string> compress_command(const std::vector<std::string> &arguments);

// One of the scenes of tests/apps/scenes.
std::string test_scene(const std::string &name);

long lines_in(const std::filesystem::path &file); // 0 where there is none
nlohmann::json summary_in(const std::filesystem::path &results);
// By name: the numbers of one column of a CSV file, NaN where a cell is empty.
std::vector<double> column_of(const std::filesystem::path &csv, const std::string &name);

// What a run says of its specimen, byte by byte: all files but those that tell time and machine (run.log,
// summary.json) and the checkpoints.
std::map<std::string, std::string> results_in(const std::filesystem::path &results);
// Names of the files in which two runs differ, "" where they agree.
std::string difference(const std::map<std::string, std::string> &a,
                       const std::map<std::string, std::string> &b);

} // namespace platen::apps::testing
