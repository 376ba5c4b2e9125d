// The line of failure of a study under several pressures, Mohr-Coulomb from it, and what codes give.
#include "apps/report/envelope.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/report_folder.h"
#include "base/pi.h"

namespace platen::apps::report {
namespace {

TEST(ReportEnvelope, a_line_through_its_own_points_gives_q_k_c_and_phi_back) {
  const double phi = 30 * pi / 180, c = 10; // k = 3, q = 2 c sqrt(3)
  std::vector<double> s;
  for (const double p : {0.0, 2.0, 7.0})
    s.push_back(2 * c * std::cos(phi) / (1 - std::sin(phi)) + p * (1 + std::sin(phi)) / (1 - std::sin(phi)));
  const FailureLine line = line_through({0, 2, 7}, s);
  EXPECT_NEAR(line.k, 3, 1e-12);
  EXPECT_NEAR(line.q, 20 * std::sqrt(3), 1e-12);
  EXPECT_NEAR(line.phi, 30, 1e-10);
  EXPECT_NEAR(line.cohesion, 10, 1e-12);
  // The tangent touches each circle: the distance of its centre is its radius.
  for (const double p : {0.0, 2.0, 7.0}) {
    const double s1 = line.q + line.k * p, centre = 0.5 * (s1 + p), angle = line.phi * pi / 180;
    EXPECT_NEAR(std::cos(angle) * (line.cohesion + centre * std::tan(angle)), 0.5 * (s1 - p), 1e-10);
  }
}

TEST(ReportEnvelope, one_pressure_or_a_falling_strength_gives_no_angle) {
  EXPECT_TRUE(std::isnan(line_through({3, 3}, {40, 41}).k));
  EXPECT_TRUE(std::isnan(line_through({3}, {40}).k));
  const FailureLine falling = line_through({0, 10}, {40, 45});
  EXPECT_DOUBLE_EQ(falling.k, 0.5);
  EXPECT_TRUE(std::isnan(falling.phi));
}

// EN 1998-3 against numbers worked by hand: (10/40)^.86 = .30354.
TEST(ReportEnvelope, codes_are_as_published) {
  EXPECT_NEAR(strength_en_1998_3(40, 10), 40 * (1 + 3.7 * 0.303549), 1e-3);
  EXPECT_EQ(strength_en_1998_3(40, 0), 40);
  EXPECT_DOUBLE_EQ(strength_richart(40, 10), 81);
}

// Two packings: q 40 and 44, k 4 and 5; the case at 20 MPa never peaked.
void write_study(const TestFolder &folder, int seeds) {
  nlohmann::json cases = nlohmann::json::array();
  std::string rows = "kind,case,surface,confining_pressure_pa,seed,status,strength_pa,pattern\n";
  for (const double p : {0.0, 5.0, 10.0, 20.0}) {
    const std::string name = "p" + std::to_string(static_cast<int>(p));
    cases.push_back({{"name", name},
                     {"surface", "dry steel"},
                     {"friction_static", 0.57},
                     {"slenderness", 2.0},
                     {"sphere_radius_m", 0.002},
                     {"confining_pressure_pa", p * 1e6},
                     {"without_peak", p == 20 ? 1 : 0},
                     {"strength_pa", {{"mean", 42e6 + 4.5e6 * p}, {"deviation", 1e6}, {"runs", seeds}}}});
    for (int seed = 1; seed <= seeds; ++seed) {
      std::ostringstream row;
      row << "friction," << name << ",dry steel," << p * 1e6 << ',' << seed << ",done,"
          << (seed == 1 ? 40e6 + 4e6 * p : 44e6 + 5e6 * p) << ",none\n";
      rows += row.str();
    }
  }
  folder.write("study.csv", rows + "friction,p5,dry steel,5e6,9,failed,nan,\n");
  folder.write("study.json", nlohmann::json{{"kind", "friction"},
                                            {"status", "done"},
                                            {"runs", 9},
                                            {"failed_runs", 1},
                                            {"cases", cases},
                                            {"comparisons", nlohmann::json::array()},
                                            {"laboratory", nlohmann::json::array()}}
                                 .dump());
}

TEST(ReportEnvelope, each_packing_has_its_line_and_they_have_their_scatter) {
  const TestFolder folder;
  write_study(folder, 2);
  std::vector<std::string> remarks;
  const std::vector<Envelope> envelopes = envelopes_of(read_study(folder.path()), folder.path(), remarks);
  ASSERT_EQ(envelopes.size(), 1u);
  const Envelope &e = envelopes[0];
  ASSERT_EQ(e.points.size(), 3u); // without a peak: no strength
  ASSERT_EQ(e.lines.size(), 2u);
  EXPECT_NEAR(e.lines[0].k, 4, 1e-9);
  EXPECT_NEAR(e.lines[1].q, 44, 1e-9);
  EXPECT_NEAR(e.k.mean, 4.5, 1e-9);
  EXPECT_NEAR(e.k.low, 4, 1e-9); // of two packings the range
  EXPECT_NEAR(e.k.high, 5, 1e-9);
  EXPECT_NEAR(e.unconfined(), 42, 1e-9);
  const TableOfFigures table = table_of(e);
  EXPECT_EQ(table.rows[1][3], "4.50");
  EXPECT_EQ(table.rows[2][5], "83.0"); // Richart: 42 + 41
  EXPECT_EQ(table_of_lines(e).rows.back()[0], "range");
  EXPECT_EQ(table_of_lines(e).rows.back()[3], "4.00 ... 5.00, 2 packings");
  EXPECT_TRUE(remarks.empty());
}

TEST(ReportEnvelope, the_page_of_one_packing_says_that_no_scatter_is_known) {
  const TestFolder folder;
  write_study(folder, 1);
  const std::string command =
      "cd '" + folder.path().string() + "' && '" PLATEN_REPORT_PROGRAM "' . -o pictures >out.txt 2>error.txt";
  ASSERT_EQ(std::system(command.c_str()), 0) << text_of(folder / "error.txt");
  EXPECT_TRUE(std::filesystem::exists(folder / "pictures/failure_envelope.png"));
  const std::string page = text_of(folder / "pictures/report.html");
  EXPECT_NE(page.find("one packing: no scatter known"), std::string::npos);
  EXPECT_NE(page.find("<th>phi (degrees)</th>"), std::string::npos);
  EXPECT_NE(page.find("<td>60.0, 1 packing</td>"), std::string::npos); // strength at 5 MPa
}

} // namespace
} // namespace platen::apps::report
