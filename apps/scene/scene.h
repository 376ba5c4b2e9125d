// A scene as the apps use it: every parameter of a scene file, checked, converted to SI and put into plain
// structs, one for each section of the file. NaN means "not given" where a member says so.
#pragma once

#include <cmath>
#include <cstddef>
#include <iosfwd>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace platen::apps {

class Parameters;

constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

// Which app reads the scene: it decides which entries must be given (a compression test needs an axial rate,
// a test of one bond needs no specimen).
enum class AppKind { pack, bonds, bar, compress, brazilian, calibrate, study, report };

// How often: a count of steps, a time (simulated seconds; wall clock for checkpoints), or none of both.
struct Interval {
  enum class Kind { none, steps, time }; // none: the app chooses, or the thing is off (see the member)
  Kind kind = Kind::none;
  double value = 0; // steps or s
};

// A length, absolute or as a multiple of the smaller radius of a pair.
struct Gap {
  bool relative = true;
  double value = 0.05; // of the smaller radius, or m
  double length(double smaller_radius) const { return relative ? value * smaller_radius : value; } // m
};

// A contact stiffness: a multiple of the bond's stiffness, an absolute one, or a multiple of the one that the
// bulk modulus K of the grains gives, k = value K_i R_i K_j R_j / (K_i R_i + K_j R_j).
struct Stiffness {
  enum class Kind { of_bond, absolute, of_bulk };
  Kind kind = Kind::of_bond;
  double value = 1; // 1, N/m or 1
};

enum class Quality { fast, standard, reference };

struct General { // section Scene
  std::string title;
  unsigned long seed = 1;
  Quality quality = Quality::standard;
};

enum class SpecimenShape { cylinder, box, bar, disc };
enum class RadiusDistribution { equal, two_sizes, uniform };
enum class PackingKind { advancing_front, random_close, file };
enum class EndsKind { as_packed, ground };

struct SpecimenSection {
  SpecimenShape shape = SpecimenShape::cylinder;
  double radius = not_given;                       // m; cylinder, round bar
  double height = not_given;                       // m, along z
  double width_x = not_given, width_y = not_given; // m; box, rectangular bar
  double sphere_radius = not_given;                // m, mean
  double radius_spread = 0;                        // kappa = (largest - smallest radius) / mean
  RadiusDistribution radius_distribution = RadiusDistribution::uniform;
  double second_radius_ratio = 0.5; // two sizes: second radius over the first
  double second_fraction = 0.5;     // two sizes: share of the number of spheres that has the second radius
  PackingKind packing = PackingKind::advancing_front;
  std::string file; // Packing = file; resolved against the folder of the scene
  EndsKind ends = EndsKind::as_packed;
  double end_layer = 1; // mean sphere radii
  bool seat = false;

  bool round() const {
    return !std::isnan(radius);
  } // cross-section: circle of `radius`, else width_x x width_y
};

enum class DensityOf { grains, solid };

struct Material {        // of the grains
  double density = 2400; // kg/m3
  DensityOf density_of = DensityOf::grains;
  double young_modulus = 17e9; // Pa
  double poisson_ratio = 0.15;
};

enum class BondKind { none, parallel_bond, cohesive_beam, elasto_damage_plastic };
enum class ContactKind { none, linear, hertz };
enum class TangentialKind { none, coulomb, coulomb_with_rolling_resistance };

struct Effects {
  BondKind bond = BondKind::parallel_bond;
  ContactKind contact = ContactKind::linear;
  TangentialKind tangential = TangentialKind::coulomb;
  bool rotation = true;
  bool bond_moments = true;
  bool gravity = false;
  bool energy_ledger = true;
  bool crack_log = true;
};

enum class RadiusRule { minimum, mean, harmonic, given };
enum class FailureLine { uncoupled, coupled };
enum class StrengthScatter { none, weibull };

struct Bond {
  double modulus = not_given;     // Pa
  double stiffness_ratio = 0.4;   // parallel bond
  double poisson_ratio = 0.3;     // cohesive beam, elasto damage plastic
  double tensile_strength = 0;    // Pa; 0: never breaks in tension
  double shear_strength = 0;      // Pa; 0: never breaks in shear
  double friction_angle = 0;      // rad
  double moment_contribution = 1; // 0 ... 1
  double radius_multiplier = 1;
  RadiusRule radius_rule = RadiusRule::minimum;
  double radius = not_given; // m; Radius rule = given
  Gap gap;
  double damping = 0; // dashpot, fraction of critical
  // Elasto damage plastic.
  double interaction_range = 0.1;         // of the sum of both radii
  double area_factor = 1;                 // 0: from the packing
  double friction_static = 0;             // while it holds
  double friction_dynamic = 0;            // once it has failed
  double softening_tension = 0.2;         // displacement of softening over that at the strength
  double softening_shear = 1;             // the same
  double fracture_energy_tension = 0;     // J/m2 of the softening branch; 0: by softening_tension
  double fracture_energy_shear = 0;       // J/m2
  std::vector<double> compression_limits; // Pa, LCS1..3
  std::vector<double> compression_slopes; // YRC1..3
  FailureLine failure_line = FailureLine::uncoupled;
  StrengthScatter strength_scatter = StrengthScatter::none;
  double weibull_modulus = not_given; // m; strength_scatter = weibull
};

