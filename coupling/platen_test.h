// A specimen between two platens, one below and one above: the experiment that its settings describe, and
// what is measured of it.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "coupling/boundaries/lateral_surface.h"
#include "coupling/boundaries/platen.h"
#include "coupling/platen_cover.h"
#include "coupling/platen_test_settings.h"
#include "coupling/program/task.h"
#include "dem/measure/circumference.h"
#include "dem/measure/gauge.h"
#include "dem/measure/solid_section.h"

namespace platen::coupling {

// What is known of the specimen before it is loaded.
struct SpecimenFacts {
  double mean_radius = 0;                // m
  double packing_fraction = 0;           // 1
  double grain_density = 0;              // kg/m^3, before mass scaling
  double voigt_modulus = 0;              // Pa; 0 without bonds
  std::array<double, 3> affine_moduli{}; // Pa, of what bonds can have along x, y and z; 0 without bonds
  double wave_transit = 0;               // s, over the height, from the Voigt modulus; 0 without bonds
};
SpecimenFacts facts_of(const dem::Specimen &specimen, const dem::ModelSettings &settings,
                       const dem::Model &model);

// m, of the outermost sphere from the plane of an end or side of the shape; negative where it reaches out.
double distance_to_plane(const dem::Specimen &specimen, Side side);

class PlatenTest : public Experiment, public Measures {
public:
  static constexpr double surface_skin = 0.3; // margin of the surfaces' particle lists, in mean radii

  // Throws BadParameter where a setting is out of its range, BadSetup where they do not go together.
  PlatenTest(const dem::Specimen &specimen, const PlatenTestSettings &settings);
  void step() { advance(1); }

  const PlatenTestSettings &settings() const { return settings_; } // as given, but for the rate by transits
  const SpecimenFacts &facts() const { return facts_; }
  const dem::SolidSection &section() const { return section_; } // across the loaded axis; of a bent bar, x
  // What stresses along z are over, of the shape's section: 1, but with net_section where it is not filled.
  double section_share() const { return settings_.net_section && !section_.fills() ? section_.mean : 1; }
  double coordination_number() const;                          // bonds per particle times two
  double ramp() const { return ramp_; }                        // s, of the axial loading
  double cell_ramp() const { return cell_ramp_; }              // s; 0 without a cell
  double axial_rate() const { return settings_.loading.rate; } // m/s, once the platens are at speed

  // Its boundaries; null where the test has none.
  Platen &top() { return *platens_[1]; }
  Platen &bottom() { return *platens_[0]; }
  const Platen &top() const { return *platens_[1]; }
  const Platen &bottom() const { return *platens_[0]; }
  Sides sides() const;                         // their places
  PlatensOfAxis platens_of(Side side) const;   // that one
  PlatensOfAxis platens_along(int axis) const; // 0 x, 1 y, 2 z: those that there are
  // What stages are made with: of a stress that is asked, its ramp (s) and how far ahead (s) the servo of
  // such platens is told of it; a servo that leads platens along an axis up to `stress` (Pa) within `ramp`,
  // or after platens that move (`follows`); that of the top platen's own stress; how the axial platens go
  // faster while the specimen is elastic.
  double ramp_of_stress() const;
  double lead_of_servo(const PlatensOfAxis &platens) const;
  double machine_compliance(const PlatensOfAxis &platens) const; // m/N, times its dashpot: ahead of that
  double time_of_servo(const PlatensOfAxis &platens) const;      // s, both, estimated
  Servo::Parameters servo_for(double stress, int axis, double ramp, double least) const;
  Servo::Parameters servo_of_top() const;
  std::optional<RateControl::Parameters> rate_control() const;
  const Platen *platen(Side side) const { return platens_[static_cast<std::size_t>(side)]; }
  Platen *platen(Side side) { return platens_[static_cast<std::size_t>(side)]; }
  const ElasticPlaten *elastic_top() const { return elastic_top_; }
  Sleeve *sleeve() { return sleeve_; }
  const Sleeve *sleeve() const { return sleeve_; }
  const SkinPressure *skin() const { return skin_; }
  const LateralWall *wall() const { return wall_; }
  bool cell() const { return settings_.loading.cell.has_value(); }
  bool without_inertia() const { // platens that yield and are solved for
    return settings_.platens.elastic && settings_.platens.elastic->motion == fem::ElasticMotion::quasi_static;
  }
  // What a platen covers of its end at the start; of a disc and of a bent bar, which strips press, nothing.
  std::optional<PlatenCover> cover(Side side) const;
  bool bent() const { return settings_.platens.span > 0; } // a bar between one strip above and two below

