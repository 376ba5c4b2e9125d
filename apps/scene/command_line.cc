#include "apps/scene/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <thread>

#include "apps/scene/parameters.h"
#include "apps/scene/shell.h"
#include "apps/scene/values.h"
#include "apps/scene/version.h"

namespace platen::apps {
namespace {

// More only wait for each other, and a thousand take all day to do so.
int most_threads() {
  constexpr unsigned int always = 64, a_core = 4;
  return static_cast<int>(std::max(always, a_core * std::thread::hardware_concurrency()));
}

[[noreturn]] void fail(const std::string &what) {
  throw InputError("command line: error: " + what);
}

// Names that a terminal, or a log of one line an entry, would not show as they are.
void check_name(const std::string &name, const char *what) {
  for (const char c : name)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      fail(std::string(what) + " = " + name.substr(0, name.find(c)) +
           "... holds a control character or a line end. Allowed: a name without.");
}

std::vector<std::string> option_names(const Program &program) {
  std::vector<std::string> names{
      "--output",           "--set",  "--threads", "--resume",  "--overwrite", "--dry-run",
      "--print-parameters", "--json", "--quiet",   "--verbose", "--help",      "--version"};
  if (program.shares_packings) names.emplace_back("--packings");
  if (program.plans_runs) names.insert(names.end(), {"--plan", "--run", "--collect"});
  return names;
}

// Text of what was not understood, with the nearest option.
[[noreturn]] void refuse_extra(const std::string &argument, const CommandLine &line, const Program &program) {
  if (argument.size() < 2 || argument[0] != '-')
    fail("\"" + argument + "\" is one argument too many" +
         (line.scene.empty() ? "" : " after " + line.scene) +
         ". Texts with blanks need quotes: --set \"Section/Key = value\".");
  const std::string nearest = nearest_word(argument.substr(0, argument.find('=')), option_names(program));
  fail(argument + " is not an option." +
       (nearest.empty() ? " See --help." : " Did you mean \"" + nearest + "\"?"));
}

int read_threads(const std::string &text) {
  int threads = 0;
  const char *last = text.data() + text.size();
  const auto [end, failure] = std::from_chars(text.data(), last, threads);
  if (failure != std::errc() || end != last || threads < 1 || threads > most_threads())
    fail("--threads = " + text + " is no count of threads. Allowed: 1 ... " + std::to_string(most_threads()) +
         ".");
  return threads;
}

int read_run(const std::string &text) {
  int run = 0;
  const char *last = text.data() + text.size();
  const auto [end, failure] = std::from_chars(text.data(), last, run);
  if (failure != std::errc() || end != last || run < 1)
    fail("--run = " + text + " is no number of a run. Allowed: 1 and what follows, as plan.csv has them.");
  return run;
}

void check_planned(const CommandLine &line) {
  const int asked = (line.plan ? 1 : 0) + (line.run > 0 ? 1 : 0) + (line.collect ? 1 : 0);
  if (asked == 0) return;
  if (asked > 1) fail("--plan, --run and --collect exclude each other. Allowed: one of them.");
  if (line.dry_run)
    fail("--dry-run goes with a whole study. Allowed: one of --dry-run, --plan, --run, --collect.");
  if (line.resume)
    fail(
        "--resume goes with a whole study; --run goes on by itself with what is there. Allowed: one of "
        "--resume, --plan, --run, --collect.");
  if (line.overwrite && !line.plan)
    fail("--overwrite goes with --plan or a whole study, not with --run or --collect.");
}

// What stands after --print-parameters, where it is neither an option nor a scene: a section or an entry.
bool is_part(const std::string &after, const Program &program) {
  const std::filesystem::path path(after);
  std::error_code ignored;
  return !after.empty() && after[0] != '-' && path.extension() != ".prm" && path.extension() != ".json" &&
         std::find(program.kinds.begin(), program.kinds.end(), after) == program.kinds.end() &&
         !std::filesystem::is_regular_file(path, ignored);
}

// The arguments without that part, which goes to `part`.
std::vector<const char *> without_part(int argc, const char *const *argv, const Program &program,
                                       std::string &part) {
  const std::string option = "--print-parameters";
  std::vector<const char *> left;
  for (int k = 0; k < argc; ++k) {
    const std::string argument = argv[k];
    if (argument.rfind(option + "=", 0) == 0) {
      part = argument.substr(option.size() + 1);
      if (part.empty()) fail(option + "= is followed by nothing. Allowed: a section, or SECTION/KEY.");
      left.push_back("--print-parameters");
      continue;
    }
    left.push_back(argv[k]);
    if (argument == option && k + 1 < argc && is_part(argv[k + 1], program)) part = argv[++k];
  }
  return left;
}

void check(const CommandLine &line, const Program &program) {
  if (line.resume && line.overwrite)
    fail("--resume and --overwrite exclude each other. Allowed: one of them.");
  if (line.quiet && line.verbose) fail("--quiet and --verbose exclude each other. Allowed: one of them.");
  check_planned(line);
  if (line.json && !line.print_parameters) fail("--json needs --print-parameters or --version.");
  check_name(line.scene, "SCENE");
  check_name(line.output, "--output");
  check_name(line.packings, "--packings");
  if (line.output_given && line.output.empty()) fail("--output is empty. Allowed: the name of a folder.");
  const std::string kind = program.kinds.empty() ? "" : "KIND ";
  if (!line.kind.empty() &&
      std::find(program.kinds.begin(), program.kinds.end(), line.kind) == program.kinds.end()) {
    const std::string nearest = nearest_word(line.kind, program.kinds);
    fail("KIND = " + line.kind + " is not known." +
         (nearest.empty() ? "" : " Did you mean \"" + nearest + "\"?") +
         " Allowed: " + joined(program.kinds) + ".");
  }
  if (line.scene.empty() && !line.print_parameters)
    fail("no scene is given. Allowed: " + program.name + " " + kind + "SCENE.prm [options], see --help.");
}

} // namespace

CommandLine read_command_line(int argc, const char *const *argv, const Program &program) {
  CommandLine line;
  std::string threads;
  CLI::App parser(program.purpose, program.name);
  parser.set_help_flag("-h,--help", "Print this and exit");
  parser.allow_extras(); // refused below, with the nearest option
  bool version = false;
  if (!program.kinds.empty())
    parser.add_option("KIND", line.kind, "What to sweep: " + joined(program.kinds))->type_name("");
  parser.add_option("SCENE", line.scene, "Scene file, .prm or .json")->type_name("");
  CLI::Option *output =
      parser.add_option("-o,--output", line.output, "Output folder [results/<name of the scene>]")
          ->type_name("DIR");
  parser.add_option("-s,--set", line.overrides, "\"Section/Key = value\", overrides one entry; repeatable")
      ->allow_extra_args(false)
      ->type_name("ENTRY");
  parser.add_option("-t,--threads", threads, "Threads [all]; results do not depend on it")->type_name("N");
  parser.add_flag("--resume", line.resume, "Go on from the newest whole checkpoint");
  parser.add_flag("--dry-run", line.dry_run, "Check and tell what would run");
  parser.add_flag("--print-parameters", line.print_parameters,
                  "Print every parameter that this program reads and exit; followed by SECTION or "
                  "SECTION/KEY: these alone");
  parser.add_flag("--json", line.json, "With --print-parameters or --version: as JSON");
  parser.add_flag("--overwrite", line.overwrite, "Replace an earlier run in the output folder");
  CLI::Option *packings = nullptr;
  if (program.shares_packings)
    packings =
        parser
            .add_option("--packings", line.packings,
                        "Takes its packing from this folder where one of the same recipe is there, else "
                        "packs and leaves it there; the results are the same bytes")
            ->type_name("DIR");
  bool no_cache = false;
  if (program.caches_packings)
    parser.add_flag("--no-cache", no_cache, "Pack anew and keep it nowhere; as Specimen/Cache = none");
  std::string run;
  CLI::Option *planned = nullptr;
  if (program.plans_runs) {
    parser.add_flag("--plan", line.plan, "Write plan.csv, a run a line, and run nothing");
    planned =
        parser
            .add_option("--run", run,
                        "Make the run with this number of the plan, or go on with it; one that is done is "
                        "left")
            ->type_name("K");
    parser.add_flag("--collect", line.collect, "Make the tables of the runs of the plan");
  }
  parser.add_flag("--quiet", line.quiet, "Print errors only");
  parser.add_flag("--verbose", line.verbose, "Print more");
  parser.add_flag("--version", version, "Print version and libraries and exit");
  try {
    const std::vector<const char *> arguments = without_part(argc, argv, program, line.part);
    parser.parse(static_cast<int>(arguments.size()), arguments.data());
  } catch (const CLI::CallForHelp &) {
    throw PrintAndExit{parser.help()};
  } catch (const CLI::ParseError &error) {
    fail(std::string(error.what()) + ". See --help.");
  }
  if (version) throw PrintAndExit{(line.json ? version_json() : version_text()) + "\n"};
  const std::vector<std::string> extras = parser.remaining();
  if (!extras.empty()) refuse_extra(extras.front(), line, program);
  line.output_given = output->count() > 0;
  if (packings != nullptr && packings->count() > 0 && line.packings.empty())
    fail("--packings is empty. Allowed: the name of a folder.");
  if (no_cache) line.overrides.emplace_back("Specimen/Cache = none");
  if (!threads.empty()) line.threads = read_threads(threads);
  if (planned != nullptr && planned->count() > 0) line.run = read_run(run);
  for (int k = 0; k < argc; ++k)
    line.text += (k == 0 ? "" : " ") + shell_word(argv[k]);
  check(line, program);
  if (!line.output_given && !line.scene.empty())
    line.output = (std::filesystem::path("results") / std::filesystem::path(line.scene).stem()).string();
  return line;
}

} // namespace platen::apps
