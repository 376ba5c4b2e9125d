// The beam bond against Euler and Bernoulli: the 12 x 12 matrix, the beam of finite section rotations,
// chains, and the stress at the skin.
#include "dem/laws/cohesive_beam.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <array>
#include <cmath>

#include "base/random.h"
#include "tests/dem/examples.h"
#include "tests/dem/static_solve.h"

namespace platen::dem::cohesive_beam_test {
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

struct Ends {
  Vector3 force, torque_i, torque_j;
};

// Andre et al. 2012 as mended (co-rotational, sections turn by finite angles against the chord).
Ends beam_of_finite_rotations(const Vector3 &reference, const Vector3 &d, const Quaternion &qi,
                              const Quaternion &qj) {
  const Vector3 x0 = reference / norm(reference), x = d / norm(d);
  const Vector3 any = std::abs(x0.x) < .7 ? Vector3{1, 0, 0} : Vector3{0, 1, 0};
  const Vector3 y0 = cross(x0, any) / norm(cross(x0, any));
  const double l = norm(reference);
  Vector3 phi[2], y[2];
  const Quaternion *q[] = {&qi, &qj};
  for (int k = 0; k < 2; ++k) {
    const Vector3 normal = rotate(*q[k], x0), axis = cross(x, normal);
    const double sine = norm(axis);
    phi[k] = sine > 0 ? std::atan2(sine, dot(x, normal)) / sine * axis : Vector3{};
    y[k] = rotate(rotation_quaternion(-phi[k]), rotate(*q[k], y0));
  }
  const double psi = std::atan2(dot(x, cross(y[0], y[1])), dot(y[0], y[1]));
  const double stiff = young * inertia / l, twist = twisting * length / l;
  Ends e;
  e.torque_i = twist * psi * x - 2 * stiff * (2 * phi[0] + phi[1]);
  e.torque_j = -twist * psi * x - 2 * stiff * (phi[0] + 2 * phi[1]);
  e.force = young * section * (norm(d) - l) / l * x - cross(x, e.torque_i + e.torque_j) / norm(d);
  return e;
}

// A beam in any direction, turned by anything, strained and turned at its ends by about `angle`.
struct Bent {
  Vector3 reference, d;
  Quaternion qi, qj;
};
Bent bent(Random &random, double angle) {
  Bent b;
  b.reference = length * random.uniform(.7, 1.3) * random.direction();
  const Quaternion common = rotation_quaternion(random.uniform(0, 3) * random.direction());
  b.d = rotate(common, b.reference + angle * norm(b.reference) * random.direction());
  b.qi = rotation_quaternion(angle * random.direction()) * common;
  b.qj = rotation_quaternion(angle * random.direction()) * common;
  return b;
}
BondResponse<double> respond(const CohesiveBeam &law, const Bent &b) {
  return law(along<double>(b.reference), {triple(b.d), rotation(b.qi), rotation(b.qj)});
}

// Largest difference from the paper's beam over its own largest force and torque.
double error_against_paper(double angle) {
  double worst = 0;
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const Bent b = bent(random, angle);
    const BondResponse<double> r = respond(beam(), b);
    const Ends wanted = beam_of_finite_rotations(b.reference, b.d, b.qi, b.qj);
    worst = std::max(worst, norm(vector(r.force) - wanted.force) / norm(wanted.force));
    const double torque = std::max(norm(wanted.torque_i), norm(wanted.torque_j));
    worst = std::max({worst, norm(vector(r.torque_i) - wanted.torque_i) / torque,
                      norm(vector(r.torque_j) - wanted.torque_j) / torque});
  }
  return worst;
}

TEST(cohesive_beam, is_the_beam_of_the_paper_to_first_order_in_rotation) {
  const double at_hundredth = error_against_paper(1e-2), at_thousandth = error_against_paper(1e-3),
               at_ten_thousandth = error_against_paper(1e-4);
  EXPECT_LT(at_hundredth, 5e-2);
  EXPECT_LT(at_thousandth, .2 * at_hundredth);
  EXPECT_LT(at_ten_thousandth, .2 * at_thousandth);
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

ModelSettings beams() {
  return bonded_by_beams(young, poisson, slender);
}

class BeamChain : public testing::TestWithParam<int> {};

// Exact at the nodes, whatever their number.
TEST_P(BeamChain, bends_twists_and_stretches_as_one_beam) {
  const int n = GetParam();
  const double l = n * length;
  struct Case {
    Vector3 force, torque, moved, turned;
  };
  const double p = 1e-9 * bending * length / (l * l), t = 1e-9 * bending * length / l,
               f = 1e-9 * axial * length / l;
  const double ei = bending * length, gi = twisting * length, es = axial * length;
  for (const Case &c :
       {Case{{0, p, 0}, {}, {0, p * l * l * l / (3 * ei), 0}, {0, 0, p * l * l / (2 * ei)}},
        Case{{}, {0, t, 0}, {0, 0, -t * l * l / (2 * ei)}, {0, t * l / ei, 0}},
        Case{{}, {t, 0, 0}, {}, {t * l / gi, 0, 0}}, Case{{f, 0, 0}, {}, {f * l / es, 0, 0}, {}}}) {
    Model model(row(n, {1, 0, 0}), beams());
    ASSERT_EQ(model.bonds->size(), static_cast<std::size_t>(n));
    const std::size_t clamp = row_of(model.particles, 0), tip = row_of(model.particles, n);
    const Vector3 before = model.particles.position[tip];
    solve_statics(model, {clamp}, {{tip, c.force, c.torque}}, length, 1e-6);
    const Vector3 moved = model.particles.position[tip] - before;
    const Quaternion &q = (*model.particles.orientation)[tip];
    const Vector3 turned = 2 * Vector3{q.x, q.y, q.z};
    const double size = norm(c.moved) > 0 ? norm(c.moved) : l * norm(c.turned);
    EXPECT_LT(norm(moved - c.moved), 2e-9 * size + 4e-16 * l) << n;
    EXPECT_LT(norm(turned - c.turned) * l, 2e-9 * size + 4e-16 * l) << n;
  }
}

INSTANTIATE_TEST_SUITE_P(cohesive_beam, BeamChain, testing::Values(1, 2, 5));

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

// Explicit steps neither make nor lose energy, and the time step knows the beams.
TEST(cohesive_beam, a_free_packing_of_beams_keeps_its_energy) {
  Model model(packed_box(8, 8, 8), beams());
  Random random(4);
  for (std::size_t i = 0; i < model.particles.size(); ++i) {
    model.particles.velocity[i] = .1 * random.direction();
    (*model.particles.angular_velocity)[i] = .1 / radius * random.direction();
  }
  const double dt = .3 * model.stable_step({}, 0).limit;
  const auto total = [&] {
    const EnergyLedger e = model.energy();
    return e.kinetic + e.bonds;
  };
  step(model, dt);
  const double before = total();
  double largest = 0;
  for (int s = 0; s < 3000; ++s) {
    step(model, dt);
    largest = std::max(largest, std::abs(total() - before));
  }
  EXPECT_LT(largest, 2e-2 * before); // of second order in the step, and bounded
}

} // namespace
} // namespace platen::dem::cohesive_beam_test
