// Good scenes: the same numbers from every notation, and from what was written.
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "apps/read_scenes.h"
#include "apps/scene/command_line.h"
#include "apps/scene/declare.h"
#include "apps/scene/expect.h"
#include "apps/scene/scene_writer.h"
#include "apps/scratch_folder.h"
#include "dem/measure/failure_pattern.h"

namespace platen::apps {
namespace {

using namespace testing;

const std::string concrete = R"(# A concrete cylinder.
subsection Scene
  set Title = Cylinder, 50 mm
end
subsection Specimen
  set Radius        = 25 mm
  set Height        = 100 mm   # as in the laboratory
  set Sphere radius = 1.41 mm
  set Radius spread = 25 %
  set Ends          = ground
end
subsection Bond
  set Modulus          = 40 GPa
  set Tensile strength = 8.9 MPa
  set Shear strength   = 33 MPa
  set Friction angle   = 45 degree
end
subsection Platens
  set Friction static = 0.1
  subsection Top
    set Friction static = 0.3
  end
end
subsection Loading
  set Axial rate = 0.1 mm/ms
end
subsection Output
  set Every = 0.1 ms
end
subsection Expect
  set strength_pa = 35 MPa ... 50 MPa
  subsection cone_top
    set half_angle_deg = 16 ...
  end
end
)";

const std::string concrete_json = R"({
  "Scene": {"Title": "Cylinder, 50 mm"},
  "Specimen": {"Radius": 25e-3, "Height": "100 mm", "Sphere radius": 1.41E-3, "Radius spread": 0.25,
               "Ends": {"value": "ground", "documentation": "sawn"}},
  "Bond": {"Modulus": "40 GPa", "Tensile strength": 8900000, "Shear strength": 33e6, "Friction angle": "45 degree"},
  "Platens": {"Friction static": 0.1, "Top": {"Friction static": 0.3}},
  "Loading": {"Axial rate": 0.1},
  "Output": {"Every": "0.1 ms"},
  "Expect": {"strength_pa": "35 MPa ... 50 MPa", "cone_top": {"half_angle_deg": "16 ..."}}
})";

class SceneFiles : public ScratchFolder {
protected:
  SceneFiles() { folder_ /= "a b"; }

  std::string put(const std::string &name, const std::string &text) const {
    testing::put(folder_ / name, text);
    return (folder_ / name).string();
  }
  Scene read(const std::string &name, const std::string &text, const Entries &overrides = {}) const {
    return read_scene(put(name, text), overrides, program("compress"));
  }
};

// All bound members as the shortest texts that give the same bits, and what has no single number.
Entries values_of(const Scene &scene) {
  Scene copy = scene;
  Parameters parameters;
  declare_scene(parameters, copy); // defaults are what the members hold
  Entries values;
  for (const Entry &entry : parameters.entries())
    if (!entry.is_file) values.push_back(entry.path + " = " + entry.default_text);
  for (const Expectation &e : scene.expect)
    values.push_back(e.key + " " + shortest_text(e.low) + " " + shortest_text(e.high));
  return values;
}

TEST_F(SceneFiles, numbers_come_out_in_si) {
  const Scene scene = read("concrete.prm", concrete);
  EXPECT_EQ(scene.name, "concrete");
  EXPECT_EQ(scene.general.title, "Cylinder, 50 mm");
  EXPECT_DOUBLE_EQ(scene.specimen.radius, 0.025);
  EXPECT_DOUBLE_EQ(scene.specimen.radius_spread, 0.25);
  EXPECT_EQ(scene.specimen.ends, dem::EndPreparation::ground);
  EXPECT_DOUBLE_EQ(scene.bond.number("tensile_strength"), 8.9e6);
  EXPECT_DOUBLE_EQ(scene.bond.number("friction_angle"), 0.78539816339744831);
  EXPECT_DOUBLE_EQ(scene.loading.rate, 0.1);
  EXPECT_EQ(scene.output.every.kind, Interval::Kind::time);
  EXPECT_DOUBLE_EQ(scene.output.every.value, 1e-4);
  ASSERT_EQ(scene.expect.size(), 2u);
  EXPECT_EQ(scene.expect[0].key, "strength_pa");
  EXPECT_EQ(scene.expect[0].origin, (folder_ / "concrete.prm").string() + ":31");
  EXPECT_EQ(scene.expect[1].key, "cone_top/half_angle_deg");
}

