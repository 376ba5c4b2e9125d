#include "apps/scene/surfaces.h"

#include <algorithm>
#include <cmath>

#include "apps/scene/parameters.h"
#include "apps/scene/units.h"
#include "apps/scene/values.h"

namespace platen::apps {
namespace {

// "word: entries (source)"; friction is constant unless a law is named.
std::string documentation(const Surface &of) {
  std::string text;
  for (const auto &[key, value] : of.entries)
    if (value != "constant") text += (text.empty() ? "" : ", ") + key + " = " + value;
  return of.word + ": " + (text.empty() ? of.source : text + " (" + of.source + ")");
}

} // namespace

const std::vector<Surface> &surfaces() {
  static const std::vector<Surface> all{
      {SurfaceKind::custom, "custom", {}, false, "the entries of the scene and their defaults"},
      {SurfaceKind::dry_steel,
       "dry steel",
       {{"Friction static", "0.57"}, {"Friction dynamic", "0.57"}, {"Friction law", "constant"}},
       true,
       "Rabbat and Russell 1985, dry steel on concrete, static; while sliding: the same, for want of a "
       "figure"},
      {SurfaceKind::weakening_steel,
       "steel slip weakening",
       {{"Friction static", "0.13"},
        {"Friction dynamic", "0.015"},
        {"Friction law", "slip weakening"},
        {"Slip length", "1.3 mm"}},
       true,
       "the law of Cusatis et al. 2011 with the figures that public codes of it use for dry steel"},
      {SurfaceKind::thesis,
       "thesis",
       {{"Friction static", "0.3"}, {"Friction dynamic", "0.3"}, {"Friction law", "constant"}},
       true,
       "Tannu 2017"},
      {SurfaceKind::teflon,
       "teflon",
       {{"Friction static", "0.03"}, {"Friction dynamic", "0.03"}, {"Friction law", "constant"}},
       true,
       "EN 1337-2 for sheets of PTFE on steel, 0.03 to 0.08, least at high pressure"},
      {SurfaceKind::grease,
       "grease",
       {{"Friction static", "0.0048"}, {"Friction dynamic", "0.0048"}, {"Friction law", "constant"}},
       true,
       "Bocklenberg et al. 2016, greased sheets of PTFE under 60 MPa, at most"},
      {SurfaceKind::brush,
       "brush",
       {{"Friction static", "0.57"},
        {"Friction dynamic", "0.57"},
        {"Friction law", "constant"},
        {"Kind", "deformable"},
        {"Degree", "2"}},
       false,
       "as dry steel; what the pins give way is in their meshes"},
      {SurfaceKind::rubber_sheet,
       "rubber sheet",
       {{"Friction static", "0.5"},
        {"Friction dynamic", "0.5"},
        {"Friction law", "constant"},
        {"Kind", "deformable"}},
       false,
       "Magliulo et al. 2011, neoprene on concrete, tilting tests; thickness and material are the scene's "
       "(Pad ...)"},
      {SurfaceKind::glued, "glued", {{"Attachment", "glued"}}, false, "end grains are tied to the platens"}};
  return all;
}

const Surface &surface(SurfaceKind kind) {
  return *std::find_if(surfaces().begin(), surfaces().end(),
                       [&](const Surface &one) { return one.kind == kind; });
}

std::vector<std::pair<std::string, SurfaceKind>> surface_words(bool of_one_side) {
  std::vector<std::pair<std::string, SurfaceKind>> words;
  if (of_one_side) words.emplace_back("common", SurfaceKind::common);
  for (const Surface &one : surfaces())
    if (one.of_one_side || !of_one_side) words.emplace_back(one.word, one.kind);
  return words;
}

std::string surface_documentation() {
  std::string text;
  for (const Surface &one : surfaces())
    text += (text.empty() ? "" : "; ") + documentation(one);
  return text + ".";
}

std::vector<StudySurface> read_surfaces(const std::string &text) {
  return read_items<StudySurface>(text, [](const std::string &item) -> StudySurface {
    const bool number = item.find_first_of("0123456789.") == 0;
    if (number) return {SurfaceKind::custom, read_quantity(item, "1", between(0, 5))};
    std::vector<std::string> words;
    for (const Surface &one : surfaces())
      words.push_back(one.word);
    return {surfaces()[read_word(item, words)].kind, not_given};
  });
}

std::string text_of(const StudySurface &surface) {
  return std::isnan(surface.friction) ? apps::surface(surface.kind).word : shortest_text(surface.friction);
}

std::string text_of(const Platens &platens) {
  using By = dem::Weakening::By;
  const auto kind = [&](const Face &face) {
    return face.surface == SurfaceKind::common ? platens.surface : face.surface;
  };
  const auto told = [&](const Face &face, const dem::SurfaceFriction &side) {
    std::string text = surface(kind(face)).word + ", friction " + shortest_text(side.friction_static) +
                       " static, " + shortest_text(side.friction_dynamic) + " dynamic";
    if (side.weakening.by == By::slip)
      text += ", slip weakening over " + shortest_text(side.weakening.slip_length) + " m";
    if (side.weakening.by == By::velocity)
      text += ", velocity weakening over " + shortest_text(side.weakening.slip_velocity) + " m/s";
    return platens.glued ? std::string("glued") : text;
  };
  std::vector<std::pair<std::string, std::vector<std::string>>>
      alike; // a description, and the sides that have it
  for (const coupling::Side side : sides_of_scene) {
    if (!platens.has(side)) continue;
    const std::string text = told(platens.face(side), platens.at(side));
    auto found = std::find_if(alike.begin(), alike.end(), [&](const auto &one) { return one.first == text; });
    if (found == alike.end()) found = alike.insert(found, {text, {}});
    found->second.emplace_back(coupling::name_of(side));
  }
  std::string text;
  for (const auto &[what, sides] : alike)
    text += "  " +
            (platens.sides == PlatenSides::two && alike.size() == 1
                 ? "platens"
                 : joined(sides) + (sides.size() == 1 ? " platen" : " platens")) +
            ": " + what + "\n";
  for (const Surface &one : surfaces())
    if (!one.entries.empty() &&
        platens.any_of([&](coupling::Side side) { return one.kind == kind(platens.face(side)); }))
      text += "    " + documentation(one) + "\n";
  return text;
}

void supply_surfaces(Parameters &parameters, const Platens &platens) {
  const auto supply = [&](const std::string &section, SurfaceKind kind) {
    if (kind == SurfaceKind::common) return;
    const Origin word = parameters.at(section + "/Surface").origin;
    for (const auto &[key, text] : surface(kind).entries)
      parameters.supply(section + "/" + key, text, word);
  };
  for (const coupling::Side side : coupling::all_sides)
    supply(section_of(side), platens.face(side).surface);
  supply("Platens", platens.surface);
}

} // namespace platen::apps
