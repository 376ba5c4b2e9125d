// A problem with a sleeve: where it stands, how it goes with the platens, what stops it.
#include <algorithm>
#include <cmath>

#include "coupling/problem.h"
#include "coupling/text_of.h"

namespace platen::coupling {
namespace {

// Spheres bear on the sleeve with springs that the pressure presses in by about a twenty-fifth of a radius
// (each bears the pressure on some 4 R^2), and not softer than this share of the mean bond.
constexpr double springs_of_pressure = 100, least_share_of_bond = 0.01;
// Intervals of so many steps make a sleeve cheap. Springs grow with the pressure; so does then the mass that
// is given to the sleeve, and what its inertia presses stays the same small share of the pressure.
constexpr double steps_of_cheap_interval = 8;

} // namespace

// Penalty springs of the skin are in series with the specimen: stiff enough for the pressure, and no stiffer,
// since with the light nodes of the sleeve they decide on its steps.
double Problem::sleeve_spring(const CellSettings &cell, double bond) const {
  if (cell.sleeve_stiffness > 0) return cell.sleeve_stiffness * bond;
  return std::max(springs_of_pressure * cell.pressure * mean_radius_, least_share_of_bond * bond);
}

void Problem::start_sleeve(const CellSettings &cell, double bond, double mass_scaling) {
  SleeveSettings settings = *cell.sleeve;
  settings.mass_scaling = mass_scaling;
  settings.contact.particle_stiffness = sleeve_spring(cell, bond);
  settings.contact.skin = surface_skin * mean_radius_;
  const dem::EndPlanes planes = end_planes();
  sleeve_ = std::make_unique<Sleeve>(model.particles, shape_, planes.low, planes.high, settings);
  sleeve_->layer.seat_within(model.particles, sleeve_->solid, cell.sleeve_seat_depth * mean_radius_);
  sleeve_volume_ = sleeve_->inner_volume();
  sleeve_ring_ = sleeve_->solid.volume() / (planes.high - planes.low);
}

// As the sleeve's own limit has it when all spheres press that lie flush with it, evenly.
double Problem::cheap_mass_of_sleeve() const {
  const fem::HyperelasticSolid &solid = sleeve_->solid;
  double mass = 0; // kg, of the face that meets the spheres
  for (std::size_t v = 0; v < solid.surface().vertices.size(); ++v)
    mass += solid.surface_mass(static_cast<int>(v));
  const SurfaceContact &contact = sleeve_->layer.parameters();
  constexpr double bound_over_mean = 2.5; // of a row of their stiffness: one for the nearest, half for three
  const double springs = bound_over_mean * sleeve_->layer.seats() * contact.particle_stiffness *
                         std::max(1.0, contact.tangential_ratio);
  const double interval = steps_of_cheap_interval * time_step_ / settings_.loading.cell->sleeve->safety;
  return std::max(1.0, springs / mass * 0.25 * interval * interval);
}

void Problem::move_sleeve() {
  SleeveLead lead;
  lead.bottom = bottom.velocity();
  lead.top = top.velocity();
  lead.pressure = cell_pressure();
  lead.bottom_place = {0, 0, face_move(bottom, bottom_face_)};
  lead.top_place = {0, 0, face_move(top, top_face_)};
  sleeve_->move(time_step_, lead);
}

void Problem::load_sleeve() {
  try {
    sleeve_->take_loads();
  } catch (const fem::InvertedElement &e) {
    throw NumericsStopped(
        "step " + std::to_string(steps_ + 1) + ", time " + text_of(time()) +
        " s: the sleeve would turn inside out: " + e.what() +
        "; try wider elements (Sleeve/Elements around), a thicker or a stiffer sleeve, or a "
        "slower Loading/Axial rate");
  }
}

double Problem::sleeve_volumetric_strain() const {
  if (!sleeve_) return std::numeric_limits<double>::quiet_NaN();
  return 1 - sleeve_->inner_volume() / sleeve_volume_;
}

double Problem::sleeve_deviator() const {
  if (!sleeve_) return std::numeric_limits<double>::quiet_NaN();
  const double pressing = 0.5 * (sleeve_->axial_force_bottom() - sleeve_->axial_force_top());
  return (pressing - sleeve_->pressure() * sleeve_ring_) / nominal_area();
}

} // namespace platen::coupling
