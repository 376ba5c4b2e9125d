#include "dem/measure/failure_pattern.h"

#include <cmath>

#include "base/pi.h"

namespace platen::dem {
namespace {

constexpr double least_column = 0.05;                 // of the volume
constexpr double sound_end = 0.3, gone_middle = 0.45; // damage
constexpr double crushed_end = 0.4;                   // damage
constexpr double held_end = 0.25;                     // spread
constexpr double most_of_it = 0.5;                    // of all broken bonds
constexpr double largest_of_shear = 1.13;             // rad: 65 degrees
constexpr double as_good_as_whole = 0.02;             // broken share

bool narrows(const ConePiece &piece) {
  return piece.is_cone() || piece.verdict == NoCone::leans || piece.verdict == NoCone::one_sided ||
         piece.verdict == NoCone::ragged;
}

// Comparisons are false where a measure is not known (NaN), and quiet about it.
// A plane through the whole specimen and nearly nothing beside it.
bool one_plane(const FailureMeasures &m) {
  return m.planes.count > 0 && std::isgreaterequal(m.planes.largest.bonds, most_of_it * m.planes.broken) &&
         std::isgreaterequal(m.planes.largest.extent, 0.9 * m.width) &&
         std::islessequal(m.planes.largest.inclination, largest_of_shear);
}

} // namespace

FailureMeasures measure_failure(const Particles &p, const Bonds &b, const Shape &shape,
                                const Soundness &soundness) {
  FailureMeasures m;
  const SoundPieces pieces = find_sound_pieces(p, b, shape, soundness);
  m.damage = damage_by_region(p, b, shape);
  m.cones = measure_cones(p, b, pieces, shape);
  m.end_spread = end_spread(skin_opening(p, b, shape));
  m.planes = sum_up(find_crack_planes(p, b), b);
  for (std::size_t k = 0; k < pieces.volume.size(); ++k)
    m.columns += pieces.spans(static_cast<int>(k)) && pieces.share(static_cast<int>(k)) >= least_column;
  m.broken_share = m.planes.broken / static_cast<double>(b.initial_count());
  m.width = 2 * std::sqrt(shape.cross_section() / pi);
  m.height = shape.height;
  return m;
}

FailureVerdict judge_failure(const FailureMeasures &m) {
  const ConePiece &bottom = m.cones[bottom_end], &top = m.cones[top_end];
  if (bottom.is_cone() && top.is_cone()) return {FailurePattern::cones, DecidedBy::two_cones};
  const double worse_end = m.damage.worse_end();
  if (std::isless(worse_end, sound_end) && std::isgreater(m.damage.middle, gone_middle) && narrows(bottom) &&
      narrows(top))
    return {FailurePattern::cones, DecidedBy::hourglass};
  if (one_plane(m))
    return {m.planes.largest.inclination < CrackPlanes::steep ? FailurePattern::splitting
                                                              : FailurePattern::shear_plane,
            DecidedBy::one_plane};
  if (m.columns >= 2) return {FailurePattern::splitting, DecidedBy::columns};
  if (std::isgreater(m.planes.steep_share, most_of_it))
    return {FailurePattern::splitting, DecidedBy::steep_planes};
  if (m.broken_share <= as_good_as_whole) return {FailurePattern::none, DecidedBy::few_broken};
  const bool held = std::isless(m.end_spread, held_end); // not where no skin is left to tell
  if (std::isgreater(worse_end, crushed_end) && !held)
    return {FailurePattern::crushing, DecidedBy::crushed_end};
  return {};
}

void FailureMeasures::describe(Archive &archive) {
  archive.version(1);
  archive("damage_top", damage.end_top);
  archive("damage_bottom", damage.end_bottom);
  archive("damage_middle", damage.middle);
  archive.part("cone_bottom", cones[bottom_end]);
  archive.part("cone_top", cones[top_end]);
  archive.part("crack_planes", planes);
  archive("end_spread", end_spread);
  archive("columns", columns);
  archive("broken_share", broken_share);
  archive("width", width, "m");
  archive("height", height, "m");
}

} // namespace platen::dem
