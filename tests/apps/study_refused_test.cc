// Studies that nothing can be made of: each is refused before anything is run, by what is wrong with it.
#include <gtest/gtest.h>

#include "apps/scene/errors.h"
#include "apps/study_runs.h"

namespace platen::apps::testing {
namespace {

struct Refused {
  Words entries;
  std::string says;
};

void expect_refused(StudyKind kind, const Words &base, const std::vector<Refused> &all) {
  for (const Refused &one : all) {
    SCOPED_TRACE(one.says);
    const std::string message = message_of<InputError>([&] { plan_of(kind, with(base, one.entries)); });
    EXPECT_TRUE(contains(message, one.says)) << message;
  }
}

TEST(RefusedStudy, of_platens) {
  expect_refused(
      StudyKind::friction, {},
      {{{}, "Study/Surface list is not set: nothing is varied."},
       {{"Study/Surface list = dry stel"},
        "holds an item, \"dry stel\", that is not known. Did you mean \"dry steel\"?"},
       {{"Study/Surface list = 7"}, "\"7\", that is out of range"},
       {{"Study/Surface list = 0.3, 0.30"}, "holds 0.3 twice"},
       {{"Study/Surface list = grease, grease"}, "holds grease twice"},
       {{"Study/Surface list = 0", "Platens/Top/Friction static = 0.4"},
        "Platens/Top/Friction static = 0.4 contradicts Study/Surface list"},
       {{"Study/Surface list = 0", "Loading/Stop at residual = 0.9"},
        "Loading/Stop at residual = 0.9 ends a run before it is known to have peaked. Allowed: below 0.8."},
       {{"Study/Surface list = 0", "Loading/Test = uniaxial strain"}, "Allowed: compression."},
       {{"Study/Surface list = 0", "Study/Confining pressure list = 1 MPa"},
        "needs Loading/Confinement = particles, sleeve"},
       {{"Study/Surface list = dry steel, brush"},
        "leads to brush_sphere_radius_2_mm, which cannot be run"}});
  expect_refused(StudyKind::slenderness, {},
                 {{{}, "Study/Slenderness list is not set: nothing is varied."},
                  {{"Study/Slenderness list = 0"}, "\"0\", that is out of range"},
                  {{"Study/Slenderness list = 1, 2", "Study/Surface list = 0, 0.3"},
                   "holds several: a study of slenderness has one kind of platens"}});
}

const std::vector<Refused> of_size{
    {{"Study/Sphere radius list = 1 mm, 0.001"}, "twice"},
    {{"Study/Sphere radius list = 1 mm,"}, "is empty"},
    {{"Study/Sphere radius list = 30 mm"}, "sphere_radius_30_mm, which cannot be run"},
    {{"Study/Domain list = 20 mm"}, "is no pair"},
    {{"Study/Domain list = 20 mm x 5 s"}, "20 mm x 5 s"},
    {{"Study/Seeds = 0"}, "Study/Seeds"},
    {{"Scene/Seed = 4294967295"}, "Scene/Seed"},
    {{"Specimen/Shape = box", "Specimen/Radius =", "Specimen/Width x = 20 mm", "Specimen/Width y = 20 mm",
      "Study/Domain list = 20 mm x 5 mm"},
     "holds cylinders"}};

TEST(RefusedStudy, of_sizes_packings_and_rates) {
  expect_refused(StudyKind::size, {}, of_size);
  expect_refused(StudyKind::rate, {}, {{{}, "Study/Axial rate list is not set"}});
  expect_refused(StudyKind::packing, {}, {{{}, "Study/Gap list is not set"}});
}

TEST(RefusedStudy, of_accuracy) {
  expect_refused(
      StudyKind::accuracy, {"Loading/Stop at residual = 0.5", no_radii},
      {{{}, "Study/Safety list is not set, nor is any other list of a study of accuracy"},
       {{"Study/Safety list = 0.5"}, "Study/Safety list = 0.5 has nothing to compare"},
       {{"Study/Safety list = 0.2, 0.5"}, "does not go from coarse to fine. Allowed: falling values"},
       {{"Study/Safety list = 0.5, 0.50, 0.2"}, "holds 0.5 twice"},
       {{"Study/Safety list = 0.5, 0.2", "Integration/Time step = 1e-8 s"},
        "Study/Safety list = 0.5, 0.2 has no effect: Integration/Time step is set"},
       {{"Study/Platen mesh list = 4, 8"}, "needs Platens/Kind = deformable"},
       {{"Platens/Kind = deformable", "Study/Platen mesh list = 8, 4"}, "Allowed: rising values"},
       {{"Platens/Kind = deformable", "Study/Platen mesh list = 4.5, 8"}, "not a whole number"},
       {{"Platens/Kind = deformable", "Study/Steps per solve list = 8, 4"}, "Motion = quasi-static"},
       {{"Study/Sleeve mesh list = 12, 24"}, "needs Loading/Confinement = sleeve"},
       {{"Study/Mass scaling list = 10, 1", "Loading/Axial rate =", "Loading/Wave crossings = 60"},
        "gains nothing where Loading/Wave crossings sets the speed"},
       {{"Study/Wave crossings list = 30, 60"}, "has no effect: Loading/Axial rate is set"},
       {{"Study/Quality list = fast, standard"},
        "would not be heard: the scene says itself what Loading/Wave"},
       {{"Study/Quality list = standard, fast"}, "does not go from coarse to fine"},
       {{"Study/Quality list = quick"}, "\"quick\", that is not known"},
       {{"Study/Effects list = Effects/Rotation"}, "\"Effects/Rotation\", that sets nothing"},
       {{"Study/Effects list = Rotation = off"}, "that names no entry"},
       {{"Study/Effects list = Effects/Rotation = on"}, "changes nothing by Effects/Rotation = on"},
       {{"Study/Effects list = Scene/Seed = 5"}, "changes Scene/Seed, which the study sets"},
       {{"Study/Effects list = Effects/Rotations = off"}, "Did you mean \"Effects/Rotation\""},
       {{"Study/Safety list = 0.5, 0.2", "Loading/Test = hydrostatic", "Loading/Confinement = particles",
         "Loading/Confining pressure = 1 MPa"},
        "has no strength to be accurate"}});
}

TEST(RefusedStudy, of_any_entries) {
  expect_refused(
      StudyKind::vary, {no_radii},
      {{{}, "Study/Vary 1 is not set: nothing is varied"},
       {{"Study/Vary 2 = Platens/Frction static: 1"},
        "Study/Vary 2 = Platens/Frction static: 1 names Platens/Frction static, which is no entry of this "
        "scene. Did you mean \"Platens/Friction static\"?"},
       {{"Study/Vary 1 = Specimen/Height"}, "varies no entry"},
       {{"Study/Vary 1 = Scene/Seed: 1, 2"}, "which is of the study itself"},
       {{"Study/Vary 1 = Specimen/Height: 9 mm, 9 mm"}, "holds 9 mm twice"},
       {{"Study/Vary 1 = Specimen/Height: 9 mm", "Study/Vary 2 = Specimen/Height: 8 mm"}, "a second time"},
       {{"Study/Vary 1 = Specimen/Height & Specimen/Height: 9 mm & 8 mm"}, "a second time"},
       {{"Study/Vary 1 = Specimen/Height & Scene/Seed: 9 mm & 2"}, "which is of the study itself"},
       {{"Study/Vary 1 = Specimen/Height & Platens/Friction static: 9 mm & 0.2, 8 mm"},
        "holds a case that has not one value for each of its 2 entries"},
       {{"Study/Vary 1 = Specimen/Height & Platens/Friction static: 9 mm & 0.2, 9 mm & 0.2"},
        "holds 9 mm & 0.2 twice"},
       {{"Study/Vary 1 = Platens/Friction static: 0.2, -1"}, "friction_static_-1"}});
}

TEST(RefusedStudy, of_a_target) {
  const std::string gain = "Study/Target/Figure = gain",
                    calibrated = "Bond/Calibrated figures = compression, ",
                    greased = "Study/Target/Over = Platens/Friction static = 0, Platens/Friction dynamic = 0",
                    lower = "Study/Target/Over = Specimen/Height = 15 mm";
  const Words base{"Loading/Stop at residual = 0.5", "Study/Wave crossings list = 2, 4, 8"};
  expect_refused(
      StudyKind::target, base,
      {{{gain}, "Study/Target/Figure = gain needs one scene that it is over"},
       {{greased}, "has no effect: Study/Target/Figure is no gain"},
       {{gain, "Study/Target/Over = Scene/Seed = 0"}, "which the study sets"},
       {{"Study/Target/Accuracy = 60 %"}, "Study/Target/Accuracy = 60 %"},
       {{"Study/Target/Figure = stiffness"}, "Allowed: strength, youngs modulus, gain"},
       {{"Study/Target/Most runs = 3"}, "is less than the pilot takes. Allowed: >= 4"},
       {{"Study/Target/Most runs = 6", "Study/Target/Step seeds = 3"}, "Allowed: >= 7"},
       {{"Study/Wave crossings list = 8, 4"}, "gives a target no speeds to choose from"},
       {{"Study/Wave crossings list = 8"}, "Allowed: 2 to 8 rising numbers"},
       {{"Loading/Stop at residual = 0.9"}, "ends a run before it is known to have peaked"},
       {{"Study/Target/Step seeds = 3", "Integration/Time step = 1e-8 s"},
        "Study/Target/Step seeds = 3 has no effect: Integration/Time step is set"},
       {{gain, "Study/Target/Over scene = nowhere.prm"}, "nowhere.prm"},
       {{gain, greased, calibrated + "slenderness"},
        "Study/Target/Figure = gain is none: the bonds are not calibrated for it: Bond/Calibrated figures = "
        "compression, slenderness, without friction"},
       {{gain, lower, calibrated + "friction"}, "without slenderness"}});
  EXPECT_NO_THROW(plan_of(StudyKind::target, with(base, {gain, greased, calibrated + "friction"})));
  EXPECT_NO_THROW(plan_of(StudyKind::target, with(base, {gain, lower, calibrated + "slenderness"})));
}

TEST_F(Study, faults_are_refused_before_anything_is_written) {
  expect(2, "Did you mean \"size\"?", "a", {}, "sizes");
  expect(2, "Study/Axial rate list is not set", "a", {}, "rate");
  expect(2, "Study/Gap list is not set", "a", {}, "packing");
  for (const Refused &one : of_size) {
    expect(2, one.says, "a", set(one.entries));
    EXPECT_FALSE(fs::exists(folder_ / "a"));
  }
  expect(2, "a/scene.prm: error: is missing: the folder holds nothing to resume", "a", {"--resume"});
  for (const std::string option : {"--plan", "--run", "--collect"})
    expect(
        2, option + " does not go with a study of target", "a",
        with(set({"Loading/Stop at residual = 0.5"}), option == "--run" ? Words{option, "1"} : Words{option}),
        "target");
  EXPECT_FALSE(fs::exists(folder_ / "a"));
}

} // namespace
} // namespace platen::apps::testing
