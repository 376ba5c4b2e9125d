// All that is wrong with a scene is told at once, in the order of files, lines and options; what only follows
// from another fault is not.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "apps/read_scenes.h"
#include "apps/scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

class ManyFaults : public ScratchFolder {
protected:
  void put(const std::string &name, const std::string &text) const { testing::put(folder_ / name, text); }
  // Each line of the message, without the folder.
  Entries told(const std::string &name, const Entries &overrides = {}) const {
    std::istringstream text(said_of(folder_ / name, overrides));
    const std::string before = folder_.string() + "/";
    Entries lines;
    for (std::string line; std::getline(text, line);)
      lines.push_back(line.rfind(before, 0) == 0 ? line.substr(before.size()) : line);
    return lines;
  }
  static std::string begins(const std::string &line, const std::string &with) {
    return line.compare(0, with.size(), with) == 0 ? "" : line + "\n does not begin with " + with;
  }
  void expect(const Entries &lines, const Entries &beginnings) const {
    ASSERT_EQ(lines.size(), beginnings.size()) << ::testing::PrintToString(lines);
    for (std::size_t k = 0; k < lines.size(); ++k)
      EXPECT_EQ(begins(lines[k], beginnings[k]), "");
  }

  const std::string good_ = "include " + good + "\n";
};

TEST_F(ManyFaults, are_told_in_the_order_of_lines_and_options) {
  put("bad.prm",
      "subsection Loading\n  set Axial rat = 5 mm/s\n  set Test = tension\nend\n"
      "subsection Specimen\n  set Radius = -5 mm\n  set Height = 10 mm\n  set Height = 20 mm\n"
      "  set Sphere radius = 1 mm\nend\n"
      "subsection Bond\n  set Tensile strength 9 MPa\n  set Shear strength = 30 MPa\n"
      "  set Modulus = 30 GPa\n  set Gap = 50 R_min\nend\n"
      "subsection Platens\n  set Friction dynamic = 0.5\nend\n");
  expect(told("bad.prm",
              {"Bond/Radius rule = given", "Integration/Safety = 2", "Specimen/Seat = on", "nothing"}),
         {"bad.prm:2: error: Loading/Axial rat is not a parameter. Did you mean \"Loading/Axial rate\"",
          "bad.prm:3: error: Loading/Test = tension needs Platens/Attachment = glued",
          "bad.prm:6: error: Specimen/Radius = -5 mm is out of range",
          "bad.prm:8: error: Specimen/Height = 20 mm is set twice",
          "bad.prm:12: error: \"set Tensile strength 9 MPa\" has no \"=\"",
          "bad.prm:15: error: Bond/Gap = 50 R_min reaches past",
          "bad.prm:18: error: Platens/Friction dynamic = 0.5 is above the static friction",
          "bad.prm: error: Bond/Radius is not set",
          "command line, --set 2: error: Integration/Safety = 2 is out of range",
          "command line, --set 3: error: Specimen/Seat = on needs Specimen/Ends = ground",
          "command line, --set 4: error: \"nothing\" sets nothing."});
}

TEST_F(ManyFaults, of_included_files_come_after_those_of_the_file_that_includes_them) {
  put("part.prm",
      "subsection Bond\n  set Modulos = 1 GPa\nend\nsubsection Integration\n  set Safety = 3\nend\n");
  put("bad.prm", "include part.prm\nsubsection Loading\n  set Ramp = -1 s\nend\n");
  const Entries lines = told("bad.prm");
  ASSERT_GE(lines.size(), 3u);
  EXPECT_EQ(begins(lines[0], "bad.prm:3: error: Loading/Ramp = -1 s"), "");
  EXPECT_EQ(begins(lines[lines.size() - 2], "part.prm:2: error: Bond/Modulos"), "");
  EXPECT_EQ(begins(lines.back(), "part.prm:5: error: Integration/Safety = 3"), "");
}

