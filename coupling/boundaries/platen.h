// A platen: a body of finite elements that the machine moves, and its contacts with the specimen.
#pragma once

#include <memory>

#include "coupling/boundary.h"
#include "dem/skin.h"
#include "fem/body.h"

namespace platen::coupling {

class Platen : public ContactBoundary {
public:
  Platen(std::string name, std::unique_ptr<fem::Body> body, const dem::Particles &particles,
         const SurfaceContact &contact);

  void drift(const Step &step, const Command &command) override;
  void finish(const Step &step) override;
  bool is_finite() const override;
  void rest() override { body_->set_velocity({}); }
  double dashpots() const override { return layer_.parameters().damping; }
  std::size_t near() const override { return layer_.search().particles().size(); }
  std::size_t closed() const override { return layer_.closed; }
  Vector3 force() const override { return force_; }
  double speed() const override { return norm(body_->velocity()); }
  ServoLoad servo_load(const dem::Particles &particles) const override;
  std::string series() const override { return "platens"; }
  void write_vtu(std::ostream &stream) const override;
  void describe(Archive &archive) override;

  const fem::Body &body() const { return *body_; }
  fem::Body &body() { return *body_; }
  const ContactLayer &layer() const override { return layer_; }
  const fem::LoadedSurface &surface() const override { return *body_; }
  using ContactBoundary::layer;
  using ContactBoundary::surface;
  // m, how far its face has moved along z.
  virtual double face_rise() const = 0;
  // N m, what it adds to the bending moment of a bar along x at x = 0, about the height z (m): positive where
  // it pulls the lower side.
  double midspan_moment(double z) const;
  bool glued() const { return layer_.parameters().attachment == Attachment::glued; }
  // Springs of the particles near it, listed anew, in row order, with the indentations of its mesh.
  std::vector<dem::GroundSpring> whole_springs(const dem::Particles &particles);

protected:
  double farthest(const Step &) const override { return body_->last_move(); }
  std::unique_ptr<fem::Body> body_;
  ContactLayer layer_;
  Vector3 force_{}; // N, of the last step
};

// One that keeps its shape. Where its loads do work, the machine does it.
class RigidPlaten : public Platen {
public:
  using Platen::Platen;
  void finish(const Step &step) override;
  double power_on_machine() const override { return power_; }
  double face_rise() const override { return body_->displacement()[2]; }

private:
  double power_ = 0; // W
};

// Two that hold a specimen by its ends, and where their faces were at the start.
struct EndPlatens {
  const Platen &low, &high;
  double low_plane = 0, high_plane = 0; // m, z
  dem::EndPlanes planes() const {       // now
    return {low_plane + low.face_rise(), high_plane + high.face_rise()};
  }
};

} // namespace platen::coupling
