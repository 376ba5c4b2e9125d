#include "coupling/boundary.h"

namespace platen::coupling {

std::size_t ContactBoundary::prepare(const dem::Particles &particles, const Step &step) {
  layer().moved(step.farthest + farthest(step));
  return layer().prepare(particles, surface());
}

void ContactBoundary::compute_part(const dem::Particles &particles, const Step &step, std::size_t part) {
  layer().compute_part(particles, surface(), step.dt, part);
}

void ContactBoundary::apply_forces(dem::Particles &particles, const Step &) {
  layer().give_forces(particles, surface());
}

void ContactBoundary::add_springs(const dem::Particles &particles, std::vector<dem::GroundSpring> &springs) {
  layer().make_list(particles, surface());
  const std::vector<dem::GroundSpring> own = layer().ground_springs(particles, surface());
  springs.insert(springs.end(), own.begin(), own.end());
}

void ContactBoundary::add_energy(dem::EnergyLedger &energy) const {
  energy.contacts += layer().elastic_energy();
  energy.friction += layer().friction_work;
  energy.damping += layer().damping_work;
}

} // namespace platen::coupling
