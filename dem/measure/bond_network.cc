#include "dem/measure/bond_network.h"

#include "base/parallel.h"

namespace platen::dem {
namespace {

constexpr double round_off_of_determinant = 1e-9; // of the product of its diagonal

struct Moments {
  double weight = 0, x = 0, y = 0, xx = 0, yy = 0;
  void add(double w, double at_x, double at_y, double own = 0) {
    weight += w;
    x += w * at_x, y += w * at_y;
    xx += w * (at_x * at_x + own), yy += w * (at_y * at_y + own);
  }
  Gyration gyration() const {
    if (weight == 0) return {};
    const double cx = x / weight, cy = y / weight;
    return {cx, cy, xx / weight - cx * cx, yy / weight - cy * cy};
  }
};

} // namespace

SmallStrain small_strain(const Particles &p, const Bonds &b, std::size_t row,
                         const std::vector<Vector3> &displacement, const std::vector<Vector3> &turn) {
  const int i = b.first[row], j = b.second[row];
  const Vector3 d = b.reference[row];
  SmallStrain s;
  s.normal = d / norm(d);
  Vector3 u = displacement[j] - displacement[i];
  if (p.has_rotation() && !turn.empty()) {
    u -= cross(turn[j], (1 - b.lever[row]) * d) + cross(turn[i], b.lever[row] * d);
    const Vector3 relative = turn[j] - turn[i];
    s.twist = dot(relative, s.normal);
    s.bend = relative - s.twist * s.normal;
  }
  s.stretch = dot(u, s.normal);
  s.slip = u - s.stretch * s.normal;
  return s;
}

Vector3 small_force(const Bonds &b, std::size_t row, const SmallStrain &s) {
  const BondStiffness k = b.stiffness(row);
  return k.axial * s.stretch * s.normal + k.shear * s.slip;
}

BondEnergies bond_energies(const Particles &p, const Bonds &b, const std::vector<Vector3> &displacement,
                           const std::vector<Vector3> &turn) {
  return ordered_sum<BondEnergies>(b.size(), [&](std::size_t first, std::size_t last) {
    BondEnergies sum;
    for (std::size_t row = first; row < last; ++row) {
      const BondStiffness k = b.stiffness(row);
      const SmallStrain s = small_strain(p, b, row, displacement, turn);
      sum.axial += 0.5 * k.axial * s.stretch * s.stretch;
      sum.bending += 0.5 * (k.shear * norm_squared(s.slip) + k.bending * norm_squared(s.bend));
      sum.torsion += 0.5 * k.twisting * s.twist * s.twist;
    }
    return sum;
  });
}

BondEnergies bond_energies(const Particles &p, const Bonds &b) {
  std::vector<Vector3> displacement(p.size()), turn(p.has_rotation() ? p.size() : 0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    displacement[i] = p.position[i] - p.reference_position[i];
    if (turn.empty()) continue;
    const Quaternion &q = (*p.orientation)[i];
    turn[i] = (q.w < 0 ? -2.0 : 2.0) * vector_part(q);
  }
  return bond_energies(p, b, displacement, turn);
}

NetworkModuli network_moduli(const Bonds &bonds, double volume) {
  // The mean ratio k = K_s / (k_n A) from differences to the first, which are round-off if a law has one
  // ratio.
  double axial = 0, difference = 0, first = 0;
  for (std::size_t row = 0; row < bonds.size(); ++row) {
    const double l = bonds.rest_length[row];
    const BondStiffness s = bonds.stiffness(row);
    if (s.axial == 0) continue;
    const double ratio = s.shear / s.axial;
    if (axial == 0) first = ratio;
    axial += l * l * s.axial;
    difference += l * l * s.axial * (ratio - first);
  }
  if (axial == 0) return {};
  const double stiffness = axial / volume, k = first + difference / axial;
  return {stiffness / 3 * (2 + 3 * k) / (4 + k), (1 - k) / (4 + k), stiffness / 3 * 5 * k / (2 + 3 * k),
          (1 - k) / (2 + 3 * k)};
}

std::array<double, 3> affine_moduli(const Bonds &bonds, double volume) {
  // C_aabb = sum of l^2 ((K_n - K_s) n_a^2 n_b^2 + K_s n_a^2 [a = b]) / V: strains along the axes move the
  // end of a bond by l e_a n_a. Rotations are zero, as the strain has none.
  std::array<std::array<double, 3>, 3> c{};
  for (std::size_t row = 0; row < bonds.size(); ++row) {
    const BondStiffness s = bonds.stiffness(row);
    const Vector3 &d = bonds.reference[row];
    const double inverse = 1 / norm_squared(d);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        c[a][b] += ((s.axial - s.shear) * d[a] * d[a] * d[b] * d[b] * inverse +
                    (a == b ? s.shear * d[a] * d[a] : 0.0)) /
                   volume;
  }
  std::array<double, 3> moduli{};
  for (int a = 0; a < 3; ++a) {
    const int x = (a + 1) % 3, y = (a + 2) % 3;
    const double across = c[x][x] * c[y][y] - c[x][y] * c[x][y];
    moduli[a] = c[a][a];
    // If nothing resists lateral strains, they have no effect.
    if (across > round_off_of_determinant * c[x][x] * c[y][y])
      moduli[a] -= (c[a][x] * (c[y][y] * c[a][x] - c[x][y] * c[a][y]) +
                    c[a][y] * (c[x][x] * c[a][y] - c[x][y] * c[a][x])) /
                   across;
  }
  return moduli;
}

Gyration mass_gyration(const Particles &p, double low, double high) {
  Moments m;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector3 &x = p.reference_position[i];
    // The mean square distance of a sphere's mass from its centre is R^2 / 5 in each direction.
    if (x.z >= low && x.z <= high) m.add(p.mass[i], x.x, x.y, 0.2 * p.radius[i] * p.radius[i]);
  }
  return m.gyration();
}

Gyration bond_gyration(const Particles &p, const Bonds &b, double low, double high) {
  Moments m;
  for (std::size_t row = 0; row < b.size(); ++row) {
    const Vector3 d = b.reference[row];
    const Vector3 middle = p.reference_position[b.first[row]] + 0.5 * d;
    if (middle.z < low || middle.z > high) continue;
    const BondStiffness s = b.stiffness(row);
    const double square = norm_squared(d), n2 = d.z * d.z / square;
    m.add(square * n2 * (s.axial * n2 + s.shear * (1 - n2)), middle.x, middle.y);
  }
  return m.gyration();
}

} // namespace platen::dem
