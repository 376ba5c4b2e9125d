// The space around a body of spheres, as small cubes: what a membrane or a fluid reaches from the side.
#pragma once

#include <cstddef>
#include <vector>

#include "base/vector3.h"

namespace platen::dem {

// The platens' faces: the body is looked at between them.
struct EndPlanes {
  double low = 0, high = 0; // m, z
};

// Cubes between two planes of z that no ball holds and that are joined, face to face, to the space beside the
// body. Pores inside the body are not among them, nor gaps narrower than a cube.
class Outside {
public:
  // Balls by centre and radius (m); cubes of the given edge (m).
  Outside(const std::vector<Vector3> &centres, const std::vector<double> &radii, const EndPlanes &planes,
          double edge);
  // Whether the centre of a cube of the outside lies within `reach` (m) of a point.
  bool within(const Vector3 &point, double reach) const;

private:
  enum class Cube : unsigned char { pore, held, outside };
  template <class Visit>
  void visit_near(const Vector3 &point, double reach, const Visit &visit) const;
  void flood();
  std::size_t index(const int (&at)[3]) const {
    return static_cast<std::size_t>(at[0]) +
           static_cast<std::size_t>(n_[0]) *
               (static_cast<std::size_t>(at[1]) +
                static_cast<std::size_t>(n_[1]) * static_cast<std::size_t>(at[2]));
  }

  double edge_ = 0; // m
  Vector3 low_;
  int n_[3] = {0, 0, 0};
  std::vector<Cube> cubes_;
};

} // namespace platen::dem
