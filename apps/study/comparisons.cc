#include "apps/study/comparisons.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/output/csv_writer.h"
#include "apps/scene/surfaces.h"

namespace platen::apps {
namespace {

// Which of `Bond / Calibrated figures` an effect needs.
CalibratedFigure needed_for(PlatenEffect effect) {
  return effect == PlatenEffect::gain ? CalibratedFigure::friction : CalibratedFigure::slenderness;
}

// Slenderness of the prisms that cubes are compared with.
constexpr double laboratory_prism = 2.39; // Hughes and Bahramian 1967: 244 mm x 102 mm

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

// Strengths of four mixes, MPa: cubes of 102 mm and prisms of 102 mm x 244 mm, between platens and with free
// ends.
struct Mix {
  double cube, prism, cube_free, prism_free;
};
constexpr Mix mixes[] = {{59, 41, 37, 37}, {100, 68, 68, 66}, {41, 34, 34, 31}, {90, 66, 64, 61}};
constexpr const char *hughes = "Hughes and Bahramian 1967, four mixes";

LaboratoryFigure of_mixes(PlatenEffect effect, bool free_ends, double slenderness, double Mix::*strength,
                          double Mix::*reference, const char *source = hughes) {
  LaboratoryFigure figure{effect, free_ends, slenderness, 0, INFINITY, -INFINITY, source};
  for (const Mix &mix : mixes) {
    const double ratio = mix.*strength / (mix.*reference);
    figure.mean += ratio / std::size(mixes);
    figure.low = std::min(figure.low, ratio);
    figure.high = std::max(figure.high, ratio);
  }
  return figure;
}

// Factors that reduce a short core's strength to that at 2; concrete of 14 to 41 MPa. They have no scatter:
// what lies within 5 % counts as the same, as in bench/results/one_concrete.md.
constexpr double same_core = 0.05;
constexpr const char *cores = "ASTM C42, a factor without scatter: 5 % to both sides";
LaboratoryFigure of_cores(double slenderness, double factor, const char *source = cores) {
  const double ratio = 1 / factor;
  return {PlatenEffect::relative_strength, false, slenderness, ratio, (1 - same_core) * ratio,
          (1 + same_core) * ratio,         source};
}

std::vector<LaboratoryFigure> all_figures() {
  constexpr bool free_ends = true, steel = false;
  constexpr const char *flatter =
      "textbook table of core corrections, after ASTM C42, without scatter: 5 % to both sides";
  // Nobody was read who has a gain at 2: that of somewhat more slender prisms is the nearest.
  constexpr const char *prisms = "Hughes and Bahramian 1967, four mixes, prisms of 2.39";
  return {of_mixes(PlatenEffect::gain, steel, 1, &Mix::cube, &Mix::cube_free),
          of_mixes(PlatenEffect::gain, steel, laboratory_prism, &Mix::prism, &Mix::prism_free),
          of_mixes(PlatenEffect::gain, steel, 2, &Mix::prism, &Mix::prism_free, prisms),
          of_mixes(PlatenEffect::cube_over_prism, steel, 1, &Mix::cube, &Mix::prism),
          of_mixes(PlatenEffect::cube_over_prism, free_ends, 1, &Mix::cube_free, &Mix::prism_free),
          of_cores(1, 0.87),
          of_cores(1.25, 0.93),
          of_cores(1.5, 0.96),
          of_cores(1.75, 0.98),
          of_cores(0.75, 0.70, flatter),
          of_cores(0.5, 0.50, flatter)};
}

class Comparing {
public:
  Comparing(const StudyPlan &plan, const std::vector<std::vector<double>> &strengths,
            const CalibratedFor &bonds)
      : plan_(plan), strengths_(strengths), bonds_(bonds) {}
  // What case k is compared with.
  void add_all(std::size_t k);
  std::vector<Comparison> comparisons;

private:
  double friction(std::size_t k) const { return label(plan_, k, "friction_static"); }
  double slenderness(std::size_t k) const { return label(plan_, k, "slenderness"); }
  bool alike(std::size_t a, std::size_t b, const char *column) const {
    return equal(label(plan_, a, column), label(plan_, b, column));
  }
  bool same_platens(std::size_t a, std::size_t b) const {
    return plan_.cases[a].surface == plan_.cases[b].surface;
  }

  // Compares with the case of the same grains and pressure that may be taken and has the least rank; of
  // several with the first.
  template <class May, class Rank>
  void add(PlatenEffect effect, std::size_t k, const May &may, const Rank &rank) {
    std::optional<std::size_t> best;
    for (std::size_t other = 0; other < plan_.cases.size(); ++other)
      if (other != k && alike(k, other, "sphere_radius_m") && alike(k, other, "confining_pressure_pa") &&
          may(other) && (!best || rank(other) < rank(*best)))
        best = other;
    if (best) add(effect, k, *best);
  }

  void add(PlatenEffect effect, std::size_t of, std::size_t over) {
    Comparison comparison{effect, of, over, {}, nullptr, bonds_.against(needed_for(effect))};
    for (std::size_t seed = 0; comparison.reason.empty() && seed < plan_.seeds.size(); ++seed)
      comparison.ratio.add(strengths_[of][seed] / strengths_[over][seed]);
    const std::string &faces = plan_.cases[of].surface;
    const bool free_ends = friction(of) <= free_friction,
               steel = friction(of) >= steel_friction && faces != surface(SurfaceKind::rubber_sheet).word &&
                       faces != surface(SurfaceKind::brush).word;
    if (label(plan_, of, "confining_pressure_pa") == 0 && (free_ends || steel))
      comparison.laboratory = laboratory_figure(effect, free_ends, slenderness(of));
    comparisons.push_back(std::move(comparison));
  }

