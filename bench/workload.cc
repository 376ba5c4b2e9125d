#include "workload.h"

#include <cmath>
#include <map>

#include "apps/output/specimen_csv.h"
#include "base/pi.h"
#include "dem/packing/growth.h"
#include "dem/packing/tiled.h"

namespace platen::bench {
namespace {

const dem::ParallelBond::Parameters parallel{0.4, 1e9, 4e9, 0.7853981633974483, 0.3};

// By the words of Effects/Bond, with dashes; strengths that nothing reaches.
const std::map<std::string, void (*)(dem::ModelSettings &)> laws{
    {"parallel-bond", [](dem::ModelSettings &s) { s.bond = parallel; }},
    {"cohesive-beam",
     [](dem::ModelSettings &s) {
       s.bond = dem::CohesiveBeam::Parameters{0.3, 1e9, 4e9, 0.7853981633974483, 0.3};
       s.bond_layout.radius_rule = dem::RadiusRule::mean;
       s.bond_layout.radius_multiplier = 0.71;
     }},
    {"elasto-damage-plastic",
     [](dem::ModelSettings &s) {
       dem::ElastoDamagePlastic::Parameters p;
       p.tensile_strength = 1e9, p.shear_strength = 4e9;
       p.friction_static = 0.9, p.friction_dynamic = 0.25, p.poisson_ratio = 0.2;
       p.compression_limits = {1e9}, p.compression_slopes = {3};
       s.bond = p;
     }},
    {"yielding-parallel-bond",
     [](dem::ModelSettings &s) {
       dem::YieldingParallelBond::Parameters p;
       static_cast<dem::ParallelBond::Parameters &>(p) = parallel;
       p.compression_limits = {1e9, 2e9, 3e9}, p.compression_slopes = {3, 12, 22};
       s.bond = p;
     }},
    {"facet", [](dem::ModelSettings &s) {
       dem::FacetBond::Parameters p;
       p.stiffness_ratio = 0.25, p.tensile_strength = 1e9, p.shear_strength = 4e9, p.fracture_energy = 1e9;
       p.friction_static = 0.2, p.transitional_stress = 600e6, p.friction_dynamic = 0.6;
       p.compression_limits = {1e9, 2e9, 3e9}, p.compression_slopes = {3, 12, 22};
       s.bond = p;
       s.bond_layout.gap.value = 0.6;
     }}};

} // namespace

std::vector<Argument> Workload::arguments(bool of_law, const std::vector<Argument> &further) {
  std::vector<Argument> all{{"--particles", &particles, "spheres of 1 mm radius", 100, 2e7},
                            {"--steps", &steps, "steps per repeat", 1, 1e9},
                            {"--repeats", &repeats, "repeats; the median is printed", 1, 1000},
                            {"--specimen", &read, "a packing from this file instead", 0, 0, {}, true}};
  std::vector<std::string> words;
  for (const auto &[word, set] : laws)
    words.push_back(word);
  if (of_law) all.push_back({"--law", &law, "law of the bonds", 0, 0, words});
  all.insert(all.end(), further.begin(), further.end());
  return all;
}

dem::Specimen Workload::specimen() const {
  if (!read.empty()) return apps::read_specimen_csv(read).specimen;
  constexpr double radius = 1e-3, fraction = 0.615; // what growth between walls reaches
  constexpr int largest_cylinder = 50000;
  constexpr std::size_t tile = 20000;
  const double volume = particles * 4.0 / 3.0 * pi * radius * radius * radius / fraction;
  if (particles > largest_cylinder) {
    const double edge = std::cbrt(volume / 2);
    return dem::tiled_close_packing(dem::box(edge, edge, 2 * edge), radius, 0.0, tile, 1);
  }
  const double r = std::cbrt(volume / (4 * pi));
  return dem::random_close_packing_of(dem::cylinder(r, 4 * r), static_cast<std::size_t>(particles), 0.0, 1);
}

coupling::PlatenTestSettings Workload::press() const {
  coupling::PlatenTestSettings s;
  s.model.bond_layout.modulus = 40e9;
  s.model.bond_layout.gap.value = 0.1;
  laws.at(law)(s.model);
  s.model.contact = dem::ContactSettings{};
  s.model.contact->damping = 0;
  s.model.local_damping = 0.5;
  s.ends = coupling::Ends::ground;
  s.end_layer = 0.3;
  s.platens.top = s.platens.bottom = {0.57, 0.57};
  s.platens.damping = 0;
  s.platens.thickness = 5e-3;
  s.loading.rate = 0.05;
  return s;
}

void run(coupling::PlatenTest &problem, long steps) {
  while (steps > 0)
    steps -= problem.advance(steps);
}

} // namespace platen::bench
