// Which pairs of a packing are bonded, where it is more than a question of their distance: pairs that
// somebody names, a notch, and flaws that a specimen has before it is loaded.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/vector3.h"
#include "dem/cell_grid.h"
#include "dem/laws/bond_layout.h"

namespace platen::dem {

struct Notch;
struct Particles;

// A bond between two spheres, by their ids.
struct GivenBond {
  int first = 0, second = 0;
  double strength_factor = 1; // on both strengths, > 0
};

// A crack or a weak plane: it concerns the bonds whose line between centres passes through it.
struct Flaw {
  enum class Form { plane, disc, rectangle };
  Form form = Form::plane;
  Vector3 centre;          // m
  Vector3 normal{0, 0, 1}; // unit
  double radius = 0;       // m, of a disc
  double width = 0;        // m, of a rectangle along the horizontal in its plane, along x where it lies flat
  double breadth = 0;      // m, of a rectangle across its width
  double strength_factor = 0; // on both strengths; 0: the bonds are cut, there are none

  bool crosses(const Vector3 &a, const Vector3 &b) const;
};

struct BondChoice {
  std::optional<std::vector<GivenBond>>
      given; // exactly these, whatever their distance; none: all within reach
  std::vector<Flaw> flaws;
};

struct BondedPairs {
  std::vector<IndexPair> pairs;        // rows of particles, sorted by (first, second)
  std::vector<double> strength_factor; // of each, above 0
  std::vector<std::size_t> in_flaw;    // of each flaw: bonds that it cuts or weakens
};

// Pairs within the layout's range, sorted by (first, second).
std::vector<IndexPair> pairs_in_range(const Vector3 *position, const double *radius, std::size_t n,
                                      const BondLayout &layout);
// Throws std::invalid_argument where a given bond names no two spheres, or two name the same.
BondedPairs bonded_pairs(const Particles &particles, const BondLayout &layout, const Notch &notch,
                         const BondChoice &choice);

} // namespace platen::dem
