// A pressure on the skin: the surface that it acts on is closed, has the specimen's area, and is that of the
// specimen as it is now.
#include "dem/confinement.h"
#include "base/pi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>

#include "base/parallel.h"
#include "dem/packing/growth.h"
#include "tests/dem/examples.h"
#include "tests/same_state.h"

namespace platen::dem::confinement_test {
namespace {

using examples::break_rows_where;

BondLayout layout() {
  BondLayout l;
  l.modulus = 36e9;
  l.gap.value = 0.05;
  return l;
}

struct Body {
  Specimen specimen;
  Particles particles;
  Bonds bonds;
  explicit Body(const Specimen &s)
      : specimen(s),
        particles(s, 2400, true),
        bonds(particles, layout(), ParallelBond::Parameters{0.4, 10e6, 30e6, 0.7853981633974483, 0.3}) {}
  EndPlanes planes() const { return {0, specimen.shape.height}; }
  Confinement confinement(ConfinementArea kind = ConfinementArea::voronoi) const {
    return Confinement(particles, &bonds, specimen.shape, planes(), kind);
  }
};

const Specimen &packed_cylinder() {
  static const Specimen s = random_close_packing(cylinder(10e-3, 25e-3), 1e-3, 0.25, 4);
  return s;
}
Specimen packed_box() {
  return random_close_packing(box(16e-3, 20e-3, 20e-3), 1e-3, 0.25, 4);
}

void press(Confinement &c, Body &body, double pressure, double dt, double distance, bool due) {
  c.update(body.particles, &body.bonds, body.planes(), dt, distance, due);
  c.add_forces(body.particles, pressure, dt);
}

Vector3 sum_of_areas(const Confinement &c) {
  Vector3 sum;
  for (std::size_t k = 0; k < c.size(); ++k)
    sum += c.area(k);
  return sum;
}
double total_area(const Confinement &c) {
  double sum = 0;
  for (std::size_t k = 0; k < c.size(); ++k)
    sum += norm(c.area(k));
  return sum;
}

TEST(confinement, a_uniform_pressure_has_neither_force_nor_moment) {
  for (const Specimen &s : {packed_cylinder(), packed_box()})
    for (const ConfinementArea kind : {ConfinementArea::voronoi, ConfinementArea::sphere}) {
      const Body body(s);
      const Confinement c = body.confinement(kind);
      Vector3 moment;
      for (std::size_t k = 0; k < c.size(); ++k)
        moment += cross(body.particles.position[c.particle(k)], c.area(k));
      // Round-off of some hundred terms.
      EXPECT_LT(norm(sum_of_areas(c)), 1e-13 * total_area(c));
      EXPECT_LT(norm(moment), 1e-13 * total_area(c) * s.shape.height);
    }
}

// Before it is balanced: the diagram's own surface is closed but for the 32 faces that stand for a ball.
TEST(confinement, the_diagrams_surface_is_nearly_closed_by_itself) {
  const Body body(packed_cylinder());
  Skin skin = find_skin(body.particles, std::vector<char>(body.particles.size(), 1), body.planes());
  EXPECT_LT(balance(skin, body.particles), 0.01);
}

TEST(confinement, voronoi_areas_are_those_of_the_shape) {
  const Body round(packed_cylinder());
  const Confinement c = round.confinement();
  double radial = 0, halves[2] = {0, 0}, upper = 0;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Vector3 x = round.particles.position[c.particle(k)], a = c.area(k);
    const double outward = (a.x * x.x + a.y * x.y) / std::hypot(x.x, x.y);
    radial += outward;
    halves[x.x > 0] += a.x;
    if (x.z > 0.5 * round.specimen.shape.height) upper += outward;
  }
  const double area = 2 * pi * 10e-3 * 25e-3;
  EXPECT_NEAR(radial / area, 1, 0.01);
  EXPECT_NEAR(c.coverage(round.particles, round.planes()), 1, 0.01);
  // What a section through the axis has to carry: the projected area, 2 r h; 3 % for the spheres that it
  // cuts.
  EXPECT_NEAR(halves[1] / (20e-3 * 25e-3), 1, 0.03);
  EXPECT_NEAR(-halves[0] / (20e-3 * 25e-3), 1, 0.03);
  EXPECT_NEAR(upper / area, 0.5, 0.02); // no end is favoured
  // The diagram needs little mending: the balls' own surface is larger because it lies further out.
  EXPECT_GT(c.factor(), 0.85);
  EXPECT_LT(c.factor(), 1.0);

