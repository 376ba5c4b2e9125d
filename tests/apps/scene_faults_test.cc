// tests/apps/faulty.txt is a table of scenes with one fault in each, and of what the message must hold.
// Adding a bad scene is adding a block; how one is written, the table says itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include "apps/programs.h"
#include "apps/scene/declare.h"
#include "apps/scene/scene.h"

namespace platen::apps {
namespace {

const std::filesystem::path folder = PLATEN_TEST_DATA;

std::string message_of(const std::string &path, const std::vector<std::string> &overrides = {},
                       const apps::Program &app = program("compress")) {
  try {
    read_scene(path, overrides, app);
  } catch (const InputError &error) {
    return error.what();
  }
  return "";
}

struct Entry {
  std::string section, key, value;
};

struct Block {
  std::vector<Entry> entries;
  std::string lines; // after the entries
  std::vector<std::string> says;
};

std::vector<Entry>::iterator found(std::vector<Entry> &entries, const Entry &entry) {
  return std::find_if(entries.begin(), entries.end(), [&](const Entry &other) {
    return other.section == entry.section && other.key == entry.key;
  });
}

// "Section/Key = value", or without the value.
Entry entry_of(const std::string &text) {
  const std::size_t equals = std::min(text.find(" ="), text.size()), slash = text.rfind('/', equals);
  const std::string section = slash == std::string::npos ? "" : text.substr(0, slash);
  const std::size_t key = slash == std::string::npos ? 0 : slash + 1;
  return {section, text.substr(key, equals - key), text.substr(equals)};
}

void add(std::vector<Entry> &entries, const Entry &entry) {
  const auto old = found(entries, entry);
  if (old != entries.end()) {
    *old = entry;
    return;
  }
  const auto last = std::find_if(entries.rbegin(), entries.rend(),
                                 [&](const Entry &other) { return other.section == entry.section; });
  entries.insert(last == entries.rend() ? entries.end() : last.base(), entry);
}

std::map<std::string, Block> read_table(const std::filesystem::path &path) {
  std::map<std::string, Block> table;
  std::ifstream file(path);
  std::string name;
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first == std::string::npos || line[first] == '#') continue;
    if (first == 0) { // a name
      const std::size_t bracket = line.find(" [");
      name = line.substr(0, bracket);
      std::string base = name.find('.') == std::string::npos ? "" : "cylinder";
      if (bracket != std::string::npos) base = line.substr(bracket + 2, line.size() - bracket - 3);
      EXPECT_EQ(table.count(name), 0u) << name << " stands there twice";
      EXPECT_EQ(table.count(base), base.empty() ? 0u : 1u)
          << name << " is made from what is not above it: " << base;
      table[name] = base.empty() ? Block() : Block(table[base]);
      continue;
    }
    Block &block = table.at(name);
    const std::string text = line.substr(first), rest = text.substr(std::min<std::size_t>(2, text.size()));
    if (text.front() == '|') {
      block.lines += rest + "\n";
    } else if (text.front() == '>') {
      block.says.push_back(rest.rfind(':', 0) == 0 ? name + rest : rest);
    } else if (text.front() == '-') {
      const auto old = found(block.entries, entry_of(rest));
      if (old == block.entries.end())
        ADD_FAILURE() << name << " leaves out what its base does not have: " << rest;
      else
        block.entries.erase(old);
    } else {
      const Entry entry = entry_of(text);
      EXPECT_FALSE(entry.value.empty()) << name << ": no entry: " << text;
      add(block.entries, entry);
    }
  }
  return table;
}

std::string scene_of(const Block &block) {
  std::string text, open;
  const auto enter = [&](const std::string &section) {
    if (section == open) return;
    std::string word;
    for (std::istringstream words(open); std::getline(words, word, '/');)
      text += "end\n";
    for (std::istringstream words(section); std::getline(words, word, '/');)
      text += "subsection " + word + "\n";
    open = section;
  };
  for (const Entry &entry : block.entries) {
    enter(entry.section);
    text += "  set " + entry.key + entry.value + "\n";
  }
  enter("");
  return text + block.lines;
}

