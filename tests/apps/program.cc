#include "apps/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "apps/scratch_folder.h"

namespace platen::apps::testing {
namespace {

// How often a running program is looked at; its steps take about as long.
constexpr std::chrono::milliseconds glance{1};

constexpr const char *out_name = "out.txt", *error_name = "error.txt";

[[noreturn]] void become(const std::vector<std::string> &command, const fs::path &folder) {
  signal(SIGHUP, SIG_DFL); // whatever started the tests may have it ignored
  const int nothing = open("/dev/null", O_RDONLY);
  const int out = open((folder / out_name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  const int error = open((folder / error_name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (dup2(nothing, 0) < 0 || dup2(out, 1) < 0 || dup2(error, 2) < 0 || chdir(folder.c_str()) != 0)
    _exit(126);
  std::vector<char *> arguments;
  for (const std::string &argument : command)
    arguments.push_back(const_cast<char *>(argument.c_str()));
  arguments.push_back(nullptr);
  execv(arguments.front(), arguments.data());
  _exit(127);
}

} // namespace

Program::Program(const std::vector<std::string> &command, const fs::path &folder) {
  setenv("PLATEN_CACHE", "none", 0); // what is tested is made here, not found
  id_ = fork();
  if (id_ < 0) throw std::runtime_error("no process");
  if (id_ == 0) become(command, folder);
}

Program::~Program() {
  if (ended_) return;
  kill(id_, SIGKILL);
  wait();
}

void Program::send(int signal) const {
  kill(id_, signal);
}

bool Program::running() {
  if (ended_) return false;
  int status = 0;
  if (waitpid(id_, &status, WNOHANG) == 0) return true;
  ended_ = true;
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return false;
}

int Program::wait() {
  while (running())
    std::this_thread::sleep_for(glance);
  return status_;
}

bool Program::wait_until(const std::function<bool()> &met) {
  while (running()) {
    if (met()) return true;
    std::this_thread::sleep_for(glance);
  }
  return false;
}

std::vector<std::string> compress_command(const std::vector<std::string> &arguments) {
  std::vector<std::string> command{PLATEN_COMPRESS_PROGRAM};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

Outcome run_program(const std::vector<std::string> &command, const fs::path &folder) {
  Outcome outcome;
  outcome.status = Program(command, folder).wait();
  outcome.out = content_of(folder / out_name);
  outcome.error = content_of(folder / error_name);
  return outcome;
}

Outcome run_compress(const std::vector<std::string> &arguments, const fs::path &folder) {
  return run_program(compress_command(arguments), folder);
}

std::string test_scene(const std::string &name) {
  return std::string(PLATEN_TEST_SCENES) + "/" + name;
}

long lines_in(const fs::path &file) {
  std::ifstream stream(file, std::ios::binary);
  return std::count(std::istreambuf_iterator<char>(stream), {}, '\n');
}

nlohmann::json summary_in(const fs::path &results) {
  return nlohmann::json::parse(content_of(results / "summary.json"));
}

std::vector<double> column_of(const fs::path &csv, const std::string &name) {
  std::istringstream rows(content_of(csv));
  const auto cells = [](const std::string &row) {
    std::vector<std::string> parts;
    std::istringstream stream(row);
    for (std::string part; std::getline(stream, part, ',');)
      parts.push_back(part);
    return parts;
  };
  std::string row;
  std::getline(rows, row);
  const std::vector<std::string> names = cells(row);
  const auto column = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  EXPECT_LT(column, names.size()) << "no column " << name;
  std::vector<double> values;
  while (std::getline(rows, row)) {
    const std::vector<std::string> parts = cells(row);
    const bool empty = column >= parts.size() || parts[column].empty();
    values.push_back(empty ? std::numeric_limits<double>::quiet_NaN()
                           : std::strtod(parts[column].c_str(), nullptr));
  }
  return values;
}

std::map<std::string, std::string> results_in(const fs::path &results) {
  std::map<std::string, std::string> files;
  for (const auto &entry : fs::recursive_directory_iterator(results)) {
    const std::string name = entry.path().lexically_relative(results).string();
    if (!entry.is_regular_file() || name == "run.log" || name == "summary.json" ||
        name.rfind("checkpoint/", 0) == 0)
      continue;
    files[name] = content_of(entry.path());
  }
  return files;
}

std::string difference(const std::map<std::string, std::string> &a,
                       const std::map<std::string, std::string> &b) {
  std::string names;
  for (const auto &[name, bytes] : a)
    if (const auto found = b.find(name); found == b.end() || found->second != bytes) names += name + "\n";
  for (const auto &[name, bytes] : b)
    if (a.find(name) == a.end()) names += name + " (only in the second)\n";
  return names;
}

} // namespace platen::apps::testing
