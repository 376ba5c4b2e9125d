// Characters that nobody sees in scenes, on command lines and in tables; line ends of all systems.
#include "apps/output/specimen_csv.h"
#include "apps/read_scenes.h"
#include "apps/scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

const std::string no_break = "\xc2\xa0", micro = "\xc2\xb5", mu = "\xce\xbc", thin = "\xe2\x80\xaf",
                  soft = "\xc2\xad", mark = "\xef\xbb\xbf", none_wide = "\xe2\x80\x8b",
                  cyrillic_c = "\xd0\xa1";

class SceneCharacters : public ScratchFolder {
protected:
  std::string put(const std::string &name, const std::string &text) const {
    testing::put(folder_ / name, text);
    return (folder_ / name).string();
  }
  // What is said of the scene, without the folder; "" where it is read.
  std::string said(const std::string &name, const std::string &text, const Entries &overrides = {}) const {
    const std::string what = said_of(put(name, text), overrides, "pack"), folder = folder_.string() + "/";
    return what.rfind(folder, 0) == 0 ? what.substr(folder.size()) : what;
  }
  static std::string prm(const std::string &more = "") {
    return "subsection Specimen\n"
           "  set Radius = 25 mm\n"
           "  set Height = 100 mm\n"
           "  set Sphere radius = 2 mm\n"
           "end\n" +
           more;
  }
  static std::string changed(std::string text, const std::string &what, const std::string &by) {
    return text.replace(text.find(what), what.size(), by);
  }
  static std::string all_changed(const std::string &text, char what, const std::string &by) {
    std::string result;
    for (const char c : text)
      result += c == what ? by : std::string(1, c);
    return result;
  }
};

void expect_begins(const std::string &text, const std::string &begin) {
  EXPECT_EQ(text.substr(0, begin.size()), begin);
}

TEST_F(SceneCharacters, what_cannot_be_seen_is_named_where_it_stands) {
  const std::string plain = prm(), seen = ", which cannot be seen. Allowed: blanks and tabs.";
  ASSERT_EQ(said("a.prm", plain), "");
  const struct {
    std::string what, by, says;
  } cases[] = {
      {"Sphere radius", "Sphere" + no_break + "radius",
       "a.prm:4: error: \"set Sphere" + no_break +
           "radius = 2 mm\" holds U+00A0 (no-break space) in column 13" + seen},
      {"  set Height", no_break + " set Height",
       "a.prm:3: error: \"" + no_break + " set Height = 100 mm\" holds U+00A0 (no-break space) in column 1" +
           seen},
      {"set Height", "set" + no_break + "Height",
       "a.prm:3: error: \"set" + no_break + "Height = 100 mm\" holds U+00A0 (no-break space) in column 6" +
           seen},
      {"2 mm", "2" + no_break + "mm",
       "a.prm:4: error: Specimen/Sphere radius = 2" + no_break +
           "mm holds U+00A0 (no-break space) in column 24" + seen},
      {"= 2 mm", "=\t2" + thin + "mm",
       "a.prm:4: error: Specimen/Sphere radius = 2" + thin +
           "mm holds U+202F (narrow no-break space) in column 24" + seen},
      {"2 mm", "2 mm" + none_wide,
       "a.prm:4: error: Specimen/Sphere radius = 2 mm" + none_wide +
           " holds U+200B (zero width space) in column 27" + seen},
      {"subsection Specimen", "subsection Spec" + soft + "imen",
       "a.prm:1: error: \"subsection Spec" + soft + "imen\" holds U+00AD (soft hyphen) in column 16" + seen},
      {"end", mark + "end",
       "a.prm:5: error: \"" + mark + "end\" holds U+FEFF (byte order mark) in column 1" + seen},
      {"set Radius", "set Radius\\\n" + no_break,
       "a.prm:2: error: \"set Radius" + no_break + " = 25 mm\" holds U+00A0 (no-break space) in column 1" +
           seen}};
  for (const auto &one : cases)
    expect_begins(said("a.prm", changed(plain, one.what, one.by)), one.says);
}

TEST_F(SceneCharacters, what_looks_like_another_letter_is_named) {
  const std::string plain = prm("subsection Contact\n  set Friction = 0.3\nend\n");
  ASSERT_EQ(said("a.prm", plain), "");
  expect_begins(said("a.prm", changed(plain, "Contact", cyrillic_c + "ontact")),
                "a.prm:6: error: " + cyrillic_c +
                    "ontact is not a section: it holds U+0421 (Cyrillic letter) in column 1. Did you mean "
                    "\"Contact\"?");
  expect_begins(said("a.prm", changed(plain, "Radius",
                                      "R\xd0\xb0"
                                      "dius")),
                "a.prm:2: error: Specimen/R\xd0\xb0"
                "dius is not a parameter: it holds U+0430 (Cyrillic letter) in column 11. Did you mean "
                "\"Specimen/Radius\"");
  EXPECT_TRUE(contains(said("a.prm", changed(plain, "100 mm", "100 \xd0\xbcm")),
                       "It holds U+043C (Cyrillic letter) in column 5."));
  EXPECT_TRUE(contains(said("a.prm", changed(plain, "0.3",
                                             "\xe2\x88\x92"
                                             "0.3")),
                       "is not a number. It holds U+2212 (minus sign) in column 1."));
}

