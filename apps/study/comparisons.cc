#include "apps/study/comparisons.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/scene/surfaces.h"
#include "apps/study/tables.h"

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

// What a case presses.
struct Pressed {
  double friction, slenderness, sphere_radius, pressure;
  std::string surface;

  Pressed(const StudyPlan &plan, std::size_t k) : surface(plan.cases[k].surface) {
    const auto label = [&](const char *column) { return plan.cases[k].labels[plan.place_of(column)]; };
    friction = label("friction_static"), slenderness = label("slenderness");
    sphere_radius = label("sphere_radius_m"), pressure = label("confining_pressure_pa");
  }
  bool has_free_ends() const { return friction <= free_friction; }
  bool has_steel() const {
    return (friction >= steel_friction || surface == apps::surface(SurfaceKind::weakening_steel).word) &&
           surface != apps::surface(SurfaceKind::rubber_sheet).word &&
           surface != apps::surface(SurfaceKind::brush).word;
  }
  std::string text() const {
    return fmt::format("{} {:.3g}", surface, slenderness) +
           (pressure > 0 ? fmt::format(" {:.3g} MPa", 1e-6 * pressure) : "");
  }
};

// Whether a strength may stand over another of the same grains and pressure; what is taken of several.
bool may_stand_over(PlatenEffect effect, const Pressed &own, const Pressed &other) {
  if (effect == PlatenEffect::gain)
    return equal(own.slenderness, other.slenderness) && other.has_free_ends() &&
           !(other.friction >= own.friction);
  if (own.surface != other.surface) return false;
  return effect == PlatenEffect::relative_strength
             ? !equal(own.slenderness, 2) && equal(other.slenderness, 2)
             : equal(own.slenderness, 1) && other.slenderness >= 2 * (1 - nearly);
}
double rank(PlatenEffect effect, const Pressed &other) { // the least; of equal ones the first
  if (effect == PlatenEffect::gain) return other.friction;
  return effect == PlatenEffect::cube_over_prism ? std::abs(other.slenderness - laboratory_prism) : 0;
}

std::optional<std::size_t> compared_with(PlatenEffect effect, const std::vector<Pressed> &all,
                                         std::size_t k) {
  std::optional<std::size_t> best;
  for (std::size_t other = 0; other < all.size(); ++other)
    if (other != k && equal(all[k].sphere_radius, all[other].sphere_radius) &&
        equal(all[k].pressure, all[other].pressure) && may_stand_over(effect, all[k], all[other]) &&
        (!best || rank(effect, all[other]) < rank(effect, all[*best])))
      best = other;
  return best;
}

std::vector<Pressed> pressed_of(const StudyPlan &plan) {
  std::vector<Pressed> all;
  for (std::size_t k = 0; k < plan.cases.size(); ++k)
    all.emplace_back(plan, k);
  return all;
}

std::string laboratory_text(const Comparison &c) {
  const LaboratoryFigure &f = *c.laboratory;
  const std::string range = f.low < f.high ? fmt::format(" ({:.2f} ... {:.2f})", f.low, f.high) : "";
  return fmt::format("{} {:.2f}{}, {}",
                     c.verdict() == std::string("outside") ? "outside the laboratory's" : "laboratory",
                     f.mean, range, f.source);
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
  std::vector<Comparison> comparisons;
  const std::vector<Pressed> all = pressed_of(plan);
  for (std::size_t k = 0; k < all.size(); ++k)
    for (const PlatenEffect effect :
         {PlatenEffect::gain, PlatenEffect::relative_strength, PlatenEffect::cube_over_prism}) {
      const std::optional<std::size_t> below = compared_with(effect, all, k);
      if (!below) continue;
      Comparison one{effect, k, *below};
      one.reason = bonds.against(needed_for(effect));
      for (std::size_t seed = 0; one.reason.empty() && seed < plan.seeds.size(); ++seed)
        one.ratio.add(strengths[k][seed] / strengths[*below][seed]);
      if (all[k].pressure == 0 && (all[k].has_free_ends() || all[k].has_steel()))
        one.laboratory = laboratory_figure(effect, all[k].has_free_ends(), all[k].slenderness);
      comparisons.push_back(std::move(one));
    }
  return comparisons;
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
  for (const Comparison &c : comparisons) {
    Json one{{"effect", word(c.effect)}, {"case", plan.cases[c.of].name}, {"over", plan.cases[c.over].name}};
    one.update(json_of(c.ratio, "runs"));
    one["laboratory"] = c.laboratory == nullptr ? Json() : Json(*c.laboratory);
    if (*c.verdict() != '\0') one["verdict"] = c.verdict();
    if (!c.reason.empty()) one["reason"] = c.reason;
    all.push_back(std::move(one));
  }
  return all;
}

void write_comparisons(const std::filesystem::path &csv, const Json &comparisons) {
  write_table(csv,
              {"effect", "case", "over", "mean", "deviation", "runs", "laboratory/mean", "laboratory/low",
               "laboratory/high", "verdict", "laboratory/source", "reason"},
              comparisons);
}

std::string text_of(const StudyPlan &plan, const std::vector<Comparison> &comparisons) {
  const std::vector<Pressed> all = pressed_of(plan);
  std::size_t widths[2] = {0, 0};
  for (const Comparison &c : comparisons) {
    widths[0] = std::max(widths[0], all[c.of].text().size());
    widths[1] = std::max(widths[1], all[c.over].text().size());
  }
  std::string text;
  for (const Comparison &c : comparisons) {
    text += fmt::format("  {:<35}  {:<{}} / {:<{}}  ", word(c.effect), all[c.of].text(), widths[0],
                        all[c.over].text(), widths[1]);
    if (!c.reason.empty())
      text += "none: " + c.reason + '\n';
    else if (c.laboratory == nullptr)
      text += text_of(c.ratio, 1) + '\n';
    else
      text += fmt::format("{:<26}  {}\n", text_of(c.ratio, 1), laboratory_text(c));
  }
  return text;
}

} // namespace platen::apps
