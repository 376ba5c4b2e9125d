// What the wall of a sleeve bears, for measures of a tube or a wrap around concrete.
#include <algorithm>
#include <cmath>

#include "coupling/boundaries/sleeve.h"

namespace platen::coupling {
namespace {

// The middle half of a height between its ends.
bool in_middle(double z, double low, double high) {
  return std::abs(z - 0.5 * (low + high)) <= 0.25 * (high - low);
}

} // namespace

Sleeve::WallState Sleeve::wall_state() const {
  const fem::HyperelasticSolid &solid = with_loads();
  const std::vector<fem::CellStress> stresses = solid.cell_stresses();
  const std::vector<double> strains = solid.plastic_strains(), hoops = solid.fibre_strains(),
                            shares = solid.fibre_shares();
  WallState state;
  double whole = 0;                            // m^3, of these what has not torn
  double volume = 0, low = high_, high = low_; // m^3, m: of the cells in the middle half
  for (std::size_t c = 0; c < stresses.size(); ++c) {
    const fem::Corners reference = solid.mesh().gather(c, solid.mesh().nodes);
    Vector3 middle{};
    for (const Vector3 &corner : reference)
      middle = middle + 0.125 * corner;
    if (!strains.empty() && strains[c] > 0) state.yielded += 1;
    if (!in_middle(middle.z, low_, high_)) continue;
    const double own = solid.mesh().cells[c].volume * stresses[c].volume_ratio;
    const double radius = std::hypot(middle.x, middle.y), tx = -middle.y / radius, ty = middle.x / radius;
    const fem::Tensor &s = stresses[c].cauchy;
    state.hoop += own * (tx * tx * s[0] + 2 * tx * ty * s[1] + ty * ty * s[4]);
    state.axial -= own * s[8];
    if (wraps() && shares[c] > 0) state.hoop_strain += own * hoops[c], whole += own;
    volume += own;
    for (const int node : solid.mesh().cell_nodes[c])
      low = std::min(low, solid.node_place(node).z), high = std::max(high, solid.node_place(node).z);
  }
  for (std::size_t n = 0; n < solid.mesh().nodes.size(); ++n) {
    const Vector3 &x = solid.mesh().nodes[n], now = solid.node_place(static_cast<int>(n));
    const double outwards = std::hypot(now.x, now.y) - std::hypot(x.x, x.y);
    if (!(outwards <= state.bulge)) state.bulge = outwards; // passes on NaN
  }
  if (volume > 0) {
    state.force = state.axial / (high - low);
    state.axial /= volume, state.hoop /= volume;
  }
  if (!strains.empty()) {
    state.yielded /= static_cast<double>(strains.size());
    for (const double strain : strains)
      if (!(strain <= state.plastic_strain)) state.plastic_strain = strain;
  }
  for (std::size_t c = 0; c < shares.size(); ++c)
    if (shares[c] > 0 && !(hoops[c] <= state.most_hoop)) state.most_hoop = hoops[c];
  if (wraps()) {
    state.hoop_strain = whole > 0 ? state.hoop_strain / whole : not_given;
    if (!(whole > 0)) state.most_hoop = not_given;
    state.torn = static_cast<double>(torn_elements()) / static_cast<double>(shares.size());
  }
  return state;
}

long Sleeve::torn_elements() const {
  const std::vector<double> shares = solid_->fibre_shares();
  return std::count(shares.begin(), shares.end(), 0.0);
}

// Of whole faces, so that force and area are of the same part.
double Sleeve::specimen_pressure() const {
  const fem::HyperelasticSolid &solid = with_loads();
  const fem::SurfaceMesh &inner = solid.surface();
  std::vector<char> counts(inner.faces.size(), 0);
  double area = 0, force = 0; // m^2, N
  for (std::size_t f = 0; f < inner.faces.size(); ++f) {
    const auto corner = [&](std::size_t k) {
      return inner.vertices[static_cast<std::size_t>(inner.faces[f][k])];
    };
    double height = 0; // m, of the middle at the start, as the wall's state counts
    for (const int vertex : inner.faces[f])
      height += 0.25 * solid.mesh().nodes[static_cast<std::size_t>(solid.surface_node(vertex))].z;
    if (!in_middle(height, low_, high_)) continue;
    counts[f] = 1;
    area += 0.5 * norm(cross(corner(2) - corner(0), corner(3) - corner(1)));
  }
  for (const ActiveContact &contact : contact_->contacts())
    if (counts[static_cast<std::size_t>(contact.face)]) force += contact.normal_force;
  return area > 0 ? force / area : not_given;
}

double Sleeve::slip() const {
  double sum = 0, count = 0;
  for (const ActiveContact &contact : contact_->contacts())
    sum += contact.slip, count += 1;
  return count > 0 ? sum / count : 0;
}

} // namespace platen::coupling