TEST_F(SceneFiles, a_platen_takes_what_it_is_not_given_from_the_common_value) {
  const Scene scene = read("concrete.prm", concrete);
  EXPECT_EQ(scene.platens.top.friction_static, 0.3);
  EXPECT_EQ(scene.platens.top.friction_dynamic, 0.3);
  EXPECT_EQ(scene.platens.bottom.friction_static, 0.1);
  EXPECT_EQ(scene.platens.bottom.friction_dynamic, 0.1);
  const Scene sliding = read("sliding.prm", concrete, {"Platens/Friction dynamic = 0.05"});
  EXPECT_EQ(sliding.platens.top.friction_dynamic, 0.05);
  EXPECT_EQ(sliding.platens.bottom.friction_dynamic, 0.05);
  EXPECT_DOUBLE_EQ(scene.platens.thickness, 0.01); // a tenth of the height
}

TEST_F(SceneFiles, json_gives_the_same_numbers_as_prm) {
  EXPECT_EQ(values_of(read("a.json", concrete_json)), values_of(read("b.prm", concrete)));
}

TEST_F(SceneFiles, byte_order_mark_and_foreign_line_ends_change_nothing) {
  std::string crlf;
  for (const char c : concrete)
    crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const auto plain = values_of(read("plain.prm", concrete));
  EXPECT_EQ(values_of(read("crlf.prm", crlf)), plain);
  EXPECT_EQ(values_of(read("mark.prm", "\xef\xbb\xbf" + crlf)), plain);
  EXPECT_EQ(values_of(read("mark.json", "\xef\xbb\xbf" + concrete_json)), plain);
}

TEST_F(SceneFiles, a_written_scene_gives_the_same_bits) {
  const Scene scene =
      read("concrete.prm", concrete,
           {"Contact/Stiffness = 0.01 bulk", "Bond/Gap = 0.123456789 mm", "Checkpoint/Every = 7 min",
            "Pair test/Modulus list = 1 GPa, 0.3 GPa", "Integration/Damping = 0.1"});
  const std::string text = scene_text(scene, folder_ / "results");
  const Scene again = read("results/scene.prm", text);
  EXPECT_EQ(values_of(again), values_of(scene));
  EXPECT_EQ(scene_text(again, folder_ / "results"), text);
}

TEST_F(SceneFiles, a_written_scene_finds_its_files_from_where_it_lies) {
  put("cases/packings/spheres  a.csv", "x_m,y_m,z_m,radius_m\n0,0,0.05,0.0015\n");
  const Scene scene = read(
      "cases/a.prm", concrete,
      {"Specimen/Packing = file", "Specimen/File = " + (folder_ / "cases/packings/spheres  a.csv").string()});
  const std::string text = scene_text(scene, folder_ / "results/deep/a");
  EXPECT_FALSE(contains(text, folder_.string())) << "the folders could no longer be moved together";
  const Scene again = read("results/deep/a/scene.prm", text);
  EXPECT_TRUE(fs::equivalent(again.specimen.file, scene.specimen.file)) << again.specimen.file;
}

// A program without a key wrote the scene: it is the same scene with the key at its default.
TEST_F(SceneFiles, a_written_scene_is_completed_with_the_defaults_of_what_it_lacks) {
  const std::string folder = (folder_ / "results").string(), file = folder + "/scene.prm";
  const Scene scene = read("concrete.prm", concrete);
  const std::string whole = scene_text(scene, folder);
  const auto completed = [&](std::string text, const std::string &key, const std::string &line) {
    const std::size_t at = text.find("  set " + key);
    EXPECT_NE(at, std::string::npos) << key;
    text.replace(at, text.find('\n', at) + 1 - at, line);
    put("results/scene.prm", text);
    return completed_scene_text(file, folder, program("compress"));
  };
  EXPECT_EQ(completed(whole, "Safety", ""), whole);
  EXPECT_NE(completed(whole, "Safety", "  set Safety = 0.7\n"), whole);
  EXPECT_NE(completed(whole, "Sphere radius", ""), whole) << "a given value, not the default";
  EXPECT_EQ(completed("  set Safety = broken\n", "Safety", "what is no scene\n"), "what is no scene\n");
  EXPECT_EQ(completed_scene_text(folder + "/none.prm", folder, program("compress")), "");
}

