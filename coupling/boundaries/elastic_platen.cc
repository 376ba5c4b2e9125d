#include "coupling/boundaries/elastic_platen.h"

namespace platen::coupling {
namespace {

// A contact between what moves on both sides: k (a - b)^2 <= k (1 + s) a^2 + k (1 + 1/s) b^2, so that each
// side may be looked at alone.
constexpr double share_of_body = 0.25;

} // namespace

ElasticPlaten::ElasticPlaten(std::string name, fem::ElasticSolid &solid,
                             std::unique_ptr<fem::ElasticSolid> &&body, const dem::Particles &particles,
                             const SurfaceContact &contact, const FaceOf &face, bool quasi_static,
                             int steps_per_solve)
    : Platen(std::move(name), std::move(body), particles, contact),
      solid_(solid),
      face_(body_->surface(), face.tag, face.covers),
      quasi_static_(quasi_static),
      steps_per_solve_(steps_per_solve),
      loads_(body_->surface().vertices.size()) {}

void ElasticPlaten::finish(const Step &step) {
  body_->kick(0.5 * step.dt);
  Platen::finish(step);
  if (!quasi_static_) return;
  loads_.add(*body_, step.dt);
  if (loads_.steps() < steps_per_solve_) return;
  solid_.aim(loads_.mean(), steps_per_solve_ * step.dt);
  loads_.reset();
}

void ElasticPlaten::add_springs(const dem::Particles &particles, std::vector<dem::GroundSpring> &springs) {
  const std::size_t first = springs.size();
  Platen::add_springs(particles, springs);
  for (std::size_t k = first; k < springs.size(); ++k) {
    springs[k].normal_stiffness *= 1 + share_of_body;
    springs[k].tangential_stiffness *= 1 + share_of_body;
  }
}

StepLimit ElasticPlaten::limit(const dem::Particles &particles) const {
  fem::VertexSprings springs = layer_.vertex_springs(particles, *body_);
  for (std::vector<double> *column : {&springs.stiffness, &springs.dashpot})
    for (double &number : *column)
      number *= 1 + 1 / share_of_body;
  return {body_->stable_step(springs), "the finite elements of a platen with the springs of its contacts"};
}

void ElasticPlaten::fit(const dem::Particles &particles, double) {
  if (quasi_static_) solid_.set_support(layer_.vertex_springs(particles, *body_).stiffness);
}

void ElasticPlaten::add_energy(dem::EnergyLedger &energy) const {
  Platen::add_energy(energy);
  const fem::BodyBook own = body_->book();
  energy.bodies += own.strain + own.kinetic;
  energy.damping += own.dissipated;
  energy.boundary += own.clamp_work;
}

void ElasticPlaten::describe(Archive &archive) {
  Platen::describe(archive);
  if (quasi_static_) archive.part("mean_loads", loads_);
}

} // namespace platen::coupling
