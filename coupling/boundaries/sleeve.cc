#include "coupling/boundaries/sleeve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/pi.h"
#include "base/portable.h"
#include "base/require.h"
#include "base/state.h"
#include "coupling/boundary.h"
#include "fem/load_solids.h"

namespace platen::coupling {

namespace {

// The elements' own limit costs as much as twenty of their steps and changes with their shape alone.
constexpr int intervals_between_limits = 100;
// Intervals of this many steps make a sleeve cheap. Springs grow with the pressure; so does the mass of the
// sleeve, and its inertia force stays the same small fraction of the pressure.
constexpr double steps_of_cheap_interval = 8, steps_of_cheap_tube = 4;
constexpr double bound_over_mean =
    2.5; // row sum of the contacts' stiffness: all of the nearest sphere, half of three others

// Faces of this many mean radii touch four spheres or so; on smaller ones the rubber enters gaps between
// them.
constexpr double radii_of_face = 5;
constexpr int fewest_around = 8;

int elements_around(const dem::Particles &particles, const dem::Shape &shape, const SleeveSettings &s) {
  if (s.elements_around > 0) return s.elements_around;
  double sum = 0; // m
  for (const double r : particles.radius)
    sum += r;
  const double face = radii_of_face * sum / static_cast<double>(particles.size());
  return std::max(fewest_around, static_cast<int>(std::lround(2 * pi * shape.radius / face)));
}

fem::Grid tube_around(const dem::Shape &shape, double low, double high, const SleeveSettings &s) {
  require(shape.kind == dem::ShapeKind::cylinder, "sleeve: only a cylinder has one");
  require(s.thickness > 0, "sleeve: thickness must be positive");
  require(s.elements_around >= fewest_around, "sleeve: at least 8 elements around");
  require(s.elements_along >= 0, "sleeve: elements along must not be negative");
  require(high > low, "sleeve: its ends must lie apart");
  fem::Tube tube;
  tube.inner_radius = (shape.radius + s.gap) / portable::cos(pi / s.elements_around);
  tube.thickness = s.thickness;
  tube.z_low = low;
  tube.height = high - low;
  tube.elements_around = s.elements_around;
  const double width = 2 * pi * (shape.radius + s.gap) / s.elements_around;
  tube.elements_along = s.elements_along > 0
                            ? s.elements_along
                            : std::max(2, static_cast<int>(std::lround(tube.height / width)));
  tube.elements_through = s.elements_through;
  return fem::make_grid(tube);
}

SleeveSettings with_elements(const dem::Particles &particles, const dem::Shape &shape, SleeveSettings s) {
  s.elements_around = elements_around(particles, shape, s);
  return s;
}

double inner_area(const fem::HyperelasticSolid &solid) { // m^2
  double area = 0;
  for (std::size_t face = 0; face < solid.surface().faces.size(); ++face)
    area += norm(fem::face_area_vector(solid.surface(), face));
  return area;
}

} // namespace

Sleeve::Sleeve(const dem::Particles &particles, const dem::Shape &shape, double low, double high,
               const SleeveSettings &settings)
    : ContactBoundary("sleeve"),
      settings_(with_elements(particles, shape, settings)),
      shape_(shape),
      low_(low),
      high_(high) {
  require(settings.safety > 0 && settings.safety <= 1, "sleeve: safety must lie in (0, 1]");
  require(settings.most_steps >= 1, "sleeve: an interval has at least one step");
  require(settings.mass_scaling == 0 || settings.mass_scaling >= 1,
          "sleeve: mass scaling must be 0, or at least 1");
  build(particles);
}

Sleeve::Sleeve(const dem::Particles &particles, const dem::Shape &shape, const EndPlatens &ends,
               const SleeveSettings &settings)
    : Sleeve(particles, shape, ends.planes().low + (settings.recess > 0 ? 0 : settings.clearance),
             ends.planes().high - settings.clearance, settings) {
  ends_.emplace(ends);
  if (top_turns() && held_above()) solid_->prescribe_each(top_motion_);
}

void Sleeve::build(const dem::Particles &particles) {
  const double stiff = wraps() ? settings_.wrap->resin_modulus : settings_.young_modulus;
  fem::SolidMaterial wall{settings_.density * mass_scaling(),
                          fem::NeoHookean::from_young(stiff, settings_.poisson_ratio)};
  if (settings_.metal) wall.hardening = settings_.metal->hardening(settings_.young_modulus);
  const double radius = shape_.radius + settings_.gap;
  if (wraps())
    wall.fibres =
        settings_.wrap->fibres(settings_.young_modulus, radius, 2 * pi * radius / settings_.elements_around);
  fem::load_solids();
  solid_ = std::make_unique<fem::HyperelasticSolid>(tube_around(shape_, low_, high_, settings_), wall,
                                                    std::vector<int>{fem::inner_tag});
  contact_ = std::make_unique<ContactLayer>(particles, *solid_, settings_.contact);
  hold_rims();
  solid_->set_damping(settings_.mass_damping);
  limit_ = find_limit();
  const double gap = settings_.gap;
  if (settings_.seat_depth > 0)
    contact_->seat_within(particles, *solid_, settings_.seat_depth + gap, false,
                          [gap](const Vector3 &) { return gap; });
  if (is_bonded()) contact_->bond_seats(particles, inner_area(*solid_));
  volume_at_start_ = inner_volume();
  ring_ = solid_->volume() / (high_ - low_);
}

void Sleeve::hold_rims() {
  const std::array<bool, 3> fixed = {settings_.bonded_rims, settings_.bonded_rims, true};
  const std::vector<int> below = solid_->nodes_of(fem::low_end_tag),
                         above = solid_->nodes_of(fem::high_end_tag);
  if (held_below()) bottom_motion_ = solid_->prescribe(below, fixed);
  bottom_rim_ = static_cast<std::size_t>(below.front());
  if (!held_above()) return;
  top_motion_ = solid_->prescribe(above, fixed);
  top_rim_ = static_cast<std::size_t>(above.front());
  top_rim_nodes_ = above;
  top_rim_places_.clear();
  for (const int node : above)
    top_rim_places_.push_back(solid_->node_place(node) - Vector3{0, 0, high_});
  if (top_turns()) solid_->prescribe_each(top_motion_);
}

// As in the sleeve's own limit when all spheres flush with it press evenly.
double Sleeve::cheap_mass(double time_step) const {
  double mass = 0; // kg, of the face that touches the spheres
  for (std::size_t v = 0; v < solid_->surface().vertices.size(); ++v)
    mass += solid_->surface_mass(static_cast<int>(v));
  const SurfaceContact &p = contact_->parameters();
  const double springs =
      bound_over_mean * contact_->seats() * p.particle_stiffness * std::max(1.0, p.tangential_ratio);
  const double interval =
      (is_rubber() ? steps_of_cheap_interval : steps_of_cheap_tube) * time_step / settings_.safety;
  // Rubber's own limit is far above that of its contacts.
  const double own = is_rubber() ? 0.0 : 1 / (own_limit_ * own_limit_);
  return std::max(1.0, (own + springs / mass * 0.25) * interval * interval);
}

void Sleeve::fit(const dem::Particles &particles, double time_step) {
  if (settings_.mass_scaling > 0) return;
  settings_.mass_scaling = cheap_mass(time_step);
  build(particles);
}

void Sleeve::drift(const Step &step, const Command &command) {
  RimMotion rims;
  rims.bottom = ends_->low.body().velocity();
  rims.top = ends_->high.body().velocity();
  rims.pressure = command.pressure;
  rims.bottom_place = {0, 0, ends_->low.closure()};
  rims.top_place = {0, 0, -ends_->high.closure()};
  if (top_turns()) {
    rims.top_rotation = ends_->high.body().rotation();
    rims.top_angular_velocity = ends_->high.body().angular_velocity();
  }
  move(step.dt, rims);
}

void Sleeve::finish(const Step &step) {
  if (made_ == planned_ && ends_ && !held_above()) require_clear_ends(step);
  try {
    take_loads();
  } catch (const fem::InvertedElement &e) {
    throw NumericsStopped(
        "step " + std::to_string(step.number + 1) + ": the sleeve would turn inside out: " + e.what() +
        "; try wider elements (`sleeve.elements_around`), a thicker or a stiffer sleeve, or "
        "a slower `loading.rate`");
  }
}

// A lower end that is held goes with its platen, in front of this plane.
void Sleeve::require_clear_ends(const Step &step) const {
  for (const auto &[tag, sense, plane] :
       {std::tuple{fem::low_end_tag, -1.0, low_ - settings_.clearance + ends_->low.closure()},
        {fem::high_end_tag, 1.0, high_ + settings_.clearance - ends_->high.closure()}})
    for (const int node : solid_->nodes_of(tag))
      if (sense * (solid_->node_place(node).z - plane) > 0)
        throw NumericsStopped("step " + std::to_string(step.number + 1) +
                              ": a platen has come to the end of the tube, which "
                              "is loaded by the concrete alone; try a longer `sleeve.clearance` or a lower "
                              "`loading.target_strain`");
}

void Sleeve::add_energy(dem::EnergyLedger &energy) const {
  ContactBoundary::add_energy(energy);
  energy.damping += lost();
  energy.plastic += solid_->plastic_work();
  energy.fracture += solid_->torn_energy();
  energy.bodies += stored();
  energy.boundary += work();
}

void Sleeve::apply_forces(dem::Particles &particles, const Step &) {
  contact_->apply_forces(particles, nullptr);
  loads_due_ = true;
  if (made_ == planned_) with_loads();
}

fem::HyperelasticSolid &Sleeve::with_loads() const {
  if (loads_due_) contact_->load_body(*solid_);
  loads_due_ = false;
  return *solid_;
}

double Sleeve::axial_force_beyond_pressure() const {
  const fem::HyperelasticSolid &solid = with_loads();
  if (!held_below()) return 0;
  const double bottom = solid.prescribed_force(bottom_motion_)[2], // N, of the platens on the sleeve
      top = held_above() ? solid.prescribed_force(top_motion_)[2] : 0;
  return 0.5 * (bottom - top) - pressure() * ring_;
}

double Sleeve::confined_fraction() const {
  if (!(pressure() > 0)) return std::numeric_limits<double>::quiet_NaN();
  if (!std::isnan(fraction_read_)) return fraction_read_;
  const fem::SurfaceMesh &inner = solid_->surface();
  std::vector<char> bears(inner.faces.size(), 0);
  contact_->visit_contacts([&](int face, const Vector3 &) { bears[static_cast<std::size_t>(face)] = 1; });
  double loaded = 0, all = 0; // m^2
  for (std::size_t face = 0; face < bears.size(); ++face) {
    const double area = norm(fem::face_area_vector(inner, face));
    all += area;
    if (bears[face] != 0) loaded += area;
  }
  return loaded / all;
}

// Of the elements, and of the contacts that press now: the row sum of the contacts' stiffness at a vertex is
// at most that of the spheres for which it is the nearest, plus half of that of the others on its faces
// (weights of a bilinear face have the sum one).
double Sleeve::find_limit() {
  if (std::fmod(intervals_, intervals_between_limits) == 0) own_limit_ = solid_->stable_step();
  const fem::SurfaceMesh &surface = solid_->surface();
  std::vector<double> stiffness(surface.vertices.size(), 0.0);
  const double stiffest =
      settings_.contact.particle_stiffness * std::max(1.0, settings_.contact.tangential_ratio);
  contact_->visit_contacts([&](int number, const Vector3 &place) {
    const std::array<int, 4> &face = surface.faces[static_cast<std::size_t>(number)];
    std::array<double, 4> far;
    for (std::size_t k = 0; k < 4; ++k)
      far[k] = norm(surface.vertices[static_cast<std::size_t>(face[k])] - place);
    const auto nearest = std::min_element(far.begin(), far.end()) - far.begin();
    for (std::size_t k = 0; k < 4; ++k)
      stiffness[static_cast<std::size_t>(face[k])] +=
          (static_cast<std::ptrdiff_t>(k) == nearest ? 1.0 : 0.5) * stiffest;
  });
  double squared = 0; // of the contacts' frequency, 1/s^2
  for (std::size_t v = 0; v < stiffness.size(); ++v)
    squared = std::max(squared, stiffness[v] / solid_->surface_mass(static_cast<int>(v)));
  const double own = 2 / own_limit_;
  return 2 / std::sqrt(own * own + squared);
}

int Sleeve::steps_of_next_interval(double dt) const {
  return std::clamp(static_cast<int>(settings_.safety * limit_ / dt), 1, settings_.most_steps);
}

void Sleeve::begin_interval(double dt, const RimMotion &rims) {
  planned_ = steps_of_next_interval(dt);
  solid_->set_pressure(fem::mantle_tag, rims.pressure);
  made_ = 0;
  elapsed_ = 0;
  kick_into(planned_ * dt, dt, rims);
  // A half-kick back reverts one, drag and work included. drift() reports an inversion in a single step.
  while (planned_ > 1 && !solid_->can_drift(planned_ * dt)) {
    solid_->half_kick(-planned_ * dt);
    planned_ /= 2;
    ++cuts_;
    kick_into(planned_ * dt, dt, rims);
  }
}

// Platens have already made the first step of the interval.
void Sleeve::kick_into(double interval, double dt, const RimMotion &rims) {
  const auto follow = [&](int number, std::size_t node, const Vector3 &velocity, const Vector3 &place) {
    const Vector3 &rim = solid_->displacement()[node];
    solid_->set_prescribed_velocity(number, (1 / interval) * (place + (interval - dt) * velocity - rim));
  };
  if (held_below()) follow(bottom_motion_, bottom_rim_, rims.bottom, rims.bottom_place);
  if (held_above() && top_turns())
    turn_top_rim(interval, dt, rims);
  else if (held_above())
    follow(top_motion_, top_rim_, rims.top, rims.top_place);
  solid_->half_kick(interval);
}

// Moves each node straight to its future position on the platen: to its own point of the face, or, where it
// slides, into the plane of the face above or below its own x and y.
void Sleeve::turn_top_rim(double interval, double dt, const RimMotion &rims) {
  const double ahead = interval - dt;
  const Quaternion turned =
      normalised(normalised(rotation_quaternion(ahead * rims.top_angular_velocity)) * rims.top_rotation);
  const Vector3 middle = Vector3{0, 0, high_} + rims.top_place + ahead * rims.top;
  const Vector3 normal = rotate(turned, {0, 0, 1});
  std::vector<Vector3> velocities(top_rim_nodes_.size());
  for (std::size_t k = 0; k < velocities.size(); ++k) {
    const Vector3 now = solid_->node_place(top_rim_nodes_[k]);
    Vector3 there = middle + rotate(turned, top_rim_places_[k]);
    if (!settings_.bonded_rims) {
      const Vector3 offset = now - middle;
      there = {now.x, now.y, middle.z - (normal.x * offset.x + normal.y * offset.y) / normal.z};
    }
    velocities[k] = (1 / interval) * (there - now);
  }
  solid_->set_node_velocities(top_motion_, velocities);
}

void Sleeve::move(double dt, const RimMotion &rims) {
  if (made_ == planned_) begin_interval(dt, rims);
  ++made_;
  elapsed_ += dt;
  solid_->place_surface_ahead(elapsed_);
  solid_->clear_loads();
  loads_due_ = false;
}

// The loads of the last step are still on the surface.
void Sleeve::take_loads() {
  fraction_read_ = std::numeric_limits<double>::quiet_NaN();
  if (made_ < planned_) return;
  solid_->drift(elapsed_, planned_ > 1); // checked when the interval began
  solid_->update_forces();
  solid_->half_kick(elapsed_);
  ++intervals_;
  limit_ = find_limit();
}

void Sleeve::describe(Archive &archive) {
  archive.version(1);
  archive("planned_steps", planned_, "1",
          at_least(0)); // more than the settings give, after an interval was halved
  archive("steps_made", made_, "1", at_least(0));
  archive("elapsed", elapsed_, "s", at_least(0));
  archive("limit", limit_, "s", above(0));
  archive("limit_of_elements", own_limit_, "s", above(0));
  archive("intervals", intervals_, "1", at_least(0));
  archive("cuts", cuts_, "1", at_least(0));
  if (const StateSource *state = archive.looks_at()) {
    const int planned = rows_of<int>(*state, archive.path("planned_steps")).at(0),
              made = rows_of<int>(*state, archive.path("steps_made")).at(0);
    if (made > planned)
      refuse_row(archive.path("steps_made"), 0, std::to_string(made), "0 ... " + std::to_string(planned));
  }
  try {
    archive.part("solid", with_loads());
  } catch (const fem::InvertedElement &e) {
    throw StateError(std::string("the sleeve of the state is inside out: ") + e.what());
  }
  archive.part("contacts", *contact_);
  double fraction = archive.writes() ? confined_fraction() : 0;
  archive("confined_share", fraction, "1", std::numeric_limits<double>::quiet_NaN(), or_nan(between(0, 1)));
  if (archive.reads()) fraction_read_ = fraction;
  if (archive.reads() && made_ < planned_) solid_->place_surface_ahead(elapsed_);
}

} // namespace platen::coupling
