#include "apps/bonds/interface_test.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

InterfaceSection section_of_one(const dem::Bonds &bonds, double modulus) {
  const double radius = bonds.bond_radius[0];
  return section_of(bonds.law, bonds.rest_length[0], pi * radius * radius, modulus);
}

// Plastic closing as a stress, damage in tension and in shear, of what one bond remembers.
struct Remembered {
  double plastic = 0, tension = 0, shear = 0;
};
Remembered remembered(const dem::InterfaceState<double> &s) {
  return {s.plastic, s.tension_damage, s.shear_damage};
}
Remembered remembered(const dem::YieldingParallelBond::State<double> &s) {
  return {s.plastic, s.broken == 1 ? 1.0 : 0.0, s.broken == 2 ? 1.0 : 0.0};
}

bool slides(const PairTest &test) {
  return test.path == PairPath::shear;
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

double length_of(const InterfacePlace &from, const InterfacePlace &to) {
  return std::abs(to.opening - from.opening) + std::abs(to.slip - from.slip);
}

// Places that the path goes to on straight lines, from touching spheres on.
std::vector<InterfacePlace> turning_places(const PairTest &test, const InterfaceSection &section) {
  std::vector<double> turns = test.turns;
  if (turns.empty())
    for (const double point : turning_points(test))
      turns.push_back(point * test.displacement);
  std::vector<InterfacePlace> places;
  const double closed = slides(test) && test.pressure > 0 ? -section.closing_at(test.pressure) : 0;
  if (closed != 0) places.push_back({closed, 0});
  for (const double turn : turns) {
    if (slides(test))
      places.push_back({closed, turn});
    else
      places.push_back({turn, test.path == PairPath::combined ? test.slip_ratio * turn : 0});
  }
  return places;
}

} // namespace

InterfaceTest::InterfaceTest(const Scene &scene, double modulus, double stiffness_ratio)
    : test_(scene.pair_test),
      model_(touching_spheres(scene), settings_of(scene, modulus, stiffness_ratio)),
      section_(section_of_one(*model_.bonds, modulus)),
      by_hand_(section_, test_.path == PairPath::combined, test_.slip_ratio) {
  (model_.particles.id[0] == 0 ? lower_ : upper_) = 1; // sphere 0 of the specimen is the upper one
}

// The upper sphere goes along the line of centres, and both turn about the same axis so that their surfaces
// slide on each other by the slip at a distance that stays.
void InterfaceTest::move(const InterfacePlace &to) {
  dem::Particles &p = model_.particles;
  const double here = p.position[upper_].z - p.position[lower_].z;
  const double distance = section_.length + to.opening;
  p.velocity[upper_] = {0, 0, (distance - here) / step};
  if (p.has_rotation())
    for (Vector3 &spin : *p.angular_velocity)
      spin = {0, -(to.slip - at_.slip) / (distance * step), 0};
  model_.begin_step(step);
  model_.compute_forces(step);
  const Vector3 force = p.force[upper_];
  const InterfaceLoad before = now_;
  now_ = {0 - force.z, 0 - force.x};
  work_ += 0.5 * ((before.normal + now_.normal) * (to.opening - at_.opening) +
                  (before.shear + now_.shear) * (to.slip - at_.slip));
  at_ = to;
  ++steps_;
  // At rest again, and free of loads: the next step begins by half a kick.
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.velocity[i] = p.force[i] = {};
    if (p.has_rotation()) (*p.angular_velocity)[i] = (*p.torque)[i] = {};
  }
}

InterfaceReading InterfaceTest::read() const {
  const dem::Bonds &b = *model_.bonds;
  const dem::BondTotals totals = dem::bond_totals(model_.particles, b);
  const Remembered state = dem::of_remembering(b.law, [&](const auto &of) {
    return remembered(b.memory<typename std::decay_t<decltype(of)>::template State<double>>(0));
  });
  return {
      state.tension, state.shear,   state.plastic / section_.normal_stiffness(),
      work_,         totals.energy, model_.works.fracture + totals.damage + totals.friction + totals.plastic};
}

