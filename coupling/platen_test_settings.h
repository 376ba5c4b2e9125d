// The settings of a test between two platens. Each struct describes its members once (base/describe.h): unit,
// range, words and meaning; messages name a member by its path, which begins with `name`. NaN: not given.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "coupling/boundaries/machine_spring.h"
#include "coupling/experiment.h"
#include "coupling/metal_settings.h"
#include "coupling/side.h"
#include "coupling/sleeve_settings.h"
#include "coupling/stage_settings.h"
#include "dem/confinement.h"
#include "dem/laws/contact_settings.h"
#include "dem/packing/specimen.h"
#include "fem/elastic_solid.h"

namespace platen::coupling {

using Ends = dem::EndPreparation;
using dem::FacedEnds;

struct PlatenLayer {
  double thickness = 0;                                    // m; not used with a given grid
  fem::Material material{not_given, not_given, not_given}; // has to be given
  bool own = false; // of the platens' own material instead, which may yield
};

struct PlatenSide : dem::SurfaceFriction {
  fem::Grid grid = nullptr;             // null: a plate of the sizes below; else placed as in fem/grids.h
  double thickness = 0;                 // m, of the plate; 0: PlatenSettings::thickness
  std::vector<PlatenLayer> layers = {}; // of an elastic platen, as ElasticPlatens::layers; empty: those
};

// Linear elastic platens, fixed to the machine at the end that is far from the specimen. Penalty springs then
// represent the particles' compliance alone: the compliance of the platen is in its mesh.
struct ElasticPlatens {
  int degree = 1;
  fem::ElasticMotion motion = fem::ElasticMotion::explicit_steps;
  double damping = 0.05;    // fraction of critical damping of the fastest mode; explicit motion only
  int steps_per_solve = 20; // quasi-static motion only: steps of the particles
  double pad_thickness = 0; // m, of a sheet on the specimen's side, included in the thickness; 0: none
  fem::Material pad{not_given, not_given, not_given}; // of the pad, or the second material of a given grid
  // From the specimen outward; the rest of the thickness is of the platens' material. With a given grid: one
  // layer for each physical volume, in their order. Empty: platen and pad.
  std::vector<PlatenLayer> layers;
  std::optional<PlatenMetal> metal; // the platens' own material yields; explicit motion only. None: elastic

  static constexpr const char *name = "platens.elastic";
  template <class Visitor, class Self>
  static void describe(Visitor &&v, Self &p);
};

// The contact law of spheres on platens: the law of grains without bonds, or a separate one.
enum class PlatenContact { as_grains, linear, hertz };

struct PlatenSettings {
  PlatenSide top, bottom;
  std::optional<PlatenSide> left, right, front, back; // of a box; none: that side is free
  std::optional<ElasticPlatens> elastic;              // none: rigid
  MachineSettings machine;                            // behind the top platen
  PlatenContact contact = PlatenContact::as_grains;   // glued contacts are linear
  double contact_modulus = 0;    // Pa, Hertz: Young's modulus of the platens' side; 0: rigid platens have no
                                 // compliance, elastic ones use the material of their face
  dem::Stiffness stiffness;      // linear: relative to the mean bond, or absolute
  double tangential_ratio = 0.8; // linear
  double damping = 0.2;          // fraction of critical
  double strip_width = 0;        // m, of strips that press a disc or bend a bar; 0: as wide as the platens
  double span = not_given;       // m, between the middles of the two lower strips below a bar along x
  double overhang = 1.2;         // half-width of the platen over that of the specimen
  bool partial_cover = false;    // a given mesh need not cover all of its end of the specimen
  double thickness = 0;          // m
  int elements_across = 8;
  fem::Material material{7830, 200e9, 0.3};
  bool glued = false;
  // The top platen (an elastic one: its clamp) turns freely about the middle of its face, moved by the
  // machine.
  bool spherical_seat = false;
  double seat_friction_arm =
      0;                   // m, the moment at which the seat begins to turn over the load; 0: it turns freely
  double eccentricity = 0; // m, along x, of the seat from the axis: the load acts there
  double tilt =
      0; // rad, of the top platen as it meets the specimen: lowest at -x, over a disc at -y, if positive
  // m, between the edges of a platen and the planes of its neighbours, which may close by that much; 0: a
  // fiftieth of the specimen's length along that axis.
  double edge_gap = 0;

