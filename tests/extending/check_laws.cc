// What the example laws do in a model, against their closed forms. Ends with 1 where they do not.
#include <cmath>
#include <cstdio>

#include "base/pi.h"
#include "dem/laws/normal_contact.h"
#include "dem/model.h"
#include "dem/packing/specimen.h"

using namespace platen;

namespace {

constexpr double radius = 1e-3; // m

int faults = 0;
void expect(const char *what, double expected, double came, double tolerance) {
  if (std::abs(came - expected) <= tolerance * std::abs(expected)) return;
  std::printf("%s: expected %.17g, came %.17g\n", what, expected, came);
  ++faults;
}

dem::Specimen pair(double distance) {
  dem::Specimen two;
  two.centre = {{0, 0, 0}, {0, 0, distance}};
  two.radius = {radius, radius};
  return two;
}

dem::ModelSettings plain() {
  dem::ModelSettings s;
  s.local_damping = 0;
  s.bond_layout.modulus = 30e9;
  return s;
}

// Pulled by 1e-6 m and moved aside by as much: a spring along the line of the centres alone.
void check_bond(dem::InstructionSet set, bool rotation) {
  dem::ModelSettings settings = plain();
  settings.rotation = rotation;
  settings.instruction_set = set;
  dem::SpringBond::Parameters spring;
  spring.axial_share = 0.5;
  settings.bond = spring;
  dem::Model model(pair(2 * radius), settings);
  model.particles.position[1] += Vector3{1e-6, 0, 1e-6};
  model.compute_forces(1e-9);
  model.end_step(1e-9);
  const double length = std::hypot(1e-6, 2 * radius + 1e-6);
  const double k = 0.5 * 30e9 / (2 * radius) * pi * radius * radius, force = k * (length - 2 * radius);
  expect("force along", force * (2 * radius + 1e-6) / length, model.particles.force[0].z, 1e-9);
  expect("force across", force * 1e-6 / length, model.particles.force[0].x, 1e-9);
  expect("energy", 0.5 * force * (length - 2 * radius), model.energy().bonds, 1e-9);
  expect("bonds", 1, static_cast<double>(model.bonds->size()), 0);
}

// Pulled beyond its yield stress and let back by half of the elastic stretch: the force of a spring that has
// grown longer, and the work of the yield. More pairs than a pack has lanes, in blocks that are not full.
void check_memory(dem::InstructionSet set, bool rotation) {
  dem::ModelSettings settings = plain();
  settings.rotation = rotation;
  settings.instruction_set = set;
  dem::YieldingBond::Parameters yielding;
  yielding.yield_stress = 5e6;
  settings.bond = yielding;
  dem::Specimen pairs;
  const std::size_t count = 11;
  for (std::size_t k = 0; k < count; ++k)
    for (const double z : {0.0, 2 * radius})
      pairs.centre.push_back({0.01 * static_cast<double>(k), 0, z}), pairs.radius.push_back(radius);
  dem::Model model(pairs, settings);
  const double area = pi * radius * radius, elastic = 5e6 / 30e9 * 2 * radius; // m
  const auto pull = [&](double by) {
    for (std::size_t i = 0; i < model.particles.size(); ++i)
      if (model.particles.position[i].z > radius) model.particles.position[i].z += by;
    model.compute_forces(1e-9);
    model.end_step(1e-9);
    for (Vector3 &v : model.particles.velocity)
      v = {};
  };
  pull(3 * elastic);
  for (const Vector3 &force : model.particles.force)
    expect("yield force", 5e6 * area, std::abs(force.z), 1e-8);
  pull(-0.5 * elastic);
  for (const Vector3 &force : model.particles.force)
    expect("force after it", 0.5 * 5e6 * area, std::abs(force.z), 1e-8);
  const dem::EnergyLedger e = model.energy();
  expect("work of yield", static_cast<double>(count) * 5e6 * area * 2 * elastic, e.plastic, 1e-8);
  expect("stored", static_cast<double>(count) * 0.25 * 0.5 * 5e6 * area * elastic, e.bonds, 1e-8);
}

// Two spheres that meet at 1 m/s: the largest overlap has all their energy, and they leave as they came.
void check_contact() {
  dem::ModelSettings settings = plain();
  settings.contact = dem::ContactSettings{};
  settings.contact->normal = dem::NormalContact::cone;
  settings.contact->tangential = dem::TangentialContact::none;
  dem::Model model(pair(2.02 * radius), settings);
  model.particles.velocity[0] = {0, 0, 0.5};
  model.particles.velocity[1] = {0, 0, -0.5};
  const double start = dem::kinetic_energy(model.particles), dt = 2e-9;
  double deepest = 0;
  for (int step = 0; step < 40000; ++step) {
    model.begin_step(dt);
    model.compute_forces(dt);
    model.end_step(dt);
    deepest =
        std::fmax(deepest, 2 * radius - (model.particles.position[1].z - model.particles.position[0].z));
  }
  const double c = dem::ConeContact::coefficient(*settings.contact, radius, radius, settings.bond_layout);
  expect("deepest overlap", std::cbrt(3 * start / c), deepest, 1e-3);
  expect("energy after", start, dem::kinetic_energy(model.particles), 1e-4);
  if (!(model.particles.velocity[1].z > 0)) std::printf("they did not part\n"), ++faults;
}

} // namespace

int main() {
  for (const dem::InstructionSet set :
       {dem::InstructionSet::baseline, dem::InstructionSet::avx2, dem::InstructionSet::avx512})
    for (const bool rotation : {false, true})
      if (set <= dem::best_instruction_set()) check_bond(set, rotation), check_memory(set, rotation);
  check_contact();
  if (faults == 0) std::printf("laws hold\n");
  return faults == 0 ? 0 : 1;
}