TEST(SceneFaults, each_bad_scene_is_refused_with_place_key_value_and_what_is_allowed) {
  const auto temporary = std::filesystem::temp_directory_path() / "platen faulty scenes";
  std::filesystem::remove_all(temporary);
  std::filesystem::create_directories(temporary);
  std::filesystem::copy(folder / "fragment", temporary / "fragment");
  int scenes = 0;
  for (const auto &[name, block] : read_table(folder.string() + ".txt")) {
    if (name.find('.') == std::string::npos) continue; // a base
    ++scenes;
    const std::string path = (temporary / name).string();
    std::ofstream(path) << scene_of(block);
    const bool calibrates = name.rfind("calibrate_", 0) == 0;
    const std::string message = message_of(path, {}, program(calibrates ? "calibrate" : "compress"));
    EXPECT_FALSE(block.says.empty()) << name << " does not say what is wrong with it";
    EXPECT_FALSE(message.empty()) << name << " was read";
    for (const std::string &fragment : block.says)
      EXPECT_NE(message.find(fragment), std::string::npos)
          << name << "\n says: " << message << "\n not: " << fragment;
    EXPECT_LE(std::count(message.begin(), message.end(), '\n'), 5) << message; // six lines
  }
  EXPECT_GE(scenes, 200);
  std::filesystem::remove_all(temporary);
}

TEST(SceneFaults, files_that_are_no_scenes_are_refused) {
  const auto temporary = std::filesystem::temp_directory_path() / "platen scene faults";
  std::filesystem::create_directories(temporary / "folder.prm");
  std::ofstream(temporary / "zero.prm") << "subsection Bond" << '\0' << "end";
  std::ofstream(temporary / "scene.txt") << "";
  std::ofstream(temporary / "large.prm") << std::string(5000000, '\n');
  EXPECT_NE(
      message_of((temporary / "nowhere.prm").string()).find("cannot be read: No such file or directory."),
      std::string::npos);
  EXPECT_NE(message_of((temporary / "folder.prm").string()).find("it is a folder."), std::string::npos);
  EXPECT_NE(message_of((temporary / "zero.prm").string()).find("no text file."), std::string::npos);
  EXPECT_NE(message_of((temporary / "scene.txt").string()).find("names that end in .prm or .json."),
            std::string::npos);
  EXPECT_NE(message_of((temporary / "large.prm").string()).find("so it is no scene."), std::string::npos);
  std::filesystem::remove_all(temporary);
}

// Each file includes two others, or itself, or the next one twice: 2^15 files are no scene.
TEST(SceneFaults, so_many_includes_are_refused_at_once) {
  const auto temporary = std::filesystem::temp_directory_path() / "platen scene includes";
  std::filesystem::create_directories(temporary);
  for (int depth = 0; depth < 15; ++depth) {
    const std::string next = "include " + std::to_string(depth + 1) + ".prm\n";
    std::ofstream(temporary / (std::to_string(depth) + ".prm")) << next + next;
  }
  std::ofstream(temporary / "15.prm") << "\n";
  const std::string message = message_of((temporary / "0.prm").string());
  EXPECT_NE(message.find(
                "more than 500 files are included, those that are included again counted again. Allowed: up "
                "to that."),
            std::string::npos)
      << message;
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message; // told once
  // As many as that are taken.
  std::ofstream all(temporary / "all.prm");
  for (int k = 0; k < 500; ++k)
    all << "include 15.prm\n";
  all.close();
  EXPECT_EQ(message_of((temporary / "all.prm").string(), {}, program("pack")).find("files are included"),
            std::string::npos);
  std::ofstream(temporary / "all.prm", std::ios::app) << "include 15.prm\n";
  EXPECT_NE(message_of((temporary / "all.prm").string(), {}, program("pack"))
                .find(":501: error: include 15.prm: more than"),
            std::string::npos);
  std::filesystem::remove_all(temporary);
}

struct FaultyOverride {
  std::vector<std::string> overrides;
  const char *says;
};

