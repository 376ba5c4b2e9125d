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

void require(bool holds, const std::string &what) {
  if (!holds) throw std::invalid_argument("sleeve: " + what);
}

fem::Grid tube_around(const dem::Shape &shape, double low, double high, const SleeveSettings &s) {
  require(shape.kind == dem::ShapeKind::cylinder, "only a cylinder has one");
  require(s.thickness > 0, "thickness must be positive");
  require(s.elements_around >= 8, "at least 8 elements around");
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

fem::Rubber heavier(fem::Rubber rubber, double factor) {
  require(factor >= 1, "mass scaling must be at least 1");
  rubber.density *= factor;
  return rubber;
}

} // namespace

Sleeve::Sleeve(const dem::Particles &particles, const dem::Shape &shape, double low, double high,
               const SleeveSettings &settings)
    : solid(tube_around(shape, low, high, settings), heavier(settings.rubber, settings.mass_scaling),
            {fem::inner_tag}),
      layer(particles, solid, settings.contact),
      settings_(settings),
      impulse_(solid.surface().vertices.size(), fem::Point{}) {
  require(settings.safety > 0 && settings.safety <= 1, "safety must lie in (0, 1]");
  require(settings.most_steps >= 1, "an interval has at least one step");
  const std::array<bool, 3> held = {settings.bonded_rims, settings.bonded_rims, true};
  bottom_lead_ = solid.lead(solid.nodes_of(fem::low_end_tag), held);
  top_lead_ = solid.lead(solid.nodes_of(fem::high_end_tag), held);
  solid.set_damping(settings.mass_damping);
  limit_ = limit();
}

// Of the elements, and of the contacts that press now: the sum of a row of the contacts' stiffness at a
// vertex is at most that of the spheres for which it is the nearest, and half of that of the others on its
// faces (weights of a bilinear face sum to one).
double Sleeve::limit() const {
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
                                                (1 + settings_.contact.tangential_ratio);
  }
  double squared = 0; // of the contacts' frequency, 1/s^2
  for (std::size_t v = 0; v < stiffness.size(); ++v)
    squared = std::max(squared, stiffness[v] / solid.surface_mass(static_cast<int>(v)));
  const double own = 2 / solid.stable_step();
  return 2 / std::sqrt(own * own + squared);
}

void Sleeve::begin_interval(double dt, const SleeveLead &lead) {
  planned_ = std::clamp(static_cast<int>(settings_.safety * limit_ / dt), 1, settings_.most_steps);
  solid.set_pressure(fem::mantle_tag, lead.pressure);
  solid.set_lead_velocity(bottom_lead_, lead.bottom);
  solid.set_lead_velocity(top_lead_, lead.top);
  solid.half_kick(planned_ * dt);
  made_ = 0;
  elapsed_ = 0;
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

void Sleeve::take_loads(double dt) {
  for (const int v : solid.loaded_vertices()) {
    fem::Point &sum = impulse_[static_cast<std::size_t>(v)];
    sum = sum + dt * solid.contact_load(v);
  }
  if (made_ == planned_) end_interval();
}

void Sleeve::end_interval() {
  solid.drift(elapsed_);
  solid.clear_loads();
  for (std::size_t v = 0; v < impulse_.size(); ++v) {
    if (impulse_[v] == fem::Point{}) continue;
    solid.add_surface_force(static_cast<int>(v), (1 / elapsed_) * impulse_[v]);
    impulse_[v] = fem::Point{};
  }
  solid.update_forces();
  solid.half_kick(elapsed_);
  limit_ = limit();
}

std::vector<double> Sleeve::state() const {
  std::vector<double> numbers{static_cast<double>(planned_), static_cast<double>(made_), elapsed_, limit_};
  for (const fem::Point &p : impulse_)
    numbers.insert(numbers.end(), p.begin(), p.end());
  const std::vector<double> own = solid.state();
  numbers.insert(numbers.end(), own.begin(), own.end());
  return numbers;
}

void Sleeve::set_state(const std::vector<double> &numbers) {
  const std::size_t own = 4 + 3 * impulse_.size();
  require(numbers.size() > own, "a state of another sleeve");
  solid.set_state({numbers.begin() + static_cast<std::ptrdiff_t>(own), numbers.end()});
  planned_ = static_cast<int>(numbers[0]);
  made_ = static_cast<int>(numbers[1]);
  elapsed_ = numbers[2];
  limit_ = numbers[3];
  for (std::size_t k = 0; k < 3 * impulse_.size(); ++k)
    impulse_[k / 3][k % 3] = numbers[4 + k];
  if (made_ < planned_) solid.place_surface_ahead(elapsed_);
}

} // namespace platen::coupling
