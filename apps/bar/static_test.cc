#include "apps/bar/static_test.h"

namespace platen::apps {
namespace {

Vector3 across(bool along_x) {
  return along_x ? Vector3{1, 0, 0} : Vector3{0, 1, 0};
}

} // namespace

Rod rod_at_rest(const BarGeometry &bar, double axial_rigidity, double poisson_ratio, const Section &section) {
  return {bar.high.z - bar.low.z,
          axial_rigidity,
          poisson_ratio,
          bar.mass_per_length,
          section,
          bar.mass,
          bar.along_x};
}

double load_of_strain(const Rod &rod, BarLoad load, double strain) {
  const double skin = rod.section.skin(rod.along_x);
  if (load == BarLoad::tension) return strain * rod.axial_rigidity;
  if (load == BarLoad::bending) return strain * rod.bending_rigidity() / (skin * rod.length);
  return strain * rod.torsion_rigidity() / skin;
}

double response_of(const Rod &rod, BarLoad load, double size) {
  if (load == BarLoad::tension) return rod.stretch(size);
  if (load == BarLoad::bending) return rod.deflection_with_shear(size);
  return rod.twist(size);
}

double frequency_of(const Rod &rod, BarLoad load) {
  if (load == BarLoad::tension) return rod.axial_frequency();
  if (load == BarLoad::bending) return rod.bending_frequency_with_shear();
  return rod.torsion_frequency();
}

StaticTest load_bar(const dem::Model &model, const BarGeometry &bar, BarLoad load, double size,
                    const dem::StaticSettings &settings) {
  dem::StaticCase at_rest;
  for (const int row : bar.low.rows)
    at_rest.led.push_back({row, {}, {}});
  if (load == BarLoad::tension) add_force(at_rest, model.particles, bar.high, {0, 0, size});
  if (load == BarLoad::bending) add_force(at_rest, model.particles, bar.high, size * across(bar.along_x));
  if (load == BarLoad::torsion) add_torque(at_rest, model.particles, bar.high, size);
  StaticTest test;
  test.load = size;
  test.state = solve_static(model.particles, *model.bonds, at_rest, settings);
  test.energy = energy_shares(model.particles, *model.bonds, test.state.displacement, test.state.turn);
  const EndMotion end = motion_of(model.particles, bar.high, test.state.displacement, test.state.turn);
  test.measured = load == BarLoad::tension   ? end.moved.z
                  : load == BarLoad::bending ? dot(end.moved, across(bar.along_x))
                                             : end.twist;
  return test;
}

} // namespace platen::apps