TEST(SceneFaults, bad_overrides_are_refused_by_their_number) {
  const FaultyOverride faults[] = {
      {{"Contact/Friction = 0.2", "Contact/Frictoin = 0.3"},
       "command line, --set 2: error: Contact/Frictoin is not a parameter. Did you mean "
       "\"Contact/Friction\""},
      {{"Platens/Friction = 0.3"},
       "Platens/Friction is not a parameter. Did you mean \"Platens/Friction static\", \"Platens/Friction "
       "dynamic\" "
       "or \"Platens/Friction law\"?"},
      {{"Loading/Rate = 0.3"}, "Did you mean \"Loading/Axial rate\"?"},
      {{"Bond/strength = 3 MPa"}, "Did you mean \"Bond/Tensile strength\", \"Bond/Shear strength\""},
      {{"Specimen/Radus = 3 mm"}, "Did you mean \"Specimen/Radius\""},
      {{"Loading/Stage 21/Axial = hold"},
       "Loading/Stage 21 is not a section. The last one is Loading/Stage 20."},
      {{"Loading/Stage 0/Axial = hold"}, "The last one is Loading/Stage 20."},
      {{"Specimen/Radius = 25 m"},
       "--set 1: error: Specimen/Radius = 25 m gives a width that is 5e+03 times Specimen/Height = 10 mm. "
       "Allowed: "
       "0.005 ... 200."},
      {{"Bond/Modulus = 48 Gpa"}, "has the unit \"Gpa\", which is not known. Did you mean \"GPa\"?"},
      {{"Contact/Friction = 9"},
       "command line, --set 1: error: Contact/Friction = 9 is out of range. Allowed: 0 ... 5"},
      {{"Contact/Friction"}, "command line, --set 1: error: \"Contact/Friction\" sets nothing."},
      {{"Contcat/Friction = 0.3"}, "Contcat is not a section. Did you mean \"Contact\"?"},
      {{"Friction = 0.3"}, "Friction is not a parameter. Did you mean \"Contact/Friction\""},
      {{"Bond/Modulus = 40 m"}, "Bond/Modulus = 40 m has the unit \"m\", which is not that of a pressure"},
      {{"Platens/Kind = deformable", "Integration/Scheme = tchamwa wielgosz"},
       "--set 1: error: Platens/Kind = deformable needs Integration/Scheme = velocity verlet. Allowed: "
       "rigid."},
      {{"Platens/Kind = deformable", "Platens/Pad thickness = 0.1 mm"},
       "Platens/Pad modulus is not set: the pad has to have one."},
      {{"Platens/Kind = deformable", "Platens/Pad thickness = 1 m"},
       "--set 2: error: Platens/Pad thickness = 1 m leaves nothing of the platen. Allowed: 0 ... "},
      {{"Platens/Top/Mesh file = none.msh"}, "--set 1: error: Platens/Top/Mesh file = none.msh"},
      {{"Platens/Top/Seat = spherical", "Integration/Scheme = tchamwa wielgosz"},
       "--set 1: error: Platens/Top/Seat = spherical needs Integration/Scheme = velocity verlet. Allowed: "
       "fixed."},
      {{"Platens/Degree = 3"}, "--set 1: error: Platens/Degree = 3 is out of range. Allowed: whole, 1 ... 2"},
      {{"Loading/Test = tension"}, "--set 1: error: Loading/Test = tension needs Platens/Attachment = glued"},
      {{"Scene/Title = a # b"}, "--set 1: error: Scene/Title = a # b holds a \"#\""},
      {{"= 3"}, "--set 1: error: "},
      {{""}, "--set 1: error: \"\" sets nothing."}};
  const auto good = (folder / "fragment" / "good.prm").string();
  for (const FaultyOverride &fault : faults)
    EXPECT_NE(message_of(good, fault.overrides).find(fault.says), std::string::npos)
        << fault.overrides.back() << ": " << message_of(good, fault.overrides);
}