  const Body square(packed_box());
  const Confinement b = square.confinement();
  double face_x = 0, face_y = 0;
  for (std::size_t k = 0; k < b.size(); ++k) {
    const Vector3 x = square.particles.position[b.particle(k)];
    if (x.x > 0) face_x += b.area(k).x;
    if (x.y > 0) face_y += b.area(k).y;
  }
  EXPECT_NEAR(face_x / (20e-3 * 20e-3), 1, 0.04);
  EXPECT_NEAR(face_y / (16e-3 * 20e-3), 1, 0.04);
}

// One factor for all: faces get nearly what is theirs; the ends, where the planes cut the skin, a little
// less, and what lies between them that much more: of eight packings 0.9916 and 1.0058, each within 0.01 and
// 0.004 of that.
TEST(confinement, a_box_is_pressed_evenly_over_faces_and_within_percents_along_its_height) {
  const double x = 16e-3, y = 14e-3, height = 18e-3;
  constexpr unsigned packings = 4;
  double ends = 0, middle = 0; // over the nominal areas, means of the packings
  for (unsigned seed = 1; seed <= packings; ++seed) {
    const Body body(random_close_packing(box(x, y, height), 0.5e-3, 0.25, seed));
    const Confinement c = body.confinement();
    double on_x = 0, on_y = 0;
    for (std::size_t k = 0; k < c.size(); ++k) {
      const Vector3 at = body.particles.position[c.particle(k)], a = c.area(k);
      const double along_x = std::copysign(1, at.x) * a.x / (2 * y * height),
                   along_y = std::copysign(1, at.y) * a.y / (2 * x * height);
      on_x += along_x, on_y += along_y;
      (std::abs(at.z - height / 2) > height / 3 ? ends : middle) += 0.5 * (along_x + along_y) / packings;
    }
    EXPECT_NEAR(on_x, 1, 0.006) << "packing " << seed;
    EXPECT_NEAR(on_y, 1, 0.006) << "packing " << seed;
  }
  EXPECT_NEAR(middle / (2. / 3), 1.0058, 0.005);
  EXPECT_NEAR(ends / (1. / 3), 0.9916, 0.01);
}

TEST(confinement, the_skin_is_at_the_surface) {
  const Body body(packed_cylinder());
  const Confinement c = body.confinement();
  std::set<int> skin;
  for (std::size_t k = 0; k < c.size(); ++k) {
    skin.insert(c.particle(k));
    const Vector3 x = body.particles.position[c.particle(k)];
    EXPECT_GT(std::hypot(x.x, x.y), 10e-3 - 4e-3) << "a pore inside is taken for the outside";
  }
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const Vector3 x = body.particles.position[i];
    const bool at_wall = std::hypot(x.x, x.y) > 10e-3 - 1.05 * body.particles.radius[i];
    EXPECT_TRUE(!at_wall || skin.count(static_cast<int>(i)) == 1) << i;
  }
}

TEST(confinement, areas_follow_the_deformed_surface) {
  Body body(packed_cylinder());
  Confinement c = body.confinement();
  // Centres move outwards by a tenth; the surface lies a ball of 2 R beyond the outermost, which does not
  // grow.
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    body.particles.position[i].x *= 1.1;
    body.particles.position[i].y *= 1.1;
  }
  press(c, body, 0, 0, 1e-3, true);
  const double r = 10e-3, sphere = 1e-3, expected = (1.1 * (r - sphere) + 2 * sphere) / (r + sphere);
  EXPECT_NEAR(c.coverage(body.particles, body.planes()), expected, 0.01);
}

TEST(confinement, what_has_come_loose_carries_nothing_and_bares_what_lies_beneath) {
  Body body(packed_cylinder());
  Confinement c = body.confinement();
  const int loose = c.particle(c.size() / 2);
  const double before = c.coverage(body.particles, body.planes());
  std::set<int> skin;
  for (std::size_t k = 0; k < c.size(); ++k)
    skin.insert(c.particle(k));
  ASSERT_GT(break_rows_where(
                body.bonds, body.particles,
                [&](std::size_t k) { return body.bonds.first[k] == loose || body.bonds.second[k] == loose; }),
            0u);
  press(c, body, 1e6, 0, 0, false);
  EXPECT_GT(norm(body.particles.force[loose]), 0) << "areas have not been updated yet";
  for (Vector3 &f : body.particles.force)
    f = {};
  press(c, body, 1e6, 0, 0, true);
  EXPECT_EQ(norm(body.particles.force[loose]), 0);
  EXPECT_NEAR(c.coverage(body.particles, body.planes()), before, 0.01); // its share has gone to others
  // Ejected, far away, it changes nothing more.
  const std::size_t size = c.size();
  body.particles.position[loose] += {0.1, 0, 0};
  press(c, body, 1e6, 0, 1e-3, true);
  EXPECT_EQ(c.size(), size);
}

