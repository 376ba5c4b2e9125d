// A specimen between two platens: particles, bodies and contact layers on one clock, loaded by motion or by
// stress.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupling/contact_layer.h"
#include "coupling/mean_loads.h"
#include "coupling/pace.h"
#include "coupling/servo.h"
#include "coupling/sleeve.h"
#include "dem/confinement.h"
#include "dem/lateral_wall.h"
#include "dem/measure/bending.h"
#include "dem/model.h"
#include "dem/packing/specimen.h"
#include "fem/body.h"
#include "fem/elastic_solid.h"

namespace platen::coupling {

// The run cannot go on: what, where, when and what to try. Apps exit with status 3.
class NumericsStopped : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};
// The scene asks for something that cannot be run: what is wrong with which entry. Apps exit with status 2.
class BadSetup : public std::runtime_error {
public:
  BadSetup(std::string entry, const std::string &reason)
      : std::runtime_error(reason), entry_(std::move(entry)) {}
  const std::string &entry() const { return entry_; } // "Section/Key"

private:
  std::string entry_;
};

enum class Ends { as_packed, ground };

struct PlatenSide {
  double friction_static = 0, friction_dynamic = 0;
  fem::Grid grid = nullptr; // null: a plate of the sizes below; else laid as fem/platen_mesh.h says
  dem::Weakening weakening{};
};

// Platens that yield: linear elastic, held by the machine at the end that is far from the specimen. Penalty
// springs are then the particles' share alone: what the platen gives way is in its mesh.
struct ElasticPlatens {
  int degree = 1;
  bool seat = false; // spherical, under the top platen's grip: turns freely about the middle of its face
  fem::ElasticMotion motion = fem::ElasticMotion::explicit_steps;
  double damping = 0.05;    // fraction of critical, of the fastest mode; explicit
  int steps_per_solve = 20; // quasi-static: of the particles
  double pad_thickness = 0; // m, of a sheet on the specimen's side that is part of the thickness; 0: none
  fem::Material pad{};      // of that sheet, or of the second material of a given grid; modulus 0: none
};

struct PlatenSettings {
  PlatenSide top, bottom;
  std::optional<ElasticPlatens> elastic; // none: rigid
  double stiffness_of_bond = 1;          // multiple of the mean bond's k_n A ...
  double stiffness_absolute = 0;         // ... or N/m where positive
  double tangential_ratio = 0.8;
  double damping = 0.2;   // fraction of critical
  double strip_width = 0; // m, of strips that press a disc or bend a bar; 0: as wide as the platens
  double span = 0;        // m, between the middles of two lower strips that a bar along x is bent on; 0: none
  double overhang = 1.2;  // platen half-width over the specimen's
  double thickness = 0;   // m
  int elements_across = 8;
  fem::Material material{7830, 200e9, 0.3};
  bool glued = false;
};

// A cell: pressure on the lateral surface and, while it rises and stands alone, the same stress on the
// platens.
struct CellSettings {
  double pressure = 0; // Pa
  double ramp = 0; // s, from none to all of it; 0: sixty wave crossings of the height, more for slow servos
  double hold = 0; // s, how long it stands alone at least
  double path = 0; // 1, what the pressure gains per deviator of the axial stage; -1/3: constant mean stress
  // Without a sleeve the pressure acts on the spheres of the skin; with one on its outer face.
  dem::ConfinementArea area = dem::ConfinementArea::voronoi;
  std::optional<SleeveSettings> sleeve;
  double sleeve_stiffness = 0;  // of its contacts, multiple of the mean bond's; 0: by the pressure
  double sleeve_seat_depth = 1; // mean radii: spheres no deeper lie flush with its inner face
};

struct LoadingSettings {
  bool tension = false;
  double rate = 0;      // m/s, closure (opening) speed of the platens, each moving at half of it
  double crossings = 0; // > 0: that speed at which a wave crosses the height so often in a closure by 0.1 %
  double hurry = 1;     // times that rate while the specimen is elastic (Pace); needs bonds
  double ramp = 0;      // s; 0: ten wave crossings of the height
  bool servo = false;   // the top platen holds a stress, at most `rate` fast, against a bottom platen at rest
  double top_stress = 0; // Pa, pressing; reached smoothly over the ramp
  double servo_gain = 0; // 0.1 ... 10 as Servo has it; 0: 5 for top_stress, 10 in a cell
  std::optional<CellSettings> cell;
  double wall_stiffness = 0; // multiple of the mean bond's; 0: no wall around the specimen
  double wall_layer = 1;     // mean radii: deeper spheres are not seated on the wall
  // Closure strains (since the end of a cell's own stage) at which the platens turn round until the axial
  // stress (less the cell's pressure) has fallen to this share of what it was; ascending.
  std::vector<double> unload_at;
  double unload_to = 0.1;
};