// Once refused with elastic platens, now run.
TEST(SceneFaults, elastic_platens_go_with_every_test) {
  const auto good = (folder / "fragment" / "good.prm").string();
  const std::vector<std::vector<std::string>> tests{
      {"Platens/Attachment = glued", "Loading/Test = tension"},
      {"Platens/Top/Control = stress", "Platens/Top/Stress = 1 MPa", "Loading/Ramp = 1 ms"},
      {"Loading/Test = hydrostatic", "Loading/Confinement = particles", "Loading/Confining pressure = 1 MPa"},
      {"Loading/Test = uniaxial strain"},
      {"Loading/Test = three point bending", "Specimen/Shape = box",
       "Specimen/Radius =", "Specimen/Ends = ground", "Specimen/Width x = 40 mm", "Specimen/Width y = 10 mm",
       "Platens/Span = 20 mm", "Platens/Strip width = 3 mm"}};
  for (std::vector<std::string> entries : tests)
    for (const char *motion : {"explicit", "quasi-static"}) {
      const std::string first = entries.front();
      entries.insert(entries.end(), {"Platens/Kind = deformable", std::string("Platens/Motion = ") + motion});
      EXPECT_EQ(message_of(good, entries), "") << first;
      entries.resize(entries.size() - 2);
    }
  EXPECT_EQ(message_of(good, {"Platens/Kind = deformable"}, program("brazilian")), "");
  EXPECT_NE(message_of(good, {"Platens/Kind = deformable"}, program("calibrate"))
                .find("is for platen-compress and platen-brazilian. Allowed: rigid."),
            std::string::npos);
}

TEST(SceneFaults, no_bond_is_unbreakable_by_oversight) {
  const auto good = (folder / "fragment" / "good.prm").string();
  for (const char *key : {"Bond/Tensile strength", "Bond/Shear strength"}) {
    const std::string missing = std::string(key) + " =", meant = missing + " unbreakable",
                      says = std::string(key) + " is not set";
    for (const char *app : {"compress", "brazilian", "bar", "bonds", "study"})
      for (const char *law : {"parallel bond", "elasto damage plastic", "yielding parallel bond"}) {
        const std::vector<std::string> scene{
            "Pair test/Displacement = 1 um", "Integration/Damping = 0", std::string("Effects/Bond = ") + law,
            "Bond/Compression limits = 10 MPa, 20 MPa, 30 MPa", "Bond/Compression slopes = 2, 3, 4"};
        std::vector<std::string> without = scene, elastic = scene;
        without.push_back(missing), elastic.push_back(meant);
        EXPECT_NE(message_of(good, without, program(app)).find(says), std::string::npos) << law;
        EXPECT_EQ(message_of(good, elastic, program(app)), "") << law;
      }
    EXPECT_EQ(message_of(good, {missing}, program("pack")), "");
    EXPECT_EQ(message_of(good, {missing, "Effects/Bond = none", "Contact/Stiffness = 1e6 N/m",
                                "Platens/Stiffness = 1e6 N/m"}),
              "");
    // What is solved at rest breaks nothing, what is searched begins with it.
    EXPECT_EQ(message_of(good, {missing, "Calibrate/Target 1 = young modulus: 20 GPa"}, program("calibrate")),
              "");
    EXPECT_NE(message_of(good, {missing, "Calibrate/Target 1 = strength_pa: 20 MPa"}, program("calibrate"))
                  .find(says + ": Effects/Bond is "),
              std::string::npos);
  }
}

TEST(SceneFaults, facets_need_their_fracture_energy) {
  const auto good = (folder / "fragment" / "good.prm").string();
  const std::vector<std::string> facet{"Effects/Bond = facet"};
  std::vector<std::string> whole = facet;
  whole.emplace_back("Bond/Fracture energy = 20 J/m2");
  EXPECT_NE(message_of(good, facet).find("Bond/Fracture energy is not set: Effects/Bond is facet."),
            std::string::npos)
      << message_of(good, facet);
  EXPECT_EQ(message_of(good, whole), "");
  whole.emplace_back("Pair test/Displacement = 1 um"), whole.emplace_back("Integration/Damping = 0");
  EXPECT_EQ(message_of(good, whole, program("bonds")), "");
}

TEST(SceneFaults, what_is_unbreakable_is_written_so_and_read_again) {
  const auto good = (folder / "fragment" / "good.prm").string();
  const Scene first = read_scene(good, {"Bond/Tensile strength = unbreakable"}, program("compress"));
  EXPECT_EQ(first.bond.number("tensile_strength"), 0); // never breaks
  EXPECT_EQ(first.bond.number("shear_strength"), 30e6);
  const auto written = std::filesystem::temp_directory_path() / "platen unbreakable.prm";
  std::ofstream(written) << scene_text(first, written.parent_path());
  const Scene second = read_scene(written.string(), {}, program("compress"));
  EXPECT_EQ(second.bond.number("tensile_strength"), 0);
  EXPECT_EQ(scene_text(second, written.parent_path()), scene_text(first, written.parent_path()));
  std::filesystem::remove(written);
}