  const StudyPlan &plan_;
  const std::vector<std::vector<double>> &strengths_;
  const CalibratedFor &bonds_;
};

void Comparing::add_all(std::size_t k) {
  add(
      PlatenEffect::gain, k,
      [&](std::size_t other) {
        return alike(k, other, "slenderness") && friction(other) <= free_friction &&
               !(friction(other) >= friction(k));
      },
      [&](std::size_t other) { return friction(other); });
  if (equal(slenderness(k), 2)) return;
  add(
      PlatenEffect::relative_strength, k,
      [&](std::size_t other) { return same_platens(k, other) && equal(slenderness(other), 2); },
      [](std::size_t) { return 0; });
  if (!equal(slenderness(k), 1)) return;
  add(
      PlatenEffect::cube_over_prism, k,
      [&](std::size_t other) { return same_platens(k, other) && slenderness(other) >= 2 * (1 - nearly); },
      [&](std::size_t other) { return std::abs(slenderness(other) - laboratory_prism); });
}

std::string words(const LaboratoryFigure &f) {
  const std::string range = f.low < f.high ? fmt::format(" ({:.2f} ... {:.2f})", f.low, f.high) : "";
  return fmt::format("{:.2f}{}, {}", f.mean, range, f.source);
}

// Of the mean against the laboratory; "" where there is nothing to judge.
const char *verdict(const Comparison &c) {
  if (c.laboratory == nullptr || c.ratio.count() == 0) return "";
  return c.outside() ? "outside" : "within";
}

} // namespace

const char *word(PlatenEffect effect) {
  constexpr const char *words[] = {"gain over free ends", "strength over that at slenderness 2",
                                   "cube over prism"};
  return words[static_cast<std::size_t>(effect)];
}

const std::vector<LaboratoryFigure> &laboratory_figures() {
  static const std::vector<LaboratoryFigure> figures = all_figures();
  return figures;
}

const LaboratoryFigure *laboratory_figure(PlatenEffect effect, bool free_ends, double slenderness) {
  constexpr double about = 0.05; // of the slenderness: a specimen of 2.4 stands beside one of 2.39
  const auto found =
      std::find_if(laboratory_figures().begin(), laboratory_figures().end(), [&](const LaboratoryFigure &f) {
        return f.effect == effect && f.free_ends == free_ends &&
               std::abs(f.slenderness - slenderness) <= about * f.slenderness;
      });
  return found == laboratory_figures().end() ? nullptr : &*found;
}

std::vector<Comparison> compare(const StudyPlan &plan, const std::vector<std::vector<double>> &strengths,
                                const CalibratedFor &bonds) {
  Comparing comparing(plan, strengths, bonds);
  for (std::size_t k = 0; k < plan.cases.size(); ++k)
    comparing.add_all(k);
  return std::move(comparing.comparisons);
}

void write_comparisons(const std::filesystem::path &csv, const StudyPlan &plan,
                       const std::vector<Comparison> &comparisons) {
  WholeTable rows(csv, {"effect", "case", "over", "mean", "deviation", "runs", "laboratory_mean",
                        "laboratory_low", "laboratory_high", "verdict", "laboratory_source", "reason"});
  for (const Comparison &c : comparisons) {
    const LaboratoryFigure *l = c.laboratory;
    rows.row({word(c.effect), plan.cases[c.of].name, plan.cases[c.over].name, c.ratio.mean(),
              c.ratio.deviation(), c.ratio.count(), l ? l->mean : not_given, l ? l->low : not_given,
              l ? l->high : not_given, verdict(c), l ? l->source.c_str() : "", c.reason});
  }
  rows.finish();
}

void to_json(Json &json, const LaboratoryFigure &figure) {
  json = {{"effect", word(figure.effect)},
          {"platens", figure.free_ends ? "free ends" : "steel"},
          {"slenderness", figure.slenderness},
          {"mean", figure.mean},
          {"low", figure.low},
          {"high", figure.high},
          {"source", figure.source}};
}

Json json_of(const StudyPlan &plan, const std::vector<Comparison> &comparisons) {
  Json all = Json::array();
  const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
  for (const Comparison &c : comparisons) {
    Json one{{"effect", word(c.effect)},
             {"case", plan.cases[c.of].name},
             {"over", plan.cases[c.over].name},
             {"mean", number(c.ratio.mean())},
             {"deviation", number(c.ratio.deviation())},
             {"low", number(c.ratio.least())},
             {"high", number(c.ratio.largest())},
             {"runs", c.ratio.count()}};
    one["laboratory"] = c.laboratory == nullptr ? Json() : Json(*c.laboratory);
    if (*verdict(c) != '\0') one["verdict"] = verdict(c);
    if (!c.reason.empty()) one["reason"] = c.reason;
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
    const char *beside = c.outside() ? "outside the laboratory's" : "laboratory";
    if (!c.reason.empty())
      text += "none: " + c.reason + '\n';
    else if (c.laboratory == nullptr)
      text += text_of(c.ratio, 1) + '\n';
    else
      text += fmt::format("{:<26}  {} {}\n", text_of(c.ratio, 1), beside, words(*c.laboratory));
  }
  return text;
}

} // namespace platen::apps
