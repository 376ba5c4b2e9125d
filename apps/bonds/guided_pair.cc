#include "apps/bonds/guided_pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "apps/bonds/pair_section.h"
#include "apps/bonds/run_bonds.h"

namespace platen::apps {
namespace {

constexpr double step = 1;        // s; places are prescribed, so that no time enters what the bond does
constexpr double same_row = 1e-7; // share of a displacement: an equal step that close to a kink is left out

// Dashpots would act at speeds that mean nothing here.
dem::ModelSettings settings_of(const Scene &scene, double modulus, double stiffness_ratio) {
  dem::ModelSettings settings = rig_settings(scene, modulus, stiffness_ratio);
  settings.bond_dashpot = 0;
  return settings;
}

CohesiveSection section_of_one(const dem::Bonds &bonds, double modulus) {
  const double radius = bonds.bond_radius[0];
  return section_of(bonds.law, bonds.rest_length[0], pi * radius * radius, modulus);
}

// Plastic closing as a stress, damage in tension and in shear, of what one bond remembers.
struct Remembered {
  double plastic = 0, tension = 0, shear = 0;
};
Remembered remembered(const dem::CohesiveState<double> &s) {
  return {s.plastic, s.tension_damage, s.shear_damage};
}
Remembered remembered(const dem::YieldingParallelBond::State<double> &s) {
  return {s.plastic, s.broken == 1 ? 1.0 : 0.0, s.broken == 2 ? 1.0 : 0.0};
}
Remembered remembered(const dem::FacetBond::State<double> &s) {
  return {s.plastic, s.damage, s.damage};
}

bool slides(const PairTest &test) {
  return test.path == PairPath::shear;
}

bool turning(const PairTest &test) {
  return test.path == PairPath::bending || test.path == PairPath::twisting;
}

// How much of a moment counts towards failure.
double beta_of(const dem::BondLaw &law) {
  return dem::of_remembering(law, [](const auto &of) {
    if constexpr (std::is_same_v<decltype(of), const dem::FacetBond &>)
      return 0.0;
    else
      return of.parameters.moment_contribution;
  });
}

// Shares of a straight line where rows stand, ascending, the last one 1.
std::vector<double> shares_of(const std::vector<double> &kinks, int steps) {
  std::vector<double> shares = kinks;
  for (int k = 1; k < steps; ++k) {
    const double share = static_cast<double>(k) / steps;
    if (std::none_of(kinks.begin(), kinks.end(), [&](double at) { return std::abs(at - share) < same_row; }))
      shares.push_back(share);
  }
  std::sort(shares.begin(), shares.end());
  shares.push_back(1);
  return shares;
}

double length_of(const CohesivePlace &from, const CohesivePlace &to) {
  return std::abs(to.opening - from.opening) + std::abs(to.slip - from.slip) + std::abs(to.turn - from.turn);
}

CohesivePlace between(const CohesivePlace &from, const CohesivePlace &to, double share) {
  if (share == 1) return to;
  return {from.opening + share * (to.opening - from.opening), from.slip + share * (to.slip - from.slip),
          from.turn + share * (to.turn - from.turn)};
}

// Places that the path goes to on straight lines, from touching spheres on. A displacement of what turns is
// that of a sphere's skin.
std::vector<CohesivePlace> turning_places(const PairTest &test, const CohesiveSection &section,
                                          double sphere_radius) {
  std::vector<double> turns = test.turns;
  if (turns.empty())
    for (const double point : turning_points(test))
      turns.push_back(point * test.displacement);
  std::vector<CohesivePlace> places;
  const double closed = slides(test) && test.pressure > 0 ? -section.closing_at(test.pressure) : 0;
  if (closed != 0) places.push_back({closed, 0, 0});
  for (const double turn : turns) {
    if (slides(test))
      places.push_back({closed, turn, 0});
    else if (turning(test))
      places.push_back({0, 0, turn / sphere_radius});
    else
      places.push_back({turn, test.path == PairPath::combined ? test.slip_ratio * turn : 0, 0});
  }
  return places;
}

} // namespace

CohesiveTest::CohesiveTest(const Scene &scene, double modulus, double stiffness_ratio)
    : test_(pair_test_of(scene)),
      radius_(scene.specimen.sphere_radius),
      model_(touching_spheres(scene), settings_of(scene, modulus, stiffness_ratio)),
      section_(section_of_one(*model_.bonds, modulus)),
      by_hand_(section_, test_.path == PairPath::combined, test_.slip_ratio) {
  (model_.particles.id[0] == 0 ? lower_ : upper_) = 1; // sphere 0 of the specimen is the upper one
  if (!turning(test_)) return;
  const dem::Bonds &bonds = *model_.bonds;
  moment_.emplace(moment_section(section_,
                                 test_.path == PairPath::bending ? MomentAxis::across : MomentAxis::along,
                                 beta_of(bonds.law), bonds.bond_radius[0]));
}

// The upper sphere goes along the line of centres, and both turn about the same axis so that their surfaces
// slide on each other by the slip at a distance that stays. What bends or twists turns against each other,
// half each, so that nothing slides.
void CohesiveTest::move(const CohesivePlace &to) {
  dem::Particles &p = model_.particles;
  const double here = p.position[upper_].z - p.position[lower_].z;
  const double distance = section_.length + to.opening;
  p.velocity[upper_] = {0, 0, (distance - here) / step};
  if (p.has_rotation())
    for (Vector3 &spin : *p.angular_velocity)
      spin = {0, -(to.slip - at_.slip) / (distance * step), 0};
  const Vector3 axis = test_.path == PairPath::bending ? Vector3{0, 1, 0} : Vector3{0, 0, 1};
  if (turning(test_)) {
    (*p.angular_velocity)[upper_] = (0.5 * (to.turn - at_.turn) / step) * axis;
    (*p.angular_velocity)[lower_] = (-0.5 * (to.turn - at_.turn) / step) * axis;
  }
  model_.begin_step(step);
  model_.compute_forces(step);
  const Vector3 force = p.force[upper_];
  const CohesiveLoad before = now_;
  now_ = {0 - force.z, 0 - force.x, turning(test_) ? 0 - dot((*p.torque)[upper_], axis) : 0};
  work_ += 0.5 * ((before.normal + now_.normal) * (to.opening - at_.opening) +
                  (before.shear + now_.shear) * (to.slip - at_.slip) +
                  (before.moment + now_.moment) * (to.turn - at_.turn));
  at_ = to;
  ++steps_;
  // At rest again, and free of loads: the next step begins by half a kick.
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.velocity[i] = p.force[i] = {};
    if (p.has_rotation()) (*p.angular_velocity)[i] = (*p.torque)[i] = {};
  }
}

