#include "apps/scene/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <limits>
#include <thread>

#include "apps/scene/shell.h"
#include "apps/scene/texts.h"
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

// Text of what was not understood, with the nearest option.
[[noreturn]] void refuse_extra(const std::string &argument, const CommandLine &line, const CLI::App &parser) {
  if (argument.size() < 2 || argument[0] != '-')
    fail("\"" + argument + "\" is one argument too many" +
         (line.scene.empty() ? "" : " after " + line.scene) +
         ". Texts with blanks need quotes: --set \"Section/Key = value\".");
  std::vector<std::string> names;
  for (const CLI::Option *option : parser.get_options())
    for (const std::string &name : option->get_lnames())
      names.push_back("--" + name);
  fail(argument + " is not an option." +
       did_you_mean(argument.substr(0, argument.find('=')), names, " See --help."));
}

// Reads decimal digits ("007" is seven) from 1 to `most`; 0 where the option is not given.
int read_count(const CLI::Option &option, const std::string &text, int most) {
  if (option.count() == 0) return 0;
  int count = 0;
  const char *last = text.data() + text.size();
  const auto [end, failure] = std::from_chars(text.data(), last, count);
  const bool whole = failure == std::errc() && end == last;
  if (!whole || count < 1 || count > most)
    fail("--" + option.get_lnames().front() + " = " + text +
         (whole ? " is out of range" : " is no whole number") + ". Allowed: 1 ... " + std::to_string(most) +
         ".");
  return count;
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

// --dry-run, --resume and --overwrite go with a whole study; --run goes on by itself with what is there.
void check_exclusive(const CLI::App &parser, const Program &program) {
  std::vector<std::vector<std::string>> first_excludes{{"--resume", "--overwrite"}, {"--quiet", "--verbose"}};
  if (program.plans_runs)
    first_excludes.insert(first_excludes.end(),
                          {{"--plan", "--run", "--collect", "--dry-run", "--resume"},
                           {"--run", "--collect", "--dry-run", "--resume", "--overwrite"},
                           {"--collect", "--dry-run", "--resume", "--overwrite"}});
  for (const std::vector<std::string> &options : first_excludes)
    for (std::size_t other = 1; other < options.size(); ++other)
      if (parser.count(options[0]) > 0 && parser.count(options[other]) > 0)
        fail(options[0] + " and " + options[other] + " exclude each other. Allowed: one of them.");
}

void check(const CommandLine &line, const Program &program) {
  if (line.json && !line.print_parameters) fail("--json needs --print-parameters or --version.");
  check_name(line.scene, "SCENE");
  check_name(line.output, "--output");
  check_name(line.packings, "--packings");
  if (!line.kind.empty() &&
      std::find(program.kinds.begin(), program.kinds.end(), line.kind) == program.kinds.end())
    fail("KIND = " + line.kind + " is not known." + did_you_mean(line.kind, program.kinds) +
         " Allowed: " + joined(program.kinds) + ".");
  if (line.scene.empty() && !line.print_parameters)
    fail("no scene is given. Allowed: " + program.name + (program.kinds.empty() ? "" : " KIND") +
         " SCENE.prm [options], see --help.");
}

} // namespace

CommandLine read_command_line(int argc, const char *const *argv, const Program &program) {
  CommandLine line;
  CLI::App parser(program.purpose, program.name);
  parser.set_help_flag("-h,--help", "Print this and exit");
  parser.allow_extras(); // refused below, with the nearest option
  const auto option = [&](const std::string &name, std::string &to, const std::string &type,
                          const std::string &text) {
    return parser.add_option(name, to, text)->type_name(type);
  };
  std::string threads, run;
  bool version = false, no_cache = false;
  if (!program.kinds.empty()) option("KIND", line.kind, "", "What to sweep: " + joined(program.kinds));
  option("SCENE", line.scene, "", "Scene file, .prm or .json");
  const CLI::Option *output =
      option("-o,--output", line.output, "DIR", "Output folder [results/<name of the scene>]");
  parser.add_option("-s,--set", line.overrides, "\"Section/Key = value\", overrides one entry; repeatable")
      ->allow_extra_args(false)
      ->type_name("ENTRY");
  const CLI::Option *count_of_threads =
      option("-t,--threads", threads, "N", "Threads [all]; results do not depend on it");
  parser.add_flag("--resume", line.resume, "Go on from the newest whole checkpoint");
  parser.add_flag("--dry-run", line.dry_run, "Check and tell what would run");
  parser.add_flag("--print-parameters", line.print_parameters,
                  "Print every parameter that this program reads and exit; followed by SECTION or "
                  "SECTION/KEY: these alone");
  parser.add_flag("--json", line.json, "With --print-parameters or --version: as JSON");
  parser.add_flag("--overwrite", line.overwrite, "Replace an earlier run in the output folder");
  const CLI::Option *packings =
      !program.shares_packings
          ? nullptr
          : option("--packings", line.packings, "DIR",
                   "Takes its packing from this folder where one of the same recipe is there, else packs and "
                   "leaves it there; the results are the same bytes");
  if (program.caches_packings)
    parser.add_flag("--no-cache", no_cache, "Pack anew and keep it nowhere; as Specimen/Cache = none");
  const CLI::Option *planned = nullptr;
  if (program.plans_runs) {
    parser.add_flag("--plan", line.plan, "Write plan.csv, a run a line, and run nothing");
    planned = option("--run", run, "K",
                     "Make the run with this number of the plan, or go on with it; one that is done is left");
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
  if (const std::vector<std::string> extras = parser.remaining(); !extras.empty())
    refuse_extra(extras.front(), line, parser);
  check_exclusive(parser, program);
  line.output_given = output->count() > 0;
  for (const auto &[given, folder] : {std::pair(output, line.output), std::pair(packings, line.packings)})
    if (given != nullptr && given->count() > 0 && folder.empty())
      fail("--" + given->get_lnames().front() + " is empty. Allowed: the name of a folder.");
  if (no_cache) line.overrides.emplace_back("Specimen/Cache = none");
  line.threads = read_count(*count_of_threads, threads, most_threads());
  if (planned != nullptr) line.run = read_count(*planned, run, std::numeric_limits<int>::max());
  for (int k = 0; k < argc; ++k)
    line.text += (k == 0 ? "" : " ") + shell_word(argv[k]);
  check(line, program);
  if (!line.output_given && !line.scene.empty())
    line.output = (std::filesystem::path("results") / std::filesystem::path(line.scene).stem()).string();
  return line;
}

std::string shell_command(const std::string &program, const CommandLine &line, const std::string &but) {
  std::string text = program;
  for (const std::string &word : {line.kind, line.scene, std::string("-o"), line.output})
    if (!word.empty()) text += " " + shell_word(word);
  for (const std::string &assignment : line.overrides)
    if (but.empty() || assignment.find_first_not_of(" \t") != assignment.find(but))
      text += shell_entry(assignment);
  return text;
}

} // namespace platen::apps
