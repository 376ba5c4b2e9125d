// A sleeve around a specimen: a tube of finite elements, of rubber in a cell, or of steel or fibres that
// confine the specimen because it presses them. Its inner face touches the particles, its outer face carries
// the cell's pressure, and its rims move with the platens; the upper rim turns with a top platen on a seat,
// but puts no moment on it: the machine turns the rim. A tube that ends before the platens is free there.
//
// The stable step of the sleeve is made several steps of the particles long, by its mass where need be. So
// the sleeve is kicked once in an interval of several steps, by velocity Verlet with the interval as step.
// Within the interval its nodes move at constant velocity, so that the surface moves smoothly for the
// particles; at its end the nodes get the forces that contacts, elements and pressure have then. The mean of
// the contacts over the interval would be half an interval late, and a spring with a delay amplifies every
// oscillation.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "coupling/boundaries/platen.h"
#include "coupling/sleeve_settings.h"
#include "dem/packing/specimen.h"
#include "fem/hyperelastic_solid.h"

namespace platen::coupling {

// Motion of the ends and pressure for the next interval: rims move to the positions of the platens, which are
// extrapolated with their present velocities.
struct RimMotion {
  Vector3 bottom{}, top{};             // m/s
  double pressure = 0;                 // Pa, on the outer face
  Vector3 bottom_place{}, top_place{}; // m, displacements of the platens since the start
  // Of a top platen that turns about the middle of its face: its orientation, and rad/s.
  Quaternion top_rotation{};
  Vector3 top_angular_velocity{};
};

class Sleeve : public ContactBoundary {
public:
  // Around a cylinder of `shape`, from z = low to z = high (m). The middles of the inner faces lie on the
  // mantle of the shape. Throws std::invalid_argument where a setting is out of range or the shape is no
  // cylinder.
  Sleeve(const dem::Particles &particles, const dem::Shape &shape, double low, double high,
         const SleeveSettings &settings);
  // Around a specimen between platens; its rims move with them.
  Sleeve(const dem::Particles &particles, const dem::Shape &shape, const EndPlatens &ends,
         const SleeveSettings &settings);

  void drift(const Step &step, const Command &command) override; // the command's pressure
  // Its loads are summed at the end of an interval, or when they are needed.
  void apply_forces(dem::Particles &particles, const Step &step) override;
  void finish(const Step &step) override;
  bool follows_others() const override { return true; }
  bool can_be_carried() const override { return false; }
  StepLimit limit(const dem::Particles &) const override { return {known_limit(), reason_of_limit}; }
  // s, stability limit of the next interval; of a tube whose mass is to be fitted to the step there is none
  // yet.
  double known_limit() const override {
    return !is_rubber() && settings_.mass_scaling == 0 ? std::numeric_limits<double>::infinity() : limit_;
  }
  void fit(const dem::Particles &particles, double time_step) override;
  void add_energy(dem::EnergyLedger &energy) const override;
  double pressure() const override { return solid_->pressure(fem::mantle_tag); }
  // Fraction of the area of its inner face: the elements that press on a sphere. The rubber transfers the
  // pressure to these. NaN without a pressure, because no element presses then.
  double confined_fraction() const override;
  std::string series() const override { return "sleeve"; }
  fem::Picture picture() const override { return with_loads().picture(contact_->vertex_slip(*solid_)); }
  const ContactLayer &layer() const override { return *contact_; }
  const fem::LoadedSurface &surface() const override { return *solid_; } // its loads may not be summed yet
  using ContactBoundary::layer;
  using ContactBoundary::surface;
  // Of the middle half of its height, means by volume (Pa), compression of the axis and tension of the hoop
  // positive; the largest equivalent plastic strain anywhere; the fraction of elements that have yielded.
  struct WallState {
    double axial = 0, hoop = 0, force = 0; // Pa, Pa, N: of its section, compression positive
    double plastic_strain = 0, yielded = 0;
    double bulge = 0;                      // m, largest displacement of a node outwards
    double hoop_strain = 0, most_hoop = 0; // 1, of a wrap that has not torn: mean of that half, largest
    double torn = 0;                       // 1, fraction of the elements
  };
  WallState wall_state() const;
  double specimen_pressure() const; // Pa, of the specimen on the middle half of its inner face, mean
  double slip() const;              // m, mean path along it of the specimen's spheres that touch it
  long torn_elements() const;
  // Of a wall at rest, hoop stress over the pressure on its inner face: free body of half a ring.
  double hoop_over_pressure() const { return (shape_.radius + settings_.gap) / settings_.thickness; }
  bool is_bonded() const { return settings_.contact.bond.strength > 0; }
  static constexpr const char *reason_of_limit =
      "the finite elements of the sleeve with the springs of its contacts";

