#include "coupling/boundaries/platen.h"

#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "base/shortest_text.h"

namespace platen::coupling {

namespace {

// A face is evaluated at the middles of this many parts along each side.
constexpr int parts = 8;

// A contact between two moving sides: k (a - b)^2 <= k (1 + s) a^2 + k (1 + 1/s) b^2, so that each side may
// be treated by itself.
constexpr double fraction_of_body = 0.25;

// Contact of a platen with its neighbours is checked after so many steps: it moves by far less.
constexpr long steps_between_edges = 100;

} // namespace

void MeanLoads::add(const fem::Body &body, double dt) {
  for (const int v : body.loaded_vertices())
    impulse_[static_cast<std::size_t>(v)] = impulse_[static_cast<std::size_t>(v)] + dt * body.contact_load(v);
  time_ += dt;
  ++steps_;
}

std::vector<Vector3> MeanLoads::mean() const {
  std::vector<Vector3> loads(impulse_);
  for (Vector3 &load : loads)
    load = (1 / time_) * load;
  return loads;
}

void MeanLoads::reset() {
  impulse_.assign(impulse_.size(), Vector3{});
  time_ = 0;
  steps_ = 0;
}

void MeanLoads::describe(Archive &archive) {
  archive.version(1);
  archive("time", time_, "s", at_least(0));
  archive("steps", steps_, "1", at_least(0));
  archive.same_rows("impulse", impulse_, "N s");
}

MeanPlace::MeanPlace(const fem::SurfaceMesh &surface, const FaceOf &face, const Vector3 &direction)
    : direction_(direction) {
  std::vector<double> part(surface.vertices.size(), 0.0), full(part);
  double covered = 0, all = 0;
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    if (surface.face_tags[f] != face.tag) continue;
    const std::array<int, 4> &corners = surface.faces[f];
    const double area = norm(fem::face_area_vector(surface, f)) / (parts * parts);
    for (int k = 0; k < parts * parts; ++k) {
      const double s = (k % parts + 0.5) / parts, t = (k / parts + 0.5) / parts;
      const std::array<double, 4> weights = {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
      Vector3 place{};
      for (std::size_t c = 0; c < 4; ++c)
        place = place + weights[c] * surface.vertices[static_cast<std::size_t>(corners[c])];
      const bool inside = face.covers(place);
      for (std::size_t c = 0; c < 4; ++c) {
        const std::size_t v = static_cast<std::size_t>(corners[c]);
        full[v] += weights[c] * area;
        if (inside) part[v] += weights[c] * area;
      }
      all += area;
      if (inside) covered += area;
    }
  }
  if (!(all > 0)) throw std::invalid_argument("mean place: no face has the tag " + std::to_string(face.tag));
  const std::vector<double> &area = covered > 0 ? part : full;
  for (std::size_t v = 0; v < area.size(); ++v) {
    if (area[v] == 0) continue;
    vertices_.push_back(static_cast<int>(v));
    weights_.push_back(area[v] / (covered > 0 ? covered : all));
  }
  start_ = now(surface);
}

double MeanPlace::now(const fem::SurfaceMesh &surface) const {
  double mean = 0;
  for (std::size_t k = 0; k < vertices_.size(); ++k)
    mean += weights_[k] * dot(surface.vertices[static_cast<std::size_t>(vertices_[k])], direction_);
  return mean;
}

Platen::Platen(std::string name, const Vector3 &inward, std::unique_ptr<fem::Body> body,
               const dem::Particles &particles, const SurfaceContact &contact)
    : ContactBoundary(std::move(name)),
      inward_(inward),
      body_(std::move(body)),
      layer_(particles, *body_, contact) {}

void Platen::drift(const Step &step, const Command &command) {
  if (machine_)
    drift_on_spring(step, command);
  else
    move(step, command.velocity);
}

void Platen::move(const Step &step, const Vector3 &velocity) {
  body_->set_velocity(velocity);
  body_->kick(0.5 * step.dt);
  body_->drift(step.dt);
  body_->clear_loads();
}

void Platen::drift_on_spring(const Step &step, const Command &command) {
  const double along = dot(command.velocity, inward_);
  const double speed = machine_->drift(along, load(), step.dt);
  move(step, command.velocity + (speed - along) * inward_);
}

void Platen::finish(const Step &step) {
  const Vector3 before = force_;
  force_ = body_->total_force();
  forces_ = before + force_;
  if (machine_) finish_on_spring(step);
  if (step.number % steps_between_edges != 0 || closure() < clearance_) return;
  throw NumericsStopped("the platen " + name() + " has closed by " + text_of(closure()) + " m at " +
                        text_of(step.time) + " s and meets the edges of its neighbours; try a larger " +
                        "`platens.edge_gap` than " + text_of(clearance_) + " m");
}

bool Platen::is_finite() const {
  return std::isfinite(force_[0] + force_[1] + force_[2]);
}

ServoLoad Platen::servo_load(const dem::Particles &particles) const {
  ServoLoad load = layer_.servo_load(particles);
  if (machine_) load.impedance += machine_->servo_impedance();
  return load;
}

void Platen::add_energy(dem::EnergyLedger &energy) const {
  ContactBoundary::add_energy(energy);
  if (!machine_) return;
  energy.bodies += machine_->elastic_energy() + kinetic_energy_on_spring();
  energy.damping += machine_->damping_work();
}

double Platen::seconds_on_spring(const fem::VertexSprings &shared) const {
  const auto sum = [](const std::vector<double> &of) { return std::accumulate(of.begin(), of.end(), 0.0); };
  return machine_->stable_step(sum(shared.stiffness), sum(shared.dashpot));
}

std::vector<dem::GroundSpring> Platen::total_springs(const dem::Particles &particles) {
  layer_.make_list(particles, *body_);
  return layer_.ground_springs(particles, *body_, true);
}

void Platen::add_shared_springs(const dem::Particles &particles, std::vector<dem::GroundSpring> &springs) {
  const std::size_t first = springs.size();
  Platen::add_springs(particles, springs);
  for (std::size_t k = first; k < springs.size(); ++k) {
    springs[k].normal_stiffness *= 1 + fraction_of_body;
    springs[k].tangential_stiffness *= 1 + fraction_of_body;
    if (glued()) springs[k].rotational_stiffness *= 1 + fraction_of_body;
  }
}

fem::VertexSprings Platen::shared_springs(const dem::Particles &particles) const {
  fem::VertexSprings springs = layer_.vertex_springs(particles, *body_);
  for (std::vector<double> *column : {&springs.stiffness, &springs.dashpot})
    for (double &number : *column)
      number *= 1 + 1 / fraction_of_body;
  return springs;
}

// The mean of the moments from the forces left and right of the middle.
double Platen::midspan_moment(double z) const {
  const fem::SurfaceMesh &mesh = body_->surface();
  double sum = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vector3 &load = body_->contact_load(static_cast<int>(v)), &x = mesh.vertices[v];
    // Force on the bar: -load. Upward at |x|, or outward below z, it causes tension on the lower side.
    const double outwards = std::copysign(1.0, x[0]) * load[0];
    sum += -load[2] * std::abs(x[0]) - outwards * (z - x[2]);
  }
  return 0.5 * sum;
}

