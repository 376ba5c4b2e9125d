// tests/apps/faulty.txt is a table of scenes with one fault in each, and of what the message must hold.
// Adding a bad scene is adding a line or a few; how one is written, the table says itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include "apps/read_scenes.h"
#include "apps/scene/declare.h"
#include "apps/scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

// A line of the table: an entry with its value, one that is left out, a line as it stands; what is said of
// it.
struct Part {
  char kind = '='; // or '-', '|', '>'
  std::string path, value, says;
  std::string entry() const { return path + " =" + value; }
};

Part part_of(const std::string &line) {
  if (line.rfind("> ", 0) == 0) return {'>', "", "", line.substr(2)};
  Part part;
  std::string text = line;
  if (const std::size_t says = line.find(" > "); says != std::string::npos)
    part.says = line.substr(says + 3), text = line.substr(0, says);
  for (const char kind : {'-', '|'})
    if (text.front() == kind) return {kind, text.substr(2), "", part.says};
  const std::size_t equals = text.find(" =");
  EXPECT_NE(equals, std::string::npos) << "no entry: " << line;
  part.path = text.substr(0, equals), part.value = text.substr(equals + 2);
  return part;
}

struct Faulty {
  std::string base, text;    // text of the table
  std::vector<Part> entries; // those that it has
  std::vector<Part> lines, told;

  void add(const Part &part) {
    if (!part.says.empty()) told.push_back(part);
    if (part.kind == '|') lines.push_back(part);
    if (part.kind != '-' && part.kind != '=') return;
    const auto section = [](const Part &of) { return of.path.substr(0, of.path.rfind('/') + 1); };
    const auto old = std::find_if(entries.begin(), entries.end(),
                                  [&](const Part &other) { return other.path == part.path; });
    EXPECT_TRUE(part.kind == '=' || old != entries.end() || !part.says.empty())
        << "leaves out what its base does not have: " << part.path;
    if (part.kind == '-') {
      if (old != entries.end()) entries.erase(old);
    } else if (old != entries.end()) {
      *old = part;
    } else {
      const auto last = std::find_if(entries.rbegin(), entries.rend(),
                                     [&](const Part &other) { return section(other) == section(part); });
      entries.insert(last == entries.rend() ? entries.end() : last.base(), part);
    }
  }
};

std::vector<Faulty> read_table(const std::string &path) {
  std::map<std::string, Faulty> bases;
  std::vector<Faulty> scenes;
  Faulty *open = nullptr; // what indented lines go on with
  std::string base;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first == std::string::npos || line[first] == '#') continue;
    if (line.front() == '[') {
      const std::size_t colon = std::min(line.find(": "), line.size() - 1);
      base = line.substr(1, colon - 1);
      if (const std::string from = line.substr(colon + 1); !from.empty()) {
        const std::string other = from.substr(1, from.size() - 2);
        EXPECT_EQ(bases.count(other), 1u) << base << " is made from what is not above it: " << other;
        EXPECT_EQ(bases.count(base), 0u) << base << " stands there twice";
        bases[base] = bases[other];
      }
      open = &bases[base];
      open->base = base;
      continue;
    }
    if (first == 0) {
      scenes.push_back(bases.at(base));
      open = &scenes.back();
    }
    open->text += line + "\n";
    open->add(part_of(line.substr(first)));
  }
  return scenes;
}

// Text of the scene, and on which line an entry or a line stands.
std::string scene_of(const Faulty &faulty, std::map<std::string, int> &line_of) {
  std::string text, open;
  int lines = 0;
  const auto put = [&](const std::string &line) { text += line + "\n", ++lines; };
  const auto enter = [&](const std::string &section) {
    if (section == open) return;
    std::string word;
    for (std::istringstream words(open); std::getline(words, word, '/');)
      put("end");
    for (std::istringstream words(section); std::getline(words, word, '/');)
      put("subsection " + word);
    open = section;
  };
  for (const Part &entry : faulty.entries) {
    const std::size_t slash = entry.path.rfind('/');
    enter(slash == std::string::npos ? "" : entry.path.substr(0, slash));
    put("  set " + entry.path.substr(slash + 1) + " =" + entry.value); // npos + 1 is 0
    line_of[entry.path] = lines;
  }
  enter("");
  for (const Part &line : faulty.lines) {
    put(line.path);
    line_of["|" + line.path] = lines;
  }
  return text;
}

