#include "apps/scene/layers.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "apps/scene/parameters.h"
#include "apps/scene/values.h"

namespace platen::apps {
namespace {

std::vector<std::string> pieces(const std::string &text, char between) {
  std::vector<std::string> found;
  for (std::size_t first = 0; first <= text.size();) {
    const std::size_t end = std::min(text.find(between, first), text.size());
    found.push_back(tidy(text.substr(first, end - first)));
    first = end + 1;
  }
  return found;
}

bool begins_number(const std::string &word) {
  const char first = word.empty() ? ' ' : word[0];
  return std::isdigit(static_cast<unsigned char>(first)) || first == '.' || first == '-' || first == '+';
}

// The words up to the first that begins a number are the name.
NamedLayer read_layer(const std::string &text) {
  std::size_t number = 0;
  while (number < text.size() && !begins_number(text.substr(number)))
    number = std::min(text.find(' ', number), text.size() - 1) + 1;
  NamedLayer layer{tidy(text.substr(0, number)), not_given};
  if (layer.material.empty()) throw ValueError("names no material");
  if (number < text.size()) layer.thickness = read_quantity(text.substr(number), "m", above(0));
  return layer;
}

double read_constant(const std::string &what, const std::string &text, const char *unit, const Range &range) {
  try {
    if (text.empty()) throw ValueError("is empty");
    return Quantity(what, unit, range).read(text);
  } catch (const ValueError &error) {
    throw ValueError("has a " + what + ", \"" + text + "\", that " + error.what());
  }
}

NamedMaterial read_material(const std::string &text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) throw ValueError("has no colon after the name");
  NamedMaterial named{tidy(text.substr(0, colon)), {}};
  if (named.name.empty() || begins_number(named.name) || named.name.find(',') != std::string::npos)
    throw ValueError("does not begin with a name");
  if (named.name == own_material) throw ValueError("has the name of the own material of the platens");
  const std::vector<std::string> constants = pieces(text.substr(colon + 1), ',');
  if (constants.size() != 3) throw ValueError("needs three numbers: Young modulus, Poisson ratio, density");
  named.material.young_modulus = read_constant("Young modulus", constants[0], "Pa", above(0));
  named.material.poisson_ratio = read_constant("Poisson ratio", constants[1], "1", between_open(-1, 0.5));
  named.material.density = read_constant("density", constants[2], "kg/m3", above(0));
  return named;
}

template <class Value, class Read>
std::vector<Value> read_each(const std::string &text, char between, const char *what, const Read &read) {
  std::vector<Value> values;
  if (tidy(text).empty()) return values;
  for (const std::string &piece : pieces(text, between))
    try {
      values.push_back(read(piece));
    } catch (const ValueError &error) {
      throw ValueError(std::string("holds a ") + what + ", \"" + piece + "\", that " + error.what());
    }
  return values;
}

const fem::Material &material_named(const std::string &name, const std::string &path,
                                    const Parameters &parameters, const Platens &platens) {
  if (name == own_material) return platens.material;
  std::vector<std::string> known{own_material};
  for (const NamedMaterial &one : platens.layer_materials) { // a scene's own numbers go before a ready word's
    if (one.name == name) return one.material;
    known.push_back(one.name);
  }
  for (const ReadyMaterial &one : ready_materials()) {
    if (one.named.name == name) return one.named.material;
    known.push_back(one.named.name);
  }
  const std::string nearest = nearest_word(name, known);
  parameters.refuse(path, "names \"" + name + "\", which Platens/Layer materials does not give." +
                              (nearest.empty() ? "" : " Did you mean \"" + nearest + "\"?") +
                              " Allowed: " + joined(known) + ".");
}

// Gent, On the relation between indentation hardness and Young's modulus, Trans. Inst. Rubber Ind. 34 (1958):
// of a rubber that does not change its volume, from its hardness Shore A. Pa.
constexpr double modulus_of_hardness(double shore) {
  return 0.0981e6 * (56 + 7.62336 * shore) / (0.137505 * (254 - 2.54 * shore));
}

// What Gent's rubber has is 1/2; elements of finite stiffness need less, and lock when it is much nearer.
constexpr double poisson_of_rubber = 0.49;

ReadyMaterial neoprene(double shore) {
  constexpr double density = 1230; // kg/m3, polychloroprene without fillers
  const std::string hardness = "A" + shortest_text(shore);
  return {{"neoprene " + hardness, {density, modulus_of_hardness(shore), poisson_of_rubber}},
          "hardness Shore " + hardness + " by Gent 1958; no ring holds its rim"};
}

std::string documentation(const ReadyMaterial &of) {
  const fem::Material &is = of.named.material;
  return of.named.name + ": " +
         fmt::format("{:.4g} MPa, {:.3g}, {:.4g} kg/m3", is.young_modulus * 1e-6, is.poisson_ratio,
                     is.density) +
         " (" + of.source + ")";
}

// Returns how thick they are together (m), as far as that is given.
double supply(const Parameters &parameters, const Platens &platens, const std::string &path,
              const std::vector<NamedLayer> &named, std::vector<coupling::PlatenLayer> &layers) {
  double sum = 0;
  for (const NamedLayer &one : named) {
    const double thickness = std::isnan(one.thickness) ? 0 : one.thickness;
    layers.push_back(
        {thickness, material_named(one.material, path, parameters, platens), one.material == own_material});
    sum += thickness;
  }
  return sum;
}

} // namespace

