// What cannot be of a test is found by its settings alone: one rule a row, and what lies beside it is
// allowed.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "coupling/boundary.h"
#include "coupling/faults.h"
#include "fem/grids.h"

namespace platen::coupling::faults_test {
namespace {

using Settings = PlatenTestSettings;

struct Row {
  const char *member, *says; // "" and "": nothing is wrong
  std::function<void(Settings &)> change;
};

// A cylinder that is compressed.
Settings cylinder() {
  Settings s;
  s.model.bond = dem::ParallelBond::Parameters{};
  s.loading.rate = 0.01, s.loading.target_strain = 0.01;
  s.platens.thickness = 0.01;
  return s;
}

// A bar along x on two strips.
Settings bar() {
  Settings s = cylinder();
  s.ends = Ends::ground;
  s.platens.span = 0.06, s.platens.strip_width = 0.005;
  return s;
}

// A box between platens on four sides.
Settings between_sides() {
  Settings s = cylinder();
  s.platens.left.emplace(), s.platens.right.emplace();
  return s;
}

void press(Settings &s) {
  s.loading.cell.emplace().pressure = 1e6;
}

void weaken(Settings &s, dem::Weakening::By by, double slip_length = not_given, double dynamic = 0.3) {
  s.platens.top.friction_static = 0.5, s.platens.top.friction_dynamic = dynamic;
  s.platens.top.weakening.by = by, s.platens.top.weakening.slip_length = slip_length;
}

void leave_bonds_out(Settings &s) {
  s.model.bond.reset();
}
void pull(Settings &s) {
  s.loading.tension = s.platens.glued = true;
}
void by_wave_transits(Settings &s) {
  s.loading.rate = not_given, s.loading.wave_transits = 60;
}
void put_wall(Settings &s) {
  s.loading.wall = true;
}
void start_strained(Settings &s) {
  s.loading.start_strain = 1e-3;
}

std::function<void(Settings &)> unload_at(const std::vector<double> &strains) {
  return [strains](Settings &s) { s.loading.unload_at = strains; };
}
void control_stress(Settings &s) {
  s.loading.servo = true, s.loading.top_stress = 1e6;
}

void ask_of_axis(Settings &s, SideGroup side, SideControl::Mode ask, Until::Reached end) {
  StageSettings &stage = s.loading.stages.emplace_back();
  stage.name = "stage 1";
  SideControl &one = stage.controls.emplace_back();
  one.side = side, one.mode = ask, one.value = 0.01;
  stage.until = {{end, 0.01, SideGroup::axial}};
}

void expect_faults(const std::vector<Row> &rows, const Settings &sound, const dem::Shape &shape) {
  ASSERT_TRUE(faults(sound, &shape).empty()) << faults(sound, &shape).front().reason;
  for (const Row &row : rows) {
    Settings settings = sound;
    row.change(settings);
    const std::vector<Fault> found = faults(settings, &shape);
    if (std::string(row.member).empty()) {
      EXPECT_TRUE(found.empty()) << found.front().member << ' ' << found.front().reason;
      continue;
    }
    ASSERT_EQ(found.size(), 1u) << row.member << ' ' << row.says;
    EXPECT_EQ(found[0].member, row.member);
    EXPECT_NE(found[0].reason.find(row.says), std::string::npos) << found[0].reason;
    EXPECT_TRUE(found[0].reason.find("Allowed: ") != std::string::npos ||
                found[0].reason.find("needs ") != std::string::npos ||
                found[0].reason.find("is not below ") != std::string::npos ||
                found[0].reason.find("does not ascend") != std::string::npos ||
                found[0].reason.find("goes beyond ") != std::string::npos)
        << found[0].reason;
    EXPECT_THROW(require_no_fault(settings, shape), BadSetup);
  }
}

// Member and reason of the only fault there is; empty: none.
std::string fault_of(const Settings &settings, const dem::Shape &shape) {
  const std::vector<Fault> found = faults(settings, &shape);
  EXPECT_LE(found.size(), 1u);
  return found.empty() ? "" : found[0].member + " " + found[0].reason;
}

TEST(Faults, friction_falls_while_it_slides) {
  using By = dem::Weakening::By;
  expect_faults(
      {{"platens.top.friction_dynamic", "above the static friction, 0.3",
        [](Settings &s) { s.platens.top.friction_static = 0.3, s.platens.top.friction_dynamic = 0.31; }},
       {"", "", [](Settings &s) { s.platens.top.friction_static = s.platens.top.friction_dynamic = 0.3; }},
       {"platens.bottom.friction_dynamic", "of the bottom platen",
        [](Settings &s) { s.platens.bottom.friction_static = 0.3, s.platens.bottom.friction_dynamic = 0.4; }},
       {"platens.top.friction_law", "slip_length` > 0", [](Settings &s) { weaken(s, By::slip); }},
       {"platens.top.friction_law", "slip_velocity` > 0", [](Settings &s) { weaken(s, By::velocity); }},
       {"", "", [](Settings &s) { weaken(s, By::slip, 1e-3); }},
       {"platens.top.friction_law", "nothing to fall to",
        [](Settings &s) { weaken(s, By::slip, 1e-3, 0.5); }}},
      cylinder(), dem::cylinder(0.02, 0.04));
}

TEST(Faults, a_machine_drives_what_it_can) {
  expect_faults(
      {{"loading.tension", "cannot pull", [](Settings &s) { s.loading.tension = true; }},
       {"", "", pull},
       {"loading.servo", "`loading.top_stress` > 0", [](Settings &s) { s.loading.servo = true; }},
       {"", "", control_stress},
       {"loading.servo", "presses, but the test pulls", [](Settings &s) { control_stress(s), pull(s); }},
       {"loading.rate_multiplier", "needs bonds",
        [](Settings &s) { s.loading.rate_multiplier = 2, leave_bonds_out(s); }},
       {"", "", [](Settings &s) { s.loading.rate_multiplier = 2; }},
       {"loading.servo_gain", "too slow", [](Settings &s) { s.loading.servo_gain = 0.09; }},
       {"", "", [](Settings &s) { s.loading.servo_gain = 0.1; }},
       {"loading.wave_transits", "needs bonds", [](Settings &s) { by_wave_transits(s), leave_bonds_out(s); }},
       {"loading.wave_transits", "sets no speed", [](Settings &s) { by_wave_transits(s), pull(s); }},
       {"", "", by_wave_transits},
       {"loading.unload_at", "does not ascend", unload_at({0.002, 0.001})},
       {"loading.unload_at", "goes beyond", unload_at({0.001, 0.01})},
       {"", "", unload_at({0.001, 0.0099})},
       {"loading.unload_at", "driven by motion",
        [](Settings &s) { control_stress(s), unload_at({0.001})(s); }}},
      cylinder(), dem::cylinder(0.02, 0.04));
}

TEST(Faults, platens_that_yield_or_turn_move_with_inertia) {
  const auto yields = [](Settings &s) { s.platens.elastic.emplace(); };
  const auto flows = [&](Settings &s) {
    yields(s), s.platens.elastic->metal.emplace().yield_strength = 100e6;
  };
  const auto spring = [](Settings &s) { s.platens.machine.stiffness = 1e8; };
  const fem::Grid mesh = fem::make_grid(fem::BoxPlate{{0, 0, 0}, {1, 1, 1}});
  expect_faults(
      {{"", "", yields},
       {"platens.elastic", "velocity verlet",
        [&](Settings &s) { yields(s), s.model.scheme = dem::Scheme::tchamwa_wielgosz; }},
       {"platens.elastic", "between rigid ends", [&](Settings &s) { yields(s), start_strained(s); }},
       {"platens.elastic.pad_thickness", "leaves nothing",
        [&](Settings &s) { yields(s), s.platens.elastic->pad_thickness = 0.01; }},
       {"", "", [&](Settings &s) { yields(s), s.platens.elastic->pad_thickness = 0.0099; }},
       {"", "", // meshes have no thickness of the settings
        [&](Settings &s) {
          yields(s), s.platens.elastic->pad_thickness = 0.01;
          s.platens.top.grid = s.platens.bottom.grid = mesh;
        }},
       {"platens.elastic.pad_thickness", "leaves nothing",
        [&](Settings &s) { yields(s), s.platens.elastic->pad_thickness = 0.01, s.platens.top.grid = mesh; }},
       {"platens.elastic.layers", "another way to say",
        [&](Settings &s) {
          yields(s), s.platens.elastic->pad_thickness = 1e-3, s.platens.elastic->layers.resize(1);
        }},
       {"", "", flows},
       {"platens.elastic.motion", "stay elastic",
        [&](Settings &s) { flows(s), s.platens.elastic->motion = fem::ElasticMotion::quasi_static; }},
       {"platens.elastic.metal.yield_strength", "has to be given",
        [&](Settings &s) { flows(s), s.platens.elastic->metal->yield_strength = not_given; }},
       {"platens.elastic.metal.yield_strength", "a tenth of Young's modulus",
        [&](Settings &s) { flows(s), s.platens.elastic->metal->yield_strength = 20.1e9; }},
       {"", "", [&](Settings &s) { flows(s), s.platens.elastic->metal->yield_strength = 19.9e9; }},
       {"platens.young_modulus", "too low beside the yield strength",
        [&](Settings &s) {
          flows(s), s.platens.material.young_modulus = 9.9e9;
          s.platens.elastic->metal->ultimate_strength = 150e6;
        }},
       {"platens.elastic.metal", "layers of others",
        [&](Settings &s) {
          flows(s), s.platens.elastic->layers = {{0.01, s.platens.material}};
        }},
       {"", "",
        [&](Settings &s) {
          flows(s), s.platens.elastic->layers = {{0.0099, s.platens.material}};
        }},
       {"", "",
        [&](Settings &s) {
          flows(s), s.platens.elastic->layers = {{0.01, {}, true}};
        }},
       {"", "", // the bottom platen yields
        [&](Settings &s) {
          flows(s), s.platens.top.layers = {{0.01, s.platens.material}};
        }},
       {"platens.machine.stiffness", "without inertia", [&](Settings &s) { spring(s), start_strained(s); }},
       {"platens.machine.damping", "lets a servo swing",
        [&](Settings &s) { spring(s), control_stress(s), s.platens.machine.damping = 0; }},
       {"platens.machine.damping", "servo", // of a cell
        [&](Settings &s) { spring(s), press(s), s.platens.machine.damping = 0; }},
       {"", "", [&](Settings &s) { spring(s), s.platens.machine.damping = 0; }},
       {"platens.spherical_seat", "do not turn",
        [](Settings &s) { s.platens.spherical_seat = true, s.loading.start_strain = 1e-3; }},
       {"platens.spherical_seat", "velocity verlet",
        [](Settings &s) { s.platens.spherical_seat = true, s.model.scheme = dem::Scheme::tchamwa_wielgosz; }},
       {"platens.contact", "ends are glued",
        [](Settings &s) { s.platens.contact = PlatenContact::hertz, s.platens.glued = true; }}},
      cylinder(), dem::cylinder(0.02, 0.04));
}

TEST(Faults, ends_and_loads_may_be_imperfect_where_that_means_something) {
  const auto tilt = [](Settings &s) { s.platens.tilt = 0.01; };
  const auto aside = [](Settings &s) { s.platens.spherical_seat = true, s.platens.eccentricity = 5e-3; };
  const auto dome = [](Settings &s) { s.ends = Ends::convex, s.end_height = 1e-4; };
  expect_faults(
      {{"", "", tilt},
       {"", "", aside},
       {"", "", dome},
       {"", "", [&](Settings &s) { aside(s), s.platens.seat_friction_arm = 1e-3; }},
       {"platens.seat_friction_arm", "platen on a seat",
        [](Settings &s) { s.platens.seat_friction_arm = 1e-3; }},
       {"platens.seat_friction_arm", "is of a rigid platen",
        [&](Settings &s) { aside(s), s.platens.seat_friction_arm = 1e-3, s.platens.elastic.emplace(); }},
       {"platens.eccentricity", "turns about the load", [](Settings &s) { s.platens.eccentricity = 5e-3; }},
       {"platens.eccentricity", "beside the specimen",
        [&](Settings &s) { aside(s), s.platens.eccentricity = -0.02; }},
       {"platens.tilt", "is of a rigid platen", [&](Settings &s) { tilt(s), s.platens.elastic.emplace(); }},
       {"platens.tilt", "what is glued fits", [&](Settings &s) { tilt(s), s.platens.glued = true; }},
       {"platens.tilt", "square ends", [&](Settings &s) { tilt(s), s.loading.start_strain = 1e-3; }},
       {"end_height", "is not set", [](Settings &s) { s.ends = Ends::rough; }},
       {"ends", "what is glued fits", [&](Settings &s) { dome(s), s.platens.glued = true; }},
       {"ends", "flat ends", [&](Settings &s) { dome(s), s.loading.start_strain = 1e-3; }}},
      cylinder(), dem::cylinder(0.02, 0.04));
}

TEST(Faults, a_disc_is_met_by_a_tilted_platen_but_has_no_ends_for_a_seat) {
  const auto seat = [](Settings &s) { s.platens.spherical_seat = true; };
  Settings split = cylinder();
  split.platens.strip_width = 2e-3;
  dem::Shape disc = dem::cylinder(0.02, 0.04);
  disc.kind = dem::ShapeKind::disc, disc.width_y = 0.02;
  expect_faults(
      {{"", "", [](Settings &s) { s.platens.tilt = 0.01; }},
       {"platens.spherical_seat", "rim of a disc", seat},
       {"platens.seat_friction_arm", "rim of a disc",
        [](Settings &s) { s.platens.seat_friction_arm = 1e-3; }},
       {"platens.eccentricity", "rim of a disc", [](Settings &s) { s.platens.eccentricity = 1e-3; }},
       {"ends", "a disc is pressed on its rim",
        [](Settings &s) { s.ends = Ends::convex, s.end_height = 1e-4; }}},
      split, disc);
}

TEST(Faults, a_run_starts_strained_where_that_can_be_solved_for) {
  Settings sound = cylinder();
  sound.loading.start_strain = 1e-3;
  expect_faults({{"loading.start_strain", "needs compression", pull},
                 {"loading.start_strain", "needs compression", put_wall},
                 {"loading.start_strain", "`loading.cell`", press},
                 {"loading.start_strain", "`loading.servo` = motion", control_stress},
                 {"loading.start_strain", "needs bonds to solve for", leave_bonds_out},
                 {"loading.start_strain", "without a memory",
                  [](Settings &s) { s.model.bond = dem::ElastoDamagePlastic::Parameters{}; }},
                 {"loading.start_strain", "gravity", [](Settings &s) { s.model.gravity.z = -9.8; }},
                 {"loading.start_strain", "is not below `loading.target_strain`",
                  [](Settings &s) { s.loading.start_strain = 0.01; }},
                 {"loading.start_strain", "the first of `loading.unload_at`", unload_at({1e-3})},
                 {"loading.start_strain", "linear springs",
                  [](Settings &s) { s.platens.contact = PlatenContact::hertz; }}},
                sound, dem::cylinder(0.02, 0.04));
}

TEST(Faults, a_bar_is_bent_by_three_strips) {
  expect_faults(
      {{"ends", "rock on its outermost spheres", [](Settings &s) { s.ends = Ends::as_packed; }},
       {"platens.strip_width", "is bent by strips", [](Settings &s) { s.platens.strip_width = 0; }},
       {"platens.glued", "three point bending", [](Settings &s) { s.platens.glued = true; }},
       {"loading.servo", "three point bending", control_stress},
       {"loading.cell", "three point bending", press},
       {"model.bond", "no bar to bend", leave_bonds_out},
       {"platens.spherical_seat", "three point bending",
        [](Settings &s) { s.platens.spherical_seat = true; }},
       {"platens.span", "no gap between the lower strips",
        [](Settings &s) { s.platens.span = s.platens.strip_width = 0.03; }},
       {"platens.span", "too long for a bar of 0.08 m", [](Settings &s) { s.platens.span = 0.0751; }},
       {"", "", [](Settings &s) { s.platens.span = 0.0749; }}},
      bar(), dem::box(0.08, 0.02, 0.02));
  EXPECT_NE(fault_of(bar(), dem::cylinder(0.02, 0.08)).find("rectangular section"), std::string::npos);
  EXPECT_TRUE(faults(bar(), nullptr).empty()) << "a shape that is not known is not judged";
}

TEST(Faults, a_notch_is_of_a_bar_that_is_bent) {
  const auto of = [](const Settings &settings, double depth, double width) {
    dem::Shape shape = dem::box(0.08, 0.02, 0.02);
    shape.notch = {depth, width};
    return fault_of(settings, shape);
  };
  EXPECT_EQ(of(bar(), 0.0179, 0.054), "");
  EXPECT_EQ(of(bar(), 0.0181, 0.001),
            "specimen.notch_depth leaves less than a tenth of the depth, 0.02 m. Allowed: up to 0.018 m.");
  EXPECT_EQ(of(bar(), 0.005, 0.056),
            "specimen.notch_width reaches over the lower strips. Allowed: below 0.055 m.");
  EXPECT_EQ(of(cylinder(), 0.005, 0),
            "specimen.notch_depth is of bars that are bent in three points. Allowed: 0.");
  EXPECT_EQ(of(cylinder(), 0, 0.001), "");
}

// A bar that is bent has stages without servos, and with the mouth of a notch where it has one.
TEST(Faults, stages_of_a_bar_move_its_strips) {
  const auto of = [](double depth, SideGroup side, SideControl::Mode ask, Until::Reached end) {
    Settings s = bar();
    ask_of_axis(s, side, ask, end);
    dem::Shape shape = dem::box(0.08, 0.02, 0.02);
    shape.notch.depth = depth;
    return fault_of(s, shape);
  };
  using Mode = SideControl::Mode;
  using Reached = Until::Reached;
  const SideGroup axial = SideGroup::axial;
  EXPECT_EQ(of(0, axial, Mode::rate, Reached::strain), "");
  EXPECT_EQ(of(0, axial, Mode::hold, Reached::time), "");
  EXPECT_EQ(of(0.005, axial, Mode::mouth_opening, Reached::mouth_opening), "");
  const auto expect_told = [](const std::string &told, const char *words) {
    EXPECT_NE(told.find(words), std::string::npos) << told;
  };
  for (const Mode ask : {Mode::stress, Mode::free, Mode::circumferential})
    expect_told(of(0.005, axial, ask, Reached::time), "does not go with three point bending. Allowed: rate");
  expect_told(of(0.005, axial, Mode::rate, Reached::circumferential_strain), "looks at a circumference");
  expect_told(of(0, axial, Mode::mouth_opening, Reached::time), "stage_1.axial looks at the mouth");
  expect_told(of(0, axial, Mode::rate, Reached::mouth_opening), "stage_1.until looks at the mouth");
  expect_told(of(0.005, SideGroup::top, Mode::mouth_opening, Reached::time), "led by the opening of a notch");
}

TEST(Faults, one_thing_presses_a_side) {
  Settings pressed = cylinder();
  press(pressed);
  const auto sleeve = [](Settings &s) { s.loading.cell->sleeve.emplace(); };
  const auto bonded = [&](Settings &s) { sleeve(s), s.loading.cell->sleeve->contact.bond.strength = 1; };
  expect_faults({{"loading.cell", "uniaxial strain", put_wall},
                 {"loading.cell", "needs bonds", leave_bonds_out},
                 {"loading.servo", "does not go with `loading.cell`", control_stress},
                 {"", "", sleeve},
                 {"ModelSettings.scheme", "does not go with a sleeve",
                  [&](Settings &s) { sleeve(s), s.model.scheme = dem::Scheme::tchamwa_wielgosz; }},
                 {"sleeve.mass_scaling", "makes the sleeve lighter",
                  [&](Settings &s) { sleeve(s), s.loading.cell->sleeve->mass_scaling = 0.99; }},
                 {"", "", [&](Settings &s) { sleeve(s), s.loading.cell->sleeve->mass_scaling = 1; }},
                 {"sleeve.elements_around", "too few for a tube",
                  [&](Settings &s) { sleeve(s), s.loading.cell->sleeve->elements_around = 7; }},
                 {"", "", [&](Settings &s) { sleeve(s), s.loading.cell->sleeve->elements_around = 8; }},
                 {"sleeve.gap", "nothing that `sleeve.bond_strength` could hold",
                  [&](Settings &s) { bonded(s), s.loading.cell->sleeve->gap = 1e-9; }},
                 {"sleeve.seat_layer", "no sphere flush with the tube",
                  [&](Settings &s) { bonded(s), s.loading.cell->sleeve->seat_layer = 0; }},
                 {"", "", [&](Settings &s) { sleeve(s), s.loading.cell->sleeve->seat_layer = 0; }},
                 {"", "", bonded}},
                pressed, dem::cylinder(0.02, 0.04));
  sleeve(pressed);
  const dem::Shape box = dem::box(0.02, 0.02, 0.04);
  EXPECT_EQ(faults(pressed, &box).front().member, "loading.cell");
  expect_faults({{"platens.left", "`loading.cell`", press},
                 {"platens.left", "`loading.wall`", put_wall},
                 {"platens.left", "`platens.glued`", [](Settings &s) { s.platens.glued = true; }},
                 {"loading.start_strain", "platens on the sides", start_strained}},
                between_sides(), box);
  const dem::Shape round = dem::cylinder(0.02, 0.04);
  EXPECT_NE(faults(between_sides(), &round).front().reason.find("presses a flat side"), std::string::npos);
}

TEST(Faults, stages_take_the_place_of_what_else_is_asked) {
  Settings sound = cylinder();
  ask_of_axis(sound, SideGroup::axial, SideControl::Mode::rate, Until::Reached::strain);
  expect_faults(
      {{"loading.servo", "does not go with stages", control_stress},
       {"loading.start_strain", "does not go with stages", start_strained},
       {"loading.unload_at", "does not go with stages", unload_at({1e-3})},
       {"loading.cell.path", "does not go with stages",
        [](Settings &s) { press(s), s.loading.cell->path = 0.1; }},
       {"loading.tension", "does not go with stages", pull},
       {"loading.stage_1.until", "has no end", [](Settings &s) { s.loading.stages[0].until.clear(); }},
       {"loading.stage_1.axial", "goes nowhere",
        [](Settings &s) { s.loading.stages[0].controls[0].value = 0; }}},
      sound, dem::cylinder(0.02, 0.04));
}

} // namespace
} // namespace platen::coupling::faults_test