// What the message must hold for one line of the table.
std::string wanted(const Part &part, const std::string &file, const std::map<std::string, int> &line_of) {
  const auto place = [&](const std::string &of) {
    return file + ":" + std::to_string(line_of.at(of)) + ": error: ";
  };
  switch (part.kind) {
    case '|':
      return place("|" + part.path) + part.says;
    case '-':
      return file + ": error: " + part.path + " " + part.says;
    case '=': {
      const bool unknown = part.says.rfind("is not a parameter", 0) == 0;
      return place(part.path) + (unknown ? part.path : part.entry()) + " " + part.says;
    }
    default:
      return part.says.front() == ':' ? file + part.says : part.says;
  }
}

class SceneFaults : public ScratchFolder {};

TEST_F(SceneFaults, each_bad_scene_is_refused_with_place_key_value_and_what_is_allowed) {
  const std::vector<std::string> programs_by_base{"calibrate", "study", "bonds", "brazilian"};
  fs::copy(fs::path(PLATEN_TEST_DATA) / "fragment", folder_ / "fragment");
  const std::vector<Faulty> scenes = read_table(std::string(PLATEN_TEST_DATA) + ".txt");
  for (const Faulty &faulty : scenes) {
    SCOPED_TRACE(faulty.base + "\n" + faulty.text);
    const std::string file = faulty.base.rfind("json", 0) == 0 ? "faulty.json" : "faulty.prm";
    std::map<std::string, int> line_of;
    put(folder_ / file, scene_of(faulty, line_of));
    const bool of_program = std::count(programs_by_base.begin(), programs_by_base.end(), faulty.base) > 0;
    const std::string message = said_of(folder_ / file, {}, of_program ? faulty.base : "compress");
    EXPECT_FALSE(faulty.told.empty()) << "it does not say what is wrong";
    EXPECT_FALSE(message.empty()) << "it was read";
    for (const Part &part : faulty.told)
      EXPECT_TRUE(contains(message, wanted(part, file, line_of)));
    EXPECT_LE(std::count(message.begin(), message.end(), '\n'), 5) << message; // six lines
  }
  EXPECT_GE(scenes.size(), 300u);
}

TEST_F(SceneFaults, files_that_are_no_scenes_are_refused) {
  fs::create_directories(folder_ / "folder.prm");
  put(folder_ / "zero.prm", std::string("subsection Bond\0end", 19));
  put(folder_ / "scene.txt", "");
  put(folder_ / "large.prm", std::string(5000000, '\n'));
  for (const auto &[name, says] : {std::pair{"nowhere.prm", "cannot be read: No such file or directory."},
                                   {"folder.prm", "it is a folder."},
                                   {"zero.prm", "no text file."},
                                   {"scene.txt", "names that end in .prm or .json."},
                                   {"large.prm", "so it is no scene."}})
    EXPECT_TRUE(contains(said_of(folder_ / name), says));
}

// Each file includes two others, or itself, or the next one twice: 2^15 files are no scene.
TEST_F(SceneFaults, so_many_includes_are_refused_at_once) {
  for (int depth = 0; depth < 15; ++depth) {
    const std::string next = "include " + std::to_string(depth + 1) + ".prm\n";
    put(folder_ / (std::to_string(depth) + ".prm"), next + next);
  }
  put(folder_ / "15.prm", "\n");
  const std::string message = said_of(folder_ / "0.prm");
  EXPECT_TRUE(contains(message,
                       "more than 500 files are included, those that are included again counted again. "
                       "Allowed: up to that."));
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message; // told once
  // As many as that are taken.
  std::string all;
  for (int k = 0; k < 500; ++k)
    all += "include 15.prm\n";
  put(folder_ / "all.prm", all);
  EXPECT_FALSE(contains(said_of(folder_ / "all.prm", {}, "pack"), "files are included"));
  put(folder_ / "all.prm", all + "include 15.prm\n");
  EXPECT_TRUE(contains(said_of(folder_ / "all.prm", {}, "pack"), ":501: error: include 15.prm: more than"));
}

