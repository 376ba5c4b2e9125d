#include "coupling/problem.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>

#include "coupling/bending.h"
#include "dem/measure/moduli.h"
#include "dem/parallel.h"
#include "fem/grids.h"

namespace platen::coupling {
namespace {

constexpr double pi = 3.14159265358979323846;
// Margin of the platens' particle lists, in mean radii.
constexpr double surface_skin = 0.3;
// The step is looked at again after this many steps, if contacts have grown by this share of the particles.
constexpr long steps_between_choices = 400;
constexpr double growth_of_contacts = 0.02;
// Within the tenth to tenfold that the servo is safe for: the stress follows within some hundred steps of a
// hard specimen.
constexpr double servo_gain = 5;

// As packed, a platen meets the outermost sphere; ground, it lies in the end plane.
double platen_plane(const dem::Specimen &s, bool top, Ends ends) {
  if (ends == Ends::ground) return top ? s.shape.height : 0.0;
  double z = top ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < s.size(); ++i)
    z = top ? std::max(z, s.centre[i].z + s.radius[i]) : std::min(z, s.centre[i].z - s.radius[i]);
  return z;
}

std::string text_of(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

void require_bar(const dem::Shape &shape, const ProblemSettings &settings) {
  const PlatenSettings &p = settings.platens;
  if (settings.ends != Ends::ground)
    throw BadSetup("Specimen/Ends", "would let a bar rock on its outermost spheres. Allowed: ground.");
  if (shape.kind != dem::ShapeKind::box)
    throw BadSetup("Loading/Test", "bends bars of rectangular section. Allowed: Specimen/Shape = box, bar.");
  if (!(p.strip_width > 0))
    throw BadSetup("Platens/Strip width", "has to be given: a bar is bent by strips. Allowed: > 0 m.");
  if (!(p.span > p.strip_width))
    throw BadSetup("Platens/Span",
                   "leaves no gap between the lower strips. Allowed: above Platens/Strip "
                   "width, " +
                       text_of(p.strip_width) + " m.");
  if (p.span + p.strip_width > shape.width_x)
    throw BadSetup("Platens/Span", "is too long for a bar of " + text_of(shape.width_x) +
                                       " m: the lower strips have to lie under it. Allowed: up to " +
                                       text_of(shape.width_x - p.strip_width) + " m.");
}

Strips bending_strips(const dem::Specimen &s, const ProblemSettings &settings, bool top) {
  const PlatenSettings &p = settings.platens;
  require_bar(s.shape, settings);
  Strips strips;
  strips.middles = top ? std::vector<double>{0} : std::vector<double>{-0.5 * p.span, 0.5 * p.span};
  strips.width = p.strip_width;
  strips.length = p.overhang * s.shape.width_y;
  strips.z_low =
      top ? platen_plane(s, true, settings.ends) : platen_plane(s, false, settings.ends) - p.thickness;
  strips.thickness = p.thickness;
  strips.elements_across = p.elements_across;
  strips.presses_from_above = top;
  return strips;
}

fem::Grid platen_grid(const dem::Specimen &s, const ProblemSettings &settings, bool top) {
  const PlatenSettings &p = settings.platens;
  const double plane = platen_plane(s, top, settings.ends), low = top ? plane : plane - p.thickness;
  if (p.span > 0) return make_grid(bending_strips(s, settings, top));
  if (s.shape.kind == dem::ShapeKind::cylinder)
    return fem::make_grid(
        fem::CylinderPlate{p.overhang * s.shape.radius, p.thickness, low, p.elements_across, 2});
  const bool strip = s.shape.kind == dem::ShapeKind::disc && p.strip_width > 0;
  const double x = strip ? 0.5 * p.strip_width : 0.5 * p.overhang * s.shape.width_x,
               y = 0.5 * p.overhang * s.shape.width_y;
  return fem::make_grid(
      fem::BoxPlate{{-x, -y, low}, {x, y, low + p.thickness}, {p.elements_across, p.elements_across, 2}});
}

// Without bonds the stiffness that a bond would have still measures the grains; N/m.
double mean_bond_stiffness(const dem::Model &model) {
  double sum = 0;
  if (model.bonds && model.bonds->size() > 0) {
    const dem::Bonds &b = *model.bonds;
    for (std::size_t k = 0; k < b.size(); ++k)
      sum += pi * b.bond_radius[k] * b.bond_radius[k] * b.normal_stiffness[k];
    return sum / static_cast<double>(b.size());
  }
  for (const double r : model.particles.radius)
    sum += model.settings().bond_layout.axial_stiffness(r, r);
  return sum / static_cast<double>(std::max<std::size_t>(model.particles.size(), 1));
}

double platen_stiffness(const dem::Model &model, const ProblemSettings &settings) {
  const PlatenSettings &p = settings.platens;
  if (p.stiffness_absolute > 0) return p.stiffness_absolute;
  return p.stiffness_of_bond * mean_bond_stiffness(model);
}

SurfaceContact layer_settings(const dem::Model &model, const dem::Specimen &s,
                              const ProblemSettings &settings, const PlatenSide &side) {
  const PlatenSettings &p = settings.platens;
  SurfaceContact c;
  c.particle_stiffness = platen_stiffness(model, settings);
  c.tangential_ratio = p.tangential_ratio;
  c.friction_static = side.friction_static;
  c.friction_dynamic = side.friction_dynamic;
  c.damping = p.damping;
  c.attachment = p.glued ? Attachment::glued : Attachment::free;
  c.seat_modulus = settings.seat ? model.settings().bond_layout.modulus : 0.0;
  c.skin = surface_skin * dem::mean_radius(s);
  return c;
}

double smooth_start(double x) {
  return x >= 1 ? 1.0 : x * x * (3 - 2 * x);
}

// A cell's pressure rises over this many wave crossings where nothing else is said.
constexpr double crossings_of_cell = 60;
// Of a specimen in contact the servo may be as quick as it can. Its time constant is then that of its
// dashpot, ten impedances, over the specimen's stiffness: ten wave crossings, more where ends are soft. What
// it is told runs ahead by that, so that the stress on the platens keeps up with the pressure.
constexpr double gain_of_cell = 10, crossings_ahead = 9;
// The platens take over when the axial stress is as near to the pressure as this share of it, or after as
// much time again as pressure and hold have had.
constexpr double settled_share = 0.01, patience = 2;
// The servo may move the platen this many times as fast as the specimen shortens under the rising pressure.
constexpr double servo_reserve = 10;
// A bar is loaded within this many of its own periods where nothing else is said.
constexpr double swings_of_ramp = 2;
// Areas of the skin are looked at in every step that is a multiple of this.
constexpr long steps_between_skins = 400;

} // namespace

Problem::Problem(const dem::Specimen &specimen, const ProblemSettings &settings)
    : model(specimen, settings.model),
      top(platen_grid(specimen, settings, true), settings.platens.material),
      bottom(platen_grid(specimen, settings, false), settings.platens.material),
      top_layer(model.particles, top, layer_settings(model, specimen, settings, settings.platens.top)),
      bottom_layer(model.particles, bottom,
                   layer_settings(model, specimen, settings, settings.platens.bottom)),
      settings_(settings),
      shape_(specimen.shape),
      bottom_plane_(platen_plane(specimen, false, settings.ends)),
      top_plane_(platen_plane(specimen, true, settings.ends)) {
  double solid = 0;
  for (const double r : specimen.radius)
    solid += 4.0 / 3.0 * pi * r * r * r;
  packing_fraction_ = solid / shape_.volume();
  if (settings.ends == Ends::ground || settings.platens.glued) {
    const double depth = settings.end_layer * dem::mean_radius(specimen);
    const int seats = std::min(top_layer.seat_within(model.particles, top, depth, bent()),
                               bottom_layer.seat_within(model.particles, bottom, depth, bent()));
    if (seats == 0)
      throw BadSetup("Specimen/End layer",
                     "leaves a platen without a sphere. Allowed: a deeper layer, or a specimen that reaches "
                     "its end planes.");
  }
  for (const bool above : {true, false})
    if (bent() && !each_meets_a_sphere(bending_strips(specimen, settings, above), specimen,
                                       settings.end_layer * dem::mean_radius(specimen)))
      throw BadSetup(
          "Platens/Strip width",
          "leaves a strip without a sphere. Allowed: wider strips, or a deeper Specimen/End layer.");
  voigt_modulus_ = model.bonds ? dem::network_moduli(*model.bonds, shape_.volume()).young_voigt : 0.0;
  grain_density_ = dem::grain_density(specimen, settings.model.density, settings.model.density_of);
  const double density = grain_density_ * settings.model.mass_scaling * packing_fraction_;
  wave_crossing_ = voigt_modulus_ > 0 ? shape_.height * std::sqrt(density / voigt_modulus_) : 0.0;
  ramp_ = settings.loading.ramp > 0 ? settings.loading.ramp
          : bent()                  ? swings_of_ramp * swing()
                                    : 10 * wave_crossing_;
  if (settings.loading.servo)
    servo_ = std::make_unique<Servo>(Servo::Parameters{servo_gain, settings.loading.rate});
  if (settings.loading.cell) start_cell(*settings.loading.cell);
  if (settings.loading.wall_stiffness > 0)
    wall_ = std::make_unique<dem::LateralWall>(model.particles, shape_,
                                               settings.loading.wall_stiffness * mean_bond_stiffness(model),
                                               settings.loading.wall_layer * dem::mean_radius(specimen));
  // Pairs that are about to touch count in the first step too.
  if (model.contacts) model.contacts->search(model.particles, model.bonds.get(), 0.0);
  choose_step(true);
}

dem::EndPlanes Problem::end_planes() const {
  return {bottom_plane_ + bottom.displacement()[2], top_plane_ + top.displacement()[2]};
}

void Problem::start_cell(const CellSettings &cell) {
  cell_ramp_ = cell.ramp > 0 ? cell.ramp : crossings_of_cell * wave_crossing_;
  if (!(cell_ramp_ > 0))
    throw BadSetup("Loading/Confining ramp",
                   "has to be given: without bonds there is no wave to take it from.");
  cell_end_ = std::numeric_limits<double>::infinity();
  try {
    confinement_ = std::make_unique<dem::Confinement>(model.particles, model.bonds.get(), shape_,
                                                      end_planes(), cell.area);
  } catch (const std::invalid_argument &e) {
    throw BadSetup("Loading/Confinement", std::string("cannot be: ") + e.what() + ".");
  }
  const double stiffness = voigt_modulus_ > 0 ? voigt_modulus_ : std::numeric_limits<double>::infinity();
  const double fastest = servo_reserve * cell.pressure / stiffness * shape_.height / cell_ramp_;
  servo_ =
      std::make_unique<Servo>(Servo::Parameters{gain_of_cell, std::max(fastest, settings_.loading.rate)});
}

std::vector<dem::GroundSpring> Problem::ground_springs() const {
  std::vector<dem::GroundSpring> springs = bottom_layer.ground_springs(model.particles, bottom);
  const std::vector<dem::GroundSpring> more = top_layer.ground_springs(model.particles, top);
  springs.insert(springs.end(), more.begin(), more.end());
  return springs;
}

std::vector<dem::GroundSpring> Problem::springs_at(bool top_platen) {
  ContactLayer &layer = top_platen ? top_layer : bottom_layer;
  const fem::Body &body = top_platen ? top : bottom;
  layer.make_list(model.particles, body);
  return layer.ground_springs(model.particles, body);
}

std::size_t Problem::springs_near() const {
  return (model.contacts ? model.contacts->table.size() : 0) + top_layer.closed + bottom_layer.closed;
}

// The step never grows: bonds that break only soften, contacts that close may stiffen.
void Problem::choose_step(bool first) {
  // Lists made now, so that the choice is the same whether the run was stopped and resumed on its way or not.
  top_layer.make_list(model.particles, top);
  bottom_layer.make_list(model.particles, bottom);
  std::vector<dem::GroundSpring> springs = ground_springs();
  near_at_choice_ = (model.contacts ? model.contacts->table.size() : 0) + springs.size();
  if (wall_) {
    wall_->make_list(model.particles);
    const std::vector<dem::GroundSpring> more = wall_->ground_springs(model.particles);
    springs.insert(springs.end(), more.begin(), more.end());
  }
  const dem::StableStep limit = model.stable_step(springs, settings_.platens.damping);
  if (settings_.fixed_step > 0) {
    if (settings_.fixed_step > limit.limit) {
      const std::string above =
          "is above the stability limit of " + text_of(limit.limit) + " s (" + limit.reason + ")";
      if (first)
        throw BadSetup("Integration/Time step", above + ". Allowed: up to that, or 0: the program chooses.");
      throw NumericsStopped("the time step of " + text_of(settings_.fixed_step) + " s " + above + " at " +
                            text_of(time()) +
                            " s; try a smaller Integration/Time step, or leave it to the program");
    }
    time_step_ = settings_.fixed_step;
    reason_ = "given by the scene";
    return;
  }
  const double step = settings_.safety * limit.limit;
  if (!std::isfinite(step))
    throw BadSetup("Integration/Time step",
                   "has to be given: nothing in the scene has a stiffness that would give it.");
  if (first || step < time_step_) {
    time_step_ = step;
    reason_ = limit.reason;
  }
}

// Time constant of the servo times the rate of the pressure, Pa.
double Problem::lead_of_cell(double time) const {
  const double x = time / cell_ramp_;
  const double rate = x < 1 ? 6 * x * (1 - x) / cell_ramp_ * settings_.loading.cell->pressure : 0.0;
  return crossings_ahead * wave_crossing_ * rate;
}

void Problem::look_at_cell() {
  if (!confinement_ || model.time >= cell_end_) return;
  const double least = cell_ramp_ + settings_.loading.cell->hold;
  const double stress = 0.5 * (stress_top() + stress_bottom()), pressure = confinement_->pressure();
  const bool near = std::abs(stress - pressure) < settled_share * pressure;
  if (model.time >= least && (near || model.time >= patience * least)) cell_end_ = model.time;
}

void Problem::set_platen_speeds() {
  const LoadingSettings &loading = settings_.loading;
  const double middle = model.time - 0.5 * time_step_;
  const bool confining = confinement_ && middle < cell_end_;
  const double begun = confining || !confinement_ ? middle : middle - cell_end_;
  const double whole = confining ? cell_ramp_ : ramp_;
  const double start = whole > 0 ? smooth_start(begun / whole) : 1.0;
  if (servo_ && (confining || loading.servo)) {
    const double wanted =
        (confining ? start * loading.cell->pressure + lead_of_cell(middle) : start * loading.top_stress) *
        nominal_area();
    top.set_velocity(
        {0, 0, -servo_->velocity(wanted, reaction_top_, top_layer.servo_load(model.particles), time_step_)});
    bottom.set_velocity({0, 0, 0});
    return;
  }
  double speed = (loading.tension ? -0.5 : 0.5) * loading.rate * start;
  if (!loading.unload_at.empty()) {
    const double most = ramp_ > 0 ? 2 * time_step_ / ramp_ : 2.0;
    cycle_.speed += std::clamp(cycle_.direction - cycle_.speed, -most, most);
    speed *= cycle_.speed;
  }
  top.set_velocity({0, 0, -speed});
  bottom.set_velocity({0, 0, speed});
}

void Problem::drift_bodies() {
  set_platen_speeds();
  top.drift(time_step_);
  bottom.drift(time_step_);
  top.clear_loads();
  bottom.clear_loads();
}

// A layer refuses a motion that could carry a particle through a face unseen.
void Problem::announce_motion(double dt) {
  const double particles = model.last_motion().fastest * dt;
  try {
    top_layer.moved(particles + top.largest_move(dt));
    bottom_layer.moved(particles + bottom.largest_move(dt));
  } catch (const std::runtime_error &e) {
    throw NumericsStopped("step " + std::to_string(steps_) + ", time " + text_of(time()) + " s: " + e.what());
  }
}

void Problem::look_at_step() {
  if (steps_ == 0 || steps_ % steps_between_choices != 0) return;
  const double grown = static_cast<double>(springs_near()) - static_cast<double>(near_at_choice_);
  if (grown <= growth_of_contacts * static_cast<double>(model.particles.size())) return;
  dem::StageClock::Lap lap(model.clock, dem::Stage::stable_step);
  choose_step(false);
}

long Problem::advance(long most) {
  for (long made = 0; made < most; ++made) {
    const double before = time_step_;
    look_at_step();
    if (made == 0)
      model.begin_step(time_step_);
    else
      model.end_and_begin_step(before, time_step_);
    if (!std::isfinite(model.last_motion().speed_squares))
      throw NumericsStopped("the kinetic energy is not finite at step " + std::to_string(steps_ + 1) +
                            ", time " + text_of(time()) +
                            " s; try a smaller Integration/Safety or Loading/Axial rate");
    add_forces();
    ++steps_;
    if (made + 1 == most || (model.breaks > 0 && model.settings().crack_log)) {
      model.end_step(time_step_);
      return made + 1;
    }
  }
  return most;
}

// All but the particles' motion. What platens do to particles is found while bonds are: its parts are small,
// for threads that are done with theirs.
void Problem::add_forces() {
  const double dt = time_step_;
  {
    dem::StageClock::Lap lap(model.clock, dem::Stage::bodies);
    drift_bodies();
  }
  std::size_t below = 0, above = 0;
  {
    dem::StageClock::Lap lap(model.clock, dem::Stage::surfaces);
    announce_motion(dt);
    below = bottom_layer.prepare(model.particles, bottom);
    above = top_layer.prepare(model.particles, top);
  }
  const auto part = [&](std::size_t p) {
    if (p < below)
      bottom_layer.compute_part(model.particles, bottom, dt, p);
    else
      top_layer.compute_part(model.particles, top, dt, p - below);
  };
  model.compute_forces(dt, dem::loop_of(below + above, part));
  dem::StageClock::Lap lap(model.clock, dem::Stage::surfaces);
  give_platen_forces();
  book_reactions();
  if (confinement_) press_skin();
  if (wall_) wall_->add_forces(model.particles, model.last_motion().fastest * dt);
  if (!settings_.loading.unload_at.empty() && axial_stage()) turn_round();
}

double Problem::confining_pressure() const {
  if (confinement_) return confinement_->pressure();
  if (!wall_) return 0;
  const dem::EndPlanes planes = end_planes();
  return wall_->pressure(planes.high - planes.low);
}

void Problem::turn_round() {
  const LoadingSettings &loading = settings_.loading;
  const double pressure = confinement_ ? confinement_->pressure() : 0.0;
  const double deviator = 0.5 * (stress_top() + stress_bottom()) - pressure;
  const double stress = loading.tension ? -deviator : deviator;
  const std::size_t turns = static_cast<std::size_t>(cycle_.turns);
  if (cycle_.direction > 0 && turns < loading.unload_at.size() && loaded_strain() >= loading.unload_at[turns])
    cycle_ = {-1, cycle_.speed, cycle_.turns + 1, loaded_strain(), stress};
  else if (cycle_.direction < 0 && stress <= loading.unload_to * cycle_.stress)
    cycle_.direction = 1;
}

void Problem::press_skin() {
  const double pressure = smooth_start(model.time / cell_ramp_) * settings_.loading.cell->pressure;
  confinement_->add_forces(model.particles, model.bonds.get(), end_planes(), pressure, time_step_,
                           model.last_motion().fastest * time_step_, steps_ % steps_between_skins == 0);
  look_at_cell();
}

bool Problem::platens_apart() {
  const SurfaceSearch &above = top_layer.search(), &below = bottom_layer.search();
  const long made = above.lists_made() + below.lists_made();
  if (made == lists_compared_) return apart_;
  lists_compared_ = made;
  std::vector<int> shared;
  std::set_intersection(above.particles().begin(), above.particles().end(), below.particles().begin(),
                        below.particles().end(), std::back_inserter(shared));
  return apart_ = shared.empty();
}

// At once where no particle feels both platens: then no sum depends on which comes first. Particles are
// sorted by height before all else, so that two threads share them out as here: each platen meets what its
// thread has at hand.
void Problem::give_platen_forces() {
  const auto above = [&] { top_layer.give_forces(model.particles, top); };
  const auto below = [&] { bottom_layer.give_forces(model.particles, bottom); };
  if (platens_apart()) return dem::both(below, above);
  above();
  below();
}

// The machine holds each platen against the particles: its work is minus theirs, by the trapezoid over the
// drift.
void Problem::book_reactions() {
  const double force_top = top.total_force()[2], force_bottom = bottom.total_force()[2];
  boundary_work_ -= 0.5 * time_step_ *
                    ((reaction_top_ + force_top) * top.velocity()[2] +
                     (reaction_bottom_ + force_bottom) * bottom.velocity()[2]);
  reaction_top_ = force_top;
  reaction_bottom_ = force_bottom;
}

double Problem::coordination_number() const {
  if (!model.bonds || model.particles.size() == 0) return 0;
  return 2.0 * static_cast<double>(model.bonds->initial_count()) /
         static_cast<double>(model.particles.size());
}

std::size_t Problem::bytes() const {
  return model.bytes() + top_layer.bytes() + bottom_layer.bytes();
}

double Problem::closure_strain() const {
  return (bottom.displacement()[2] - top.displacement()[2]) / shape_.height;
}
double Problem::stress_top() const {
  return reaction_top_ / nominal_area();
}
double Problem::stress_bottom() const {
  return -reaction_bottom_ / nominal_area();
}
double Problem::midspan_moment() const {
  const double middle = 0.5 * (end_planes().low + end_planes().high);
  return coupling::midspan_moment(top, middle) + coupling::midspan_moment(bottom, middle);
}
double Problem::swing() const {
  const double slenderness = settings_.platens.span / shape_.height;
  return 2 / pi * std::sqrt(12.0) * slenderness * slenderness * wave_crossing_;
}
double Problem::platen_speed() const {
  return bottom.velocity()[2] - top.velocity()[2];
}

dem::EnergyLedger Problem::energy() const {
  dem::EnergyLedger e = model.energy();
  if (wall_) e.contacts += wall_->elastic_energy();
  e.contacts += top_layer.elastic_energy() + bottom_layer.elastic_energy();
  e.friction += top_layer.friction_work + bottom_layer.friction_work;
  e.damping += top_layer.damping_work + bottom_layer.damping_work;
  e.boundary += boundary_work_ + (confinement_ ? confinement_->work() : 0.0);
  return e;
}

double Problem::unbalanced_ratio() const {
  if (!model.bonds || model.intact_bonds() == 0) return std::numeric_limits<double>::quiet_NaN();
  const double sum = dem::bond_totals(model.particles, *model.bonds, settings_.model.instruction_set).force;
  const double bonds = sum / static_cast<double>(model.intact_bonds());
  const double net = model.last_sums().unbalanced / static_cast<double>(model.particles.size());
  return bonds > 0 ? net / bonds : std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> Problem::numbers() const {
  std::vector<double> all{servo_ ? servo_->state()[0] : 0.0,
                          model.time,
                          time_step_,
                          static_cast<double>(steps_),
                          static_cast<double>(near_at_choice_),
                          boundary_work_,
                          reaction_top_,
                          reaction_bottom_,
                          model.works.damping,
                          model.works.fracture,
                          model.works.weight,
                          static_cast<double>(model.broken_tension),
                          static_cast<double>(model.broken_shear),
                          model.contacts ? model.contacts->friction_work : 0.0,
                          model.contacts ? model.contacts->damping_work : 0.0,
                          top_layer.friction_work,
                          top_layer.damping_work,
                          bottom_layer.friction_work,
                          bottom_layer.damping_work,
                          static_cast<double>(top_layer.closed),
                          static_cast<double>(bottom_layer.closed)};
  if (!settings_.loading.unload_at.empty())
    all.insert(all.end(), {cycle_.direction, cycle_.speed, cycle_.turns, cycle_.strain, cycle_.stress});
  if (confinement_) {
    all.push_back(cell_end_);
    const std::vector<double> more = confinement_->numbers();
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

void Problem::set_numbers(const std::vector<double> &n) {
  if (n.size() != numbers().size()) throw std::invalid_argument("a checkpoint of another version");
  if (confinement_) {
    const auto own = static_cast<std::ptrdiff_t>(confinement_->numbers().size());
    cell_end_ = *(n.end() - own - 1);
    confinement_->set_numbers({n.end() - own, n.end()});
  }
  if (!settings_.loading.unload_at.empty()) cycle_ = {n[21], n[22], n[23], n[24], n[25]};
  if (servo_) servo_->set_state({n[0]});
  model.time = n[1];
  time_step_ = n[2];
  steps_ = static_cast<long>(n[3]);
  near_at_choice_ = static_cast<std::size_t>(n[4]);
  boundary_work_ = n[5];
  reaction_top_ = n[6];
  reaction_bottom_ = n[7];
  model.works = {n[8], n[9], n[10]};
  model.broken_tension = static_cast<long>(n[11]);
  model.broken_shear = static_cast<long>(n[12]);
  if (model.contacts) model.contacts->friction_work = n[13], model.contacts->damping_work = n[14];
  top_layer.friction_work = n[15];
  top_layer.damping_work = n[16];
  bottom_layer.friction_work = n[17];
  bottom_layer.damping_work = n[18];
  top_layer.closed = static_cast<std::size_t>(n[19]);
  bottom_layer.closed = static_cast<std::size_t>(n[20]);
}

void Problem::restored() {
  top_layer.restored();
  bottom_layer.restored();
  if (wall_) wall_->forget();
  if (model.bonds) model.bonds->restored();
  if (model.contacts) model.contacts->restored();
}

} // namespace platen::coupling
