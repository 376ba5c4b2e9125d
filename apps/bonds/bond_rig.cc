#include "apps/bonds/bond_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/run/model_setup.h"
#include "apps/scene/errors.h"

namespace platen::apps {
namespace {

constexpr double at_rest = 1e-8;     // imbalance over the largest load
constexpr double round_off = 1e-15;  // of the force at a stretch of one radius: forces cannot be told closer
constexpr long most_steps = 5000000; // until at rest
constexpr int steps_between_checks = 20; // at the imbalance
constexpr int steps_of_a_move = 40;      // in which a prescribed displacement is gone through
constexpr double bonded_gap = 1e-9;      // of the radius: spheres touch, whatever Bond/Gap allows beyond that
constexpr double base_clearance = 1e-6;  // of the radius, between base spheres without a bond

} // namespace

dem::Specimen touching_spheres(const Scene &scene) {
  const double r = scene.specimen.sphere_radius;
  dem::Specimen s;
  if (is_pyramid(scene)) {
    const double half = r * (pair_test_of(scene).base_bond ? 1 : 1 + base_clearance);
    s.centre = {{0, 0, std::sqrt(4 * r * r - half * half)}, {-half, 0, 0}, {half, 0, 0}};
  } else {
    s.centre = {{0, 0, 2 * r}, {0, 0, 0}};
  }
  s.radius.assign(s.centre.size(), r);
  s.shape = dem::box(4 * r, 2 * r, 4 * r);
  return s;
}

dem::ModelSettings pair_settings(const Scene &scene) {
  dem::ModelSettings settings = model_settings(scene);
  settings.bond_layout.modulus = scene.model.bond_layout.modulus;
  settings.bond_layout.gap = {true, bonded_gap};
  return settings;
}

BondRig::BondRig(const Scene &scene)
    : scene_(scene),
      coordinates_(scene.model.rotation ? 6 : 3),
      rolls_(is_pyramid(scene) && pair_test_of(scene).plate == PairPlate::rolling),
      model_(touching_spheres(scene), pair_settings(scene)),
      radius_(scene.specimen.sphere_radius),
      axial_stiffness_(model_.bonds->stiffness(0).axial) {
  const std::size_t spheres = model_.particles.size();
  row_.resize(spheres);
  loads_.resize(spheres);
  for (std::size_t k = 0; k < spheres; ++k)
    row_[static_cast<std::size_t>(model_.particles.id[k])] = k;
  fixed_.assign(spheres, {true, true, true, true, true, true});
  const PairPath path = pair_test_of(scene).path;
  if (path == PairPath::shear) driven_ = 0;
  if (path == PairPath::bending) driven_ = 4, fixed_[0][0] = false;
  if (path == PairPath::twisting) driven_ = 5;
  fixed_[0][2] = fixed_[0][driven_] = false; // the line of centres stays free on every path
  if (is_pyramid(scene) && pair_test_of(scene).plate != PairPlate::sticking)
    for (const std::size_t base : {1u, 2u})
      fixed_[base][0] = fixed_[base][4] = false;
  check_time_step();
}

// Set at the start; made smaller where a contact that has closed is stiffer than what was there.
void BondRig::check_time_step() {
  const dem::StableStep stable = model_.stable_step({}, 0);
  const double wanted = scene_.time_step.fixed_step, safe = scene_.time_step.safety * stable.limit;
  if (dt_ == 0 && wanted > stable.limit)
    refuse(scene_, "Integration/Time step",
           fmt::format("is above the limit of {:.4g} s: {}.", stable.limit, stable.reason));
  if (dt_ == 0) {
    dt_ = wanted > 0 ? wanted : safe;
    reason_ =
        wanted > 0 ? "as the scene sets it" : fmt::format("{} x {}", scene_.time_step.safety, stable.reason);
  }
  if (dt_ > stable.limit) dt_ = safe;
}

double &BondRig::speed(std::size_t sphere, std::size_t c) {
  dem::Particles &p = model_.particles;
  return (c < 3 ? p.velocity : *p.angular_velocity)[row_[sphere]][static_cast<int>(c % 3)];
}

double &BondRig::load(std::size_t sphere, std::size_t c) {
  dem::Particles &p = model_.particles;
  return (c < 3 ? p.force : *p.torque)[row_[sphere]][static_cast<int>(c % 3)];
}

// What the rig has to put on the driven coordinate to hold it.
double BondRig::driven_load() const {
  return 0.0 - loads_[0][driven_];
}

double BondRig::driven_displacement() const {
  const dem::Particles &p = model_.particles;
  const std::size_t i = row_[0];
  if (driven_ < 3) return (p.position[i] - p.reference_position[i])[static_cast<int>(driven_)];
  const Quaternion q = (*p.orientation)[i];
  return 2 * std::atan2(vector_part(q)[static_cast<int>(driven_) - 3], q.w);
}

// The plate's friction X at the foot of each base sphere, such that it rolls without slip: v_x = R w_y.
void BondRig::roll() {
  const dem::Particles &p = model_.particles;
  for (const std::size_t base : {1u, 2u}) {
    const std::size_t i = row_[base];
    const double r = p.radius[i], m = p.mass[i], inertia = (*p.inertia)[i];
    const double friction = (r * loads_[base][4] / inertia - loads_[base][0] / m) / (1 / m + r * r / inertia);
    load(base, 0) += friction;
    load(base, 4) -= r * friction;
  }
}

void BondRig::prescribe_coordinates() {
  for (std::size_t s = 0; s < fixed_.size(); ++s)
    for (std::size_t c = 0; c < coordinates_; ++c)
      if (fixed_[s][c]) speed(s, c) = load(s, c) = 0;
  if (by_load_) return;
  speed(0, driven_) = drive_speed_;
  load(0, driven_) = 0;
}

void BondRig::step() {
  prescribe_coordinates();
  model_.begin_step(dt_);
  model_.compute_forces(dt_);
  // What bonds and contacts exert: the rig has no weight, and its few spheres are one block, so that nothing
  // waits in ghosts.
  for (std::size_t s = 0; s < row_.size(); ++s)
    for (std::size_t c = 0; c < coordinates_; ++c)
      loads_[s][c] = load(s, c);
  if (by_load_) load(0, driven_) += applied_;
  if (rolls_) roll();
  model_.end_step(dt_);
  prescribe_coordinates();
  ++steps_;
  const std::size_t touching = model_.contacts ? model_.contacts->touching_count() : 0;
  if (touching != touching_) check_time_step();
  touching_ = touching;
}

// Largest load on a free coordinate, N; moments over the radius.
double BondRig::imbalance() const {
  double largest = 0;
  for (std::size_t s = 0; s < fixed_.size(); ++s)
    for (std::size_t c = 0; c < coordinates_; ++c) {
      if (fixed_[s][c] || (s == 0 && c == driven_ && !by_load_)) continue;
      double load = loads_[s][c];
      if (s == 0 && c == driven_) load += applied_;
      if (c > 2) load /= radius_;
      if (rolls_ && s > 0) load = loads_[s][0] + loads_[s][4] / radius_; // one coordinate, two parts
      largest = std::max(largest, std::abs(load));
    }
  return largest;
}

BondReading BondRig::settle() {
  const double floor = round_off * axial_stiffness_ * radius_;
  const std::size_t intact = model_.intact_bonds();
  for (long n = 1; n <= most_steps; ++n) {
    step();
    if (by_load_ && model_.intact_bonds() < intact) return read(); // nothing is left that could hold the load
    if (n % steps_between_checks != 0) continue;
    if (model_.intact_bonds() == 0 && touching_ == 0) { // nothing acts any more: where it is, it stays
      for (Vector3 &v : model_.particles.velocity)
        v = {};
      if (coordinates_ > 3)
        for (Vector3 &w : *model_.particles.angular_velocity)
          w = {};
      return read();
    }
    const double arm = driven_ < 3 ? 1 : radius_;
    scale_ = std::max(scale_, std::abs(by_load_ ? applied_ : driven_load()) / arm);
    const double allowed = std::max(at_rest * scale_, floor);
    if (imbalance() <= allowed &&
        dem::kinetic_energy(model_.particles) <= allowed * allowed / axial_stiffness_)
      return read();
  }
  throw NumericsError(
      fmt::format("the spheres did not come to rest within {} steps at a load of {:.6g} N; "
                  "Integration/Damping = 0.5 ... 0.8 is best for that",
                  most_steps, scale_));
}

BondReading BondRig::load_to(double load) {
  by_load_ = true;
  applied_ = load;
  return settle();
}

BondReading BondRig::move_to(double displacement) {
  by_load_ = false;
  drive_speed_ = (displacement - driven_displacement()) / (steps_of_a_move * dt_);
  for (int n = 0; n < steps_of_a_move; ++n)
    step();
  drive_speed_ = 0;
  return settle();
}

BondReading BondRig::read() const {
  const dem::Particles &p = model_.particles;
  BondReading r;
  (driven_ < 3 ? r.force : r.moment) = by_load_ ? applied_ : driven_load();
  (driven_ < 3 ? r.displacement : r.rotation) = driven_displacement();
  r.intact = static_cast<double>(model_.intact_bonds());
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
