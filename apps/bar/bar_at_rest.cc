#include "apps/bar/bar_at_rest.h"

#include "apps/bar/bar_section.h"
#include "dem/stable_step.h"

namespace platen::apps {
namespace {

constexpr double small_strain = 1e-4; // of the solves, which are linear

double mean_axial_stiffness(const dem::Bonds &bonds) {
  double sum = 0;
  for (std::size_t row = 0; row < bonds.size(); ++row)
    sum += bonds.stiffness(row).axial;
  return sum / static_cast<double>(bonds.size());
}

// Spheres of an end moved along z by stiff springs, free to slide.
void hold_along_axis(dem::StaticCase &load, const BarEnd &end, double stiffness, double moved) {
  for (const std::size_t row : end.rows) {
    dem::Support support;
    support.spring.particle = static_cast<int>(row);
    support.spring.normal = {0, 0, 1};
    support.spring.normal_stiffness = stiffness;
    support.moved = {0, 0, moved};
    load.supports.push_back(support);
  }
}

// Axes of six strains: three stretches, three shears.
constexpr int axes[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};

// m, displacement of a place (m) under such a strain.
Vector3 strained(const Vector3 &place, const int (&axes_of)[2]) {
  Vector3 moved;
  moved[axes_of[0]] = small_strain * place[axes_of[1]];
  moved[axes_of[1]] = small_strain * place[axes_of[0]];
  return moved;
}

// The shape with `margin` taken off all round.
dem::Region inside(const dem::Shape &shape, double margin) {
  dem::Region region{shape, margin};
  region.shape.height -= 2 * margin;
  region.shape.radius -= margin;
  region.shape.width_x -= 2 * margin;
  region.shape.width_y -= 2 * margin;
  return region;
}

Vector3 across(bool along_x) {
  return along_x ? Vector3{1, 0, 0} : Vector3{0, 1, 0};
}

} // namespace

Rod rod_at_rest(const BarGeometry &bar, double axial_rigidity, double poisson_ratio,
                const CrossSection &section) {
  return {bar.high.z - bar.low.z,
          axial_rigidity,
          poisson_ratio,
          bar.mass_per_length,
          section,
          bar.mass,
          bar.along_x};
}

double along(BarLoad load, const EndMotion &end, bool along_x) {
  if (load == BarLoad::tension) return end.moved.z;
  if (load == BarLoad::bending) return dot(end.moved, across(along_x));
  return end.twist;
}

StaticTest load_bar(const dem::Model &model, const BarGeometry &bar, BarLoad load, double size,
                    const dem::StaticSettings &settings) {
  dem::StaticCase at_rest;
  for (const std::size_t row : bar.low.rows)
    at_rest.prescribed.push_back({static_cast<int>(row), {}, {}});
  if (load == BarLoad::tension) add_force(at_rest, model.particles, bar.high, {0, 0, size});
  if (load == BarLoad::bending) add_force(at_rest, model.particles, bar.high, size * across(bar.along_x));
  if (load == BarLoad::torsion) add_torque(at_rest, model.particles, bar.high, size);
  StaticTest test;
  test.load = size;
  test.state = solve_static(model.particles, *model.bonds, at_rest, settings);
  test.energy = bond_energies(model.particles, *model.bonds, test.state.displacement, test.state.turn);
  const EndMotion end = motion_of(model.particles, bar.high, test.state.displacement, test.state.turn);
  test.measured = along(load, end, bar.along_x);
  return test;
}

BarModuli pull_bar(const dem::Model &model, const BarGeometry &bar, const dem::Shape &shape) {
  const double stiffness = 10 * mean_axial_stiffness(*model.bonds), stretch = small_strain * bar.length();
  dem::StaticCase load;
  hold_along_axis(load, bar.low, stiffness, 0);
  hold_along_axis(load, bar.high, stiffness, stretch);
  const dem::StaticState state = solve_static(model.particles, *model.bonds, load);
  double force = 0;
  for (const std::size_t row : bar.high.rows)
    force += stiffness * (stretch - state.displacement[row].z);
  dem::Region middle{shape, 0.25 * shape.height};
  middle.shape.height *= 0.5;
  const dem::Tensor strain = mean_strain(middle, model.particles, state.displacement, bar.in_piece);
  return {force / strain[2][2], -0.5 * (strain[0][0] + strain[1][1]) / strain[2][2]};
}

dem::Moduli bulk_moduli(const dem::Model &model, const BarGeometry &bar, const dem::Shape &shape) {
  const double mean_radius = bar.mean_radius;
  const dem::Region region = inside(shape, region_margin * mean_radius);
  const bool round = shape.kind == dem::ShapeKind::cylinder;
  const double least = mean_radius; // of the region's half-width
  if (region.shape.height < 2 * least ||
      (round ? region.shape.radius < least
             : region.shape.width_x < 2 * least || region.shape.width_y < 2 * least))
    return {not_given, not_given, not_given};
  const dem::Particles &p = model.particles;
  std::array<dem::Tensor, 6> strain, stress;
  for (std::size_t k = 0; k < 6; ++k) {
    dem::StaticCase load;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (wall_clearance(shape, p.reference_position[i]) - p.radius[i] <= skin_depth * mean_radius)
        load.prescribed.push_back({static_cast<int>(i), strained(p.reference_position[i], axes[k]), {}});
    const dem::StaticState state = solve_static(p, *model.bonds, load);
    strain[k] = mean_strain(region, p, state.displacement, bar.in_piece);
    stress[k] = mean_stress(region, p, *model.bonds, state.displacement, state.turn);
  }
  return dem::isotropic_moduli(strain, stress);
}

} // namespace platen::apps
