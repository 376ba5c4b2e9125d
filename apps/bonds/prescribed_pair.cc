#include "apps/bonds/prescribed_pair.h"

#include <algorithm>
#include <cmath>

#include "apps/bonds/bond_rig.h"
#include "apps/bonds/load_path.h"

namespace platen::apps {
namespace {

constexpr double step = 1;         // s; places are prescribed, so that no time enters what the bond does
constexpr int least_moves = 10000; // of a path: peaks and works are known as closely as these divide it

// Dashpots would act at speeds that mean nothing here.
dem::ModelSettings settings_of(const Scene &scene) {
  dem::ModelSettings settings = pair_settings(scene);
  settings.bond_dashpot = 0;
  return settings;
}

// m, closing at which a bond first bears this pressure (Pa).
double closing_under(double pressure, const dem::Bonds &bonds) {
  double elastic = pressure; // Pa, of the same closing without yield
  dem::of_remembering(bonds.law, [&](const auto &law) {
    for (std::size_t k = 0; k < law.compression.given; ++k) {
      const auto &branch = law.compression.branches[k];
      elastic = std::max(elastic, branch.begin + (pressure - branch.limit) * branch.slope);
    }
    return true;
  });
  return elastic / bonds.normal_stiffness[0];
}

// What the bond remembers under that name; otherwise as said.
double remembered(const dem::Bonds &bonds, const char *name, double otherwise) {
  for (const Column<double> *column : bonds.memory_scalars)
    if (column->name() == name) return (*column)[0];
  return otherwise;
}

} // namespace

PrescribedPair::PrescribedPair(const Scene &scene)
    : scene_(scene),
      test_(pair_test_of(scene)),
      model_(touching_spheres(scene), settings_of(scene)),
      length_(model_.bonds->rest_length[0]),
      normal_stiffness_(model_.bonds->normal_stiffness[0]),
      slides_(test_.path == PairPath::shear),
      turns_(turns(scene)),
      moves_per_row_(std::max(1, least_moves / test_.steps)) {
  if (slides_) closed_ = -closing_under(test_.pressure, *model_.bonds);
  (model_.particles.id[0] == 0 ? lower_ : upper_) = 1; // sphere 0 of the specimen is the upper one
}

// A displacement of what turns is that of a sphere's skin.
PrescribedPair::Place PrescribedPair::place_at(double displacement) const {
  if (slides_) return {closed_, displacement, 0};
  if (turns_) return {0, 0, displacement / scene_.specimen.sphere_radius};
  return {displacement, test_.path == PairPath::combined ? test_.slip_ratio * displacement : 0, 0};
}

// The upper sphere goes along the line of centres, and both turn about the same axis so that their surfaces
// slide on each other by the slip at a distance that stays. What bends or twists turns against each other,
// half each, so that nothing slides.
void PrescribedPair::move(const Place &to) {
  dem::Particles &p = model_.particles;
  const double here = p.position[upper_].z - p.position[lower_].z, distance = length_ + to.opening;
  p.velocity[upper_] = {0, 0, (distance - here) / step};
  if (p.has_rotation())
    for (Vector3 &spin : *p.angular_velocity)
      spin = {0, -(to.slip - at_.slip) / (distance * step), 0};
  const Vector3 axis = test_.path == PairPath::bending ? Vector3{0, 1, 0} : Vector3{0, 0, 1};
  if (turns_) {
    (*p.angular_velocity)[upper_] = (0.5 * (to.turn - at_.turn) / step) * axis;
    (*p.angular_velocity)[lower_] = (-0.5 * (to.turn - at_.turn) / step) * axis;
  }
  model_.begin_step(step);
  model_.compute_forces(step);
  const Load before = load_;
  const Vector3 force = p.force[upper_];
  load_ = {0 - force.z, 0 - force.x, turns_ ? 0 - dot((*p.torque)[upper_], axis) : 0};
  work_ += 0.5 * ((before.normal + load_.normal) * (to.opening - at_.opening) +
                  (before.shear + load_.shear) * (to.slip - at_.slip) +
                  (before.moment + load_.moment) * (to.turn - at_.turn));
  at_ = to;
  ++steps_;
  // At rest again, and free of loads: the next step begins by half a kick.
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.velocity[i] = p.force[i] = {};
    if (p.has_rotation()) (*p.angular_velocity)[i] = (*p.torque)[i] = {};
  }
}

BondReading PrescribedPair::read() const {
  const dem::Bonds &bonds = *model_.bonds;
  const dem::BondResponse<double> response = bonds.response(0, model_.particles);
  const dem::BondTotals totals = dem::bond_totals(model_.particles, bonds);
  BondReading r;
  if (!turns_) r.force = slides_ ? load_.shear : load_.normal;
  if (!turns_) r.displacement = slides_ ? at_.slip : at_.opening;
  r.moment = load_.moment;
  r.rotation = at_.turn;
  r.normal = load_.normal;
  r.shear = load_.shear;
  r.tension_ratio = response.tension_ratio;
  r.shear_ratio = response.shear_ratio;
  r.intact = static_cast<double>(model_.intact_bonds());
  r.tension_damage = remembered(bonds, "tension_damage", bonds.damage(0)); // one for both in some laws
  r.shear_damage = remembered(bonds, "shear_damage", bonds.damage(0));
  r.plastic_closing = remembered(bonds, "plastic", 0) / normal_stiffness_;
  r.work = work_;
  r.stored = totals.energy;
  r.dissipated = model_.works.fracture + totals.damage + totals.friction + totals.plastic;
  return r;
}

// Figures of the path so far. A softening branch has one energy where one direction alone is strained.
void PrescribedPair::take(const BondReading &now, BondRun &run) {
  const auto height = [&](const BondReading &of) {
    return slides_ || turns_ ? std::abs(of.load()) : of.load();
  };
  if (std::isnan(run.stiffness) && now.travel() != 0) run.stiffness = now.load() / now.travel();
  if (now.intact > 0) {
    if (height(now) > height(peak_)) peak_ = now;
    if (std::abs(now.load()) > std::abs(run.largest.load())) run.largest = now;
    softened_ = std::max(now.tension_damage, now.shear_damage) > 0;
  } else if (std::isnan(run.break_load)) {
    run.break_load = peak_.force + std::abs(peak_.moment);
    if (softened_ && !turns_ && closed_ == 0 && test_.path != PairPath::combined)
      run.fracture_energy = (now.work - peak_.work) / run.bond_area;
  }
}

// On a straight line.
void PrescribedPair::follow(const Place &to, int rows, BondRun &run) {
  const Place from = at_;
  const int moves = rows * moves_per_row_;
  for (int k = 1; k <= moves; ++k) {
    const double share = static_cast<double>(k) / moves;
    move(k == moves
             ? to
             : Place{from.opening + share * (to.opening - from.opening),
                     from.slip + share * (to.slip - from.slip), from.turn + share * (to.turn - from.turn)});
    const BondReading now = read();
    take(now, run);
    if (k % moves_per_row_ == 0) run.rows.push_back(now);
  }
}

BondRun PrescribedPair::run() {
  BondRun run(scene_, model_);
  run.time_step_reason = "none: spheres are moved without inertia";
  if (closed_ != 0) follow(place_at(0), 1, run);
  for (const Leg &leg : legs_of(turning_displacements(test_), test_.steps))
    follow(place_at(leg.to), leg.steps, run);
  run.conclude(model_, steps_);
  return run;
}

} // namespace platen::apps