TEST_F(SceneFiles, a_file_is_looked_for_beside_the_scene_that_names_it) {
  put("packings/spheres.csv", "x_m,y_m,z_m,radius_m\n0,0,0.05,0.0015\n");
  std::string with_file = concrete;
  const std::string key = "  set Ends          = ground\n";
  with_file.replace(with_file.find(key), key.size(),
                    key + "  set Packing = file\n  set File = packings/spheres.csv\n");
  const Scene scene = read("a.prm", with_file);
  EXPECT_TRUE(fs::equivalent(scene.specimen.file, folder_ / "packings/spheres.csv"));
}

TEST_F(SceneFiles, a_scene_overrides_what_it_includes) {
  put("common/base.prm", concrete);
  const Scene scene =
      read("a.prm", "include common/base.prm\nsubsection Bond\n  set Modulus = 50 GPa\nend\n");
  EXPECT_DOUBLE_EQ(scene.model.bond_layout.modulus, 50e9);
  EXPECT_DOUBLE_EQ(scene.bond.number("tensile_strength"), 8.9e6);
}

// The parts of scenes that came with the programs; what lies beside the scene goes first.
TEST_F(SceneFiles, what_is_not_beside_a_scene_is_included_from_the_scenes_of_platen) {
  const std::string text = "include parts/concrete.prm\nsubsection Bond\n  set Gap = 0.04 R_min\nend\n";
  const Scene shipped = read("a.prm", text);
  EXPECT_DOUBLE_EQ(shipped.model.bond_layout.modulus, 48e9);
  EXPECT_DOUBLE_EQ(shipped.model.bond_layout.gap.value, 0.04);
  put("parts/concrete.prm", concrete);
  EXPECT_DOUBLE_EQ(read("a.prm", text).model.bond_layout.modulus, 40e9);
  try {
    read("b.prm", "include parts/no_such.prm\n");
    ADD_FAILURE() << "a part that is nowhere is refused";
  } catch (const InputError &error) {
    EXPECT_TRUE(contains(error.what(), (folder_ / "parts/no_such.prm").string())) << error.what();
  }
}

TEST_F(SceneFiles, the_last_override_holds) {
  const Scene scene = read("a.prm", concrete, {"Contact/Friction = 0.2", " Contact / Friction=0.3 "});
  EXPECT_EQ(scene.contact.friction, 0.3);
}

TEST_F(SceneFiles, printed_parameters_can_be_read_as_a_scene) {
  const Scene scene = read("a.prm", concrete, {"Bond/Modulus = 12.345678901234567 GPa"});
  for (const bool json : {false, true}) {
    std::ostringstream text;
    print_parameters(scene, "", json, text);
    EXPECT_TRUE(contains(text.str(), "12.345678901234567 GPa"));
    const Scene again = read(json ? "b.json" : "b.prm", text.str());
    EXPECT_EQ(values_of(again), values_of(scene));
    std::ostringstream second;
    print_parameters(again, "", json, second);
    EXPECT_EQ(second.str(), text.str());
  }
}

TEST_F(SceneFiles, every_entry_tells_its_meaning) {
  for (const apps::Program &of : programs()) {
    const Scene scene = default_scene(of);
    std::ostringstream text;
    const auto &entries = scene.parameters->entries();
    write_prm({entries.begin(), entries.end()}, true, text);
    std::set<std::string> paths;
    for (const Entry &entry : scene.parameters->entries()) {
      EXPECT_GT(entry.documentation.size(), 10u) << entry.path;
      EXPECT_EQ(entry.documentation.back(), '.') << entry.path;
      EXPECT_TRUE(paths.insert(entry.path).second) << entry.path;
      EXPECT_TRUE(contains(text.str(), "set " + entry.path.substr(entry.path.rfind('/') + 1))) << entry.path;
    }
  }
}

