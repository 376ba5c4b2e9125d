// Pieces connected by intact bonds: all of them, and pieces of intact spheres that still stand on the
// platens.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "dem/bonds.h"
#include "dem/packing/specimen.h"
#include "dem/particles.h"

namespace platen::dem {

// Disjoint sets of the members 0 ... n - 1, each at first a set of its own. The name of a set is its smallest
// member, so that names do not depend on the order in which pairs are joined.
class DisjointSets {
public:
  explicit DisjointSets(std::size_t n);
  int name(int member);
  void join(int one, int other);
  // Members of each set, ascending; sets by their names. With `counted`, only the counted members: counted
  // and other members must not have been joined.
  std::vector<std::vector<int>> all(const std::vector<char> &counted = {});

private:
  std::vector<int> parent_;
};

struct Fragments {
  std::vector<int> of_particle; // fragment number of each row; 0 is the largest by mass, then descending
  std::vector<int> particles;   // count in each fragment
  std::vector<double> mass;     // kg
  int count = 0;                // pieces of at least two particles
  int single = 0;               // pieces of one particle
};
Fragments find_fragments(const Particles &particles, const Bonds *bonds);

enum End { bottom_end = 0, top_end = 1 };

// A sphere is intact if it had bonds and at least this `fraction` of them is intact. It stands on a platen if
// its reference surface is within `reach` mean radii of the end plane.
struct IntactRules {
  double fraction = 0.7; // 1
  double reach = 0.5;    // mean radii
};

// A piece of intact spheres connected by intact bonds.
struct IntactPiece {
  double volume_fraction = 0;                    // of the volume of all spheres that ever had a bond
  std::array<bool, 2> stands_on{{false, false}}; // the platen of an End
  bool spans() const { return stands_on[bottom_end] && stands_on[top_end]; }
};
std::vector<IntactPiece> find_intact_pieces(const Particles &particles, const Bonds &bonds,
                                            const Shape &shape, const IntactRules &intact_rules = {});

} // namespace platen::dem