TEST_F(SceneCharacters, comments_titles_and_names_of_files_may_hold_them) {
  EXPECT_EQ(said("a.prm", prm("# 40" + no_break + "MPa\nsubsection Scene\n  set Title = Beton 40" + no_break +
                              "MPa # 40" + no_break + "MPa\nend\n")),
            "");
  put("part" + no_break + ".prm", "");
  EXPECT_EQ(said("a.prm", prm("include part" + no_break + ".prm\n")), "");
  EXPECT_TRUE(contains(said("a.prm", prm("include other" + no_break + ".prm\n")),
                       "The name holds U+00A0 (no-break space) in column 14"));
}

TEST_F(SceneCharacters, json_and_the_command_line_name_them_too) {
  const std::string plain =
      "{\"Specimen\": {\"Radius\": \"25 mm\", \"Height\": \"100 mm\",\n \"Sphere radius\": \"2 mm\"}}";
  ASSERT_EQ(said("a.json", plain), "");
  expect_begins(said("a.json", changed(plain, "2 mm", "2" + no_break + "mm")),
                "a.json:2: error: Specimen/Sphere radius = 2" + no_break +
                    "mm holds U+00A0 (no-break space) in column 21, which cannot be seen.");
  expect_begins(said("a.json", changed(plain, "Sphere radius", "Sphere" + no_break + "radius")),
                "a.json:2: error: Specimen/Sphere" + no_break +
                    "radius holds U+00A0 (no-break space) in column 9, which cannot be seen.");
  expect_begins(
      said("a.json", changed(plain, "2 mm", "2\\u00a0mm")),
      "a.json:2: error: Specimen/Sphere radius = 2" + no_break + "mm holds U+00A0 (no-break space), which");
  EXPECT_EQ(said("a.prm", prm(), {"Specimen/Height =" + no_break + "90 mm"}),
            "command line, --set 1: error: Specimen/Height = " + no_break +
                "90 mm holds U+00A0 (no-break space) in column 18, which cannot be seen. Allowed: blanks and "
                "tabs.");
  EXPECT_EQ(
      said("a.prm", prm(), {"Specimen/" + none_wide + "Height = 90 mm"}),
      "command line, --set 1: error: \"Specimen/" + none_wide +
          "Height = 90 mm\" holds U+200B (zero width space) in column 10, which cannot be seen. Allowed: "
          "blanks and tabs.");
  EXPECT_EQ(said("a.prm", prm(), {"Scene/Title = 40" + no_break + "MPa"}), "");
}

TEST_F(SceneCharacters, both_signs_for_micro_are_one) {
  const Scene one = read_scene(put("a.prm", changed(prm(), "2 mm", "2000 " + micro + "m")), {},
                               program("pack")),
              other =
                  read_scene(put("b.prm", changed(prm(), "2 mm", "2000 " + mu + "m")), {}, program("pack"));
  EXPECT_EQ(one.specimen.sphere_radius, other.specimen.sphere_radius);
  EXPECT_DOUBLE_EQ(other.specimen.sphere_radius, 0.002);
}

TEST_F(SceneCharacters, line_ends_of_all_three_kinds_are_read) {
  const std::string
      json =
          "{\"Specimen\": {\"Radius\": \"25 mm\",\n\"Height\": \"100 mm\",\n\"Sphere radius\": \"2 mm\"}}\n",
      bad = prm("subsection Bond\n  set Gapp = 1\nend\n");
  for (const char *end : {"\r", "\r\n", "\n"}) {
    EXPECT_EQ(said("a.prm", all_changed(prm(), '\n', end)), "");
    EXPECT_EQ(said("a.json", all_changed(json, '\n', end)), "");
    put("part.prm", all_changed("subsection Contact\n  set Friction = 0.1\nend\n", '\n', end));
    EXPECT_EQ(said("a.prm", all_changed(prm("include part.prm\n"), '\n', end)), "");
    expect_begins(said("a.prm", all_changed(bad, '\n', end)),
                  "a.prm:7: error: Bond/Gapp is not a parameter.");
    expect_begins(said("a.json", all_changed(changed(json, "Height", "Heigth"), '\n', end)),
                  "a.json:2: error: Specimen/Heigth is not a parameter.");
    const std::string table =
        "# shape: cylinder radius_m=0.025 height_m=0.1\nx_m,y_m,z_m,radius_m\n0,0,0.01,0.001\n0,0,x,0.001\n";
    EXPECT_TRUE(contains(
        message_of<InputError>([&] { read_specimen_csv(put("s.csv", all_changed(table, '\n', end))); }),
        "s.csv:4: error: column z_m: \"x\""));
    EXPECT_EQ(read_specimen_csv(put("s.csv", all_changed(changed(table, "x,", "0.02,"), '\n', end)))
                  .specimen.size(),
              2u);
  }
}

TEST_F(SceneCharacters, tables_of_spheres_name_them) {
  const std::string table = put("s.csv", "x_m,y_m,z_m,radius_m\n0,0," + no_break + "0.01,0.001\n");
  EXPECT_TRUE(contains(message_of<InputError>([&] { read_specimen_csv(table); }),
                       "the line holds U+00A0 (no-break space) in column 5"));
}

} // namespace
} // namespace platen::apps
