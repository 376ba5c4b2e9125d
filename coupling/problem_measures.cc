// What is read off a problem: strains, stresses, energies, sizes.
#include <cmath>
#include <limits>

#include "coupling/bending.h"
#include "coupling/problem.h"

namespace platen::coupling {
namespace {

constexpr double pi = 3.14159265358979323846;

} // namespace

dem::EndPlanes Problem::end_planes() const {
  return {bottom_plane_ + face_move(bottom, bottom_face_), top_plane_ + face_move(top, top_face_)};
}

double Problem::face_move(const fem::Body &body, const MeanPlace &face) const {
  return deformable() ? face.rise(body.surface()) : body.displacement()[2];
}

double Problem::coordination_number() const {
  if (!model.bonds || model.particles.size() == 0) return 0;
  return 2.0 * static_cast<double>(model.bonds->initial_count()) /
         static_cast<double>(model.particles.size());
}

std::size_t Problem::bytes() const {
  return model.bytes() + top_layer.bytes() + bottom_layer.bytes() + (sleeve_ ? sleeve_->layer.bytes() : 0);
}

double Problem::closure_strain() const {
  return (face_move(bottom, bottom_face_) - face_move(top, top_face_)) / shape_.height;
}
double Problem::grip_closure() const {
  return bottom.displacement()[2] - top.displacement()[2];
}
double Problem::axial_closure() const {
  if (!cell()) return closure_strain();
  return axial_stage() ? closure_strain() - cell_closure_ : 0.0;
}
double Problem::stress_top() const {
  return reaction_top_ / nominal_area();
}
double Problem::stress_bottom() const {
  return -reaction_bottom_ / nominal_area();
}
double Problem::midspan_moment() const {
  const double middle = 0.5 * (end_planes().low + end_planes().high);
  return coupling::midspan_moment(top, middle) + coupling::midspan_moment(bottom, middle);
}
double Problem::swing() const {
  const double slenderness = settings_.platens.span / shape_.height;
  return 2 / pi * std::sqrt(12.0) * slenderness * slenderness * wave_crossing_;
}
double Problem::platen_speed() const {
  return bottom.velocity()[2] - top.velocity()[2];
}

dem::EnergyLedger Problem::energy() const {
  dem::EnergyLedger e = model.energy();
  if (wall_) e.contacts += wall_->elastic_energy();
  if (sleeve_) {
    e.contacts += sleeve_->layer.elastic_energy();
    e.friction += sleeve_->layer.friction_work;
    e.damping += sleeve_->layer.damping_work + sleeve_->lost();
    e.bodies += sleeve_->stored();
    e.boundary += sleeve_->work();
  }
  e.contacts += top_layer.elastic_energy() + bottom_layer.elastic_energy();
  e.friction += top_layer.friction_work + bottom_layer.friction_work;
  e.damping += top_layer.damping_work + bottom_layer.damping_work;
  if (deformable())
    for (const fem::Body *body : {&top, &bottom}) {
      const fem::BodyBook book = body->book();
      e.bodies += book.strain + book.kinetic;
      e.damping += book.dissipated;
      e.boundary += book.grip_work;
    }
  e.boundary += boundary_work_ + (confinement_ ? confinement_->work() : 0.0);
  return e;
}

double Problem::unbalanced_ratio() const {
  if (!model.bonds || model.intact_bonds() == 0) return std::numeric_limits<double>::quiet_NaN();
  const double sum = dem::bond_totals(model.particles, *model.bonds, settings_.model.instruction_set).force;
  const double bonds = sum / static_cast<double>(model.intact_bonds());
  const double net = model.last_sums().unbalanced / static_cast<double>(model.particles.size());
  return bonds > 0 ? net / bonds : std::numeric_limits<double>::quiet_NaN();
}

} // namespace platen::coupling
