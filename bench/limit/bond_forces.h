// The bond law of the idealised loop: the total-form parallel bond of dem/laws/parallel_bond.h in the same
// symbols, forces and torques only.
#pragma once

namespace platen::bench {

template <class Real>
struct Vector {
  Real x, y, z;
};
template <class Real>
struct BondForces {
  Vector<Real> force, torque_first, torque_second; // on the first particle; on the second: minus force
};

template <class Real>
inline Real dot(const Vector<Real> &a, const Vector<Real> &b) {
  return a.x * b.x + a.y * b.y + a.z * b.z; // 5 flops
}
template <class Real>
inline Vector<Real> cross(const Vector<Real> &a, const Vector<Real> &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; // 9
}
template <class Real>
inline Vector<Real> operator+(const Vector<Real> &a, const Vector<Real> &b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z}; // 3
}
template <class Real>
inline Vector<Real> operator-(const Vector<Real> &a, const Vector<Real> &b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z}; // 3
}
template <class Real>
inline Vector<Real> operator*(const Real &s, const Vector<Real> &a) {
  return {s * a.x, s * a.y, s * a.z}; // 3
}
// a turned by the unit quaternion (w, u): 30
template <class Real>
inline Vector<Real> turned(const Real &w, const Vector<Real> &u, const Vector<Real> &a) {
  const Vector<Real> s = cross(u, a), t = s + s;
  return a + w * t + cross(u, t);
}

// The numbers at the right count flops: a root and a division are one each, a fused multiply-add is two.
// Bonded neighbours never turn by half a turn against each other, so that w needs no change of sign. Real
// needs root(Real); Block holds the members of BondBlock.
template <class Real, class Block>
inline BondForces<Real> bond_forces(const Block &b, const Vector<Real> &xi, const Real &pw,
                                    const Vector<Real> &p, const Vector<Real> &xj, const Real &qw,
                                    const Vector<Real> &q) {
  const Vector<Real> d = xj - xi;                                                             // 3
  const Real length = root(dot(d, d)), inverse = 1.0 / length;                                // 7
  const Vector<Real> n = inverse * d;                                                         // 3
  const Vector<Real> ri = turned(pw, p, {b.arm_first[0], b.arm_first[1], b.arm_first[2]});    // 30
  const Vector<Real> rj = turned(qw, q, {b.arm_second[0], b.arm_second[1], b.arm_second[2]}); // 30
  const Vector<Real> u = d - ri - rj;                                                         // 6
  const Real un = dot(u, n);                                                                  // 5
  const Vector<Real> shear = b.shear * (u - un * n);                                          // 9
  const Real axial = b.normal * (length - b.rest_length);                                     // 2
  const Real w = qw * pw + q.x * p.x + q.y * p.y + q.z * p.z;                                 // 7
  const Vector<Real> v = {pw * q.x - qw * p.x + q.z * p.y - q.y * p.z,                        // 7
                          pw * q.y - qw * p.y + q.x * p.z - q.z * p.x,                        // 7
                          pw * q.z - qw * p.z + q.y * p.x - q.x * p.y};                       // 7
  const Real vn = dot(v, n);                                                                  // 5
  const Vector<Real> vs = v - vn * n;                                                         // 6
  const Vector<Real> skew = (b.excess[1] * vn) * cross(v, n);                                 // 13
  const Vector<Real> moment = (w + w) * (b.bending * v + (b.excess[0] * vn) * n);             // 14
  return {axial * n + (1.0 - un * inverse) * shear + (b.excess[2] * vn * inverse) * vs,       // 19
          cross(ri, shear) + moment - skew,                                                   // 15
          cross(rj, shear) - moment - skew};                                                  // 15
} // 210; adding force and torque to both ends makes 12 more: 222

} // namespace platen::bench