void Platen::describe(Archive &archive) {
  archive.version(1);
  archive("force", force_, "N");
  archive.part("body", *body_);
  archive.part("contacts", layer_);
  if (machine_) archive.part("machine", *machine_);
}

void RigidPlaten::add_springs(const dem::Particles &particles, std::vector<dem::GroundSpring> &springs) {
  if (machine_)
    add_shared_springs(particles, springs);
  else
    Platen::add_springs(particles, springs);
}

StepLimit RigidPlaten::limit(const dem::Particles &particles) const {
  if (!machine_) return {};
  return {seconds_on_spring(shared_springs(particles)),
          "a platen on the spring of the machine and those of its contacts"};
}

void DynamicPlaten::finish(const Step &step) {
  body_->kick(0.5 * step.dt);
  Platen::finish(step);
}

void DynamicPlaten::add_springs(const dem::Particles &particles, std::vector<dem::GroundSpring> &springs) {
  add_shared_springs(particles, springs);
}

StepLimit DynamicPlaten::limit(const dem::Particles &particles) const {
  fem::VertexSprings springs = shared_springs(particles);
  if (!machine_) return {body_->stable_step(springs), reason_of_limit()};
  springs.clamp = machine_->settings().stiffness;
  // The squared frequencies of the body's own motion and of its motion on the spring add up at most, and so
  // do the dashpots.
  const double own = body_->stable_step(springs), on_machine = seconds_on_spring(springs);
  return {1 / (1 / own + 1 / on_machine), reason_of_limit() + ", on the spring of the machine"};
}

void DynamicPlaten::add_energy(dem::EnergyLedger &energy) const {
  Platen::add_energy(energy);
  const fem::EnergyBalance own = body_->energy_balance();
  energy.bodies += own.strain + own.kinetic;
  energy.damping += own.dissipated;
  energy.plastic += own.plastic;
  energy.friction += own.rubbed;
  energy.unbalanced += own.unbalanced;
  energy.boundary += own.clamp_work;
}

ElasticPlaten::ElasticPlaten(std::string name, const Vector3 &inward, fem::ElasticSolid &solid,
                             std::unique_ptr<fem::ElasticSolid> &&body, const dem::Particles &particles,
                             const SurfaceContact &contact, const FaceOf &face, bool quasi_static,
                             int steps_per_solve)
    : DynamicPlaten(std::move(name), inward, std::move(body), particles, contact),
      solid_(solid),
      face_(body_->surface(), face, inward),
      quasi_static_(quasi_static),
      steps_per_solve_(steps_per_solve),
      loads_(body_->surface().vertices.size()) {}

void ElasticPlaten::finish(const Step &step) {
  DynamicPlaten::finish(step);
  if (!quasi_static_) return;
  loads_.add(*body_, step.dt);
  if (loads_.steps() < steps_per_solve_) return;
  solid_.solve_for(loads_.mean(), steps_per_solve_ * step.dt);
  loads_.reset();
}

void ElasticPlaten::drift_on_spring(const Step &step, const Command &command) {
  const double along = dot(command.velocity, inward_), start = dot(body_->displacement(), inward_);
  solid_.push(0.5 * step.dt * machine_->push(along));
  move(step, command.velocity - along * inward_ + solid_.sliding_velocity() * inward_);
  machine_->follow(dot(body_->displacement(), inward_) - start, step.dt);
}

void ElasticPlaten::finish_on_spring(const Step &step) {
  solid_.push(machine_->finish_push(solid_.sliding_velocity(), solid_.sliding_mass(), step.dt));
}

void ElasticPlaten::fit(const dem::Particles &particles, double time_step) {
  if (!quasi_static_) return;
  solid_.set_support(layer_.vertex_springs(particles, *body_).stiffness);
  seconds_behind_ = solid_.solves_behind(inward_) * steps_per_solve_ * time_step;
}

void ElasticPlaten::describe(Archive &archive) {
  Platen::describe(archive);
  if (quasi_static_) archive.part("mean_loads", loads_);
}

} // namespace platen::coupling
