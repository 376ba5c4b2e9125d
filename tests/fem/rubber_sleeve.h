// A rubber sleeve and fields on it for the tests of HyperelasticSolid.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "fem/hyperelastic_solid.h"
#include "tests/same_state.h"

namespace platen::fem {

inline const SolidMaterial rubber{1100, NeoHookean::from_young(3e6, 0.49)};

inline HyperelasticSolid sleeve(const SolidMaterial &material = rubber,
                                const std::vector<int> &contact = {inner_tag}) {
  return HyperelasticSolid(make_grid(Tube{0.05, 0.005, 0.0, 0.06, 16, 6, 2}), material, contact);
}

inline std::vector<Vector3> random_field(std::size_t nodes, double size, unsigned seed = 3) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> spread(-size, size);
  std::vector<Vector3> field(nodes);
  for (Vector3 &p : field)
    p = {spread(engine), spread(engine), spread(engine)};
  return field;
}

// A smooth field as large as the wall is thick.
inline std::vector<Vector3> bent(const HyperelasticSolid &solid, double size = 0.005) {
  std::vector<Vector3> field;
  for (const Vector3 &x : solid.mesh().nodes)
    field.push_back({size * std::sin(40 * x[1] + 20 * x[2]), size * std::cos(30 * x[2] + 10 * x[0]),
                     size * std::sin(30 * x[0])});
  return field;
}

inline Vector3 turned(const Vector3 &p) { // 2.3 rad about (2, 3, 6)/7
  const Vector3 axis = {2.0 / 7, 3.0 / 7, 6.0 / 7};
  const double c = std::cos(2.3), s = std::sin(2.3);
  return c * p + s * cross(axis, p) + (1 - c) * dot(axis, p) * axis;
}

inline double largest(const std::vector<Vector3> &field) {
  double most = 0;
  for (const Vector3 &p : field)
    most = std::max(most, norm(p));
  return most;
}

inline std::vector<Vector3> turned_places(const HyperelasticSolid &solid,
                                          const std::vector<Vector3> &displacement) {
  std::vector<Vector3> moved = displacement;
  for (std::size_t n = 0; n < moved.size(); ++n)
    moved[n] = turned(solid.mesh().nodes[n] + displacement[n]) - solid.mesh().nodes[n];
  return moved;
}

// Blown up from inside with its ends fixed; rings as it is let go. (From outside it would buckle at 7 kPa.)
inline HyperelasticSolid held_sleeve(double pressure, double poisson = 0.45) {
  HyperelasticSolid solid = sleeve({1100, NeoHookean::from_young(3e6, poisson)});
  solid.prescribe(solid.nodes_of(low_end_tag), {true, true, true});
  solid.prescribe(solid.nodes_of(high_end_tag), {true, true, true});
  solid.set_pressure(inner_tag, pressure);
  solid.update_forces();
  return solid;
}

inline void set_velocity(HyperelasticSolid &solid,
                         const std::vector<Vector3> &velocity) { // m/s, of each node
  set_state(solid, with_rows(state_of(solid), "state/node_velocity", velocity));
}

inline void step(HyperelasticSolid &solid, double dt, int steps) {
  for (int k = 0; k < steps; ++k) {
    solid.half_kick(dt);
    solid.drift(dt);
    solid.update_forces();
    solid.half_kick(dt);
  }
}

inline double imbalance(const HyperelasticSolid &solid) {
  return solid.kinetic_energy() + solid.internal_energy() + solid.damping_work() - solid.pressure_work() -
         solid.prescribed_work();
}

} // namespace platen::fem
