// What tests give to the nodes of an ElasticSolid and ask of them, by its state.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fem/elastic_solid.h"
#include "tests/same_state.h"

namespace platen::fem {

// m, of a node about centre or seat, in global axes, where it is displaced by u (m) in the frame's axes.
inline Vector3 arm_of(const ElasticSolid &solid, std::size_t node, const Vector3 &u) {
  return rotate(solid.rotation(), solid.model().nodes[node] - (solid.centre() - solid.displacement()) + u);
}

// Sets a deformation (m) and, for an explicit body, its rate (m/s) in the frame's axes; clamped nodes are
// ignored. The energy balance starts anew.
inline void set_deformation(ElasticSolid &solid, std::vector<Vector3> u, std::vector<Vector3> rate) {
  rate.resize(u.size(), Vector3{});
  for (const int held : solid.clamped_nodes())
    u[static_cast<std::size_t>(held)] = rate[static_cast<std::size_t>(held)] = Vector3{};
  std::vector<Vector3> moved, velocity;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const Vector3 r = solid.model().nodes[i] - (solid.centre() - solid.displacement());
    const Quaternion &turn = solid.rotation();
    moved.push_back(solid.displacement() + (rotate(turn, r) - r) + rotate(turn, u[i]));
    velocity.push_back(solid.velocity() + cross(solid.angular_velocity(), arm_of(solid, i, u[i])) +
                       rotate(turn, rate[i]));
  }
  State state = state_of(solid);
  const auto set = [&](const char *name, const auto &rows) {
    if (state.find(std::string("state/") + name))
      state = with_rows(state, std::string("state/") + name, rows);
  };
  set("start", u), set("target", u); // quasi-static
  set("node_displacement", moved), set("node_velocity", velocity);
  for (const char *zero : {"elapsed", "duration", "last_step", "load_work", "clamp_work", "dissipated"})
    set(zero, std::vector<double>{0});
  set("on_the_way", std::vector<char>{0});
  set_state(solid, state);
}

// Explicit, clamped nodes included: kg m/s, and kg m^2/s about centre or seat.
struct Momenta {
  Vector3 linear{}, angular{};
};
inline Momenta momenta(const ElasticSolid &solid) {
  const auto rate = rows_of<Vector3>(state_of(solid), "state/node_velocity", "m/s");
  const std::vector<Vector3> u = solid.deformation();
  Momenta sum;
  for (std::size_t i = 0; i < rate.size(); ++i) {
    sum.linear += solid.model().mass[i] * rate[i];
    sum.angular += solid.model().mass[i] * cross(arm_of(solid, i, u[i]), rate[i]);
  }
  return sum;
}

// What the body puts on the machine (N, N m about centre or seat): what strain makes its free nodes bear, and
// the loads on clamped ones. At rest that of the loads.
struct ClampLoads {
  Vector3 force{}, moment{};
};
inline ClampLoads clamp_loads(const ElasticSolid &solid) {
  const std::vector<Vector3> u = solid.deformation();
  std::vector<Vector3> borne;
  multiply(solid.model().stiffness, u, borne);
  for (Vector3 &f : borne)
    f = rotate(solid.rotation(), f);
  for (const int held : solid.clamped_nodes())
    borne[static_cast<std::size_t>(held)] = Vector3{};
  const std::vector<int> node = node_surface(solid.model()).node;
  for (const int held : solid.clamped_nodes())
    for (const int v : solid.loaded_vertices())
      if (node[static_cast<std::size_t>(v)] == held)
        borne[static_cast<std::size_t>(held)] += solid.contact_load(v);
  ClampLoads loads;
  for (std::size_t i = 0; i < u.size(); ++i) {
    loads.force += borne[i];
    loads.moment += cross(arm_of(solid, i, u[i]), borne[i]);
  }
  return loads;
}

} // namespace platen::fem
