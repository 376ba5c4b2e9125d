// Tubes around a specimen: the kinds of sleeve, steels by name, and the hardening that a file gives.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/scene/scene_loading.h"

namespace platen::apps {

class Parameters;

// Words of Sleeve/Steel. `documentation`: a sentence for each: its entries and their source.
std::vector<std::pair<std::string, Steel>> steel_words();
std::string steel_documentation();

// Gives the entries that kind and steel stand for to those that nobody has set.
void supply_tube(Parameters &parameters, const Loading &loading);

// Rows of true plastic strain and flow stress after the yield strength: a table with the columns
// plastic_strain and flow_stress_pa or flow_stress_mpa. Throws InputError naming file, line and what is
// allowed.
std::vector<fem::Hardening::Point> read_hardening(const std::filesystem::path &path, double yield_strength);

} // namespace platen::apps
