// Command lines: what they say, what is refused, the exit status of what the body throws; commands that are
// printed to be pasted.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <stdexcept>

#include "apps/programs.h"
#include "apps/scene/command_line.h"
#include "apps/scene/shell.h"
#include "apps/scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

const std::string good = std::string(PLATEN_TEST_DATA) + "/fragment/good.prm";
apps::Program described(const std::string &name, const std::vector<std::string> &kinds) {
  apps::Program program;
  program.name = name;
  program.kinds = kinds;
  program.reads = {"Specimen"};
  return program;
}
const apps::Program compress = described("platen-compress", {}),
                    study = described("platen-study", {"friction", "slenderness", "rate"});

CommandLine parse(std::vector<const char *> arguments, const apps::Program &app = compress) {
  arguments.insert(arguments.begin(), app.name.c_str());
  return read_command_line(static_cast<int>(arguments.size()), arguments.data(), app);
}

TEST(CommandLine, options_come_before_or_after_the_scene) {
  for (const auto &arguments : std::vector<std::vector<const char *>>{
           {"cases/a.prm", "-o", "out", "-s", "A/B = 1", "--set", "A/C = -2", "-t", "3", "--quiet"},
           {"-t3", "-s", "A/B = 1", "-s", "A/C = -2", "--output=out", "--quiet", "cases/a.prm"},
           {"--quiet", "--set=A/B = 1", "cases/a.prm", "--set=A/C = -2", "--threads", "3", "-oout"}}) {
    const CommandLine line = parse(arguments);
    EXPECT_EQ(line.scene, "cases/a.prm");
    EXPECT_EQ(line.output, "out");
    EXPECT_EQ(line.overrides, (std::vector<std::string>{"A/B = 1", "A/C = -2"}));
    EXPECT_EQ(line.threads, 3);
    EXPECT_TRUE(line.quiet);
    EXPECT_FALSE(line.resume || line.overwrite || line.dry_run || line.verbose);
  }
}

TEST(CommandLine, output_falls_under_results_by_default) {
  const CommandLine line = parse({"cases/a.b.prm"});
  EXPECT_EQ(line.output, "results/a.b");
  EXPECT_FALSE(line.output_given);
  EXPECT_EQ(line.threads, 0);
}

TEST(CommandLine, a_study_takes_its_kind_first) {
  const CommandLine line = parse({"friction", "a.prm", "--resume"}, study);
  EXPECT_EQ(line.kind, "friction");
  EXPECT_EQ(line.scene, "a.prm");
  EXPECT_TRUE(line.resume);
}

TEST(CommandLine, help_and_version_are_texts) {
  for (const char *option : {"--output", "--set", "--threads", "--resume", "--overwrite", "--dry-run",
                             "--print-parameters", "--json", "--quiet", "--verbose", "--version", "--help"})
    try {
      parse({"--help"});
      ADD_FAILURE();
    } catch (const PrintAndExit &asked) {
      EXPECT_TRUE(contains(asked.text, option));
    }
  try {
    parse({"--version"});
    ADD_FAILURE();
  } catch (const PrintAndExit &asked) {
    for (const char *part : {"Platen ", "commit ", "compiler ", "deal.II ", "Trilinos", "VTK "})
      EXPECT_TRUE(contains(asked.text, part));
  }
}

TEST(CommandLine, a_program_can_read_the_version) {
  try {
    parse({"--version", "--json"});
    ADD_FAILURE();
  } catch (const PrintAndExit &asked) {
    const nlohmann::json json = nlohmann::json::parse(asked.text);
    EXPECT_EQ(asked.text.find('\n'), asked.text.size() - 1) << "one line";
    for (const char *key : {"version", "build_type", "compiler", "deal.II", "vtk"})
      EXPECT_TRUE(json.at(key).is_string()) << key;
    EXPECT_TRUE(json.at("changed").is_boolean());
    EXPECT_TRUE(json.at("commit").is_string() || json.at("commit").is_null());
    EXPECT_TRUE(json.at("trilinos").is_string() || json.at("trilinos").is_null());
  }
}

TEST(CommandLine, packings_are_shared_by_programs_that_pack_for_many_runs) {
  apps::Program sharing = compress;
  sharing.shares_packings = true;
  EXPECT_EQ(parse({"a.prm", "--packings", "kept"}, sharing).packings, "kept");
  EXPECT_EQ(parse({"a.prm"}, sharing).packings, "");
  EXPECT_THROW(parse({"a.prm", "--packings", "kept"}), InputError);
  EXPECT_THROW(parse({"a.prm", "--packings", ""}, sharing), InputError);
}

