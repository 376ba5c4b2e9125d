// The setup of a test between two platens: platens against the specimen, lateral boundaries, program.
#include "coupling/platen_test.h"

#include <algorithm>
#include <cmath>

#include "base/pi.h"
#include "coupling/faults.h"
#include "coupling/platens_of_test.h"
#include "coupling/program_of_test.h"
#include "dem/measure/bond_network.h"

namespace platen::coupling {
namespace {

// Within the range of a tenth to ten that is safe for the servo: the stress follows within some hundred steps
// of a hard specimen.
constexpr double servo_gain = 5;
constexpr double thickness_over_height = 0.1; // of platens whose thickness is not given
// Default ramp of the loading: of a specimen in wave transits, of a bar in its own periods.
constexpr double transits_of_ramp = 10, periods_of_ramp = 2;
// Default ramp of a cell's pressure, in wave transits.
constexpr double transits_of_cell = 60;
// For a specimen in contact the servo may be as fast as possible. Its time constant is then its dashpot, ten
// impedances, over the specimen's stiffness: ten wave transits, more where ends are soft. Its target runs
// ahead by that time, so that the stress on the platens follows the pressure without delay. A slower servo
// gets as much more time.
constexpr double gain_of_cell = 10, transits_ahead = 9;
// Platens that control stresses without a cell need not follow a pressure, but a specimen that expands as it
// fails: a dashpot of 2.5 impedances reduces the stress error of this expansion to a quarter. On a machine's
// spring that would oscillate.
constexpr double gain_of_platens = 40;
// The servo may move the platen this many times as fast as the specimen shortens under the rising pressure.
constexpr double servo_reserve = 10;
// The pressure compresses the springs between spheres and sleeve by about a twenty-fifth of a radius (each
// carries the pressure on some 4 R^2); they are not softer than this fraction of the mean bond.
constexpr double springs_of_pressure = 100, least_fraction_of_bond = 0.01;

// A servo moves the top platen at some time.
} // namespace

double distance_to_plane(const dem::Specimen &specimen, Side side) {
  const int axis = axis_of(side);
  const double plane = extent(specimen.shape, axis)[is_high(side)];
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < specimen.size(); ++i)
    least = std::min(least, std::abs(plane - specimen.centre[i][axis]) - specimen.radius[i]);
  return least;
}

SpecimenFacts facts_of(const dem::Specimen &specimen, const dem::ModelSettings &settings,
                       const dem::Model &model) {
  SpecimenFacts facts;
  facts.mean_radius = dem::mean_radius(specimen);
  double solid = 0;
  for (const double r : specimen.radius)
    solid += 4.0 / 3.0 * pi * r * r * r;
  const double volume = specimen.shape.volume();
  facts.packing_fraction = solid / volume;
  facts.voigt_modulus = model.bonds ? dem::network_moduli(*model.bonds, volume).young_voigt : 0.0;
  if (model.bonds) facts.affine_moduli = dem::affine_moduli(*model.bonds, volume);
  facts.grain_density = dem::grain_density(specimen, settings.density, settings.density_of);
  const double density = facts.grain_density * settings.mass_scaling * facts.packing_fraction;
  facts.wave_transit =
      facts.voigt_modulus > 0 ? specimen.shape.height * std::sqrt(density / facts.voigt_modulus) : 0.0;
  return facts;
}

PlatenTest::PlatenTest(const dem::Specimen &specimen, const PlatenTestSettings &settings)
    : Experiment(specimen, settings.model, settings.time_step), settings_(settings) {
  if (settings_.platens.thickness == 0)
    settings_.platens.thickness = thickness_over_height * specimen.shape.height;
  require_in_range();
  add_platens(specimen);
  section_ = dem::solid_section(specimen, bent() ? 0 : loaded_axis(*this));
  require_one_section();
  if (notched()) measure_mouth();
  facts_ = facts_of(specimen, settings.model, model);
  facts_.voigt_modulus /= section_fraction(); // per volume of the load-bearing part; wave speeds are the same
  for (double &modulus : facts_.affine_moduli)
    modulus /= section_fraction();
  for (const Side side : all_sides)
    require_cover(side);
  seat_platens(specimen);
  choose_rates();
  add_lateral(mean_bond_stiffness(model));
  for (const MadeFor<Boundary> &make : settings_.boundaries)
    add(make(*this));
  begin(make_program(*this));
}

double PlatenTest::seconds_behind() const {
  double latest = 0;
  for (const Platen *platen : platens_)
    if (platen != nullptr) latest = std::max(latest, platen->seconds_behind());
  return latest;
}

double PlatenTest::platen_plastic_work() const {
  double work = 0;
  for (const ElasticPlaten *platen : elastic_)
    if (platen != nullptr) work += platen->solid().energy_balance().plastic;
  return work;
}

