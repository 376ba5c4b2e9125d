// The command line that all apps share, and the frame of their main function.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/errors.h"
#include "apps/scene/scene.h"

namespace platen::apps {

struct AppDescription {
  AppKind kind = AppKind::compress;
  std::string name;                    // "platen-compress"
  std::string purpose;                 // one sentence for --help
  std::vector<std::string> kinds = {}; // words, one of which comes first on the line; none: no such argument
  bool shares_packings = false;        // has --packings
  bool caches_packings = false;        // has --no-cache
  bool plans_runs = false;             // has --plan, --run, --collect
  // Of an app that runs on ranks of mpirun: throws InputError where they were given different texts. Null: it
  // runs in one process.
  void (*require_same)(const std::string &text) = nullptr;
};

struct CommandLine {
  std::string kind;   // one of AppDescription::kinds
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
CommandLine read_command_line(int argc, const char *const *argv, const AppDescription &app);

// The work of an app; returns the exit status.
using AppBody = std::function<int(const CommandLine &, const Scene &)>;

// Reads command line and scene, answers --help, --version and --print-parameters, calls body and turns what
// it throws into the exit statuses: InputError, std::invalid_argument 2; OutputError, file system errors 4;
// everything else 3. The message goes to standard error once, without a stack trace. Notes on entries without
// effect go to standard error unless --quiet.
int run_app(int argc, char **argv, const AppDescription &app, const AppBody &body);

// The same but for the body: the exit status where --help, --version or --print-parameters was asked for, or
// where command line or scene are refused; none where there is work to do. None too on one of several ranks,
// which tell what is wrong once.
std::optional<int> answer_at_once(int argc, char **argv, const AppDescription &app);

} // namespace platen::apps
