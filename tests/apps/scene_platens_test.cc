// What a scene says of platens, sleeve and loading arrives in the settings of the library, side by side.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "apps/read_scenes.h"
#include "apps/run/problem_setup.h"
#include "apps/scene/layers.h"
#include "apps/scene/tubes.h"
#include "coupling/platens_of_test.h"

namespace platen::apps {
namespace {

// Every number and flag by its name; words, stiffnesses and gaps as they compare.
struct Values {
  std::map<std::string, double> of;
  template <class Member, class... About>
  void operator()(const char *name, const Member &value, const About &...) {
    if constexpr (std::is_arithmetic_v<Member> || std::is_enum_v<Member>)
      of[name] = static_cast<double>(value);
  }
};

template <class Described>
void expect_same(const Described &scene, const Described &library, const Entries &but = {}) {
  Values a, b;
  Described::describe(a, scene);
  Described::describe(b, library);
  EXPECT_GT(a.of.size(), 1u);
  for (const auto &[name, value] : a.of) {
    const bool differs = std::find(but.begin(), but.end(), name) != but.end();
    const bool same = value == b.of.at(name) || (std::isnan(value) && std::isnan(b.of.at(name)));
    EXPECT_EQ(same, !differs) << Described::name << "." << name << ": scene " << value << ", library "
                              << b.of.at(name);
  }
}

TEST(ScenePlatens, a_default_of_platens_sleeve_and_loading_is_stated_once) {
  const coupling::PlatenTestSettings library;
  const coupling::PlatenTestSettings plain = problem_settings(scene_with({}));
  // The file states an axial rate; a scene ends by itself, a program of one's own where it likes.
  expect_same<coupling::LoadingSettings>(plain.loading, library.loading, {"rate", "target_strain"});
  // A tenth of the specimen.
  expect_same<coupling::PlatenSettings>(plain.platens, library.platens, {"thickness"});
  expect_same(plain.time_step, library.time_step);
  const coupling::PlatenTestSettings held = problem_settings(scene_with(
      {"Platens/Kind = deformable", "Loading/Confinement = sleeve", "Loading/Confining pressure = 2 MPa",
       "Specimen/Shape = cylinder", "Specimen/Radius = 50 mm"}));
  expect_same(*held.platens.elastic, coupling::ElasticPlatens());
  expect_same(*held.loading.cell, coupling::CellSettings(), {"pressure"});
  expect_same(*held.loading.cell->sleeve, coupling::SleeveSettings());
  EXPECT_FALSE(plain.platens.elastic || plain.loading.cell || plain.loading.wall);
}

TEST(ScenePlatens, a_tube_arrives_with_its_steel) {
  const Entries tube{"Specimen/Shape = cylinder",  "Specimen/Radius = 50 mm", "Loading/Confinement = sleeve",
                     "Sleeve/Kind = tube",         "Sleeve/Steel = S275",     "Sleeve/Thickness = 2 mm",
                     "Sleeve/Clearance = 1 mm",    "Sleeve/Gap = 0.1 mm",     "Sleeve/Friction = 0.2",
                     "Sleeve/Elements through = 3"};
  const Entries adheres{"Sleeve/Gap = 0 mm", "Sleeve/Bond strength = 0.5 MPa", "Sleeve/Bond slip = 0.1 mm"};
  const auto settings = [&](const Entries &more) {
    Entries all = tube;
    all.insert(all.end(), more.begin(), more.end());
    return problem_settings(scene_with(all)).loading;
  };
  const coupling::LoadingSettings told = settings({});
  ASSERT_TRUE(told.tube && told.tube->metal);
  EXPECT_FALSE(told.cell);
  const coupling::SleeveSettings &wall = *told.tube;
  EXPECT_EQ(wall.thickness, 2e-3);
  EXPECT_EQ(wall.young_modulus, 210e9);
  EXPECT_EQ(wall.poisson_ratio, 0.3);
  EXPECT_EQ(wall.density, 7850);
  EXPECT_EQ(wall.metal->yield_strength, 275e6);
  EXPECT_EQ(wall.metal->ultimate_strength, 430e6);
  EXPECT_EQ(wall.clearance, 1e-3);
  EXPECT_EQ(wall.gap, 1e-4);
  EXPECT_EQ(wall.contact.friction_static, 0.2);
  EXPECT_EQ(wall.elements_through, 3);
  EXPECT_EQ(wall.mass_damping, 100);
  EXPECT_FALSE(wall.bonded_rims);
  EXPECT_EQ(settings({"Sleeve/Yield strength = 300 MPa"}).tube->metal->yield_strength, 300e6);
  EXPECT_EQ(settings({"Sleeve/Rims = bonded"}).tube->bonded_rims, true);
  EXPECT_EQ(wall.contact.bond.strength, 0);
  EXPECT_EQ(wall.recess, 0);
  EXPECT_EQ(settings({"Sleeve/Recess = 2 mm"}).tube->recess, 2e-3);
  const coupling::SurfaceBond bond = settings(adheres).tube->contact.bond;
  EXPECT_EQ(bond.strength, 0.5e6);
  EXPECT_EQ(bond.slip, 1e-4);
  EXPECT_TRUE(std::isnan(bond.tension));
  const coupling::LoadingSettings rubber =
      problem_settings(scene_with({"Specimen/Shape = cylinder", "Specimen/Radius = 50 mm",
                                   "Loading/Confinement = sleeve", "Loading/Confining pressure = 1 MPa"}))
          .loading;
  EXPECT_FALSE(rubber.tube || rubber.cell->sleeve->metal);
  // What is noted to have no effect has none.
  const coupling::LoadingSettings noted =
      problem_settings(
          scene_with({"Specimen/Shape = cylinder", "Specimen/Radius = 50 mm", "Loading/Confinement = sleeve",
                      "Loading/Confining pressure = 1 MPa", "Sleeve/Gap = 1 mm", "Sleeve/Clearance = 1 mm",
                      "Sleeve/Recess = 1 mm", "Sleeve/Bond strength = 1 MPa", "Sleeve/Bond slip = 1 mm"}))
          .loading;
  expect_same(*noted.cell->sleeve, *rubber.cell->sleeve);
}

TEST(ScenePlatens, deformable_ones_of_metal_yield) {
  const auto elastic = [](const Entries &more) {
    Entries all{"Platens/Kind = deformable", "Platens/Yield strength = 40 MPa", "Platens/Saturation = 30 MPa",
                "Platens/Saturation rate = 20", "Platens/Layers = gypsum 1 mm, platen 2 mm"};
    all.insert(all.end(), more.begin(), more.end());
    return *problem_settings(scene_with(all)).platens.elastic;
  };
  EXPECT_FALSE(elastic({}).metal);
  const coupling::ElasticPlatens yielding = elastic({"Platens/Material law = yielding"});
  ASSERT_TRUE(yielding.metal);
  EXPECT_EQ(yielding.metal->yield_strength, 40e6);
  EXPECT_EQ(yielding.metal->saturation, 30e6);
  EXPECT_EQ(yielding.metal->saturation_rate, 20);
  EXPECT_TRUE(std::isnan(yielding.metal->ultimate_strength));
  EXPECT_FALSE(yielding.layers.at(0).own);
  EXPECT_TRUE(yielding.layers.at(1).own);
}

TEST(ScenePlatens, the_hardening_of_a_tube_is_read_from_a_file) {
  const auto read = [](const std::string &text) {
    const std::string path = ::testing::TempDir() + "/hardening.csv";
    std::ofstream(path) << text;
    return read_hardening(path, 300e6);
  };
  const auto points = read("# of a coupon\nflow_stress_mpa,plastic_strain\n300,0\n320,0.01\n390,0.08\n");
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].strain, 0.01);
  EXPECT_EQ(points[1].stress, 390e6);
  EXPECT_EQ(read("plastic_strain;flow_stress_pa\n0,02;3,1e8\n").at(0).strain, 0.02);
  for (const char *bad : {"plastic_strain,flow_stress_pa\n0.02,2.9e8\n", "plastic_strain,flow_stress_pa\n",
                          "plastic_strain,flow_stress_pa\n0.02,3e8\n0.02,4e8\n", "plastic_strain\n0.02\n",
                          "plastic_strain,flow_stress_pa\n0.02,3e8\n0.03,2.99e8\n"})
    EXPECT_THROW(read(bad), InputError) << bad;
  std::string many = "plastic_strain,flow_stress_pa\n";
  for (int k = 1; k <= 32; ++k)
    many += std::to_string(0.01 * k) + ",3e8\n";
  EXPECT_THROW(read(many), InputError);
}

