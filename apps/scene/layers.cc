#include "apps/scene/layers.h"

#include <algorithm>
#include <cctype>

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
  for (const NamedMaterial &one : platens.layer_materials) {
    if (one.name == name) return one.material;
    known.push_back(one.name);
  }
  const std::string nearest = nearest_word(name, known);
  parameters.refuse(path, "names \"" + name + "\", which Platens/Layer materials does not give." +
                              (nearest.empty() ? "" : " Did you mean \"" + nearest + "\"?") +
                              " Allowed: " + joined(known) + ".");
}

// Returns how thick they are together (m), as far as that is given.
double supply(const Parameters &parameters, const Platens &platens, const std::string &path,
              const std::vector<NamedLayer> &named, std::vector<coupling::PlatenLayer> &layers) {
  double sum = 0;
  for (const NamedLayer &one : named) {
    const double thickness = std::isnan(one.thickness) ? 0 : one.thickness;
    layers.push_back({thickness, material_named(one.material, path, parameters, platens)});
    sum += thickness;
  }
  return sum;
}

} // namespace

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