struct ProblemSettings {
  dem::ModelSettings model;
  Ends ends = Ends::as_packed;
  double end_layer = 1; // mean radii, for ground ends
  bool seat = false;    // rocking springs of ground spheres
  PlatenSettings platens;
  LoadingSettings loading;
  double safety = 0.8;
  double fixed_step = 0; // s; 0: safety times the limit
};

class Problem {
public:
  static constexpr double surface_skin = 0.3; // margin of the surfaces' particle lists, in mean radii
  static constexpr const char *reason_of_sleeve =
      "the finite elements of the sleeve with the springs of its contacts";

  Problem(const dem::Specimen &specimen, const ProblemSettings &settings);

  void step() { advance(1); }
  // Up to `most` steps, to the same bits as one by one and faster; ends early after a step that leaves
  // cracks to be written. Returns how many were made. Throws NumericsStopped, naming particles and columns,
  // where numbers are not finite: within a step or two where they reach a force, else within a hundred.
  long advance(long most);
  // Throws NumericsStopped where a particle's motion is not finite: to be asked before a state is kept.
  void require_finite() const;
  // Before the first step: carries the particles by displacements (m) and turns (rad; empty without rotation)
  // and each platen towards the other by `way` (m), so slowly that nothing is left in motion, as a solve
  // without inertia has it. Bonds, contacts, friction springs and the energy book are then as after a loading
  // in no hurry; the clock stands at zero. Throws BadSetup where a bond breaks on the way, and
  // std::logic_error after the first step.
  void carry(const std::vector<dem::Vector3> &displacement, const std::vector<dem::Vector3> &turn,
             double way);

  dem::Model model;

private:
  std::unique_ptr<fem::Body> top_body_, bottom_body_;

public:
  fem::Body &top, &bottom;
  ContactLayer top_layer, bottom_layer;

  const dem::Shape &shape() const { return shape_; }
  const ProblemSettings &settings() const { return settings_; }
  bool deformable() const { return settings_.platens.elastic.has_value(); }
  bool quasi_static() const {
    return deformable() && settings_.platens.elastic->motion == fem::ElasticMotion::quasi_static;
  }
  double time() const { return model.time; }
  long steps() const { return steps_; }
  double time_step() const { return time_step_; }
  const std::string &time_step_reason() const { return reason_; }
  double ramp() const { return ramp_; }                        // s
  double axial_rate() const { return settings_.loading.rate; } // m/s, once the platens are at speed
  double fastest_rate() const { return axial_rate() * settings_.loading.hurry; } // m/s
  double wave_crossing() const { return wave_crossing_; } // s, over the height, from the Voigt modulus
  double packing_fraction() const { return packing_fraction_; }
  double mean_radius() const { return mean_radius_; }     // m
  double grain_density() const { return grain_density_; } // kg/m^3, before mass scaling
  double voigt_modulus() const { return voigt_modulus_; } // Pa, intact; 0 without bonds
  double coordination_number() const;                     // bonds per particle times two
  // Springs of the particles near a platen, in row order of its layer's list, which is made anew.
  std::vector<dem::GroundSpring> springs_at(bool top_platen);
  std::size_t springs_near() const; // grain contacts that are near, platen contacts that are closed
  std::size_t bytes() const; // of all columns of particles, bonds and contacts, and of the search lists

  // Pressure of the cell, or on the wall; Pa. Whether the platens have taken over (true without one). They do
  // when the pressure has risen and stood for its time, and the axial stress is within 1 % of it.
  double confining_pressure() const;
  bool cell() const { return settings_.loading.cell.has_value(); }
  bool axial_stage() const { return !cell() || model.time >= cell_end_; }
  double cell_ramp() const { return cell_ramp_; } // s
  // From a turn of the platens until the strain of the turn has been reached again.
  bool cycling() const {
    return cycle_.turns > 0 && (cycle_.direction < 0 || loaded_strain() < cycle_.strain);
  }
  const dem::LateralWall *wall() const { return wall_.get(); }   // null without a wall
  dem::Confinement *confinement() { return confinement_.get(); } // null without a pressure on the skin
  const dem::Confinement *confinement() const { return confinement_.get(); }
  Sleeve *sleeve() { return sleeve_.get(); } // null without one
  const Sleeve *sleeve() const { return sleeve_.get(); }
  // Of the volume within the sleeve, positive in compression; NaN without one.
  double sleeve_volumetric_strain() const;
  // Pa over nominal_area(): what the platens press on the sleeve's ends, which stress_top() and
  // stress_bottom() leave out, beyond the pressure that stands in the rubber anyway. NaN without a sleeve.
  double sleeve_deviator() const;
  // A bar between one strip above and two below.
  bool bent() const { return settings_.platens.span > 0; }
  dem::ThreePoints three_points() const { return {settings_.platens.span, shape_.width_y, shape_.height}; }
  double swing() const; // s, first period of the bar on its supports: slender, with the Voigt modulus
  double midspan_moment() const;     // N m, positive where it pulls the lower side; of a bent bar
  dem::EndPlanes end_planes() const; // where the platens' faces are now