TEST(ScenePlatens, layers_arrive_with_their_materials) {
  const Entries entries{
      "Platens/Kind = deformable", "Platens/Layers = hard rubber 2 mm, steel 20 mm",
      "Platens/Layer materials = steel: 210 GPa, 0.3, 7850 kg/m3; hard rubber: 5 MPa, 45 %, 1.1 g/cm3",
      "Platens/Bottom/Layers = platen 1 mm, steel 3 mm"};
  const coupling::PlatenTestSettings settings = problem_settings(scene_with(entries));
  const coupling::PlatenSettings &told = settings.platens;
  ASSERT_EQ(told.elastic->layers.size(), 2u);
  EXPECT_DOUBLE_EQ(told.elastic->layers[0].thickness, 2e-3);
  EXPECT_DOUBLE_EQ(told.elastic->layers[0].material.young_modulus, 5e6);
  EXPECT_DOUBLE_EQ(told.elastic->layers[0].material.poisson_ratio, 0.45);
  EXPECT_DOUBLE_EQ(told.elastic->layers[0].material.density, 1100);
  EXPECT_EQ(told.elastic->layers[1].material.young_modulus, 210e9);
  EXPECT_DOUBLE_EQ(told.thickness, 22e-3); // as thick as they are
  ASSERT_EQ(told.bottom.layers.size(), 2u);
  EXPECT_EQ(told.bottom.layers[0].material.young_modulus, told.material.young_modulus);
  EXPECT_DOUBLE_EQ(told.bottom.thickness, 4e-3);
  EXPECT_TRUE(told.top.layers.empty());
  EXPECT_EQ(told.top.thickness, 0);
  Entries thicker(entries);
  thicker.emplace_back("Platens/Thickness = 30 mm");
  const coupling::PlatenTestSettings other = problem_settings(scene_with(thicker));
  const coupling::PlatenSettings &given = other.platens;
  EXPECT_DOUBLE_EQ(given.thickness, 30e-3);
  EXPECT_EQ(given.bottom.thickness, 0); // what its layers leave is platen
}

