// Letters of pictures: every title is readable, however long it is and whatever it is written in.
#include "apps/report/letters.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace platen::apps::report {
namespace {

TEST(ReportLetters, code_points_are_read_and_bad_bytes_replaced) {
  EXPECT_EQ(code_points("a\xC2\xB0\xCF\x83\xE4\xB8\x89"), (std::vector<char32_t>{U'a', 0xB0, 0x3C3, 0x4E09}));
  EXPECT_EQ(code_points("\xFF"
                        "a\xC3"),
            (std::vector<char32_t>{0xFFFD, U'a', 0xFFFD}));
}

TEST(ReportLetters, bytes_that_are_no_text_are_replaced) {
  EXPECT_EQ(valid_utf8("caf\xE9"), "caf\xEF\xBF\xBD");
  EXPECT_EQ(valid_utf8("\xCF\x83 = 3"), "\xCF\x83 = 3");
}

TEST(ReportLetters, latin_has_the_house_font_and_greek_one_that_has_it) {
  EXPECT_EQ(font_file_for("Concrete, 30\xC2\xB0", true), "");
  const std::string greek = font_file_for("\xCF\x83 = 3 MPa", false),
                    cyrillic = font_file_for("\xD0\x91\xD0\xB5", true);
  ASSERT_FALSE(greek.empty()) << "fonts-dejavu-core is not installed";
  EXPECT_TRUE(std::filesystem::exists(greek)) << greek;
  EXPECT_TRUE(std::filesystem::exists(cyrillic)) << cyrillic;
}

TEST(ReportLetters, lines_break_at_blanks_and_within_long_words) {
  EXPECT_EQ(wrapped("one two three", 7), "one two\nthree");
  EXPECT_EQ(wrapped("one two three", 20), "one two three");
  EXPECT_EQ(wrapped("abcdefgh ij", 3), "abc\ndef\ngh\nij");
  EXPECT_EQ(wrapped("\xCF\x83\xCF\x83\xCF\x83", 2), "\xCF\x83\xCF\x83\n\xCF\x83"); // letters, not bytes
  EXPECT_EQ(wrapped("", 5), "");
}

TEST(ReportLetters, shortened_text_keeps_its_beginning) {
  EXPECT_EQ(shortened("abcdef", 6), "abcdef");
  EXPECT_EQ(shortened("abcdefg", 6), "abc...");
  EXPECT_EQ(shortened("\xCF\x83\xCF\x83\xCF\x83\xCF\x83\xCF\x83", 4), "\xCF\x83...");
}

} // namespace
} // namespace platen::apps::report
