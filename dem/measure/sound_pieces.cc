#include "dem/measure/sound_pieces.h"

#include <algorithm>
#include <utility>

#include "base/pi.h"
#include "dem/mean_radius.h"
#include "dem/measure/damage.h"
#include "dem/measure/disjoint_sets.h"

namespace platen::dem {
namespace {

double sphere_volume(double radius) {
  return 4.0 / 3 * pi * radius * radius * radius;
}

std::vector<char> sound_spheres(const BondCounts &counts, double share) {
  std::vector<char> sound(counts.intact.size(), 0);
  for (std::size_t i = 0; i < sound.size(); ++i) {
    const int all = counts.intact[i] + counts.broken[i];
    sound[i] = all > 0 && counts.intact[i] >= share * all;
  }
  return sound;
}

} // namespace

bool SoundPieces::spans(int piece) const {
  return stands[bottom_end][piece] && stands[top_end][piece];
}

SoundPieces find_sound_pieces(const Particles &p, const Bonds &b, const Shape &shape,
                              const Soundness &soundness) {
  const BondCounts counts = bond_counts(p, b);
  const std::vector<char> sound = sound_spheres(counts, soundness.share);
  DisjointSets sets(p.size());
  for (std::size_t k = 0; k < b.size(); ++k)
    if (!b.has_failed(k) && sound[b.first[k]] && sound[b.second[k]]) sets.join(b.first[k], b.second[k]);

  SoundPieces pieces;
  std::vector<std::pair<double, std::vector<int>>> found; // volume, rows
  for (std::vector<int> &rows : sets.all(sound)) {
    double volume = 0;
    for (const int i : rows)
      volume += sphere_volume(p.radius[i]);
    found.emplace_back(volume, std::move(rows));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto &one, const auto &other) { return one.first > other.first; });
  for (std::size_t i = 0; i < p.size(); ++i)
    if (counts.intact[i] + counts.broken[i] > 0) pieces.bonded_volume += sphere_volume(p.radius[i]);
  for (std::vector<char> &stands : pieces.stands)
    stands.assign(found.size(), 0);
  pieces.of_particle.assign(p.size(), SoundPieces::none);
  const double margin = soundness.reach * mean_radius(p);
  for (std::size_t piece = 0; piece < found.size(); ++piece) {
    pieces.volume.push_back(found[piece].first);
    for (const int i : found[piece].second) {
      pieces.of_particle[i] = static_cast<int>(piece);
      const double z = p.reference_position[i].z, reach = p.radius[i] + margin;
      if (z < reach) pieces.stands[bottom_end][piece] = 1;
      if (shape.height - z < reach) pieces.stands[top_end][piece] = 1;
    }
  }
  for (const End end : {bottom_end, top_end})
    for (std::size_t k = found.size(); k-- > 0;)
      if (pieces.stands[end][k]) pieces.at_end[end] = static_cast<int>(k);
  return pieces;
}

} // namespace platen::dem
