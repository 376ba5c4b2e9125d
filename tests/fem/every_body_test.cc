// What holds of every body: it goes on from its state to the last bit, on any number of threads, and its
// picture repeats.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/parallel.h"
#include "fem/rigid_body.h"
#include "tests/fem/elastic_plate.h"
#include "tests/fem/metal.h"
#include "tests/fem/rubber_sleeve.h"
#include "tests/same_state.h"

namespace platen::fem::every_body_test {
namespace {

// Loads that change, and take energy.
template <class Solid>
void load(Solid &solid, int k, double size, double dashpot) {
  solid.clear_loads();
  for (std::size_t v = 0; v < solid.surface().vertices.size(); v += 3)
    solid.add_surface_force(static_cast<int>(v),
                            size * std::cos(k + static_cast<double>(v)) * Vector3{0.2, -0.1, 1} -
                                dashpot * solid.surface().velocities[v]);
}

struct OfPlate {
  static void step(Body &body, int k) {
    constexpr double dt = 3e-7;
    body.kick(0.5 * dt), body.drift(dt);
    load(body, k, 1e3, 1e3);
    body.kick(0.5 * dt);
  }
};
struct Rigid : OfPlate {
  static constexpr const char *name = "rigid";
  static RigidBody make() {
    RigidBody body(plate(), steel);
    body.set_velocity({0.1, -0.2, 0.3}, {3, -2, 5});
    return body;
  }
};
struct RigidOnSeat : OfPlate {
  static constexpr const char *name = "rigid_on_a_seat";
  static RigidBody make() {
    RigidBody body(plate(), steel, Vector3{0.01, 0, 0.02});
    body.set_velocity({0.1, 0, -0.2}, {3, -2, 1});
    return body;
  }
};
template <ElasticMotion motion>
struct Elastic : OfPlate {
  static constexpr bool is_static = motion == ElasticMotion::quasi_static;
  static constexpr const char *name = is_static ? "quasi_static" : "elastic";
  static ElasticSolid make() {
    Clamp clamp;
    clamp.turns = true;
    clamp.seat = {0.01, 0, 0.02};
    ElasticSolid solid(make_grid(CylinderPlate{0.03, 0.02, 0, 12, 3}), {steel}, clamp,
                       {is_static ? 1 : 2, motion});
    solid.set_velocity({0, 0, -0.2});
    return solid;
  }
  static void step(ElasticSolid &solid, int k) {
    if (is_static && k % 10 == 0) solid.solve_for(solid.contact_loads(), 3e-6);
    OfPlate::step(solid, k);
  }
};
struct Yielding {
  static constexpr const char *name = "yielding";
  static ElasticSolid make() {
    Material metal = steel;
    metal.hardening = lines({{0, 1e5}}, 1e5, 20);
    Clamp clamp;
    clamp.turns = true;
    clamp.seat = {0.01, 0, 0.02};
    ElasticSolid solid(make_grid(CylinderPlate{0.03, 0.02, 0, 12, 3}), {metal}, clamp, {2});
    solid.set_velocity({0, 0, -0.2});
    return solid;
  }
  static void step(ElasticSolid &solid, int k) {
    const double dt = 0.5 * solid.stable_step();
    solid.kick(0.5 * dt), solid.drift(dt);
    load(solid, k, 100, 1);
    solid.kick(0.5 * dt);
    const double lost = solid.energy_balance().plastic;
    if (k == 14) {
      EXPECT_GT(lost, 0);
    }
    if (k == 59) {
      EXPECT_LT(lost, 1);
    }
  }
};
struct OfRubber {
  static constexpr const char *name = "rubber";
  static HyperelasticSolid make() {
    HyperelasticSolid solid = held_sleeve(2e4);
    solid.set_damping(50);
    solid.set_prescribed_velocity(1, {0, 0, -0.3}, {0.1, 0.2, 5}, {0, 0, 0.06});
    return solid;
  }
  static void step(HyperelasticSolid &solid, int k) {
    load(solid, k, 0.1, 0.01);
    fem::step(solid, 1e-5, 1);
  }
};

template <class Kind>
class EveryBody : public testing::Test {};
struct NameOf {
  template <class Kind>
  static std::string GetName(int) {
    return Kind::name;
  }
};
using Kinds = testing::Types<Rigid, RigidOnSeat, Elastic<ElasticMotion::explicit_steps>,
                             Elastic<ElasticMotion::quasi_static>, Yielding, OfRubber>;
TYPED_TEST_SUITE(EveryBody, Kinds, NameOf);

TYPED_TEST(EveryBody, goes_on_from_its_state_to_the_last_bit) {
  auto body = TypeParam::make(), other = TypeParam::make();
  const auto go = [](auto &of, int first, int last) {
    for (int k = first; k < last; ++k)
      TypeParam::step(of, k);
  };
  go(body, 0, 27), go(other, 0, 2); // with loads that have to go
  set_state(other, state_of(body));
  EXPECT_TRUE(same_state(body, other));
  EXPECT_EQ(other.surface().vertices, body.surface().vertices);
  EXPECT_EQ(other.surface().velocities, body.surface().velocities);
  EXPECT_EQ(other.contact_loads(), body.contact_loads());
  go(body, 27, 60), go(other, 27, 60);
  EXPECT_TRUE(same_state(body, other));
  EXPECT_EQ(other.surface().vertices, body.surface().vertices);
  EXPECT_THROW(set_state(other, State()), StateError);
  EXPECT_TRUE(same_state(body, other));
}

TYPED_TEST(EveryBody, any_number_of_threads_gives_the_same_bits) {
  std::vector<State> ends;
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    auto body = TypeParam::make();
    for (int k = 0; k < 15; ++k)
      TypeParam::step(body, k);
    ends.push_back(state_of(body));
  }
  EXPECT_TRUE(same_state(ends[0], ends[1]));
  EXPECT_TRUE(same_state(ends[0], ends[2]));
}

TYPED_TEST(EveryBody, has_a_picture_of_its_fields_where_its_surface_is) {
  auto body = TypeParam::make();
  TypeParam::step(body, 0);
  std::vector<double> slip(body.surface().vertices.size(), 0.0);
  slip.back() = 2.5;
  const Picture picture = body.picture(slip), without = body.picture({});
  std::vector<std::string> names;
  for (const PictureField &field : picture.of_points) {
    names.push_back(field.name);
    EXPECT_EQ(field.values.size(), picture.points.size() * static_cast<std::size_t>(field.components));
  }
  std::vector<std::string> fields{"displacement", "contact_shear", "contact_pressure", "slip"};
  const std::string name = TypeParam::name;
  if (name.find("rigid") == std::string::npos) fields.insert(fields.end(), {"stress", "von_mises"});
  if (name == "rubber") fields.push_back("pressure");
  EXPECT_EQ(names, fields);
  for (const PictureField &field : picture.of_cells)
    EXPECT_EQ(field.values.size() * static_cast<std::size_t>(picture.nodes_per_cell), picture.cells.size());
  const auto tractions = body.contact_tractions();
  for (std::size_t v = 0; v < slip.size(); ++v) { // each vertex is a point, with its tractions and slip
    bool found = false;
    for (std::size_t n = 0; n < picture.points.size() && !found; ++n) {
      const double *shear = &picture.of_points[1].values[3 * n];
      found = norm(picture.points[n] - body.surface().vertices[v]) < 1e-15 &&
              Vector3{shear[0], shear[1], shear[2]} == tractions[v].shear &&
              picture.of_points[2].values[n] == tractions[v].pressure &&
              picture.of_points[3].values[n] == slip[v];
    }
    ASSERT_TRUE(found) << v;
  }
  // Elements of one material that meet at a node show the same there.
  std::map<std::array<double, 3>, std::size_t> first;
  for (std::size_t n = 0; n < picture.points.size(); ++n) {
    const Vector3 &p = picture.points[n];
    const std::size_t same = first.emplace(std::array<double, 3>{p.x, p.y, p.z}, n).first->second;
    for (const PictureField &field : picture.of_points) {
      const auto parts = static_cast<std::size_t>(field.components);
      for (std::size_t k = 0; k < parts; ++k)
        ASSERT_EQ(field.values[parts * n + k], field.values[parts * same + k]) << field.name << " at " << n;
    }
  }
  const std::vector<double> &none = without.of_points[3].values;
  EXPECT_EQ(std::count(none.begin(), none.end(), 0.0), static_cast<std::ptrdiff_t>(none.size()));
  EXPECT_THROW(body.picture({1.0}), std::invalid_argument);
}

} // namespace
} // namespace platen::fem::every_body_test
