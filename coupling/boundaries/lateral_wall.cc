#include "coupling/boundaries/lateral_wall.h"

namespace platen::coupling {

void LateralWall::add_springs(const dem::Particles &particles, std::vector<dem::GroundSpring> &springs) {
  wall_.make_list(particles);
  const std::vector<dem::GroundSpring> own = wall_.ground_springs(particles);
  springs.insert(springs.end(), own.begin(), own.end());
}

double LateralWall::pressure() const {
  const dem::EndPlanes planes = ends_.planes();
  return wall_.pressure(planes.high - planes.low);
}

} // namespace platen::coupling
