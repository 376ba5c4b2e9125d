// The workload of the step benchmarks: equal spheres of 1 mm, close packed, bonded with normal, shear,
// bending and twisting, pressed elastically between two rigid platens.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "apps/output/machine.h"
#include "coupling/platen_test.h"
#include "dem/packing/specimen.h"
#include "limit/idealised_loop.h"

namespace platen::bench {

// About `particles` spheres: a cylinder twice as high as wide; above 50 000, a box twice as high as wide
// of tiles of 20 000 spheres without seams.
dem::Specimen close_packed(int particles);

// About so many spheres of a periodic packing repeated as it is, in seconds: without seams inside, and with
// ends and sides that are not brought to rest. For what costs and sizes alone are asked of.
dem::Specimen repeated(int particles);

// Failure checks, energy balance, local damping and contacts on; strengths that nothing reaches.
enum class Law { parallel_bond, cohesive_beam, elasto_damage_plastic, yielding_parallel_bond, facet };
extern const std::map<std::string, Law> laws; // by the words of Effects/Bond, with dashes
coupling::PlatenTestSettings elastic_press(Law law = Law::parallel_bond);

// The bonds of a problem for the idealised loop.
Network network_of(const dem::Model &model);

void run(coupling::PlatenTest &problem, long steps);

struct Spread {
  double median = 0, smallest = 0, largest = 0;
};
inline Spread spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values[values.size() / 2], values.front(), values.back()};
}

} // namespace platen::bench