// Poisson's ratio of gypsum: pores take a solid's towards .2 (Roberts and Garboczi, Proc. R. Soc. A 458
// (2002)); density of a cast of .6 of water to plaster. Sulphur has no word: no modulus of capping compound
// was found.
const std::vector<ReadyMaterial> &ready_materials() {
  static const std::vector<ReadyMaterial> all = [] {
    std::vector<ReadyMaterial> made(1);
    made[0].named = {"gypsum", {1200, 9.8e9, 0.2}};
    made[0].source =
        "cast and dry, some 1e5 kg/cm2: Kishitani and Hirai, Trans. Archit. Inst. Japan, series of 1977, "
        "part 3";
    for (const double shore : {50., 60., 70.}) // as ASTM C1231 names them
      made.push_back(neoprene(shore));
    return made;
  }();
  return all;
}

std::string layer_documentation() {
  std::string text;
  for (const ReadyMaterial &one : ready_materials())
    text += (text.empty() ? "" : "; ") + documentation(one);
  return text + ".";
}

std::string text_of_layers(const Platens &platens) {
  const auto names = [](const std::vector<NamedLayer> &layers, const std::string &word) {
    return std::any_of(layers.begin(), layers.end(),
                       [&](const NamedLayer &one) { return one.material == word; });
  };
  std::string text;
  for (const ReadyMaterial &one : ready_materials()) {
    const std::string &word = one.named.name;
    const bool own = std::any_of(platens.layer_materials.begin(), platens.layer_materials.end(),
                                 [&](const NamedMaterial &given) { return given.name == word; });
    if (platens.deformable && !own &&
        (names(platens.layers, word) || names(platens.top_layers, word) ||
         names(platens.bottom_layers, word)))
      text += "    " + documentation(one) + "\n";
  }
  return text;
}

std::vector<NamedLayer> read_layers(const std::string &text) {
  return read_each<NamedLayer>(text, ',', "layer", read_layer);
}

std::vector<NamedMaterial> read_layer_materials(const std::string &text) {
  const std::vector<NamedMaterial> all = read_each<NamedMaterial>(text, ';', "material", read_material);
  for (std::size_t k = 0; k < all.size(); ++k)
    for (std::size_t other = 0; other < k; ++other)
      if (all[k].name == all[other].name) throw ValueError("gives " + all[k].name + " twice");
  return all;
}

void supply_layers(const Parameters &parameters, Platens &platens) {
  const double all = supply(parameters, platens, "Platens/Layers", platens.layers, platens.elastic->layers);
  platens.top.thickness =
      supply(parameters, platens, "Platens/Top/Layers", platens.top_layers, platens.top.layers);
  platens.bottom.thickness =
      supply(parameters, platens, "Platens/Bottom/Layers", platens.bottom_layers, platens.bottom.layers);
  if (!platens.deformable || platens.thickness > 0)
    platens.top.thickness = platens.bottom.thickness = 0;
  else
    platens.thickness = all;
}

} // namespace platen::apps
