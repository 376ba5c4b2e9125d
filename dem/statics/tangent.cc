#include "dem/statics/tangent.h"

#include <array>

namespace platen::dem::statics {
namespace {

// Of the bond's length, and rad: round-off of 1e-10 and an error of 1e-12 of the stiffness.
constexpr double difference = 1e-6;

using Answer = std::array<double, 9>; // force on the first, torques on both

Answer answer(const BondResponse<double> &r) {
  return {r.force.x,    r.force.y,    r.force.z,    r.torque_i.x, r.torque_i.y,
          r.torque_i.z, r.torque_j.x, r.torque_j.y, r.torque_j.z};
}

Rotation<double> turned_by(const Quaternion &q, int axis, double angle) {
  Vector3 v;
  (axis == 0 ? v.x : (axis == 1 ? v.y : v.z)) = angle;
  const Quaternion t = rotation_quaternion(v) * q;
  return {t.w, t.x, t.y, t.z};
}

} // namespace

BondBlocks<6> tangent_stiffness(const Particles &p, const Bonds &b, std::size_t row) {
  BondBlocks<6> blocks{};
  if (b.stiffness(row).axial == 0) return blocks;
  const std::size_t i = static_cast<std::size_t>(b.first[row]), j = static_cast<std::size_t>(b.second[row]);
  const Vector3 d = p.position[j] - p.position[i];
  const Quaternion &qi = (*p.orientation)[i], &qj = (*p.orientation)[j];
  const BondMotion<double> here{{d.x, d.y, d.z}, turned_by(qi, 0, 0), turned_by(qj, 0, 0)};
  const double length = difference * b.rest_length[row];
  // Derivatives by the distance and by the rotations of both.
  std::array<Answer, 9> by;
  for (int k = 0; k < 9; ++k) {
    BondMotion<double> ends[2] = {here, here};
    const double h = k < 3 ? length : difference;
    for (int s = 0; s < 2; ++s) {
      const double step = s == 0 ? h : -h;
      if (k < 3) (k == 0 ? ends[s].distance.x : (k == 1 ? ends[s].distance.y : ends[s].distance.z)) += step;
      if (k >= 3 && k < 6) ends[s].turn_i = turned_by(qi, k - 3, step);
      if (k >= 6) ends[s].turn_j = turned_by(qj, k - 6, step);
    }
    const Answer more = answer(b.response_to(row, ends[0])), less = answer(b.response_to(row, ends[1]));
    for (std::size_t e = 0; e < 9; ++e)
      by[static_cast<std::size_t>(k)][e] = (more[e] - less[e]) / (2 * h);
  }
  // Twelve unknowns, displacement and rotation of each; the distance grows with the second, falls with the
  // first, whose force is minus the other's.
  const double ri = p.radius[i], rj = p.radius[j];
  const auto entry = [&](int r, int c) {
    const std::size_t column = static_cast<std::size_t>(c < 3 ? c : (c < 6 ? c : (c < 9 ? c - 6 : c - 3)));
    const double unit = c < 3 ? -1 : (c < 6 ? 1 / ri : (c < 9 ? 1 : 1 / rj));
    const std::size_t force = static_cast<std::size_t>(r < 3 ? r : (r < 6 ? r : (r < 9 ? r - 6 : r - 3)));
    const double scale = r < 3 ? 1 : (r < 6 ? 1 / ri : (r < 9 ? -1 : 1 / rj));
    return -scale * unit * by[column][force];
  };
  for (int c = 0; c < 6; ++c)
    for (int r = 0; r < 6; ++r) {
      blocks.ii[6 * c + r] = 0.5 * (entry(r, c) + entry(c, r));
      blocks.jj[6 * c + r] = 0.5 * (entry(6 + r, 6 + c) + entry(6 + c, 6 + r));
      blocks.ij[6 * c + r] = 0.5 * (entry(r, 6 + c) + entry(6 + c, r));
    }
  return blocks;
}

} // namespace platen::dem::statics
