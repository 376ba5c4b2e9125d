// What the benchmarks share: options, and the workload: equal spheres of 1 mm, close packed, bonded with
// normal, shear, bending and twisting, pressed elastically between two rigid platens.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "arguments.h"
#include "base/clock.h"
#include "coupling/platen_test.h"
#include "dem/packing/specimen.h"

namespace platen::bench {

struct Workload {
  int particles = 22500, steps = 100, repeats = 5;
  std::string read; // a packing, in place of `particles` spheres
  std::string law = "parallel-bond";

  // These members, the law where `of_law`, and further ones.
  std::vector<Argument> arguments(bool of_law, const std::vector<Argument> &further = {});
  // A cylinder twice as high as wide; above 50 000 spheres a box twice as high as wide, of tiles of 20 000.
  dem::Specimen specimen() const;
  // Failure checks, energy balance, local damping and contacts on; strengths that nothing reaches.
  coupling::PlatenTestSettings press() const;
};

void run(coupling::PlatenTest &problem, long steps);

template <class Work>
double seconds_of(const Work &work) {
  const auto start = Clock::now();
  work();
  return seconds_since(start);
}

struct Spread {
  double median = 0, smallest = 0, largest = 0;
};
inline Spread spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values[values.size() / 2], values.front(), values.back()};
}

} // namespace platen::bench