void InterfaceTest::add_row(BondRun &run, const InterfacePlace &at) const {
  const dem::BondResponse<double> response = model_.bonds->response(0, model_.particles);
  RigReading row;
  row.force = slides(test_) ? now_.shear : now_.normal;
  row.displacement = slides(test_) ? at.slip : at.opening;
  row.normal = now_.normal;
  row.shear = now_.shear;
  row.tension_ratio = response.tension_ratio;
  row.shear_ratio = response.shear_ratio;
  row.intact = static_cast<int>(model_.intact_bonds());
  row.strain_ratio = not_given;
  run.path.rows.push_back(row);
  run.interface.rows.push_back({read(), now_, by_hand_.load(), by_hand_.dissipated()});
  if (row.intact > 0 && std::abs(row.force) > std::abs(run.path.largest.force)) run.path.largest = row;
}

// What is known by hand, and the energy of the softening branch.
void InterfaceTest::conclude(BondRun &run) const {
  const bool combined = test_.path == PairPath::combined;
  const SofteningByHand softening = slides(test_) ? section_.shear(test_.pressure) : section_.tension();
  run.stiffness_by_hand = section_.area * softening.stiffness;
  run.strength_by_hand = section_.area * softening.strength;
  if (test_.path == PairPath::compression) run.strength_by_hand = std::numeric_limits<double>::infinity();
  if (combined) { // where the first of the lines bends down
    InterfaceByHand fresh(section_, true, test_.slip_ratio);
    const InterfacePlace end = turning_places(test_, section_).front();
    const std::vector<double> kinks = fresh.kinks(end);
    run.strength_by_hand = not_given;
    if (!kinks.empty()) { // of a brittle one just before it breaks
      fresh.go({kinks.front() * end.opening, kinks.front() * end.slip});
      run.strength_by_hand = fresh.load().normal;
    }
  }
  InterfaceResult &result = run.interface;
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

BondRun InterfaceTest::run() {
  BondRun run;
  run.modulus = section_.modulus;
  run.stiffness_ratio = section_.shear_stiffness() / section_.normal_stiffness();
  run.bonds = model_.intact_bonds();
  run.bond_area = section_.area;
  run.time_step = run.strain_ratio_by_hand = not_given;
  run.time_step_reason = "none: spheres are led without inertia";
  const std::vector<InterfacePlace> places = turning_places(test_, section_);
  double length = 0;
  InterfacePlace from;
  for (const InterfacePlace &to : places)
    length += length_of(from, to), from = to;
  from = {};
  for (const InterfacePlace &to : places) {
    const double part = length_of(from, to) / length;
    const int steps = std::max(1, static_cast<int>(std::lround(part * test_.steps)));
    for (const double share : shares_of(by_hand_.kinks(to), steps)) {
      const InterfacePlace next = share < 1
                                      ? InterfacePlace{from.opening + share * (to.opening - from.opening),
                                                       from.slip + share * (to.slip - from.slip)}
                                      : to;
      move(next);
      by_hand_.go(next);
      add_row(run, next);
    }
    from = to;
  }
  conclude(run);
  run.add(model_, steps_);
  run.fracture_work = model_.works.fracture;
  return run;
}

double InterfaceResult::difference(std::size_t row) const {
  double scale = 0;
  for (const InterfaceRow &r : rows)
    scale = std::max({scale, std::abs(r.by_hand.normal), std::abs(r.by_hand.shear)});
  const InterfaceRow &r = rows[row];
  const double normal = r.load.normal - r.by_hand.normal, shear = r.load.shear - r.by_hand.shear;
  return (std::abs(normal) > std::abs(shear) ? normal : shear) / scale;
}

double InterfaceResult::largest_difference() const {
  double largest = 0;
  for (std::size_t k = 0; k < rows.size(); ++k)
    largest = std::max(largest, std::abs(difference(k)));
  return largest;
}

} // namespace platen::apps