double PlatenTest::platen_plastic_strain() const {
  double largest = 0;
  for (const ElasticPlaten *platen : elastic_)
    if (platen != nullptr)
      for (const double strain : platen->solid().plastic_strains())
        largest = std::max(largest, strain);
  return largest;
}

void PlatenTest::require_one_section() const {
  if (!settings_.net_section || section_.fills()) return;
  if (bent() || shape().kind == dem::ShapeKind::disc || loaded_axis(*this) != 2)
    throw BadSetup("net_section", "is of specimens that are pressed or pulled along z. Allowed: nominal.");
  if (section_.same_at_all_heights()) return;
  const auto percent = [](double fraction) { return std::to_string(std::lround(100 * fraction)); };
  throw BadSetup("net_section", "is not one: the spheres fill " + percent(section_.least) + " to " +
                                    percent(section_.largest) +
                                    " % of the shape's section by height. Allowed: nominal.");
}

void PlatenTest::measure_mouth() {
  try {
    mouth_.emplace(model.particles, shape().notch, model.bonds.get());
  } catch (const std::invalid_argument &e) {
    throw BadSetup("specimen.notch_depth", std::string("has no mouth to measure: ") + e.what() +
                                               ". Allowed: 0, or " +
                                               text_of(2 * dem::mean_radius(model.particles)) +
                                               " m and more, two mean radii, with spheres on both sides.");
  }
}

void PlatenTest::require_in_range() const {
  const LoadingSettings &loading = settings_.loading;
  platen::require_in_range(settings_.platens);
  platen::require_in_range(settings_.platens.machine);
  if (settings_.platens.elastic) platen::require_in_range(*settings_.platens.elastic);
  if (platens_yield()) platen::require_in_range(*settings_.platens.elastic->metal);
  platen::require_in_range(loading);
  if (loading.cell) platen::require_in_range(*loading.cell);
  if (const SleeveSettings *sleeve = loading.sleeve()) platen::require_in_range(*sleeve);
  if (loading.tube && loading.tube->metal) platen::require_in_range(*loading.tube->metal);
  if (loading.tube && loading.tube->wrap) platen::require_in_range(*loading.tube->wrap);
  require_no_fault(settings_, shape());
}

void PlatenTest::add_platens(const dem::Specimen &specimen) {
  require_edge_gaps(specimen.shape, settings_.platens);
  for (const Side side : all_sides) {
    if (settings_.platens.side(side) == nullptr) continue;
    PlatenOfTest made = make_platen(specimen, settings_, side, model);
    platens_[static_cast<std::size_t>(side)] = made.platen.get();
    if (has_neighbours(settings_.platens, side))
      made.platen->set_clearance(edge_gap(shape(), settings_.platens, axis_of(side)));
    elastic_[static_cast<std::size_t>(side)] = made.elastic;
    add(std::move(made.platen));
  }
  ends_.emplace(EndPlatens{bottom(), top(), platen_plane(specimen, settings_, Side::bottom),
                           platen_plane(specimen, settings_, Side::top)});
}

std::optional<PlatenCover> PlatenTest::cover(Side side) const {
  if (platen(side) == nullptr || shape().kind == dem::ShapeKind::disc || bent()) return std::nullopt;
  const int axis = axis_of(side);
  const double plane = axis != 2           ? extent(shape(), axis)[is_high(side)]
                       : side == Side::top ? ends_->high_plane
                                           : ends_->low_plane;
  const double edge = has_neighbours(settings_.platens, side)
                          ? edge_gap(shape(), settings_.platens, (axis + 1) % 3) +
                                edge_gap(shape(), settings_.platens, (axis + 2) % 3)
                          : 0.0;
  return cover_of(shape(), platen(side)->surface().surface(), side, plane, 2 * facts_.mean_radius, edge);
}

// Detects a mesh in another unit, or the mesh of another specimen.
void PlatenTest::require_cover(Side side) const {
  constexpr double round_off = 1e-3, most_wide = 20; // of the specimen's width
  const std::optional<PlatenCover> found = cover(side);
  if (!found || settings_.platens.side(side)->grid == nullptr) return;
  const std::string member = std::string("platens.") + name_of(side) + ".grid",
                    wide = text_of(found->extent[0]) + " m x " + text_of(found->extent[1]) + " m";
  const int axis = axis_of(side);
  for (const int k : {0, 1})
    if (const double width = width_of_end(shape(), (axis + 1 + k) % 3);
        found->extent[static_cast<std::size_t>(k)] > most_wide * width)
      throw BadSetup(member, "is " + wide + " wide where the specimen has " + text_of(width) +
                                 " m: is it in another unit? Allowed: up to " + text_of(most_wide) +
                                 " times the specimen.");
  if (found->within_reach >= 1 - round_off || settings_.platens.partial_cover) return;
  throw BadSetup(member,
                 "faces the specimen with " + wide + ", which reaches over " +
                     text_of(std::round(100 * found->within_reach)) +
                     " % of its end: stresses over the whole end would mean nothing. Allowed: all of it, "
                     "or `platens.partial_cover` = partial.");
}