TEST_F(SceneFiles, entries_without_effect_are_told) {
  const Scene scene = read("a.prm", concrete, {"Contact/Restitution = 0.5"});
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_EQ(
      scene.notes[0],
      "command line, --set 1: note: Contact/Restitution = 0.5 has no effect: Effects/Contact is not hertz.");
  EXPECT_TRUE(read("b.prm", concrete).notes.empty());
  EXPECT_EQ(read("c.prm", concrete, {"Integration/Dissipation = 1.2"}).notes.size(), 1u);
  EXPECT_TRUE(
      read("d.prm", concrete, {"Integration/Scheme = tchamwa wielgosz", "Integration/Dissipation = 1.2"})
          .notes.empty());
}

Entries reasons_of_missed(const nlohmann::ordered_json &expectations) {
  Entries reasons;
  for (const auto &one : expectations)
    if (one["met"] == false) reasons.push_back(one["reason"].get<std::string>());
  return reasons;
}

TEST_F(SceneFiles, expected_numbers_hold_at_their_bounds_and_not_beyond) {
  const Scene scene = read("a.prm", concrete);
  const auto failures = [&](double strength, double angle) {
    return reasons_of_missed(
        check_expectations(scene, {{"strength_pa", strength}, {"cone_top", {{"half_angle_deg", angle}}}}));
  };
  EXPECT_TRUE(failures(35e6, 16).empty());
  EXPECT_TRUE(failures(50e6, 89).empty());
  ASSERT_EQ(failures(51e6, 20).size(), 1u);
  EXPECT_EQ(failures(51e6, 20)[0],
            (folder_ / "a.prm").string() + ":31: strength_pa = 51 MPa is not in 35 MPa ... 50 MPa");
  // Four digits, or as many as it takes to see on which side it is.
  EXPECT_TRUE(contains(failures(34123456.78, 20)[0], "strength_pa = 34.12 MPa is not in"));
  EXPECT_TRUE(contains(failures(50000001, 20)[0], "strength_pa = 50.000001 MPa is not in"));
  EXPECT_TRUE(contains(failures(40e6, 15.99999)[0], "half_angle_deg = 15.99999 is not in 16 ..."));
  const Scene other = read("b.prm", concrete, {"Expect/strength_pa = 35e6 ... 0.05 GPa"});
  EXPECT_TRUE(contains(reasons_of_missed(check_expectations(other, {{"strength_pa", 51.23456e6}})).at(0),
                       "strength_pa = 0.05123 GPa is not in 35e6 ... 0.05 GPa"));
  ASSERT_EQ(failures(40e6, not_given).size(), 1u); // expected and not measured
  EXPECT_TRUE(contains(failures(40e6, not_given)[0], "cone_top/half_angle_deg was not measured"));
}

