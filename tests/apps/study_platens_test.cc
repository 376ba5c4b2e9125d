// Studies of friction and slenderness: what they plan, run and compare.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <random>
#include <thread>

#include "apps/programs.h"
#include "apps/scene/errors.h"
#include "apps/scene/parameters.h"
#include "apps/study/comparisons.h"
#include "apps/study/tables.h"
#include "apps/study_runs.h"

namespace platen::apps::testing {
namespace {

Scene scene_with(const std::vector<std::string> &entries) {
  return read_scene(test_scene("study.prm"), entries, program("study"));
}

StudyPlan plan_with(const std::vector<std::string> &entries, StudyKind kind = StudyKind::friction) {
  std::vector<std::string> all{"Study/Sphere radius list ="};
  all.insert(all.end(), entries.begin(), entries.end());
  return plan_study(kind, scene_with(all), all);
}

Scene led_to(const StudyPlan &plan, std::size_t k, const std::vector<std::string> &entries) {
  return read_scene(test_scene("study.prm"), overrides_of(plan.cases[k], 1, entries), program("compress"));
}

std::vector<std::string> names_of(const StudyPlan &plan) {
  std::vector<std::string> names;
  for (const StudyCase &one : plan.cases)
    names.push_back(one.name);
  return names;
}

TEST(PlatenStudyPlan, platens_run_within_slendernesses_in_the_order_of_the_lists) {
  const std::vector<std::string> entries{"Study/Surface list = dry steel, 0.1, grease",
                                         "Study/Slenderness list = 2, 0.5"};
  const StudyPlan plan = plan_with(entries);
  EXPECT_EQ(names_of(plan),
            (std::vector<std::string>{"dry_steel_slenderness_2", "friction_0.1_slenderness_2",
                                      "grease_slenderness_2", "dry_steel_slenderness_0.5",
                                      "friction_0.1_slenderness_0.5", "grease_slenderness_0.5"}));
  EXPECT_EQ(plan.seeds, (std::vector<unsigned long>{3, 4}));
  EXPECT_EQ(plan.cases[1].surface, "friction 0.1");
  EXPECT_EQ(plan.cases[5].surface, "grease");
  EXPECT_EQ(plan.cases[5].labels, (std::vector<double>{0.0048, 0.0048, 0.5, 0.01, 0.002, 0}));
}

TEST(PlatenStudyPlan, another_height_changes_nothing_else) {
  const std::vector<std::string> entries{"Study/Slenderness list = 0.5, 2, 3"};
  const StudyPlan plan = plan_with(entries, StudyKind::slenderness);
  ASSERT_EQ(plan.cases.size(), 3u);
  EXPECT_EQ(plan.cases[2].surface, "friction 0.3");
  for (std::size_t k = 0; k < 3; ++k) {
    const Scene scene = led_to(plan, k, entries);
    EXPECT_DOUBLE_EQ(scene.specimen.height, (k == 0 ? 0.5 : k == 1 ? 2 : 3) * 0.02); // radius 10 mm
    int others = 0;
    const Scene own = led_to(plan, 1, entries);
    for (const Entry &entry : scene.parameters->entries())
      others += entry.path != "Specimen/Height" && entry.text != own.parameters->at(entry.path).text;
    EXPECT_EQ(others, 0);
  }
  const std::vector<std::string> box{
      "Specimen/Shape = box",     "Specimen/Radius =",          "Specimen/Width x = 30 mm",
      "Specimen/Width y = 20 mm", "Study/Slenderness list = 2", "Platens/Kind = deformable"};
  const StudyPlan boxes = plan_with(box, StudyKind::slenderness);
  EXPECT_DOUBLE_EQ(led_to(boxes, 0, box).specimen.height, 0.04);
  EXPECT_DOUBLE_EQ(led_to(boxes, 0, box).platens.thickness, 0.002); // of the scene's own height, 20 mm
}

TEST(PlatenStudyPlan, heights_and_slendernesses_are_round_numbers) {
  const StudyPlan plan =
      plan_with({"Specimen/Radius = 25 mm", "Study/Slenderness list = 3"}, StudyKind::slenderness);
  EXPECT_EQ(plan.cases[0].overrides.back(), "Specimen/Height = 0.15 m"); // 3 * 0.05 is more, by a bit
  EXPECT_EQ(plan.cases[0].labels[2], 3);
}

TEST(PlatenStudyPlan, a_word_takes_back_what_the_scene_says_of_friction_and_custom_does_not) {
  const std::vector<std::string> entries{"Platens/Friction static = 0.4",
                                         "Platens/Friction dynamic = 0.2",
                                         "Platens/Friction law = slip weakening",
                                         "Platens/Slip length = 1 mm",
                                         "Platens/Attachment = glued",
                                         "Study/Surface list = custom, dry steel, 0.1, glued"};
  const StudyPlan plan = plan_with(entries);
  const auto platens = [&](std::size_t k) { return led_to(plan, k, entries).platens; };
  EXPECT_EQ(platens(0).top.friction_static, 0.4);
  EXPECT_EQ(platens(0).top.weakening.by, dem::Weakening::By::slip);
  EXPECT_EQ(platens(1).top.friction_static, 0.57);
  EXPECT_EQ(platens(1).top.friction_dynamic, 0.57);
  EXPECT_EQ(platens(1).top.weakening.by, dem::Weakening::By::nothing);
  EXPECT_EQ(platens(1).glued, false);
  EXPECT_EQ(platens(2).top.friction_dynamic, 0.1);
  EXPECT_EQ(platens(2).top.weakening.by, dem::Weakening::By::nothing);
  EXPECT_EQ(platens(3).glued, true);
  EXPECT_TRUE(std::isnan(plan.cases[3].labels[0])); // glue has no coefficient
}

TEST(PlatenStudyPlan, sphere_radii_and_pressures_multiply_the_cases) {
  const std::vector<std::string> entries{
      "Study/Surface list = 0, 0.3", "Study/Sphere radius list = 2 mm, 1.4 mm",
      "Study/Confining pressure list = 0, 1 MPa", "Loading/Confinement = particles",
      "Loading/Confining pressure = 3 MPa"};
  const StudyPlan plan = plan_study(StudyKind::friction, scene_with(entries), entries);
  ASSERT_EQ(plan.cases.size(), 8u);
  EXPECT_EQ(plan.cases[0].name, "friction_0_sphere_radius_2_mm_pressure_0_MPa");
  EXPECT_EQ(led_to(plan, 0, entries).loading.confinement, ConfinementKind::none);
  EXPECT_EQ(plan.cases[0].labels.back(), 0);
  EXPECT_EQ(plan.cases[7].name, "friction_0.3_sphere_radius_1.4_mm_pressure_1_MPa");
  EXPECT_DOUBLE_EQ(led_to(plan, 7, entries).loading.cell->pressure, 1e6);
  EXPECT_DOUBLE_EQ(plan.cases[7].labels[4], 0.0014);
}

TEST(PlatenStudyPlan, what_cannot_be_varied_is_refused) {
  const auto refused = [](const std::vector<std::string> &entries, StudyKind kind, const std::string &says) {
    const std::string message =
        message_of<InputError>([&] { plan_study(kind, scene_with(entries), entries); });
    EXPECT_TRUE(contains(message, says)) << message;
  };
  const StudyKind friction = StudyKind::friction, slenderness = StudyKind::slenderness;
  refused({}, friction, "Study/Surface list is not set: nothing is varied.");
  refused({}, slenderness, "Study/Slenderness list is not set: nothing is varied.");
  refused({"Study/Surface list = dry stel"}, friction,
          "holds an item, \"dry stel\", that is not known. Did you mean \"dry steel\"?");
  refused({"Study/Surface list = 7"}, friction, "\"7\", that is out of range");
  refused({"Study/Surface list = 0.3, 0.30"}, friction, "holds 0.3 twice");
  refused({"Study/Surface list = grease, grease"}, friction, "holds grease twice");
  refused({"Study/Slenderness list = 0"}, slenderness, "\"0\", that is out of range");
  refused({"Study/Slenderness list = 1, 2", "Study/Surface list = 0, 0.3"}, slenderness,
          "holds several: a study of slenderness has one kind of platens");
  refused({"Study/Surface list = 0", "Platens/Top/Friction static = 0.4"}, friction,
          "Platens/Top/Friction static = 0.4 contradicts Study/Surface list");
  refused({"Study/Surface list = 0", "Loading/Stop at residual = 0.9"}, friction,
          "Loading/Stop at residual = 0.9 ends a run before it is known to have peaked. Allowed: below 0.8.");
  refused({"Study/Surface list = 0", "Loading/Test = uniaxial strain"}, friction, "Allowed: compression.");
  refused({"Study/Surface list = 0", "Study/Confining pressure list = 1 MPa"}, friction,
          "needs Loading/Confinement = particles, sleeve");
  refused({"Study/Surface list = dry steel, brush"}, friction,
          "leads to brush_sphere_radius_2_mm, which cannot be run");
}

// Raw strengths of the source against the means that it is quoted with.
TEST(Laboratory, ratios_of_cubes_and_prisms_are_those_of_hughes_and_bahramian) {
  const auto mean = [](PlatenEffect effect, bool free_ends, double slenderness) {
    const LaboratoryFigure *f = laboratory_figure(effect, free_ends, slenderness);
    EXPECT_NE(f, nullptr);
    EXPECT_LE(f->low, f->mean);
    EXPECT_LE(f->mean, f->high);
    return f->mean;
  };
  EXPECT_NEAR(mean(PlatenEffect::gain, false, 1), 1.42, 0.005);
  EXPECT_NEAR(mean(PlatenEffect::gain, false, 2.4), 1.08, 0.005);
  EXPECT_NEAR(mean(PlatenEffect::cube_over_prism, false, 1), 1.37, 0.005);
  EXPECT_NEAR(mean(PlatenEffect::cube_over_prism, true, 1), 1.04, 0.005);
  EXPECT_NEAR(mean(PlatenEffect::relative_strength, false, 1), 1.15, 0.005); // ASTM C42: 1 / 0.87
  EXPECT_EQ(laboratory_figure(PlatenEffect::gain, false, 3), nullptr);
  EXPECT_EQ(laboratory_figure(PlatenEffect::gain, true, 1), nullptr);
  EXPECT_NEAR(mean(PlatenEffect::relative_strength, false, 0.75), 1.43,
              0.005); // of flatter cores: 1 / 0.7, 1 / 0.5
  EXPECT_NEAR(mean(PlatenEffect::relative_strength, false, 0.5), 2, 0.005);
  EXPECT_EQ(laboratory_figure(PlatenEffect::relative_strength, true, 0.5), nullptr);
  for (const LaboratoryFigure &f : laboratory_figures())
    EXPECT_EQ(f.source.find("memory"), std::string::npos) << f.source;
}

TEST(Comparisons, ratios_are_taken_seed_by_seed_and_a_failed_run_counts_in_none) {
  const StudyPlan plan = plan_with({"Study/Surface list = 0.57, grease, 0.03, glued",
                                    "Study/Slenderness list = 1, 2, 2.4", "Study/Seeds = 3"});
  std::vector<std::vector<double>> strengths(12, {30, 33, 36});
  strengths[0] = {45, 66, std::nan("")}; // dry, 1
  strengths[4] = {30, 44, 72};           // dry, 2
  const std::vector<Comparison> all = compare(plan, strengths);
  const auto found = [&](PlatenEffect effect, std::size_t of, std::size_t over) {
    for (const Comparison &c : all)
      if (c.effect == effect && c.of == of) {
        EXPECT_EQ(c.over, over);
        return c;
      }
    ADD_FAILURE() << word(effect) << " of " << of;
    return Comparison{effect, of, over, {}, nullptr};
  };
  // Over grease, which has less friction than Teflon.
  const Comparison gain = found(PlatenEffect::gain, 0, 1);
  EXPECT_EQ(gain.ratio.count(), 2u);
  EXPECT_DOUBLE_EQ(gain.ratio.mean(), 1.75);                  // 45/30, 66/33
  EXPECT_DOUBLE_EQ(gain.ratio.deviation(), std::sqrt(0.125)); // about 1.5 and 2
  ASSERT_NE(gain.laboratory, nullptr);
  EXPECT_NEAR(gain.laboratory->mean, 1.42, 0.005);
  const Comparison relative = found(PlatenEffect::relative_strength, 0, 4);
  EXPECT_DOUBLE_EQ(relative.ratio.mean(), 1.5); // 45/30, 66/44
  found(PlatenEffect::cube_over_prism, 0, 8);   // 2.4 is nearer to the laboratory's 2.39 than 2
  found(PlatenEffect::gain, 3, 1);              // glued, which has no coefficient
  EXPECT_EQ(found(PlatenEffect::gain, 2, 1).laboratory, nullptr);              // Teflon: nobody says
  EXPECT_EQ(found(PlatenEffect::relative_strength, 1, 5).laboratory, nullptr); // nor of short greased ones
  const LaboratoryFigure *free_ends = found(PlatenEffect::cube_over_prism, 1, 9).laboratory;
  ASSERT_NE(free_ends, nullptr);
  EXPECT_TRUE(free_ends->free_ends);
  const bool grease_gains = std::any_of(all.begin(), all.end(), [](const Comparison &c) {
    return c.effect == PlatenEffect::gain && c.of == 1;
  });
  EXPECT_FALSE(grease_gains);
  const Json written = json_of(plan, all);
  EXPECT_EQ(written[0]["case"], plan.cases[all[0].of].name);
  EXPECT_NE(text_of(plan, all).find("Hughes and Bahramian 1967"), std::string::npos);
}

// Of a material that nobody calibrated for platens, or for short specimens, a study has strengths and no
// ratios.
TEST(Comparisons, need_bonds_that_are_calibrated_for_them) {
  const StudyPlan plan = plan_with({"Study/Surface list = 0.57, grease", "Study/Slenderness list = 1, 2"});
  const std::vector<std::vector<double>> strengths{{60, 60}, {30, 30}, {40, 40}, {30, 30}};
  using Figure = CalibratedFigure;
  const auto of = [&](const std::vector<Figure> &figures) {
    std::map<PlatenEffect, std::string> reasons;
    for (const Comparison &c : compare(plan, strengths, {std::nullopt, figures})) {
      EXPECT_EQ(c.ratio.count(), c.reason.empty() ? 2u : 0u);
      reasons[c.effect] = c.reason;
    }
    return reasons;
  };
  const auto gain = PlatenEffect::gain, relative = PlatenEffect::relative_strength;
  EXPECT_EQ(of({})[gain], "");
  EXPECT_EQ(of({})[relative], "");
  auto reasons = of({Figure::compression, Figure::slenderness});
  EXPECT_EQ(
      reasons[gain],
      "the bonds are not calibrated for it: Bond/Calibrated figures = compression, slenderness, without "
      "friction");
  EXPECT_EQ(reasons[relative], "");
  reasons = of({Figure::friction});
  EXPECT_EQ(reasons[gain], "");
  EXPECT_NE(reasons[relative], "");
  const std::vector<Comparison> none = compare(plan, strengths, {std::nullopt, {Figure::compression}});
  EXPECT_TRUE(json_of(plan, none)[0]["mean"].is_null());
  EXPECT_EQ(json_of(plan, none)[0]["reason"], none[0].reason);
  EXPECT_FALSE(json_of(plan, none)[0].contains("verdict"));
  EXPECT_NE(text_of(plan, none).find("none: the bonds are not calibrated for it"), std::string::npos);
  EXPECT_EQ(text_of(plan, none).find("laboratory"), std::string::npos);
}

TEST(Comparisons, outside_the_range_of_the_laboratory_are_told_as_outside) {
  const StudyPlan plan = plan_with({"Study/Surface list = 0.57, grease", "Study/Slenderness list = 1, 2"});
  const auto with = [&](double cube, double slender) {
    return compare(plan, {{cube, cube}, {30, 30}, {slender, slender}, {30, 30}});
  };
  const auto gain = [](const std::vector<Comparison> &all, std::size_t of) {
    return *std::find_if(all.begin(), all.end(),
                         [&](const Comparison &c) { return c.effect == PlatenEffect::gain && c.of == of; });
  };
  // Mixes of 1967: 1.206 to 1.595 of cubes; 1.030 to 1.108 of prisms of 2.39, the nearest to 2.
  for (const auto &[cube, outside] : {std::pair{36.1, true}, {36.3, false}, {47.7, false}, {47.9, true}})
    EXPECT_EQ(gain(with(cube, 32), 0).outside(), outside) << cube;
  for (const auto &[slender, outside] : {std::pair{30.8, true}, {31, false}, {33.2, false}, {33.3, true}})
    EXPECT_EQ(gain(with(40, slender), 2).outside(), outside) << slender;
  EXPECT_NE(gain(with(40, 32), 2).laboratory->source.find("prisms of 2.39"), std::string::npos);
  // A factor without scatter, 1/.87: 5 % to both sides.
  const auto relative = [&](double cube) {
    const std::vector<Comparison> all = with(cube, 40);
    return std::find_if(
               all.begin(), all.end(),
               [](const Comparison &c) { return c.effect == PlatenEffect::relative_strength && c.of == 0; })
        ->outside();
  };
  EXPECT_TRUE(relative(43.6));
  EXPECT_FALSE(relative(43.8));
  EXPECT_FALSE(relative(48.2));
  EXPECT_TRUE(relative(48.4));
  const std::vector<Comparison> far = with(60, 32);
  EXPECT_EQ(json_of(plan, far)[0]["verdict"], "outside");
  EXPECT_NE(
      text_of(plan, far).find("outside the laboratory's 1.42 (1.21 ... 1.59), Hughes and Bahramian 1967"),
      std::string::npos)
      << text_of(plan, far);
  EXPECT_EQ(json_of(plan, with(42, 32))[0]["verdict"], "within");
  const std::vector<Comparison> failed = with(std::nan(""), 32);
  EXPECT_FALSE(gain(failed, 0).outside());
  EXPECT_FALSE(json_of(plan, failed)[0].contains("verdict"));
}

// Three platens and two heights on one seed: six runs of a tenth of a second.
const std::vector<std::string> small{"--quiet",
                                     "-s",
                                     "Study/Surface list = dry steel, 0.1, grease",
                                     "-s",
                                     "Study/Slenderness list = 1, 2",
                                     "-s",
                                     "Study/Sphere radius list =",
                                     "-s",
                                     "Study/Seeds = 1",
                                     "-s",
                                     "Loading/Target strain = 0.03"};

std::vector<std::string> also(std::vector<std::string> options, const std::vector<std::string> &more) {
  options.insert(options.end(), more.begin(), more.end());
  return options;
}

TEST_F(Study, of_friction_has_a_row_for_each_run_and_compares_their_strengths) {
  const Outcome outcome = run("a", also(small, {"-t", "2"}), "friction");
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  const fs::path csv = folder_ / "a/study.csv";
  EXPECT_EQ(words_in(csv, "surface"), (std::vector<std::string>{"dry steel", "friction 0.1", "grease",
                                                                "dry steel", "friction 0.1", "grease"}));
  EXPECT_EQ(column_of(csv, "height_m"), (std::vector<double>{0.02, 0.02, 0.02, 0.04, 0.04, 0.04}));
  const std::vector<double> strength = column_of(csv, "strength_pa"), bonds = column_of(csv, "bonds");
  EXPECT_EQ(bonds[0], bonds[2]); // the same packing
  EXPECT_GT(bonds[3], 1.8 * bonds[0]);
  EXPECT_GT(strength[0], strength[2]); // platens hold a cube together
  const auto comparisons = json("a")["comparisons"];
  bool found = false;
  for (const auto &c : comparisons)
    if (c["effect"] == "gain over free ends" && c["case"] == "dry_steel_slenderness_1") {
      found = true;
      EXPECT_EQ(c["over"], "grease_slenderness_1");
      EXPECT_DOUBLE_EQ(c["mean"].get<double>(), strength[0] / strength[2]);
      EXPECT_NEAR(c["laboratory"]["mean"].get<double>(), 1.42, 0.005);
    }
  EXPECT_TRUE(found);
  EXPECT_GE(json("a")["laboratory"].size(), 10u);
  const fs::path ratios = folder_ / "a/comparisons.csv";
  ASSERT_EQ(words_in(ratios, "effect").size(), comparisons.size());
  for (std::size_t k = 0; k < comparisons.size(); ++k) {
    EXPECT_EQ(words_in(ratios, "case")[k], comparisons[k]["case"]);
    EXPECT_EQ(column_of(ratios, "mean")[k], comparisons[k]["mean"].get<double>());
    EXPECT_EQ(words_in(ratios, "verdict")[k], comparisons[k].value("verdict", ""));
    if (!comparisons[k]["laboratory"].is_null()) {
      EXPECT_EQ(column_of(ratios, "laboratory_high")[k], comparisons[k]["laboratory"]["high"].get<double>());
    }
  }
  EXPECT_EQ(lines_in(folder_ / "a/costs.csv"), 7);

  ASSERT_EQ(run("one", small, "friction").status, 0);
  EXPECT_EQ(table("one"), table("a"));
  EXPECT_EQ(content_of(folder_ / "one/study.json"), content_of(folder_ / "a/study.json"));
}

TEST_F(Study, of_one_run_gives_it_all_threads) {
  const std::vector<std::string> single =
      also(small, {"-t", "3", "-s", "Study/Surface list = 0.3", "-s", "Study/Slenderness list = 1"});
  ASSERT_EQ(run("a", single, "friction").status, 0);
  EXPECT_EQ(summary_in(folder_ / "a/runs/friction_0.3_slenderness_1_seed_3")["threads"],
            std::min(3u, std::thread::hardware_concurrency())); // no more than there are cores
}

// Killed without a word again and again, at once taken up: the runs that were under way end on their own, and
// the next study waits for them.
TEST_F(Study, of_friction_killed_at_random_comes_to_the_same_table) {
  const std::vector<std::string> three = also(small, {"-s", "Study/Slenderness list = 1"});
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(run("whole", three, "friction").status, 0);
  const double whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> wait(0.01 * whole, 0.3 * whole); // s
  int kills = 0;
  bool begun = false;
  for (int round = 0; round < 10; ++round) {
    const std::vector<std::string> options = also(three, {"-t", "2", begun ? "--resume" : "--overwrite"});
    Program program(command("killed", options, "friction"), folder_);
    // The first two are killed at any time, the others once there is something to take up: a busy machine may
    // need longer to start than the longest wait.
    while (round >= 2 && !fs::exists(folder_ / "killed/study.json") && program.running())
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    std::this_thread::sleep_for(std::chrono::duration<double>(wait(engine)));
    if (program.running()) {
      program.send(SIGKILL);
      ++kills;
    }
    const int status = program.wait();
    begun = begun || fs::exists(folder_ / "killed/study.json");
    if (status == 0) break;
    ASSERT_EQ(status, -SIGKILL) << content_of(folder_ / "error.txt");
  }
  EXPECT_GE(kills, 2);
  ASSERT_TRUE(begun);
  EXPECT_EQ(run("killed", also(three, {"--resume"}), "friction").status, 0);
  EXPECT_EQ(table("killed"), table("whole"));
  EXPECT_EQ(content_of(folder_ / "killed/study.json"), content_of(folder_ / "whole/study.json"));
}

// A fall by 2 % is a peak; damage is measured at a fall to 0.8, which may be beyond the target strain.
TEST(StudyTables, a_run_has_peaked_where_its_summary_says_so) {
  EXPECT_TRUE(StudyTables::peaked(Json{{"peak_reached", true}, {"middle_damage", nullptr}}));
  EXPECT_FALSE(StudyTables::peaked(Json{{"peak_reached", false}, {"middle_damage", 0.5}}));
  EXPECT_FALSE(StudyTables::peaked(Json{{"peak_reached", nullptr}}));
  EXPECT_FALSE(StudyTables::peaked(Json())); // of a run that failed
}

TEST_F(Study, of_friction_compares_nothing_that_never_peaked) {
  const Outcome outcome =
      run("a",
          also(small, {"-s", "Study/Slenderness list =", "-s", "Study/Surface list = 0.3, grease", "-s",
                       "Loading/Target strain = 2e-4"}),
          "friction");
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  const std::string log = content_of(folder_ / "a/run.log");
  EXPECT_TRUE(contains(log, "grease_seed_3: it reached no peak"));
  EXPECT_FALSE(contains(log, "nan")) << log;
  EXPECT_EQ(json("a")["cases"][0]["without_peak"], 1);
  EXPECT_TRUE(json("a")["cases"][0]["strength_pa"]["mean"].is_null());
  EXPECT_TRUE(json("a")["comparisons"][0]["mean"].is_null());
}

TEST_F(Study, of_friction_survives_a_case_that_fails) {
  // One step for all, above the limit of the smaller spheres.
  const Outcome outcome =
      run("a",
          also(small, {"-s", "Study/Slenderness list =", "-s", "Study/Surface list = 0.3, grease", "-s",
                       "Integration/Time step = 2.4e-7 s", "-s", "Study/Sphere radius list = 1.4 mm, 2 mm"}),
          "friction");
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_EQ(words_in(folder_ / "a/study.csv", "status"),
            (std::vector<std::string>{"failed", "failed", "done", "done"}));
  const auto comparisons = json("a")["comparisons"];
  ASSERT_EQ(comparisons.size(), 2u);
  EXPECT_TRUE(comparisons[0]["mean"].is_null());
  EXPECT_EQ(comparisons[0]["runs"], 0);
  EXPECT_GT(comparisons[1]["mean"], 0);
  EXPECT_EQ(json("a")["cases"][0]["without_peak"], 0);
}

} // namespace
} // namespace platen::apps::testing