  const PlatenSide *side(Side side) const; // null where no platen presses

  static constexpr const char *name = "platens";
  template <class Visitor, class Self>
  static void describe(Visitor &&v, Self &p);
};

// A cell: pressure on the lateral surface and, while it rises and acts alone, the same stress on the platens.
struct CellSettings {
  double pressure = 0; // Pa
  double ramp = 0; // s, from zero to all of it; 0: sixty wave transits of the height, more for slow servos
  double path = 0; // 1, increase of the pressure per deviator of the axial stage; -1/3: constant mean stress
  // Without a sleeve the pressure acts on the spheres of the skin; with a sleeve it acts on its outer face.
  dem::ConfinementArea area = dem::ConfinementArea::voronoi;
  std::optional<SleeveSettings> sleeve;
  bool alone = false; // hydrostatic: the test ends when the pressure has been constant for `hold`

  static constexpr const char *name = "loading.cell";
  template <class Visitor, class Self>
  static void describe(Visitor &&v, Self &p);
};

struct LoadingSettings {
  bool tension = false;
  double rate = not_given; // m/s, closure (opening) speed of the platens, each moving at half of it
  // Sets the rate where it is not given: number of wave transits of the height during a closure of 0.1 %.
  double wave_transits = not_given;
  double rate_multiplier = 1; // factor on that rate while the specimen is elastic (RateControl); needs bonds
  double ramp = 0;            // s; 0: ten wave transits of the height
  double target_strain = not_given; // closure at which the test ends; not given: never
  double start_strain = 0;          // at the start of the run, for the estimate of its length
  bool servo = false; // the top platen holds a stress, no faster than `rate`, against a bottom platen at rest
  double top_stress = 0; // Pa, compression positive; reached smoothly over the ramp
  double hold = 0;       // s, duration of that stress after the ramp, or of a cell's pressure alone
  double servo_gain = 0; // 0.1 ... 10; 0: 5 for top_stress, 10 in a cell or on a spring, 40 else
  std::optional<CellSettings> cell;
  std::optional<SleeveSettings> tube; // around a cylinder without a cell: it confines as it is pressed
  bool wall = false;                  // around the specimen, stiff and frictionless
  double wall_stiffness = 10;         // multiple of the mean bond's
  double wall_layer = 1;              // mean radii: deeper spheres are not seated on the wall
  // Closure strains (since the end of a cell's own stage) at which the platens reverse until the axial stress
  // (less the cell's pressure) has fallen to this fraction of its value at the reversal; ascending.
  std::vector<double> unload_at;
  double unload_to = 0.1;
  // These stages, one after the other, replace the members above. A cell's pressure is then their largest
  // one.
  std::vector<StageSettings> stages;

  // The sleeve of a cell, or the tube; null: none.
  const SleeveSettings *sleeve() const {
    return tube ? &*tube : cell && cell->sleeve ? &*cell->sleeve : nullptr;
  }