CohesiveReading CohesiveTest::read() const {
  const dem::Bonds &b = *model_.bonds;
  const dem::BondTotals totals = dem::bond_totals(model_.particles, b);
  const Remembered state = dem::of_remembering(b.law, [&](const auto &of) {
    return remembered(b.memory<typename std::decay_t<decltype(of)>::template State<double>>(0));
  });
  return {
      state.tension, state.shear,   state.plastic / section_.normal_stiffness(),
      work_,         totals.energy, model_.works.fracture + totals.damage + totals.friction + totals.plastic};
}

void CohesiveTest::add_row(BondRun &run, const CohesivePlace &at) const {
  const dem::BondResponse<double> response = model_.bonds->response(0, model_.particles);
  RigReading row;
  row.force = slides(test_) ? now_.shear : now_.normal;
  row.displacement = slides(test_) ? at.slip : at.opening;
  row.moment = now_.moment;
  row.rotation = at.turn;
  row.normal = now_.normal;
  row.shear = now_.shear;
  row.tension_ratio = response.tension_ratio;
  row.shear_ratio = response.shear_ratio;
  row.intact = static_cast<int>(model_.intact_bonds());
  row.strain_ratio = not_given;
  run.path.rows.push_back(row);
  if (moment_)
    run.cohesive.rows.push_back({read(), now_, {0, 0, moment_->moment()}, moment_->dissipated()});
  else
    run.cohesive.rows.push_back({read(), now_, by_hand_.load(), by_hand_.dissipated()});
  const RigReading &largest = run.path.largest;
  if (row.intact > 0 &&
      std::abs(row.force) + std::abs(row.moment) > std::abs(largest.force) + std::abs(largest.moment))
    run.path.largest = row;
}

std::vector<double> CohesiveTest::kinks(const CohesivePlace &to) const {
  return moment_ ? moment_->kinks(to.turn) : by_hand_.kinks(to);
}

void CohesiveTest::go_by_hand(const CohesivePlace &to) {
  moment_ ? moment_->go(to.turn) : by_hand_.go(to);
}

