// The beam bond against Euler and Bernoulli: the 12 x 12 matrix, the beam of finite section rotations,
// chains, and the stress at the skin.
#include "dem/laws/cohesive_beam.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <array>
#include <cmath>

#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

using namespace examples;

// A number and its derivative, for exact tangents of the law.
struct Dual {
  double value = 0, slope = 0;
  Dual() = default;
  Dual(double v, double s = 0) : value(v), slope(s) {} // numbers are constants
};
inline Dual operator+(const Dual &a, const Dual &b) {
  return {a.value + b.value, a.slope + b.slope};
}
inline Dual operator-(const Dual &a, const Dual &b) {
  return {a.value - b.value, a.slope - b.slope};
}
inline Dual operator*(const Dual &a, const Dual &b) {
  return {a.value * b.value, a.slope * b.value + a.value * b.slope};
}
inline Dual operator/(const Dual &a, const Dual &b) {
  return {a.value / b.value, (a.slope * b.value - a.value * b.slope) / (b.value * b.value)};
}
// At zero only where nothing depends on the slope there.
inline Dual root(const Dual &a) {
  const double r = std::sqrt(a.value);
  return {r, r > 0 ? 0.5 * a.slope / r : 0};
}
inline Dual magnitude(const Dual &a) {
  return a.value < 0 ? Dual(0) - a : a;
}
inline Dual larger(const Dual &a, const Dual &b) {
  return a.value > b.value ? a : b;
}

constexpr double young = 265e9, poisson = .3,
                 slender = .71; // silica: E, nu, radius of the beam over the spheres'
constexpr double beam_radius = slender * radius, length = 2 * radius;
constexpr double section = pi * beam_radius * beam_radius, inertia = section * beam_radius * beam_radius / 4;
constexpr double axial = young * section / length, bending = young * inertia / length;
constexpr double twisting = young / (2 * (1 + poisson)) * 2 * inertia / length;

CohesiveBeam beam() {
  CohesiveBeam::Parameters p;
  p.poisson_ratio = poisson;
  return p;
}
template <class Real>
BondGeometry<Real> along(const Vector3 &d) {
  return {{d.x, d.y, d.z}, norm(d), .5, young / norm(d), beam_radius};
}
// Of the present motion, in the order force and torque on i, force and torque on j.
std::array<Dual, 12> actions(const BondResponse<Dual> &r) {
  const Dual zero = 0;
  return {r.force.x,        r.force.y,        r.force.z,        r.torque_i.x, r.torque_i.y, r.torque_i.z,
          zero - r.force.x, zero - r.force.y, zero - r.force.z, r.torque_j.x, r.torque_j.y, r.torque_j.z};
}

// Derivatives of what the bond does by displacement and small rotation of both ends, at rest.
Eigen::MatrixXd tangent_at_rest() {
  Eigen::MatrixXd k(12, 12);
  for (int c = 0; c < 12; ++c) {
    std::array<double, 12> unit{};
    unit[c] = 1;
    const auto at = [&](int e) { return Dual(0, unit[e]); };
    BondMotion<Dual> m;
    m.distance = {Dual(length) + at(6) - at(0), at(7) - at(1), at(8) - at(2)};
    const Dual half = .5;
    m.turn_i = {Dual(1), half * at(3), half * at(4), half * at(5)};
    m.turn_j = {Dual(1), half * at(9), half * at(10), half * at(11)};
    const auto force = actions(beam().turning<true>(along<Dual>({length, 0, 0}), m));
    for (int r = 0; r < 12; ++r)
      k(r, c) = -force[r].slope; // the beam acts against the motion
  }
  return k;
}

// Of a beam along x with displacements and rotations of both ends.
Eigen::MatrixXd euler_bernoulli() {
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(12, 12);
  const auto couple = [&](int a, int b, double value) { k(a, b) += value, k(b, a) += a == b ? 0 : value; };
  couple(0, 0, axial), couple(6, 6, axial), couple(0, 6, -axial);
  couple(3, 3, twisting), couple(9, 9, twisting), couple(3, 9, -twisting);
  const double shear = 12 * bending / (length * length), arm = 6 * bending / length;
  for (const auto &[v, t, sign] : {std::array{1, 5, 1}, std::array{2, 4, -1}}) {
    couple(v, v, shear), couple(v + 6, v + 6, shear), couple(v, v + 6, -shear);
    couple(t, t, 4 * bending), couple(t + 6, t + 6, 4 * bending), couple(t, t + 6, 2 * bending);
    couple(v, t, sign * arm), couple(v, t + 6, sign * arm);
    couple(v + 6, t, -sign * arm), couple(v + 6, t + 6, -sign * arm);
  }
  return k;
}

TEST(cohesive_beam, tangent_at_rest_is_the_matrix_of_the_beam) {
  const Eigen::MatrixXd ours = tangent_at_rest(), wanted = euler_bernoulli();
  EXPECT_LT((wanted - wanted.transpose()).cwiseAbs().maxCoeff(), 1e-300);
  for (int r = 0; r < 12; ++r)
    for (int c = 0; c < 12; ++c) {
      const double scale = std::sqrt(wanted(r, r) * wanted(c, c));
      EXPECT_NEAR(ours(r, c), wanted(r, c), 1e-12 * scale) << r << ", " << c;
    }
}

CohesiveBeam strong(double tensile, double shear, double beta = 1) {
  CohesiveBeam::Parameters p = beam().parameters;
  p.tensile_strength = tensile;
  p.shear_strength = shear;
  p.moment_contribution = beta;
  return p;
}
constexpr double tiny = 1e-6; // rotations: closed forms hold to its square