  static constexpr const char *name = "loading";
  template <class Visitor, class Self>
  static void describe(Visitor &&v, Self &p);
};

class PlatenTest;
template <class Part>
using MadeFor = std::function<std::unique_ptr<Part>(const PlatenTest &)>;

struct PlatenTestSettings {
  dem::ModelSettings model;
  Ends ends = Ends::as_packed;
  double end_layer = 1; // mean radii, for ground ends
  // Of ends that are not flat (dem::depth_of_face): m, and which of both; the others are ground.
  double end_height = 0;
  FacedEnds end_faces = FacedEnds::top;
  std::uint64_t end_seed = 1; // rough ends
  bool seat = false;          // rocking springs of ground spheres
  // Stresses along z are over the part of the section that the specimen fills, which has to be the same at
  // all heights (dem::solid_section); else over the section of the shape.
  bool net_section = false;
  PlatenSettings platens;
  LoadingSettings loading;
  TimeStepSettings time_step;
  // User-defined: boundaries are added after those of the members above; stages replace those of the members,
  // a cell's consolidation included, so they have to command its pressure. They are made when platens and
  // lateral boundaries exist.
  std::vector<MadeFor<Boundary>> boundaries;
  std::vector<MadeFor<Stage>> stages;
};

// Whether grains press on platens by Hertz' law.
inline bool presses_by_hertz(const PlatenTestSettings &settings) {
  const PlatenSettings &p = settings.platens;
  if (p.contact != PlatenContact::as_grains) return p.contact == PlatenContact::hertz;
  const auto &grains = settings.model.contact;
  return !p.glued && grains && grains->normal == dem::NormalContact::hertz;
}

inline const PlatenSide *PlatenSettings::side(Side side) const {
  const auto there = [](const std::optional<PlatenSide> &given) { return given ? &*given : nullptr; };
  switch (side) {
    case Side::bottom:
      return &bottom;
    case Side::top:
      return &top;
    case Side::left:
      return there(left);
    case Side::right:
      return there(right);
    case Side::front:
      return there(front);
    default:
      return there(back);
  }
}

template <class Visitor, class Self>
void ElasticPlatens::describe(Visitor &&v, Self &p) {
  v("motion", p.motion,
    Words<fem::ElasticMotion>{{"explicit", fem::ElasticMotion::explicit_steps},
                              {"quasi-static", fem::ElasticMotion::quasi_static}},
    "Of deformable platens: with their inertia, step by step; or without, solved for now and then.");
  v("degree", p.degree, between(1, 2), "Of the elements of deformable platens.");
  v("damping", p.damping, "1", between(0, 1),
    "Fraction of critical damping of a deformable platen's fastest vibration, less of slower ones.");
  v("steps_per_solve", p.steps_per_solve, between(1, 100000),
    "Time steps over which loads are averaged for each solve.");
  v("pad_thickness", p.pad_thickness, "m", at_least(0),
    "Of a sheet of another material that faces the specimen, part of the thickness of a deformable platen; "
    "0: none.");
  v("pad_modulus", p.pad.young_modulus, "Pa", above(0), "Young modulus of that sheet.");
  v("pad_poisson_ratio", p.pad.poisson_ratio, "1", between_open(-1, 0.5), "Poisson ratio of that sheet.");
  v("pad_density", p.pad.density, "kg/m3", above(0), "Density of that sheet.");
}

template <class Visitor, class Self>
void PlatenSettings::describe(Visitor &&v, Self &p) {
  v("contact", p.contact,
    Words<PlatenContact>{{"as grains", PlatenContact::as_grains},
                         {"linear", PlatenContact::linear},
                         {"hertz", PlatenContact::hertz}},
    "Normal force of grains on platens; as grains: by their own law, linear where they have none and where "
    "ends are glued. Hertz: sphere on plane, with Mindlin's tangential stiffness.");
  v("contact_modulus", p.contact_modulus, "Pa", at_least(0),
    "Hertz: Young modulus of the platens' side, with their Poisson ratio; 0: rigid platens do not give way "
    "there, deformable ones by the material of their face.");
  v("tangential_ratio", p.tangential_ratio, "1", above_up_to(0, 5),
    "Tangential over normal penalty stiffness.");
  v("damping", p.damping, "1", between(0, 1), "Fraction of critical damping of grains on platens.");
  v("overhang", p.overhang, "1", between(1, 10), "Half-width of the platens over that of the specimen.");
  v("partial_cover", p.partial_cover, Words<bool>{{"whole", false}, {"partial", true}},
    "Of meshes: whole, they have to reach over all of the specimen's end, gaps between their faces aside; or "
    "partial, for punches: stresses are over the whole end all the same.");
  v("strip_width", p.strip_width, "m", at_least(0),
    "platen-brazilian: width of the strips that the disc lies between; 0: of the whole platens. "
    "Test = three point bending: of the strip above the bar and the two below.");
  v("span", p.span, "m", above(0), "Distance of the middles of the two lower strips.");
  v("edge_gap", p.edge_gap, "m", at_least(0),
    "From the edges of a platen to the planes of its neighbours, where a box has platens on other sides too: "
    "how far these may close; 0: a fiftieth of the specimen's length there.");
  v("thickness", p.thickness, "m", at_least(0), "0: a tenth of the specimen's height.");
  v("elements_across", p.elements_across, between(1, 1000), "Finite elements across a platen.");
  v("density", p.material.density, "kg/m3", above(0), "Density of the platens.");
  v("young_modulus", p.material.young_modulus, "Pa", above(0), "Young modulus of the platens.");
  v("poisson_ratio", p.material.poisson_ratio, "1", between_open(-1, 0.5), "Poisson ratio of the platens.");
  v("glued", p.glued, Words<bool>{{"contact", false}, {"glued", true}},
    "Glued: the end grains are held by the platens, in tension too.");
  v("seat_friction_arm", p.seat_friction_arm, "m", at_least(0),
    "Of a rigid platen's spherical seat, the coefficient of friction of its ball times the radius: it sticks "
    "until the load lies farther from its centre; 0: it turns freely.");
  v("eccentricity", p.eccentricity, "m", any_number(),
    "Along x, of the spherical seat from the axis: the middle of the load.");
  v("tilt", p.tilt, "rad", between(-0.1, 0.1),
    "Of a rigid top platen about y, before it meets the specimen: 0 is square to the axis; positive: the "
    "side of -x comes first. Over a disc about x: the side of -y comes first.");
  v("spherical_seat", p.spherical_seat, Words<bool>{{"fixed", false}, {"spherical", true}},
    "Spherical: the top platen turns freely about the middle of its face, which the machine moves; a "
    "deformable one with its clamp.");
}

template <class Visitor, class Self>
void CellSettings::describe(Visitor &&v, Self &p) {
  v("pressure", p.pressure, "Pa", at_least(0), "Lateral pressure, and that on the platens while it rises.");
  v("ramp", p.ramp, "s", at_least(0),
    "Time in which the pressure rises smoothly; 0: chosen by the app, longer for a slow servo.");
  v("path", p.path, "1", between(-0.5, 3),
    "What the pressure gains per deviator of the axial stage: 0 holds it, -1/3 holds the mean stress, "
    "positive values load proportionally.");
  v("area", p.area,
    Words<dem::ConfinementArea>{{"voronoi", dem::ConfinementArea::voronoi},
                                {"sphere", dem::ConfinementArea::sphere}},
    "What the pressure acts on: each sphere's part of the deformed surface, or pi R^2 of each lateral "
    "sphere.");
}

template <class Visitor, class Self>
void LoadingSettings::describe(Visitor &&v, Self &p) {
  v("rate", p.rate, "m/s", above(0), "Speed of closure (tension: of opening).");
  v("wave_transits", p.wave_transits, "1", above(0),
    "Sets the speed where Axial rate is not given: how often a wave crosses the specimen while it closes by "
    "0.1 % (platen-compress; compression, uniaxial strain).");
  v("rate_multiplier", p.rate_multiplier, "1", between(1, 100),
    "How many times as fast the platens go while the specimen is elastic, before it fails and where it is "
    "unloaded; 1: always at the speed of the test.");
  v("ramp", p.ramp, "s", at_least(0), "Time of the smooth start; 0: chosen by the app.");
  v("hold", p.hold, "s", at_least(0),
    "How long the stress on the top platen is held after the ramp (Control = stress); with Confinement: how "
    "long its pressure stands on all sides before the platens move on.");
  v("start_strain", p.start_strain, "1", from_to_below(0, 1),
    "Closure over height that a static solve begins the run with, at rest; 0: from nothing.");
  v("target_strain", p.target_strain, "1", above_up_to(0, 1),
    "Closure over height at which the run is over.");
  v("servo", p.servo, Words<bool>{{"motion", false}, {"stress", true}},
    "What is prescribed on the top platen.");
  v("top_stress", p.top_stress, "Pa", at_least(0), "Pressing stress.");
  v("servo_gain", p.servo_gain, "1", between(0, 10),
    "Of the servo that holds the top platen at its stress or, while a cell's pressure rises, at that "
    "pressure: 0.1 is slow, 10 quick; 0: chosen by the app (5; in a cell or on a machine's spring 10; of "
    "stages between platens alone 40).");
  v("wall_stiffness", p.wall_stiffness, "1", above_up_to(0, 1000),
    "Of each sphere at the wall, as a multiple of the mean bond's.");
  v("unload_at", p.unload_at, "1", above_up_to(0, 1),
    "Closures over height, ascending, at which the platens turn round; empty: never.");
  v("unload_to", p.unload_to, "1", between(0, 0.95),
    "Share of the axial stress at the turn (less a confining pressure) at which they load again.");
}

} // namespace platen::coupling
