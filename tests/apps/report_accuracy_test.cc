// Pictures and page of a study of accuracy, from a made-up study.json.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "apps/report/accuracy_study.h"
#include "apps/report/chart.h"
#include "apps/report_folder.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

using Json = nlohmann::json;

Json statistics(const Json &mean, const Json &deviation, double root_mean_square) {
  return {{"mean", mean}, {"deviation", deviation}, {"root_mean_square", root_mean_square}, {"runs", 3}};
}

Json value_of(const std::string &text, double error) {
  Json one{{"value", text}};
  for (const char *measure : {"strength", "strain_at_peak", "modulus", "broken_bonds"})
    one["errors"][measure] = statistics(error, 0.001, std::abs(error));
  return one;
}

Json parameter_of(const std::string &name, bool ordered, const std::vector<Json> &values) {
  return {{"knob", name},
          {"unit", ordered ? "m/s" : ""},
          {"ordered", ordered},
          {"scatter_of_seeds",
           {{"strength", 0.02}, {"strain_at_peak", 0.03}, {"modulus", 0.004}, {"broken_bonds", nullptr}}},
          {"values", values}};
}

Json price(double within, const Json &value, const Json &seconds) {
  return {
      {"knob", "axial rate"}, {"of", "strength"}, {"within", within}, {"value", value}, {"seconds", seconds}};
}

Json example() {
  Json study{{"kind", "accuracy"}, {"status", "done"}, {"runs", 15}, {"failed_runs", 0}};
  study["accuracy"] = {
      parameter_of("axial rate", true, {value_of("0.2", -0.1), value_of("0.1", 0.02), value_of("0.05", 0)}),
      parameter_of("effects", false,
                   {value_of("Effects/Rotation = off", 0.5), value_of("the scene as it is", 0)})};
  Json seconds = Json::array();
  for (const auto &[parameter, value, mean] : {std::tuple{"axial rate", "0.2", 1.0},
                                               {"axial rate", "0.1", 2.0},
                                               {"axial rate", "0.05", 4.0},
                                               {"effects", "Effects/Rotation = off", 2.5},
                                               {"effects", "the scene as it is", 4.0}})
    seconds.push_back({{"knob", parameter}, {"value", value}, {"mean", mean}});
  study["costs"] = {{"wall_seconds", seconds},
                    {"prices", {price(0.05, "0.1", 2.0), price(0.01, nullptr, nullptr)}}};
  return study;
}

TEST(ReportAccuracy, its_table_tells_errors_scatter_and_seconds_and_its_remarks_what_a_bound_costs) {
  const TestFolder folder;
  folder.write("study.json", example().dump());
  const AccuracyResults study = read_accuracy(folder.path());
  const TableOfFigures table = table_of_accuracy(study);
  ASSERT_EQ(table.rows.size(), 5u);
  EXPECT_EQ(table.rows[0],
            (std::vector<std::string>{"axial rate", "0.2 m/s", "3", "-10", "-10", "-10", "-10", "1"}));
  EXPECT_EQ(table.rows[2],
            (std::vector<std::string>{"axial rate", "0.05 m/s", "3", "reference; deviation of its seeds 2",
                                      "reference; deviation of its seeds 3",
                                      "reference; deviation of its seeds 0.4", "reference", "4"}));
  EXPECT_EQ(study.remarks,
            (std::vector<std::string>{"axial rate, strength: 5 % costs 2 s (0.1); 1 % not reached"}));
}

TEST(ReportAccuracy, errors_of_few_seeds_have_a_range_and_of_five_a_deviation) {
  const TestFolder folder;
  Json study = example();
  Json &error = study["accuracy"][0]["values"][0]["errors"]["strength"];
  error.update({{"low", -0.12}, {"high", -0.07}});
  folder.write("study.json", study.dump());
  EXPECT_EQ(table_of_accuracy(read_accuracy(folder.path())).rows[0][3], "-12 ... -7");
  error["runs"] = 5;
  folder.write("study.json", study.dump());
  EXPECT_EQ(table_of_accuracy(read_accuracy(folder.path())).rows[0][3], "-10 +- 0.1");
}

TEST(ReportAccuracy, what_is_no_finished_study_is_refused) {
  const TestFolder folder;
  Json broken = example();
  broken.erase("costs");
  folder.write("study.json", broken.dump());
  EXPECT_THROW(read_accuracy(folder.path()), InputError);
  folder.write("study.json", Json{{"kind", "accuracy"}, {"status", "running"}}.dump());
  EXPECT_THROW(read_accuracy(folder.path()), InputError);
}

TEST(ReportAccuracy, decades_hold_every_point_above_zero_and_the_band) {
  Chart chart;
  chart.curves.push_back({"a", {1, 10, 100}, {0.1, 0, 1000}});
  chart.marks.push_back({1000, 1, "", colours::black, MarkShape::circle});
  chart.band_top = 0.001;
  const Chart logs = in_decades(chart);
  EXPECT_DOUBLE_EQ(logs.curves[0].x[2], 2);
  EXPECT_DOUBLE_EQ(logs.curves[0].y[0], -1);
  EXPECT_TRUE(std::isnan(logs.curves[0].y[1])); // nothing has no logarithm
  EXPECT_DOUBLE_EQ(logs.band_top, -3);
  EXPECT_LT(logs.x_range[0], 0);
  EXPECT_GT(logs.x_range[1], 3);
  EXPECT_LT(logs.y_range[0], -3);
  EXPECT_GT(logs.y_range[1], 3);
  EXPECT_TRUE(std::isnan(in_decades(Chart{}).band_top));
}

TEST(ReportAccuracy, ticks_of_decades_are_powers_of_ten_with_steps_between_where_there_is_room) {
  const auto words = [](double low, double high) {
    std::vector<std::string> all;
    for (const Tick &tick : decade_ticks(low, high))
      all.push_back(tick.words);
    return all;
  };
  EXPECT_EQ(words(-0.1, 1.1), (std::vector<std::string>{"1", "2", "5", "10"}));
  EXPECT_EQ(words(0.25, 0.75), (std::vector<std::string>{"2", "3", "4", "5"}));
  EXPECT_EQ(words(-2.1, 2.1), (std::vector<std::string>{"0.01", "0.1", "1", "10", "100"}));
  for (const Tick &tick : decade_ticks(-1, 2))
    EXPECT_NEAR(std::pow(10, tick.place), std::stod(tick.words), 1e-12 * std::stod(tick.words));
}

TEST(ReportAccuracy, picture_and_page_are_written) {
  const TestFolder folder;
  folder.write("study.json", example().dump());
  folder.write("summary.json", Json{{"scene", "Made-up errors"}}.dump());
  const std::string command = "env -u DISPLAY '" PLATEN_REPORT_PROGRAM "' '" + folder.path().string() +
                              "' >'" + (folder / "out.txt").string() + "' 2>&1";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == status_done) << text_of(folder / "out.txt");
  for (const char *name : {"accuracy.png", "accuracy_more.png"})
    EXPECT_GT(std::filesystem::file_size(folder / "pictures" / name), 10000u) << name;
  const std::string page = text_of(folder / "pictures" / "report.html");
  EXPECT_NE(page.find("Made-up errors"), std::string::npos);
  EXPECT_NE(page.find("5 % costs 2 s (0.1)"), std::string::npos);
}

} // namespace
} // namespace platen::apps::report
