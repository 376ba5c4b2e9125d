// --print-parameters leaves out what a program does not read: with all of that changed it finds the same.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "apps/program.h"
#include "apps/programs.h"
#include "apps/scene/errors.h"
#include "apps/scene/parameters.h"
#include "apps/scene/scene.h"
#include "apps/scratch_folder.h"

namespace platen::apps::testing {
namespace {

struct App {
  std::string program, scene;
  std::vector<std::string> entries; // that make it small
  std::size_t fewest;               // of entries that can be changed
};

bool accepted(const App &app, const std::vector<std::string> &entries) {
  try {
    read_scene(app.scene, entries, program(app.program));
    return true;
  } catch (const InputError &) {
    return false;
  }
}

// Values that differ from what the scene has, of which an entry takes one or none.
std::vector<std::string> other_values(const Entry &entry) {
  std::vector<std::string> values = entry.words;
  for (const char *value : {"0.31", "0.7", "2", "3", "17", "5e9", "1e-3", "1e-5", "0.1, 0.2", "1 GPa, 2 GPa",
                            "dry steel", "on", "hold", "time 1 s", "something else"})
    values.emplace_back(value);
  return values;
}

// One assignment for each entry that the program does not read and that it takes another value of, all
// together.
std::vector<std::string> what_it_does_not_read(const App &app) {
  const Scene scene = read_scene(app.scene, app.entries, program(app.program));
  std::vector<std::string> all = app.entries;
  for (const Entry &entry : scene.parameters->entries()) {
    if (program(app.program).reads_entry(entry.path) || entry.number > 1) continue;
    for (const std::string &value : other_values(entry)) {
      if (value == entry.text) continue;
      all.push_back(entry.path + " = " + value);
      if (accepted(app, all)) break;
      all.pop_back();
    }
  }
  return all;
}

class Readers : public ScratchFolder {
protected:
  int run(const App &app, const std::vector<std::string> &entries, const std::string &to) {
    std::vector<std::string> command{
        std::string(PLATEN_APPS) + "/" + app.program, app.scene, "-o", to, "--quiet", "-t", "2"};
    for (const std::string &entry : entries)
      command.insert(command.end(), {"-s", entry});
    return Program(command, folder_).wait();
  }
  // All that it finds, without what it costs and the scene itself.
  std::map<std::string, std::string> found(const std::string &in) {
    std::map<std::string, std::string> all = results_in(folder_ / in);
    all.erase("scene.prm");
    nlohmann::json summary = summary_in(folder_ / in);
    for (const char *cost : {"wall_seconds", "setup_seconds", "particle_steps_per_second", "stage_seconds",
                             "peak_memory_bytes", "cores", "seconds", "scene_sha256", "overridden"})
      summary.erase(cost);
    all["summary.json"] = summary.dump(1);
    return all;
  }
  Outcome print(const std::string &program, const std::vector<std::string> &after) {
    std::vector<std::string> command{std::string(PLATEN_APPS) + "/" + program};
    command.insert(command.end(), after.begin(), after.end());
    return run_program(command, folder_);
  }
};

TEST_F(Readers, a_program_reads_nothing_that_it_does_not_print) {
  const std::string scenes = PLATEN_SCENES;
  const std::vector<App> apps{
      {"platen-pack", test_scene("crushed.prm"), {}, 150},
      {"platen-bonds", scenes + "/two_particles.prm", {}, 150},
      {"platen-bar", test_scene("bar.prm"), {"Bar test/Load = tension", "Bar test/Periods = 4"}, 100},
      {"platen-brazilian", test_scene("split.prm"), {"Loading/Target strain = 0.001"}, 40},
      {"platen-calibrate",
       test_scene("crushed.prm"),
       {"Calibrate/Mode = abacus", "Calibrate/Seeds = 1"},
       40}};
  for (const App &app : apps) {
    const std::vector<std::string> changed = what_it_does_not_read(app);
    EXPECT_GE(changed.size(), app.fewest) << app.program;
    const std::string one = app.program + " as it is", other = app.program + " changed";
    ASSERT_EQ(run(app, app.entries, one), 0) << app.program << content_of(folder_ / "error.txt");
    ASSERT_EQ(run(app, changed, other), 0) << app.program << content_of(folder_ / "error.txt");
    const auto first = found(one), second = found(other);
    EXPECT_FALSE(first.empty());
    EXPECT_EQ(difference(first, second), "") << app.program << "\n"
                                             << first.at("summary.json") << second.at("summary.json");
  }
}

// A standard of discs would refuse the compressions that the targets lead to.
TEST_F(Readers, trials_of_a_calibration_are_of_no_standard) {
  const Outcome dry = print(
      "platen-calibrate", {test_scene("crushed.prm"), "--dry-run", "-s",
                           "Calibrate/Target 1 = strength_pa: 40 MPa", "-s", "Scene/Standard = EN 12390-6"});
  EXPECT_EQ(dry.status, 0) << dry.error;
}

// A study is of runs of platen-compress, and asks its own section what they are.
TEST_F(Readers, a_study_does_not_look_into_the_sections_of_others) {
  int files = 0;
  for (const auto &file : fs::directory_iterator(std::string(PLATEN_SOURCE) + "/apps/study")) {
    const std::string text = content_of(file.path());
    for (const char *member : {"pair_test", ".calibrate.", "bar_test"})
      EXPECT_EQ(text.find(member), std::string::npos) << file.path() << ": " << member;
    ++files;
  }
  EXPECT_GE(files, 8);
}

TEST_F(Readers, parameters_are_printed_by_program_section_and_key) {
  const auto entries_of = [](const std::string &text) {
    std::istringstream lines(text);
    std::vector<std::string> sets;
    for (std::string line; std::getline(lines, line);)
      if (const auto at = line.find("set "); at != std::string::npos && line.find('#') == std::string::npos)
        sets.push_back(line);
    return sets.size();
  };
  // By program.
  const Outcome pack = print("platen-pack", {"--print-parameters"}),
                compress = print("platen-compress", {"--print-parameters"}),
                study = print("platen-study", {"--print-parameters"});
  EXPECT_EQ(pack.status + compress.status + study.status, 0);
  for (const char *section : {"subsection Loading", "subsection Study", "subsection Contact"})
    EXPECT_FALSE(contains(pack.out, section));
  EXPECT_TRUE(contains(pack.out, "subsection Specimen"));
  EXPECT_TRUE(contains(compress.out, "subsection Loading"));
  EXPECT_FALSE(contains(compress.out, "subsection Study"));
  EXPECT_TRUE(contains(study.out, "subsection Study"));
  // By section and key, before and behind a scene, with its values.
  const Outcome bond = print("platen-compress", {"--print-parameters", "Bond"}),
                gap = print("platen-compress", {"--print-parameters", "Bond/Gap", test_scene("crushed.prm")}),
                same = print("platen-compress", {test_scene("crushed.prm"), "--print-parameters=Bond/Gap"}),
                top = print("platen-compress", {"--print-parameters", "Platens/Top"}),
                platens = print("platen-compress", {"--print-parameters", "Platens"});
  EXPECT_TRUE(contains(bond.out, "set Tensile strength")) << bond.error;
  EXPECT_FALSE(contains(bond.out, "subsection Specimen"));
  EXPECT_EQ(entries_of(gap.out), 1u) << gap.out << gap.error;
  EXPECT_TRUE(contains(gap.out, "set Gap = 0.05 R_min"));
  EXPECT_TRUE(contains(gap.out, "Allowed: "));
  EXPECT_EQ(gap.out, same.out);
  EXPECT_TRUE(contains(top.out, "set Seat"));
  EXPECT_LT(entries_of(top.out), entries_of(platens.out));
  EXPECT_TRUE(contains(platens.out, "subsection Top"));
  // A further one of sections alike is printed where it is asked for.
  EXPECT_TRUE(contains(print("platen-compress", {"--print-parameters", "Loading/Stage 3"}).out, "set Until"));
  // A scene behind the option stays a scene, as a kind of a study stays one.
  EXPECT_TRUE(
      contains(print("platen-compress", {"--print-parameters", test_scene("crushed.prm")}).out, "= 36 GPa"));
  EXPECT_EQ(print("platen-study", {"--print-parameters", "size", test_scene("study.prm")}).status, 0);
  const Outcome json = print("platen-compress", {"--print-parameters", "Bond/Gap", "--json"});
  const auto tree = nlohmann::json::parse(json.out);
  EXPECT_EQ(tree.size(), 1u);
  EXPECT_EQ(tree["Bond"].size(), 1u);
  EXPECT_EQ(tree["Bond"]["Gap"]["default_value"], "0.05 R_min");
}

TEST_F(Readers, parts_that_are_not_there_are_refused_with_the_nearest) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> bad{
      {{"Bnd"},
       "command line: error: --print-parameters Bnd: no such section or entry. Did you mean \"Bond\"?"},
      {{"Bond/Gpa"}, "Did you mean \"Bond/Gap\"?"},
      {{"Gap"}, "Did you mean \"Bond/Gap\"?"},
      {{"Nonsense"}, "no such section or entry. Allowed: SECTION or SECTION/KEY"},
      {{"Study"}, "platen-compress reads nothing of Study."},
      {{"Bar test/Load"}, "platen-compress reads nothing of Bar test/Load."}};
  for (const auto &[after, says] : bad) {
    std::vector<std::string> arguments{"--print-parameters"};
    arguments.insert(arguments.end(), after.begin(), after.end());
    const Outcome outcome = print("platen-compress", arguments);
    EXPECT_EQ(outcome.status, 2) << after[0];
    EXPECT_EQ(outcome.out, "") << after[0];
    EXPECT_TRUE(contains(outcome.error, says));
  }
  EXPECT_EQ(print("platen-compress", {"--print-parameters="}).status, 2);
}

} // namespace
} // namespace platen::apps::testing
