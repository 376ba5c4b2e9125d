// A specimen between two platens, one below and one above: the experiment of its settings, and its measures.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "coupling/boundaries/lateral_surface.h"
#include "coupling/boundaries/platen.h"
#include "coupling/boundaries/sleeve.h"
#include "coupling/platen_cover.h"
#include "coupling/platen_test_settings.h"
#include "coupling/program/task.h"
#include "dem/measure/circumference.h"
#include "dem/measure/gauge.h"
#include "dem/measure/solid_section.h"

namespace platen::coupling {

// Quantities of the specimen that are known before loading.
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

// m, distance of the outermost sphere from the plane of an end or side; negative where it reaches out.
double distance_to_plane(const dem::Specimen &specimen, Side side);

class PlatenTest : public Experiment, public Measures {
public:
  static constexpr double surface_skin = 0.3; // margin of the surfaces' particle lists, in mean radii

  // Throws BadParameter where a setting is out of its range, BadSetup where they do not go together.
  PlatenTest(const dem::Specimen &specimen, const PlatenTestSettings &settings);
  void step() { advance(1); }

  const PlatenTestSettings &settings() const { return settings_; } // as given, but the rate by transits
  const SpecimenFacts &facts() const { return facts_; }
  const dem::SolidSection &section() const { return section_; } // across the loaded axis; of a bent bar, x
  // Fraction of the shape's section for stresses along z: 1, except with net_section where it is not filled.
  double section_fraction() const { return settings_.net_section && !section_.fills() ? section_.mean : 1; }
  double coordination_number() const;                          // bonds per particle times two
  double ramp() const { return ramp_; }                        // s, of the axial loading
  double cell_ramp() const { return cell_ramp_; }              // s; 0 without a cell
  double axial_rate() const { return settings_.loading.rate; } // m/s, after the ramp

  // Its boundaries; null where the test has none.
  Platen &top() { return *platens_[1]; }
  Platen &bottom() { return *platens_[0]; }
  const Platen &top() const { return *platens_[1]; }
  const Platen &bottom() const { return *platens_[0]; }
  Sides sides() const;                         // indices of the boundaries
  PlatensOfAxis platens_of(Side side) const;   // the platen of that side
  PlatensOfAxis platens_along(int axis) const; // 0 x, 1 y, 2 z: the existing ones
  // Parameters for stages: the ramp (s) of a prescribed stress, and the time (s) by which the servo of these
  // platens receives it in advance; a servo for platens along an axis and up to `stress` (Pa) within `ramp`,
  // with a velocity limit of at least `least` (m/s); the servo for the top platen's own stress; the faster
  // rate of the axial platens while the specimen is elastic.
  double ramp_of_stress() const;
  double lead_of_servo(const PlatensOfAxis &platens) const;
  double machine_compliance(const PlatensOfAxis &platens) const; // m/N, times its dashpot: additional lead
  double time_of_servo(const PlatensOfAxis &platens) const;      // s, sum of both, estimated
  Servo::Parameters servo_for(double stress, int axis, double ramp, double least) const;
  Servo::Parameters servo_of_top() const;
  std::optional<RateControl::Parameters> rate_control() const;
  const Platen *platen(Side side) const { return platens_[static_cast<std::size_t>(side)]; }
  Platen *platen(Side side) { return platens_[static_cast<std::size_t>(side)]; }
  const ElasticPlaten *elastic_top() const { return elastic_[static_cast<std::size_t>(Side::top)]; }
  Sleeve *sleeve() { return sleeve_; }
  const Sleeve *sleeve() const { return sleeve_; }
  const Sleeve *tube() const { return settings_.loading.tube ? sleeve_ : nullptr; } // a sleeve without a cell
  const SkinPressure *skin() const { return skin_; }
  const LateralWall *wall() const { return wall_; }
  bool cell() const { return settings_.loading.cell.has_value(); }
  bool without_inertia() const { // elastic platens that are solved for statically
    return settings_.platens.elastic && settings_.platens.elastic->motion == fem::ElasticMotion::quasi_static;
  }
  bool platens_yield() const { return settings_.platens.elastic && settings_.platens.elastic->metal; }
  double platen_plastic_work() const;   // J, lost since the start
  double platen_plastic_strain() const; // equivalent, the largest mean of an element
  // What a platen covers of its end at the start; nothing for a disc and for a bent bar, which strips press.
  std::optional<PlatenCover> cover(Side side) const;
  bool bent() const { return settings_.platens.span > 0; } // a bar between one strip above and two below

