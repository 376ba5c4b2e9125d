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

Specimen pair_of(double first, double second, double gap) {
  Specimen s = spheres({{0, 0, 0}, {(first + second) * (1 + gap), 0, 0}});
  s.radius = {first, second};
  return s;
}

Specimen cubic(int along_x, int along_y, int along_z, double distance) {
  std::vector<Vector3> centres;
  for (int z = 0; z < along_z; ++z)
    for (int y = 0; y < along_y; ++y)
      for (int x = 0; x < along_x; ++x)
        centres.push_back(.5 * distance * radius *
                          Vector3{2. * x + 1 - along_x, 2. * y + 1 - along_y, 2. * z + 1});
  Specimen s = spheres(std::move(centres));
  s.shape = scaled(box(along_x, along_y, along_z), distance * radius);
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

ElastoDamagePlastic::Parameters cohesive_bond_of_concrete() {
  ElastoDamagePlastic::Parameters p;
  p.poisson_ratio = .2;
  p.tensile_strength = 5e6, p.shear_strength = 16e6;
  p.friction_static = .9, p.friction_dynamic = .25;
  p.softening_tension = .2, p.softening_shear = 1;
  p.compression_limits = {20e6, 45e6, 70e6}, p.compression_slopes = {3, 12, 22};
  return p;
}

ModelSettings interfaces() {
  ModelSettings s = bonded();
  s.bond = cohesive_bond_of_concrete();
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

ModelSettings unbonded(NormalContact normal, TangentialContact tangential, double stiffness) {
  ModelSettings s;
  s.density = 2400;
  s.local_damping = 0;
  s.contact = ContactSettings{};
  s.contact->normal = normal;
  s.contact->tangential = tangential;
  s.contact->stiffness = {Stiffness::Kind::absolute, stiffness};
  s.contact->friction = s.contact->damping = 0;
  s.contact->young_modulus = 70e9;
  s.contact->poisson_ratio = .25;
  return s;
}

ModelSettings bending_interfaces() {
  ModelSettings s = interfaces();
  auto &law = std::get<ElastoDamagePlastic::Parameters>(*s.bond);
  law.moments = true, law.moment_contribution = .3;
  return s;
}

void PrintTo(const SetUp &set_up, std::ostream *to) {
  *to << set_up.name;
}

const std::vector<SetUp> &set_ups() {
  static const std::vector<SetUp> all = [] {
    ModelSettings effects = breakable(), plain = breakable(), rolling = breakable(), alone = breakable(),
                  grains = breakable(), still = breakable(), beams = bonded_by_beams(30e9, .2, 1);
    effects.contact->damping = .2;
    effects.local_damping = .1;
    effects.bond_dashpot = .05;
    effects.gravity = {0, 0, -9.81};
    effects.scheme = Scheme::tchamwa_wielgosz;
    effects.dissipation = 1.1;
    effects.strength_scatter = StrengthScatter{4, 2};
    plain.contact->damping = .2;
    rolling.contact->normal = NormalContact::hertz;
    rolling.contact->tangential = TangentialContact::coulomb_with_rolling;
    rolling.contact->rolling_friction = .2;
    alone.contact.reset();
    grains.bond.reset();
    still.rotation = false;
    still.contact->tangential = TangentialContact::none;
    std::get<CohesiveBeam::Parameters>(*beams.bond).tensile_strength = 20e6;
    beams.contact = ContactSettings{};
    std::vector<SetUp> list{
        {"all_effects", effects}, {"parallel_bonds", plain}, {"hertz_and_rolling", rolling},
        {"bonds_alone", alone},   {"grains", grains},        {"without_rotation", still},
        {"beams", beams}};
    for (const auto &[name, settings] : {std::pair{"interfaces", interfaces()},
                                         {"bending_interfaces", bending_interfaces()},
                                         {"yielding_parallel_bonds", yielding_bonds()},
                                         {"facets", facets()}}) {
      list.push_back({name, settings});
      list.back().settings.bond_dashpot = .1;
    }
    return list;
  }();
  return all;
}

std::unique_ptr<Model> flying_block(const ModelSettings &settings, double side) {
  auto model = std::make_unique<Model>(packed_box(side, side, side), settings);
  Particles &p = model->particles;
  Random random(9);
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.velocity[i] = .1 * (p.position[i] / radius) + 2 * random.direction();
    if (p.has_rotation()) (*p.angular_velocity)[i] = (.1 / radius) * random.direction();
  }
  if (model->contacts) model->contacts->search(p, model->bonds.get(), 0);
  return model;
}

void move_pair(Model &model, const Vector3 &by, const Vector3 &turn_first, const Vector3 &turn_second) {
  Particles &p = model.particles;
  p.velocity[0] = {}, p.velocity[1] = by;
  (*p.angular_velocity)[0] = turn_first, (*p.angular_velocity)[1] = turn_second;
  p.force[0] = p.force[1] = (*p.torque)[0] = (*p.torque)[1] = {};
  model.begin_step(1);
  model.compute_forces(1);
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