  // Laboratory signs: compression positive (tension tests: still compression positive).
  double closure_strain() const; // platen to platen, over the height; elastic: of the faces, on the mean
                                 // over what the specimen covered at the start
  double grip_closure() const;   // m, of what the machine leads; rigid: of the platens
  double axial_closure() const;  // the same since the platens took over from a cell (without one: all of it)
  // Pa, load of the particles over nominal_area(), whatever the platens' own inertia makes of it.
  double stress_top() const, stress_bottom() const;
  // m^2: the cross-section; of a bent bar what makes the load its nominal flexural stress.
  double nominal_area() const { return bent() ? three_points().nominal_area() : shape_.cross_section(); }
  double platen_speed() const; // m/s, closure speed now
  dem::EnergyLedger energy() const;
  double unbalanced_ratio() const; // mean |net force| over mean |bond force|; NaN without bonds

  void describe(Archive &archive);

private:
  dem::StableStep limit_now();
  void choose_step(bool first);
  void look_at_step();
  [[noreturn]] void stop_not_finite() const;
  void look_at_energy();
  void add_forces();
  void press_skin();
  double sleeve_spring(const CellSettings &cell, double bond) const;
  void start_sleeve(const CellSettings &cell, double bond, double mass_scaling);
  double cheap_mass_of_sleeve() const;
  double cell_pressure() const;
  void move_sleeve();
  void load_sleeve();
  void turn_round();
  double loaded_strain() const { return settings_.loading.tension ? -axial_closure() : axial_closure(); }
  void look_at_cell();
  double lead_of_cell(double time) const;
  void start_cell(const CellSettings &cell, double bond);
  void give_platen_forces();
  bool platens_apart();
  void book_reactions();
  void set_platen_speeds();
  void drift_bodies();
  void kick_bodies();
  void solve_bodies();
  double limit_of_bodies() const;
  double face_move(const fem::Body &body, const MeanPlace &face) const;
  void announce_motion(double dt);
  std::vector<dem::GroundSpring> ground_springs() const;

  ProblemSettings settings_;
  dem::Shape shape_;
  double bottom_plane_ = 0, top_plane_ = 0; // m, z of the platens' faces at the start
  double mean_radius_ = 0;                  // m
  double packing_fraction_ = 0, grain_density_ = 0, voigt_modulus_ = 0, wave_crossing_ = 0, ramp_ = 0;
  double time_step_ = 0;
  std::string reason_;
  long steps_ = 0;
  std::size_t near_at_choice_ = 0;
  double boundary_work_ = 0;                      // J, of both platens
  double given_energy_ = 0;                       // J, of motion before the first step
  double energy_allowed_ = 0;                     // J, of motion, when it was last looked at
  double half_lightest_ = 0;                      // kg, of the particles' masses
  double reaction_top_ = 0, reaction_bottom_ = 0; // N, z, of the particles on the bodies
  MeanPlace top_face_, bottom_face_;              // of elastic platens
  MeanLoads top_loads_, bottom_loads_;            // of quasi-static ones
  long lists_compared_ = -1;                      // search lists made by both layers when apart_ was found
  bool apart_ = false;                            // no particle is near both platens
  std::unique_ptr<Servo> servo_;                  // null where both platens are always driven
  std::unique_ptr<Pace> pace_;                    // null where they keep one speed
  double cell_ramp_ = 0, cell_end_ = 0;           // s
  double cell_closure_ = 0;                       // closure strain at cell_end_
  double slowness_ = 1;                           // of a cell's servo, against the quickest
  double path_deviator_ = 0;                      // Pa, that the cell's path follows
  std::unique_ptr<dem::Confinement> confinement_;
  std::unique_ptr<Sleeve> sleeve_;
  double sleeve_volume_ = 0, sleeve_ring_ = 0; // m^3 within it, m^2 of an end of it, at the start
  std::unique_ptr<dem::LateralWall> wall_;
  struct Cycle {
    double direction = 1, speed = 1; // of loading; what the speed is now, which follows within the ramp
    double turns = 0;
    double strain = 0, stress = 0; // of the last turn; Pa
    void describe(Archive &archive);
  } cycle_;
};

} // namespace platen::coupling