void PlatenTest::seat_platens(const dem::Specimen &specimen) {
  const double depth = settings_.end_layer * dem::mean_radius(specimen);
  if (are_ground(settings_.ends) || settings_.platens.glued) {
    const auto seats = [&](Platen &platen, Side side) {
      const double recess = recess_of(settings_, side);
      const auto below = [&](const Vector3 &x) { return depth_of_end(shape(), settings_, side, x) + recess; };
      return platen.layer().seat_within(model.particles, platen.body(), depth + recess, bent(), below);
    };
    for (const Side side : all_sides)
      if (Platen *platen = platens_[static_cast<std::size_t>(side)];
          platen != nullptr && seats(*platen, side) == 0)
        throw BadSetup("end_layer",
                       "leaves a platen without a sphere: the nearest lies " +
                           text_of(distance_to_plane(specimen, side)) + " m from the plane of the " +
                           name_of(side) + " one, and the layer is " + text_of(depth) +
                           " m deep. Allowed: a deeper layer, or a specimen that reaches its end planes.");
  }
  if (bent()) require_strips_to_meet(specimen, settings_, depth);
}

void PlatenTest::choose_rates() {
  LoadingSettings &loading = settings_.loading;
  const double transit = facts_.wave_transit;
  if (transit == 0 &&
      (loading.rate_multiplier > 1 || (std::isnan(loading.rate) && loading.wave_transits > 0)))
    throw BadSetup(loading.rate_multiplier > 1 ? "loading.rate_multiplier" : "loading.wave_transits",
                   "needs bonds, and the specimen has none. Allowed: a `loading.rate` alone.");
  if (std::isnan(loading.rate) && loading.wave_transits > 0)
    loading.rate = 1e-3 * shape().height / (loading.wave_transits * transit);
  if (std::isnan(loading.rate)) loading.rate = 0;
  if (std::isnan(loading.target_strain)) loading.target_strain = std::numeric_limits<double>::infinity();
  ramp_ = loading.ramp > 0 ? loading.ramp
          : bent()         ? periods_of_ramp * bending_period()
                           : transits_of_ramp * transit;
  servo_slowness_ = gain_of_cell / gain_of_servo();
  if (!loading.cell) return;
  for (const StageSettings &stage : loading.stages)
    for (const SideControl &control : stage.controls)
      if (control.mode == SideControl::Mode::pressure)
        loading.cell->pressure = std::max(loading.cell->pressure, control.value);
  cell_ramp_ = loading.cell->ramp > 0 ? loading.cell->ramp : transit > 0 ? ramp_of_stress() : 0;
  if (!(cell_ramp_ > 0))
    throw BadSetup("loading.cell.ramp", "has to be given: without bonds there is no wave to take it from.");
}

void PlatenTest::add_lateral(double bond) {
  const LoadingSettings &loading = settings_.loading;
  if (loading.cell || loading.tube) {
    try {
      if (loading.sleeve() != nullptr)
        add_sleeve(*loading.sleeve(), bond);
      else
        skin_ = &add(std::make_unique<SkinPressure>(model.particles, model.bonds.get(), shape(), *ends_,
                                                    loading.cell->area));
    } catch (const std::invalid_argument &e) {
      throw BadSetup(loading.tube ? "loading.tube" : "loading.cell",
                     std::string("cannot be: ") + e.what() + ".");
    }
  }
  if (loading.wall)
    wall_ =
        &add(std::make_unique<LateralWall>(model.particles, shape(), *ends_, loading.wall_stiffness * bond,
                                           loading.wall_layer * facts_.mean_radius));
}

// Penalty springs of the skin are in series with the specimen: stiff enough for the pressure, and no stiffer,
// because with the light nodes of the sleeve they determine its steps.
void PlatenTest::add_sleeve(const SleeveSettings &given, double bond) {
  SleeveSettings settings = given;
  const double pressure = settings_.loading.cell ? settings_.loading.cell->pressure : 0;
  settings.contact.particle_stiffness =
      given.stiffness > 0 ? given.stiffness * bond
      : settings_.loading.tube
          ? bond
          : std::max(springs_of_pressure * pressure * facts_.mean_radius, least_fraction_of_bond * bond);
  settings.contact.skin = surface_skin * facts_.mean_radius;
  settings.contact.instruction_set = model.settings().instruction_set;
  settings.seat_depth = given.seat_layer * facts_.mean_radius;
  sleeve_ = &add(std::make_unique<Sleeve>(model.particles, shape(), *ends_, settings));
}

