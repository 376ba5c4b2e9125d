// Forces, pressure, explicit steps and state of a solid at finite strain.
#include "fem/hyperelastic_solid.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <sstream>

#include "fem/threads.h"

namespace platen::fem {
namespace {

const Rubber rubber{1100, NeoHookean::from_young(3e6, 0.49)};

HyperelasticSolid sleeve(const Rubber &material = rubber, const std::vector<int> &contact = {inner_tag}) {
  return HyperelasticSolid(make_grid(Tube{0.05, 0.005, 0.0, 0.06, 16, 6, 2}), material, contact);
}

std::vector<Point> random_field(std::size_t nodes, double size, unsigned seed = 3) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> spread(-size, size);
  std::vector<Point> field(nodes);
  for (Point &p : field)
    p = {spread(engine), spread(engine), spread(engine)};
  return field;
}

// A smooth field as large as the wall is thick.
std::vector<Point> bent(const HyperelasticSolid &solid, double size = 0.005) {
  std::vector<Point> field;
  for (const Point &x : solid.mesh().nodes)
    field.push_back({size * std::sin(40 * x[1] + 20 * x[2]), size * std::cos(30 * x[2] + 10 * x[0]),
                     size * std::sin(30 * x[0])});
  return field;
}

Point turned(const Point &p) { // 2.3 rad about (2, 3, 6)/7
  const Point axis = {2.0 / 7, 3.0 / 7, 6.0 / 7};
  const double c = std::cos(2.3), s = std::sin(2.3);
  return c * p + s * cross(axis, p) + (1 - c) * dot(axis, p) * axis;
}

double largest(const std::vector<Point> &field) {
  double most = 0;
  for (const Point &p : field)
    most = std::max(most, norm(p));
  return most;
}

std::vector<Point> turned_places(const HyperelasticSolid &solid, const std::vector<Point> &displacement) {
  std::vector<Point> moved = displacement;
  for (std::size_t n = 0; n < moved.size(); ++n)
    moved[n] = turned(solid.mesh().nodes[n] + displacement[n]) - solid.mesh().nodes[n];
  return moved;
}

TEST(hyperelastic_solid, mass_is_density_times_volume) {
  const HyperelasticSolid solid = sleeve();
  const double volume = 8 * std::sin(M_PI / 8) * (0.055 * 0.055 - 0.05 * 0.05) * 0.06;
  EXPECT_NEAR(solid.volume(), volume, 1e-13 * volume);
  double sum = 0;
  for (const double m : solid.nodal_mass())
    sum += m;
  EXPECT_NEAR(sum, 1100 * volume, 1e-13 * 1100 * volume);
}

// Energy in mu V: round-off of 1 - 1; forces in mu A: the bulk modulus is 50 mu.
TEST(hyperelastic_solid, a_rotation_by_any_angle_stores_nothing) {
  HyperelasticSolid solid = sleeve();
  solid.set_displacement(turned_places(solid, std::vector<Point>(solid.mesh().nodes.size())));
  const double mu = rubber.law.shear_modulus;
  EXPECT_LT(std::abs(solid.internal_energy()), 1e-14 * mu * solid.volume());
  EXPECT_LT(largest(solid.internal_forces()), 1e-12 * mu * 1e-4);
}

TEST(hyperelastic_solid, forces_and_pressure_turn_with_the_solid) {
  HyperelasticSolid solid = sleeve();
  solid.set_pressure(mantle_tag, 1e5);
  solid.set_displacement(bent(solid));
  const std::vector<Point> inner = solid.internal_forces(), pressed = solid.pressure_forces();
  const double energy = solid.internal_energy(), size = largest(inner);
  solid.set_displacement(turned_places(solid, bent(solid)));
  EXPECT_NEAR(solid.internal_energy(), energy, 1e-12 * energy);
  for (std::size_t n = 0; n < inner.size(); ++n) {
    EXPECT_LT(norm(solid.internal_forces()[n] - turned(inner[n])), 1e-11 * size);
    EXPECT_LT(norm(solid.pressure_forces()[n] - turned(pressed[n])), 1e-11 * size);
  }
}

TEST(hyperelastic_solid, internal_forces_have_no_sum_and_no_moment) {
  HyperelasticSolid solid = sleeve();
  solid.set_displacement(bent(solid));
  Point sum{}, moment{};
  double forces = 0;
  for (std::size_t n = 0; n < solid.mesh().nodes.size(); ++n) {
    const Point f = solid.internal_forces()[n];
    sum = sum + f, moment = moment + cross(solid.node_place(static_cast<int>(n)), f);
    forces += norm(f);
  }
  EXPECT_LT(norm(sum), 1e-13 * forces);
  EXPECT_LT(norm(moment), 1e-13 * forces * 0.08);
}

TEST(hyperelastic_solid, the_tangent_with_pressure_is_the_slope_of_the_forces) {
  HyperelasticSolid solid = sleeve();
  solid.set_pressure(mantle_tag, 2e6), solid.set_pressure(inner_tag, 5e5);
  const std::vector<Point> u = bent(solid, 0.002), d = random_field(u.size(), 1);
  solid.set_displacement(u);
  const std::vector<Point> k = solid.stiffness_times(d);
  const double h = 1e-8, size = largest(k);
  const auto forces = [&](double step) {
    std::vector<Point> place = u;
    for (std::size_t n = 0; n < u.size(); ++n)
      place[n] = u[n] + step * d[n];
    solid.set_displacement(place);
    std::vector<Point> f = solid.internal_forces();
    for (std::size_t n = 0; n < f.size(); ++n)
      f[n] = f[n] - solid.pressure_forces()[n];
    return f;
  };
  const std::vector<Point> up = forces(h), down = forces(-h);
  for (std::size_t n = 0; n < u.size(); ++n)
    EXPECT_LT(norm(k[n] - (0.5 / h) * (up[n] - down[n])), 1e-6 * size);
}

double current_volume(const HyperelasticSolid &solid) {
  double volume = 0;
  const std::vector<CellStress> cells = solid.cell_stresses();
  for (std::size_t c = 0; c < cells.size(); ++c)
    volume += solid.mesh().cells[c].volume * cells[c].volume_ratio;
  return volume;
}

// All four sides pressed alike: the surface is closed.
HyperelasticSolid pressed_all_around(double pressure) {
  HyperelasticSolid solid = sleeve();
  for (const int tag : {mantle_tag, inner_tag, low_end_tag, high_end_tag})
    solid.set_pressure(tag, pressure);
  solid.update_forces();
  return solid;
}

TEST(hyperelastic_solid, pressure_on_a_closed_deformed_surface_sums_to_zero) {
  HyperelasticSolid solid = pressed_all_around(1e6);
  solid.set_displacement(bent(solid));
  Point sum{}, moment{};
  double forces = 0;
  for (std::size_t n = 0; n < solid.mesh().nodes.size(); ++n) {
    const Point f = solid.pressure_forces()[n];
    sum = sum + f, moment = moment + cross(solid.node_place(static_cast<int>(n)), f);
    forces += norm(f);
  }
  EXPECT_LT(norm(sum), 1e-14 * forces);
  EXPECT_LT(norm(moment), 1e-14 * forces * 0.08);
  Point sides{};
  for (const int tag : {mantle_tag, inner_tag, low_end_tag, high_end_tag})
    sides = sides + solid.pressure_force(tag);
  EXPECT_LT(norm(sides), 1e-14 * forces);
}

// Work of the drifts = -p (V after - V before), V from the cells: another integral of the same trilinear
// geometry. Exact for one long drift, where the trapezoidal rule is off by percents.
TEST(hyperelastic_solid, pressure_does_the_work_p_dv) {
  const double p = 1e6;
  HyperelasticSolid solid = pressed_all_around(p);
  const double before = current_volume(solid);
  solid.set_velocity(bent(solid));
  solid.drift(1);
  const double first = current_volume(solid);
  EXPECT_GT(std::abs(first - before), 1e-3 * before);
  EXPECT_NEAR(solid.pressure_work(), -p * (first - before), 1e-10 * p * std::abs(first - before));
  for (int step = 0; step < 50; ++step)
    solid.drift(-0.013);
  const double last = current_volume(solid);
  EXPECT_NEAR(solid.pressure_work(), -p * (last - before), 1e-10 * p * std::abs(first - before));
}

// On the inner face alone, ends in their planes: the same with the volume inside the tube.
TEST(hyperelastic_solid, pressure_inside_a_tube_does_the_work_of_its_lumen) {
  HyperelasticSolid solid = sleeve();
  const double share = 8 * std::sin(M_PI / 8);
  EXPECT_NEAR(solid.enclosed_volume(inner_tag), share * 0.05 * 0.05 * 0.06, 1e-17);
  EXPECT_NEAR(solid.enclosed_volume(mantle_tag), share * 0.055 * 0.055 * 0.06, 1e-17);
  solid.set_pressure(inner_tag, 1e5);
  solid.update_forces();
  std::vector<Point> v = bent(solid);
  for (std::size_t n = 0; n < v.size(); ++n) {
    const double z = solid.mesh().nodes[n][2];
    if (z < 1e-9 || z > 0.06 - 1e-9) v[n][2] = 0;
  }
  solid.set_velocity(v);
  const double before = solid.enclosed_volume(inner_tag);
  solid.drift(1);
  const double change = solid.enclosed_volume(inner_tag) - before;
  EXPECT_NEAR(solid.pressure_work(), 1e5 * change, 1e-10 * 1e5 * std::abs(change));
}

// Largest eigenvalue of M^-1 K by Lanczos with full orthogonalisation; from below, so that the step from it
// is an upper bound of the true one.
double lanczos(const HyperelasticSolid &solid, int steps) {
  const std::size_t nodes = solid.mesh().nodes.size();
  const auto count = static_cast<Eigen::Index>(3 * nodes);
  const auto apply = [&](const Eigen::VectorXd &x) {
    std::vector<Point> d(nodes);
    for (std::size_t n = 0; n < nodes; ++n)
      for (std::size_t k = 0; k < 3; ++k)
        d[n][k] = x[static_cast<Eigen::Index>(3 * n + k)] / std::sqrt(solid.nodal_mass()[n]);
    const std::vector<Point> f = solid.stiffness_times(d);
    Eigen::VectorXd y(count);
    for (std::size_t n = 0; n < nodes; ++n)
      for (std::size_t k = 0; k < 3; ++k)
        y[static_cast<Eigen::Index>(3 * n + k)] = f[n][k] / std::sqrt(solid.nodal_mass()[n]);
    return y;
  };
  Eigen::MatrixXd basis(count, steps), small = Eigen::MatrixXd::Zero(steps, steps);
  Eigen::VectorXd v(count);
  for (Eigen::Index k = 0; k < count; ++k)
    v[k] = std::sin(1.0 + 12.9898 * static_cast<double>(k * k % 1009));
  v.normalize();
  for (int s = 0; s < steps; ++s) {
    basis.col(s) = v;
    Eigen::VectorXd w = apply(v);
    small(s, s) = v.dot(w);
    for (int again = 0; again < 2; ++again)
      w -= basis.leftCols(s + 1) * (basis.leftCols(s + 1).transpose() * w);
    const double beta = w.norm();
    if (s + 1 < steps) small(s, s + 1) = small(s + 1, s) = beta;
    v = w / beta;
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(small).eigenvalues()[steps - 1];
}

TEST(hyperelastic_solid, the_stable_step_is_below_that_of_lanczos) {
  for (const double poisson : {0.3, 0.49, 0.4995}) {
    HyperelasticSolid solid = sleeve({1100, NeoHookean::from_young(3e6, poisson)});
    for (const double size : {0.0, 0.003}) {
      solid.set_displacement(bent(solid, size));
      const double limit = 2 / std::sqrt(lanczos(solid, 60));
      EXPECT_LT(solid.stable_step(), limit * (1 + 1e-6));
      EXPECT_GT(solid.stable_step(), 0.75 * limit);
    }
  }
}

// Blown up from inside with its ends held; rings as it is let go. (From outside it would buckle at 7 kPa.)
HyperelasticSolid held_sleeve(double pressure, double poisson = 0.45) {
  HyperelasticSolid solid = sleeve({1100, NeoHookean::from_young(3e6, poisson)});
  solid.lead(solid.nodes_of(low_end_tag), {true, true, true});
  solid.lead(solid.nodes_of(high_end_tag), {true, true, true});
  solid.set_pressure(inner_tag, pressure);
  solid.update_forces();
  return solid;
}

void step(HyperelasticSolid &solid, double dt, int steps) {
  for (int k = 0; k < steps; ++k) {
    solid.half_kick(dt);
    solid.drift(dt);
    solid.update_forces();
    solid.half_kick(dt);
  }
}

double imbalance(const HyperelasticSolid &solid) {
  return solid.kinetic_energy() + solid.internal_energy() + solid.damping_work() - solid.pressure_work() -
         solid.lead_work();
}

// Energy of motion and strain = works. Velocity Verlet keeps a neighbour of the energy: the difference swings
// with dt^2 and does not grow. The upper end is led up and down, so all books are in use.
TEST(hyperelastic_solid, an_explicit_vibration_closes_its_energy_book) {
  double worst[2] = {0, 0}, book = 0;
  for (const int fine : {0, 1}) {
    HyperelasticSolid solid = held_sleeve(2e4);
    solid.set_damping(50);
    const double dt = 0.4 * solid.stable_step() / (1 + fine);
    for (int k = 0; k < 300 * (1 + fine); ++k) {
      solid.set_lead_velocity(1, {0, 0, -0.5 * std::sin(2e3 * k * dt)});
      step(solid, dt, 1);
      worst[fine] = std::max(worst[fine], std::abs(imbalance(solid)));
    }
    book = std::abs(solid.pressure_work()) + std::abs(solid.lead_work());
    EXPECT_GT(std::abs(solid.lead_work()), 0.01 * book);
    EXPECT_GT(solid.damping_work(), 0.001 * book);
  }
  EXPECT_LT(worst[0], 0.01 * book);
  EXPECT_NEAR(worst[0] / worst[1], 4, 1.5); // second order
}

TEST(hyperelastic_solid, steps_below_the_limit_stay_bounded_and_above_it_do_not) {
  const double limit = 2 / std::sqrt(lanczos(held_sleeve(0), 60));
  HyperelasticSolid calm = held_sleeve(2e3), wild = held_sleeve(2e3);
  const double dt = calm.stable_step();
  double energy = 0, work = 0;
  for (int k = 0; k < 2000; ++k) {
    step(calm, dt, 1);
    energy = std::max(energy, calm.kinetic_energy() + calm.internal_energy());
    work = std::max(work, calm.pressure_work());
  }
  EXPECT_LT(energy, 2 * work);
  EXPECT_THROW(step(wild, 1.2 * limit, 2000), InvertedElement);
}

TEST(hyperelastic_solid, damped_steps_come_to_rest_where_newton_does) {
  HyperelasticSolid explicit_one = held_sleeve(2e4), implicit = held_sleeve(0);
  explicit_one.set_damping(800);
  step(explicit_one, 0.9 * explicit_one.stable_step(), 6000);
  implicit.solve({{{inner_tag, 2e4}}, {}});
  const double size = largest(implicit.displacement());
  EXPECT_GT(size, 1e-4);
  for (std::size_t n = 0; n < implicit.displacement().size(); ++n)
    EXPECT_LT(norm(explicit_one.displacement()[n] - implicit.displacement()[n]), 1e-6 * size);
}

TEST(hyperelastic_solid, an_inverted_element_is_found_before_it_is_used) {
  HyperelasticSolid solid = held_sleeve(2e4);
  step(solid, 0.9 * solid.stable_step(), 20);
  const std::vector<double> before = solid.state();
  std::vector<Point> v = solid.velocity();
  const int node = solid.mesh().cell_nodes[37][6];
  v[static_cast<std::size_t>(node)] = {0, 0, -100};
  solid.set_velocity(v);
  const std::vector<double> state = solid.state();
  try {
    solid.drift(1e-3); // 10 cm through cells of 1 cm
    FAIL() << "an inverted element was used";
  } catch (const InvertedElement &error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("cell " + std::to_string(error.cell) + " at ("), std::string::npos) << text;
    EXPECT_NE(text.find("pressure 20000 Pa on side 6"), std::string::npos) << text;
    EXPECT_LE(error.volume_ratio, inverted_share);
    const auto &nodes = solid.mesh().cell_nodes[static_cast<std::size_t>(error.cell)];
    EXPECT_NE(std::find(nodes.begin(), nodes.end(), node), nodes.end());
  }
  EXPECT_EQ(solid.state(), state); // nothing has moved
  solid.set_state(before);
  step(solid, 0.5 * solid.stable_step(), 5); // and it goes on from there
}

bool same(const std::vector<Point> &a, const std::vector<Point> &b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Point)) == 0;
}