void crumble(Body &body, const std::function<bool(int)> &loose) {
  break_rows_where(body.bonds, body.particles,
                   [&](std::size_t k) { return loose(body.bonds.first[k]) || loose(body.bonds.second[k]); });
}

// Pa, of the forces towards the axis over the nominal area of the mantle.
double mean_pressure(const Body &body) {
  double sum = 0;
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const Vector3 x = body.particles.position[i], f = body.particles.force[i];
    sum -= (f.x * x.x + f.y * x.y) / std::hypot(x.x, x.y);
  }
  return sum / (2 * pi * 10e-3 * 25e-3);
}

TEST(confinement, what_crumbles_takes_its_share_of_the_pressure_along) {
  for (const ConfinementArea kind : {ConfinementArea::voronoi, ConfinementArea::sphere})
    for (const double sound : {1.0, 0.6, 0.0}) { // of the height, from below
      Body body(packed_cylinder());
      Confinement c = body.confinement(kind);
      EXPECT_EQ(c.loaded_fraction(), 1);
      const double start = c.coverage(body.particles, body.planes());
      crumble(body, [&](int i) { return body.particles.position[i].z > sound * 25e-3; });
      press(c, body, 3e6, 0, 0, true);
      // Where the sound part ends it has a face of its own, whose spheres bear on the mantle too.
      EXPECT_NEAR(c.loaded_fraction(), sound, sound == 0.6 ? 0.05 : 0) << start;
      EXPECT_EQ(c.pressure(), 3e6 * c.loaded_fraction());
      EXPECT_NEAR(c.pressure() * start / 3e6, mean_pressure(body) / 3e6, 0.01) << sound;
    }
}

// A specimen that is whole has the pressure that it was given, however it has changed its width; one that has
// lost a sphere is counted from its width then.
TEST(confinement, only_what_has_come_loose_takes_from_the_pressure) {
  Body body(packed_cylinder());
  Confinement c = body.confinement();
  const auto widen = [&](double factor) {
    for (std::size_t i = 0; i < body.particles.size(); ++i)
      body.particles.position[i].x *= factor, body.particles.position[i].y *= factor;
    press(c, body, 3e6, 0, 1e-3, true);
  };
  widen(0.9);
  EXPECT_LT(c.coverage(body.particles, body.planes()), 0.95);
  EXPECT_EQ(c.loaded_fraction(), 1);
  EXPECT_EQ(c.pressure(), 3e6);
  const int loose = c.particle(c.size() / 2);
  crumble(body, [&](int i) { return i == loose; });
  press(c, body, 3e6, 0, 0, true);
  EXPECT_NEAR(c.loaded_fraction(), 1, 0.01);
  widen(1.2);
  EXPECT_EQ(c.loaded_fraction(), 1) << "no more than the whole is loaded";
  widen(0.8);
  EXPECT_LT(c.loaded_fraction(), 1);
  Confinement read = Body(packed_cylinder()).confinement();
  set_state(read, state_of(c));
  EXPECT_TRUE(same_state(read, c));
  EXPECT_EQ(read.pressure(), c.pressure());
}

// A lump at the mantle, cut from the rest where it stands: from a twentieth of the spheres on it is a body.
TEST(confinement, a_piece_is_pressed_from_a_twentieth_of_the_spheres_on) {
  for (const double share : {0.035, 0.07}) {
    Body body(packed_cylinder());
    Confinement c = body.confinement();
    const Vector3 at = body.particles.position[c.particle(c.size() / 2)];
    const auto far = [&](int i) { return norm(body.particles.position[i] - at); };
    std::vector<int> by_distance(body.particles.size());
    std::iota(by_distance.begin(), by_distance.end(), 0);
    std::sort(by_distance.begin(), by_distance.end(), [&](int a, int b) { return far(a) < far(b); });
    const auto count = static_cast<std::ptrdiff_t>(share * static_cast<double>(by_distance.size()));
    const std::set<int> lump(by_distance.begin(), by_distance.begin() + count);
    break_rows_where(body.bonds, body.particles, [&](std::size_t k) {
      return lump.count(body.bonds.first[k]) != lump.count(body.bonds.second[k]);
    });
    press(c, body, 3e6, 0, 0, true);
    int pressed = 0;
    for (std::size_t k = 0; k < c.size(); ++k)
      pressed += static_cast<int>(lump.count(c.particle(k)));
    EXPECT_EQ(pressed > 0, share > 0.05) << pressed << " of " << count;
  }
}

