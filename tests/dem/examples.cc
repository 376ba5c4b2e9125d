#include "tests/dem/examples.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/random.h"
#include "dem/packing/advancing_front.h"

namespace platen::dem::examples {

Specimen spheres(std::vector<Vector3> centres, double r) {
  Specimen s;
  s.radius.assign(centres.size(), r);
  s.centre = std::move(centres);
  s.shape = box(1, 1, 1);
  return s;
}

Specimen row(int bonds, const Vector3 &direction) {
  const Vector3 unit = direction / norm(direction);
  std::vector<Vector3> centres;
  for (int k = 0; k <= bonds; ++k)
    centres.push_back(2 * radius * k * unit);
  return spheres(std::move(centres));
}

Specimen packed_box(double x, double y, double z, std::uint64_t seed) {
  return advancing_front(box(x * radius, y * radius, z * radius), equal_radii(radius), seed);
}

ModelSettings bonded() {
  ModelSettings s;
  s.density = 2400;
  s.local_damping = 0;
  s.bond_layout.modulus = modulus;
  s.bond_layout.gap.value = 1e-6;
  ParallelBond::Parameters bond;
  bond.stiffness_ratio = stiffness_ratio;
  s.bond = bond;
  return s;
}

ModelSettings bonded_by_beams(double young, double poisson, double slender) {
  ModelSettings s = bonded();
  CohesiveBeam::Parameters law;
  law.poisson_ratio = poisson;
  s.bond = law;
  s.bond_layout.modulus = young;
  s.bond_layout.radius_rule = RadiusRule::mean;
  s.bond_layout.radius_multiplier = slender;
  return s;
}

ParallelBond::Parameters &parallel_bond(ModelSettings &settings) {
  return std::get<ParallelBond::Parameters>(settings.bond.value());
}

ModelSettings interfaces() {
  ModelSettings s = bonded();
  ElastoDamagePlastic::Parameters law;
  law.tensile_strength = 5e6;
  law.shear_strength = 16e6;
  law.friction_static = .9;
  law.friction_dynamic = .25;
  law.poisson_ratio = .2;
  law.compression_limits = {20e6, 45e6, 70e6};
  law.compression_slopes = {3, 12, 22};
  s.bond = law;
  s.bond_layout.modulus = 28e9;
  s.bond_layout.by_range = true;
  s.contact = ContactSettings{};
  s.contact->friction = .25;
  s.contact->damping = 0;
  return s;
}

ModelSettings yielding_bonds() {
  ModelSettings s = bonded();
  YieldingParallelBond::Parameters law;
  law.stiffness_ratio = .25;
  law.tensile_strength = law.shear_strength = 9e6;
  law.friction_angle = std::atan(.5);
  law.moment_contribution = .22;
  law.compression_limits = {60e6, 110e6, 160e6}, law.compression_slopes = {3, 12, 22};
  s.bond = law;
  s.bond_layout.modulus = 48e9;
  s.contact = ContactSettings{};
  s.contact->friction = .35;
  s.contact->damping = 0;
  return s;
}

ModelSettings facets() {
  ModelSettings s = bonded();
  FacetBond::Parameters law;
  law.stiffness_ratio = .25;
  law.tensile_strength = 4e6, law.shear_strength = 11e6;
  law.fracture_energy = 1.05;
  law.friction_static = .2, law.transitional_stress = 600e6, law.friction_dynamic = .6;
  law.compression_limits = {20e6, 45e6, 70e6}, law.compression_slopes = {3, 12, 22};
  s.bond = law;
  s.bond_layout.modulus = 28e9;
  s.bond_layout.gap.value = .6;
  s.contact = ContactSettings{};
  s.contact->friction = .35;
  s.contact->damping = 0;
  return s;
}

ModelSettings breakable() {
  ModelSettings s = bonded();
  parallel_bond(s).tensile_strength = tensile_strength;
  parallel_bond(s).shear_strength = shear_strength;
  s.contact = ContactSettings{};
  s.contact->damping = 0;
  return s;
}

std::size_t row_of(const Particles &particles, int id) {
  for (std::size_t k = 0; k < particles.size(); ++k)
    if (particles.id[k] == id) return k;
  throw std::out_of_range("no such particle");
}

Loads bond_loads(const Particles &p, const Bonds &b) {
  Loads loads{std::vector<Vector3>(p.size()), std::vector<Vector3>(p.size())};
  for (std::size_t k = 0; k < b.size(); ++k) {
    const std::size_t i = static_cast<std::size_t>(b.first[k]), j = static_cast<std::size_t>(b.second[k]);
    const BondResponse<double> r = b.response(k, p);
    loads.force[i] += vector(r.force);
    loads.force[j] -= vector(r.force);
    loads.torque[i] += vector(r.torque_i);
    loads.torque[j] += vector(r.torque_j);
  }
  return loads;
}

Loads kernel_loads(Particles &p, Bonds &b, InstructionSet set, std::vector<BondBreak> &breaks) {
  compute_bond_forces(p, b, set, {}, 0, breaks);
  for (std::size_t block = 0; block < b.blocks.blocks(); ++block)
    return_ghosts(p, b.blocks, block);
  Loads loads{{p.force.begin(), p.force.end()}, std::vector<Vector3>(p.size())};
  if (p.has_rotation()) loads.torque.assign(p.torque->begin(), p.torque->end());
  return loads;
}

void turn_rigidly(Particles &p, const Quaternion &turn, const Vector3 &centre) {
  for (std::size_t k = 0; k < p.size(); ++k) {
    p.position[k] = centre + rotate(turn, p.position[k] - centre);
    p.velocity[k] = rotate(turn, p.velocity[k]);
    if (!p.has_rotation()) continue;
    (*p.orientation)[k] = normalised(turn * (*p.orientation)[k]);
    (*p.angular_velocity)[k] = rotate(turn, (*p.angular_velocity)[k]);
  }
}

Momentum momentum(const Particles &p) {
  Momentum sum;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const Vector3 linear = p.mass[k] * p.velocity[k];
    const Vector3 orbital = cross(p.position[k], linear);
    const Vector3 spin = p.has_rotation() ? (*p.inertia)[k] * (*p.angular_velocity)[k] : Vector3{};
    sum.linear += linear;
    sum.angular += orbital + spin;
    sum.linear_scale += norm(linear);
    sum.angular_scale += norm(orbital) + norm(spin);
  }
  return sum;
}

void shake(Particles &p, double speed, double rate) {
  Random random(5);
  Vector3 centre;
  for (std::size_t i = 0; i < p.size(); ++i)
    centre += p.position[i] / static_cast<double>(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.velocity[i] = speed * random.direction() - rate * (p.position[i] - centre);
    if (p.has_rotation()) (*p.angular_velocity)[i] = (speed / radius) * random.direction();
  }
}

} // namespace platen::dem::examples
