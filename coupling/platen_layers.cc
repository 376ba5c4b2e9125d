#include "coupling/platen_layers.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "base/shortest_text.h"

namespace platen::coupling {
namespace {

// Fraction of a thickness: a smaller rest of a sum of layers is round-off, not a layer.
constexpr double round_off = 1e-9;

// The member that gives the layers of a side.
std::string owner(const PlatenSettings &p, Side side) {
  return std::string("platens.") + (p.side(side)->layers.empty() ? "elastic" : name_of(side)) + ".layers";
}

std::vector<PlatenLayer> given_layers(const PlatenSettings &p, Side side) {
  const std::vector<PlatenLayer> &own = p.side(side)->layers;
  std::vector<PlatenLayer> layers = own.empty() ? p.elastic->layers : own;
  for (PlatenLayer &layer : layers)
    if (layer.own) layer.material = own_material(p);
  return layers;
}

void require_valid(const PlatenLayer &layer, const std::string &member) {
  try {
    fem::check(layer.material, "a layer");
  } catch (const std::invalid_argument &e) {
    throw BadSetup(member, std::string("cannot be: ") + e.what() + ".");
  }
}

std::vector<fem::Material> materials_of_grid(const PlatenSettings &p, Side side) {
  const int volumes = fem::materials_of(p.side(side)->grid);
  const std::string has = "has " + std::to_string(volumes) + " physical volumes: ";
  const std::vector<PlatenLayer> layers = given_layers(p, side);
  std::vector<fem::Material> materials;
  for (const PlatenLayer &layer : layers) {
    require_valid(layer, owner(p, side));
    materials.push_back(layer.material);
  }
  if (!layers.empty() && static_cast<int>(layers.size()) != volumes)
    throw std::invalid_argument(has + "there are " + std::to_string(layers.size()) + " layers in `" +
                                owner(p, side) + "`");
  if (!layers.empty()) return materials;
  if (volumes > 1 && !(p.elastic->pad.young_modulus > 0))
    throw std::invalid_argument(has + "the second needs `platens.elastic.pad_modulus`");
  if (volumes > 2)
    throw std::invalid_argument(has + "two are known without `platens.elastic.layers`, platen and pad");
  materials.push_back(own_material(p));
  if (volumes > 1) materials.push_back(p.elastic->pad);
  return materials;
}

} // namespace

fem::Material own_material(const PlatenSettings &p) {
  fem::Material material = p.material;
  if (p.elastic && p.elastic->metal) material.hardening = p.elastic->metal->hardening(material.young_modulus);
  return material;
}

double thickness_of(const PlatenSettings &settings, Side side) {
  const double own = settings.side(side)->thickness;
  return own > 0 ? own : settings.thickness;
}

std::vector<PlatenLayer> layers_of(const PlatenSettings &p, Side side) {
  const double thickness = thickness_of(p, side);
  const ElasticPlatens &elastic = *p.elastic;
  std::vector<PlatenLayer> layers = given_layers(p, side);
  if (layers.empty() && elastic.pad_thickness > 0)
    return {{elastic.pad_thickness, elastic.pad}, {thickness - elastic.pad_thickness, own_material(p)}};
  double sum = 0;
  for (const PlatenLayer &layer : layers) {
    if (!(layer.thickness > 0))
      throw BadSetup(owner(p, side), "has a layer of no thickness. Allowed: above 0 m each.");
    require_valid(layer, owner(p, side));
    sum += layer.thickness;
  }
  if (sum > (1 + round_off) * thickness)
    throw BadSetup(owner(p, side), "is " + text_of(sum) + " m thick. Allowed: up to " + text_of(thickness) +
                                       " m, the thickness of the platen.");
  if (thickness - sum > round_off * thickness) layers.push_back({thickness - sum, own_material(p)});
  return layers;
}

// A sheet of one element could not bulge at degree 1; for the machine's side this does not matter.
std::vector<fem::Layer> elements_of_layers(const PlatenSettings &p, Side side, double half_width) {
  const std::vector<PlatenLayer> layers = layers_of(p, side);
  std::vector<fem::Layer> elements;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const double alike = 0.5 * p.elements_across * layers[k].thickness / half_width;
    const bool fixed = k + 1 == layers.size();
    const int least = layers.size() == 1 ? 2 : fixed ? 1 : 2 / p.elastic->degree;
    elements.push_back({layers[k].thickness, std::max(least, static_cast<int>(std::lround(alike)))});
  }
  if (!is_high(side)) std::reverse(elements.begin(), elements.end());
  return elements;
}

std::vector<fem::Material> materials_of(const PlatenSettings &p, Side side) {
  if (p.side(side)->grid) return materials_of_grid(p, side);
  std::vector<fem::Material> materials;
  for (const PlatenLayer &layer : layers_of(p, side))
    materials.push_back(layer.material);
  if (!is_high(side)) std::reverse(materials.begin(), materials.end());
  return materials;
}

} // namespace platen::coupling
