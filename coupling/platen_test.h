// A specimen between two platens, one below and one above: the experiment that its settings describe, and
// what is measured of it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "coupling/boundaries/elastic_platen.h"
#include "coupling/boundaries/lateral_wall.h"
#include "coupling/boundaries/platen.h"
#include "coupling/boundaries/skin_pressure.h"
#include "coupling/boundaries/sleeve.h"
#include "coupling/experiment.h"
#include "dem/measure/bending.h"

namespace platen::coupling {

enum class Ends { as_packed, ground };

struct PlatenSide : dem::SurfaceFriction {
  fem::Grid grid = nullptr; // null: a plate of the sizes below; else laid as fem/platen_mesh.h says
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
  double ramp = 0; // s, from none to all of it; 0: sixty wave transits of the height, more for slow servos
  double hold = 0; // s, how long it stands alone at least
  double path = 0; // 1, what the pressure gains per deviator of the axial stage; -1/3: constant mean stress
  // Without a sleeve the pressure acts on the spheres of the skin; with one on its outer face.
  dem::ConfinementArea area = dem::ConfinementArea::voronoi;
  std::optional<SleeveSettings> sleeve;
  double sleeve_stiffness = 0;  // of its contacts, multiple of the mean bond's; 0: by the pressure
  double sleeve_seat_depth = 1; // mean radii: spheres no deeper lie flush with its inner face
  bool alone = false;           // hydrostatic: the test is over when the pressure has stood for its time
};

struct LoadingSettings {
  bool tension = false;
  double rate = 0; // m/s, closure (opening) speed of the platens, each moving at half of it
  double wave_transits =
      0; // > 0: that speed at which a wave crosses the height so often in a closure by 0.1 %
  double rate_multiplier = 1; // times that rate while the specimen is elastic (RateControl); needs bonds
  double ramp = 0;            // s; 0: ten wave transits of the height
  double target_strain = std::numeric_limits<double>::infinity(); // closure at which the test is over
  double start_strain = 0; // that the run begins with, for what is expected of its length
  bool servo = false; // the top platen holds a stress, at most `rate` fast, against a bottom platen at rest
  double top_stress = 0;                                 // Pa, pressing; reached smoothly over the ramp
  double hold = std::numeric_limits<double>::infinity(); // s, how long that is held after the ramp
  double servo_gain = 0; // 0.1 ... 10 as Servo has it; 0: 5 for top_stress, 10 in a cell
  std::optional<CellSettings> cell;
  double wall_stiffness = 0; // multiple of the mean bond's; 0: no wall around the specimen
  double wall_layer = 1;     // mean radii: deeper spheres are not seated on the wall
  // Closure strains (since the end of a cell's own stage) at which the platens turn round until the axial
  // stress (less the cell's pressure) has fallen to this share of what it was; ascending.
  std::vector<double> unload_at;
  double unload_to = 0.1;
};

class PlatenTest;
template <class Part>
using MadeFor = std::function<std::unique_ptr<Part>(const PlatenTest &)>;

struct PlatenTestSettings {
  dem::ModelSettings model;
  Ends ends = Ends::as_packed;
  double end_layer = 1; // mean radii, for ground ends
  bool seat = false;    // rocking springs of ground spheres
  PlatenSettings platens;
  LoadingSettings loading;
  TimeStepSettings time_step;
  // Of one's own: boundaries after those that the members above make, and stages in their place. They are
  // made when platens and lateral boundaries are there.
  std::vector<MadeFor<Boundary>> boundaries;
  std::vector<MadeFor<Stage>> stages;
};

// What is known of the specimen before it is loaded.
struct SpecimenFacts {
  double mean_radius = 0;      // m
  double packing_fraction = 0; // 1
  double grain_density = 0;    // kg/m^3, before mass scaling
  double voigt_modulus = 0;    // Pa; 0 without bonds
  double wave_transit = 0;     // s, over the height, from the Voigt modulus; 0 without bonds
};
SpecimenFacts facts_of(const dem::Specimen &specimen, const dem::ModelSettings &settings,
                       const dem::Model &model);

class PlatenTest : public Experiment, public Measures {
public:
  static constexpr double surface_skin = 0.3; // margin of the surfaces' particle lists, in mean radii

  // Throws BadSetup where the settings do not go together.
  PlatenTest(const dem::Specimen &specimen, const PlatenTestSettings &settings);
  void step() { advance(1); }

