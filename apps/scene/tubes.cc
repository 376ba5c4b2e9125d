#include "apps/scene/tubes.h"

#include <algorithm>
#include <cmath>

#include "apps/scene/parameters.h"
#include "apps/scene/text_table.h"
#include "apps/scene/texts.h"
#include "base/shortest_text.h"

namespace platen::apps {
namespace {

struct SteelWord {
  Steel kind;
  std::string word, yield_strength, ultimate_strength;
};

// EN 10025-2 and EN 1993-1-1, tables 3.1: walls up to 16 mm.
const std::vector<SteelWord> &steels() {
  static const std::vector<SteelWord> all{{Steel::s235, "S235", "235 MPa", "360 MPa"},
                                          {Steel::s275, "S275", "275 MPa", "430 MPa"},
                                          {Steel::s355, "S355", "355 MPa", "510 MPa"}};
  return all;
}

// EN 1993-1-1, 3.2.6; density EN 1991-1-1.
const std::vector<std::pair<std::string, std::string>> of_steel = {
    {"Modulus", "210 GPa"}, {"Poisson ratio", "0.3"}, {"Density", "7850 kg/m3"}};
// Density and Poisson's ratio of laminates of carbon: docs/theory.md. The rest as of tubes.
const std::vector<std::pair<std::string, std::string>> of_wraps = {
    {"Poisson ratio", "0.35"}, {"Density", "1600 kg/m3"}, {"Rims", "sliding"}, {"Damping", "100"}};
// Two elements bend with the wall. Its inertia is scaled, and damping acts on the scaled mass: less than
// for rubber.
const std::vector<std::pair<std::string, std::string>> of_tubes = {
    {"Elements through", "2"}, {"Rims", "sliding"}, {"Damping", "100"}, {"Friction", "0.57"}};

} // namespace

std::vector<std::pair<std::string, Steel>> steel_words() {
  std::vector<std::pair<std::string, Steel>> words{{"custom", Steel::custom}};
  for (const SteelWord &one : steels())
    words.emplace_back(one.word, one.kind);
  return words;
}

std::string steel_documentation() {
  std::string text = "custom: the entries of the scene; the others set ";
  for (const auto &[key, value] : of_steel)
    text += key + " = " + value + ", ";
  for (const SteelWord &one : steels())
    text += (&one == &steels().front() ? "and " : "; ") + one.word +
            ": Yield strength = " + one.yield_strength + ", Ultimate strength = " + one.ultimate_strength;
  return text + " (EN 1993-1-1, walls up to 16 mm).";
}

void supply_tube(Parameters &parameters, const Loading &loading) {
  if (!loading.tubed()) return;
  const auto supply = [&](const std::string &key, const std::string &value, const char *by) {
    parameters.supply("Sleeve/" + key, value, parameters.at(std::string("Sleeve/") + by).origin);
  };
  for (const auto &[key, value] : loading.wrapped() ? of_wraps : of_tubes)
    supply(key, value, "Kind");
  if (loading.wrapped()) return;
  for (const SteelWord &one : steels()) {
    if (one.kind != loading.steel) continue;
    for (const auto &[key, value] : of_steel)
      supply(key, value, "Steel");
    supply("Yield strength", one.yield_strength, "Steel");
    if (loading.hardening_file.empty()) supply("Ultimate strength", one.ultimate_strength, "Steel");
  }
}

std::vector<fem::Hardening::Point> read_hardening(const std::filesystem::path &path, double yield_strength) {
  TextPlace place;
  place.file = path.string();
  KnownColumns known;
  known.words = {{"plastic_strain", 0}, {"flow_stress_pa", 1}, {"flow_stress_mpa", 1, 1e6}};
  known.needed = 2;
  TextTable table(known);
  std::vector<fem::Hardening::Point> points;
  read_lines(path, place, [&](std::string_view line) {
    const std::string text = trimmed(std::string(line));
    if (text.empty() || text.front() == '#') return true;
    if (!table.is_named()) {
      table.take_header(text, place);
      return true;
    }
    table.read_row(text, place);
    const fem::Hardening::Point point{table.value(0), table.value(1)};
    const double strain = points.empty() ? 0 : points.back().strain,
                 stress = points.empty() ? yield_strength : points.back().stress;
    if (points.empty() && point.strain == 0 && point.stress == yield_strength) return true; // the yield point
    if (!(point.strain > strain) || !(point.stress >= stress))
      place.fail("the plastic strain has to ascend and the flow stress must not fall. Allowed: above " +
                 shortest_text(strain) + ", and " + shortest_text(stress) + " Pa or more.");
    if (points.size() + 2 > fem::Hardening::most_points)
      place.fail("there are more points than a hardening may have. Allowed: up to " +
                 std::to_string(fem::Hardening::most_points - 1) + ".");
    points.push_back(point);
    return true;
  });
  if (points.empty()) place.fail("the file holds no point beyond the yield strength.");
  return points;
}

} // namespace platen::apps