TEST(CommandLine, a_study_is_planned_run_by_number_and_collected) {
  apps::Program planning = study;
  planning.plans_runs = true;
  EXPECT_TRUE(parse({"rate", "a.prm", "--plan"}, planning).plan);
  EXPECT_TRUE(parse({"rate", "a.prm", "--collect"}, planning).collect);
  EXPECT_EQ(parse({"rate", "a.prm", "--run", "12"}, planning).run, 12);
  EXPECT_EQ(parse({"rate", "a.prm", "--run=007"}, planning).run, 7); // seq -w
  EXPECT_EQ(parse({"rate", "a.prm"}, planning).run, 0);
  EXPECT_TRUE(parse({"rate", "a.prm", "--plan", "--overwrite"}, planning).overwrite);
  const std::pair<std::vector<const char *>, const char *> bad[] = {
      {{"--run", "0"}, "--run = 0 is out of range. Allowed: 1 ... "},
      {{"--run", "-1"}, "--run = -1 is out of range"},
      {{"--run", "2x"}, "--run = 2x is no whole number"},
      {{"--run", "1-4"}, "--run = 1-4 is no whole number"},
      {{"--run", ""}, "--run =  is no whole number"},
      {{"--run", "99999999999"}, "is no whole number"},
      {{"--run"}, "--run"},
      {{"--plan", "--collect"}, "exclude each other"},
      {{"--plan", "--run", "1"}, "exclude each other"},
      {{"--run", "1", "--resume"}, "and --resume exclude each other. Allowed: one of them."},
      {{"--collect", "--resume"}, "and --resume exclude each other. Allowed: one of them."},
      {{"--run", "1", "--overwrite"}, "and --overwrite exclude each other"},
      {{"--collect", "--overwrite"}, "and --overwrite exclude each other"},
      {{"--plan", "--dry-run"}, "--plan and --dry-run exclude each other"},
      {{"--colect"}, "Did you mean \"--collect\"?"}};
  for (const auto &[options, says] : bad)
    try {
      std::vector<const char *> line{"rate", "a.prm"};
      line.insert(line.end(), options.begin(), options.end());
      parse(line, planning);
      ADD_FAILURE() << says;
    } catch (const InputError &error) {
      EXPECT_TRUE(contains(error.what(), says)) << error.what();
    }
  EXPECT_THROW(parse({"a.prm", "--plan"}), InputError); // of other programs
}

struct BadLine {
  std::vector<const char *> arguments;
  const char *says;
};

TEST(CommandLine, bad_lines_are_refused) {
  const BadLine lines[] = {
      {{}, "no scene is given. Allowed: platen-compress SCENE.prm [options]"},
      {{"a.prm", "--ovrwrite"}, "--ovrwrite is not an option. Did you mean \"--overwrite\"?"},
      {{"a.prm", "--thread=3"}, "Did you mean \"--threads\"?"},
      {{"a.prm", "b.prm"}, "\"b.prm\" is one argument too many after a.prm"},
      {{"a.prm", "-s", "A/B", "=", "1"}, "\"=\" is one argument too many"},
      {{"a.prm", "-t", "0"}, "--threads = 0 is out of range. Allowed: 1 ... "},
      {{"a.prm", "-t", "100000"}, "--threads = 100000 is out of range. Allowed: 1 ... "},
      {{"a\x1b[2J.prm"}, "SCENE = a... holds a control character"},
      {{"a.prm", "-o", "x\ny"}, "--output = x... holds a control character or a line end"},
      {{"a.prm", "-t", "two"}, "--threads = two is no whole number"},
      {{"a.prm", "-t", "1.5"}, "--threads = 1.5 is no whole number"},
      {{"a.prm", "-t"}, "--threads"},
      {{"a.prm", "-o"}, "--output"},
      {{"a.prm", "--output="}, "--output"},
      {{"a.prm", "--resume", "--overwrite"}, "--resume and --overwrite exclude each other"},
      {{"a.prm", "--quiet", "--verbose"}, "--quiet and --verbose exclude each other"},
      {{"a.prm", "--json"}, "--json needs --print-parameters or --version"}};
  for (const BadLine &bad : lines)
    try {
      parse(bad.arguments);
      ADD_FAILURE() << bad.says;
    } catch (const InputError &error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find("command line: error: "), 0u) << message;
      EXPECT_TRUE(contains(message, bad.says));
    }
  EXPECT_THROW(parse({"fricton", "a.prm"}, study), InputError);
}

// Runs an app on a good scene and gives its exit status.
int status_of(const AppBody &body, const std::vector<std::string> &options = {}) {
  std::vector<std::string> arguments = {"platen-compress", good};
  arguments.insert(arguments.end(), options.begin(), options.end());
  std::vector<char *> pointers;
  for (std::string &argument : arguments)
    pointers.push_back(argument.data());
  return run_app(static_cast<int>(pointers.size()), pointers.data(), compress, body);
}