  // In each step of the particles, after their drift over dt (s) and before forces: moves the surface. Begins
  // an interval where the last one has ended.
  void move(double dt, const RimMotion &rims);
  // After the contact layer has computed its forces: ends the interval where it is due. Throws
  // fem::InvertedElement before an inverted element is used.
  void take_loads();

  const fem::HyperelasticSolid &solid() const { return with_loads(); }
  fem::HyperelasticSolid &solid() { return with_loads(); }

  int steps_of_interval() const { return planned_; }
  int steps_of_next_interval(double dt) const;                                    // of dt (s) each
  double inner_volume() const { return solid_->enclosed_volume(fem::inner_tag); } // m^3, of the specimen
  bool yields() const { return settings_.metal.has_value(); }
  bool wraps() const { return settings_.wrap.has_value(); }
  bool is_rubber() const { return !yields() && !wraps(); }
  bool held_below() const { return settings_.clearance == 0 || settings_.recess > 0; } // by the platen
  bool held_above() const { return settings_.clearance == 0; }
  // Of the enclosed volume, positive in compression.
  double volumetric_strain() const { return 1 - inner_volume() / volume_at_start_; }
  // N: force of the platens on its ends (the mean of both) in excess of the pressure in the rubber.
  double axial_force_beyond_pressure() const;
  double mass_scaling() const { return settings_.mass_scaling == 0 ? 1.0 : settings_.mass_scaling; }
  long cuts() const { return static_cast<long>(cuts_); } // halvings of intervals that would invert an element
  // Work of pressure and platens on the sleeve since the start; its stored and its dissipated energy (J).
  double work() const { return solid_->pressure_work() + solid_->prescribed_work(); }
  double stored() const { return solid_->kinetic_energy() + solid_->internal_energy(); }
  double lost() const { return solid_->damping_work(); }

  void describe(Archive &archive) override;

protected:
  double farthest(const Step &step) const override { return solid_->largest_move(step.dt); }

private:
  void begin_interval(double dt, const RimMotion &rims);
  void kick_into(double interval, double dt, const RimMotion &rims);
  void turn_top_rim(double interval, double dt, const RimMotion &rims);
  bool top_turns() const { return ends_ && ends_->high.body().turns(); }
  void hold_rims();
  void require_clear_ends(const Step &step) const;
  double find_limit();
  fem::HyperelasticSolid &with_loads() const;
  double cheap_mass(double time_step) const;

  void build(const dem::Particles &particles);

  SleeveSettings settings_;
  dem::Shape shape_;
  double low_, high_; // m, z
  std::unique_ptr<fem::HyperelasticSolid> solid_;
  std::unique_ptr<ContactLayer> contact_;
  std::optional<EndPlatens> ends_;
  double volume_at_start_ = 0, ring_ = 0; // m^3, enclosed; m^2, of one end
  int bottom_motion_ = 0, top_motion_ = 0;
  std::size_t bottom_rim_ = 0, top_rim_ = 0; // one node of each
  std::vector<int> top_rim_nodes_;
  std::vector<Vector3> top_rim_places_; // m, of these at the start, from the middle of the platen's face
  mutable bool loads_due_ = false;      // loads of the last step are still in the layer
  int planned_ = 0, made_ = 0;          // steps of the interval
  double elapsed_ = 0;                  // s, of the interval
  double limit_ = 0;                    // s, of the next interval, by the contacts at the end of this one
  double own_limit_ = 0;                // s, of the elements alone, computed now and then
  double intervals_ = 0, cuts_ = 0;     // since the start
  // Of a state that was just read, until a step finds which elements press; else NaN.
  double fraction_read_ = std::numeric_limits<double>::quiet_NaN();
};

} // namespace platen::coupling
