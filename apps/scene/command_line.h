// The command line that all apps share, and the frame of their main function.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/scene/errors.h"
#include "apps/scene/program.h"
#include "apps/scene/scene.h"

namespace platen::apps {

struct CommandLine {
  std::string kind;   // one of Program::kinds
  std::string scene;  // path of the scene; "" only with print_parameters
  std::string output; // output folder; "results/<name of the scene>" where not given
  bool output_given = false;
  std::vector<std::string> overrides; // "Section/Key = value", in order
  int threads = 0;                    // 0: all that the machine has
  std::string packings;               // folder of packings that runs share; "": none
  bool resume = false, overwrite = false, dry_run = false, print_parameters = false, json = false;
  bool plan = false, collect = false;
  int run = 0;      // number of a planned run, from 1 on; 0: none is given
  std::string part; // what of the parameters is printed, "Bond" or "Bond/Gap"; "": all
  bool quiet = false, verbose = false;
  std::string text; // the whole line as typed, for the log
};

// What --help and --version ask for: text to print, then exit status 0.
struct PrintAndExit {
  std::string text;
};

// Throws InputError for a bad command line, PrintAndExit for --help and --version.
CommandLine read_command_line(int argc, const char *const *argv, const Program &program);

// The program on the same scene, output folder and entries as it was called with, but for an entry that is to
// be another, as a shell takes it.
std::string shell_command(const std::string &program, const CommandLine &line, const std::string &but = "");

// The work of an app; returns the exit status.
using AppBody = std::function<int(const CommandLine &, const Scene &)>;

// Until a program that writes catches signals itself: one that asks it to stop ends it at once, with the exit
// status of a run that was stopped, because nothing is written yet; one that asks for a checkpoint waits.
void obey_early_signals();

// Throws InputError if the ranks of one run were given different texts.
using RequireSame = void (*)(const std::string &text);

// Reads command line and scene, answers --help, --version and --print-parameters, calls body and turns what
// it throws into the exit statuses: InputError, std::invalid_argument 2; OutputError, file system errors 4;
// everything else 3. The message goes to standard error once, without a stack trace. Notes on entries without
// effect go to standard error unless --quiet. Without `require_same` the program runs in one process, and is
// refused if a launcher has started several.
int run_app(int argc, char **argv, const Program &program, const AppBody &body,
            RequireSame require_same = nullptr);

} // namespace platen::apps
