#include "dem/measure/section.h"

namespace platen::dem {
namespace {

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

Gyration mass_gyration(const Particles &p, double low, double high) {
  Moments m;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector3 &x = p.reference_position[i];
    // A sphere's mass lies R^2 / 5 from its centre in each direction, in the mean of squares.
    if (x.z >= low && x.z <= high) m.add(p.mass[i], x.x, x.y, 0.2 * p.radius[i] * p.radius[i]);
  }
  return m.gyration();
}

Gyration bond_gyration(const Particles &p, const Bonds &b, double low, double high) {
  Moments m;
  for (std::size_t row = 0; row < b.size(); ++row) {
    const Vector3 d = b.reference[row];
    const Vector3 middle = p.reference_position[static_cast<std::size_t>(b.first[row])] + 0.5 * d;
    if (middle.z < low || middle.z > high) continue;
    const BondStiffness s = b.stiffness(row);
    const double square = norm_squared(d), n2 = d.z * d.z / square;
    m.add(square * n2 * (s.axial * n2 + s.shear * (1 - n2)), middle.x, middle.y);
  }
  return m.gyration();
}

} // namespace platen::dem
