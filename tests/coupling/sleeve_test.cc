// A sleeve around a bonded cylinder: what the cell presses on it arrives at the particles, and no energy is
// lost on the way.
#include "coupling/boundaries/sleeve.h"
#include "base/pi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dem/model.h"
#include "tests/coupling/set_ups.h"
#include "tests/same_state.h"

namespace platen::coupling::sleeve_test {
namespace {

SleeveSettings butyl() {
  SleeveSettings s;
  s.thickness = 1e-3;
  s.poisson_ratio = 0.49;
  s.mass_scaling = 1;
  s.elements_around = 12; // two spheres wide: faces bridge the gaps between spheres
  s.elements_along = 8;
  s.contact.particle_stiffness = 1e6;
  s.contact.friction_static = 0;
  s.contact.skin = 3e-4;
  s.mass_damping = 2e3;
  return s;
}

// Specimen and sleeve on one clock; the pressure rises smoothly.
struct Cell {
  dem::Specimen specimen = small_cylinder();
  dem::Model model;
  Sleeve sleeve;
  double ramp = 6e-4, pressure = 1e5, dt;
  static constexpr int struck = 50;

  explicit Cell(const SleeveSettings &settings = butyl())
      : model(specimen, with_contacts()),
        sleeve(model.particles, specimen.shape, 0, specimen.shape.height, settings) {
    sleeve.layer().seat_within(model.particles, sleeve.solid(), 1e-3);
    dt = 0.5 * model.stable_step(sleeve.layer().ground_springs(model.particles, sleeve.solid()), 0).limit;
  }
  static dem::ModelSettings with_contacts() {
    dem::ModelSettings s = elastic_settings(0.5).model;
    s.local_damping = 0.3;
    return s;
  }
  // `blow`: a force on one vertex of the inner face (N).
  void step(const Vector3 &blow = {}) {
    model.begin_step(dt);
    const double x = std::min(1.0, model.time / ramp);
    sleeve.move(dt, {{}, {}, pressure * x * x * (3 - 2 * x)});
    sleeve.layer().moved(model.last_motion().fastest * dt + sleeve.solid().largest_move(dt));
    model.compute_forces(dt);
    sleeve.layer().add_forces(model.particles, sleeve.solid(), dt);
    sleeve.solid().add_surface_force(struck, blow);
    sleeve.take_loads();
    model.end_step(dt);
  }
  void run(double until) {
    while (model.time < until)
      step();
  }
  double residual() {
    dem::EnergyLedger e = model.energy();
    sleeve.add_energy(e);
    return e.residual();
  }
};

// Sum of the normal forces on the particles along the radius, N.
double radial_force(const Cell &cell) {
  double sum = 0;
  for (const ActiveContact &c : cell.sleeve.layer().contacts())
    sum -=
        c.normal_force * (c.normal.x * c.point.x + c.normal.y * c.point.y) / std::hypot(c.point.x, c.point.y);
  return sum;
}

TEST(sleeve, hands_the_pressure_of_the_cell_to_the_specimen) {
  Cell cell;
  cell.run(1e-3);
  EXPECT_GT(cell.sleeve.layer().closed, 50u);
  // The pressure acts on the polygon of the outer face. Rims are fixed: they bear an eighth (half an element
  // at each end of eight) and what spans from the last spheres to them; the tube itself keeps next to
  // nothing.
  const dem::Shape &shape = cell.specimen.shape;
  const double outer = 12 * std::sin(pi / 12) / pi * (shape.radius / std::cos(pi / 12) + 1e-3);
  const double whole = cell.pressure * 2 * pi * outer * shape.height;
  EXPECT_GT(radial_force(cell), 0.75 * whole);
  EXPECT_LT(radial_force(cell), whole);
  // What the particles got the sleeve has got with the other sign.
  Vector3 on_particles{}, on_sleeve{};
  cell.sleeve.solid().clear_loads();
  for (std::size_t i = 0; i < cell.model.particles.size(); ++i)
    cell.model.particles.force[i] = {};
  cell.sleeve.layer().add_forces(cell.model.particles, cell.sleeve.solid(), cell.dt);
  for (std::size_t i = 0; i < cell.model.particles.size(); ++i)
    for (int k = 0; k < 3; ++k)
      on_particles[static_cast<std::size_t>(k)] += cell.model.particles.force[i][k];
  on_sleeve = cell.sleeve.solid().total_force();
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(on_particles[k] + on_sleeve[k], 0, 1e-12 * whole);
}

TEST(sleeve, the_energy_of_pressure_is_found_again) {
  Cell cell;
  cell.run(1e-3);
  EXPECT_GT(cell.sleeve.steps_of_interval(), 3); // it is stepped seldom
  EXPECT_GT(cell.sleeve.work(), 0);
  // What the rubber's damping takes is in the balance: several times what this leaves over.
  EXPECT_GT(cell.sleeve.lost(), 0.03 * cell.sleeve.work());
  EXPECT_LT(std::abs(cell.residual()), 0.01 * cell.sleeve.work());
}

// Loads that nobody asked for are not those of the next step.
TEST(sleeve, a_step_begins_without_the_loads_of_the_last_one) {
  Cell cell;
  cell.run(1e-4);
  cell.sleeve.solid().clear_loads();
  cell.sleeve.apply_forces(cell.model.particles, {});
  EXPECT_GT(norm(cell.sleeve.solid().contact_load(Cell::struck)), 0);
  cell.sleeve.solid().clear_loads();
  cell.sleeve.apply_forces(cell.model.particles, {});
  cell.sleeve.move(cell.dt, {{}, {}, cell.pressure});
  EXPECT_EQ(cell.sleeve.solid().contact_load(Cell::struck), Vector3{});
}

TEST(sleeve, parts_of_its_contacts_ascend_by_their_particles) {
  Cell cell;
  cell.run(1e-4);
  ContactLayer &layer = cell.sleeve.layer();
  const std::size_t parts = layer.prepare(cell.model.particles, cell.sleeve.solid());
  const std::vector<int> &near = layer.search().particles();
  ASSERT_GT(parts, 1u);
  auto last = near.begin();
  for (std::size_t part = 0; part < parts; ++part) {
    const auto at = std::lower_bound(near.begin(), near.end(), layer.particle_of_part(part));
    ASSERT_TRUE(at != near.end() && *at == layer.particle_of_part(part)) << "part " << part;
    // A part before it was full; rows that are passed over stand between.
    const std::ptrdiff_t full = part > 0 ? SurfacePoints::most : 0;
    EXPECT_GE(at - last, full) << "part " << part;
    last = at;
  }
}

// Stopped in the middle of an interval and between two: what the state does not hold is not there to go on
// with.
TEST(sleeve, goes_on_from_its_state_to_the_last_bit) {
  Cell whole, stopped;
  int between = 0, within = 0;
  whole.run(5e-5);
  stopped.run(5e-5);
  const State other = state_of(Cell().sleeve);
  for (int k = 0; k < 40; ++k) {
    const State kept = state_of(stopped.sleeve);
    const auto steps = [&](const char *name) { return rows_of<int>(kept, name).front(); };
    ++(steps("state/planned_steps") == steps("state/steps_made") ? between : within);
    set_state(stopped.sleeve, other);
    set_state(stopped.sleeve, kept);
    whole.step();
    stopped.step();
    ASSERT_TRUE(same_state(whole.sleeve, stopped.sleeve)) << k;
  }
  EXPECT_GT(between, 0);
  EXPECT_GT(within, 0);
}

// A vertex is struck so hard that a whole interval would drive it through the wall: half of one is begun, as
// if no more had been planned.
TEST(sleeve, an_interval_that_would_invert_an_element_is_cut) {
  Cell cell;
  cell.run(5e-5);
  const auto between = [&] {
    const State state = state_of(cell.sleeve);
    return rows_of<int>(state, "state/planned_steps") == rows_of<int>(state, "state/steps_made");
  };
  while (!between())
    cell.step();
  const int planned = cell.sleeve.steps_of_next_interval(cell.dt);
  ASSERT_GT(planned, 3);
  const Vector3 &at = cell.sleeve.solid().surface().vertices[Cell::struck];
  const double interval = planned * cell.dt, from_axis = std::hypot(at[0], at[1]);
  const double wall = 1e-3, mass = cell.sleeve.solid().surface_mass(Cell::struck);
  const double force = 1.2 * mass * wall / (interval * interval); // at its end and the next one's start
  do
    cell.step({force * at[0] / from_axis, force * at[1] / from_axis, 0});
  while (!between());
  EXPECT_EQ(cell.sleeve.cuts(), 0);
  ASSERT_EQ(cell.sleeve.steps_of_next_interval(cell.dt), planned);

  SleeveSettings half = butyl();
  half.most_steps = planned / 2;
  Sleeve other(cell.model.particles, cell.specimen.shape, 0, cell.specimen.shape.height, half);
  set_state(other, state_of(cell.sleeve));
  for (Sleeve *sleeve : {&cell.sleeve, &other}) {
    sleeve->move(cell.dt, {{}, {0, 0, -0.1}, 2e5, {}, {0, 0, -1e-6}});
    EXPECT_EQ(sleeve->steps_of_interval(), planned / 2);
    EXPECT_EQ(sleeve->cuts(), sleeve == &other ? 0 : 1);
  }
  const auto &velocity = cell.sleeve.solid().velocity(), &expected = other.solid().velocity();
  for (std::size_t n = 0; n < expected.size(); ++n)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(velocity[n][k], expected[n][k], 1e-12 * wall / interval);
  EXPECT_NEAR(cell.sleeve.work(), other.work(), 1e-12 * other.stored());
  EXPECT_NEAR(cell.sleeve.lost(), other.lost(), 1e-12 * other.stored());
}

TEST(sleeve, what_cannot_be_is_refused) {
  const dem::Specimen s = small_cylinder();
  const dem::Model model(s, Cell::with_contacts());
  SleeveSettings settings = butyl();
  settings.thickness = 0;
  EXPECT_THROW(Sleeve(model.particles, s.shape, 0, s.shape.height, settings), std::invalid_argument);
  settings = butyl();
  settings.mass_scaling = 0.5;
  EXPECT_THROW(Sleeve(model.particles, s.shape, 0, s.shape.height, settings), std::invalid_argument);
  EXPECT_THROW(Sleeve(model.particles, dem::box(1, 1, 1), 0, 1, butyl()), std::invalid_argument);
}

} // namespace
} // namespace platen::coupling::sleeve_test