TEST(confinement, a_specimen_without_lateral_spheres_is_refused) {
  for (const ConfinementArea kind : {ConfinementArea::voronoi, ConfinementArea::sphere}) {
    Body body(packed_cylinder());
    crumble(body, [](int) { return true; });
    EXPECT_THROW(body.confinement(kind), std::invalid_argument);
  }
}

// Cut through along its axis: both halves are bodies, and the flaw between them is too narrow for the cell.
// Drawn apart, each has a skin of its own all round, so that the pressure holds none of them to one side.
TEST(confinement, two_large_pieces_are_both_pressed_and_pushed_nowhere) {
  for (const Specimen &s : {packed_cylinder(), packed_box()})
    for (const double opening : {0.0, 0.3e-3, 12e-3}) { // m; sphere radius 1 mm
      Body body(s);
      Confinement c = body.confinement();
      const auto right = [&](int i) { return body.particles.reference_position[i].x > 0; };
      break_rows_where(body.bonds, body.particles, [&](std::size_t k) {
        return right(body.bonds.first[k]) != right(body.bonds.second[k]);
      });
      for (std::size_t i = 0; i < body.particles.size(); ++i)
        body.particles.position[i].x += (right(static_cast<int>(i)) ? .5 : -.5) * opening;
      const double p = 1e6;
      press(c, body, p, 0, 0, true);
      Vector3 all, piece[2], outer[2]; // outer: of spheres far from the cut
      for (std::size_t i = 0; i < body.particles.size(); ++i) {
        const int side = right(static_cast<int>(i)) ? 1 : 0;
        const Vector3 f = body.particles.force[i];
        all += f, piece[side] += f;
        if (std::abs(body.particles.reference_position[i].x) > 4e-3) outer[side] += f;
      }
      const double section = p * 20e-3 * s.shape.height; // N, on the plane of the cut; both are 20 mm wide
      EXPECT_LT(norm(all), 1e-12 * section) << opening;
      EXPECT_LT(outer[1].x, -.7 * section) << opening; // pressed from outside
      EXPECT_GT(outer[0].x, .7 * section) << opening;
      if (opening > 4e-3) { // the cell is between them too
        EXPECT_LT(std::abs(piece[0].x), .08 * section) << opening;
        EXPECT_LT(std::abs(piece[1].x), .08 * section) << opening;
      } else { // they are pressed together by it
        EXPECT_NEAR(piece[0].x, section, .08 * section) << opening;
        EXPECT_NEAR(piece[1].x, -section, .08 * section) << opening;
      }
    }
}

TEST(confinement, work_is_pressure_times_the_volume_that_is_lost) {
  Body body(packed_cylinder());
  Confinement c = body.confinement();
  // Every sphere moves towards the axis by 1e-4 of its distance: dV/V = -2e-4.
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const Vector3 x = body.particles.position[i];
    body.particles.velocity[i] = {-1e-4 * x.x, -1e-4 * x.y, 0};
  }
  const double p = 5e6, lost = 2e-4 * body.specimen.shape.volume();
  press(c, body, p, 1.0, 0, false);
  EXPECT_NEAR(c.work(), 0.5 * p * c.coverage(body.particles, body.planes()) * lost, 0.06 * p * lost)
      << "the pressure has risen from 0 in the step; centres lie a radius (10 %) inside the surface";
  const double first = c.work();
  press(c, body, p, 1.0, 0, false);
  EXPECT_NEAR(c.work() - first, 2 * first, 1e-12 * first);
}

TEST(confinement, threads_change_no_bit) {
  const Body body(packed_cylinder());
  std::vector<Vector3> areas[2];
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    const Confinement c = body.confinement();
    for (std::size_t k = 0; k < c.size(); ++k)
      areas[threads > 1].push_back(c.area(k));
  }
  ASSERT_EQ(areas[0].size(), areas[1].size());
  for (std::size_t k = 0; k < areas[0].size(); ++k)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(areas[0][k][axis], areas[1][k][axis]);
}

} // namespace
} // namespace platen::dem::confinement_test
