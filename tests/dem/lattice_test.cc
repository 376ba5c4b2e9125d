// Static equilibrium of a face-centred cubic lattice, to round-off of its solve: a specimen whose bonds in
// its own faces count half, as half of what they stand for lies outside, is strained evenly by even
// tractions.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "dem/equilibrium.h"
#include "dem/measure/gauge.h"
#include "dem/model.h"
#include "tests/dem/examples.h"

namespace platen::dem::lattice_test {
namespace {

using namespace examples;

constexpr double ratio = 0.4;                     // K_s / K_n
constexpr double half = 1.41421356237309504880;   // of a cell's edge, in radii
constexpr std::array<int, 3> halves{6, 8, 10};    // of cells along x, y, z
constexpr double strain = 1e-6, tolerance = 1e-9; // of the solve

struct Lattice {
  Specimen specimen;
  std::vector<std::array<int, 3>> place; // in half cells
  Lattice() {
    const double h = half * radius;
    specimen.shape = box(halves[0] * h + 2 * radius, halves[1] * h + 2 * radius, halves[2] * h + 2 * radius);
    for (int z = 0; z <= halves[2]; ++z)
      for (int y = 0; y <= halves[1]; ++y)
        for (int x = 0; x <= halves[0]; ++x) {
          if ((x + y + z) % 2 != 0) continue;
          specimen.centre.push_back({(x - 0.5 * halves[0]) * h, (y - 0.5 * halves[1]) * h, z * h + radius});
          specimen.radius.push_back(radius);
          place.push_back({x, y, z});
        }
  }
  // -1, 1 on the low, the high face of that axis; 0 inside.
  int face(std::size_t i, int axis) const {
    const int at = place[i][axis];
    return at == 0 ? -1 : at == halves[axis] ? 1 : 0;
  }
};

struct Pressed {
  Vector3 stress, strain; // Pa, 1; compression positive
};

class FaceCentredLattice : public ::testing::Test {
protected:
  FaceCentredLattice() {
    ModelSettings settings = bonded();
    settings.rotation = false; // shear at edges is uneven: spheres there would turn, and their bonds yield
    parallel_bond(settings).stiffness_ratio = ratio;
    model_ = std::make_unique<Model>(lattice_.specimen, settings);
    Bonds &b = *model_->bonds;
    stiffness_ = b.stiffness(0).axial;
    for (std::size_t k = 0; k < b.size(); ++k)
      for (int axis = 0; axis < 3; ++axis) {
        const int side = face(b.first[k], axis);
        if (side != 0 && side == face(b.second[k], axis)) b.normal_stiffness[k] *= 0.5;
      }
  }
  int face(int row, int axis) const {
    return lattice_.face(static_cast<std::size_t>(model_->particles.id[row]), axis);
  }
  // Springs on the faces of the axes that are pressed: of each sphere by its share of the face, so that all
  // give way alike; their other ends move in by `closure` (m) each.
  Pressed press(const std::array<bool, 3> &held, const Vector3 &closure) const {
    const Particles &p = model_->particles;
    StaticCase load;
    for (int i = 0; i < static_cast<int>(p.size()); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        if (!held[axis] || face(i, axis) == 0) continue;
        Support support;
        support.spring.particle = i;
        support.spring.normal[axis] = -face(i, axis);
        support.spring.arm = -p.radius[i] * support.spring.normal;
        double share = 1;
        for (int other = 0; other < 3; ++other)
          if (other != axis && face(i, other) != 0) share *= 0.5;
        support.spring.normal_stiffness = share * spring;
        support.moved = closure[axis] * support.spring.normal;
        load.supports.push_back(support);
      }
    StaticSettings settings;
    settings.tolerance = tolerance;
    const StaticState state = solve_static(p, *model_->bonds, load, settings);
    const GaugeStrain gauge =
        Gauge(p, lattice_.specimen.shape, model_->bonds.get()).strain_of(p, state.displacement);
    Pressed found;
    found.strain = {-gauge.lateral_x, -gauge.lateral_y, -gauge.axial};
    for (const Support &s : load.supports)
      for (int axis = 0; axis < 3; ++axis) {
        if (s.spring.normal[axis] == 0) continue;
        const Vector3 &u = state.displacement[s.spring.particle];
        const double area = half * half * radius * radius * halves[0] * halves[1] * halves[2] / halves[axis];
        found.stress[axis] +=
            0.5 * s.spring.normal_stiffness * dot(s.moved - u, s.spring.normal) / area; // of two faces
      }
    return found;
  }

  static constexpr double spring = 1e9; // N/m, of a whole sphere's place on a face
  Lattice lattice_;
  std::unique_ptr<Model> model_;
  double stiffness_ = 0; // N/m, K_n
};

// Free sides: nu = (1 - r)/(3 + r), E = sqrt(2) K_n/R (1 + 3 r)/(3 + r).
TEST_F(FaceCentredLattice, between_two_platens_has_its_youngs_modulus_and_poissons_ratio) {
  const Pressed found = press({false, false, true}, {0, 0, strain});
  const double young = std::sqrt(2) * stiffness_ / radius * (1 + 3 * ratio) / (3 + ratio);
  EXPECT_NEAR(found.stress.z / found.strain.z / young, 1, 1e-7);
  const double poisson = (1 - ratio) / (3 + ratio);
  EXPECT_NEAR(-found.strain.x / found.strain.z / poisson, 1, 1e-7);
  EXPECT_NEAR(-found.strain.y / found.strain.z / poisson, 1, 1e-7);
}

// Sides at rest: what their springs give way is taken from stress and strain, (K_n + K_s)/(sqrt(2) R) and
// (K_n - K_s)/(2 sqrt(2) R) are left.
TEST_F(FaceCentredLattice, between_six_platens_has_its_constrained_modulus_and_its_lateral_stress) {
  const Pressed found = press({true, true, true}, {0, 0, strain});
  const double c11 = stiffness_ * (1 + ratio) / (std::sqrt(2) * radius),
               c12 = stiffness_ * (1 - ratio) / (2 * std::sqrt(2) * radius);
  const Vector3 &e = found.strain;
  EXPECT_NEAR(found.stress.z / (c11 * e.z + c12 * (e.x + e.y)), 1, 1e-7);
  EXPECT_NEAR(found.stress.x / (c11 * e.x + c12 * (e.y + e.z)), 1, 1e-7);
  EXPECT_NEAR(found.stress.y / (c11 * e.y + c12 * (e.x + e.z)), 1, 1e-7);
  EXPECT_GT(e.z, 0);
  EXPECT_GT(found.stress.x, 0);
}

// K = sqrt(2) K_n/(3 R), whatever the shear springs: stresses alike strain alike.
TEST_F(FaceCentredLattice, under_even_pressure_has_its_bulk_modulus) {
  // Springs that give way by p A / k close each length by the same share: closures by lengths and areas.
  const double bulk = std::sqrt(2) * stiffness_ / (3 * radius), pressure = 3 * bulk * strain;
  Vector3 closure;
  for (int axis = 0; axis < 3; ++axis) // a sphere's place on a face is half a cell's square
    closure[axis] =
        0.5 * strain * halves[axis] * half * radius + pressure * 2 * half * half * radius * radius / spring;
  const Pressed found = press({true, true, true}, closure);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(found.strain[axis] / strain, 1, 1e-7) << axis;
    EXPECT_NEAR(found.stress[axis] / pressure, 1, 1e-7) << axis;
  }
}

} // namespace
} // namespace platen::dem::lattice_test