TEST(hyperelastic_solid, a_resumed_run_is_the_same_to_the_last_bit) {
  HyperelasticSolid one = held_sleeve(2e4), other = held_sleeve(0);
  one.set_damping(50), other.set_damping(50);
  const double dt = 0.5 * one.stable_step();
  one.set_lead_velocity(1, {0, 0, -0.3}, {0.1, 0.2, 5}, {0, 0, 0.06});
  step(one, dt, 40);
  one.add_surface_force(3, {1, -2, 0.5});
  step(one, dt, 7);
  other.set_state(one.state());
  EXPECT_EQ(other.state(), one.state());
  EXPECT_TRUE(same(one.surface().vertices, other.surface().vertices));
  EXPECT_TRUE(same(one.surface().velocities, other.surface().velocities));
  step(one, dt, 40), step(other, dt, 40);
  EXPECT_EQ(other.state(), one.state());
  EXPECT_EQ(one.internal_energy(), other.internal_energy());
  EXPECT_THROW(other.set_state({1, 2, 3}), std::invalid_argument);
}

TEST(hyperelastic_solid, the_number_of_threads_changes_no_bit) {
  std::vector<double> state[2];
  double energy[2], limit[2];
  for (const int threads : {1, 2}) {
    limit_threads(threads);
    HyperelasticSolid solid = held_sleeve(2e4);
    limit[threads - 1] = solid.stable_step();
    step(solid, 0.5 * limit[threads - 1], 50);
    solid.solve({{{inner_tag, 3e4}}, {}});
    state[threads - 1] = solid.state(), energy[threads - 1] = solid.internal_energy();
  }
  limit_threads(0);
  EXPECT_EQ(state[0], state[1]);
  EXPECT_EQ(energy[0], energy[1]);
  EXPECT_EQ(limit[0], limit[1]);
}

