#include "dem/measure/failure_pattern.h"

#include <cmath>
#include <numeric>
#include <vector>

#include "base/pi.h"

namespace platen::dem {
namespace {

constexpr double least_column = 0.05;       // of the volume
constexpr double crushed_end = 0.4;         // damage
constexpr double restrained_end = 0.25;     // spread
constexpr double most_of_it = 0.5;          // of all broken bonds
constexpr double largest_of_shear = 1.13;   // rad: 65 degrees
constexpr double least_broken_around = 0.1; // of the bonds that are not within dead zones
constexpr double practically_intact = 0.02; // fraction of broken bonds

// In all rules, comparisons with an unknown measure (NaN) are false and raise no floating-point exception.

// A plane through the whole specimen with at least half of all broken bonds.
bool one_plane(const FailureMeasures &m) {
  return m.planes.count > 0 && std::isgreaterequal(m.planes.largest.bonds, most_of_it * m.planes.broken) &&
         std::isgreaterequal(m.planes.largest.extent, 0.9 * m.width) &&
         std::islessequal(m.planes.largest.inclination, largest_of_shear);
}

// A smooth barrel also has a still zone on each platen, as round and straight as a cone; but a cone separates
// only if the bonds around it break.
void require_broken(std::array<DeadZone, 2> &dead, const DeadZones &zones, const Bonds &b,
                    const std::vector<double> &losses) {
  double all = 0, broken = 0;
  for (std::size_t k = 0; k < b.initial_count(); ++k) {
    const auto within = [&](End end) {
      return zones.members[end][b.record_first[k]] && zones.members[end][b.record_second[k]];
    };
    if (within(bottom_end) || within(top_end)) continue;
    all += 1, broken += losses[k];
  }
  if (broken >= least_broken_around * all) return;
  for (DeadZone &zone : dead)
    if (zone.is_cone() || zone.verdict == DeadZoneVerdict::dome || zone.verdict == DeadZoneVerdict::doubtful)
      zone.verdict = DeadZoneVerdict::unbroken;
}

// Relates the planes of failed bonds to the losses of all bonds. With facets, most of the loss is damage
// outside of the planes.
void count_losses(CrackPlanes &planes, double lost) {
  if (!(lost > 0)) return;
  planes.steep_fraction *= planes.broken / lost;
  planes.broken = lost;
}

// Two cones; one of them may have lost its tip and be a dome.
bool two_cones(const DeadZone &one, const DeadZone &other) {
  const auto dome = [](const DeadZone &d) { return d.verdict == DeadZoneVerdict::dome; };
  return (one.is_cone() && (other.is_cone() || dome(other))) || (dome(one) && other.is_cone());
}

// Cones by damage, which states before version 3 contain: they are read and dropped.
struct FormerCone {
  void describe(Archive &archive) const {
    archive.version(1);
    std::int64_t verdict = 0;
    archive("verdict", verdict, "1", any_value());
    double number = 0;
    for (const char *fraction : {"spheres", "volume_fraction", "overlap", "roundness", "confidence"})
      archive(fraction, number, "1", any_value());
    for (const char *length : {"height", "apex_depth"})
      archive(length, number, "m", any_value());
    for (const char *angle : {"half_angle", "tilt"})
      archive(angle, number, "rad", any_value());
    Vector3 vector;
    archive("apex", vector, "m", any_value());
    archive("axis", vector, "1", any_value());
  }
};

} // namespace

Specimen specimen_before(const Particles &p, const Shape &shape) {
  return {
      shape, {p.reference_position.begin(), p.reference_position.end()}, {p.radius.begin(), p.radius.end()}};
}

FailureMeasures measure_failure(const Particles &p, const Bonds &b, const Shape &shape,
                                const IntactRules &intact_rules, const MotionAfterPeak &motion,
                                std::vector<double> losses) {
  if (losses.empty()) losses = bond_losses(b);
  FailureMeasures m;
  const DeadZones zones = find_dead_zones(specimen_before(p, shape), motion);
  m.dead = zones.at_end;
  require_broken(m.dead, zones, b, losses);
  m.opening = zones.opening;
  m.damage = damage_by_region(p, b, shape, losses);
  m.end_spread = end_spread(skin_opening(p, b, shape));
  m.planes = sum_up(find_crack_planes(p, b), b);
  for (const IntactPiece &piece : find_intact_pieces(p, b, shape, intact_rules))
    m.columns += piece.spans() && piece.volume_fraction >= least_column;
  count_losses(m.planes, std::accumulate(losses.begin(), losses.end(), 0.0));
  m.broken_fraction = m.planes.broken / static_cast<double>(losses.size());
  m.width = 2 * std::sqrt(shape.cross_section() / pi);
  m.height = shape.height;
  return m;
}

FailureVerdict judge_failure(const FailureMeasures &m) {
  if (one_plane(m))
    return {m.planes.largest.inclination < CrackPlanes::steep ? FailurePattern::splitting
                                                              : FailurePattern::shear_plane,
            DecidedBy::one_plane};
  if (two_cones(m.dead[bottom_end], m.dead[top_end])) return {FailurePattern::cones, DecidedBy::two_cones};
  if (m.columns >= 2) return {FailurePattern::splitting, DecidedBy::columns};
  if (std::isgreater(m.planes.steep_fraction, most_of_it))
    return {FailurePattern::splitting, DecidedBy::steep_planes};
  if (m.broken_fraction <= practically_intact) return {FailurePattern::none, DecidedBy::few_broken};
  const bool restrained = std::isless(m.end_spread, restrained_end); // false if no skin is left
  const double worse_end = m.damage.worse_end();
  if (std::isgreater(worse_end, crushed_end) && !restrained)
    return {FailurePattern::crushing, DecidedBy::crushed_end};
  return {};
}

void FailureMeasures::describe(Archive &archive) {
  const int version = archive.version(3);
  const bool before_motion = version < 2;
  if (version < 3) {
    FormerCone bottom, top;
    archive.part("cone_bottom", bottom);
    archive.part("cone_top", top);
  }
  archive("damage_top", damage.end_top, "1", any_value());
  archive("damage_bottom", damage.end_bottom, "1", any_value());
  archive("damage_middle", damage.middle, "1", any_value());
  if (!before_motion) {
    archive.part("dead_zone_bottom", dead[bottom_end]);
    archive.part("dead_zone_top", dead[top_end]);
    archive("opening", opening, "m", any_value());
  }
  archive.part("crack_planes", planes);
  archive("end_spread", end_spread, "1", any_value());
  archive("columns", columns, "1", any_value());
  archive("broken_share", broken_fraction, "1", any_value());
  archive("width", width, "m", any_value());
  archive("height", height, "m", any_value());
}

} // namespace platen::dem
