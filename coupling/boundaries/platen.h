// A platen: a body of finite elements that the machine moves, and its contacts with the specimen. There are
// three kinds: a rigid one; a rigid one that turns on its seat; and a linear elastic one, fixed to the
// machine at the end that is far from the specimen, or with that end on a seat.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "base/archive.h"
#include "coupling/boundaries/machine_spring.h"
#include "coupling/boundary.h"
#include "dem/skin.h"
#include "fem/body.h"
#include "fem/elastic_solid.h"

namespace platen::coupling {

// Time mean of the loads of a body's vertices, for bodies that follow them without inertia.
class MeanLoads {
public:
  MeanLoads() = default;
  explicit MeanLoads(std::size_t vertices) : impulse_(vertices, Vector3{}) {}
  void add(const fem::Body &body, double dt); // present loads, acting for dt (s)
  int steps() const { return steps_; }        // added since the last reset()
  std::vector<Vector3> mean() const;          // N, one per vertex
  void reset();

  void describe(Archive &archive);

private:
  std::vector<Vector3> impulse_; // N s
  double time_ = 0;              // s
  int steps_ = 0;
};

// The part of a face for the measure of its displacement: the faces of a tag, where `covers` is true.
struct FaceOf {
  int tag = 0;
  std::function<bool(const Vector3 &)> covers;
};

// The mean position of a part of the surface along a direction, by weights of its vertices.
class MeanPlace {
public:
  MeanPlace() = default;
  // Over the covered area of the face; over all of it where no part is covered.
  MeanPlace(const fem::SurfaceMesh &surface, const FaceOf &face, const Vector3 &direction);
  double now(const fem::SurfaceMesh &surface) const;                                      // m
  double advance(const fem::SurfaceMesh &surface) const { return now(surface) - start_; } // m

private:
  Vector3 direction_{};
  std::vector<int> vertices_;
  std::vector<double> weights_; // sum 1
  double start_ = 0;            // m
};

class Platen : public ContactBoundary {
public:
  // `inward`: unit vector of the direction in which it presses the specimen.
  Platen(std::string name, const Vector3 &inward, std::unique_ptr<fem::Body> body,
         const dem::Particles &particles, const SurfaceContact &contact);

  // Before the first step: the machine then moves a crosshead, and the platen through that spring in the
  // direction that it presses.
  virtual void stand_on(const MachineSpring &spring) { machine_ = spring; }

  void drift(const Step &step, const Command &command) override;
  void finish(const Step &step) override;
  bool is_finite() const override;
  void rest() override { body_->set_velocity({}); }
  double dashpots() const override { return layer_.parameters().damping; }
  std::size_t near() const override { return layer_.search().particles().size(); }
  std::size_t closed() const override { return layer_.closed; }
  Vector3 force() const override { return force_; }
  Vector3 inward() const override { return inward_; }
  double speed() const override { return norm(body_->velocity()); }
  void add_energy(dem::EnergyLedger &energy) const override;
  ServoLoad servo_load(const dem::Particles &particles) const override;
  std::string series() const override { return "platens"; }
  fem::Picture picture() const override { return body_->picture(layer_.vertex_slip(*body_)); }
  void describe(Archive &archive) override;

  const fem::Body &body() const { return *body_; }
  fem::Body &body() { return *body_; }
  const ContactLayer &layer() const override { return layer_; }
  void set_friction(const dem::SurfaceFriction &friction) { layer_.set_friction(friction); }
  const fem::LoadedSurface &surface() const override { return *body_; }
  using ContactBoundary::layer;
  using ContactBoundary::surface;
  // m, closure at which its face touches the edges of its neighbours: the run stops there.
  void set_clearance(double clearance) { clearance_ = clearance; }
  // N m, its contribution to the bending moment of a bar along x at x = 0, about the height z (m); positive:
  // tension on the lower side.
  double midspan_moment(double z) const;
  const MachineSpring *machine() const { return machine_ ? &*machine_ : nullptr; } // null: a rigid machine
  // s, delay of its face after its loads along its direction: of a platen without inertia, after fit().
  virtual double seconds_behind() const { return 0; }
  bool glued() const { return layer_.parameters().attachment == Attachment::glued; }
  // Springs of the particles near it, from a rebuilt list, in row order, with the indentations of its mesh.
  std::vector<dem::GroundSpring> total_springs(const dem::Particles &particles);

protected:
  double farthest(const Step &) const override { return body_->last_move(); }
  // For a body that moves by its loads: stiffness of its contact springs as seen by the particles, and by the
  // body.
  void add_shared_springs(const dem::Particles &particles, std::vector<dem::GroundSpring> &springs);
  fem::VertexSprings shared_springs(const dem::Particles &particles) const;
  void move(const Step &step, const Vector3 &velocity); // m/s, of what the machine moves
  // On a spring, for a platen whose mass in the spring model carries the load directly: its step, its limit,
  // and the correction of its power on the machine (W): the crosshead's power replaces the platen's in the
  // direction that it presses.
  virtual void drift_on_spring(const Step &step, const Command &command);
  virtual void finish_on_spring(const Step &step) { machine_->finish(load(), step.dt); }
  virtual double kinetic_energy_on_spring() const { return machine_->kinetic_energy(); } // J
  virtual double seconds_on_spring(const fem::VertexSprings &shared) const;
  double power_past_spring() const {
    if (!machine_) return 0;
    return dot(forces_, inward_) * dot(body_->velocity(), inward_) + machine_->power();
  }

