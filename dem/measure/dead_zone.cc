#include "dem/measure/dead_zone.h"

#include <algorithm>
#include <cmath>

#include "dem/cell_grid.h"
#include "dem/measure/damage.h"
#include "dem/measure/dead_zone_shape.h"

namespace platen::dem {
namespace {

std::vector<IndexPair> neighbours(const Specimen &s, double gap) {
  std::vector<IndexPair> pairs =
      near_pairs(s.centre.data(), s.radius.data(), s.size(), gap * largest_radius(s));
  const auto separated = [&](const IndexPair &p) {
    const double one = s.radius[p.first], other = s.radius[p.second];
    return norm(s.centre[p.second] - s.centre[p.first]) - one - other >= gap * std::min(one, other);
  };
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), separated), pairs.end());
  return pairs;
}

// Displacement of each sphere relative to the platen of an end, m.
std::vector<double> motion_to_platen(const Specimen &s, const MotionAfterPeak &motion, End end) {
  const PlatenMotion &platen = motion.platens[end];
  const Vector3 middle{0, 0, end == top_end ? s.shape.height : 0};
  std::vector<double> moved(s.size());
  for (std::size_t i = 0; i < s.size(); ++i)
    moved[i] = norm(motion.displacement[i] - platen.displacement - cross(platen.turn, s.centre[i] - middle));
  return moved;
}

// The dead spheres that are connected to the platen by dead neighbours.
std::vector<char> on_platen(const Specimen &s, const std::vector<char> &dead,
                            const std::vector<IndexPair> &pairs, End end, double margin) {
  DisjointSets sets(s.size());
  for (const IndexPair &pair : pairs)
    if (dead[pair.first] && dead[pair.second]) sets.join(pair.first, pair.second);
  std::vector<char> touched(s.size(), 0), members(s.size(), 0);
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double z = end == top_end ? s.shape.height - s.centre[i].z : s.centre[i].z;
    if (dead[i] && z < s.radius[i] + margin) touched[sets.name(static_cast<int>(i))] = 1;
  }
  for (std::size_t i = 0; i < s.size(); ++i)
    members[i] = dead[i] && touched[sets.name(static_cast<int>(i))];
  return members;
}

} // namespace

DeadZones find_dead_zones(const Specimen &before, const MotionAfterPeak &motion, const DeadZoneRules &rules) {
  DeadZones zones;
  for (std::vector<char> &members : zones.members)
    members.assign(before.size(), 0);
  if (before.shape.kind == ShapeKind::disc || !motion.known()) return zones;
  for (const double slice : skin_opening(before.centre, motion.displacement, before.shape))
    zones.opening = std::fmax(zones.opening, slice);
  if (!std::isgreater(zones.opening, 0.0)) return zones;

  const std::vector<IndexPair> pairs = neighbours(before, rules.gap);
  const double margin = rules.reach * mean_radius(before);
  std::array<std::vector<double>, 2> moved;
  for (const End end : {bottom_end, top_end})
    moved[end] = motion_to_platen(before, motion, end);
  for (const End end : {bottom_end, top_end}) {
    const std::vector<double> &here = moved[end], &there = moved[end == top_end ? bottom_end : top_end];
    std::vector<char> dead(before.size());
    for (std::size_t i = 0; i < before.size(); ++i)
      dead[i] = here[i] < rules.still * zones.opening && here[i] <= there[i];
    zones.members[end] = on_platen(before, dead, pairs, end, margin);
    zones.at_end[end] = measure_dead_zone(before, zones.members[end], end, rules);
  }
  return zones;
}

const char *words_of(DeadZoneVerdict why) {
  constexpr const char *words[] = {"not measured",
                                   "a cone",
                                   "nothing moves with the platen",
                                   "little of the end moves with the platen",
                                   "a low layer moves with the platen",
                                   "too much of the specimen moves with the platen",
                                   "what moves with the platen has the full section over half of its height",
                                   "what moves with the platen does not narrow as a cone does",
                                   "what moves with the platen leans to one side",
                                   "what moves with the platen is a wedge",
                                   "what moves with the platen is too ragged for a cone",
                                   "part of the end alone moves with the platen: undecided",
                                   "the specimen has barrelled, and little has broken",
                                   "what moves with the platen is a dome"};
  return words[static_cast<int>(why)];
}

void DeadZone::describe(Archive &archive) {
  archive.version(1);
  archive("verdict", verdict, "1", between(0, static_cast<double>(DeadZoneVerdict::dome)));
  archive("spheres", spheres, "1", any_value());
  archive("base_ratio", base_ratio, "1", any_value());
  archive("volume_fraction", volume_fraction, "1", any_value());
  archive("height", height, "m", any_value());
  archive("half_angle", half_angle, "rad", any_value());
  archive("apex_depth", apex_depth, "m", any_value());
  archive("tilt", tilt, "rad", any_value());
  archive("apex", apex, "m", any_value());
  archive("axis", axis, "1", any_value());
  archive("roundness", roundness, "1", any_value());
  archive("straightness", straightness, "1", any_value());
  archive("overlap", overlap, "1", any_value());
  archive("confidence", confidence, "1", any_value());
}

} // namespace platen::dem
