// Soft frictionless spheres between frictionless walls, or in a box without walls that repeats itself,
// brought to rest: the working part of the growth packings.
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

// Where soft spheres are.
struct Room {
  Shape shape;          // a cylinder or box with walls; of a repeating room a box
  bool repeats = false; // in x, y and z: what leaves at one face comes in at the opposite one
};

// Spheres of radius scale * factor[i] that repel with unit stiffness where they overlap (energy overlap^2 / 2
// per contact). Any length unit; the mean radius should be about 1, which the search skin and the steps
// assume. Loops use the threads of all loops; places repeat to the last bit for any number of them and on any
// processor.
class SoftSpheres {
public:
  SoftSpheres(Room room, std::vector<Vector3> centre, std::vector<double> factor);

  void set_scale(double scale);
  double scale() const { return scale_; }
  // Moves the spheres to a minimum of the energy by FIRE (Bitzek et al. 2006, PRL 97:170201; the step back on
  // uphill motion after Guenole et al. 2020). Stops when the residual force is below tolerance times the mean
  // overlap, or below floor (nothing left to push), or after max_iterations. Returns the iterations used.
  long relax(double tolerance, double floor, long max_iterations);
  Overlaps overlaps();
  // Takes every sphere that is not held (fewer than four contacts with spheres or walls) to neighbours, in a
  // direction of its own and while all others stand still, and pushes it there with the given force from now
  // on: after relax() no sphere floats. Returns how many there are.
  std::size_t seat_loose_spheres(double force, Random &random);
  // In order of space, not of the constructor. Of a repeating room: within the box.
  std::vector<Vector3> centres() const;
  const std::vector<double> &factor() const { return factor_; }

private:
  // Spheres that others meet and that do not move themselves.
  struct Obstacle {
    Vector3 centre;
    double factor;
  };
  struct BlockSums {
    kernels::SoftSums of_kernel;
    WallSums of_walls;
    double fastest = 0;
    double room = 0; // how far its spheres may still go before each is looked at
  };

  SoftSpheres(Room room, std::vector<Vector3> centre, std::vector<double> factor,
              std::vector<Obstacle> obstacles);
  std::size_t size() const { return factor_.size(); }
  Vector3 way(std::size_t i) const { return {way_[i].x, way_[i].y, way_[i].z}; }
  Vector3 place(std::size_t i) const { return centre_[i] + way(i); }
  void choose_reach();
  void find_partners();
  void make_balls();
  void find_walls();
  bool partners_are_stale();
  double room_of(std::size_t first, std::size_t last) const;
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

  Room room_;
  double scale_ = 1, largest_factor_ = 1;
  std::vector<double> factor_;
  std::vector<Obstacle> obstacles_;
  std::vector<Vector3> centre_; // when the lists were made
  std::vector<Vector3> press_;  // a constant force on each, or empty
  // Spheres, filled up to whole groups; of ways also obstacles, which have none. Outside: walls and press.
  AlignedVector<kernels::SoftRow> way_, velocity_, force_, outside_;
  std::size_t rows_ = 0; // whole groups
  std::vector<SoftPartners> partners_;
  std::vector<SoftBall> balls_; // of the last search; kept for their memory
  SoftWalls walls_;
  std::vector<double> reach_; // how far each sphere may go until partners are looked for again
  bool lists_are_good_ = false;
  long since_build_ = 0;
  std::vector<BlockSums> sums_;
  kernels::SoftSums total_; // of the last forces
  double mean_overlap_ = 0, residual_ = 0;
};

} // namespace platen::dem