  Vector3 inward_;
  std::unique_ptr<fem::Body> body_;
  ContactLayer layer_;
  Vector3 force_{};  // N, of the last step
  Vector3 forces_{}; // N, at the start plus at the end of its drift
  std::optional<MachineSpring> machine_;
  double clearance_ = std::numeric_limits<double>::infinity();
};

// A platen that keeps its shape. The machine does the work of its loads; on a spring the machine moves the
// crosshead, and the platen has its own energies in the direction that it presses.
class RigidPlaten : public Platen {
public:
  using Platen::Platen;
  double power_on_machine() const override { return dot(forces_, body_->velocity()) - power_past_spring(); }
  bool can_be_carried() const override { return !machine_; }
  void add_springs(const dem::Particles &particles, std::vector<dem::GroundSpring> &springs) override;
  StepLimit limit(const dem::Particles &particles) const override;
  double closure() const override { return dot(body_->displacement(), inward_); }
};

// Two platens at the ends of a specimen, and the positions of their faces at the start.
struct EndPlatens {
  const Platen &low, &high;
  double low_plane = 0, high_plane = 0;                              // m, z
  dem::EndPlanes planes() const {                                    // now
    return {low_plane + low.closure(), high_plane - high.closure()}; // of the middle of a face that turns
  }
};

// A platen whose body is also moved by its loads: it has its own energy balance and its own largest step.
class DynamicPlaten : public Platen {
public:
  using Platen::Platen;
  void finish(const Step &step) override;
  double power_on_machine() const override { return -power_past_spring(); }
  bool can_be_carried() const override { return false; }
  void add_springs(const dem::Particles &particles, std::vector<dem::GroundSpring> &springs) override;
  StepLimit limit(const dem::Particles &particles) const override;
  void add_energy(dem::EnergyLedger &energy) const override;

protected:
  virtual std::string reason_of_limit() const = 0;
};

// A rigid platen on a spherical seat: the machine moves the middle of its face, about which it turns freely.
class SeatedPlaten : public DynamicPlaten {
public:
  using DynamicPlaten::DynamicPlaten;
  double closure() const override { return dot(body_->displacement(), inward_); } // of that middle

protected:
  std::string reason_of_limit() const override {
    return "a platen that turns on its seat, with the springs of its contacts";
  }
};

class ElasticPlaten : public DynamicPlaten {
public:
  // Quasi-static: its shape follows the mean loads of `steps_per_solve` steps during the next ones.
  ElasticPlaten(std::string name, const Vector3 &inward, std::unique_ptr<fem::ElasticSolid> solid,
                const dem::Particles &particles, const SurfaceContact &contact, const FaceOf &face,
                bool quasi_static, int steps_per_solve)
      : ElasticPlaten(std::move(name), inward, *solid, std::move(solid), particles, contact, face,
                      quasi_static, steps_per_solve) {}

  // The clamp slides, with the part of the spring's mass that exceeds the body's mass.
  void stand_on(const MachineSpring &spring) override {
    Platen::stand_on(spring);
    solid_.attach(spring.settings().mass - solid_.mass());
  }
  void finish(const Step &step) override;
  double power_on_machine() const override { return machine_ ? -machine_->power() : 0; }
  bool drifts_long() const override { return true; }
  void fit(const dem::Particles &particles, double time_step) override;
  double closure() const override { return face_.advance(body_->surface()); } // mean over the face
  void describe(Archive &archive) override;
  const fem::ElasticSolid &solid() const { return solid_; }
  double seconds_behind() const override { return seconds_behind_; }

protected:
  std::string reason_of_limit() const override {
    return "the finite elements of a platen with the springs of its contacts";
  }
  // The clamp slides; its energy and work are included in those of the body.
  void drift_on_spring(const Step &step, const Command &command) override;
  void finish_on_spring(const Step &step) override;
  double kinetic_energy_on_spring() const override { return 0; }
  double seconds_on_spring(const fem::VertexSprings &shared) const override {
    if (quasi_static_) return Platen::seconds_on_spring(shared);
    return std::numeric_limits<double>::infinity(); // the body's limit includes the spring
  }

private:
  ElasticPlaten(std::string name, const Vector3 &inward, fem::ElasticSolid &solid,
                std::unique_ptr<fem::ElasticSolid> &&body, const dem::Particles &particles,
                const SurfaceContact &contact, const FaceOf &face, bool quasi_static, int steps_per_solve);

  fem::ElasticSolid &solid_; // the body
  MeanPlace face_;
  bool quasi_static_;
  int steps_per_solve_;
  double seconds_behind_ = 0; // s
  MeanLoads loads_;
};

} // namespace platen::coupling
