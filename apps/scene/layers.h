// Layers of elastic platens by the names of their materials.
#pragma once

#include <string>
#include <vector>

#include "apps/scene/scene_loading.h"

namespace platen::apps {

class Parameters;

// The material of the platens' own entries (Young modulus, Poisson ratio, Density) among layers.
inline const std::string own_material = "platen";

// "rubber 2 mm, steel 20 mm", from the specimen outward; a thickness may be left out; "" is none.
std::vector<NamedLayer> read_layers(const std::string &text);
// "rubber: 5 MPa, 0.49, 1100 kg/m3; steel: 210 GPa, 0.3, 7850 kg/m3": Young modulus, Poisson ratio and
// density of each; "" is none.
std::vector<NamedMaterial> read_layer_materials(const std::string &text);

// A material of caps and pads that has a word of its own.
struct ReadyMaterial {
  NamedMaterial named;
  std::string source;
};
const std::vector<ReadyMaterial> &ready_materials();
// What the words stand for, and whence: of all, and for the screen of those that the platens use, a line
// each.
std::string layer_documentation();
std::string text_of_layers(const Platens &platens);

// Gives the layers of the library their materials, and a plate without a thickness that of its layers. Throws
// InputError for a material that neither the scene gives nor a ready word.
void supply_layers(const Parameters &parameters, Platens &platens);

} // namespace platen::apps
