// The frictionless walls of a container of soft spheres (dem/packing/soft_spheres.h). Lengths in mean radii.
#pragma once

#include <cstddef>
#include <vector>

#include "base/vector3.h"
#include "dem/kernels/soft_kernel.h"
#include "dem/packing/specimen.h"

namespace platen::dem {

// Overlaps with walls: unit stiffness.
struct WallSums {
  double overlap = 0, contacts = 0, largest = 0;
};

// Spheres near walls, flat and round walls separately. As for pairs, the lists contain the state when they
// were made; the displacement since then is added (dem/kernels/soft_kernel.h).
class SoftWalls {
public:
  // Empties the lists. For cylinders and boxes.
  void clear(const Shape &shape);
  // Rows ascending; lists the walls that this sphere may touch after a displacement of `reach`.
  void add(int row, const Vector3 &centre, double radius, double reach);
  // Adds to `force` of rows [first, last), with their `displacement` since the lists were made.
  WallSums add_forces(std::size_t first, std::size_t last, const kernels::SoftRow *displacement,
                      kernels::SoftRow *force) const;
  // Calls visit(row) for every row of [first, last) on the lists, once or more.
  template <class Visit>
  void for_each_row(std::size_t first, std::size_t last, const Visit &visit) const {
    const auto rows_of = [&](const auto &walls) {
      for (const auto *w = begin(walls, first), *end = begin(walls, last); w != end; ++w)
        visit(static_cast<std::size_t>(w->row));
    };
    rows_of(flat_), rows_of(round_), rows_of(wide_);
  }

private:
  struct Plane {
    int row;
    float x, y, z; // inwards
    double gap;
  };
  struct Round {
    int row;
    float x, y, inner; // where the surface of the sphere meets the wall's
    float outside;     // square of the distance from the axis less that of `inner`
  };
  template <class Wall>
  static const Wall *begin(const std::vector<Wall> &walls, std::size_t row);
  void add_flat(std::size_t first, std::size_t last, const kernels::SoftRow *displacement,
                kernels::SoftRow *force, WallSums &sums) const;
  void add_round(std::size_t first, std::size_t last, const kernels::SoftRow *displacement,
                 kernels::SoftRow *force, WallSums &sums) const;

  Shape shape_;
  std::vector<Plane> flat_;
  std::vector<Round> round_;
  std::vector<Round> wide_; // of spheres wider than the container, pressed from both sides
};

} // namespace platen::dem
