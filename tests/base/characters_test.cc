#include "base/characters.h"

#include <gtest/gtest.h>

namespace platen::characters_test {
namespace {

TEST(Characters, what_cannot_be_seen_is_named_with_its_column) {
  const struct {
    std::string text, says;
  } cases[] = {{"set\xc2\xa0Gap", "U+00A0 (no-break space) in column 4"},
               {"ab\xe2\x80\x8b", "U+200B (zero width space) in column 3"},
               {"\xef\xbb\xbfset", "U+FEFF (byte order mark) in column 1"},
               {"\xc2\xb5\xc2\xb5\xc2\xadm", "U+00AD (soft hyphen) in column 3"},
               {"40\xe2\x80\xafGPa", "U+202F (narrow no-break space) in column 3"},
               {"40\xe3\x80\x80GPa", "U+3000 (ideographic space) in column 3"},
               {"40\xa0GPa", "the byte A0, which is no UTF-8 in column 3"},
               {"40\xe2\x80", "the byte E2, which is no UTF-8 in column 3"},
               {"Cont\xd0\xb0"
                "ct",
                "U+0430 (Cyrillic letter) in column 5"},
               {"\xce\x92ond", "U+0392 (Greek letter) in column 1"},
               {"\xe2\x88\x92"
                "5",
                "U+2212 (minus sign) in column 1"}};
  for (const auto &one : cases)
    EXPECT_EQ(text_of_odd_character(one.text), one.says) << one.text;
}

TEST(Characters, what_scenes_are_written_with_is_plain) {
  for (const char *text :
       {"", "set Gap\t= 0.05 R_min # a", "25 \xc2\xb5m", "25 \xce\xbcm", "30 \xc2\xb0", "5 mm\xc2\xb2",
        "B\xc3\xa9ton \xe6\xb7\xb7\xe5\x87\x9d\xe5\x9c\x9f \xf0\x9f\xa7\xb1"})
    EXPECT_EQ(text_of_odd_character(text), "") << text;
}

TEST(Characters, three_kinds_of_line_ends_are_one) {
  EXPECT_EQ(with_plain_line_ends("a\r\nb\rc\n\r\rd"), "a\nb\nc\n\n\nd");
  EXPECT_EQ(with_plain_line_ends("a\nb"), "a\nb");
}

TEST(Characters, two_signs_for_micro_are_one) {
  EXPECT_EQ(with_micro_sign("\xce\xbcm \xc2\xb5s"), "\xc2\xb5m \xc2\xb5s");
}

} // namespace
} // namespace platen::characters_test