TEST(ScenePlatens, caps_have_ready_words_that_a_scene_may_give_itself) {
  const coupling::PlatenTestSettings settings = problem_settings(
      scene_with({"Platens/Kind = deformable", "Platens/Layers = gypsum 1 mm, platen 10 mm",
                  "Platens/Top/Layers = neoprene A50 4 mm, neoprene A70 2 mm, neoprene A60 1 mm",
                  "Platens/Bottom/Layers = gypsum 2 mm, neoprene A60 3 mm",
                  "Platens/Layer materials = neoprene A60: 9 MPa, 0.4, 1500 kg/m3"}));
  const coupling::PlatenSettings &told = settings.platens;
  EXPECT_EQ(told.elastic->layers[0].material.young_modulus, 9.8e9);
  EXPECT_EQ(told.elastic->layers[0].material.poisson_ratio, 0.2);
  EXPECT_EQ(told.elastic->layers[0].material.density, 1200);
  // Gent by hand: .0981 (56 + 381.168) / (.137505 x 127), .0981 (56 + 533.6352) / (.137505 x 76.2) MPa.
  EXPECT_NEAR(told.top.layers[0].material.young_modulus, 2.455812e6, 1);
  EXPECT_NEAR(told.top.layers[1].material.young_modulus, 5.520507e6, 1);
  EXPECT_EQ(told.top.layers[0].material.poisson_ratio, 0.49);
  EXPECT_EQ(told.top.layers[0].material.density, 1230);
  EXPECT_DOUBLE_EQ(told.top.layers[0].thickness, 4e-3); // the number of the word is none of a thickness
  EXPECT_EQ(told.bottom.layers[1].material.young_modulus, 9e6);
  EXPECT_EQ(told.top.layers[2].material.young_modulus, 9e6);
}

TEST(ScenePlatens, the_screen_tells_what_the_words_of_the_layers_stand_for) {
  Platens platens;
  platens.deformable = true;
  platens.layers = {{"platen", 1e-3}};
  EXPECT_EQ(text_of_layers(platens), "");
  platens.bottom_layers = {{"gypsum", 1e-3}};
  platens.top_layers = {{"neoprene A60", 1e-3}, {"neoprene A70", 1e-3}};
  platens.layer_materials = {{"neoprene A70", {1500, 9e6, 0.4}}};
  EXPECT_EQ(
      text_of_layers(platens),
      "    gypsum: 9800 MPa, 0.2, 1200 kg/m3 (cast and dry, some 1e5 kg/cm2: Kishitani and Hirai, Trans. "
      "Archit. Inst. Japan, series of 1977, part 3)\n"
      "    neoprene A60: 3.605 MPa, 0.49, 1230 kg/m3 (hardness Shore A60 by Gent 1958; no ring holds "
      "its rim)\n");
  platens.deformable = false;
  EXPECT_EQ(text_of_layers(platens), "");
}

