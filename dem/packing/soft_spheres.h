// Soft frictionless spheres between frictionless walls, brought to rest: the working part of the growth
// packing.
#pragma once

#include <cstddef>
#include <vector>

#include "base/random.h"
#include "base/vector3.h"
#include "dem/packing/specimen.h"

namespace platen::dem {

// Overlaps of pairs and of spheres with walls, in the length unit of the system.
struct Overlaps {
  std::size_t contacts = 0;  // pairs and walls
  std::size_t pairs = 0;     // pairs alone
  double mean = 0, max = 0;  // over contacts
  double residual_force = 0; // root mean square of the net force on a sphere, same unit (stiffness 1)
};

// Spheres of radius scale * factor[i] that repel with unit stiffness where they overlap (energy overlap^2 / 2
// per contact). Any length unit; the mean radius should be about 1, which the search skin and the steps
// assume.
class SoftSpheres {
public:
  SoftSpheres(const Shape &shape, std::vector<Vector3> centre, std::vector<double> factor);

  void set_scale(double scale);
  double scale() const { return scale_; }
  // Moves the spheres to a minimum of the energy by FIRE (Bitzek et al. 2006, PRL 97:170201; the step back on
  // uphill motion after Guenole et al. 2020). Stops when the residual force is below tolerance times the mean
  // overlap, or below floor (nothing left to push), or after max_iterations. Returns the iterations used.
  long relax(double tolerance, double floor, long max_iterations);
  Overlaps overlaps();
  // Pushes every sphere that is not held (fewer than four contacts with spheres or walls) with the given
  // force in a direction of its own, from now on, so that relax() seats it on its neighbours: no sphere
  // floats. Returns how many there are.
  std::size_t press_loose_spheres(double force, Random &random);
  const std::vector<Vector3> &centre() const { return centre_; }
  const std::vector<double> &factor() const { return factor_; }

private:
  void sort_in_space();
  void build_pairs();
  bool pairs_are_stale() const;
  void compute_forces();
  double squeeze(double x, double r, double half);
  void add_wall_forces();
  void touch(double overlap);

  Shape shape_;
  double scale_ = 1, largest_factor_ = 1;
  std::vector<Vector3> centre_, press_, force_, velocity_, centre_at_build_;
  std::vector<double> factor_, radius_;
  double scale_at_build_ = 0;
  std::vector<int> first_,
      partner_;  // partners of sphere i, numbers above i: partner_[first_[i] .. first_[i + 1])
  Overlaps now_; // of the last compute_forces()
};

} // namespace platen::dem
