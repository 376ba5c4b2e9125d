// The failure envelope of a study: closed forms, which cases it is of, what the study leaves of it.
#include <gtest/gtest.h>

#include <cmath>

#include "apps/study/failure_envelope.h"
#include "apps/study_runs.h"
#include "base/pi.h"

namespace platen::apps::testing {
namespace {

constexpr double MPa = 1e6;

FailureLine line_through(const std::vector<FailurePoint> &points) {
  std::vector<FailurePoint> in_pascal;
  for (const auto &[pressure, strength] : points)
    in_pascal.push_back({pressure * MPa, strength * MPa});
  return fit_failure_line(in_pascal);
}

// c = 10 MPa, phi = 30 degrees: k = 3, q = 2 c sqrt(k).
TEST(FailureLine, of_points_on_a_line_of_mohr_and_coulomb_gives_its_c_and_phi) {
  std::vector<FailurePoint> points;
  for (const double p : {1.0, 7.0, 2.0})
    points.push_back({p, 20 * std::sqrt(3) + 3 * p});
  const FailureLine line = line_through(points);
  EXPECT_NEAR(line.k, 3, 1e-12);
  EXPECT_NEAR(line.q, 20 * std::sqrt(3) * MPa, 1e-4);
  EXPECT_NEAR(line.cohesion, 10 * MPa, 1e-4);
  EXPECT_NEAR(line.friction_angle, 30, 1e-10);
  EXPECT_EQ(line.pressure_low, 1 * MPa);
  EXPECT_EQ(line.pressure_high, 7 * MPa);
  EXPECT_EQ(line.runs, 3u);
  EXPECT_LT(line.largest_miss, 1e-12);
  EXPECT_LT(line.cohesion_error, 1);
}

// By hand: 10.2 + 4.2 s3, residuals -.2, .6, -.6, .2, their squares 0.8; mean pressure 1.5, squares about
// it 5.
TEST(FailureLine, errors_are_those_of_least_squares) {
  const FailureLine line = line_through({{0, 10}, {1, 15}, {2, 18}, {3, 23}});
  EXPECT_NEAR(line.q, 10.2 * MPa, 1e-4);
  EXPECT_NEAR(line.k, 4.2, 1e-12);
  EXPECT_NEAR(line.residual_error, std::sqrt(0.8 / 2) * MPa, 1e-4);
  EXPECT_NEAR(line.k_error, std::sqrt(0.4 / 5), 1e-12);
  EXPECT_NEAR(line.q_error, std::sqrt(0.4 * (1 / 4.0 + 2.25 / 5)) * MPa, 1e-4);
  EXPECT_NEAR(line.largest_miss, 0.6 / 15, 1e-12);
  EXPECT_EQ(line.reason, "");
  // Of c and phi by finite differences, with the covariance -1.5 s_k^2 of q and k.
  const auto c = [](double q, double k) { return q / (2 * std::sqrt(k)); };
  const auto phi = [](double k) { return std::asin((k - 1) / (k + 1)) / degree; };
  const double step = 1e-6, by_q = (c(10.2 + step, 4.2) - c(10.2 - step, 4.2)) / (2 * step),
               by_k = (c(10.2, 4.2 + step) - c(10.2, 4.2 - step)) / (2 * step), of_k = 0.4 / 5;
  const double variance =
      by_q * by_q * 0.4 * (1 / 4.0 + 2.25 / 5) + by_k * by_k * of_k - 2 * by_q * by_k * 1.5 * of_k;
  EXPECT_NEAR(line.cohesion_error, std::sqrt(variance) * MPa, 1e-2);
  EXPECT_NEAR(line.friction_angle_error, (phi(4.2 + step) - phi(4.2 - step)) / (2 * step) * line.k_error,
              1e-8);
}

// A miss is of the mean strength at a pressure: 40 and 44 are 42, the line's own value there.
TEST(FailureLine, misses_means_of_a_pressure_and_scatters_by_runs) {
  const FailureLine line = line_through({{0, 40}, {0, 44}, {10, 80}, {10, 84}});
  EXPECT_NEAR(line.k, 4, 1e-12);
  EXPECT_LT(line.largest_miss, 1e-12);
  EXPECT_NEAR(line.residual_error, std::sqrt(16 / 2.0) * MPa, 1e-4);
  EXPECT_TRUE(std::isnan(line.hoek_brown_sc));
  EXPECT_EQ(line.reason, "two pressures: no curve of Hoek and Brown");
}

TEST(FailureLine, of_points_on_a_curve_of_hoek_and_brown_gives_its_sc_and_m) {
  std::vector<FailurePoint> points;
  for (const double p : {0.0, 5.0, 10.0, 20.0, 40.0})
    points.push_back({p, p + 40 * std::sqrt(12 * p / 40 + 1)});
  const FailureLine line = line_through(points);
  EXPECT_NEAR(line.hoek_brown_sc, 40 * MPa, 1e-3);
  EXPECT_NEAR(line.hoek_brown_m, 12, 1e-9);
  EXPECT_GT(line.largest_miss, 0.05);                                     // the line is none
  const FailureLine falling = line_through({{0, 40}, {5, 45}, {10, 49}}); // s1 - s3 falls
  EXPECT_TRUE(std::isnan(falling.hoek_brown_sc) && std::isnan(falling.hoek_brown_m));
  EXPECT_TRUE(contains(falling.reason, "no curve of Hoek and Brown")) << falling.reason;
}

TEST(FailureLine, what_points_do_not_give_is_missing_with_its_reason) {
  const FailureLine none = line_through({{3, 40}, {3, 41}, {3, 45}});
  EXPECT_TRUE(std::isnan(none.k) && std::isnan(none.pressure_low) && std::isnan(none.largest_miss));
  EXPECT_EQ(none.reason, "strengths at fewer than two pressures: no line");
  EXPECT_EQ(line_through({}).runs, 0u);

  const FailureLine two = line_through({{0, 40}, {10, 80}});
  EXPECT_NEAR(two.cohesion, 10 * MPa, 1e-4); // 40 / (2 sqrt 4)
  EXPECT_TRUE(std::isnan(two.k_error) && std::isnan(two.q_error) && std::isnan(two.residual_error));
  EXPECT_TRUE(std::isnan(two.cohesion_error) && std::isnan(two.friction_angle_error));
  EXPECT_EQ(two.reason, "two runs: no standard errors; two pressures: no curve of Hoek and Brown");

  const FailureLine flat = line_through({{0, 40}, {10, 45}, {20, 50}});
  EXPECT_NEAR(flat.k, 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(flat.cohesion) && std::isnan(flat.friction_angle));
  EXPECT_TRUE(contains(flat.reason, "k < 1: no c and phi")) << flat.reason;
  const FailureLine below = line_through({{10, 5}, {20, 45}});
  EXPECT_TRUE(std::isnan(below.cohesion));
  EXPECT_TRUE(contains(below.reason, "q < 0: no c and phi")) << below.reason;
  EXPECT_NEAR(line_through({{0, 40}, {8, 48}}).friction_angle, 0, 1e-9); // k = 1
}

StudyPlan envelope_plan(StudyKind kind, const Words &entries) {
  return plan_of(kind, with(entries, {no_radii, "Loading/Confinement = particles"}));
}

TEST(FailureEnvelopes, are_of_cases_that_differ_by_pressure_alone) {
  const StudyPlan plan = envelope_plan(
      StudyKind::friction, {"Study/Surface list = dry steel, glued", "Study/Slenderness list = 1, 2",
                            "Study/Confining pressure list = 4 MPa, 0, 2 MPa"});
  std::vector<std::vector<double>> strengths;
  for (std::size_t c = 0; c < plan.cases.size(); ++c) { // k = 3 to 6; the second packing is 10 MPa stronger
    const double k = 3 + static_cast<double>(c % 4), p = plan.cases[c].labels.back();
    strengths.push_back({30 * MPa + k * p, 40 * MPa + k * p});
  }
  strengths[1][1] = std::nan(""); // glued at 4 MPa
  const std::vector<FailureEnvelope> envelopes = failure_envelopes(plan, strengths);
  ASSERT_EQ(envelopes.size(), 4u);
  EXPECT_EQ(envelopes[2].name, "dry_steel_slenderness_2");
  EXPECT_EQ(envelopes[2].cases, (std::vector<std::size_t>{2, 6, 10}));
  EXPECT_EQ(envelopes[2].line.runs, 6u);
  EXPECT_NEAR(envelopes[2].line.k, 5, 1e-9);
  EXPECT_NEAR(envelopes[2].line.q, 35 * MPa, 1e-2);
  ASSERT_EQ(envelopes[1].packings.size(), 2u);
  EXPECT_NEAR(envelopes[1].packings[0].q, 30 * MPa, 1e-2);
  EXPECT_NEAR(envelopes[1].packings[1].q, 40 * MPa, 1e-2);
  EXPECT_NEAR(envelopes[1].packings[1].k, 4, 1e-9);
  EXPECT_EQ(envelopes[1].line.reason, "1 of 6 runs have no strength");
  EXPECT_TRUE(contains(envelopes[1].packings[1].reason, "1 of 3 runs have no strength"));
  EXPECT_TRUE(contains(text_of(envelopes), "  envelope of dry_steel_slenderness_2: c = 7.826 +- "))
      << text_of(envelopes); // 35 / (2 sqrt 5)
  EXPECT_TRUE(contains(text_of(envelopes), " degrees, 0 to 4 MPa, 6 runs, largest miss "));
  const Json written = json_of(plan, envelopes);
  EXPECT_EQ(written[3]["surface"], "glued");
  EXPECT_EQ(written[3]["slenderness"], 2);
  EXPECT_FALSE(written[3].contains("confining_pressure_pa"));
  EXPECT_EQ(written[3]["cases"][1], plan.cases[7].name);
  EXPECT_EQ(written[3]["packings"][1]["seed"], 4);

  EXPECT_EQ(failure_envelopes(envelope_plan(StudyKind::friction, {"Study/Surface list = dry steel, glued",
                                                                  "Study/Confining pressure list = 4 MPa"}),
                              {{1, 1}, {1, 1}})
                .size(),
            0u);
}

TEST(FailureEnvelopes, of_any_entries_have_the_name_of_all_that_is_varied_but_the_pressure) {
  const char *pressures = "Study/Vary 2 = Loading/Confining pressure: 1 MPa, 3 MPa";
  const StudyPlan plan =
      envelope_plan(StudyKind::vary, {"Study/Vary 1 = Effects/Rotation: on, off", pressures,
                                      "Study/Vary 3 = Platens/Friction static: 0.2, 0.25"});
  const std::vector<std::vector<double>> strengths(8, {30 * MPa, 31 * MPa});
  const std::vector<FailureEnvelope> envelopes = failure_envelopes(plan, strengths);
  ASSERT_EQ(envelopes.size(), 4u);
  EXPECT_EQ(envelopes[1].name, "rotation_on_friction_static_0.25");
  EXPECT_EQ(envelopes[3].cases, (std::vector<std::size_t>{5, 7})); // rotation off, 0.25
  EXPECT_EQ(json_of(plan, envelopes)[3]["friction_static"], 0.25);
  const std::vector<FailureEnvelope> one =
      failure_envelopes(envelope_plan(StudyKind::vary, {pressures, "Study/Seeds = 1"}), {{1}, {4}});
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].name, "all");
  EXPECT_TRUE(one[0].packings.empty()); // the line is that of the packing
}