TEST_F(SceneFaults, bad_overrides_are_refused_by_their_number) {
  for (const auto &[overrides, says] : std::vector<std::pair<Entries, const char *>>{
           {{"Contact/Friction = 0.2", "Contact/Frictoin = 0.3"},
            "command line, --set 2: error: Contact/Frictoin is not a parameter. Did you mean "
            "\"Contact/Friction\""},
           {{"Platens/Friction = 0.3"},
            "Platens/Friction is not a parameter. Did you mean \"Platens/Friction static\", "
            "\"Platens/Friction "
            "dynamic\" "
            "or \"Platens/Friction law\"?"},
           {{"Loading/Rate = 0.3"}, "Did you mean \"Loading/Axial rate\"?"},
           {{"Bond/strength = 3 MPa"}, "Did you mean \"Bond/Tensile strength\", \"Bond/Shear strength\""},
           {{"Specimen/Radus = 3 mm"}, "Did you mean \"Specimen/Radius\""},
           {{"Loading/Stage 21/Axial = hold"},
            "Loading/Stage 21 is not a section. The last one is Loading/Stage 20."},
           {{"Loading/Stage 0/Axial = hold"}, "The last one is Loading/Stage 20."},
           {{"Specimen/Radius = 25 m"},
            "--set 1: error: Specimen/Radius = 25 m gives a width that is 5e+03 times Specimen/Height = 10 "
            "mm. "
            "Allowed: "
            "0.005 ... 200."},
           {{"Bond/Modulus = 48 Gpa"}, "has the unit \"Gpa\", which is not known. Did you mean \"GPa\"?"},
           {{"Contact/Friction = 9"},
            "command line, --set 1: error: Contact/Friction = 9 is out of range. Allowed: 0 ... 5"},
           {{"Contact/Friction"}, "command line, --set 1: error: \"Contact/Friction\" sets nothing."},
           {{"Contcat/Friction = 0.3"}, "Contcat is not a section. Did you mean \"Contact\"?"},
           {{"Friction = 0.3"}, "Friction is not a parameter. Did you mean \"Contact/Friction\""},
           {{"Bond/Modulus = 40 m"},
            "Bond/Modulus = 40 m has the unit \"m\", which is not that of a pressure"},
           {{"Platens/Kind = deformable", "Integration/Scheme = tchamwa wielgosz"},
            "--set 1: error: Platens/Kind = deformable needs Integration/Scheme = velocity verlet. Allowed: "
            "rigid."},
           {{"Platens/Kind = deformable", "Platens/Pad thickness = 0.1 mm"},
            "Platens/Pad modulus is not set: the pad has to have one."},
           {{"Platens/Kind = deformable", "Platens/Pad thickness = 1 m"},
            "--set 2: error: Platens/Pad thickness = 1 m leaves nothing of the platen. Allowed: 0 ... "},
           {{"Platens/Top/Mesh file = none.msh"}, "--set 1: error: Platens/Top/Mesh file = none.msh"},
           {{"Platens/Top/Seat = spherical", "Integration/Scheme = tchamwa wielgosz"},
            "--set 1: error: Platens/Top/Seat = spherical needs Integration/Scheme = velocity verlet. "
            "Allowed: "
            "fixed."},
           {{"Platens/Degree = 3"},
            "--set 1: error: Platens/Degree = 3 is out of range. Allowed: whole, 1 ... 2"},
           {{"Loading/Test = tension"},
            "--set 1: error: Loading/Test = tension needs Platens/Attachment = glued"},
           {{"Scene/Title = a # b"}, "--set 1: error: Scene/Title = a # b holds a \"#\""},
           {{"= 3"}, "--set 1: error: "},
           {{""}, "--set 1: error: \"\" sets nothing."}})
    EXPECT_TRUE(contains(said_with(overrides), says));
}

// Once refused with elastic platens, now run.
TEST_F(SceneFaults, elastic_platens_go_with_every_test) {
  const std::vector<Entries> tests{
      {"Platens/Attachment = glued", "Loading/Test = tension"},
      {"Platens/Top/Control = stress", "Platens/Top/Stress = 1 MPa", "Loading/Ramp = 1 ms"},
      {"Loading/Test = hydrostatic", "Loading/Confinement = particles", "Loading/Confining pressure = 1 MPa"},
      {"Loading/Test = uniaxial strain"},
      {"Loading/Test = three point bending", "Specimen/Shape = box",
       "Specimen/Radius =", "Specimen/Ends = ground", "Specimen/Width x = 40 mm", "Specimen/Width y = 10 mm",
       "Platens/Span = 20 mm", "Platens/Strip width = 3 mm"}};
  for (Entries entries : tests)
    for (const char *motion : {"explicit", "quasi-static"}) {
      entries.insert(entries.end(), {"Platens/Kind = deformable", std::string("Platens/Motion = ") + motion});
      EXPECT_EQ(said_with(entries), "");
      entries.resize(entries.size() - 2);
    }
  EXPECT_EQ(said_with({"Platens/Kind = deformable"}, "brazilian"), "");
}

