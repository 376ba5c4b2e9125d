#include "apps/study/laboratory.h"

#include <algorithm>
#include <cmath>

namespace platen::apps {
namespace {

// Strengths of four mixes, MPa: cubes of 102 mm and prisms of 102 mm x 244 mm, between platens and with free
// ends.
struct Mix {
  double cube, prism, cube_free, prism_free;
};
constexpr Mix mixes[] = {{59, 41, 37, 37}, {100, 68, 68, 66}, {41, 34, 34, 31}, {90, 66, 64, 61}};
constexpr const char *hughes = "Hughes and Bahramian 1967, four mixes";

LaboratoryFigure of_mixes(PlatenEffect effect, bool free_ends, double slenderness, double Mix::*strength,
                          double Mix::*reference) {
  LaboratoryFigure figure{effect, free_ends, slenderness, 0, INFINITY, -INFINITY, hughes};
  for (const Mix &mix : mixes) {
    const double ratio = mix.*strength / (mix.*reference);
    figure.mean += ratio / std::size(mixes);
    figure.low = std::min(figure.low, ratio);
    figure.high = std::max(figure.high, ratio);
  }
  return figure;
}

// Factors that reduce a short core's strength to that at 2; concrete of 14 to 41 MPa.
LaboratoryFigure of_astm(double slenderness, double factor) {
  return {
      PlatenEffect::relative_strength, false, slenderness, 1 / factor, 1 / factor, 1 / factor, "ASTM C42"};
}

LaboratoryFigure of_rilem(bool teflon, double slenderness, double low, double high) {
  return {PlatenEffect::relative_strength,
          teflon,
          slenderness,
          0.5 * (low + high),
          low,
          high,
          "RILEM TC 148-SSC (van Mier et al. 1997), from memory"};
}

std::vector<LaboratoryFigure> all() {
  constexpr bool free_ends = true, steel = false;
  std::vector<LaboratoryFigure> figures{
      of_mixes(PlatenEffect::gain, steel, 1, &Mix::cube, &Mix::cube_free),
      of_mixes(PlatenEffect::gain, steel, laboratory_prism, &Mix::prism, &Mix::prism_free),
      of_mixes(PlatenEffect::cube_over_prism, steel, 1, &Mix::cube, &Mix::prism),
      of_mixes(PlatenEffect::cube_over_prism, free_ends, 1, &Mix::cube_free, &Mix::prism_free)};
  const auto add = [&](const std::vector<LaboratoryFigure> &more) {
    figures.insert(figures.end(), more.begin(), more.end());
  };
  add({of_astm(1, 0.87), of_astm(1.25, 0.93), of_astm(1.5, 0.96), of_astm(1.75, 0.98)});
  add({of_rilem(steel, 0.5, 1.5, 2.0), of_rilem(steel, 1, 1.1, 1.4), of_rilem(steel, 4, 0.95, 1.0)});
  for (const double slenderness : {0.5, 1.0, 4.0})
    add({of_rilem(free_ends, slenderness, 0.95, 1.1)});
  return figures;
}

} // namespace

const char *word(PlatenEffect effect) {
  switch (effect) {
    case PlatenEffect::gain:
      return "gain over free ends";
    case PlatenEffect::relative_strength:
      return "strength over that at slenderness 2";
    case PlatenEffect::cube_over_prism:
      break;
  }
  return "cube over prism";
}

const std::vector<LaboratoryFigure> &laboratory_figures() {
  static const std::vector<LaboratoryFigure> figures = all();
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

} // namespace platen::apps
