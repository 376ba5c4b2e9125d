#include "step_scene.h"

#include <cmath>

#include "base/pi.h"
#include "dem/packing/growth.h"
#include "dem/packing/periodic_growth.h"
#include "dem/packing/tiled.h"

namespace platen::bench {
namespace {

constexpr double radius = 1e-3;
// What growth between walls reaches.
constexpr double fraction = 0.615;
constexpr int largest_cylinder = 50000;
constexpr std::size_t tile_of = 20000; // spheres

double volume_for(double particles) {
  return particles * 4.0 / 3.0 * pi * radius * radius * radius / fraction;
}

// Twice as high as wide, of tiles that fit to each other without seams.
dem::Specimen tiled(int particles) {
  const double edge = std::cbrt(volume_for(particles) / 2);
  return dem::tiled_close_packing(dem::box(edge, edge, 2 * edge), radius, 0.0, tile_of, 1);
}

} // namespace

dem::Specimen close_packed(int particles) {
  if (particles > largest_cylinder) return tiled(particles);
  const double r = std::cbrt(volume_for(particles) / (4 * pi));
  return dem::random_close_packing_of(dem::cylinder(r, 4 * r), static_cast<std::size_t>(particles), 0.0, 1);
}

dem::Specimen repeated(int particles) {
  const double edge = std::cbrt(volume_for(static_cast<double>(tile_of)));
  const dem::Specimen tile = dem::periodic_close_packing(dem::box(edge, edge, edge), tile_of, 0.0, 1);
  const double tiles = static_cast<double>(particles) / static_cast<double>(tile_of);
  const int across = std::max(1, static_cast<int>(std::lround(std::cbrt(tiles / 2))));
  const int up = std::max(1, static_cast<int>(std::lround(tiles / (across * across))));
  const double most = *std::max_element(tile.radius.begin(), tile.radius.end());
  dem::Specimen all;
  all.shape = dem::box(across * edge + 2 * most, across * edge + 2 * most, up * edge + 2 * most);
  const std::size_t size = tile.size() * static_cast<std::size_t>(across * across * up);
  all.centre.reserve(size), all.radius.reserve(size);
  for (int z = 0; z < up; ++z)
    for (int y = 0; y < across; ++y)
      for (int x = 0; x < across; ++x)
        for (std::size_t k = 0; k < tile.size(); ++k) {
          const Vector3 place{x - 0.5 * (across - 1), y - 0.5 * (across - 1), 1.0 * z};
          all.centre.push_back(tile.centre[k] + edge * place + Vector3{0, 0, most});
          all.radius.push_back(tile.radius[k]);
        }
  return all;
}

const std::map<std::string, Law> laws{{"parallel-bond", Law::parallel_bond},
                                      {"cohesive-beam", Law::cohesive_beam},
                                      {"elasto-damage-plastic", Law::elasto_damage_plastic},
                                      {"yielding-parallel-bond", Law::yielding_parallel_bond},
                                      {"facet", Law::facet}};

coupling::PlatenTestSettings elastic_press(Law law) {
  coupling::PlatenTestSettings s;
  s.model.bond_layout.modulus = 40e9;
  s.model.bond_layout.gap.value = 0.1;
  s.model.bond = dem::ParallelBond::Parameters{0.4, 1e9, 4e9, 0.7853981633974483, 0.3};
  if (law == Law::cohesive_beam) {
    s.model.bond = dem::CohesiveBeam::Parameters{0.3, 1e9, 4e9, 0.7853981633974483, 0.3};
    s.model.bond_layout.radius_rule = dem::RadiusRule::mean;
    s.model.bond_layout.radius_multiplier = 0.71;
  }
  if (law == Law::elasto_damage_plastic) {
    dem::ElastoDamagePlastic::Parameters p;
    p.tensile_strength = 1e9;
    p.shear_strength = 4e9;
    p.friction_static = 0.9;
    p.friction_dynamic = 0.25;
    p.poisson_ratio = 0.2;
    p.compression_limits = {1e9}, p.compression_slopes = {3};
    s.model.bond = p;
  }
  if (law == Law::yielding_parallel_bond) {
    dem::YieldingParallelBond::Parameters p;
    static_cast<dem::ParallelBond::Parameters &>(p) = std::get<dem::ParallelBond::Parameters>(*s.model.bond);
    p.compression_limits = {1e9, 2e9, 3e9}, p.compression_slopes = {3, 12, 22};
    s.model.bond = p;
  }
  if (law == Law::facet) {
    dem::FacetBond::Parameters p;
    p.stiffness_ratio = 0.25, p.tensile_strength = 1e9, p.shear_strength = 4e9, p.fracture_energy = 1e9;
    p.friction_static = 0.2, p.transitional_stress = 600e6, p.friction_dynamic = 0.6;
    p.compression_limits = {1e9, 2e9, 3e9}, p.compression_slopes = {3, 12, 22};
    s.model.bond = p;
    s.model.bond_layout.gap.value = 0.6;
  }
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

Network network_of(const dem::Model &model) {
  Network network;
  for (const Vector3 &x : model.particles.position)
    network.position.push_back({x.x, x.y, x.z});
  network.first.assign(model.bonds->first.begin(), model.bonds->first.end());
  network.second.assign(model.bonds->second.begin(), model.bonds->second.end());
  network.radius = model.particles.radius[0];
  return network;
}

void run(coupling::PlatenTest &problem, long steps) {
  while (steps > 0)
    steps -= problem.advance(steps);
}

} // namespace platen::bench
