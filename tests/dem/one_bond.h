// One bond that remembers between two spheres along z, with prescribed motion, for tests of its law. SI
// units.
#pragma once

#include "base/pi.h"
#include "base/vector3.h"
#include "dem/laws/cohesive_moments.h"
#include "dem/laws/facet_bond.h"
#include "dem/laws/yielding_parallel_bond.h"
#include "tests/dem/examples.h"

namespace platen::dem::examples {

// What acts by the law, and moves the state on.
inline CohesiveResponse<double> act(const ElastoDamagePlastic &law, CohesiveState<double> &s,
                                    const CohesiveGeometry<double> &g, const CohesiveMotion<double> &m) {
  if (law.parameters.moments) return BendingCohesive{law}(s, g, m);
  CohesiveResponse<double> r = law(s, g, m);
  const Triple<double> moment = cross(m.distance, r.force); // by the force at its arms
  r.torque_i = scale(g.lever, moment), r.torque_j = scale(1 - g.lever, moment);
  return r;
}
template <class Law>
CohesiveResponse<double> act(const Law &law, typename Law::template State<double> &s,
                             const CohesiveGeometry<double> &g, const CohesiveMotion<double> &m) {
  return law(s, g, m);
}
// What sums over bonds ask for.
inline ForceAndEnergy<double> force_and_energy(const ElastoDamagePlastic &law, const CohesiveState<double> &s,
                                               const CohesiveGeometry<double> &g,
                                               const BondMotion<double> &pose) {
  return law.parameters.moments ? BendingCohesive{law}.force_and_energy(s, g, pose)
                                : law.force_and_energy(s, g, pose);
}
template <class Law>
ForceAndEnergy<double> force_and_energy(const Law &law, const typename Law::template State<double> &s,
                                        const CohesiveGeometry<double> &g, const BondMotion<double> &pose) {
  return law.force_and_energy(s, g, pose);
}

// The first sphere stays where it is, both turn.
template <class Law>
struct OneBond {
  Law law;
  CohesiveGeometry<double> geometry;
  typename Law::template State<double> state{};
  CohesiveMotion<double> pose;
  CohesiveResponse<double> now{};
  double work = 0;       // J, by the trapezoid over each step: exact along straight lines
  double kinks_work = 0; // J, what that misses where a step crosses a kink, of laws that count it

  OneBond(const Law &of, double young, double length, double bond_radius)
      : law(of),
        geometry{length,         0.5,        young / length, pi * bond_radius * bond_radius, 1.0,
                 {0, 0, length}, bond_radius},
        pose{{0, 0, length}, {}, {}, 0, {1, 0, 0, 0}, {1, 0, 0, 0}, {}, {}} {
    now = act(law, state, geometry, pose);
  }
  virtual ~OneBond() = default;
  // The second sphere moves by this and both turn by these (rad, small), in so many steps.
  void move(const Triple<double> &by, const Triple<double> &turn_i = {}, const Triple<double> &turn_j = {},
            int steps = 1) {
    const double part = 1.0 / steps;
    for (int k = 0; k < steps; ++k) {
      begin_step();
      const CohesiveResponse<double> before = now;
      pose.travelled = scale(part, by), pose.turned_i = scale(part, turn_i),
      pose.turned_j = scale(part, turn_j);
      pose.distance = pose.distance + pose.travelled;
      pose.turn_i = turned_by(pose.turn_i, pose.turned_i),
      pose.turn_j = turned_by(pose.turn_j, pose.turned_j);
      const Triple<double> arms =
          scale(geometry.lever, pose.turned_i) + scale(1 - geometry.lever, pose.turned_j);
      pose.moved = pose.travelled + cross(pose.distance - scale(0.5, pose.travelled), arms);
      pose.spun_along = 0.5 * dot(pose.turned_i + pose.turned_j, pose.distance);
      now = act(law, state, geometry, pose);
      work += 0.5 * (dot(before.force + now.force, pose.travelled) -
                     dot(before.torque_i + now.torque_i, pose.turned_i) -
                     dot(before.torque_j + now.torque_j, pose.turned_j));
      end_step();
    }
  }
  // As one, about the centre of the first.
  void turn_rigidly(const Vector3 &angle, int steps) {
    const CohesiveMotion<double> start = pose;
    pose.turned_i = pose.turned_j = triple(angle / steps), pose.moved = {0, 0, 0};
    for (int k = 1; k <= steps; ++k) { // from the start each time, so that round-off does not add up
      const Triple<double> so_far = triple(angle * k / steps), before = pose.distance;
      pose.distance = turned(turned_by({1, 0, 0, 0}, so_far), start.distance);
      pose.travelled = pose.distance - before;
      pose.turn_i = turned_by(start.turn_i, so_far), pose.turn_j = turned_by(start.turn_j, so_far);
      pose.spun_along = dot(pose.turned_i, pose.distance);
      now = act(law, state, geometry, pose);
    }
  }
  // As if it had come to where it is by these (m, m, rad m); returns the work of that, J.
  double impose(const Triple<double> &travelled, const Triple<double> &moved, double spun = 0) {
    const Triple<double> before = now.force;
    now = law(state, geometry, {pose.distance, travelled, moved, spun});
    return 0.5 * dot(before + now.force, moved);
  }
  static Rotation<double> turned_by(const Rotation<double> &q, const Triple<double> &angle) {
    return rotation(rotation_quaternion(vector(angle)) * Quaternion{q.w, q.x, q.y, q.z});
  }
  double normal() const { return now.normal / geometry.area; } // Pa
  double shear() const { return norm(vector(now.shear)) / geometry.area; }
  double plastic() const { return law.plastic_work(state, geometry); } // J
  double balance() const { return now.energy + plastic() + state.dissipated; }
  double whole_work() const { return work + kinks_work; }

protected:
  virtual void begin_step() {}
  virtual void end_step() {}
};

} // namespace platen::dem::examples
