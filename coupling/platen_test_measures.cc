// The measures of a test between two platens: strains, stresses, sizes.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/pi.h"
#include "coupling/platen_test.h"

namespace platen::coupling {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

} // namespace

double PlatenTest::coordination_number() const {
  if (!model.bonds) return 0;
  return 2.0 * static_cast<double>(model.bonds->initial_count()) /
         static_cast<double>(model.particles.size());
}

double PlatenTest::closure_strain() const {
  return (bottom().closure() + top().closure()) / shape().height;
}

double PlatenTest::platen_speed() const {
  return bottom().body().velocity()[2] - top().body().velocity()[2];
}

double PlatenTest::stress_top() const {
  return top().load() / nominal_area();
}

double PlatenTest::stress_bottom() const {
  return bottom().load() / nominal_area();
}

double PlatenTest::stress(Side side) const {
  if (platen(side) == nullptr) return none;
  return platen(side)->load() / (axis_of(side) == 2 ? nominal_area() : face_area(shape(), axis_of(side)));
}

double PlatenTest::closure_strain(int axis) const {
  double closure = 0;
  bool any = false;
  for (const Side side : all_sides)
    if (axis_of(side) == axis && platen(side) != nullptr) closure += platen(side)->closure(), any = true;
  return any ? closure / length(shape(), axis) : none;
}

double PlatenTest::machine_closure() const {
  if (machine() == nullptr) return none;
  const auto moved = [](const Platen &p) { return dot(p.body().displacement(), p.inward()); };
  return moved(bottom()) + moved(top()) + machine()->compression();
}

double PlatenTest::circumferential_strain() const {
  if (!circumference_) circumference_.emplace(model.particles, shape(), model.bonds.get());
  return circumference_->strain(model.particles);
}

double PlatenTest::mouth_opening() const {
  return mouth_ ? (*mouth_)(model.particles) : none;
}

double PlatenTest::widening(Widening of) const {
  return of == Widening::mouth ? mouth_opening() : circumferential_strain();
}

// The circumference controls no bar in bending.
std::vector<int> PlatenTest::rows_measured() const {
  const auto needed = [&](Widening of) {
    const auto &stages = settings_.loading.stages;
    return std::any_of(stages.begin(), stages.end(),
                       [of](const StageSettings &stage) { return needs(stage, of); });
  };
  if (needed(Widening::mouth)) return mouth_->rows();
  if (!needed(Widening::circumference)) return {};
  circumferential_strain();
  return circumference_->rows();
}

double PlatenTest::confining_pressure() const {
  double sum = 0; // at most one boundary presses the sides
  for (const auto &boundary : boundaries())
    sum += boundary->pressure();
  return sum;
}

double PlatenTest::confined_fraction() const {
  for (const auto &boundary : boundaries())
    if (const double fraction = boundary->confined_fraction(); !std::isnan(fraction)) return fraction;
  return none;
}

double PlatenTest::sleeve_volumetric_strain() const {
  return sleeve_ == nullptr ? none : sleeve_->volumetric_strain();
}

double PlatenTest::sleeve_deviator() const {
  return sleeve_ == nullptr ? none : sleeve_->axial_force_beyond_pressure() / nominal_area();
}

double PlatenTest::tube_load() const {
  return tube() == nullptr ? none : tube()->axial_force_beyond_pressure();
}

double PlatenTest::bending_period() const {
  const double slenderness = settings_.platens.span / shape().height;
  return 2 / pi * std::sqrt(12.0) * slenderness * slenderness * facts_.wave_transit;
}

double PlatenTest::midspan_moment() const {
  const dem::EndPlanes planes = end_planes();
  const double middle = 0.5 * (planes.low + planes.high);
  return top().midspan_moment(middle) + bottom().midspan_moment(middle);
}

double PlatenTest::broken_bonds() const {
  return static_cast<double>(model.known_breaks());
}

double PlatenTest::unbalanced_ratio() const {
  const std::size_t intact = model.intact_bonds();
  if (intact == 0) return none;
  const double bonds = model.bond_totals().force / static_cast<double>(intact);
  const double net = model.unbalanced() / static_cast<double>(model.particles.size());
  return bonds > 0 ? net / bonds : none;
}

} // namespace platen::coupling