TEST_F(SceneFiles, what_is_expected_is_listed_with_range_value_and_whether_it_is_met) {
  const Scene scene = read("a.prm", concrete, {"Expect/particles = 1 ...", "Expect/pattern = cones"});
  const nlohmann::ordered_json summary{
      {"strength_pa", 51e6}, {"cone_top", {{"half_angle_deg", 16}}}, {"particles", nullptr}};
  const auto list = check_expectations(scene, summary);
  ASSERT_EQ(list.size(), 4u);
  const auto of = [&](const char *entry) {
    for (const auto &one : list)
      if (one["entry"] == entry) return one;
    return nlohmann::ordered_json();
  };
  EXPECT_EQ(of("Expect/strength_pa")["range"], "35 MPa ... 50 MPa");
  EXPECT_EQ(of("Expect/strength_pa")["value"], 51e6);
  EXPECT_EQ(of("Expect/strength_pa")["met"], false);
  EXPECT_TRUE(contains(of("Expect/strength_pa")["reason"].get<std::string>(), "a.prm:31: strength_pa"));
  EXPECT_EQ(of("Expect/cone_top/half_angle_deg")["met"], true);
  EXPECT_EQ(of("Expect/cone_top/half_angle_deg")["reason"], nullptr);
  EXPECT_EQ(of("Expect/particles")["met"], false); // measured by this app, and null
  EXPECT_EQ(of("Expect/particles")["value"], nullptr);
  EXPECT_EQ(of("Expect/pattern")["met"], nullptr); // of another app
  EXPECT_EQ(of("Expect/pattern")["reason"], "measured by another app");
  for (const auto &one : unchecked_expectations(scene, "it was stopped")) {
    EXPECT_EQ(one["met"], nullptr);
    EXPECT_EQ(one["value"], nullptr);
    EXPECT_EQ(one["reason"], "it was stopped");
  }
  EXPECT_EQ(unchecked_expectations(scene, "it was stopped").size(), 4u);
}

// What an option sets to the text of the file is as the file has it; a later option does not hide the file's.
TEST_F(SceneFiles, what_an_option_changes_is_known_with_what_the_file_has) {
  const Scene scene = read("a.prm", concrete,
                           {"Expect/strength_pa = 1 MPa ... 2 MPa", "Scene/Seed = 8", "Scene/Seed = 9",
                            "Expect/cone_top/half_angle_deg = 16 ..."});
  const auto &entry = scene.parameters->at("Expect/strength_pa");
  EXPECT_TRUE(entry.overridden());
  EXPECT_EQ(entry.of_file, "35 MPa ... 50 MPa");
  EXPECT_TRUE(scene.parameters->at("Scene/Seed").overridden());
  EXPECT_NE(scene.parameters->at("Scene/Seed").of_file, "8");
  EXPECT_FALSE(scene.parameters->at("Expect/cone_top/half_angle_deg").overridden());
  for (const Entry &one : read("b.prm", concrete).parameters->entries())
    EXPECT_FALSE(one.overridden()) << one.path;
}

TEST_F(SceneFiles, an_expected_word_is_one_of_those_given) {
  const Scene scene = read(
      "a.prm", concrete,
      {"Expect/strength_pa =", "Expect/cone_top/half_angle_deg =", "Expect/pattern = cones, shear plane"});
  const auto failed = [&](const nlohmann::ordered_json &summary) {
    return reasons_of_missed(check_expectations(scene, summary));
  };
  EXPECT_TRUE(failed({{"pattern", "cones"}}).empty());
  EXPECT_TRUE(failed({{"pattern", "shear plane"}}).empty());
  ASSERT_EQ(failed({{"pattern", "crushing"}}).size(), 1u);
  EXPECT_TRUE(
      contains(failed({{"pattern", "crushing"}})[0], "pattern = crushing is not one of cones, shear plane"));
  ASSERT_EQ(failed({{"pattern", nullptr}}).size(), 1u);
  EXPECT_TRUE(contains(failed({{"pattern", nullptr}})[0], "pattern was not measured"));
  const auto unchecked = check_expectations(scene, {{"steps", 1}});
  ASSERT_EQ(unchecked.size(), 1u);
  EXPECT_EQ(unchecked[0]["entry"], "Expect/pattern");
  EXPECT_EQ(unchecked[0]["met"], nullptr);
  EXPECT_THROW(read("b.prm", concrete, {"Expect/pattern = cone"}), InputError);
  for (const char *word : dem::pattern_words)
    EXPECT_NO_THROW(read("b.prm", concrete, {std::string("Expect/pattern = ") + word})) << word;
}

TEST_F(SceneFiles, continued_lines_are_joined) {
  const Scene scene =
      read("a.prm", concrete + "subsection Material\n  set Density = 2500 \\\n     kg/m3 # joined\nend\n");
  EXPECT_DOUBLE_EQ(scene.model.density, 2500);
}

} // namespace
} // namespace platen::apps
