// The cells of an elastic solid whose material yields (j2_plasticity.h), at small strain. Each Gauss point
// remembers its plastic strain p, a deviator, which starts the stress anew: with the stiffness K of the solid
//   internal forces    K u - sum_q w_q 2 mu B_q^T p_q
//   stored energy      u K u/2 - sum_q w_q 2 mu e_q:p_q + sum_q w_q mu p_q:p_q
//   energy lost        sum_q w_q (integral of the flow stress to the equivalent plastic strain of the point)
// The points are those that K is integrated with, so that forces are the derivative of the stored energy and
// the stress at each point is on the yield surface or within. Forces of all other nodes are zero.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/archive.h"
#include "fem/elastic_model.h"
#include "fem/hyperelastic_cell.h"

namespace platen::fem {

class YieldingCells {
public:
  explicit YieldingCells(const ElasticModel &model);

  // A step to this displacement of the nodes (m, frame's axes) from where the cells were at the last call.
  void yield(const std::vector<Vector3> &displacement);
  // Those of the plastic strain, which the elastic forces K u lose: sum_q w_q 2 mu B_q^T p_q; N.
  const std::vector<Vector3> &forces() const { return forces_; }
  double energy_of_plastic_strain() const; // J, sum_q w_q mu p_q:p_q
  double plastic_work() const;             // J
  // Means of each cell of the solid: the equivalent plastic strain, and 2 mu p (Pa).
  std::vector<double> strains() const;
  std::vector<Stress> stresses() const;

  void describe(Archive &archive);

private:
  struct EightPoints {                // without weight where the points of a cell are no multiple of eight
    std::array<AtPoints, 6> strain{}; // p: xx, yy, zz, yz, zx, xy
    AtPoints equivalent{};            // 1
    AtPoints weight{};                // m^3
  };
  void find_forces();
  const J2Plasticity &law_of(std::size_t cell) const { return laws_[material_[cell]]; }
  template <class Value>
  double sum_over_points(const Value &value) const;
  template <class Value>
  double mean(std::size_t cell, const Value &value) const;

  std::size_t per_cell_, eights_per_cell_; // nodes, of which a cell has as many as points; eights of points
  std::size_t cells_of_solid_;
  std::vector<J2Plasticity> laws_;            // of each material; those of elastic ones are not used
  std::vector<std::size_t> cells_, material_; // those that yield, by their numbers in the solid
  std::vector<int> cell_nodes_;
  std::vector<double> gradient_; // 1/m: eight points, node, component, point
  std::vector<EightPoints> points_;
  std::vector<Vector3> cell_force_, forces_; // N
  std::vector<std::size_t> first_, entry_;   // of each node in entry_, and the end; rows of cell_force_
};

} // namespace platen::fem