  // Whether the loading by the platens has begun after a cell's stage (true without a cell); whether the
  // platens are between a reversal and its strain.
  bool axial_stage() const { return program().in_axial_stage(); }
  bool cycling() const { return program().is_cycling(); }

  // Laboratory signs: compression positive (tension tests: still compression positive).
  double closure_strain() const override; // platen to platen, over the height; elastic: of the faces, mean
                                          // over the area that the specimen covered at the start
  double axial_closure() const { return program().axial_closure(); } // since the start of the axial stage
  // Pa, load of the particles over nominal_area(), independent of the platens' own inertia.
  double stress_top() const, stress_bottom() const;
  // Pa, over the specimen's face on that side; NaN without platens.
  double stress(Side side) const;
  double closure_strain(int axis) const override;
  double widening(Widening of) const override;
  double circumferential_strain() const;
  double mouth_opening() const;                                    // m, of a notch; NaN without one
  const MachineSpring *machine() const { return top().machine(); } // null: a rigid one
  double machine_closure() const;          // m, of the crosshead and the bottom platen; NaN without a spring
  double confining_pressure() const;       // Pa, of a cell, as it acts on the lateral surface, or on the wall
  double confined_fraction() const;        // 1, of the lateral surface that a cell loads; NaN without one
  double sleeve_volumetric_strain() const; // within the sleeve, positive in compression; NaN without one
  // Pa over nominal_area(): pressure of the platens on the sleeve's ends, which stress_top() and
  // stress_bottom() leave out, in excess of the pressure in the rubber. NaN without a sleeve.
  double sleeve_deviator() const;
  double tube_load() const; // N, of the platens on the ends of a tube; NaN without one
  // m^2: the cross-section, or the net one; of a bent bar that which gives the nominal flexural stress.
  double nominal_area() const {
    return bent() ? three_points().nominal_area() : section_fraction() * shape().cross_section();
  }
  bool notched() const { return shape().notch.is_there(); }
  dem::ThreePoints three_points() const {
    return {settings_.platens.span, shape().width_y, shape().height, shape().notch.depth};
  }
  double bending_period()
      const; // s, first period of the bar on its supports: slender, with the Voigt modulus
  double midspan_moment() const; // N m, of a bent bar; positive: tension on the lower side
  dem::EndPlanes end_planes() const { return ends_->planes(); } // present planes of the platens' faces
  double platen_speed() const;                                  // m/s, present closure speed
  double seconds_behind() const;   // s, largest delay of a platen without inertia after its loads; or 0
  double unbalanced_ratio() const; // mean |net force| over mean |bond force|; NaN without bonds

  // The measures that its program reads.
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
  void measure_mouth();
  void add_platens(const dem::Specimen &specimen);
  void require_cover(Side side) const;
  void seat_platens(const dem::Specimen &specimen);
  void add_lateral(double bond);
  void add_sleeve(const SleeveSettings &given, double bond);
  void choose_rates();
  double gain_of_servo() const; // of servos other than the top platen's own
  double stiffness_of_specimen() const;
  double dashpot_of_machine(const PlatensOfAxis &platens) const;

  PlatenTestSettings settings_;
  SpecimenFacts facts_;
  std::array<Platen *, side_count> platens_{};              // by Side
  std::array<const ElasticPlaten *, side_count> elastic_{}; // those that deform
  std::optional<EndPlatens> ends_;
  Sleeve *sleeve_ = nullptr;
  const SkinPressure *skin_ = nullptr;
  const LateralWall *wall_ = nullptr;
  mutable std::optional<dem::Circumference> circumference_; // made when it is needed
  std::optional<dem::MouthOpening> mouth_;                  // of a notch
  double ramp_ = 0, cell_ramp_ = 0;                         // s
  double servo_slowness_ = 1; // of the stages' servos, relative to a cell's fastest
  dem::SolidSection section_;
};

} // namespace platen::coupling
