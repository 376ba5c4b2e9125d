// Commands that are printed to be pasted: a shell makes of them what was called.
#include "apps/scene/command_line.h"
#include "apps/scene/shell.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

namespace platen::apps {
namespace {

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
