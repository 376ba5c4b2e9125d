// Entries are the members of the library's structs: what an entry sets, which laws it is for, and how a
// refusal of the library is told in words of the scene.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "apps/run/model_setup.h"
#include "apps/run/problem_setup.h"
#include "apps/scene/members.h"
#include "coupling/platens_of_test.h"
#include "dem/laws/normal_contact.h"

namespace platen::apps {
namespace {

const std::string good = (std::filesystem::path(PLATEN_TEST_DATA) / "fragment" / "good.prm").string();

Scene scene_with(const std::vector<std::string> &overrides) {
  return read_scene(good, overrides, AppKind::compress);
}

template <class Parameters>
std::vector<std::string> members_of() {
  std::vector<std::string> names; // flags are effects
  const Parameters empty{};
  Parameters::describe(
      [&](const char *name, const auto &value, const auto &...) {
        if (!std::is_same_v<std::decay_t<decltype(value)>, bool>) names.emplace_back(name);
      },
      empty);
  return names;
}

TEST(SceneBindings, every_number_of_every_bond_law_has_an_entry_that_sets_it_in_all_laws) {
  const Scene plain = default_scene();
  dem::BondLaws::for_each([&](auto *law) {
    using Law = std::remove_pointer_t<decltype(law)>;
    for (const std::string &member : members_of<typename Law::Parameters>())
      EXPECT_NE(plain.parameters->find("Bond/" + key_of(member)), nullptr) << Law::word << ": " << member;
  });
  const Scene scene = scene_with({"Bond/Tensile strength = 7 MPa", "Bond/Poisson ratio = 0.1"});
  EXPECT_EQ(std::get<dem::ParallelBond::Parameters>(scene.bond.laws).tensile_strength, 7e6);
  EXPECT_EQ(std::get<dem::CohesiveBeam::Parameters>(scene.bond.laws).tensile_strength, 7e6);
  EXPECT_EQ(std::get<dem::ElastoDamagePlastic::Parameters>(scene.bond.laws).tensile_strength, 7e6);
  EXPECT_EQ(std::get<dem::CohesiveBeam::Parameters>(scene.bond.laws).poisson_ratio, 0.1);
  EXPECT_EQ(std::get<dem::ElastoDamagePlastic::Parameters>(scene.bond.laws).poisson_ratio, 0.1);
}

TEST(SceneBindings, an_entry_without_effect_names_the_laws_that_it_is_for) {
  const auto note = [](const std::vector<std::string> &overrides) {
    const std::vector<std::string> notes = scene_with(overrides).notes;
    return notes.size() == 1 ? notes[0].substr(notes[0].find("has no effect")) : std::to_string(notes.size());
  };
  const std::string interface = "Effects/Bond = elasto damage plastic", beam = "Effects/Bond = cohesive beam";
  EXPECT_EQ(note({"Bond/Softening shear = 2"}), "has no effect: Effects/Bond is not elasto damage plastic.");
  EXPECT_EQ(note({interface, "Bond/Softening shear = 2"}), "0");
  EXPECT_EQ(note({"Bond/Poisson ratio = 0.1"}),
            "has no effect: Effects/Bond is not cohesive beam or elasto damage plastic.");
  EXPECT_EQ(note({beam, "Bond/Poisson ratio = 0.1"}), "0");
  EXPECT_EQ(note({beam, "Bond/Stiffness ratio = 0.1"}),
            "has no effect: Effects/Bond is not parallel bond or yielding parallel bond.");
  EXPECT_EQ(note({"Bond/Compression limits = 1 MPa", "Bond/Compression slopes = 2"}), "2");
  EXPECT_EQ(note({"Effects/Bond = yielding parallel bond", "Bond/Compression limits = 1 MPa",
                  "Bond/Compression slopes = 2"}),
            "0");
  EXPECT_EQ(note({interface, "Bond/Gap = 0.1 R_min"}),
            "has no effect: Effects/Bond = elasto damage plastic.");
  EXPECT_EQ(note({interface, "Bond/Fracture energy shear = 2", "Bond/Softening shear = 2"}),
            "has no effect: Bond/Fracture energy shear takes its place.");
  EXPECT_EQ(note({"Effects/Interface moments = on"}),
            "has no effect: Effects/Bond is not elasto damage plastic.");
  EXPECT_EQ(note({interface, "Effects/Interface moments = on"}), "0");
  EXPECT_EQ(note({interface, "Effects/Interface moments = on", "Effects/Rotation = off"}),
            "has no effect: Effects/Rotation is off.");
  EXPECT_EQ(note({interface, "Bond/Moment contribution = 0.5"}),
            "has no effect: Effects/Interface moments is off.");
  EXPECT_EQ(note({interface, "Effects/Interface moments = on", "Bond/Moment contribution = 0.5"}), "0");
  EXPECT_EQ(note({"Bond/Moment contribution = 0.5"}), "0");
  EXPECT_EQ(note({"Bond/Radius = 1 mm"}), "has no effect: Bond/Radius rule is not given.");
  EXPECT_EQ(note({"Contact/Restitution = 0.5"}), "has no effect: Effects/Contact is not hertz.");
  EXPECT_EQ(note({"Effects/Contact = hertz", "Contact/Restitution = 0.5"}), "0");
  EXPECT_EQ(note({"Output/Fields = off", "Output/Fields every = 3"}), "has no effect: Output/Fields = off.");
  EXPECT_EQ(note({"Integration/Damping = 0", "Integration/Damping form = vector"}),
            "has no effect: Integration/Damping = 0.");
}

// Half as large: modulus times .5^-.1, strengths and limits of compression times .5^-.02.
TEST(SceneBindings, bonds_calibrated_for_one_size_are_those_of_another_by_powers) {
  const std::vector<std::string> bonds{"Effects/Bond = yielding parallel bond",
                                       "Bond/Modulus = 40 GPa",
                                       "Bond/Tensile strength = 9 MPa",
                                       "Bond/Shear strength = 30 MPa",
                                       "Bond/Compression limits = 60 MPa, 110 MPa",
                                       "Bond/Compression slopes = 3, 12",
                                       "Specimen/Sphere radius = 1 mm"};
  std::vector<std::string> sized = bonds;
  for (const char *entry :
       {"Bond/Calibrated radius = 2 mm", "Bond/Modulus exponent = -0.1", "Bond/Strength exponent = -0.02"})
    sized.emplace_back(entry);
  const dem::ModelSettings as_given = model_settings(scene_with(bonds)),
                           corrected = model_settings(scene_with(sized));
  const auto &one = std::get<dem::YieldingParallelBond::Parameters>(*as_given.bond),
             &other = std::get<dem::YieldingParallelBond::Parameters>(*corrected.bond);
  EXPECT_EQ(as_given.bond_layout.modulus, 40e9);
  EXPECT_NEAR(corrected.bond_layout.modulus, 40e9 * std::pow(0.5, -0.1), 1e-3);
  const double stronger = std::pow(0.5, -0.02);
  EXPECT_EQ(one.tensile_strength, 9e6);
  EXPECT_NEAR(other.tensile_strength, 9e6 * stronger, 1e-3);
  EXPECT_NEAR(other.shear_strength, 30e6 * stronger, 1e-3);
  ASSERT_EQ(other.compression_limits.size(), 2u);
  EXPECT_NEAR(other.compression_limits[1], 110e6 * stronger, 1e-3);
  EXPECT_EQ(other.friction_angle, one.friction_angle);
  EXPECT_EQ(other.compression_slopes, one.compression_slopes);
}

TEST(SceneBindings, a_scene_is_the_settings_of_the_library) {
  const dem::ModelSettings plain = model_settings(scene_with({})), own;
  // A model that is told nothing is the one of a scene that says nothing.
  EXPECT_EQ(plain.local_damping, own.local_damping);
  EXPECT_EQ(plain.density, own.density);
  EXPECT_EQ(plain.contact->friction, dem::ContactSettings().friction);
  EXPECT_EQ(plain.contact->damping, dem::ContactSettings().damping);
  EXPECT_EQ(plain.bond_layout.gap.value, own.bond_layout.gap.value);
  const dem::ModelSettings all = model_settings(scene_with({"Effects/Bond = elasto damage plastic",
                                                            "Bond/Compression limits = 1 MPa, 2 MPa",
                                                            "Bond/Compression slopes = 3, 4",
                                                            "Bond/Failure line = coupled",
                                                            "Effects/Contact = hertz",
                                                            "Effects/Interface moments = on",
                                                            "Bond/Moment contribution = 0.4",
                                                            "Effects/Tangential = none",
                                                            "Material/Density of = solid",
                                                            "Integration/Damping form = vector",
                                                            "Integration/Scheme = tchamwa wielgosz",
                                                            "Integration/Dissipation = 1.2",
                                                            "Integration/Instruction set = baseline",
                                                            "Bond/Strength scatter = weibull",
                                                            "Bond/Weibull modulus = 9",
                                                            "Scene/Seed = 5",
                                                            "Phases/By = radius",
                                                            "Phases/Radius above = 1 mm",
                                                            "Phases/Interface strength factor = 0.5",
                                                            "Bond/Radius rule = harmonic",
                                                            "Effects/Gravity = on"}));
  const auto &law = std::get<dem::ElastoDamagePlastic::Parameters>(*all.bond);
  EXPECT_EQ(law.compression_limits, (std::vector<double>{1e6, 2e6}));
  EXPECT_EQ(law.compression_slopes, (std::vector<double>{3, 4}));
  EXPECT_EQ(law.failure_line, dem::FailureLine::coupled);
  EXPECT_TRUE(law.moments);
  EXPECT_FALSE(dem::ElastoDamagePlastic::Parameters().moments);
  EXPECT_EQ(law.moment_contribution, 0.4);
  EXPECT_EQ(all.contact->normal, dem::NormalContact::hertz);
  EXPECT_EQ(all.contact->tangential, dem::TangentialContact::none);
  EXPECT_EQ(all.density_of, dem::DensityOf::solid);
  EXPECT_EQ(all.damping_form, dem::DampingForm::vector);
  EXPECT_EQ(all.phi(), 1.2);
  EXPECT_EQ(plain.phi(), 1);
  EXPECT_EQ(all.instruction_set, dem::InstructionSet::baseline);
  EXPECT_EQ(all.strength_scatter->weibull_modulus, 9);
  EXPECT_EQ(all.strength_scatter->seed, 5u);
  EXPECT_EQ(all.phases->radius_above, 1e-3);
  EXPECT_EQ(all.phases->interface.strength, 0.5);
  EXPECT_EQ(all.bond_layout.radius_rule, dem::RadiusRule::harmonic);
  EXPECT_TRUE(all.bond_layout.by_range);
  EXPECT_LT(all.gravity.z, 0);
}

TEST(SceneBindings, a_refusal_of_the_library_is_told_by_file_line_and_key) {
  const Scene scene = scene_with({"Bond/Modulus = 5 GPa"});
  const auto told = [&](const BadParameter &error) -> std::string {
    try {
      scene.parameters->refuse(error);
    } catch (const InputError &e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(told({"BondLayout", "modulus", "5e9", "is too soft."}),
            "command line, --set 1: error: Bond/Modulus = 5 GPa is too soft.");
  EXPECT_EQ(told({"CohesiveBeam", "tensile_strength", "0", "is none."}).find(good), 0u);
  EXPECT_THROW(scene.parameters->refuse(BadParameter("Nobody", "modulus", "", "is wrong.")), BadParameter);
}

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
void expect_same(const Described &scene, const Described &library, const std::vector<std::string> &but = {}) {
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

TEST(SceneBindings, a_default_of_platens_sleeve_and_loading_is_stated_once) {
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

TEST(SceneBindings, layers_arrive_with_their_materials) {
  const std::vector<std::string> entries{
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
  std::vector<std::string> thicker(entries);
  thicker.emplace_back("Platens/Thickness = 30 mm");
  const coupling::PlatenTestSettings other = problem_settings(scene_with(thicker));
  const coupling::PlatenSettings &given = other.platens;
  EXPECT_DOUBLE_EQ(given.thickness, 30e-3);
  EXPECT_EQ(given.bottom.thickness, 0); // what its layers leave is platen
}

TEST(SceneBindings, what_platens_sleeve_and_loading_say_arrives) {
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
  EXPECT_EQ(told.loading.cell->sleeve_seat_depth, 2);
  EXPECT_EQ(told.loading.unload_at, (std::vector<double>{0.001, 0.002}));
  EXPECT_EQ(told.loading.rate_multiplier, 4);
  EXPECT_EQ(told.time_step.safety, 0.3);
  EXPECT_EQ(told.ends, dem::EndPreparation::ground);
}

// By the law of the grains unless platens have one; what is glued is linear.
TEST(SceneBindings, grains_press_on_platens_as_the_scene_says) {
  const auto told = [](std::vector<std::string> entries) {
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
TEST(SceneBindings, sides_have_platens_where_the_scene_puts_them) {
  const std::vector<std::string> box{"Specimen/Shape = box",
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
    std::vector<std::string> entries = box;
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

TEST(SceneBindings, members_that_the_library_names_are_told_as_entries) {
  const Scene scene = scene_with({});
  for (const auto &[member, entry] :
       std::map<std::string, std::string>{{"ends", "Specimen/Ends"},
                                          {"end_layer", "Specimen/End layer"},
                                          {"specimen.radius", "Specimen/Sphere radius"},
                                          {"platens.strip_width", "Platens/Strip width"},
                                          {"platens.span", "Platens/Span"},
                                          {"platens.elements_across", "Platens/Elements across"},
                                          {"platens.top.grid", "Platens/Top/Mesh file"},
                                          {"platens.bottom.grid", "Platens/Bottom/Mesh file"},
                                          {"platens.left.grid", "Platens/Left/Mesh file"},
                                          {"platens.back.grid", "Platens/Back/Mesh file"},
                                          {"platens.left", "Platens/Sides"},
                                          {"platens.back", "Platens/Sides"},
                                          {"platens.edge_gap", "Platens/Edge gap"},
                                          {"platens.elastic.pad_modulus", "Platens/Pad modulus"},
                                          {"loading.rate", "Loading/Axial rate"},
                                          {"loading.wave_transits", "Loading/Wave crossings"},
                                          {"loading.rate_multiplier", "Loading/Hurry"},
                                          {"loading.start_strain", "Loading/Start strain"},
                                          {"loading.cell", "Loading/Confinement"},
                                          {"loading.cell.ramp", "Loading/Confining ramp"},
                                          {"sleeve.elements_around", "Sleeve/Elements around"},
                                          {"time_step.safety", "Integration/Safety"},
                                          {"time_step.fixed_step", "Integration/Time step"}})
    EXPECT_EQ(scene.parameters->entry_of(member), entry);
  EXPECT_EQ(scene.parameters->with_entries("a larger `end_layer`, or `nothing known`; `open"),
            "a larger Specimen/End layer, or nothing known; `open");
}

} // namespace
} // namespace platen::apps