void CohesiveTest::conclude_turning(BondRun &run) const {
  run.stiffness_by_hand = moment_->stiffness();
  run.strength_by_hand = moment_->strength();
  CohesiveResult &result = run.cohesive;
  run.path.break_load = result.fracture_energy = result.fracture_energy_by_hand = not_given;
  const std::vector<RigReading> &rows = run.path.rows;
  if (rows.back().intact > 0) return;
  run.path.break_load = 0;
  for (std::size_t k = 0; rows[k].intact > 0; ++k)
    run.path.break_load = std::max(run.path.break_load, std::abs(rows[k].moment));
}

// What is known by hand, and the energy of the softening branch.
void CohesiveTest::conclude(BondRun &run) const {
  if (moment_) return conclude_turning(run);
  const bool combined = test_.path == PairPath::combined;
  const SofteningByHand softening = slides(test_) ? section_.shear(test_.pressure) : section_.tension();
  run.stiffness_by_hand = section_.area * softening.stiffness;
  run.strength_by_hand = section_.area * softening.strength;
  if (test_.path == PairPath::compression) run.strength_by_hand = std::numeric_limits<double>::infinity();
  if (combined) { // where the first of the lines bends down
    CohesiveByHand fresh(section_, true, test_.slip_ratio);
    const CohesivePlace end = turning_places(test_, section_, radius_).front();
    const std::vector<double> kinks = fresh.kinks(end);
    run.strength_by_hand = not_given;
    if (!kinks.empty()) { // of a brittle one just before it breaks
      fresh.go({kinks.front() * end.opening, kinks.front() * end.slip});
      run.strength_by_hand = fresh.load().normal;
    }
  }
  CohesiveResult &result = run.cohesive;
  run.path.break_load = result.fracture_energy = result.fracture_energy_by_hand = not_given;
  const std::vector<RigReading> &rows = run.path.rows;
  if (rows.back().intact > 0) return;
  const auto height = [&](std::size_t k) { return slides(test_) ? std::abs(rows[k].force) : rows[k].force; };
  std::size_t peak = 0, failed = 0;
  for (; rows[failed].intact > 0; ++failed)
    if (height(failed) > height(peak)) peak = failed;
  run.path.break_load = rows[peak].force;
  if (combined || (slides(test_) && test_.pressure > 0) || softening.is_brittle()) return;
  result.fracture_energy =
      (result.rows[failed].measured.work - result.rows[peak].measured.work) / section_.area;
  result.fracture_energy_by_hand = softening.fracture_energy();
}

BondRun CohesiveTest::run() {
  BondRun run;
  run.modulus = section_.modulus;
  run.stiffness_ratio = section_.shear_stiffness() / section_.normal_stiffness();
  run.bonds = model_.intact_bonds();
  run.bond_area = section_.area;
  run.cohesive.length = section_.length;
  run.time_step = run.strain_ratio_by_hand = not_given;
  run.time_step_reason = "none: spheres are led without inertia";
  const std::vector<CohesivePlace> places = turning_places(test_, section_, radius_);
  double length = 0;
  CohesivePlace from;
  for (const CohesivePlace &to : places)
    length += length_of(from, to), from = to;
  from = {};
  for (const CohesivePlace &to : places) {
    const double part = length_of(from, to) / length;
    const int steps = std::max(1, static_cast<int>(std::lround(part * test_.steps)));
    for (const double share : shares_of(kinks(to), steps)) {
      const CohesivePlace next = between(from, to, share);
      move(next);
      go_by_hand(next);
      add_row(run, next);
    }
    from = to;
  }
  conclude(run);
  run.add(model_, steps_);
  run.fracture_work = model_.works.fracture;
  return run;
}

double CohesiveResult::difference(std::size_t row) const {
  const auto each = [this](const CohesiveLoad &of) {
    return std::array<double, 3>{length * of.normal, length * of.shear, of.moment};
  };
  double scale = 0;
  for (const CohesiveRow &r : rows)
    for (const double load : each(r.by_hand))
      scale = std::max(scale, std::abs(load));
  const auto measured = each(rows[row].load), by_hand = each(rows[row].by_hand);
  double largest = 0;
  for (std::size_t k = 0; k < measured.size(); ++k)
    if (std::abs(measured[k] - by_hand[k]) > std::abs(largest)) largest = measured[k] - by_hand[k];
  return largest / scale;
}

double CohesiveResult::largest_difference() const {
  double largest = 0;
  for (std::size_t k = 0; k < rows.size(); ++k)
    largest = std::max(largest, std::abs(difference(k)));
  return largest;
}

} // namespace platen::apps
