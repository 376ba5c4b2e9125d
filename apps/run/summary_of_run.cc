#include "apps/run/summary_of_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <set>

#include "apps/run/app_output.h"
#include "apps/run/figures.h"
#include "apps/run/problem_setup.h"
#include "apps/run/stages_of_run.h"
#include "apps/run/validity.h"

namespace platen::apps {
namespace {

// Takes the rows of list_figures() and computes those that the test has.
class Evaluation : public FigureList<Evaluation> {
public:
  Evaluation(const TestRecord &test, Json &to) : test_(test), to_(to) {}
  template <class Holds>
  void where(Holds holds) {
    there_ = holds(test_);
  }
  template <class Value>
  void take(const Figure &figure, Value value) {
    if (!there_) return;
    to_[Json::json_pointer("/" + figure.key)] = value(test_);
    evaluated_.push_back(figure);
  }
  const std::vector<Figure> &evaluated() const { return evaluated_; }

private:
  const TestRecord &test_;
  Json &to_;
  bool there_ = true;
  std::vector<Figure> evaluated_;
};

constexpr const char *unmeasured = "not measured by this test";

bool is_missing(const Json &value) {
  return value.is_null() || (value.is_number_float() && !std::isfinite(value.get<double>()));
}

// Names each figure that a peak, a modulus, a fall or a consolidation is needed for.
Json validity_of(const std::vector<Figure> &told, const Reasons &reasons, const Json &summary) {
  Json validity = Json::object();
  for (const Figure &figure : told) {
    if (!figure.is_headline()) continue;
    if (const auto found = reasons.find(figure.key); found != reasons.end())
      validity[figure.key] = found->second;
    else if (is_missing(summary[figure.key]))
      validity[figure.key] = Json::array({unmeasured});
    else
      validity[figure.key] = "valid";
  }
  return validity;
}

std::string shown(const Line &line, const Json &value) {
  if (value.is_number()) return fmt::format(fmt::runtime(line.format), line.factor * value.get<double>());
  if (value.is_array()) return fmt::format("{}", fmt::join(value.get<std::vector<std::string>>(), "; "));
  return value.get<std::string>();
}

} // namespace

const char *app_of(const coupling::PlatenTest &problem) {
  return problem.shape().kind == dem::ShapeKind::disc ? "platen-brazilian" : "platen-compress";
}

Json summary_of_run(const std::string &status, const TestRecord &test) {
  Json summary = summary_head(test.scene, app_of(test.problem), status, effects_on(test.scene));
  if (test.scene.general.standard != "none") summary["standard"] = test.scene.general.standard;
  Evaluation evaluation(test, summary);
  list_figures(evaluation);
  const Reasons reasons = reasons_against(test, evaluation.evaluated(), summary);
  for (const auto &[figure, against] : reasons)
    summary[figure] = nullptr;
  summary["validity"] = validity_of(evaluation.evaluated(), reasons, summary);
  return summary;
}

std::string report_of_run(const Json &summary) {
  std::string text;
  std::set<std::string> told;
  for (const Figure &figure : figures()) {
    const auto line = [&](const std::string &words) {
      text += fmt::format("  {:<36}{}\n", figure.line.label, words);
    };
    const Json::json_pointer place("/" + figure.key);
    if (figure.line.label.empty() || !summary.contains(place)) continue;
    const Json &value = summary.at(place), against = summary.at("validity").value(figure.key, Json());
    if (!is_missing(value))
      line(shown(figure.line, value));
    else if (against.is_array() && against[0] != unmeasured && told.insert(against[0]).second)
      line("none: " + against[0].get<std::string>());
  }
  return text;
}

} // namespace platen::apps
