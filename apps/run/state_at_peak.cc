#include "apps/run/state_at_peak.h"

namespace platen::apps {

StateAtPeak::Place StateAtPeak::place_of(const coupling::Platen &platen) {
  const Vector3 &moved = platen.body().displacement(), &inward = platen.inward();
  return {moved + (platen.closure() - dot(moved, inward)) * inward, platen.body().rotation()};
}

void StateAtPeak::keep(const coupling::PlatenTest &problem) {
  const dem::Particles &p = problem.model.particles;
  position_.assign(p.position.begin(), p.position.end());
  platens_ = {place_of(problem.bottom()), place_of(problem.top())};
}

dem::MotionAfterPeak StateAtPeak::motion_since(const coupling::PlatenTest &problem) const {
  dem::MotionAfterPeak motion;
  if (position_.empty()) return motion;
  const dem::Particles &p = problem.model.particles;
  motion.displacement.resize(position_.size());
  for (std::size_t i = 0; i < position_.size(); ++i)
    motion.displacement[i] = p.position[i] - position_[i];
  for (const dem::End end : {dem::bottom_end, dem::top_end}) {
    const Place now = place_of(end == dem::top_end ? problem.top() : problem.bottom()), &then = platens_[end];
    // Small turns: twice the vector part of the rotation between the two.
    const Quaternion turned = now.rotation * conjugate(then.rotation);
    motion.platens[end] = {now.displacement - then.displacement,
                           (turned.w < 0 ? -2 : 2) * vector_part(turned)};
  }
  return motion;
}

void StateAtPeak::describe(Archive &archive) {
  archive.version(1);
  archive.rows("position", position_, "m");
  archive("bottom_displacement", platens_[dem::bottom_end].displacement, "m");
  archive("bottom_rotation", platens_[dem::bottom_end].rotation, "1", unit_length());
  archive("top_displacement", platens_[dem::top_end].displacement, "m");
  archive("top_rotation", platens_[dem::top_end].rotation, "1", unit_length());
}

} // namespace platen::apps
