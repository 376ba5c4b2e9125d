// Failure pattern of a specimen compressed along its axis, in one word, and the measure that decided it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "dem/measure/cracks.h"
#include "dem/measure/damage.h"
#include "dem/measure/dead_zone.h"

namespace platen::dem {

// Measures from which the pattern is decided.
struct FailureMeasures {
  DamageByRegion damage{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::quiet_NaN()};
  std::array<DeadZone, 2> dead;                              // [bottom_end], [top_end]: cones by displacement
  double opening = std::numeric_limits<double>::quiet_NaN(); // m, of the skin since the peak, U (dead_zone.h)
  CrackPlanes planes;                                        // as fractions of all losses
  double end_spread = std::numeric_limits<double>::quiet_NaN(); // of the skin (damage.h)
  double columns = 0; // intact pieces from platen to platen, each at least a twentieth of the volume
  double broken_fraction = std::numeric_limits<double>::quiet_NaN(); // mean loss of all bonds
  double width = 0, height = 0; // m, of the specimen; width of a circle with the area of its section
  void describe(Archive &archive);
};
// The specimen at its positions before the test.
Specimen specimen_before(const Particles &particles, const Shape &shape);
// Without a motion there are no cones by displacement. Ends, middle and the surroundings of cones are judged
// by losses (damage.h; empty: of these bonds), planes and pieces by broken bonds.
FailureMeasures measure_failure(const Particles &particles, const Bonds &bonds, const Shape &shape,
                                const IntactRules &intact_rules = {}, const MotionAfterPeak &motion = {},
                                std::vector<double> losses = {});

enum class FailurePattern : std::int64_t { none, cones, shear_plane, splitting, crushing, undecided };
inline constexpr std::array<const char *, 6> pattern_words{"none",      "cones",    "shear plane",
                                                           "splitting", "crushing", "undecided"};
inline const char *word_of(FailurePattern pattern) {
  return pattern_words[static_cast<std::size_t>(pattern)];
}
enum class DecidedBy : std::int64_t {
  nothing,      // no rule below holds
  one_plane,    // half of all lost bonds lie in one plane that crosses the specimen
  two_cones,    // the parts that move with the platens are cones, one of them perhaps without its tip
  columns,      // two pieces or more from platen to platen
  steep_planes, // half of all lost bonds lie in planes along the axis
  few_broken,   // 2 % of the bonds at most are lost
  crushed_end   // the worse end has lost more than 0.4 of its bonds, and friction did not restrain the ends
};
struct FailureVerdict {
  FailurePattern pattern = FailurePattern::undecided;
  DecidedBy by = DecidedBy::nothing;
};

// The first rule that holds, in the order of DecidedBy from `one_plane` on: planes come first, because an
// inclined one leaves on each platen a part that moves with it. The plane of `one_plane` splits if it lies
// within 15 degrees of the axis and shears up to 65 degrees. The limit of damage for a crushed end (0.4) lies
// between the damage by dry and by lubricated platens in cylinders twice as high as wide. The ends of cubes
// are damaged by any platen: if they spread by less than a quarter of the middle, friction has restrained
// them and they are not called crushed.
FailureVerdict judge_failure(const FailureMeasures &measures);

} // namespace platen::dem
