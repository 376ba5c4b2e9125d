#include "apps/study/comparisons.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/scene/surfaces.h"

namespace platen::apps {
namespace {

constexpr double free_friction = 0.05; // and below: sheets of Teflon
constexpr double steel_friction = 0.3; // and above: the strength of cubes hardly depends on it
constexpr double nearly = 1e-9;        // of a slenderness, for the round-off of heights

double label(const StudyPlan &plan, std::size_t of, const char *column) {
  const auto place = std::find(plan.varied.begin(), plan.varied.end(), column) - plan.varied.begin();
  return plan.cases[of].labels[static_cast<std::size_t>(place)];
}

bool equal(double a, double b) {
  return std::abs(a - b) <= nearly * std::abs(b);
}

class Comparing {
public:
  Comparing(const StudyPlan &plan, const std::vector<std::vector<double>> &strengths)
      : plan_(plan), strengths_(strengths) {}
  std::vector<Comparison> all();

private:
  double friction(std::size_t k) const { return label(plan_, k, "friction_static"); }
  double slenderness(std::size_t k) const { return label(plan_, k, "slenderness"); }
  bool alike(std::size_t a, std::size_t b, const char *column) const {
    return equal(label(plan_, a, column), label(plan_, b, column));
  }
  bool same_grains(std::size_t a, std::size_t b) const {
    return alike(a, b, "sphere_radius_m") && alike(a, b, "confining_pressure_pa");
  }
  bool same_platens(std::size_t a, std::size_t b) const {
    return plan_.cases[a].surface == plan_.cases[b].surface;
  }
  // The best of all cases that may be compared with k; nothing where there is none.
  template <class May, class Better>
  std::optional<std::size_t> partner(std::size_t k, const May &may, const Better &better) const;
  void add(PlatenEffect effect, std::size_t of, std::size_t over);

  const StudyPlan &plan_;
  const std::vector<std::vector<double>> &strengths_;
  std::vector<Comparison> comparisons_;
};

template <class May, class Better>
std::optional<std::size_t> Comparing::partner(std::size_t k, const May &may, const Better &better) const {
  std::optional<std::size_t> best;
  for (std::size_t other = 0; other < plan_.cases.size(); ++other)
    if (other != k && same_grains(k, other) && may(other) && (!best || better(other, *best))) best = other;
  return best;
}

void Comparing::add(PlatenEffect effect, std::size_t of, std::size_t over) {
  Comparison comparison{effect, of, over, {}, nullptr};
  for (std::size_t seed = 0; seed < plan_.seeds.size(); ++seed)
    comparison.ratio.add(strengths_[of][seed] / strengths_[over][seed]);
  const std::string &faces = plan_.cases[of].surface;
  const bool free_ends = friction(of) <= free_friction,
             steel = friction(of) >= steel_friction && faces != surface(SurfaceKind::rubber_sheet).word &&
                     faces != surface(SurfaceKind::brush).word;
  const bool bare = label(plan_, of, "confining_pressure_pa") == 0;
  if (bare && (free_ends || steel))
    comparison.laboratory = laboratory_figure(effect, free_ends, slenderness(of));
  comparisons_.push_back(std::move(comparison));
}

std::vector<Comparison> Comparing::all() {
  const auto any = [](std::size_t, std::size_t) { return false; };
  for (std::size_t k = 0; k < plan_.cases.size(); ++k) {
    const auto free_ends = partner(
        k,
        [&](std::size_t other) {
          return alike(k, other, "slenderness") && friction(other) <= free_friction &&
                 !(friction(other) >= friction(k));
        },
        [&](std::size_t a, std::size_t b) { return friction(a) < friction(b); });
    if (free_ends) add(PlatenEffect::gain, k, *free_ends);
    if (equal(slenderness(k), 2)) continue;
    const auto two = partner(
        k, [&](std::size_t other) { return same_platens(k, other) && equal(slenderness(other), 2); }, any);
    if (two) add(PlatenEffect::relative_strength, k, *two);
    if (!equal(slenderness(k), 1)) continue;
    const auto from_prism = [&](std::size_t other) {
      return std::abs(slenderness(other) - laboratory_prism);
    };
    const auto prism = partner(
        k,
        [&](std::size_t other) { return same_platens(k, other) && slenderness(other) >= 2 * (1 - nearly); },
        [&](std::size_t a, std::size_t b) { return from_prism(a) < from_prism(b); });
    if (prism) add(PlatenEffect::cube_over_prism, k, *prism);
  }
  return std::move(comparisons_);
}

std::string words(const LaboratoryFigure &f) {
  const std::string range = f.low < f.high ? fmt::format(" ({:.2f} ... {:.2f})", f.low, f.high) : "";
  return fmt::format("{:.2f}{}, {}", f.mean, range, f.source);
}

} // namespace

std::vector<Comparison> compare(const StudyPlan &plan, const std::vector<std::vector<double>> &strengths) {
  return Comparing(plan, strengths).all();
}

Json json_of(const LaboratoryFigure &figure) {
  return {{"effect", word(figure.effect)},
          {"platens", figure.free_ends ? "free ends" : "steel"},
          {"slenderness", figure.slenderness},
          {"mean", figure.mean},
          {"low", figure.low},
          {"high", figure.high},
          {"source", figure.source}};
}

Json json_of(const std::vector<LaboratoryFigure> &figures) {
  Json all = Json::array();
  for (const LaboratoryFigure &figure : figures)
    all.push_back(json_of(figure));
  return all;
}

Json json_of(const StudyPlan &plan, const std::vector<Comparison> &comparisons) {
  Json all = Json::array();
  for (const Comparison &c : comparisons) {
    Json one{{"effect", word(c.effect)},         {"case", plan.cases[c.of].name},
             {"over", plan.cases[c.over].name},  {"mean", c.ratio.mean()},
             {"deviation", c.ratio.deviation()}, {"runs", c.ratio.count()}};
    one["laboratory"] = c.laboratory == nullptr ? Json() : json_of(*c.laboratory);
    all.push_back(std::move(one));
  }
  return all;
}

std::string text_of(const StudyPlan &plan, const std::vector<Comparison> &comparisons) {
  const auto specimen = [&](std::size_t k) {
    const double pressure = label(plan, k, "confining_pressure_pa");
    return fmt::format("{} {:.3g}", plan.cases[k].surface, label(plan, k, "slenderness")) +
           (pressure > 0 ? fmt::format(" {:.3g} MPa", 1e-6 * pressure) : "");
  };
  std::size_t widths[2] = {0, 0};
  for (const Comparison &c : comparisons) {
    widths[0] = std::max(widths[0], specimen(c.of).size());
    widths[1] = std::max(widths[1], specimen(c.over).size());
  }
  std::string text;
  for (const Comparison &c : comparisons) {
    text += fmt::format("  {:<35}  {:<{}} / {:<{}}  ", word(c.effect), specimen(c.of), widths[0],
                        specimen(c.over), widths[1]);
    if (c.laboratory == nullptr)
      text += text_of(c.ratio, 1) + '\n';
    else
      text += fmt::format("{:<16}  laboratory {}\n", text_of(c.ratio, 1), words(*c.laboratory));
  }
  return text;
}

} // namespace platen::apps
