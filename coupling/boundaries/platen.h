// A platen: a body of finite elements that the machine moves, and its contacts with the specimen. A rigid
// one; a rigid one that turns on its seat; and one that yields: linear elastic, fixed to the machine at the
// end that is far from the specimen, or with that end on a seat.
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

// Loads of a body's vertices on the mean over time, for who follows them without inertia.
class MeanLoads {
public:
  MeanLoads() = default;
  explicit MeanLoads(std::size_t vertices) : impulse_(vertices, Vector3{}) {}
  void add(const fem::Body &body, double dt); // the loads as they are, for dt (s)
  int steps() const { return steps_; }        // added since the last reset()
  std::vector<Vector3> mean() const;          // N, one per vertex
  void reset();

  void describe(Archive &archive);

private:
  std::vector<Vector3> impulse_; // N s
  double time_ = 0;              // s
  int steps_ = 0;
};

// What of a face counts where its displacement is told: the faces of a tag, where `covers` holds.
struct FaceOf {
  int tag = 0;
  std::function<bool(const Vector3 &)> covers;
};

// The mean place of a part of the surface along a direction, as shares of its vertices.
class MeanPlace {
public:
  MeanPlace() = default;
  // Over the area of the face that is covered; over all of it where none is.
  MeanPlace(const fem::SurfaceMesh &surface, const FaceOf &face, const Vector3 &direction);
  double now(const fem::SurfaceMesh &surface) const;                                      // m
  double advance(const fem::SurfaceMesh &surface) const { return now(surface) - start_; } // m

private:
  Vector3 direction_{};
  std::vector<int> vertices_;
  std::vector<double> shares_; // sum 1
  double start_ = 0;           // m
};

class Platen : public ContactBoundary {
public:
  // `inward`: unit vector of the way that it presses the specimen.
  Platen(std::string name, const Vector3 &inward, std::unique_ptr<fem::Body> body,
         const dem::Particles &particles, const SurfaceContact &contact);

  // Before the first step: the machine moves a crosshead, and the platen along the way that it presses
  // through that spring.
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
  void write_vtu(std::ostream &stream) const override;
  void describe(Archive &archive) override;

  const fem::Body &body() const { return *body_; }
  fem::Body &body() { return *body_; }
  const ContactLayer &layer() const override { return layer_; }
  void set_friction(const dem::SurfaceFriction &friction) {
    layer_.set_friction(friction);
  } // as the layer does
  const fem::LoadedSurface &surface() const override { return *body_; }
  using ContactBoundary::layer;
  using ContactBoundary::surface;
  // m, closure at which its face meets the edges of its neighbours: the run stops there.
  void set_room(double room) { room_ = room; }
  // N m, what it adds to the bending moment of a bar along x at x = 0, about the height z (m): positive where
  // it pulls the lower side.
  double midspan_moment(double z) const;
  const MachineSpring *machine() const { return machine_ ? &*machine_ : nullptr; } // null: a rigid one
  // s, by which its face comes after its loads along its way: of one without inertia, from fit()
  // on.
  virtual double seconds_behind() const { return 0; }
  bool glued() const { return layer_.parameters().attachment == Attachment::glued; }
  // Springs of the particles near it, listed anew, in row order, with the indentations of its mesh.
  std::vector<dem::GroundSpring> whole_springs(const dem::Particles &particles);

protected:
  double farthest(const Step &) const override { return body_->last_move(); }
  // Of a body that moves by its loads: what its contacts' springs count for the particles, and for itself.
  void add_shared_springs(const dem::Particles &particles, std::vector<dem::GroundSpring> &springs);
  fem::VertexSprings shared_springs(const dem::Particles &particles) const;
  void move(const Step &step, const Vector3 &velocity); // m/s, of what the machine moves
  // On a spring. Of a platen whose load bears on that at once, with the mass that the spring knows: its step,
  // its limit, and its power on the machine (W) along the way that it presses, with that of the crosshead in
  // its place.
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
  Vector3 forces_{}; // N, at the start and at the end of its drift, added up
  std::optional<MachineSpring> machine_;
  double room_ = std::numeric_limits<double>::infinity();
};

// One that keeps its shape. Where its loads do work, the machine does it; on a spring the machine moves the
// crosshead, and the platen has energies of its own along the way that it presses.
class RigidPlaten : public Platen {
public:
  using Platen::Platen;
  double power_on_machine() const override { return dot(forces_, body_->velocity()) - power_past_spring(); }
  bool can_be_carried() const override { return !machine_; }
  void add_springs(const dem::Particles &particles, std::vector<dem::GroundSpring> &springs) override;
  StepLimit limit(const dem::Particles &particles) const override;
  double closure() const override { return dot(body_->displacement(), inward_); }
};

// Two that hold a specimen by its ends, and where their faces were at the start.
struct EndPlatens {
  const Platen &low, &high;
  double low_plane = 0, high_plane = 0;                              // m, z
  dem::EndPlanes planes() const {                                    // now
    return {low_plane + low.closure(), high_plane - high.closure()}; // where one turns: of its middle
  }
};

// One whose body its loads move too: it has an energy balance and a largest step of its own.
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

// A rigid one on a spherical seat: the machine moves the middle of its face, about which it turns freely.
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
  // Quasi-static: its shape follows the mean loads of so many steps of the particles during the next ones.
  ElasticPlaten(std::string name, const Vector3 &inward, std::unique_ptr<fem::ElasticSolid> solid,
                const dem::Particles &particles, const SurfaceContact &contact, const FaceOf &face,
                bool quasi_static, int steps_per_solve)
      : ElasticPlaten(std::move(name), inward, *solid, std::move(solid), particles, contact, face,
                      quasi_static, steps_per_solve) {}

  // Its clamp slides, with what of the spring's mass the body does not have itself.
  void stand_on(const MachineSpring &spring) override {
    Platen::stand_on(spring);
    solid_.attach(spring.settings().mass - solid_.mass());
  }
  void finish(const Step &step) override;
  double power_on_machine() const override { return machine_ ? -machine_->power() : 0; }
  bool drifts_long() const override { return true; }
  void fit(const dem::Particles &particles, double time_step) override;
  double closure() const override { return face_.advance(body_->surface()); } // the mean of the face
  void describe(Archive &archive) override;
  const fem::ElasticSolid &solid() const { return solid_; }
  double seconds_behind() const override { return seconds_behind_; }

protected:
  std::string reason_of_limit() const override {
    return "the finite elements of a platen with the springs of its contacts";
  }
  // Its clamp slides, and has its energy and its work among those of the body.
  void drift_on_spring(const Step &step, const Command &command) override;
  void finish_on_spring(const Step &step) override;
  double kinetic_energy_on_spring() const override { return 0; }
  double seconds_on_spring(const fem::VertexSprings &shared) const override {
    if (quasi_static_) return Platen::seconds_on_spring(shared);
    return std::numeric_limits<double>::infinity(); // that of the body counts the spring
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