// Only the inner face is seen, and it looks at the axis; loads come back as tractions.
TEST(hyperelastic_solid, particles_see_the_inner_face_alone) {
  HyperelasticSolid solid = sleeve();
  const SurfaceMesh &surface = solid.surface();
  EXPECT_EQ(surface.faces.size(), 16u * 6);
  EXPECT_EQ(surface.vertices.size(), 16u * 7);
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const Point at = surface.vertices[static_cast<std::size_t>(surface.faces[f][0])],
                area = face_area_vector(surface, f);
    EXPECT_EQ(surface.face_tags[f], inner_tag);
    EXPECT_LT(at[0] * area[0] + at[1] * area[1], 0);
    for (const int v : surface.faces[f])
      solid.add_surface_force(v, -0.25 * 7e4 * area);
  }
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    EXPECT_LT(norm(surface.vertices[v] - solid.node_place(solid.surface_node(static_cast<int>(v)))), 1e-18);
    EXPECT_NEAR(solid.contact_tractions()[v].pressure, 7e4, 1e-8);
    EXPECT_LT(norm(solid.contact_tractions()[v].shear), 1e-8);
  }
  EXPECT_LT(norm(solid.total_force()), 1e-11);
  EXPECT_LT(norm(solid.moment({1, 2, 3})), 1e-11);
  solid.set_velocity(std::vector<Point>(solid.mesh().nodes.size(), Point{0, 0, 2}));
  EXPECT_EQ(surface.velocities[5], (Point{0, 0, 2}));
  EXPECT_EQ(solid.largest_move(0.5), 1);
  EXPECT_THROW(sleeve(rubber, {77}), std::invalid_argument);
}

