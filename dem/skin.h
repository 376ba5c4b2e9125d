// The lateral surface of a body of spheres, divided among the spheres that form it.
//
// Each sphere gets a ball of twice its radius, so that neighbouring balls overlap and leave no pore between
// touching grains. The power diagram cuts each ball to a cell. The rest of the ball's own surface
// (approximated by a solid of 32 faces) is its part of the skin, and the sum of the outward area vectors of
// these faces is the sphere's area. A cell is closed, so areas depend on where the ball's surface is cut and
// not on its shape in between. The planes of the platens bound the skin; pores and narrow cracks have no
// skin.
#pragma once

#include <cstddef>
#include <vector>

#include "base/vector3.h"
#include "dem/particles.h"

namespace platen::dem {

// The platens' faces, which bound the body.
struct EndPlanes {
  double low = 0, high = 0; // m, z
};

// Cubes between two planes of z whose centre is in no ball and that are connected, face to face, to the space
// around the body. Pores inside the body and gaps narrower than a cube are not included.
class Outside {
public:
  // Balls by centre and radius (m); cubes of the given edge (m).
  Outside(const std::vector<Vector3> &centres, const std::vector<double> &radii, const EndPlanes &planes,
          double edge);
  // Whether the centre of an outside cube lies within `reach` (m) of a point.
  bool within(const Vector3 &point, double reach) const;

private:
  enum class Cube : unsigned char { pore, solid, outside };
  template <class Visit>
  void visit_near(const Vector3 &point, double reach, const Visit &visit) const;
  void flood();
  std::size_t index(const int (&at)[3]) const {
    return (static_cast<std::size_t>(at[2]) * n_[1] + at[1]) * n_[0] + at[0];
  }

  double edge_ = 0; // m
  Vector3 low_;
  int n_[3] = {0, 0, 0};
  std::vector<Cube> cubes_;
};

struct Skin {
  std::vector<int> particle; // rows, ascending
  std::vector<Vector3> area; // m^2, outward
};

// Skin of the spheres marked in `body` (one mark per row).
Skin find_skin(const Particles &particles, const std::vector<char> &body, const EndPlanes &planes);

// Corrects each area vector by |a| (b + w x (x - c)), the smallest change relative to its size, so that a
// uniform pressure has no resultant force or moment: sum a = 0 and sum x x a = 0. Returns |sum a| before,
// over the sum of |a|. Does not change a skin of fewer than three spheres.
double balance(Skin &skin, const Particles &particles);

} // namespace platen::dem
