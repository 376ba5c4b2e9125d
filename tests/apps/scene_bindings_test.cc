// Entries are the members of the library's structs: what an entry sets, which laws it is for, and how a
// refusal of the library is told in words of the scene.
#include <gtest/gtest.h>

#include <map>

#include "apps/read_scenes.h"
#include "apps/run/model_setup.h"
#include "apps/run/problem_setup.h"
#include "apps/scene/members.h"
#include "apps/scratch_folder.h"
#include "coupling/platens_of_test.h"
#include "dem/laws/normal_contact.h"

namespace platen::apps {
namespace {

using namespace testing;

template <class Parameters>
Entries members_of() {
  Entries names; // flags are effects
  const Parameters empty{};
  Parameters::describe(
      [&](const char *name, const auto &value, const auto &...) {
        if (!std::is_same_v<std::decay_t<decltype(value)>, bool>) names.emplace_back(name);
      },
      empty);
  return names;
}

TEST(SceneBindings, every_number_of_every_bond_law_has_an_entry_that_sets_it_in_all_laws) {
  const Scene plain = default_scene(program("compress"));
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

TEST(SceneBindings,
     spheres_of_another_size_than_that_of_the_calibration_are_noted_where_nothing_corrects_bonds) {
  const auto notes = [](const Entries &overrides) { return scene_with(overrides).notes; };
  const std::string radius = "Specimen/Sphere radius = 1.2 mm";
  const Entries told = notes({radius, "Bond/Calibrated radius = 1 mm"});
  ASSERT_EQ(told.size(), 1);
  EXPECT_TRUE(contains(told[0],
                       "note: Specimen/Sphere radius = 1.2 mm is 1.2 times that of the calibration, "
                       "Bond/Calibrated radius = 1 mm, and no exponent corrects the bonds"));
  EXPECT_EQ(notes({radius, "Bond/Calibrated radius = 1.3 mm"}).size(), 1);
  EXPECT_EQ(notes({radius, "Bond/Calibrated radius = 1.19 mm"}).size(), 0);
  for (const char *exponent : {"Bond/Modulus exponent = 0.05", "Bond/Strength exponent = -0.05"})
    EXPECT_EQ(notes({radius, "Bond/Calibrated radius = 1 mm", exponent}).size(), 0) << exponent;
}

// Twice as large a specimen of spheres twice as large has as many across: the same bonds, uncorrected.
TEST(SceneBindings, spheres_across_the_least_width_decide_where_the_calibrated_width_is_given) {
  const Entries calibrated{"Bond/Calibrated radius = 1 mm", "Bond/Calibrated width = 20 mm",
                           "Bond/Modulus exponent = -0.1", "Bond/Strength exponent = -0.02"};
  const auto with = [&](Entries entries) {
    entries.insert(entries.end(), calibrated.begin(), calibrated.end());
    return scene_with(entries);
  };
  const auto modulus = [&](const Entries &entries) {
    return model_settings(with(entries)).bond_layout.modulus;
  };
  const double own = model_settings(scene_with({})).bond_layout.modulus;
  const auto cylinder = [](const char *radius, const char *spheres) {
    return Entries{std::string("Specimen/Radius = ") + radius, "Specimen/Height = 80 mm",
                   std::string("Specimen/Sphere radius = ") + spheres};
  };
  EXPECT_NEAR(modulus(cylinder("30 mm", "3 mm")), own, 1e-9 * own);
  EXPECT_NEAR(modulus(cylinder("20 mm", "1 mm")), own * std::pow(0.5, -0.1), 1e-9 * own); // 20 across for 10
  EXPECT_NEAR(modulus(cylinder("10 mm", "1.2 mm")), own * std::pow(1.2, -0.1), 1e-9 * own);
  const Entries plate{
      "Specimen/Shape = box",     "Specimen/Radius =",       "Specimen/Width x = 30 mm",
      "Specimen/Width y = 20 mm", "Specimen/Height = 80 mm", "Specimen/Sphere radius = 1.2 mm"};
  EXPECT_NEAR(modulus(plate), own * std::pow(1.2, -0.1), 1e-9 * own); // of the least
  const auto refusal = [&](Entries entries) {
    entries.insert(entries.end(), calibrated.begin(), calibrated.end());
    return said_with(entries);
  };
  EXPECT_TRUE(
      contains(refusal(cylinder("30 mm", "1 mm")),
               "Bond/Calibrated width = 20 mm with Calibrated radius = 1 mm is for 10 spheres across, and "
               "the specimen has 30 across its least width. Allowed: 6.67 to 20."));
  EXPECT_TRUE(contains(refusal(cylinder("10 mm", "1.6 mm")), "has 6.25 across"));
  EXPECT_EQ(refusal(cylinder("10 mm", "1.45 mm")), "");
  EXPECT_EQ(refusal(cylinder("200 mm", "20 mm")), "");
  const auto notes = [](Entries entries) {
    entries.insert(entries.end(), {"Bond/Calibrated radius = 1 mm", "Bond/Calibrated width = 20 mm"});
    return scene_with(entries).notes;
  };
  EXPECT_TRUE(notes(cylinder("30 mm", "3 mm")).empty());
  const Entries told = notes(cylinder("15 mm", "1 mm"));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_TRUE(contains(told[0],
                       "is 0.667 times that of the calibration, Bond/Calibrated radius = 1 mm over "
                       "Bond/Calibrated width = 20 mm (15 spheres across the least width for 10)"));
}

// The packing alone is made without bonds, and a pair has none.
TEST(SceneBindings, another_packing_than_the_bonds_are_calibrated_for_is_refused_where_it_is_bonded) {
  const Entries another{"Bond/Calibrated packing = random close", "Specimen/Packing = advancing front"};
  EXPECT_THROW(scene_with(another), InputError);
  EXPECT_NO_THROW(scene_with(another, "pack"));
  EXPECT_NO_THROW(scene_with({another[0], "Specimen/Packing = random close"}));
  EXPECT_NO_THROW(scene_with({"Bond/Calibrated packing = any", another[1]}));
}

TEST(SceneBindings, an_entry_without_effect_names_the_laws_that_it_is_for) {
  const auto note = [](const Entries &overrides) {
    const Entries notes = scene_with(overrides).notes;
    return notes.size() == 1 ? notes[0].substr(notes[0].find("has no effect")) : std::to_string(notes.size());
  };
  const std::string interface = "Effects/Bond = elasto damage plastic", beam = "Effects/Bond = cohesive beam";
  EXPECT_EQ(note({"Bond/Softening shear = 2"}), "has no effect: Effects/Bond is not elasto damage plastic.");
  EXPECT_EQ(note({interface, "Bond/Softening shear = 2"}), "0");
  EXPECT_EQ(note({"Bond/Poisson ratio = 0.1"}),
            "has no effect: Effects/Bond is not cohesive beam or elasto damage plastic.");
  EXPECT_EQ(note({beam, "Bond/Poisson ratio = 0.1"}), "0");
  EXPECT_EQ(note({beam, "Bond/Stiffness ratio = 0.1"}),
            "has no effect: Effects/Bond is not parallel bond, yielding parallel bond or facet.");
  EXPECT_EQ(note({"Bond/Compression limits = 1 MPa", "Bond/Compression slopes = 2"}), "2");
  EXPECT_EQ(note({"Effects/Bond = yielding parallel bond", "Bond/Compression limits = 1 MPa",
                  "Bond/Compression slopes = 2"}),
            "0");
  const std::string facet = "Effects/Bond = facet", energy = "Bond/Fracture energy = 20 J/m2";
  EXPECT_EQ(note({facet, energy, "Bond/Softening exponent = 0.3", "Bond/Gap = 0.6 R_min"}), "0");
  EXPECT_EQ(note({energy}), "has no effect: Effects/Bond is not facet.");
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
  const Entries bonds{"Effects/Bond = yielding parallel bond",
                      "Bond/Modulus = 40 GPa",
                      "Bond/Tensile strength = 9 MPa",
                      "Bond/Shear strength = 30 MPa",
                      "Bond/Compression limits = 60 MPa, 110 MPa",
                      "Bond/Compression slopes = 3, 12",
                      "Specimen/Sphere radius = 1 mm"};
  Entries sized = bonds;
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
