#include "coupling/sleeve.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace platen::coupling {

// fem::Point is an array: its operators are not found by its type.
using fem::operator+;
using fem::operator-;
using fem::operator*;

namespace {

constexpr double pi = 3.14159265358979323846;
// The elements' own limit costs as much as twenty of their steps and changes with their shape alone.
constexpr int intervals_between_limits = 100;

void require(bool holds, const std::string &what) {
  if (!holds) throw std::invalid_argument("sleeve: " + what);
}

// Faces of this many mean radii meet four spheres or so; with fewer the rubber is driven into the gaps
// between them.
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
  require(shape.kind == dem::ShapeKind::cylinder, "only a cylinder has one");
  require(s.thickness > 0, "thickness must be positive");
  require(s.elements_around >= fewest_around, "at least 8 elements around");
  require(s.elements_along >= 0, "elements along must not be negative");
  require(high > low, "its ends must lie apart");
  fem::Tube tube;
  tube.inner_radius = shape.radius / std::cos(pi / s.elements_around);
  tube.thickness = s.thickness;
  tube.z_low = low;
  tube.height = high - low;
  tube.elements_around = s.elements_around;
  const double width = 2 * pi * shape.radius / s.elements_around;
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

fem::Rubber heavier(fem::Rubber rubber, double factor) {
  require(factor >= 1, "mass scaling must be at least 1");
  rubber.density *= factor;
  return rubber;
}

} // namespace

Sleeve::Sleeve(const dem::Particles &particles, const dem::Shape &shape, double low, double high,
               const SleeveSettings &settings)
    : solid(tube_around(shape, low, high, with_elements(particles, shape, settings)),
            heavier(settings.rubber, settings.mass_scaling), {fem::inner_tag}),
      layer(particles, solid, settings.contact),
      settings_(settings) {
  require(settings.safety > 0 && settings.safety <= 1, "safety must lie in (0, 1]");
  require(settings.most_steps >= 1, "an interval has at least one step");
  const std::array<bool, 3> held = {settings.bonded_rims, settings.bonded_rims, true};
  const std::vector<int> below = solid.nodes_of(fem::low_end_tag), above = solid.nodes_of(fem::high_end_tag);
  bottom_lead_ = solid.lead(below, held);
  top_lead_ = solid.lead(above, held);
  bottom_rim_ = static_cast<std::size_t>(below.front());
  top_rim_ = static_cast<std::size_t>(above.front());
  solid.set_damping(settings.mass_damping);
  limit_ = limit();
}

// Of the elements, and of the contacts that press now: the sum of a row of the contacts' stiffness at a
// vertex is at most that of the spheres for which it is the nearest, and half of that of the others on its
// faces (weights of a bilinear face sum to one).
double Sleeve::limit() {
  if (std::fmod(intervals_, intervals_between_limits) == 0) own_limit_ = solid.stable_step();
  const fem::SurfaceMesh &surface = solid.surface();
  std::vector<double> stiffness(surface.vertices.size(), 0.0);
  for (const ActiveContact &c : layer.contacts()) {
    const std::array<int, 4> &face = surface.faces[static_cast<std::size_t>(c.face)];
    const fem::Point at = {c.point.x, c.point.y, c.point.z};
    const auto far = [&](int v) { return fem::norm(surface.vertices[static_cast<std::size_t>(v)] - at); };
    const int nearest =
        *std::min_element(face.begin(), face.end(), [&](int a, int b) { return far(a) < far(b); });
    for (const int v : face)
      stiffness[static_cast<std::size_t>(v)] += (v == nearest ? 1.0 : 0.5) *
                                                settings_.contact.particle_stiffness *
                                                std::max(1.0, settings_.contact.tangential_ratio);
  }
  double squared = 0; // of the contacts' frequency, 1/s^2
  for (std::size_t v = 0; v < stiffness.size(); ++v)
    squared = std::max(squared, stiffness[v] / solid.surface_mass(static_cast<int>(v)));
  const double own = 2 / own_limit_;
  return 2 / std::sqrt(own * own + squared);
}

int Sleeve::steps_of_next_interval(double dt) const {
  return std::clamp(static_cast<int>(settings_.safety * limit_ / dt), 1, settings_.most_steps);
}

void Sleeve::begin_interval(double dt, const SleeveLead &lead) {
  planned_ = steps_of_next_interval(dt);
  solid.set_pressure(fem::mantle_tag, lead.pressure);
  made_ = 0;
  elapsed_ = 0;
  kick_into(planned_ * dt, dt, lead);
  // A half-kick back undoes one, drag and works included. What a single step inverts is told by drift().
  while (planned_ > 1 && !solid.can_drift(planned_ * dt)) {
    solid.half_kick(-planned_ * dt);
    planned_ /= 2;
    ++cuts_;
    kick_into(planned_ * dt, dt, lead);
  }
}

// Platens have made the first step of the interval already.
void Sleeve::kick_into(double interval, double dt, const SleeveLead &lead) {
  const auto follow = [&](int number, std::size_t node, const fem::Point &velocity, const fem::Point &place) {
    const fem::Point &rim = solid.displacement()[node];
    solid.set_lead_velocity(number, (1 / interval) * (place + (interval - dt) * velocity - rim));
  };
  follow(bottom_lead_, bottom_rim_, lead.bottom, lead.bottom_place);
  follow(top_lead_, top_rim_, lead.top, lead.top_place);
  solid.half_kick(interval);
}

void Sleeve::move(double dt, const SleeveLead &lead) {
  if (made_ == planned_) begin_interval(dt, lead);
  ++made_;
  elapsed_ += dt;
  solid.place_surface_ahead(elapsed_);
  solid.clear_loads();
}

double Sleeve::largest_move(double dt) const {
  return solid.largest_move(dt);
}

// The loads of the last step stand on the surface.
void Sleeve::take_loads() {
  if (made_ < planned_) return;
  solid.drift(elapsed_);
  solid.update_forces();
  solid.half_kick(elapsed_);
  ++intervals_;
  limit_ = limit();
}

void Sleeve::describe(Archive &archive) {
  archive.version(1);
  archive("planned_steps", planned_);
  archive("steps_made", made_);
  archive("elapsed", elapsed_, "s");
  archive("limit", limit_, "s");
  archive("limit_of_elements", own_limit_, "s");
  archive("intervals", intervals_);
  archive("cuts", cuts_);
  archive.part("solid", solid);
  archive.part("contacts", layer);
  if (archive.reads() && made_ < planned_) solid.place_surface_ahead(elapsed_);
}

} // namespace platen::coupling
