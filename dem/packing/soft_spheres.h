// Soft frictionless spheres between frictionless walls, or in a periodic box without walls, brought to rest:
// the main part of the growth packings.
#pragma once

#include <cstddef>
#include <vector>

#include "base/aligned_vector.h"
#include "base/random.h"
#include "base/vector3.h"
#include "dem/kernels/soft_kernel.h"
#include "dem/packing/soft_partners.h"
#include "dem/packing/soft_walls.h"
#include "dem/packing/specimen.h"

namespace platen::dem {

// Overlaps of pairs and of spheres with walls, in the length unit of the system.
struct Overlaps {
  std::size_t contacts = 0;  // pairs and walls
  std::size_t pairs = 0;     // pairs alone
  double mean = 0, max = 0;  // over contacts
  double residual_force = 0; // root mean square of the net force on a sphere, same unit (stiffness 1)
};

// The container of soft spheres.
struct Container {
  Shape shape;          // a cylinder or box with walls; a box if periodic
  bool repeats = false; // periodic in x, y and z
};

// Spheres of radius scale * factor[i] that repel with unit stiffness where they overlap (energy overlap^2 / 2
// per contact). Any length unit; the mean radius should be about 1, as the search skin and the steps assume.
// Loops use the threads of all loops; positions are the same to the last bit for any number of threads and on
// any processor.
class SoftSpheres {
public:
  SoftSpheres(Container container, std::vector<Vector3> centre, std::vector<double> factor);

  void set_scale(double scale);
  double scale() const { return scale_; }
  // Moves the spheres to a minimum of the energy by FIRE (Bitzek et al. 2006, PRL 97:170201; the step back on
  // uphill motion after Guenole et al. 2020). Stops when the residual force is below tolerance times the mean
  // overlap, or below floor (nothing left to push), or after max_iterations. Returns the iterations used.
  long relax(double tolerance, double floor, long max_iterations);
  Overlaps overlaps();
  // Moves every unsupported sphere (fewer than four contacts with spheres or walls) to neighbours, each in a
  // direction of its own and with all others fixed, and presses it there with the given force from now on:
  // after relax() no sphere floats. Returns the number of these spheres.
  std::size_t seat_loose_spheres(double force, Random &random);
  // In spatial order, not that of the constructor. For a periodic container: within the box.
  std::vector<Vector3> centres() const;
  const std::vector<double> &factor() const { return factor_; }

private:
  // Spheres that others touch and that do not move themselves.
  struct Obstacle {
    Vector3 centre;
    double factor;
  };
  struct BlockSums {
    kernels::SoftSums of_kernel;
    WallSums of_walls;
    double fastest = 0;
    double clearance = 0; // displacement left to its spheres until each is checked
  };

  SoftSpheres(Container container, std::vector<Vector3> centre, std::vector<double> factor,
              std::vector<Obstacle> obstacles);
  std::size_t size() const { return factor_.size(); }
  Vector3 displacement(std::size_t i) const {
    return {displacement_[i].x, displacement_[i].y, displacement_[i].z};
  }
  Vector3 place(std::size_t i) const { return centre_[i] + displacement(i); }
  void choose_reach();
  void find_partners();
  void make_balls();
  void find_walls();
  bool partners_are_stale();
  double clearance_of(std::size_t first, std::size_t last) const;
  void compute_forces(double next_step);
  void add_up();
  bool at_rest(double tolerance, double floor) const;
  void step_back(double step);
  void drift(double step, double mixing);
  std::vector<std::size_t> loose_spheres() const;
  std::vector<std::size_t> push_loose_spheres(double force, Random &random);
  bool touches_wall(std::size_t i) const;
  template <class Visit>
  void for_each_touch(const Visit &visit) const;
  kernels::SoftColumns columns();

  Container container_;
  double scale_ = 1, largest_factor_ = 1;
  std::vector<double> factor_;
  std::vector<Obstacle> obstacles_;
  std::vector<Vector3> centre_; // positions when the lists were made
  std::vector<Vector3> press_;  // a constant force on each, or empty
  // Spheres in whole groups; in displacement_ also obstacles, without displacement. outside_: walls and
  // press_.
  AlignedVector<kernels::SoftRow> displacement_, velocity_, force_, outside_;
  std::size_t rows_ = 0; // whole groups
  std::vector<SoftPartners> partners_;
  std::vector<SoftBall> balls_; // of the last search; kept to reuse their memory
  SoftWalls walls_;
  std::vector<double> reach_; // largest displacement of each sphere until the next search for partners
  bool lists_are_good_ = false;
  long since_build_ = 0;
  std::vector<BlockSums> sums_;
  kernels::SoftSums total_; // of the last forces
  double mean_overlap_ = 0, residual_ = 0;
};

} // namespace platen::dem