// Platens come first, by their order in Side; then the lateral boundary.
Sides PlatenTest::sides() const {
  Sides sides;
  std::size_t next = 2;
  for (const auto &[side, place] : {std::pair{Side::left, &sides.left},
                                    {Side::right, &sides.right},
                                    {Side::front, &sides.front},
                                    {Side::back, &sides.back}})
    if (platen(side) != nullptr) *place = next++;
  if (settings_.loading.cell) sides.lateral = next;
  return sides;
}

PlatensOfAxis PlatenTest::platens_of(Side side) const {
  const int axis = axis_of(side);
  PlatensOfAxis found{{}, axis == 2 ? nominal_area() : face_area(shape(), axis), length(shape(), axis), axis};
  for (std::size_t k = 0; k < boundaries().size(); ++k)
    if (boundaries()[k].get() == platen(side)) found.places.push_back(k);
  return found;
}

PlatensOfAxis PlatenTest::platens_along(int axis) const {
  PlatensOfAxis both;
  for (const Side side : all_sides) {
    if (axis_of(side) != axis) continue;
    const PlatensOfAxis one = platens_of(side);
    both.area = one.area, both.length = one.length, both.axis = axis;
    both.places.insert(both.places.end(), one.places.begin(), one.places.end());
  }
  return both;
}

double PlatenTest::gain_of_servo() const {
  const LoadingSettings &loading = settings_.loading;
  if (loading.servo_gain > 0) return loading.servo_gain;
  return loading.cell || settings_.platens.machine.yields() ? gain_of_cell : gain_of_platens;
}

double PlatenTest::ramp_of_stress() const {
  const double rigid = servo_slowness_ * transits_ahead * facts_.wave_transit;
  return std::max(1.0, servo_slowness_) * transits_of_cell * facts_.wave_transit +
         transits_of_cell / transits_ahead * (time_of_servo(platens_of(Side::top)) - rigid);
}

double PlatenTest::stiffness_of_specimen() const {
  return facts_.voigt_modulus > 0 ? facts_.voigt_modulus * nominal_area() / shape().height
                                  : std::numeric_limits<double>::infinity();
}

// N s/m, addition of the machine's impedance to the dashpot of a servo that moves its crosshead.
double PlatenTest::dashpot_of_machine(const PlatensOfAxis &platens) const {
  if (machine() == nullptr || platens.axis != 2) return 0;
  const std::size_t count = platens.places.size();
  if (count == 1 && boundaries()[platens.places.front()].get() != &top()) return 0;
  return Servo::impedances / gain_of_servo() * machine()->servo_impedance() / static_cast<double>(count);
}

// A servo with the dashpot c has the time constant c (1/k_s + 1/k_m), c/k_s on a rigid machine; two platens
// close twice as fast.
double PlatenTest::machine_compliance(const PlatensOfAxis &platens) const {
  if (machine() == nullptr || platens.axis != 2) return 0;
  return 1 / (machine()->settings().stiffness * static_cast<double>(platens.places.size()));
}

double PlatenTest::lead_of_servo(const PlatensOfAxis &platens) const {
  const double count = static_cast<double>(platens.places.size());
  return servo_slowness_ * transits_ahead * facts_.wave_transit +
         dashpot_of_machine(platens) / (stiffness_of_specimen() * count);
}

// The grains' dashpot follows from its time constant on a rigid machine.
double PlatenTest::time_of_servo(const PlatensOfAxis &platens) const {
  const double lead = servo_slowness_ * transits_ahead * facts_.wave_transit,
               grains = lead > 0 ? lead * stiffness_of_specimen() : 0.0;
  return lead_of_servo(platens) + (grains + dashpot_of_machine(platens)) * machine_compliance(platens);
}

Servo::Parameters PlatenTest::servo_for(double stress, int axis, double ramp, double least) const {
  const double stiffness =
      facts_.voigt_modulus > 0 ? facts_.voigt_modulus : std::numeric_limits<double>::infinity();
  double fastest = servo_reserve * stress / stiffness * length(shape(), axis) / ramp;
  if (machine() != nullptr && axis == 2)
    fastest += servo_reserve * stress * nominal_area() / machine()->settings().stiffness / ramp;
  return {gain_of_servo(), std::max(fastest, least)};
}

Servo::Parameters PlatenTest::servo_of_top() const {
  const LoadingSettings &loading = settings_.loading;
  return {loading.servo_gain > 0 ? loading.servo_gain : servo_gain, loading.rate};
}

std::optional<RateControl::Parameters> PlatenTest::rate_control() const {
  const LoadingSettings &loading = settings_.loading;
  if (!(loading.rate_multiplier > 1)) return std::nullopt;
  return RateControl::Parameters{loading.rate_multiplier, bent() ? bending_period() : facts_.wave_transit,
                                 ramp_, static_cast<double>(model.bonds->size())};
}

} // namespace platen::coupling