// Three runs on a hundred spheres, made by the study and one by one.
TEST_F(Study, under_pressures_leaves_its_envelope_in_a_table_and_in_json) {
  const Words pressed =
      set({"Study/Confining pressure list = 0, 0.5 MPa, 1 MPa", "Study/Surface list = grease", no_radii,
           "Study/Seeds = 1", "Specimen/Packing = random close", "Loading/Confinement = particles"});
  const Outcome outcome = run("a", pressed, "friction");
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_TRUE(contains(outcome.out, "envelope of grease: c = ")) << outcome.out;
  const fs::path csv = folder_ / "a/envelope.csv";
  ASSERT_EQ(json("a")["envelopes"].size(), 1u);
  const auto said = json("a")["envelopes"][0];
  EXPECT_EQ(said, summary_in(folder_ / "a")["envelopes"][0]);
  EXPECT_EQ(words_in(csv, "name"), Words{"grease"});
  EXPECT_EQ(words_in(csv, "surface"), Words{"grease"});
  for (const char *key : {"runs", "slenderness", "pressure_high_pa", "cohesion_pa", "friction_angle_deg",
                          "friction_angle_error_deg", "k", "largest_miss"})
    EXPECT_EQ(column_of(csv, key).at(0), said[key].get<double>()) << key;
  std::vector<FailurePoint> points;
  const std::vector<double> strength = column_of(folder_ / "a/study.csv", "strength_pa");
  for (std::size_t k = 0; k < strength.size(); ++k)
    points.push_back({0.5 * MPa * static_cast<double>(k), strength[k]});
  EXPECT_NEAR(said["q_pa"].get<double>(), fit_failure_line(points).q, 1);
  const std::string table = content_of(csv), text = content_of(folder_ / "a/study.json");

  expect(0, "", "b", with(pressed, {"--plan"}), "friction");
  EXPECT_FALSE(fs::exists(folder_ / "b/envelope.csv"));
  for (const char *number : {"1", "2", "3"})
    expect(0, "", "b", with(pressed, {"--run", number}), "friction");
  expect(0, "", "b", with(pressed, {"--collect"}), "friction");
  EXPECT_EQ(content_of(folder_ / "b/envelope.csv"), table);
  EXPECT_EQ(content_of(folder_ / "b/study.json"), text);

  // Another study in its place: one pressure has no envelope.
  Words other = with(pressed, {"--overwrite"});
  other[1] = "Study/Confining pressure list = 1 MPa";
  ASSERT_EQ(run("a", other, "friction").status, 0);
  EXPECT_FALSE(fs::exists(csv));
  EXPECT_FALSE(json("a").contains("envelopes"));
}

} // namespace
} // namespace platen::apps::testing
