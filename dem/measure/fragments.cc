#include "dem/measure/fragments.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "dem/measure/damage.h"
#include "dem/particles.h"

namespace platen::dem {
namespace {

std::vector<char> intact_spheres(const BondCounts &counts, double fraction) {
  std::vector<char> intact(counts.intact.size(), 0);
  for (std::size_t i = 0; i < intact.size(); ++i) {
    const int all = counts.intact[i] + counts.broken[i];
    intact[i] = all > 0 && counts.intact[i] >= fraction * all;
  }
  return intact;
}

} // namespace

DisjointSets::DisjointSets(std::size_t n) : parent_(n) {
  std::iota(parent_.begin(), parent_.end(), 0);
}

int DisjointSets::name(int member) {
  while (parent_[member] != member)
    member = parent_[member] = parent_[parent_[member]];
  return member;
}

void DisjointSets::join(int one, int other) {
  const int a = name(one), b = name(other);
  parent_[std::max(a, b)] = std::min(a, b);
}

std::vector<std::vector<int>> DisjointSets::all(const std::vector<char> &counted) {
  std::vector<std::vector<int>> sets;
  std::vector<int> number(parent_.size());
  for (int i = 0; i < static_cast<int>(parent_.size()); ++i) {
    if (!counted.empty() && !counted[i]) continue;
    const int set = name(i);
    if (set == i) {
      number[i] = static_cast<int>(sets.size());
      sets.emplace_back();
    }
    sets[number[set]].push_back(i);
  }
  return sets;
}

Fragments find_fragments(const Particles &p, const Bonds *bonds) {
  const int n = static_cast<int>(p.size());
  DisjointSets sets(p.size());
  if (bonds != nullptr)
    for (std::size_t k = 0; k < bonds->initial_count(); ++k)
      if (!is_broken(bonds->state[k])) sets.join(bonds->record_first[k], bonds->record_second[k]);
  std::vector<double> mass(p.size(), 0.0);
  std::vector<int> particles(p.size(), 0), roots;
  for (int i = 0; i < n; ++i) {
    const int r = sets.name(i);
    if (r == i) roots.push_back(i);
    mass[r] += p.mass[i];
    ++particles[r];
  }
  std::stable_sort(roots.begin(), roots.end(), [&](int a, int b) { return mass[a] > mass[b]; });
  Fragments f;
  std::vector<int> number(p.size());
  for (const int r : roots) {
    number[r] = static_cast<int>(f.mass.size());
    f.mass.push_back(mass[r]);
    f.particles.push_back(particles[r]);
    (particles[r] > 1 ? f.count : f.single) += 1;
  }
  f.of_particle.resize(p.size());
  for (int i = 0; i < n; ++i)
    f.of_particle[i] = number[sets.name(i)];
  return f;
}

std::vector<IntactPiece> find_intact_pieces(const Particles &p, const Bonds &b, const Shape &shape,
                                            const IntactRules &intact_rules) {
  const BondCounts counts = bond_counts(p, b);
  const std::vector<char> intact = intact_spheres(counts, intact_rules.fraction);
  DisjointSets sets(p.size());
  for (std::size_t k = 0; k < b.size(); ++k)
    if (!b.has_failed(k) && intact[b.first[k]] && intact[b.second[k]]) sets.join(b.first[k], b.second[k]);
  double bonded_volume = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (counts.intact[i] + counts.broken[i] > 0) bonded_volume += sphere_volume(p.radius[i]);

  std::vector<IntactPiece> pieces;
  const double margin = intact_rules.reach * mean_radius(p);
  for (const std::vector<int> &rows : sets.all(intact)) {
    IntactPiece &piece = pieces.emplace_back();
    for (const int i : rows) {
      piece.volume_fraction += sphere_volume(p.radius[i]) / bonded_volume;
      const double z = p.reference_position[i].z, reach = p.radius[i] + margin;
      if (z < reach) piece.stands_on[bottom_end] = true;
      if (shape.height - z < reach) piece.stands_on[top_end] = true;
    }
  }
  return pieces;
}

} // namespace platen::dem