TEST(ScenePlatens, what_platens_sleeve_and_loading_say_arrives) {
  const coupling::PlatenTestSettings told =
      problem_settings(scene_with({"Platens/Kind = deformable",
                                   "Platens/Top/Friction static = 0.4",
                                   "Platens/Friction dynamic = 0.2",
                                   "Platens/Bottom/Friction law = slip weakening",
                                   "Platens/Slip length = 1 mm",
                                   "Platens/Degree = 2",
                                   "Platens/Pad thickness = 0.5 mm",
                                   "Platens/Pad modulus = 3 MPa",
                                   "Platens/Pad Poisson ratio = 0.4",
                                   "Platens/Pad density = 1200 kg/m3",
                                   "Platens/Young modulus = 70 GPa",
                                   "Platens/Motion = quasi-static",
                                   "Platens/Stiffness = 4e5 N/m",
                                   "Loading/Confinement = sleeve",
                                   "Loading/Confining pressure = 2 MPa",
                                   "Loading/Pressure path = 0.5",
                                   "Loading/Confinement area = sphere",
                                   "Loading/Hold = 1 ms",
                                   "Sleeve/Rims = sliding",
                                   "Sleeve/Modulus = 2 MPa",
                                   "Sleeve/Friction = 0.1",
                                   "Sleeve/Seat depth = 2",
                                   "Loading/Unload at = 0.001, 0.002",
                                   "Loading/Hurry = 4",
                                   "Integration/Safety = 0.3",
                                   "Specimen/Shape = cylinder",
                                   "Specimen/Radius = 50 mm",
                                   "Specimen/Ends = ground"}));
  EXPECT_EQ(told.platens.top.friction_static, 0.4);
  EXPECT_EQ(told.platens.bottom.friction_static, 0.3);
  EXPECT_EQ(told.platens.top.dynamic(), 0.2);
  EXPECT_EQ(told.platens.top.weakening.by, dem::Weakening::By::nothing);
  EXPECT_EQ(told.platens.bottom.weakening.by, dem::Weakening::By::slip);
  EXPECT_EQ(told.platens.bottom.weakening.slip_length, 1e-3);
  EXPECT_EQ(told.platens.elastic->degree, 2);
  EXPECT_EQ(told.platens.elastic->motion, fem::ElasticMotion::quasi_static);
  EXPECT_EQ(told.platens.elastic->pad_thickness, 0.5e-3);
  EXPECT_EQ(told.platens.elastic->pad.young_modulus, 3e6);
  EXPECT_EQ(told.platens.elastic->pad.density, 1200);
  EXPECT_EQ(told.platens.material.young_modulus, 70e9);
  EXPECT_EQ(told.platens.stiffness.kind, Stiffness::Kind::absolute);
  EXPECT_EQ(told.loading.cell->pressure, 2e6);
  EXPECT_EQ(told.loading.cell->path, 0.5);
  EXPECT_EQ(told.loading.cell->area, dem::ConfinementArea::sphere);
  EXPECT_EQ(told.loading.hold, 1e-3);
  EXPECT_FALSE(told.loading.cell->sleeve->bonded_rims);
  EXPECT_EQ(told.loading.cell->sleeve->young_modulus, 2e6);
  EXPECT_EQ(told.loading.cell->sleeve->contact.friction_static, 0.1);
  EXPECT_EQ(told.loading.cell->sleeve->contact.dynamic(), 0.1);
  EXPECT_EQ(told.loading.cell->sleeve->seat_layer, 2);
  EXPECT_EQ(told.loading.unload_at, (std::vector<double>{0.001, 0.002}));
  EXPECT_EQ(told.loading.rate_multiplier, 4);
  EXPECT_EQ(told.time_step.safety, 0.3);
  EXPECT_EQ(told.ends, dem::EndPreparation::ground);
}

