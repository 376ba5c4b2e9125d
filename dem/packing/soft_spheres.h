// Soft frictionless spheres between frictionless walls, or in a box without walls that repeats itself,
// brought to rest: the working part of the growth packings.
#pragma once

#include <cstddef>
#include <vector>

#include "base/random.h"
#include "base/vector3.h"
#include "dem/kernels/soft_kernel.h"
#include "dem/packing/soft_partners.h"
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
// processor: forces are added in the order of the spheres, and so are the two sums that a place depends on.
class SoftSpheres {
public:
  SoftSpheres(Room room, const std::vector<Vector3> &centre, std::vector<double> factor);

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
  // In order of space, not of the constructor. Of a repeating room: within the box.
  std::vector<Vector3> centres() const;
  const std::vector<double> &factor() const { return factor_; }

private:
  // Of one block of rows, in the order of lanes: good for what allows for their round-off.
  struct BlockSums {
    kernels::SoftContacts contacts;
    kernels::SoftPower power;
    double fastest = 0;
    double room = -1; // how far its spheres may still go before each is looked at
  };

  std::size_t size() const { return factor_.size(); }
  Vector3 place(std::size_t i) const { return {ball_[i].x, ball_[i].y, ball_[i].z}; }
  void sort_in_space(std::vector<Vector3> &centre);
  void make_images();
  void move_images();
  void choose_reach();
  void find_partners();
  bool partners_are_stale();
  double room_of(std::size_t first, std::size_t last) const;
  void compute_forces(double next_step);
  void compute_squares(double next_step);
  void sum_squares();
  bool at_rest(double tolerance, double floor);
  bool goes_downhill() const;
  void step_back(double step);
  void drift(double step, double mixing);
  Overlaps exact_overlaps() const;
  template <class Touch>
  Vector3 wall_force(std::size_t i, const Touch &touch) const;
  kernels::SoftColumns columns();

  Room room_;
  double scale_ = 1, largest_factor_ = 1;
  std::vector<double> factor_;
  // Spheres, filled up to whole packs; one that touches none; images. Other columns have the first and a
  // spare row, so that vectors can be read as four doubles.
  std::vector<kernels::Ball> ball_;
  std::size_t rows_ = 0; // whole packs
  std::vector<int> owner_;
  std::vector<Vector3> shift_; // of images
  std::vector<Vector3> press_, force_, velocity_, centre_at_build_;
  std::vector<double> force_square_, speed_square_;
  SoftPartners partners_;
  std::vector<int> near_wall_;
  std::vector<double> reach_; // how far each sphere may go until partners are looked for again
  double scale_at_build_ = 0;
  long since_build_ = 0;
  std::vector<BlockSums> sums_;
  double residual_ = 0, push_ = 0, speed_ = 0; // of the last forces: squares summed in order
};

} // namespace platen::dem