TEST(hyperelastic_solid, senseless_requests_are_refused) {
  HyperelasticSolid solid = sleeve();
  const std::vector<int> end = solid.nodes_of(low_end_tag);
  solid.lead(end, {false, false, true});
  EXPECT_THROW(solid.lead(end, {true, true, true}), std::invalid_argument);
  EXPECT_EQ(solid.lead(end, {true, true, false}), 1);
  EXPECT_THROW(solid.lead({}, {true, true, true}), std::invalid_argument);
  EXPECT_THROW(solid.set_pressure(3, 1e5), std::invalid_argument);
  EXPECT_THROW(solid.set_pressure(mantle_tag, std::nan("")), std::invalid_argument);
  EXPECT_THROW(solid.set_lead_velocity(2, {}), std::invalid_argument);
  EXPECT_THROW(solid.set_damping(-1), std::invalid_argument);
  EXPECT_THROW(sleeve({0, rubber.law}), std::invalid_argument);
  EXPECT_THROW(sleeve({1100, {1e6, -1}}), std::invalid_argument);
}

TEST(hyperelastic_solid, the_picture_names_its_fields_and_repeats) {
  HyperelasticSolid solid = sleeve();
  solid.set_displacement(bent(solid));
  std::ostringstream first, second;
  solid.write_vtu(first);
  solid.write_vtu(second, std::vector<double>(solid.surface().vertices.size(), 0.0));
  for (const char *field : {"\"displacement\"", "\"stress\"", "\"von_mises\"", "\"pressure\"", "\"J\"",
                            "\"contact_pressure\"", "\"contact_shear\"", "\"slip\"", "compressor=\"vtkZLib"})
    EXPECT_NE(first.str().find(field), std::string::npos) << field;
  EXPECT_EQ(first.str(), second.str());
  EXPECT_THROW(solid.write_vtu(first, {1.0}), std::invalid_argument);
}

} // namespace
} // namespace platen::fem