TEST_F(SceneFaults, no_bond_is_unbreakable_by_oversight) {
  for (const char *key : {"Bond/Tensile strength", "Bond/Shear strength"}) {
    const std::string missing = std::string(key) + " =", meant = missing + " unbreakable",
                      says = std::string(key) + " is not set";
    for (const char *app : {"compress", "brazilian", "bar", "bonds", "study"})
      for (const char *law : {"parallel bond", "elasto damage plastic", "yielding parallel bond"}) {
        const Entries scene{
            "Pair test/Displacement = 1 um", "Integration/Damping = 0", std::string("Effects/Bond = ") + law,
            "Bond/Compression limits = 10 MPa, 20 MPa, 30 MPa", "Bond/Compression slopes = 2, 3, 4"};
        Entries without = scene, elastic = scene;
        without.push_back(missing), elastic.push_back(meant);
        EXPECT_TRUE(contains(said_with(without, app), says)) << law;
        EXPECT_EQ(said_with(elastic, app), "") << law;
      }
    EXPECT_EQ(said_with({missing}, "pack"), "");
    EXPECT_EQ(said_with({missing, "Effects/Bond = none", "Contact/Stiffness = 1e6 N/m",
                         "Platens/Stiffness = 1e6 N/m"}),
              "");
    // What is solved at rest breaks nothing, what is searched begins with it.
    EXPECT_EQ(said_with({missing, "Calibrate/Target 1 = young modulus: 20 GPa"}, "calibrate"), "");
    EXPECT_TRUE(contains(said_with({missing, "Calibrate/Target 1 = strength_pa: 20 MPa"}, "calibrate"),
                         says + ": Effects/Bond is "));
  }
}

TEST_F(SceneFaults, facets_need_their_fracture_energy) {
  const Entries facet{"Effects/Bond = facet"};
  EXPECT_TRUE(contains(said_with(facet), "Bond/Fracture energy is not set: Effects/Bond is facet."));
  Entries whole = facet;
  whole.emplace_back("Bond/Fracture energy = 20 J/m2");
  EXPECT_EQ(said_with(whole), "");
  whole.insert(whole.end(), {"Pair test/Displacement = 1 um", "Integration/Damping = 0"});
  EXPECT_EQ(said_with(whole, "bonds"), "");
}

TEST_F(SceneFaults, what_is_unbreakable_is_written_so_and_read_again) {
  const Scene first = scene_with({"Bond/Tensile strength = unbreakable"});
  EXPECT_EQ(first.bond.number("tensile_strength"), 0); // never breaks
  EXPECT_EQ(first.bond.number("shear_strength"), 30e6);
  put(folder_ / "written.prm", scene_text(first, folder_));
  const Scene second = read_scene(folder_ / "written.prm", {}, program("compress"));
  EXPECT_EQ(second.bond.number("tensile_strength"), 0);
  EXPECT_EQ(scene_text(second, folder_), scene_text(first, folder_));
}

TEST_F(SceneFaults, each_app_asks_for_what_it_needs) {
  EXPECT_EQ(said_with({}), "");
  EXPECT_EQ(said_with({"Effects/Bond = facet", "Bond/Fracture energy = 20 J/m2"}), "");
  EXPECT_EQ(said_with({"Loading/Axial rate ="}, "pack"), "");
  EXPECT_EQ(said_with({"Bond/Modulus ="}, "pack"), "");
  EXPECT_TRUE(contains(said_with({"Bond/Modulus ="}, "bar"), "Bond/Modulus is not set"));
  EXPECT_TRUE(contains(said_with({}, "bonds"), "Pair test/Force is not set"));
  EXPECT_EQ(said_with({"Pair test/Force = 3 kN"}, "bonds"), "");
  EXPECT_EQ(said_with({"Pair test/Force = 3 kN", "Bond/Modulus =", "Pair test/Modulus list = 1 GPa, 2 GPa"},
                      "bonds"),
            "");
  for (const std::string entry : {"Material/Density of = solid", "Bond/Strength scatter = weibull"})
    EXPECT_TRUE(
        contains(said_with({"Pair test/Force = 3 kN", entry}, "bonds"), entry.substr(0, entry.find(" ="))))
        << entry;
}

// Bytes are changed, dropped, doubled and swapped in good scenes: whatever comes out is read or refused by
// InputError.
TEST_F(SceneFaults, mangled_scenes_never_end_in_another_error) {
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