TEST(SceneFaults, each_app_asks_for_what_it_needs) {
  const auto good = (folder / "fragment" / "good.prm").string();
  EXPECT_EQ(message_of(good), "");
  EXPECT_EQ(message_of(good, {"Loading/Axial rate ="}, program("pack")), "");
  EXPECT_EQ(message_of(good, {"Bond/Modulus ="}, program("pack")), "");
  EXPECT_NE(message_of(good, {"Bond/Modulus ="}, program("bar")).find("Bond/Modulus is not set"),
            std::string::npos);
  EXPECT_NE(message_of(good, {}, program("bonds")).find("Pair test/Force is not set"), std::string::npos);
  EXPECT_EQ(message_of(good, {"Pair test/Force = 3 kN"}, program("bonds")), "");
  EXPECT_EQ(
      message_of(good, {"Pair test/Force = 3 kN", "Bond/Modulus =", "Pair test/Modulus list = 1 GPa, 2 GPa"},
                 program("bonds")),
      "");
  for (const char *entry : {"Material/Density of = solid", "Bond/Strength scatter = weibull"})
    EXPECT_NE(message_of(good, {"Pair test/Force = 3 kN", entry}, program("bonds"))
                  .find(std::string(entry).substr(0, std::string(entry).find(" ="))),
              std::string::npos)
        << entry;
}

// Bytes are changed, dropped, doubled and swapped in good scenes: whatever comes out is read or refused by
// InputError.
TEST(SceneFaults, mangled_scenes_never_end_in_another_error) {
  const std::string seeds[] = {
      "subsection Bond\n set Modulus = 4 GPa # x\n set Gap = 0.05 R_min\nend\nsubsection Platens\n "
      "subsection Top\n"
      "  set Stress = 1 \\\n MPa\n end\nend\n#include nowhere.prm\n",
      "{\"Bond\": {\"Modulus\": \"4 GPa\", \"Damping\": 0.25}, \"Output\": {\"Every\": 100, \"Fields\": "
      "true}}"};
  std::mt19937 random(1);
  const auto pick = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  int read = 0;
  for (int round = 0; round < 2000; ++round) {
    std::string text = seeds[round % 2];
    for (std::size_t k = 0, changes = 1 + pick(4); k < changes && !text.empty(); ++k) {
      const std::size_t at = pick(text.size());
      switch (pick(4)) {
        case 0:
          text[at] = static_cast<char>(random());
          break;
        case 1:
          text.erase(at, 1 + pick(5));
          break;
        case 2:
          text.insert(at, text.substr(pick(text.size()), 1 + pick(20)));
          break;
        default:
          std::swap(text[at], text[pick(text.size())]);
      }
    }
    Scene scene;
    Parameters parameters;
    declare_scene(parameters, scene);
    parameters.apply(round % 2 == 0 ? prm_assignments(text, "mangled.prm")
                                    : json_assignments(text, "mangled.json"));
    read += parameters.faults().empty() ? 1 : 0;
    for (const EntryError &error : parameters.faults().all()) {
      const std::string message = error.what();
      EXPECT_EQ(message.compare(0, 7, "mangled"), 0) << message;
      EXPECT_LE(std::count(message.begin(), message.end(), '\n'), 5) << message;
    }
  }
  EXPECT_GT(read, 10); // some changes do no harm; otherwise nothing but the first line was tried
}

TEST(Suggestions, the_nearest_name_is_found_across_slips_of_the_pen) {
  EXPECT_EQ(edit_distance("Friction", "Frictoin"), 1); // two neighbours swapped
  EXPECT_EQ(edit_distance("friction", "Friction"), 0); // case does not count
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(nearest_word("hertzz", {"none", "linear", "hertz"}), "hertz");
  EXPECT_EQ(nearest_word("weather", {"none", "linear", "hertz"}), "");
  EXPECT_EQ(nearest_word(std::string(100000, 'a'), {"aaaa"}), "");
}

} // namespace
} // namespace platen::apps