TEST(cohesive_beam, tension_breaks_it_at_the_strength_of_the_section) {
  const double strain = 1e-4, stress = young * strain;
  const BondResponse<double> r = strong(2 * stress, 1)(
      along<double>({length, 0, 0}), {{length * (1 + strain), 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}});
  EXPECT_NEAR(r.normal_force, stress * section, 1e-10 * stress * section);
  EXPECT_NEAR(r.tension_ratio, .5, 1e-10);
  EXPECT_NEAR(r.shear_ratio, 0, 1e-10);
  EXPECT_NEAR(r.energy, .5 * stress * strain * section * length, 1e-10 * r.energy);
}

TEST(cohesive_beam, pure_bending_strains_the_skin_alike_at_both_ends) {
  const Quaternion back = rotation_quaternion({0, 0, -tiny / 2}),
                   forth = rotation_quaternion({0, 0, tiny / 2});
  for (const double beta : {1., .3}) {
    const double stress = young * beam_radius * tiny / length; // M r / I
    const BondResponse<double> r = strong(stress, stress, beta)(
        along<double>({length, 0, 0}), {{length, 0, 0}, rotation(back), rotation(forth)});
    EXPECT_NEAR(r.torque_i.z, bending * tiny, 1e-10 * bending * tiny);
    EXPECT_NEAR(r.torque_j.z, -bending * tiny, 1e-10 * bending * tiny);
    EXPECT_NEAR(r.tension_ratio, beta, 1e-10);
    EXPECT_NEAR(r.shear_ratio, 0, 1e-10);
    EXPECT_NEAR(r.energy, .5 * bending * tiny * tiny, 1e-10 * r.energy);
  }
}

TEST(cohesive_beam, torsion_shears_the_skin) {
  const double stress = young / (2 * (1 + poisson)) * beam_radius * tiny / length; // T r / I_o
  const BondResponse<double> r =
      strong(stress, stress)(along<double>({length, 0, 0}),
                             {{length, 0, 0}, {1, 0, 0, 0}, rotation(rotation_quaternion({tiny, 0, 0}))});
  EXPECT_NEAR(r.torque_i.x, twisting * tiny, 1e-10 * twisting * tiny);
  EXPECT_NEAR(r.shear_ratio, 1, 1e-10);
  EXPECT_NEAR(r.tension_ratio, 0, 1e-10);
}

// One end clamped, the other displaced and turned as by a load P at its end: the moment is P l where it is
// clamped and none at the load, whichever end that is.
TEST(cohesive_beam, a_cantilever_is_strained_most_where_it_is_clamped) {
  const double tip = tiny * length, load = 3 * bending * tip / (length * length);
  const Quaternion slope = rotation_quaternion({0, 0, 1.5 * tiny});
  const double stress = load * length * beam_radius / inertia, shear = load / section;
  const CohesiveBeam law = strong(stress, shear);
  const BondResponse<double> r =
      law(along<double>({length, 0, 0}), {{length, tip, 0}, {1, 0, 0, 0}, rotation(slope)});
  EXPECT_NEAR(r.force.y, load, 1e-10 * load);
  EXPECT_NEAR(r.torque_i.z, load * length, 1e-10 * load * length);
  EXPECT_NEAR(r.torque_j.z, 0, 1e-10 * load * length);
  EXPECT_NEAR(r.tension_ratio, 1, 1e-6); // the deflection stretches it by tiny^2 / 2
  EXPECT_NEAR(r.shear_ratio, 1, 1e-10);
  const BondResponse<double> other =
      law(along<double>({length, 0, 0}),
          {{length, -tip, 0}, rotation(rotation_quaternion({0, 0, -1.5 * tiny})), {1, 0, 0, 0}});
  EXPECT_NEAR(other.torque_i.z, 0, 1e-10 * load * length);
  EXPECT_NEAR(other.tension_ratio, 1, 1e-6);
}

// A chain clamped at one end and bent by a moment at the other to half a circle, by a damped explicit run
// until damping has left some 1e-9 of its oscillations. Every bond turns by the angle whose sine is M l/EI:
// its potential is that of the half angle.
TEST(cohesive_beam, chains_bend_to_a_circle) {
  constexpr int beams = 20;
  const double thin = .3, ei = 40e9 * pi * std::pow(thin * radius, 4) / 4; // N m^2
  const double moment = pi * ei / (beams * length);
  ModelSettings settings = bonded_by_beams(40e9, .2, thin);
  settings.local_damping = .5;
  Model model(row(beams, {1, 0, 0}), settings);
  Particles &p = model.particles;
  const std::size_t clamp = row_of(p, 0), tip = row_of(p, beams);
  p.mass[clamp] = (*p.inertia)[clamp] = 1e30; // kg, kg m^2: does not move
  const double dt = .5 * model.stable_step({}, 0).limit;
  for (int s = 0; s < 800 * beams * beams; ++s)
    step(model, dt, [&](Particles &all) { (*all.torque)[tip].y -= moment; });
  const double turn = std::asin(moment * length / ei), exact = length / (2 * std::sin(turn / 2));
  EXPECT_NEAR(exact / (ei / moment), 1, 1e-2);
  for (const int k : {0, 5, 10}) { // radius of the circle through three nodes
    const Vector3 a = p.position[row_of(p, k)], b = p.position[row_of(p, k + 5)],
                  c = p.position[row_of(p, k + 10)];
    EXPECT_NEAR(norm(b - a) * norm(c - b) * norm(a - c) / (2 * norm(cross(b - a, c - a))) / exact, 1, 1e-6)
        << k;
  }
}

} // namespace
} // namespace platen::dem
