// An elastic solid that the machine carries and turns, or that turns by itself on its seat.
#include <gtest/gtest.h>

#include <cmath>

#include "base/pi.h"
#include "base/state.h"
#include "tests/elastic_nodes.h"
#include "tests/fem/elastic_plate.h"

namespace platen::fem::elastic_frame_test {
namespace {

// However far the machine carries and turns a body: what is left is round-off of places, 1e-17 m. One with
// inertia is put there, since its inside would feel the centripetal force.
TEST(elastic_solid, rigid_motion_of_any_size_stores_nothing) {
  const ElasticSolid still(plate(), {steel}, Clamp{});
  ElasticSolid carried(plate(), {steel}, Clamp{}, {1, ElasticMotion::quasi_static}),
      put_there(plate(), {steel}, Clamp{});
  const double dt = 0.3 / 64; // far larger than a stable step: nothing must be there to oscillate
  carried.set_velocity({3, -2, 1}, {0.5 * pi / 0.3, 0, 0});
  for (int k = 0; k < 64; ++k)
    carried.drift(dt);
  carried.solve_for(std::vector<Vector3>(carried.surface().vertices.size(), Vector3{}), 0);
  State state = with_rows(state_of(put_there), "state/rotation", std::vector<Quaternion>{carried.rotation()});
  state = with_rows(state, "state/displacement", std::vector<Vector3>{carried.displacement()});
  set_state(put_there, state);
  const std::vector<Vector3> none(still.model().nodes.size(), Vector3{});
  set_deformation(put_there, none, none);
  for (const ElasticSolid *solid : {&carried, &put_there}) {
    EXPECT_NEAR(solid->rotation().x, std::sqrt(0.5), 1e-12); // a quarter turn about x
    EXPECT_LT(solid->energy_balance().strain, 1e-20);
    for (const Stress &s : cell_stress(solid->model(), solid->deformation()))
      EXPECT_LT(von_mises(s), 1e-13 * steel.young_modulus);
    const Vector3 moved = solid->displacement();
    EXPECT_NEAR(moved[0], 0.9, 1e-12);
    for (std::size_t v = 0; v < still.surface().vertices.size(); ++v) {
      const Vector3 r = still.surface().vertices[v] - still.centre();
      const Vector3 expected = still.centre() + moved + Vector3{r[0], -r[2], r[1]};
      EXPECT_LT(norm(solid->surface().vertices[v] - expected), 1e-13);
    }
  }
}

// Turned by a right angle first, a body bends in its own frame as it would have upright.
TEST(elastic_solid, a_turned_body_bends_as_an_upright_one) {
  ElasticSolid upright(plate(), {steel}, Clamp{}, {2, ElasticMotion::quasi_static});
  ElasticSolid turned(plate(), {steel}, Clamp{}, {2, ElasticMotion::quasi_static});
  turned.set_velocity({}, {0, 0.5 * pi, 0});
  turned.drift(1);
  std::vector<Vector3> loads = uneven_loads(upright, 1e3);
  upright.solve_for(loads, 0);
  for (Vector3 &f : loads)
    f = rotate(turned.rotation(), f);
  turned.solve_for(loads, 0);
  const auto a = upright.deformation(), b = turned.deformation();
  double size = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    size = std::max(size, norm(a[i]));
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_LT(norm(a[i] - b[i]), 1e-10 * size);
}

// On an elastic ground that is tilted and takes energy, the free seat turns the plate until the ground pushes
// without moment: the plate lies as the ground does, but for the third of a percent that its face shifts
// sideways.
TEST(elastic_solid, a_free_seat_turns_until_the_moment_is_gone) {
  for (const ElasticMotion kind : {ElasticMotion::explicit_steps, ElasticMotion::quasi_static}) {
    Clamp clamp;
    clamp.turns = true;
    clamp.seat = {0.01, 0, 0.02};
    ElasticOptions options{1, kind};
    if (kind == ElasticMotion::explicit_steps) options.mass_damping = 3000;
    ElasticSolid solid(make_grid(BoxPlate{{-0.02, -0.03, 0}, {0.04, 0.03, 0.02}, {2, 2, 1}}), {steel}, clamp,
                       options);
    const double stiffness = 1e7, dashpot = 500, slope = 2e-3, sink = 1e-4, dt = 1e-6;
    const auto press = [&] {
      solid.clear_loads();
      for (std::size_t v = 0; v < solid.surface().vertices.size(); ++v) {
        const Vector3 &p = solid.surface().vertices[v];
        if (std::abs(p[2]) > 5e-3) continue;
        const double speed = solid.surface().velocities[v][2];
        solid.add_surface_force(static_cast<int>(v),
                                {0, 0, stiffness * (sink + slope * (p[0] - 0.01) - p[2]) - dashpot * speed});
      }
    };
    press();
    const double moment_at_start = norm(solid.moment(solid.centre()));
    EXPECT_GT(moment_at_start, 1);
    for (int k = 0; k < 20000; ++k) {
      solid.kick(0.5 * dt), solid.drift(dt);
      press();
      solid.kick(0.5 * dt);
      if (kind == ElasticMotion::quasi_static && k % 50 == 49)
        solid.solve_for(solid.contact_loads(), 50 * dt);
    }
    EXPECT_LT(norm(solid.moment(solid.centre())), 1e-6 * moment_at_start);
    const Vector3 normal = rotate(solid.rotation(), {0, 0, 1});
    EXPECT_NEAR(-normal[0] / normal[2], slope, 5e-3 * slope);
    EXPECT_NEAR(normal[1], 0, 1e-9);
    EXPECT_NEAR(norm(solid.displacement()), 0, 1e-15); // the seat is fixed
    EXPECT_NEAR(clamp_loads(solid).force[2], solid.total_force()[2], 1e-6 * solid.total_force()[2]);
  }
}

// Free to turn and not pushed, a body on its seat keeps its angular momentum about it.
TEST(elastic_solid, a_body_on_its_seat_keeps_its_angular_momentum) {
  Clamp clamp;
  clamp.turns = true;
  clamp.seat = {0.01, 0.005, 0.03};
  ElasticSolid solid(plate(), {steel}, clamp, {1});
  const std::vector<Vector3> none(solid.model().nodes.size(), Vector3{});
  solid.set_velocity({}, {20, -10, 30});
  set_deformation(solid, none, shaken(solid, 1e-2));
  const Vector3 start = momenta(solid).angular;
  const double dt = 0.8 * solid.stable_step();
  solid.drift(dt, 1);
  const double energy = total(solid.energy_balance());
  for (int k = 0; k < 4000; ++k)
    solid.drift(dt, 1);
  EXPECT_LT(norm(momenta(solid).angular - start), 1e-10 * norm(start));
  EXPECT_NEAR(total(solid.energy_balance()), energy, 1e-4 * energy); // order dt^2 w^2 where it turns
}

} // namespace
} // namespace platen::fem::elastic_frame_test
