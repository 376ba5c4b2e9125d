#include "dem/packing/decompression.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace platen::dem {
namespace {

constexpr double overfill = 0.03;      // of volume
constexpr double final_overlap = 5e-5; // mean, in mean radii: contacts are known, positions are not strained
constexpr double overlap_step = 0.4;   // each stage targets this fraction of the last mean overlap
constexpr double seating_force = 0.1; // on loose spheres, in mean contact forces: too weak to move the others
constexpr double first_back = 2e-4; // relative growth after shrinking too far; doubled while it does not help
constexpr double flattest = 0.5, steepest = 4.0; // bounds of the slope of mean overlap over relative size
constexpr int most_stages = 200;
constexpr long most_iterations = 200000; // of one stage

// Shrinks an over-full system at rest until its mean overlap is final_overlap, then seats the loose spheres.
// Returns the number of stages and adds to the iterations.
int shrink(SoftSpheres &spheres, double at_rest, Random &random, GrowthReport &made) {
  double slope = 1.8; // mean overlap lost per relative loss of size; measured as soon as two stages are known
  double last_scale = 0, last_overlap = 0;
  double target = 0, back = first_back;
  for (int stage = 1; stage <= most_stages; ++stage) {
    const bool last = target > 0 && target <= final_overlap;
    made.iterations += spheres.relax(at_rest, 1e-3 * final_overlap, most_iterations);
    const Overlaps state = spheres.overlaps();
    const double scale = spheres.scale(), overlap = state.mean / scale;
    if (overlap < 0.05 * final_overlap) { // shrunk too far: nothing is compressed any more
      spheres.set_scale(scale * (1 + back));
      back *= 2, target = 0, last_overlap = 0;
      slope = std::min(1.25 * slope, steepest);
      continue;
    }
    back = first_back;
    if (last && overlap <= 1.5 * final_overlap) {
      made.loose_spheres = spheres.seat_loose_spheres(seating_force * overlap, random);
      made.iterations += spheres.relax(at_rest, 0, most_iterations);
      return stage;
    }
    if (last_overlap > 1.5 * overlap && last_scale > scale)
      slope = std::clamp((last_overlap - overlap) / (1 - scale / last_scale), flattest, steepest);
    target = std::max(overlap_step * overlap, final_overlap);
    if (overlap <= 1.5 * final_overlap) target = final_overlap;
    last_scale = scale, last_overlap = overlap;
    spheres.set_scale(scale * (1 - std::max(0.0, overlap - target) / slope));
  }
  throw std::runtime_error("the sphere packing did not jam");
}

} // namespace

double overfull_scale() {
  return std::cbrt(1 + overfill / bulk_fraction);
}

double mean_cube(double spread) {
  return 1 + 0.25 * spread * spread;
}

std::vector<double> radius_factors(std::size_t n, double spread, Random &random) {
  std::vector<double> factor(n);
  for (std::size_t i = 0; i < n; ++i)
    factor[i] = 1 + spread * ((static_cast<double>(i) + 0.5) / static_cast<double>(n) - 0.5);
  random.shuffle(factor);
  return factor;
}

void decompress(SoftSpheres &spheres, Random &random, GrowthReport &made, double at_rest) {
  made.stages = shrink(spheres, at_rest, random, made);
  const Overlaps state = spheres.overlaps();
  const double count = static_cast<double>(spheres.factor().size());
  made.contacts_per_sphere = 2.0 * static_cast<double>(state.pairs) / count;
  made.mean_overlap = state.mean / spheres.scale(), made.max_overlap = state.max / spheres.scale();
  made.residual_force = state.mean > 0 ? state.residual_force / state.mean : 0;
}

} // namespace platen::dem
