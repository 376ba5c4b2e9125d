// Studies of friction and slenderness: what they plan, run and compare.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <thread>

#include "apps/scene/parameters.h"
#include "apps/study/comparisons.h"
#include "apps/study/tables.h"
#include "apps/study_runs.h"

namespace platen::apps::testing {
namespace {

StudyPlan platen_plan(const Words &entries, StudyKind kind = StudyKind::friction) {
  return plan_of(kind, with({no_radii}, entries));
}

TEST(PlatenStudyPlan, platens_run_within_slendernesses_in_the_order_of_the_lists) {
  const Words entries{"Study/Surface list = dry steel, 0.1, grease", "Study/Slenderness list = 2, 0.5"};
  const StudyPlan plan = platen_plan(entries);
  EXPECT_EQ(names_of(plan),
            (Words{"dry_steel_slenderness_2", "friction_0.1_slenderness_2", "grease_slenderness_2",
                   "dry_steel_slenderness_0.5", "friction_0.1_slenderness_0.5", "grease_slenderness_0.5"}));
  EXPECT_EQ(plan.seeds, (std::vector<unsigned long>{3, 4}));
  EXPECT_EQ(plan.cases[1].surface, "friction 0.1");
  EXPECT_EQ(plan.cases[5].surface, "grease");
  EXPECT_EQ(plan.cases[5].labels, (std::vector<double>{0.0048, 0.0048, 0.5, 0.01, 0.002, 0}));
}

TEST(PlatenStudyPlan, another_height_changes_nothing_else) {
  const Words entries{"Study/Slenderness list = 0.5, 2, 3"};
  const StudyPlan plan = platen_plan(entries, StudyKind::slenderness);
  ASSERT_EQ(plan.cases.size(), 3u);
  EXPECT_EQ(plan.cases[2].surface, "friction 0.3");
  for (std::size_t k = 0; k < 3; ++k) {
    const Scene scene = led_to(plan.cases[k], 1, entries);
    EXPECT_DOUBLE_EQ(scene.specimen.height, (k == 0 ? 0.5 : k == 1 ? 2 : 3) * 0.02); // radius 10 mm
    int others = 0;
    const Scene own = led_to(plan.cases[1], 1, entries);
    for (const Entry &entry : scene.parameters->entries())
      others += entry.path != "Specimen/Height" && entry.text != own.parameters->at(entry.path).text;
    EXPECT_EQ(others, 0);
  }
  const Words box{"Specimen/Shape = box",     "Specimen/Radius =",          "Specimen/Width x = 30 mm",
                  "Specimen/Width y = 20 mm", "Study/Slenderness list = 2", "Platens/Kind = deformable"};
  const StudyPlan boxes = platen_plan(box, StudyKind::slenderness);
  EXPECT_DOUBLE_EQ(led_to(boxes.cases[0], 1, box).specimen.height, 0.04);
  EXPECT_DOUBLE_EQ(led_to(boxes.cases[0], 1, box).platens.thickness,
                   0.002); // of the scene's own height, 20 mm
}

TEST(PlatenStudyPlan, heights_and_slendernesses_are_round_numbers) {
  const StudyPlan plan =
      platen_plan({"Specimen/Radius = 25 mm", "Study/Slenderness list = 3"}, StudyKind::slenderness);
  EXPECT_EQ(plan.cases[0].overrides.back(), "Specimen/Height = 0.15 m"); // 3 * 0.05 is more, by a bit
  EXPECT_EQ(plan.cases[0].labels[2], 3);
}

TEST(PlatenStudyPlan, a_word_takes_back_what_the_scene_says_of_friction_and_custom_does_not) {
  const Words entries{"Platens/Friction static = 0.4",
                      "Platens/Friction dynamic = 0.2",
                      "Platens/Friction law = slip weakening",
                      "Platens/Slip length = 1 mm",
                      "Platens/Attachment = glued",
                      "Study/Surface list = custom, dry steel, 0.1, glued"};
  const StudyPlan plan = platen_plan(entries);
  const auto platens = [&](std::size_t k) { return led_to(plan.cases[k], 1, entries).platens; };
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
  const Words entries{"Study/Surface list = 0, 0.3", "Study/Sphere radius list = 2 mm, 1.4 mm",
                      "Study/Confining pressure list = 0, 1 MPa", "Loading/Confinement = particles",
                      "Loading/Confining pressure = 3 MPa"};
  const StudyPlan plan = plan_of(StudyKind::friction, entries);
  ASSERT_EQ(plan.cases.size(), 8u);
  EXPECT_EQ(plan.cases[0].name, "friction_0_sphere_radius_2_mm_pressure_0_MPa");
  EXPECT_EQ(led_to(plan.cases[0], 1, entries).loading.confinement, ConfinementKind::none);
  EXPECT_EQ(plan.cases[0].labels.back(), 0);
  EXPECT_EQ(plan.cases[7].name, "friction_0.3_sphere_radius_1.4_mm_pressure_1_MPa");
  EXPECT_DOUBLE_EQ(led_to(plan.cases[7], 1, entries).loading.cell->pressure, 1e6);
  EXPECT_DOUBLE_EQ(plan.cases[7].labels[4], 0.0014);
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
  const StudyPlan plan = platen_plan({"Study/Surface list = 0.57, grease, 0.03, glued",
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
    return Comparison{effect, of, over};
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
  const StudyPlan plan = platen_plan({"Study/Surface list = 0.57, grease", "Study/Slenderness list = 1, 2"});
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
  EXPECT_TRUE(std::isnan(json_of(plan, none)[0]["mean"].get<double>()));
  EXPECT_EQ(json_of(plan, none)[0]["reason"], none[0].reason);
  EXPECT_FALSE(json_of(plan, none)[0].contains("verdict"));
  EXPECT_NE(text_of(plan, none).find("none: the bonds are not calibrated for it"), std::string::npos);
  EXPECT_EQ(text_of(plan, none).find("laboratory"), std::string::npos);
}

TEST(Comparisons, outside_the_range_of_the_laboratory_are_told_as_outside) {
  const StudyPlan plan = platen_plan({"Study/Surface list = 0.57, grease", "Study/Slenderness list = 1, 2"});
  const auto bearing = [&](double cube, double slender) {
    return compare(plan, {{cube, cube}, {30, 30}, {slender, slender}, {30, 30}});
  };
  const auto found = [](const std::vector<Comparison> &all, PlatenEffect effect, std::size_t of) {
    return *std::find_if(all.begin(), all.end(),
                         [&](const Comparison &c) { return c.effect == effect && c.of == of; });
  };
  const auto gain = [&](const std::vector<Comparison> &all, std::size_t of) {
    return found(all, PlatenEffect::gain, of);
  };
  // Mixes of 1967: 1.206 to 1.595 of cubes; 1.030 to 1.108 of prisms of 2.39, the nearest to 2.
  for (const auto &[cube, outside] : {std::pair{36.1, true}, {36.3, false}, {47.7, false}, {47.9, true}})
    EXPECT_STREQ(gain(bearing(cube, 32), 0).verdict(), outside ? "outside" : "within") << cube;
  for (const auto &[slender, outside] : {std::pair{30.8, true}, {31, false}, {33.2, false}, {33.3, true}})
    EXPECT_STREQ(gain(bearing(40, slender), 2).verdict(), outside ? "outside" : "within") << slender;
  EXPECT_NE(gain(bearing(40, 32), 2).laboratory->source.find("prisms of 2.39"), std::string::npos);
  // A factor without scatter, 1/.87: 5 % to both sides.
  for (const auto &[cube, outside] : {std::pair{43.6, true}, {43.8, false}, {48.2, false}, {48.4, true}})
    EXPECT_STREQ(found(bearing(cube, 40), PlatenEffect::relative_strength, 0).verdict(),
                 outside ? "outside" : "within")
        << cube;
  const std::vector<Comparison> far = bearing(60, 32);
  EXPECT_EQ(json_of(plan, far)[0]["verdict"], "outside");
  EXPECT_NE(
      text_of(plan, far).find("outside the laboratory's 1.42 (1.21 ... 1.59), Hughes and Bahramian 1967"),
      std::string::npos)
      << text_of(plan, far);
  EXPECT_EQ(json_of(plan, bearing(42, 32))[0]["verdict"], "within");
  const std::vector<Comparison> failed = bearing(std::nan(""), 32);
  EXPECT_STREQ(gain(failed, 0).verdict(), "");
  EXPECT_FALSE(json_of(plan, failed)[0].contains("verdict"));
}

// Three platens and two heights on one seed: six runs of a tenth of a second.
const Words small_platens =
    set({"Study/Surface list = dry steel, 0.1, grease", "Study/Slenderness list = 1, 2", no_radii,
         "Study/Seeds = 1", "Loading/Target strain = 0.03"});
// One height, and two platens.
const Words two = set({"Study/Surface list = 0.3, grease", "Study/Seeds = 1"});

TEST_F(Study, of_friction_has_a_row_for_each_run_and_compares_their_strengths) {
  const Outcome outcome = run("a", with(small_platens, {"-t", "2"}), "friction");
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  const fs::path csv = folder_ / "a/study.csv";
  EXPECT_EQ(words_in(csv, "surface"),
            (Words{"dry steel", "friction 0.1", "grease", "dry steel", "friction 0.1", "grease"}));
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

  ASSERT_EQ(run("one", small_platens, "friction").status, 0);
  expect_same_tables("one", "a");
}

TEST_F(Study, of_one_run_gives_it_all_threads) {
  const Words single =
      with(with(small_platens, {"-t", "3"}), set({"Study/Surface list = 0.3", "Study/Slenderness list = 1"}));
  ASSERT_EQ(run("a", single, "friction").status, 0);
  EXPECT_EQ(summary_in(folder_ / "a/runs/friction_0.3_slenderness_1_seed_3")["threads"],
            std::min(3u, std::thread::hardware_concurrency())); // no more than there are cores
}

// Killed without a word again and again, at once taken up.
TEST_F(Study, of_friction_killed_at_random_comes_to_the_same_table) {
  expect_the_same_however_often_killed(with(small_platens, set({"Study/Slenderness list = 1"})), "friction");
}

// A fall by 2 % is a peak; damage is measured at a fall to 0.8, which may be beyond the target strain.
TEST(StudyTables, a_run_has_peaked_where_its_summary_says_so) {
  EXPECT_TRUE(has_peaked(Json{{"peak_reached", true}, {"middle_damage", nullptr}}));
  EXPECT_FALSE(has_peaked(Json{{"peak_reached", false}, {"middle_damage", 0.5}}));
  EXPECT_FALSE(has_peaked(Json{{"peak_reached", nullptr}}));
  EXPECT_FALSE(has_peaked(Json())); // of a run that failed
}

TEST_F(Study, of_friction_compares_nothing_that_never_peaked) {
  const Words pressed_little = with(two, set({no_radii, "Loading/Target strain = 2e-4"}));
  expect(0, "grease_seed_3: it reached no peak", "a", pressed_little, "friction");
  const std::string log = content_of(folder_ / "a/run.log");
  EXPECT_TRUE(contains(log, "grease_seed_3: it reached no peak"));
  EXPECT_FALSE(contains(log, "nan"));
  EXPECT_EQ(json("a")["cases"][0]["without_peak"], 1);
  EXPECT_TRUE(json("a")["cases"][0]["strength_pa"]["mean"].is_null());
  EXPECT_TRUE(json("a")["comparisons"][0]["mean"].is_null());
}

TEST_F(Study, of_friction_survives_a_case_that_fails) {
  // One step for all, above the limit of the smaller spheres.
  expect(0, "2 of 4 runs failed", "a",
         with(two, set({"Integration/Time step = 2.4e-7 s", "Study/Sphere radius list = 1.4 mm, 2 mm"})),
         "friction");
  EXPECT_EQ(words_in(folder_ / "a/study.csv", "status"), (Words{"failed", "failed", "done", "done"}));
  const auto comparisons = json("a")["comparisons"];
  ASSERT_EQ(comparisons.size(), 2u);
  EXPECT_TRUE(comparisons[0]["mean"].is_null());
  EXPECT_EQ(comparisons[0]["runs"], 0);
  EXPECT_GT(comparisons[1]["mean"], 0);
  EXPECT_EQ(json("a")["cases"][0]["without_peak"], 0);
}

} // namespace
} // namespace platen::apps::testing