enum class PhasesBy { none, radius, file };

struct PhasesSection { // aggregates in a matrix
  PhasesBy by = PhasesBy::none;
  double radius_above = not_given;                      // m; by = radius
  std::string file;                                     // by = file; resolved against the folder of the scene
  double aggregate_modulus = 1, aggregate_strength = 1; // of bonds, over those of the matrix
  double interface_modulus = 1, interface_strength = 1;
};

struct Contact {
  double friction = 0.5;
  Stiffness stiffness;           // linear contact
  double tangential_ratio = 0.5; // tangential over normal stiffness, linear contact
  double damping = 0.2;          // fraction of critical, linear contact
  double restitution = 1;        // (0, 1], hertz
  double rolling_friction = 0;   // rolling moment <= rolling_friction R* N
};

enum class PlatenKind { rigid, deformable };
enum class Attachment { contact, glued };
enum class PlatenControl { motion, stress };

struct PlatenSide { // of one platen; where the file gives none, the common value (never NaN in a scene read)
  double friction_static = not_given, friction_dynamic = not_given;
};

struct Platens {
  PlatenKind kind = PlatenKind::rigid;
  double friction_static = 0.3;        // common to both; the apps use top and bottom
  double friction_dynamic = not_given; // common to both; not given: as the static one
  PlatenSide top, bottom;
  PlatenControl top_control = PlatenControl::motion;
  double top_stress = 0;         // Pa, pressing; top_control = stress
  Stiffness stiffness;           // of_bond (of the mean bond) or absolute
  double tangential_ratio = 0.8; // tangential over normal penalty stiffness
  double damping = 0.2;          // fraction of critical
  double strip_width = 0;        // m, platen-brazilian, bending; 0: as wide as the platens
  double span = not_given;       // m, test = three_point_bending
  double overhang = 1.2;         // platen half-width over that of the specimen
  double thickness = 0;          // m; where the file gives 0, a tenth of the specimen's height
  int elements_across = 8;
  double density = 7830;        // kg/m3
  double young_modulus = 200e9; // Pa
  double poisson_ratio = 0.3;
  Attachment attachment = Attachment::contact;
};

struct Sleeve {
  double thickness = not_given; // m
  double modulus = not_given;   // Pa
  double poisson_ratio = not_given;
};

enum class LoadingTest { compression, tension, hydrostatic, uniaxial_strain, three_point_bending };
enum class ConfinementKind { none, particles, sleeve };
enum class ConfinementArea { voronoi, sphere };

struct Loading {
  LoadingTest test = LoadingTest::compression;
  double axial_rate = not_given; // m/s, speed of the platens towards (tension: from) each other, > 0
  double ramp = 0;               // s, smooth start; 0: the app chooses
  double hold = 0;             // s, how long a stress is held after its ramp: the top platen's, or the cell's
  double target_strain = 0.01; // closure of the platens over the height of the specimen
  double stop_at_residual = 0.02; // fraction of the peak stress; 0: never
  ConfinementKind confinement = ConfinementKind::none;
  double confining_pressure = 0; // Pa
  double confining_ramp = 0;     // s; 0: the app chooses
  ConfinementArea confinement_area = ConfinementArea::voronoi;

  double wall_stiffness = 10;    // of the mean bond's; test = uniaxial_strain
  std::vector<double> unload_at; // closure strains, ascending
  double unload_to = 0.1;        // share of the axial stress at the turn

  bool cell() const { return confinement == ConfinementKind::particles; }
  bool walled() const { return test == LoadingTest::uniaxial_strain; }
  bool bending() const { return test == LoadingTest::three_point_bending; }
  bool hydrostatic() const { return test == LoadingTest::hydrostatic; }
};

enum class InstructionSet { best, baseline };

enum class Scheme { velocity_verlet, tchamwa_wielgosz };

struct Integration {
  Scheme scheme = Scheme::velocity_verlet;
  double dissipation = 1.1; // phi of tchamwa wielgosz
  double safety = 0.8;      // time step over its limit
  double mass_scaling = 1;
  double damping = 0.5; // local, non-viscous
  double time_step = 0; // s; 0: safety times the limit
  InstructionSet instruction_set = InstructionSet::best;
};

struct Output {
  Interval every;        // rows of history.csv; none: the app chooses
  Interval fields_every; // frames of the .pvd series; none: the app chooses
  bool fields = true;
};

struct Checkpoint {
  Interval every{Interval::Kind::time, 600}; // time: s of wall clock; none: no checkpoints
};

