#include "coupling/static_press.h"

#include <algorithm>

#include "dem/measure/gauge.h"

namespace platen::coupling {

namespace {

constexpr int most_solves = 40; // the set of contacts settles within ten, or oscillates
constexpr double rough = 1e-4;
// After this many solves a sphere changes its state only for more than this fraction of the mean force.
constexpr int decided = 12;
constexpr double hair = 0.01;

// All spheres near both platens, and which of them are pressed.
struct Contacts {
  std::vector<dem::Support> near;
  std::vector<bool> pressed;
  std::size_t first_of_top = 0;
  bool glued = false;
};

Contacts contacts_of(PlatenTest &test, double strain) {
  Contacts c;
  c.glued = test.top().glued();
  const double displacement = 0.5 * strain * test.shape().height;
  for (const bool top : {false, true}) {
    if (top) c.first_of_top = c.near.size();
    for (dem::GroundSpring &s : (top ? test.top() : test.bottom()).total_springs(test.model.particles))
      if (s.gap <= displacement) c.near.push_back({s, {0, 0, top ? -displacement : displacement}});
  }
  c.pressed.assign(c.near.size(), true);
  return c;
}

// Force of the platen on the particle along the normal, N; the gap has to be closed first.
double normal_force(const dem::Support &s, const dem::StaticState &state) {
  const std::size_t i = static_cast<std::size_t>(s.spring.particle);
  Vector3 u = state.displacement[i];
  if (!state.turn.empty()) u += cross(state.turn[i], s.spring.arm);
  return s.spring.normal_stiffness * (dot(s.moved - u, s.spring.normal) - s.spring.gap);
}

dem::StaticCase case_of(const Contacts &c) {
  dem::StaticCase load;
  for (std::size_t k = 0; k < c.near.size(); ++k) {
    if (!c.pressed[k]) continue;
    load.supports.push_back(c.near[k]);
    // The closure of the gap causes no strain.
    load.supports.back().moved -= c.near[k].spring.gap * c.near[k].spring.normal;
  }
  return load;
}

// True where no sphere changed its state. A sphere changes only where its force exceeds `band` times the mean
// force, so that repeated sets settle.
bool update(Contacts &c, const dem::StaticState &state, double band) {
  std::vector<double> force(c.near.size());
  double sum = 0;
  std::size_t pressed = 0;
  for (std::size_t k = 0; k < c.near.size(); ++k) {
    force[k] = normal_force(c.near[k], state);
    if (c.pressed[k] && force[k] > 0) sum += force[k], ++pressed;
  }
  const double undecided = band * sum / static_cast<double>(std::max<std::size_t>(pressed, 1));
  bool settled = true;
  for (std::size_t k = 0; k < c.near.size(); ++k) {
    const bool presses = c.glued || force[k] > (c.pressed[k] ? -undecided : undecided);
    settled = settled && presses == c.pressed[k];
    c.pressed[k] = presses;
  }
  return settled;
}

StaticPress measured(const PlatenTest &test, const Contacts &c, const dem::StaticState &state,
                     double strain) {
  StaticPress p;
  p.strain_platen = strain;
  for (std::size_t k = 0; k < c.near.size(); ++k) {
    if (!c.pressed[k]) continue;
    const bool top = k >= c.first_of_top;
    ++(top ? p.closed_top : p.closed_bottom);
    const double up = normal_force(c.near[k], state) * c.near[k].spring.normal.z;
    p.stress += 0.5 * (top ? -up : up) / test.nominal_area();
  }
  dem::Gauge gauge(test.model.particles, test.shape(), test.model.bonds.get());
  const dem::GaugeStrain s = gauge.strain_of(test.model.particles, state.displacement);
  p.strain_gauge = -s.axial;
  p.lateral_strain = s.lateral();
  return p;
}

} // namespace

StaticPress press_statically(PlatenTest &test, double strain, const dem::StaticSettings &settings) {
  if (!test.model.bonds || !(strain > 0))
    throw NumericsStopped("a static solve needs bonds and a strain above 0");
  if (test.top().layer().parameters().hertz)
    throw NumericsStopped("a static solve needs linear springs on the platens (`platens.contact`)");
  Contacts contacts = contacts_of(test, strain);
  dem::EquilibriumSolver solver(test.model.particles, *test.model.bonds);
  // While the set of contacts still changes a rough solution is enough.
  dem::StaticSettings now = settings;
  now.tolerance = std::max(settings.tolerance, rough);
  dem::StaticState state;
  int iterations = 0;
  for (int solve = 1; solve <= most_solves; ++solve) {
    try {
      state = solver.solve(case_of(contacts), now, solve > 1 ? &state : nullptr);
    } catch (const dem::NoEquilibrium &e) {
      throw NumericsStopped(e.what());
    }
    iterations += state.iterations;
    if (!update(contacts, state, solve > decided ? hair : 0)) continue;
    if (now.tolerance > settings.tolerance) {
      now.tolerance = settings.tolerance;
      continue;
    }
    StaticPress p = measured(test, contacts, state, strain);
    p.solves = solve;
    p.iterations = iterations;
    p.displacement = std::move(state.displacement);
    p.turn = std::move(state.turn);
    return p;
  }
  throw NumericsStopped("the contacts of the platens do not settle in " + std::to_string(most_solves) +
                        " solves");
}

StaticPress start_statically(PlatenTest &test, double strain, const dem::StaticSettings &settings) {
  StaticPress p = press_statically(test, strain, settings);
  const double rise = 0.5 * strain * test.shape().height; // m, of each platen towards the other
  std::vector<Vector3> of_boundaries(test.boundaries().size(), Vector3{});
  of_boundaries[0] = {0, 0, rise}; // bottom
  of_boundaries[1] = {0, 0, -rise};
  test.carry(p.displacement, p.turn, of_boundaries);
  return p;
}

} // namespace platen::coupling