  const PlatenTestSettings &settings() const { return settings_; } // as given, but for the rate by transits
  const SpecimenFacts &facts() const { return facts_; }
  double coordination_number() const;                          // bonds per particle times two
  double ramp() const { return ramp_; }                        // s, of the axial loading
  double cell_ramp() const { return cell_ramp_; }              // s; 0 without a cell
  double axial_rate() const { return settings_.loading.rate; } // m/s, once the platens are at speed

  // Its boundaries; null where the test has none.
  Platen &top() { return *top_; }
  Platen &bottom() { return *bottom_; }
  const Platen &top() const { return *top_; }
  const Platen &bottom() const { return *bottom_; }
  const ElasticPlaten *elastic_top() const { return elastic_top_; }
  Sleeve *sleeve() { return sleeve_; }
  const Sleeve *sleeve() const { return sleeve_; }
  const SkinPressure *skin() const { return skin_; }
  const LateralWall *wall() const { return wall_; }
  bool cell() const { return settings_.loading.cell.has_value(); }
  bool bent() const { return settings_.platens.span > 0; } // a bar between one strip above and two below

  // Whether the platens have taken over from a cell (true without one); between a turn and its strain.
  bool axial_stage() const { return program().in_axial_stage(); }
  bool cycling() const { return program().is_cycling(); }

  // Laboratory signs: compression positive (tension tests: still compression positive).
  double closure_strain() const override; // platen to platen, over the height; elastic: of the faces, on the
                                          // mean over what the specimen covered at the start
  double grip_closure() const;            // m, of what the machine moves; rigid: of the platens
  double axial_closure() const { return program().axial_closure(); } // since the platens took over
  // Pa, load of the particles over nominal_area(), whatever the platens' own inertia makes of it.
  double stress_top() const, stress_bottom() const;
  double confining_pressure() const;       // Pa, of the cell, or on the wall
  double sleeve_volumetric_strain() const; // within the sleeve, positive in compression; NaN without one
  // Pa over nominal_area(): what the platens press on the sleeve's ends, which stress_top() and
  // stress_bottom() leave out, beyond the pressure that stands in the rubber anyway. NaN without a sleeve.
  double sleeve_deviator() const;
  // m^2: the cross-section; of a bent bar what makes the load its nominal flexural stress.
  double nominal_area() const { return bent() ? three_points().nominal_area() : shape().cross_section(); }
  dem::ThreePoints three_points() const { return {settings_.platens.span, shape().width_y, shape().height}; }
  double bending_period()
      const; // s, first period of the bar on its supports: slender, with the Voigt modulus
  double midspan_moment() const; // N m, positive where it pulls the lower side; of a bent bar
  dem::EndPlanes end_planes() const { return ends_->planes(); } // where the platens' faces are now
  double platen_speed() const;                                  // m/s, closure speed now
  double unbalanced_ratio() const; // mean |net force| over mean |bond force|; NaN without bonds

  // What its program sees.
  double time() const override { return Experiment::time(); }
  double time_step() const override { return Experiment::time_step(); }
  double axial_stress() const override { return 0.5 * (stress_top() + stress_bottom()); }
  double lateral_pressure() const override { return confining_pressure(); }
  double broken_bonds() const override;
  Vector3 force(std::size_t boundary) const override { return boundaries()[boundary]->force(); }
  ServoLoad servo_load(std::size_t boundary) const override {
    return boundaries()[boundary]->servo_load(model.particles);
  }

private:
  void add_platens(const dem::Specimen &specimen);
  void seat_platens(const dem::Specimen &specimen);
  void add_lateral(double bond);
  void add_sleeve(const CellSettings &cell, double bond);
  void choose_rates();
  std::unique_ptr<Program> make_program() const;
  std::unique_ptr<Stage> axial_stage_of_settings() const;
  Sides sides() const;

  PlatenTestSettings settings_;
  SpecimenFacts facts_;
  Platen *top_ = nullptr, *bottom_ = nullptr;
  const ElasticPlaten *elastic_top_ = nullptr;
  std::optional<EndPlatens> ends_;
  Sleeve *sleeve_ = nullptr;
  const SkinPressure *skin_ = nullptr;
  const LateralWall *wall_ = nullptr;
  double ramp_ = 0, cell_ramp_ = 0; // s
  double servo_slowness_ = 1;       // of a cell's servo, against the quickest
};

} // namespace platen::coupling
