#include "dem/measure/fragments.h"

#include <algorithm>
#include <numeric>

namespace platen::dem {
namespace {

int root_of(std::vector<int> &parent, int i) {
  while (parent[i] != i)
    i = parent[i] = parent[parent[i]];
  return i;
}

} // namespace

Fragments find_fragments(const Particles &p, const Bonds *bonds) {
  const int n = static_cast<int>(p.size());
  std::vector<int> parent(p.size());
  std::iota(parent.begin(), parent.end(), 0);
  if (bonds != nullptr)
    for (std::size_t k = 0; k < bonds->size(); ++k) {
      if (bonds->has_failed(k)) continue;
      const int a = root_of(parent, bonds->first[k]), b = root_of(parent, bonds->second[k]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  std::vector<double> mass(p.size(), 0.0);
  std::vector<int> particles(p.size(), 0), roots;
  for (int i = 0; i < n; ++i) {
    const int r = root_of(parent, i);
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
    f.of_particle[i] = number[root_of(parent, i)];
  return f;
}

} // namespace platen::dem