TEST_F(ManyFaults, what_follows_from_another_is_not_told) {
  // A needed entry that could not be read, or whose key is misspelt, is not missing.
  put("a.prm", good_);
  expect(told("a.prm", {"Loading/Axial rate = fast", "Bond/Modulus = 3 mm"}),
         {"command line, --set 1: error: Loading/Axial rate = fast",
          "command line, --set 2: error: Bond/Modulus"});
  put("b.prm", good_ + "subsection Bond\n  set Radius rule = given\n  set Radios = 1 mm\nend\n");
  expect(told("b.prm"), {"b.prm:4: error: Bond/Radios is not a parameter."});
  // A word that cannot be read decides what else is needed: nothing is said that another word would not need.
  expect(told("a.prm", {"Effects/Bond = cohesiv beam", "Bond/Modulus ="}),
         {"command line, --set 1: error: Effects/Bond = cohesiv beam is not known"});
  expect(told("a.prm", {"Loading/Test = hydrostatik", "Loading/Axial rate ="}),
         {"command line, --set 1: error: Loading/Test = hydrostatik is not known"});
  expect(told("a.prm", {"Loading/Test = hydrostatik", "Specimen/Seat = on"}),
         {"command line, --set 1: error: Loading/Test = hydrostatik is not known",
          "command line, --set 2: error: Specimen/Seat = on needs"});
  // What a section of an unknown name holds is passed over, and what it would have set is not missing.
  put("c.prm",
      "subsection Specimn\n  set Radius = 5 mm\n  set Nonsense = 3\nend\n"
      "subsection Bond\n  set Modulus = 40 GPa\n  set Tensile strength = 9 MPa\n"
      "  set Shear strength = 9 MPa\nend\nsubsection Loading\n  set Axial rate = 5 mm/s\nend\n");
  expect(told("c.prm"), {"c.prm:1: error: Specimn is not a section. Did you mean \"Specimen\"?"});
  // A file that is not there, or an end that is missing, leaves nothing to say of what is not set.
  put("d.prm", "include nowhere.prm\nsubsection Integration\n  set Safety = 3\nend\n");
  expect(told("d.prm"), {"d.prm:1: error: include nowhere.prm", "d.prm:3: error: Integration/Safety = 3"});
  put("e.prm", "subsection Bond\n  set Modulus = -1\n");
  expect(told("e.prm"),
         {"e.prm:1: error: subsection Bond is opened here", "e.prm:2: error: Bond/Modulus = -1"});
}

TEST_F(ManyFaults, of_an_entry_are_told_once) {
  put("a.prm", good_);
  expect(told("a.prm", {"Specimen/Sphere radius = 20 mm"}), // larger than radius and height
         {"command line, --set 1: error: Specimen/Sphere radius = 20 mm is too large"});
  expect(told("a.prm", {"Loading/Start strain = 0.5", "Effects/Gravity = on"}), // two reasons against it
         {"command line, --set 1: error: Loading/Start strain = 0.5"});
}

TEST_F(ManyFaults, twenty_are_told_and_the_rest_counted) {
  std::string text = "subsection Bond\n";
  for (int k = 0; k < 25; ++k)
    text += "  set Modulos = " + std::to_string(k) + "\n";
  put("bad.prm", text + "end\n");
  const Entries lines = told("bad.prm");
  ASSERT_EQ(lines.size(), 21u);
  EXPECT_EQ(begins(lines[0], "bad.prm:2: "), "");
  EXPECT_EQ(begins(lines[19], "bad.prm:21: "), "");
  EXPECT_EQ(begins(lines[20], "... and "), "");
}

TEST_F(ManyFaults, of_json_are_told_together_too) {
  put("bad.json",
      "{\"Bond\": {\"Moduluss\": 1,\n\"Gap\": -1},\n\"Bonds\": {\"Modulus\": {\"a\": 1}, \"x\": 2},\n"
      "\"Integration\": {\"Safety\": 2}}\n");
  const Entries lines = told("bad.json");
  ASSERT_GE(lines.size(), 4u);
  EXPECT_EQ(begins(lines[0], "bad.json:1: error: Bond/Moduluss is not a parameter"), "");
  EXPECT_EQ(begins(lines[1], "bad.json:2: error: Bond/Gap = -1"), "");
  EXPECT_EQ(begins(lines[2], "bad.json:3: error: Bonds is not a section"), "");
  EXPECT_EQ(begins(lines[3], "bad.json:4: error: Integration/Safety = 2"), "");
}

} // namespace
} // namespace platen::apps
