#include "dem/measure/fragments.h"

#include <algorithm>

#include "dem/measure/disjoint_sets.h"

namespace platen::dem {

Fragments find_fragments(const Particles &p, const Bonds *bonds) {
  const int n = static_cast<int>(p.size());
  DisjointSets sets(p.size());
  if (bonds != nullptr)
    for (std::size_t k = 0; k < bonds->size(); ++k)
      if (!bonds->has_failed(k)) sets.join(bonds->first[k], bonds->second[k]);
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

} // namespace platen::dem
