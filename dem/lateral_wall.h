// A stiff frictionless wall around the specimen, with the initial shape of the specimen: it keeps the lateral
// strain at zero (oedometer, uniaxial strain compaction) and reports the pressure that this needs.
#pragma once

#include <vector>

#include "base/archive.h"
#include "dem/packing/specimen.h"
#include "dem/particles.h"
#include "dem/stable_step.h"

namespace platen::dem {

class LateralWall {
public:
  // Spring of `stiffness` (N/m) for each sphere that reaches the wall. If the sphere's surface is within
  // `layer` (m), the spring begins at the initial gap, as if the specimen had been cast against the wall.
  LateralWall(const Particles &particles, const Shape &shape, double stiffness, double layer);

  // To call once a step, after the drift; no particle has moved by more than `distance` (m).
  void add_forces(Particles &particles, double distance);
  void make_list(const Particles &particles); // of spheres near the wall; always rebuilt
  void describe(Archive &archive);

  double force() const { return force_; }                   // N, sum of the normal forces of the last step
  double elastic_energy() const { return elastic_energy_; } // J, of the last step
  std::size_t seats() const;
  // Whether add_forces() will rebuild the list; listed rows, ascending; number of rebuilds.
  bool lists_anew(double distance) const { return !valid_ || moved_ + distance > skin_; }
  std::vector<int> particles() const;
  long lists_made() const { return lists_made_; }
  std::size_t near() const { return rows_.size(); }
  double pressure(double height) const { return force_ / (perimeter_ * height); } // Pa; height in m
  std::vector<GroundSpring> ground_springs(const Particles &particles) const;

private:
  struct Row {
    int particle = 0, side = 0;
    double rest = 0; // m, gap at which the spring begins
  };
  struct Gap {
    double gap = 0; // m, from the sphere's surface to the wall
    Vector3 inward;
  };
  Gap gap(const Vector3 &position, double radius, int side) const;
  int sides() const { return shape_.kind == ShapeKind::cylinder ? 1 : 4; }

  Shape shape_;
  double stiffness_, layer_, skin_ = 0, perimeter_ = 0;
  double moved_ = 0, force_ = 0, elastic_energy_ = 0;
  bool valid_ = false;
  std::vector<Row> rows_; // ascending
  long lists_made_ = 0;
};

} // namespace platen::dem