// By the law of the grains unless platens have one; what is glued is linear.
TEST(ScenePlatens, grains_press_on_platens_as_the_scene_says) {
  const auto told = [](Entries entries) {
    entries.insert(entries.begin(), {"Platens/Stiffness = 1e7 N/m", "Platens/Tangential ratio = 0.5"});
    return scene_with(entries);
  };
  const auto by_hertz = [](const Scene &scene) {
    EXPECT_EQ(coupling::presses_by_hertz(problem_settings(scene)), scene.hertz_on_platens());
    return scene.hertz_on_platens();
  };
  EXPECT_FALSE(by_hertz(told({"Effects/Contact = linear"})));
  EXPECT_TRUE(by_hertz(told({"Effects/Contact = hertz"})));
  EXPECT_FALSE(by_hertz(told({"Effects/Contact = hertz", "Platens/Attachment = glued"})));
  EXPECT_FALSE(by_hertz(told({"Effects/Contact = hertz", "Platens/Contact = linear"})));
  EXPECT_TRUE(by_hertz(told({"Effects/Contact = linear", "Platens/Contact = hertz"})));
  EXPECT_EQ(problem_settings(told({"Platens/Contact modulus = 210 GPa"})).platens.contact_modulus, 210e9);
  const auto noted = [&](const std::string &contact, const std::string &path) {
    const Scene scene = told({"Effects/Contact = " + contact, "Platens/Contact modulus = 200 GPa"});
    for (const std::string &note : scene.notes)
      if (note.find("note: " + path + " ") != std::string::npos) return true;
    return false;
  };
  for (const std::string key : {"Platens/Stiffness", "Platens/Tangential ratio"}) {
    EXPECT_TRUE(noted("hertz", key)) << key;
    EXPECT_FALSE(noted("linear", key)) << key;
  }
  EXPECT_TRUE(noted("linear", "Platens/Contact modulus"));
  EXPECT_FALSE(noted("hertz", "Platens/Contact modulus"));
}

// Each side takes its own figure, that of its own word, the common one; sides without platens are left out.
TEST(ScenePlatens, sides_have_platens_where_the_scene_puts_them) {
  const Entries box{"Specimen/Shape = box",
                    "Specimen/Radius =",
                    "Specimen/Width x = 10 mm",
                    "Specimen/Width y = 10 mm",
                    "Platens/Friction static = 0.4",
                    "Platens/Left/Friction static = 0.2",
                    "Platens/Right/Surface = grease",
                    "Platens/Front/Friction law = slip weakening",
                    "Platens/Front/Friction dynamic = 0.1",
                    "Platens/Slip length = 1 mm",
                    "Platens/Edge gap = 0.3 mm"};
  const auto told = [&](const std::string &sides) {
    Entries entries = box;
    entries.push_back("Platens/Sides = " + sides);
    return scene_with(entries);
  };
  const coupling::PlatenSettings two = problem_settings(told("two")).platens,
                                 x = problem_settings(told("four x")).platens,
                                 y = problem_settings(told("four y")).platens,
                                 six = problem_settings(told("six")).platens;
  EXPECT_FALSE(two.left || two.right || two.front || two.back);
  EXPECT_TRUE(x.left && x.right && !x.front && !x.back);
  EXPECT_TRUE(!y.left && !y.right && y.front && y.back);
  ASSERT_TRUE(six.left && six.right && six.front && six.back);
  EXPECT_EQ(six.edge_gap, 0.3e-3);
  EXPECT_EQ(six.top.friction_static, 0.4);
  EXPECT_EQ(six.left->friction_static, 0.2);
  EXPECT_EQ(six.left->dynamic(), 0.2);
  EXPECT_EQ(six.right->friction_static, 0.0048);
  EXPECT_EQ(six.front->friction_static, 0.4);
  EXPECT_EQ(six.front->dynamic(), 0.1);
  EXPECT_EQ(six.front->weakening.by, dem::Weakening::By::slip);
  EXPECT_EQ(six.back->weakening.by, dem::Weakening::By::nothing);
  EXPECT_EQ(six.back->friction_static, 0.4);
  EXPECT_TRUE(told("six").notes.empty());
  const auto notes = [&](const std::string &sides, const std::string &path) {
    for (const std::string &note : told(sides).notes)
      if (note.find("note: " + path + " ") != std::string::npos)
        return note.substr(note.find("has no effect"));
    return std::string();
  };
  EXPECT_EQ(notes("two", "Platens/Left/Friction static"),
            "has no effect: Platens/Sides leaves that side free.");
  EXPECT_EQ(notes("four x", "Platens/Left/Friction static"), "");
  EXPECT_EQ(notes("four x", "Platens/Front/Friction dynamic"),
            "has no effect: Platens/Sides leaves that side free.");
  EXPECT_EQ(notes("four x", "Platens/Slip length"), "has no effect: no Friction law is slip weakening.");
  EXPECT_EQ(notes("two", "Platens/Edge gap"), "has no effect: Platens/Sides = two.");
  EXPECT_EQ(notes("four y", "Platens/Edge gap"), "");
}

} // namespace
} // namespace platen::apps