// One expected number: low <= summary.json's key <= high; the open side of a one-sided range is infinite.
struct Expectation {
  std::string key; // a key of summary.json; `cone_top/height_m` is a member of an object
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  std::string text;   // the range as it stands in the scene
  std::string origin; // "case.prm:31"
};

enum class PairPath { tension, compression, shear, bending, twisting, cyclic };
enum class PairPlate { frictionless, rolling, sticking };

struct PairTest { // platen-bonds
  int particles = 2;
  PairPath path = PairPath::tension;
  PairPlate plate = PairPlate::frictionless; // three particles: what the lower two stand on
  bool base_bond = true;                     // three particles: a bond between the lower two
  double force = not_given;                  // N, largest
  double displacement = not_given;           // m, largest
  std::vector<double> moduli;                // Pa; holds Bond/Modulus where the list is empty
  std::vector<double> stiffness_ratios;      // holds Bond/Stiffness ratio where the list is empty
  int steps = 1000;
};

enum class CalibrateMode { bounds, abacus, search };

struct Calibrate { // platen-calibrate
  CalibrateMode mode = CalibrateMode::search;
  // Wanted of the specimen; each may be left out.
  double young_modulus = not_given, poisson_ratio = not_given;           // Pa, 1
  double compressive_strength = not_given, tensile_strength = not_given; // Pa
  int seeds = 3, verification_seeds = 5; // packings to calibrate on, and others to judge by
  double strain = 1e-5;                  // of the static solves
  double tension_rate = not_given;       // m/s; tension tests
  int most_trials = 8;                   // sets of strengths that are tried
  double tolerance = 0.02;               // of strengths, relative
  // Abacus; each holds the bond's own value where the list is empty.
  std::vector<double> moduli, stiffness_ratios, radius_multipliers, poisson_ratios; // Pa, 1, 1, 1
  // Where the search may go.
  double ratio_low = 0.02, ratio_high = 1;          // shear over normal stiffness (parallel bond)
  double multiplier_low = 0.3, multiplier_high = 1; // radius multiplier (cohesive beam)
  double moments_low = 0; // moment contribution, once the strengths are at their largest ratio
  double strengths_low = 0.5, strengths_high = 6; // shear over tensile strength of the bond
};

enum class BarLoad { all, tension, bending, torsion, impact, none };
enum class BarMethod { both, at_rest, dynamic };
enum class BarSide { x, y };

struct BarTest {               // platen-bar
  BarLoad load = BarLoad::all; // none: the moduli alone
  BarMethod method = BarMethod::both;
  BarSide side = BarSide::x; // the way in which the bar is bent
  double strain = 1e-4;      // at the skin of the clamped end
  double end_depth = 1;      // mean sphere radii
  double periods = 10;       // recorded of each oscillation
  bool bulk_moduli = true;
};

struct DomainSize {              // of a cylinder
  double height = 0, radius = 0; // m
};

struct Study {                      // platen-study; a list that is empty leaves the scene's own value
  int seeds = 5;                    // runs of each case: Scene/Seed and those after it
  std::vector<double> sphere_radii; // m; size
  std::vector<DomainSize> domains;  // size; at the scene's sphere radius
  std::vector<Gap> gaps;            // packing
  std::vector<double> radius_multipliers, radius_spreads; // packing
  std::vector<double> axial_rates;                        // m/s; rate
};

struct Scene {
  std::string name = "default"; // file name without its ending
  std::string path;             // as given on the command line
  General general;
  SpecimenSection specimen;
  Material material;
  Effects effects;
  Bond bond;
  PhasesSection phases;
  Contact contact;
  Platens platens;
  Sleeve sleeve;
  Loading loading;
  Integration integration;
  Output output;
  Checkpoint checkpoint;
  std::vector<Expectation> expect; // only those that the scene gives
  PairTest pair_test;
  Calibrate calibrate;
  BarTest bar_test;
  Study study;
  std::vector<std::string> notes; // entries that were set and have no effect here, one line each
  std::shared_ptr<const Parameters> parameters; // the same entries as text
};

// Every entry at its default, nothing required. Never throws InputError.
Scene default_scene();

// Reads `path` (.prm or .json), applies overrides ("Section/Key = value", in order), converts and checks all.
// Throws InputError with one message: file, line, key, value, what is allowed.
Scene read_scene(const std::string &path, const std::vector<std::string> &overrides, AppKind app);

// All parameters as used, defaults included, as a .prm that reads back to the same numbers bit for bit; paths
// of files are written so that they hold from `folder`, where the text will lie.
void write_scene(const Scene &scene, const std::string &folder, std::ostream &out);

// Every parameter with value, default, unit, range and meaning: as .prm, or as JSON (readable as a scene
// too).
void print_parameters(const Scene &scene, bool as_json, std::ostream &out);

} // namespace platen::apps
