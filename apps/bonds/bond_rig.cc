#include "apps/bonds/bond_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/run/model_setup.h"
#include "apps/scene/errors.h"
#include "apps/scene/parameters.h"
#include "dem/packing/specimen.h"

namespace platen::apps {
namespace {

constexpr double at_rest = 1e-8;     // imbalance over the largest load
constexpr double round_off = 1e-15;  // of the force at a stretch of one radius: forces cannot be told closer
constexpr long most_steps = 5000000; // until at rest
constexpr int steps_between_looks = 20; // at the imbalance
constexpr int steps_of_a_move = 40;     // in which a prescribed displacement is gone through
constexpr double bonded_gap = 1e-9;     // of the radius: spheres touch, whatever Bond/Gap allows beyond that
constexpr double base_clearance = 1e-6; // of the radius, between base spheres without a bond

bool is_pyramid(const Scene &scene) {
  return scene.pair_test.particles == 3;
}

} // namespace

dem::Specimen touching_spheres(const Scene &scene) {
  const double r = scene.specimen.sphere_radius;
  dem::Specimen s;
  if (is_pyramid(scene)) {
    const double half = r * (scene.pair_test.base_bond ? 1 : 1 + base_clearance);
    s.centre = {{0, 0, std::sqrt(4 * r * r - half * half)}, {-half, 0, 0}, {half, 0, 0}};
  } else {
    s.centre = {{0, 0, 2 * r}, {0, 0, 0}};
  }
  s.radius.assign(s.centre.size(), r);
  s.shape = dem::box(4 * r, 2 * r, 4 * r);
  return s;
}

dem::ModelSettings rig_settings(const Scene &scene, double modulus, double stiffness_ratio) {
  dem::ModelSettings settings = model_settings(scene);
  settings.bond_layout.modulus = modulus;
  settings.bond_layout.gap.value = bonded_gap;
  settings.bond_layout.gap.relative = true;
  if (auto *bond = std::get_if<dem::ParallelBond::Parameters>(&*settings.bond))
    bond->stiffness_ratio = stiffness_ratio;
  return settings;
}

namespace {

BondSection section_of(const dem::ModelSettings &settings, double radius) {
  BondSection b;
  b.sphere_radius = radius;
  b.bond_radius = settings.bond_layout.bond_radius(radius, radius);
  b.modulus = settings.bond_layout.modulus;
  if (const auto *beam = std::get_if<dem::CohesiveBeam::Parameters>(&*settings.bond)) {
    b.beam = true;
    b.poisson_ratio = beam->poisson_ratio;
  } else {
    b.stiffness_ratio = std::get<dem::ParallelBond::Parameters>(*settings.bond).stiffness_ratio;
  }
  std::visit(
      [&](const auto &law) {
        b.tensile_strength = dem::never_if_zero(law.tensile_strength);
        b.shear_strength = dem::never_if_zero(law.shear_strength);
        if constexpr (!std::is_same_v<decltype(law), const dem::ElastoDamagePlastic::Parameters &>)
          b.moment_contribution = law.moment_contribution;
      },
      *settings.bond);
  return b;
}

} // namespace

BondRig::BondRig(const Scene &scene, double modulus, double stiffness_ratio)
    : scene_(scene),
      section_(section_of(rig_settings(scene, modulus, stiffness_ratio), scene.specimen.sphere_radius)),
      rotation_(scene.model.rotation),
      model_(touching_spheres(scene), rig_settings(scene, modulus, stiffness_ratio)) {
  const std::size_t spheres = model_.particles.size();
  row_.resize(spheres);
  loads_.resize(spheres);
  for (std::size_t k = 0; k < spheres; ++k)
    row_[static_cast<std::size_t>(model_.particles.id[k])] = k;
  held_.assign(spheres, {true, true, true, true, true, true});
  const auto set_free = [&](std::size_t sphere, std::initializer_list<std::size_t> coordinates) {
    for (const std::size_t c : coordinates)
      held_[sphere][c] = false;
  };
  if (is_pyramid(scene)) {
    driven_ = 2;
    if (scene.pair_test.plate != PairPlate::sticking)
      for (const std::size_t base : {1u, 2u})
        set_free(base, {0, 4});
  } else if (scene.pair_test.path == PairPath::shear) {
    driven_ = 0;
    set_free(0, {2});
  } else if (scene.pair_test.path == PairPath::bending) {
    driven_ = 4;
    set_free(0, {0, 2});
  } else if (scene.pair_test.path == PairPath::twisting) {
    driven_ = 5;
    set_free(0, {2});
  } else {
    driven_ = 2;
  }
  set_free(0, {driven_});
  bonds_at_start_ = static_cast<int>(model_.intact_bonds());
  check_time_step();
}

// Set at the start; made smaller where a contact that has closed is stiffer than what was there.
void BondRig::check_time_step() {
  const dem::StableStep stable = model_.stable_step({}, 0);
  const double wanted = scene_.integration.time_step, safe = scene_.integration.safety * stable.limit;
  if (dt_ == 0 && wanted > stable.limit)
    scene_.parameters->refuse("Integration/Time step", fmt::format("is above the limit of {:.4g} s: {}.",
                                                                   stable.limit, stable.reason));
  if (dt_ == 0) {
    dt_ = wanted > 0 ? wanted : safe;
    reason_ = wanted > 0 ? "as the scene sets it"
                         : fmt::format("{} x {}", scene_.integration.safety, stable.reason);
  }
  if (dt_ > stable.limit) dt_ = safe;
}

// What bonds and contacts exert, as it stands after compute_forces: the rig has no weight, and its few
// spheres are one block, so that nothing waits in ghosts.
void BondRig::take_loads() {
  const dem::Particles &p = model_.particles;
  for (std::size_t s = 0; s < row_.size(); ++s)
    loads_[s] = {p.force[row_[s]], rotation_ ? (*p.torque)[row_[s]] : Vector3{}};
}

namespace {

double component(const Vector3 &linear, const Vector3 &angular, std::size_t coordinate) {
  return coordinate < 3 ? linear[static_cast<int>(coordinate)] : angular[static_cast<int>(coordinate) - 3];
}

} // namespace

// What the rig has to put on the driven coordinate to hold it.
double BondRig::driven_load() const {
  return 0.0 - component(loads_[0].force, loads_[0].torque, driven_);
}

double BondRig::driven_place() const {
  const dem::Particles &p = model_.particles;
  const std::size_t i = row_[0];
  if (driven_ < 3) return (p.position[i] - p.reference_position[i])[static_cast<int>(driven_)];
  const Quaternion q = (*p.orientation)[i];
  return 2 * std::atan2(vector_part(q)[static_cast<int>(driven_) - 3], q.w);
}

// The plate's friction X at the foot of each base sphere, such that it rolls without slip: v_x = R w_y.
void BondRig::roll(dem::Particles &p) const {
  for (const std::size_t base : {1u, 2u}) {
    const std::size_t i = row_[base];
    const double r = p.radius[i], m = p.mass[i], inertia = (*p.inertia)[i];
    const double friction =
        (r * loads_[base].torque.y / inertia - loads_[base].force.x / m) / (1 / m + r * r / inertia);
    p.force[i].x += friction;
    (*p.torque)[i].y -= r * friction;
  }
}

void BondRig::hold_coordinates() {
  dem::Particles &p = model_.particles;
  const auto set = [&](std::size_t sphere, std::size_t c, double speed) {
    const std::size_t i = row_[sphere];
    if (c < 3) {
      p.velocity[i][static_cast<int>(c)] = speed;
      p.force[i][static_cast<int>(c)] = 0;
    } else if (rotation_) {
      (*p.angular_velocity)[i][static_cast<int>(c) - 3] = speed;
      (*p.torque)[i][static_cast<int>(c) - 3] = 0;
    }
  };
  for (std::size_t s = 0; s < held_.size(); ++s)
    for (std::size_t c = 0; c < 6; ++c)
      if (held_[s][c]) set(s, c, 0);
  if (!by_load_) set(0, driven_, drive_speed_);
}

void BondRig::step() {
  hold_coordinates();
  model_.begin_step(dt_);
  model_.compute_forces(dt_);
  take_loads();
  if (by_load_) {
    dem::Particles &p = model_.particles;
    if (driven_ < 3)
      p.force[row_[0]][static_cast<int>(driven_)] += applied_;
    else
      (*p.torque)[row_[0]][static_cast<int>(driven_) - 3] += applied_;
  }
  if (is_pyramid(scene_) && scene_.pair_test.plate == PairPlate::rolling) roll(model_.particles);
  model_.end_step(dt_);
  hold_coordinates();
  ++steps_;
  const std::size_t touching = model_.contacts ? model_.contacts->touching_count() : 0;
  if (touching != touching_) check_time_step();
  touching_ = touching;
}

// Largest load on a free coordinate, N; moments over the radius.
double BondRig::imbalance() const {
  const double r = section_.sphere_radius;
  const bool rolling = is_pyramid(scene_) && scene_.pair_test.plate == PairPlate::rolling;
  double largest = 0;
  for (std::size_t s = 0; s < held_.size(); ++s)
    for (std::size_t c = 0; c < (rotation_ ? 6u : 3u); ++c) {
      if (held_[s][c] || (s == 0 && c == driven_ && !by_load_)) continue;
      double load = component(loads_[s].force, loads_[s].torque, c);
      if (s == 0 && c == driven_) load += applied_;
      if (c > 2) load /= r;
      if (rolling && s > 0) load = loads_[s].force.x + loads_[s].torque.y / r; // one coordinate, two parts
      largest = std::max(largest, std::abs(load));
    }
  return largest;
}

RigReading BondRig::settle() {
  const double stiffness = section_.axial_stiffness(), floor = round_off * stiffness * section_.sphere_radius;
  const std::size_t intact = model_.intact_bonds();
  for (long n = 1; n <= most_steps; ++n) {
    step();
    if (by_load_ && model_.intact_bonds() < intact) return read(); // nothing is left that could hold the load
    if (n % steps_between_looks != 0) continue;
    if (model_.intact_bonds() == 0 && touching_ == 0) { // nothing acts any more: where it is, it stays
      for (Vector3 &v : model_.particles.velocity)
        v = {};
      if (rotation_)
        for (Vector3 &w : *model_.particles.angular_velocity)
          w = {};
      return read();
    }
    const double arm = driven_ < 3 ? 1 : section_.sphere_radius;
    scale_ = std::max(scale_, std::abs(by_load_ ? applied_ : driven_load()) / arm);
    const double allowed = std::max(at_rest * scale_, floor);
    if (imbalance() <= allowed && dem::kinetic_energy(model_.particles) <= allowed * allowed / stiffness)
      return read();
  }
  throw NumericsError(
      fmt::format("the spheres did not come to rest within {} steps at a load of {:.6g} N; "
                  "Integration/Damping = 0.5 ... 0.8 is best for that",
                  most_steps, scale_));
}

RigReading BondRig::load_to(double load) {
  by_load_ = true;
  applied_ = load;
  return settle();
}

RigReading BondRig::move_to(double displacement) {
  by_load_ = false;
  drive_speed_ = (displacement - driven_place()) / (steps_of_a_move * dt_);
  for (int n = 0; n < steps_of_a_move; ++n)
    step();
  drive_speed_ = 0;
  return settle();
}

RigReading BondRig::read() const {
  const dem::Particles &p = model_.particles;
  RigReading r;
  const double load = by_load_ ? applied_ : driven_load();
  (driven_ < 3 ? r.force : r.moment) = load;
  (driven_ < 3 ? r.displacement : r.rotation) = driven_place();
  r.intact = static_cast<int>(model_.intact_bonds());
  const dem::Bonds &b = *model_.bonds;
  for (std::size_t k = 0; k < b.size(); ++k) {
    if (b.normal_stiffness[k] == 0) continue;
    const dem::BondResponse<double> response = b.response(k, p);
    r.tension_ratio = std::max(r.tension_ratio, response.tension_ratio);
    r.shear_ratio = std::max(r.shear_ratio, response.shear_ratio);
    const auto ends =
        std::minmax(p.id[static_cast<std::size_t>(b.first[k])], p.id[static_cast<std::size_t>(b.second[k])]);
    if (ends.first == 0 && ends.second == 1) r.normal = response.normal_force, r.shear = response.shear_force;
  }
  r.strain_ratio = std::numeric_limits<double>::quiet_NaN();
  if (is_pyramid(scene_)) {
    const auto moved = [&](std::size_t sphere) {
      return (p.position[row_[sphere]] - p.reference_position[row_[sphere]]).x;
    };
    r.lateral = .5 * (moved(2) - moved(1));
    if (r.displacement != 0) r.strain_ratio = -std::sqrt(3.0) * r.lateral / r.displacement;
  }
  return r;
}

} // namespace platen::apps
