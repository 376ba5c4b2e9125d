// A bar between strips bends as beam theory says, and breaks in the middle. A disc under two line loads has a
// known stress, and splits there.
#include <algorithm>
#include <cmath>

#include "apps/crushed.h"
#include "base/pi.h"
#include "coupling/platen_test.h"
#include "coupling/static_press.h"
#include "dem/measure/stress.h"
#include "dem/packing/growth.h"
#include "tests/coupling/elastic_problem.h"

namespace platen::apps::testing {
namespace {

class Bending : public Crushed {
protected:
  Bending() : Crushed("bent.prm") {}
};

TEST_F(Bending, a_bar_breaks_in_the_middle) {
  const fs::path bar = crushed_once();
  const nlohmann::json s = summary_in(bar);
  EXPECT_EQ(s["test"], "three point bending");
  const double load = s["failure_load_n"], strength = s["strength_pa"];
  EXPECT_NEAR(strength / (1.5 * load * 36e-3 / (12e-3 * 144e-6)), 1, 1e-6); // 3 P L / (2 b d^2)
  // Six spheres deep: above the 4 to 5 MPa that such bonds bear in direct tension, and below three times
  // that.
  EXPECT_GT(strength, 5e6);
  EXPECT_LT(strength, 15e6);
  // A third of the span, a quarter of the bar.
  EXPECT_GT(s["cracks_near_midspan"], 0.8);
  EXPECT_GT(s["broken_tension"], 2 * s["broken_shear"].get<int>());
  EXPECT_LT(s["energy_residual_relative"], 0.02);
  EXPECT_TRUE(s["youngs_modulus_gauge_pa"].is_null());
  for (const char *strain : {"strain_at_peak_platen", "strain_at_peak_gauge"}) {
    EXPECT_TRUE(s[strain].is_null()) << strain;
    EXPECT_EQ(s["validity"][strain][0],
              "closure over the depth is no strain of the material: deflection_at_peak_m");
  }
  const auto of = [&](const char *name) { return column_of(bar / "history.csv", name); };
  const std::string log = content_of(bar / "run.log");
  const auto top = of("axial_stress_top_pa"), sag = of("deflection_m"), moment = of("midspan_moment_n_m");
  EXPECT_NEAR(*std::max_element(top.begin(), top.end()) / strength, 1, 0.05);
  EXPECT_GT(sag.back(), 1.2 * s["deflection_at_peak_m"].get<double>()); // softer once it cracks
  // A bar that slopes leans on inner edges, a strip may press by its own edges: 1 - 2 w / L at the least; the
  // thrust of friction above, at most 0.3 P / 2 at half a depth, takes another tenth.
  EXPECT_GT(s["moment_over_nominal"], 1 - 2 * 3.0 / 36 - 0.1);
  EXPECT_LT(s["moment_over_nominal"], 1 + 2 * 3.0 / 36);
  EXPECT_LT(*std::max_element(moment.begin(), moment.end()), 1.2 * 0.25 * load * 36e-3);
  for (const char *said :
       {"  strength                            ", "  flexural modulus                    "})
    EXPECT_TRUE(contains(log, said));
  EXPECT_FALSE(contains(log, "nan"));
}

TEST_F(Bending, threads_change_no_byte) {
  crush("one", {}, {"-t", "1"});
  crush("two", {}, {"-t", "2"});
  expect_same("one", "two");
}

// Steel, a little softer than rigid: the same bar, and the same load within what a crack more or less makes.
TEST_F(Bending, elastic_strips_bend_as_rigid_ones) {
  const nlohmann::json rigid = summary_in(crushed_once());
  for (const std::string motion : {"explicit", "quasi-static"}) {
    const nlohmann::json s = crush(motion, {"Platens/Kind = deformable", "Platens/Motion = " + motion});
    EXPECT_NEAR(s["flexural_modulus_pa"].get<double>() / rigid["flexural_modulus_pa"].get<double>(), 1, 0.01);
    EXPECT_NEAR(s["strength_pa"].get<double>() / rigid["strength_pa"].get<double>(), 1, 0.1);
    EXPECT_GT(s["cracks_near_midspan"], 0.8);
    EXPECT_LT(s["energy_residual_relative"], 0.01);
    const auto held = column(motion, "body_energy_j");
    EXPECT_GT(*std::max_element(held.begin(), held.end()), 0);
  }
}

// A third of its depth is cut away: less load, and all that is told of a ligament.
TEST_F(Bending, a_notched_bar_breaks_above_its_notch) {
  const Words slow{"Loading/Axial rate = 0.02 m/s", "Loading/Stop at residual = 0.02"},
      cut = with(slow, {"Specimen/Notch depth = 4 mm", "Specimen/Notch width = 2 mm"}),
      kept{"--packings", "kept"};
  const nlohmann::json whole = crush("whole", slow, kept), s = crush("notched", cut, kept);
  // One packing, which is kept whole.
  long packings = 0;
  for (const auto &file : fs::directory_iterator(folder_ / "kept"))
    packings += file.path().extension() == ".csv";
  EXPECT_EQ(packings, 1);
  EXPECT_LT(s["particles"], whole["particles"]);
  EXPECT_LT(s["bonds"], whole["bonds"]);

  const double load = s["failure_load_n"], net = s["net_strength_pa"];
  EXPECT_LT(load, 0.7 * whole["failure_load_n"].get<double>()); // (8 / 12)^2 is 0.44
  EXPECT_NEAR(net / (1.5 * load * 36e-3 / (12e-3 * 64e-6)), 1, 1e-6);
  EXPECT_NEAR(net / s["strength_pa"].get<double>(), 144. / 64, 1e-9);
  EXPECT_GT(s["cmod_at_peak_m"], 0);
  EXPECT_LT(s["load_at_end_over_peak"], 0.02);
  const auto top = column("notched", "axial_stress_top_pa"),
             bottom = column("notched", "axial_stress_bottom_pa"),
             strain = column("notched", "axial_strain_platen"), mouth = column("notched", "cmod_m");
  double work = 0; // N m
  for (std::size_t k = 1; k < top.size(); ++k)
    work += 0.25 * (top[k - 1] + bottom[k - 1] + top[k] + bottom[k]) * (strain[k] - strain[k - 1]) * 12e-3 *
            load / s["strength_pa"].get<double>();
  EXPECT_NEAR(s["work_of_fracture_j"].get<double>() / work, 1, 1e-6);
  EXPECT_NEAR(s["fracture_energy_j_m2"].get<double>() / (work / (12e-3 * 8e-3)), 1, 1e-6);
  EXPECT_GT(s["bond_fracture_energy_j_m2"], 0);
  EXPECT_GT(mouth.back(), 2 * s["cmod_at_peak_m"].get<double>());
  EXPECT_GT(s["cracks_near_midspan"], 0.8);

  EXPECT_TRUE(s["flexural_modulus_pa"].is_null());
  EXPECT_EQ(s["validity"]["flexural_modulus_pa"][0], "the bar has a notch: beam theory knows of none");
  for (const char *of_notch : {"net_strength_pa", "cmod_at_peak_m", "fracture_energy_j_m2"}) {
    EXPECT_TRUE(whole[of_notch].is_null());
    EXPECT_EQ(whole["validity"][of_notch][0],
              "the bar has no notch, above which a ligament breaks: Specimen/Notch depth");
  }
}

// The mouth opens as it is asked, through the fall too, on any number of threads.
TEST_F(Bending, a_stage_leads_a_bar_by_its_mouth) {
  const Words led{"Specimen/Notch depth = 4 mm", "Loading/Stage 1/Axial = cmod rate 20 mm/s",
                  "Loading/Stage 1/Until = cmod 40 um", "Loading/Stop at residual = 0"};
  const nlohmann::json s = crush("whole", led, {"-t", "1"});
  const nlohmann::json stage = s["stages"][0], control = stage["controls"][0];
  EXPECT_EQ(stage["ended_by"], "cmod");
  EXPECT_EQ(control["quantity"], "cmod rate");
  EXPECT_EQ(control["unit"], "m/s");
  EXPECT_NEAR(control["reached"].get<double>() / control["asked"].get<double>(), 1, 0.3);
  EXPECT_EQ(s["peak_reached"], true);
  const auto mouth = column("whole", "cmod_m");
  EXPECT_NEAR(mouth.back(), 40e-6, 2e-6);
  crush("two", led, {"-t", "2"});
  expect_same("whole", "two");
}

TEST_F(Bending, a_bar_packed_upright_is_laid_down) {
  const nlohmann::json s = crush("laid", {"Specimen/Shape = bar", "Specimen/Width x = 12 mm",
                                          "Specimen/Height = 48 mm", "Loading/Target strain = 0.0002"});
  EXPECT_GT(s["largest_stress_pa"], 0);
  EXPECT_TRUE(s["deflection_at_peak_m"].is_null()); // it ends before its peak
  EXPECT_TRUE(contains(content_of(folder_ / "laid/specimen.csv"),
                       "# shape: box width_x_m=0.048 width_y_m=0.012 height_m=0.012"));
  // What was laid down is a box, and read as one.
  crush("box",
        {"Loading/Target strain = 0.0002", "Specimen/Packing = file", "Specimen/File = laid/specimen.csv"});
  for (const char *file : {"specimen.csv", "history.csv"})
    EXPECT_EQ(content_of(folder_ / "laid" / file), content_of(folder_ / "box" / file)) << file;
}

TEST_F(Bending, what_cannot_be_bent_is_refused) {
  const auto refuse = [&](const Words &entries, const std::string &says) {
    const Outcome outcome = run_compress(arguments("no", entries), folder_);
    EXPECT_EQ(outcome.status, 2) << says;
    EXPECT_TRUE(contains(outcome.error, says));
    EXPECT_FALSE(fs::exists(folder_ / "no"));
  };
  refuse({"Platens/Span = 46 mm"}, "Platens/Span = 46 mm is too long for a bar of 0.048 m");
  refuse({"Platens/Span = 2 mm"}, "leaves no gap between the lower strips");
  refuse({"Platens/Strip width = 0"}, "Platens/Strip width");
  refuse({"Platens/Attachment = glued"}, "Platens/Attachment = glued does not go with");
  refuse({"Specimen/Ends = as packed"}, "Specimen/Ends = as packed would let a bar rock");
  refuse({"Platens/Strip width = 0.01 mm"}, "without a sphere");
  refuse({"Specimen/Notch depth = 11 mm"},
         "Specimen/Notch depth = 11 mm leaves less than a tenth of the depth, 0.012 m. Allowed: up to 0.0108 "
         "m.");
  refuse({"Specimen/Notch depth = 1 mm"}, "Specimen/Notch depth = 1 mm has no mouth to measure");
  refuse({"Specimen/Notch depth = 4 mm", "Specimen/Notch width = 40 mm"}, "reaches over the lower strips");
  refuse({"Loading/Stage 1/Axial = cmod rate 20 mm/s", "Loading/Stage 1/Until = time 1 ms"},
         "looks at the mouth of a notch, and there is none");
}

// The same bar stood on end and pressed gives its modulus; then it is bent on two spans.
TEST(bending, an_elastic_bar_bends_like_a_beam) {
  const double length = 60e-3, side = 12e-3;
  const dem::Specimen standing = dem::random_close_packing(dem::box(side, side, length), 0.9e-3, 0.25, 3);
  coupling::PlatenTestSettings settings = coupling::elastic_settings(0.05);
  coupling::PlatenTest pressed(standing, settings);
  const coupling::StaticPress press = coupling::press_statically(pressed, 1e-5);
  const double e = press.youngs_modulus(), nu = press.poisson_ratio();

  settings.platens.strip_width = 3e-3;
  const auto bent = [&](double span) {
    settings.platens.span = span;
    coupling::PlatenTest problem(dem::laid_along_x(standing), settings);
    const dem::Deflection deflection(problem.model.particles, problem.shape(), span);
    const double enough = 2e-4 * span * span / side / 6; // m; a strain of 2e-4 at the skin
    while (deflection(problem.model.particles) < enough)
      problem.advance(16);
    const double sag = deflection(problem.model.particles);
    // Of the moment that the strips really make: their width leaves 0.86 to 0.89 of that of points.
    const double load = 0.5 * (problem.stress_top() + problem.stress_bottom()) * problem.nominal_area();
    const double made = problem.midspan_moment() / (0.25 * load * span);
    EXPECT_GT(made, 1 - 2 * settings.platens.strip_width / span);
    EXPECT_LT(made, 1);
    const double stress = made * load / problem.nominal_area();
    return sag / problem.three_points().deflection(stress, e, nu);
  };
  const double near = bent(36e-3), far = bent(54e-3);
  // Outside the outermost centres nothing bears: with a square section smaller by up to a mean radius all
  // around and the same force per strain, the bar sags by up to (12 / 10.2)^2 = 1.38 times the theory. Found
  // with the programs: 1.06 and 1.08.
  for (const double ratio : {near, far}) {
    EXPECT_GT(ratio, 1);
    EXPECT_LT(ratio, 1.25);
  }
  // Shear is a third of the bending in the short span and a seventh in the long one: beam theory has both, or
  // this ratio would be 0.87.
  EXPECT_NEAR(far / near, 1, 0.05);
}

// The same box by other tests.
TEST_F(Bending, a_box_is_pulled_by_glued_ends) {
  const nlohmann::json s =
      crush("pulled", {"Loading/Test = tension", "Platens/Attachment = glued", "Specimen/Width x = 12 mm",
                       "Specimen/Height = 24 mm", "Loading/Target strain = 0.002"});
  EXPECT_EQ(s["test"], "tension");
  // Direct tension of such bonds: 5 MPa of large specimens, less of a few spheres pulled fast or slow.
  EXPECT_GT(s["strength_pa"], 3e6);
  EXPECT_LT(s["strength_pa"], 8e6);
  // 23 GPa of large specimens of such bonds; one in five of these spheres lies at a corner or an edge.
  EXPECT_NEAR(s["youngs_modulus_gauge_pa"].get<double>() / 20e9, 1, 0.15);
  EXPECT_LT(s["energy_residual_relative"], 0.02);
  EXPECT_TRUE(contains(outcome_.out, "  test                                tension\n"));
  EXPECT_TRUE(contains(outcome_.out, "  strength                            "));
  EXPECT_FALSE(contains(outcome_.out, "nan"));
}

TEST_F(Bending, a_hydrostatic_run_does_not_tell_what_it_has_not_measured) {
  const nlohmann::json s = crush("alike", {"Loading/Test = hydrostatic", "Loading/Confinement = particles",
                                           "Loading/Confining pressure = 2 MPa", "Specimen/Width x = 12 mm"});
  EXPECT_GT(s["bulk_modulus_pa"], 0);
  EXPECT_TRUE(s["strength_pa"].is_null());
  EXPECT_TRUE(contains(outcome_.out, "bulk modulus"));
  for (const char *unsaid : {"nan", "compressive strength", "Young's modulus"})
    EXPECT_FALSE(contains(outcome_.out, unsaid));
}

class Brazilian : public Crushed {
protected:
  Brazilian() : Crushed("split.prm", Frames::as_in_the_scene, "platen-brazilian") {}
};

TEST_F(Brazilian, a_disc_splits_along_its_loaded_diameter) {
  const fs::path disc = crushed_once();
  const nlohmann::json s = summary_in(disc);
  EXPECT_EQ(s["app"], "platen-brazilian");
  // 2 P / (pi D t).
  const double load = s["failure_load_n"];
  EXPECT_NEAR(s["strength_pa"].get<double>() / (2 * load / (pi * 24e-3 * 10e-3)), 1, 1e-12);
  const auto top = column_of(disc / "history.csv", "axial_stress_top_pa"),
             bottom = column_of(disc / "history.csv", "axial_stress_bottom_pa");
  double most = 0; // N, mean of both strips
  for (std::size_t row = 0; row < top.size(); ++row)
    most = std::max(most, 0.5 * (top[row] + bottom[row]) * pi * 12e-3 * 10e-3);
  EXPECT_NEAR(most / load, 1, 1e-12);
  for (const char *figure : {"strength_pa", "failure_load_n", "opening_at_peak_m"})
    EXPECT_EQ(s["validity"][figure], "valid") << figure;
  EXPECT_EQ(s["peak_reached"], true);
  // Below the bond's own strength, 9.5 MPa, far below what the same network bears in compression (40 MPa).
  EXPECT_GT(s["strength_pa"], 1e6);
  EXPECT_LT(s["strength_pa"], 12e6);
  // A quarter of the width, about a third of the area; evenly spread cracks would give .32.
  EXPECT_GT(s["cracks_on_loaded_diameter"], 0.5);
  EXPECT_GT(s["opening_at_peak_m"], 0);
  EXPECT_GT(s["broken_tension"], 2 * s["broken_shear"].get<int>());
  EXPECT_GE(s["fragments"], 2);
  EXPECT_LT(s["energy_residual_relative"], 0.02);
  EXPECT_TRUE(s["youngs_modulus_gauge_pa"].is_null());
  EXPECT_TRUE(s["strain_at_peak_platen"].is_null());
  EXPECT_EQ(s["validity"]["strain_at_peak_platen"][0],
            "closure over the diameter is no strain of the material: opening_at_peak_m");
  const auto opening = column_of(disc / "history.csv", "opening_m");
  EXPECT_GT(opening.back(), 5 * s["opening_at_peak_m"].get<double>()); // the halves part
  // A disc has events, but no cones.
  for (const char *key : {"cone_top", "cone_bottom", "pattern", "final_pattern"})
    EXPECT_TRUE(s.at(key).is_null()) << key;
  EXPECT_EQ(s["acoustic"]["cracks"], s["broken_tension"].get<int>() + s["broken_shear"].get<int>());
}

TEST_F(Brazilian, elastic_strips_split_as_rigid_ones) {
  const nlohmann::json rigid = summary_in(crushed_once());
  for (const std::string motion : {"explicit", "quasi-static"}) {
    const nlohmann::json s = crush(motion, {"Platens/Kind = deformable", "Platens/Motion = " + motion});
    EXPECT_NEAR(s["strength_pa"].get<double>() / rigid["strength_pa"].get<double>(), 1, 0.1) << motion;
    EXPECT_GT(s["cracks_on_loaded_diameter"], 0.5) << motion;
    const double most =
        motion == "explicit" ? 0.004 : 0.02; // of explicit ones .0016 to .0019 on eight packings
    EXPECT_LT(s["energy_residual_relative"], most) << motion;
  }
}

// Strips without inertia come a little behind their loads: .005 to .016 of the work on twelve packings.
TEST_F(Brazilian, the_balance_of_quasi_static_strips_closes_to_their_lag) {
  constexpr int packings = 4;
  double mean = 0;
  for (int seed = 4; seed < 4 + packings; ++seed) {
    const nlohmann::json s =
        crush(std::to_string(seed), {"Platens/Kind = deformable", "Platens/Motion = quasi-static",
                                     "Scene/Seed = " + std::to_string(seed)});
    EXPECT_LT(s["energy_residual_relative"], 0.02) << "seed " << seed;
    mean += s["energy_residual_relative"].get<double>() / packings;
  }
  EXPECT_LT(mean, 0.015);
}

TEST_F(Brazilian, a_disc_from_a_file_is_the_disc_that_was_packed) {
  crush("packed", {"Loading/Target strain = 0.0003"});
  crush("read",
        {"Loading/Target strain = 0.0003", "Specimen/Packing = file", "Specimen/File = packed/specimen.csv"});
  for (const char *file : {"specimen.csv", "history.csv", "cracks.csv"})
    EXPECT_EQ(content_of(folder_ / "packed" / file), content_of(folder_ / "read" / file)) << file;
}

TEST_F(Brazilian, what_cannot_be_split_is_refused) {
  const auto refuse = [&](const std::string &entry, const std::string &says) {
    const Outcome outcome = run_program(command("no", {entry}), folder_);
    EXPECT_EQ(outcome.status, 2) << entry;
    EXPECT_TRUE(contains(outcome.error, says));
    EXPECT_FALSE(fs::exists(folder_ / "no"));
  };
  refuse("Specimen/Shape = box", "cannot be laid on its rim");
  refuse("Loading/Test = tension", "does not go with platen-brazilian");
  refuse("Platens/Strip width = -1 mm", "Platens/Strip width");
}

// Elastic disc between strips: at the centre sigma_x = 2P/(pi D t) in tension, sigma_z = 3 times that in
// compression (Hertz 1883 for line loads).
TEST(brazilian, the_centre_of_an_elastic_disc_has_the_stress_of_the_closed_form) {
  const double radius = 15e-3, thickness = 12e-3;
  const dem::Specimen specimen =
      dem::laid_down(dem::random_close_packing(dem::cylinder(radius, thickness), 1.1e-3, 0.25, 3));
  coupling::PlatenTestSettings settings = coupling::elastic_settings(1);
  settings.platens.strip_width = 2e-3;
  coupling::PlatenTest problem(specimen, settings);
  while (problem.closure_strain() < 1e-4)
    problem.advance(16);
  const dem::Particles &p = problem.model.particles;
  const auto stress = dem::particle_stress(p, problem.model.bonds.get(), nullptr, 1.0);
  double across = 0, along = 0, through = 0, volume = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector3 &x = p.position[i];
    if (std::hypot(x.x, x.z - radius) > 0.35 * radius) continue;
    const double v = 4.0 / 3.0 * pi * std::pow(p.radius[i], 3);
    across += v * stress[i][0], through += v * stress[i][4], along += v * stress[i][8];
    volume += v;
  }
  // Stress of spheres times the share of space that spheres take there.
  const double solid = volume / (pi * std::pow(0.35 * radius, 2) * thickness);
  across *= solid / volume, along *= solid / volume, through *= solid / volume;
  const double closed = 0.5 * (problem.stress_top() + problem.stress_bottom()); // 2 P / (pi D t)
  // Averages over the disc of 0.35 R in the closed form: 0.88 across, 0.96 x 3 along. 15 %: some 400 spheres,
  // a granular network, strips a fifteenth of the diameter wide.
  EXPECT_NEAR(across / (0.88 * closed), 1, 0.15);
  EXPECT_NEAR(along / (-0.96 * 3 * closed), 1, 0.15);
  EXPECT_LT(std::abs(through), 0.3 * closed); // the faces are free
}

} // namespace
} // namespace platen::apps::testing
