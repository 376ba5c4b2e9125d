// Three-point bending: a bar between strips bends as beam theory says, and breaks in the middle.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cmath>

#include "apps/program.h"
#include "apps/scratch_folder.h"
#include "coupling/platen_test.h"
#include "coupling/static_press.h"
#include "dem/packing/growth.h"
#include "tests/coupling/elastic_problem.h"

namespace platen::apps::testing {
namespace {

class Bending : public ScratchFolder {
protected:
  std::vector<std::string> arguments(const std::string &name, const std::vector<std::string> &entries,
                                     const std::vector<std::string> &options = {}) const {
    std::vector<std::string> all{test_scene("bent.prm"), "-o", name};
    for (const std::string &entry : entries)
      all.insert(all.end(), {"-s", entry});
    all.insert(all.end(), options.begin(), options.end());
    return all;
  }
  nlohmann::json bend(const std::string &name, const std::vector<std::string> &entries,
                      const std::vector<std::string> &options = {"--quiet"}) {
    const Outcome outcome = run_compress(arguments(name, entries, options), folder_);
    EXPECT_EQ(outcome.status, 0) << outcome.error;
    screen_ = outcome.out;
    return summary_in(folder_ / name);
  }
  std::vector<double> column(const std::string &name, const std::string &column) const {
    return column_of(folder_ / name / "history.csv", column);
  }
  std::string screen_;
};

TEST_F(Bending, a_bar_breaks_in_the_middle) {
  const nlohmann::json s = bend("bar", {}, {});
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
  const auto top = column("bar", "axial_stress_top_pa"), sag = column("bar", "deflection_m"),
             moment = column("bar", "midspan_moment_n_m");
  EXPECT_NEAR(*std::max_element(top.begin(), top.end()) / strength, 1, 0.05);
  EXPECT_GT(sag.back(), 1.2 * s["deflection_at_peak_m"].get<double>()); // softer once it cracks
  // A bar that slopes leans on inner edges, a strip may press by its own edges: 1 - 2 w / L at the least; the
  // thrust of friction above, at most 0.3 P / 2 at half a depth, takes another tenth.
  EXPECT_GT(s["moment_over_nominal"], 1 - 2 * 3.0 / 36 - 0.1);
  EXPECT_LT(s["moment_over_nominal"], 1 + 2 * 3.0 / 36);
  EXPECT_LT(*std::max_element(moment.begin(), moment.end()), 1.2 * 0.25 * load * 36e-3);
  for (const char *said :
       {"  strength                            ", "  flexural modulus                    "})
    EXPECT_TRUE(contains(screen_, said)) << screen_;
  EXPECT_FALSE(contains(screen_, "nan")) << screen_;
}

// Steel, a little softer than rigid: the same bar, and the same load within what a crack more or less makes.
TEST_F(Bending, elastic_strips_bend_as_rigid_ones) {
  const nlohmann::json rigid = bend("rigid", {});
  for (const std::string motion : {"explicit", "quasi-static"}) {
    const nlohmann::json s = bend(motion, {"Platens/Kind = deformable", "Platens/Motion = " + motion});
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
  const std::vector<std::string> slow{"Loading/Axial rate = 0.02 m/s", "Loading/Stop at residual = 0.02"},
      kept{"--quiet", "--packings", "kept"};
  std::vector<std::string> cut = slow;
  cut.insert(cut.end(), {"Specimen/Notch depth = 4 mm", "Specimen/Notch width = 2 mm"});
  const nlohmann::json whole = bend("whole", slow, kept), s = bend("notched", cut, kept);
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

// The mouth opens as it is asked, through the fall too, on any number of threads and after a stop.
TEST_F(Bending, a_stage_leads_a_bar_by_its_mouth) {
  const std::vector<std::string> led{"Specimen/Notch depth = 4 mm",
                                     "Loading/Stage 1/Axial = cmod rate 20 mm/s",
                                     "Loading/Stage 1/Until = cmod 40 um", "Loading/Stop at residual = 0"};
  const nlohmann::json s = bend("whole", led, {"--quiet", "-t", "1"});
  const nlohmann::json stage = s["stages"][0], control = stage["controls"][0];
  EXPECT_EQ(stage["ended_by"], "cmod");
  EXPECT_EQ(control["quantity"], "cmod rate");
  EXPECT_EQ(control["unit"], "m/s");
  EXPECT_NEAR(control["reached"].get<double>() / control["asked"].get<double>(), 1, 0.3);
  EXPECT_EQ(s["peak_reached"], true);
  const auto mouth = column("whole", "cmod_m");
  EXPECT_NEAR(mouth.back(), 40e-6, 2e-6);
  const auto whole = results_in(folder_ / "whole");
  bend("two", led, {"--quiet", "-t", "2"});
  EXPECT_EQ(difference(whole, results_in(folder_ / "two")), "");
  const long rows = lines_in(folder_ / "whole/history.csv");
  {
    Program program(compress_command(arguments("stopped", led, {"--quiet", "-t", "2"})), folder_);
    EXPECT_TRUE(program.wait_until([&] { return lines_in(folder_ / "stopped/history.csv") >= rows / 2; }));
    program.send(SIGTERM);
    EXPECT_EQ(program.wait(), 143);
  }
  bend("stopped", led, {"--quiet", "-t", "1", "--resume"});
  EXPECT_EQ(difference(whole, results_in(folder_ / "stopped")), "");
}

TEST_F(Bending, a_bar_packed_upright_is_laid_down) {
  const nlohmann::json s = bend("laid", {"Specimen/Shape = bar", "Specimen/Width x = 12 mm",
                                         "Specimen/Height = 48 mm", "Loading/Target strain = 0.0002"});
  EXPECT_GT(s["largest_stress_pa"], 0);
  EXPECT_TRUE(s["deflection_at_peak_m"].is_null()); // it ends before its peak
  EXPECT_TRUE(contains(content_of(folder_ / "laid/specimen.csv"),
                       "# shape: box width_x_m=0.048 width_y_m=0.012 height_m=0.012"));
  // What was laid down is a box, and read as one.
  bend("box",
       {"Loading/Target strain = 0.0002", "Specimen/Packing = file", "Specimen/File = laid/specimen.csv"});
  for (const char *file : {"specimen.csv", "history.csv"})
    EXPECT_EQ(content_of(folder_ / "laid" / file), content_of(folder_ / "box" / file)) << file;
}

// Threads, a stop before the peak and another behind it.
TEST_F(Bending, threads_and_stops_change_no_byte) {
  bend("whole", {}, {"--quiet", "-t", "1"});
  const auto whole = results_in(folder_ / "whole");
  bend("two", {}, {"--quiet", "-t", "2"});
  EXPECT_EQ(difference(whole, results_in(folder_ / "two")), "");
  const long rows = lines_in(folder_ / "whole/history.csv");
  std::vector<std::string> options{"--quiet", "-t", "2"};
  for (const long at : {rows / 4, 3 * rows / 4}) {
    Program program(compress_command(arguments("stopped", {}, options)), folder_);
    EXPECT_TRUE(program.wait_until([&] { return lines_in(folder_ / "stopped/history.csv") >= at; }));
    program.send(SIGTERM);
    EXPECT_EQ(program.wait(), 143);
    options = {"--quiet", "-t", "1", "--resume"};
  }
  const nlohmann::json s = bend("stopped", {}, options), before = summary_in(folder_ / "whole");
  EXPECT_EQ(difference(whole, results_in(folder_ / "stopped")), "");
  for (const char *key : {"strength_pa", "deflection_at_peak_m", "flexural_modulus_pa", "moment_over_nominal",
                          "cracks_near_midspan", "energy_residual_relative"})
    EXPECT_EQ(s[key], before[key]) << key;
}

TEST_F(Bending, what_cannot_be_bent_is_refused) {
  const auto refuse = [&](const std::vector<std::string> &entries, const std::string &says) {
    const Outcome outcome = run_compress(arguments("no", entries), folder_);
    EXPECT_EQ(outcome.status, 2) << says;
    EXPECT_TRUE(contains(outcome.error, says)) << outcome.error;
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
      bend("pulled",
           {"Loading/Test = tension", "Platens/Attachment = glued", "Specimen/Width x = 12 mm",
            "Specimen/Height = 24 mm", "Loading/Target strain = 0.002"},
           {});
  EXPECT_EQ(s["test"], "tension");
  // Direct tension of such bonds: 5 MPa of large specimens, less of a few spheres pulled fast or slow.
  EXPECT_GT(s["strength_pa"], 3e6);
  EXPECT_LT(s["strength_pa"], 8e6);
  // 23 GPa of large specimens of such bonds; one in five of these spheres lies at a corner or an edge.
  EXPECT_NEAR(s["youngs_modulus_gauge_pa"].get<double>() / 20e9, 1, 0.15);
  EXPECT_LT(s["energy_residual_relative"], 0.02);
  EXPECT_TRUE(contains(screen_, "  test                                tension\n")) << screen_;
  EXPECT_TRUE(contains(screen_, "  strength                            ")) << screen_;
  EXPECT_FALSE(contains(screen_, "nan")) << screen_;
}

TEST_F(Bending, a_hydrostatic_run_does_not_tell_what_it_has_not_measured) {
  const nlohmann::json s = bend("alike",
                                {"Loading/Test = hydrostatic", "Loading/Confinement = particles",
                                 "Loading/Confining pressure = 2 MPa", "Specimen/Width x = 12 mm"},
                                {});
  EXPECT_GT(s["bulk_modulus_pa"], 0);
  EXPECT_TRUE(s["strength_pa"].is_null());
  EXPECT_TRUE(contains(screen_, "bulk modulus")) << screen_;
  for (const char *unsaid : {"nan", "compressive strength", "Young's modulus"})
    EXPECT_FALSE(contains(screen_, unsaid)) << screen_;
}

} // namespace
} // namespace platen::apps::testing