  // Whether the platens have taken over from a cell (true without one); between a turn and its strain.
  bool axial_stage() const { return program().in_axial_stage(); }
  bool cycling() const { return program().is_cycling(); }

  // Laboratory signs: compression positive (tension tests: still compression positive).
  double closure_strain() const override; // platen to platen, over the height; elastic: of the faces, on the
                                          // mean over what the specimen covered at the start
  double axial_closure() const { return program().axial_closure(); } // since the platens took over
  // Pa, load of the particles over nominal_area(), whatever the platens' own inertia makes of it.
  double stress_top() const, stress_bottom() const;
  // Pa over the specimen's face there, without platens NaN.
  double stress(Side side) const;
  double closure_strain(int axis) const override;
  double circumferential_strain() const override;
  const MachineSpring *machine() const { return top().machine(); } // null: a rigid one
  double machine_closure() const;          // m, of the crosshead and the bottom platen; NaN without a spring
  double confining_pressure() const;       // Pa, of a cell, as it acts on the lateral surface, or on the wall
  double confined_share() const;           // 1, of the lateral surface that a cell loads; NaN without one
  double sleeve_volumetric_strain() const; // within the sleeve, positive in compression; NaN without one
  // Pa over nominal_area(): what the platens press on the sleeve's ends, which stress_top() and
  // stress_bottom() leave out, beyond the pressure that stands in the rubber anyway. NaN without a sleeve.
  double sleeve_deviator() const;
  // m^2: the cross-section, or the net one; of a bent bar what makes the load its nominal flexural stress.
  double nominal_area() const {
    return bent() ? three_points().nominal_area() : section_share() * shape().cross_section();
  }
  dem::ThreePoints three_points() const { return {settings_.platens.span, shape().width_y, shape().height}; }
  double bending_period()
      const; // s, first period of the bar on its supports: slender, with the Voigt modulus
  double midspan_moment() const; // N m, positive where it pulls the lower side; of a bent bar
  dem::EndPlanes end_planes() const { return ends_->planes(); } // where the platens' faces are now
  double platen_speed() const;                                  // m/s, closure speed now
  double seconds_behind() const;   // s, of the platen without inertia that comes latest after its loads; or 0
  double unbalanced_ratio() const; // mean |net force| over mean |bond force|; NaN without bonds

  // What its program sees.
  double time() const override { return Experiment::time(); }
  double time_step() const override { return Experiment::time_step(); }
  double axial_stress() const override { return 0.5 * (stress_top() + stress_bottom()); }
  double lateral_pressure() const override { return confining_pressure(); }
  double broken_bonds() const override;
  Vector3 force(std::size_t boundary) const override { return boundaries()[boundary]->force(); }
  double load(std::size_t boundary) const override { return boundaries()[boundary]->load(); }
  double moved_inward(std::size_t boundary) const override { return boundaries()[boundary]->closure(); }
  Vector3 inward(std::size_t boundary) const override { return boundaries()[boundary]->inward(); }
  ServoLoad servo_load(std::size_t boundary) const override {
    return boundaries()[boundary]->servo_load(model.particles);
  }

protected:
  double strain_of_cracks() const override { return closure_strain(); }
  std::vector<int> rows_measured() const override;

private:
  void require_in_range() const;
  void require_one_section() const;
  void add_platens(const dem::Specimen &specimen);
  void require_cover(Side side) const;
  void seat_platens(const dem::Specimen &specimen);
  void add_lateral(double bond);
  void add_sleeve(const CellSettings &cell, double bond);
  void choose_rates();
  double gain_of_servo() const; // of those that are not the top platen's own
  double stiffness_of_specimen() const;
  double dashpot_of_machine(const PlatensOfAxis &platens) const;

  PlatenTestSettings settings_;
  SpecimenFacts facts_;
  std::array<Platen *, side_count> platens_{}; // by Side
  const ElasticPlaten *elastic_top_ = nullptr;
  std::optional<EndPlatens> ends_;
  Sleeve *sleeve_ = nullptr;
  const SkinPressure *skin_ = nullptr;
  const LateralWall *wall_ = nullptr;
  mutable std::optional<dem::Circumference> circumference_; // made when it is asked for
  double ramp_ = 0, cell_ramp_ = 0;                         // s
  double servo_slowness_ = 1; // of the stages' servos, against a cell's quickest
  dem::SolidSection section_;
};

} // namespace platen::coupling