template <class Error>
AppBody throwing() {
  return [](const CommandLine &, const Scene &) -> int { throw Error("something happened"); };
}

TEST(ExitStatus, each_kind_of_failure_has_its_own) {
  EXPECT_EQ(status_of([](const CommandLine &, const Scene &) { return 0; }), 0);
  EXPECT_EQ(status_of([](const CommandLine &, const Scene &) { return 130; }), 130);
  EXPECT_EQ(status_of([](const CommandLine &, const Scene &) { return status_check_failed; }), 1);
  EXPECT_EQ(status_of(throwing<InputError>()), 2);
  EXPECT_EQ(status_of(throwing<std::invalid_argument>()), 2);
  EXPECT_EQ(status_of(throwing<NumericsError>()), 3);
  EXPECT_EQ(status_of(throwing<std::runtime_error>()), 3);
  EXPECT_EQ(status_of(throwing<OutputError>()), 4);
}

TEST(ExitStatus, bad_input_is_told_once_and_the_body_does_not_run) {
  bool ran = false;
  const AppBody body = [&](const CommandLine &, const Scene &) {
    ran = true;
    return 0;
  };
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(status_of(body, {"--set", "Contact/Friction = 7"}), 2);
  EXPECT_EQ(
      ::testing::internal::GetCapturedStderr(),
      "command line, --set 1: error: Contact/Friction = 7 is out of range. Allowed: 0 ... 5, default 0.5.\n");
  EXPECT_FALSE(ran);
}

TEST(ExitStatus, parameters_are_printed_without_running) {
  bool ran = false;
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(status_of(
                [&](const CommandLine &, const Scene &) {
                  ran = true;
                  return 0;
                },
                {"--print-parameters"}),
            0);
  EXPECT_TRUE(contains(::testing::internal::GetCapturedStdout(), "set Sphere radius       = 1 mm"));
  EXPECT_FALSE(ran);
}

TEST(ExitStatus, stack_traces_of_libraries_are_left_out) {
  ::testing::internal::CaptureStderr();
  status_of([](const CommandLine &, const Scene &) -> int {
    throw std::runtime_error(
        "--------\nAn error occurred in file <x.cc>\nAdditional information: \n    The matrix is "
        "singular.\n\nStacktrace:\n-----------\n#0 somewhere\n--------\n");
  });
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "The matrix is singular.\n");
}

// The words that /bin/sh sees, one a line.
std::string words_of(const std::string &command) {
  FILE *shell = popen(("printf '%s\\n' " + command).c_str(), "r");
  std::string text;
  std::array<char, 256> piece{};
  while (std::fgets(piece.data(), piece.size(), shell) != nullptr)
    text += piece.data();
  EXPECT_EQ(pclose(shell), 0) << command;
  return text;
}

TEST(Shell, a_word_is_what_it_was) {
  for (const char *word : {"results/dry",
                           "a b",
                           "$(touch x)",
                           "`touch x`",
                           "it's",
                           "''",
                           "a\"b",
                           "a;b",
                           "a&b",
                           "~",
                           "*",
                           "a\\b",
                           "",
                           " ",
                           "#a",
                           "!x",
                           "{a,b}",
                           "a>b",
                           "\xc3\xa9t\xc3\xa9",
                           "-s",
                           "a=b",
                           "x\ty"})
    EXPECT_EQ(words_of(shell_word(word)), std::string(word) + "\n") << word;
}

TEST(Shell, a_plain_word_stays_as_it_is) {
  EXPECT_EQ(shell_word("scenes/demo_dry.prm"), "scenes/demo_dry.prm");
  EXPECT_EQ(shell_word("a b"), "'a b'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
}

TEST(Shell, a_command_is_called_as_it_was) {
  CommandLine line;
  line.kind = "friction", line.scene = "my scenes/a.prm", line.output = "$(touch x)";
  line.overrides = {"Scene/Title = it's", "Loading/Target strain = 0.01"};
  EXPECT_EQ(
      words_of(shell_command("platen-study", line)),
      "platen-study\nfriction\nmy scenes/a.prm\n-o\n$(touch x)\n-s\nScene/Title = it's\n-s\nLoading/Target "
      "strain = 0.01\n");
  line.kind = "";
  line.overrides.emplace_back("  Loading/Target strain = 0.02");
  EXPECT_EQ(words_of(shell_command("platen-compress", line, "Loading/Target strain")),
            "platen-compress\nmy scenes/a.prm\n-o\n$(touch x)\n-s\nScene/Title = it's\n");
}

} // namespace
} // namespace platen::apps
