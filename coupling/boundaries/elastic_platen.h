// A platen that yields: linear elastic, held by the machine at the end that is far from the specimen.
#pragma once

#include <functional>

#include "coupling/boundaries/mean_loads.h"
#include "coupling/boundaries/platen.h"
#include "fem/elastic_solid.h"

namespace platen::coupling {

// What of its face counts where its displacement is told: the faces of a tag, where `covers` holds.
struct FaceOf {
  int tag = 0;
  std::function<bool(double x, double y)> covers;
};

class ElasticPlaten : public Platen {
public:
  // Quasi-static: its shape follows the mean loads of so many steps of the particles during the next ones.
  ElasticPlaten(std::string name, std::unique_ptr<fem::ElasticSolid> solid, const dem::Particles &particles,
                const SurfaceContact &contact, const FaceOf &face, bool quasi_static, int steps_per_solve)
      : ElasticPlaten(std::move(name), *solid, std::move(solid), particles, contact, face, quasi_static,
                      steps_per_solve) {}

  void finish(const Step &step) override;
  bool drifts_long() const override { return true; }
  bool can_be_carried() const override { return false; }
  void add_springs(const dem::Particles &particles, std::vector<dem::GroundSpring> &springs) override;
  StepLimit limit(const dem::Particles &particles) const override;
  void fit(const dem::Particles &particles, double time_step) override;
  void add_energy(dem::EnergyLedger &energy) const override;
  double face_rise() const override { return face_.rise(body_->surface()); } // the mean of the face
  void describe(Archive &archive) override;
  const fem::ElasticSolid &solid() const { return solid_; }

private:
  ElasticPlaten(std::string name, fem::ElasticSolid &solid, std::unique_ptr<fem::ElasticSolid> &&body,
                const dem::Particles &particles, const SurfaceContact &contact, const FaceOf &face,
                bool quasi_static, int steps_per_solve);

  fem::ElasticSolid &solid_; // the body
  MeanPlace face_;
  bool quasi_static_;
  int steps_per_solve_;
  MeanLoads loads_;
};

} // namespace platen::coupling
