// Sections of a scene that say what is done with the specimen. NaN means "not given" where a member says so.
#pragma once

#include <string>
#include <vector>

#include "apps/scene/quantities.h"

namespace platen::apps {

enum class PlatenKind { rigid, deformable };
enum class PlatenMotion { explicit_steps, quasi_static };
enum class Attachment { contact, glued };
enum class PlatenSeat { fixed, spherical };
enum class PlatenControl { motion, stress };
// What a platen's face is (apps/scene/surfaces.h); common: of one platen, what both are.
enum class SurfaceKind { common, custom, dry_steel, thesis, teflon, grease, brush, rubber_sheet, glued };
enum class FrictionLaw { common, constant, slip_weakening, velocity_weakening }; // common: as above

struct PlatenSide { // of one platen; where the file gives none, the common value (never NaN in a scene read)
  SurfaceKind surface = SurfaceKind::common;
  double friction_static = not_given, friction_dynamic = not_given;
  FrictionLaw friction_law = FrictionLaw::common;
  double slip_length = not_given, slip_velocity = not_given; // m, m/s; not given where no law needs them
  std::string mesh_file;                                     // Gmsh; empty: a plate
};

struct Platens {
  PlatenKind kind = PlatenKind::rigid;
  SurfaceKind surface = SurfaceKind::custom;
  double friction_static = 0.3;                              // common to both; the apps use top and bottom
  double friction_dynamic = not_given;                       // common to both; not given: as the static one
  FrictionLaw friction_law = FrictionLaw::constant;          // this and the next: common to both
  double slip_length = not_given, slip_velocity = not_given; // m, m/s
  PlatenSide top, bottom;
  PlatenControl top_control = PlatenControl::motion;
  PlatenSeat top_seat = PlatenSeat::fixed; // kind = deformable
  double top_stress = 0;                   // Pa, pressing; top_control = stress
  Stiffness stiffness;                     // of_bond (of the mean bond) or absolute
  double tangential_ratio = 0.8;           // tangential over normal penalty stiffness
  double damping = 0.2;                    // fraction of critical
  double strip_width = 0;                  // m, platen-brazilian, bending; 0: as wide as the platens
  double span = not_given;                 // m, test = three_point_bending
  double overhang = 1.2;                   // platen half-width over that of the specimen
  double thickness = 0;                    // m; where the file gives 0, a tenth of the specimen's height
  int elements_across = 8;
  double density = 7830;        // kg/m3
  double young_modulus = 200e9; // Pa
  double poisson_ratio = 0.3;
  PlatenMotion motion = PlatenMotion::explicit_steps; // this and the next: kind = deformable
  int degree = 1;
  double body_damping = 0.05;     // fraction of critical, of the fastest mode; motion = explicit_steps
  int steps_per_solve = 20;       // motion = quasi_static
  double pad_thickness = 0;       // m, of a sheet between platen and specimen, part of the thickness; 0: none
  double pad_modulus = not_given; // Pa
  double pad_poisson_ratio = not_given;
  double pad_density = not_given; // kg/m3
  double mesh_unit = 1;           // m, of the mesh files
  Attachment attachment = Attachment::contact;
};

enum class SleeveRims { bonded, sliding };

struct Sleeve {            // loading.confinement = sleeve
  double thickness = 3e-3; // m
  double modulus = 1.5e6;  // Pa
  double poisson_ratio = 0.4995;
  double density = 1100; // kg/m3
  SleeveRims rims = SleeveRims::bonded;
  int elements_around = 0; // 0: faces five mean radii wide
  int elements_through = 1;
  double friction = 0.5;
  double stiffness = 0;         // of its contacts, multiple of the mean bond's; 0: by the pressure
  double seat_depth = 1;        // mean radii
  double contact_damping = 0.2; // fraction of critical
  double damping = 1000;        // 1/s
  double mass_scaling = 0;      // 0: such that it is stepped once in eight steps
};

enum class LoadingTest { compression, tension, hydrostatic, uniaxial_strain, three_point_bending };
enum class ConfinementKind { none, particles, sleeve };
enum class ConfinementArea { voronoi, sphere };

struct Loading {
  LoadingTest test = LoadingTest::compression;
  double axial_rate = not_given;     // m/s, speed of the platens towards (tension: from) each other, > 0
  double wave_crossings = not_given; // in a thousandth of closure; sets the rate where it is not given
  double hurry = 1;                  // times that rate while the specimen is elastic
  double ramp = 0;                   // s, smooth start; 0: the app chooses
  double hold = 0;             // s, how long a stress is held after its ramp: the top platen's, or the cell's
  double start_strain = 0;     // closure of a static solve that the run begins with; 0: from nothing
  double target_strain = 0.01; // closure of the platens over the height of the specimen
  double stop_at_residual = 0.02; // fraction of the peak stress; 0: never
  double servo_gain = 0;          // 0: the app chooses
  ConfinementKind confinement = ConfinementKind::none;
  double confining_pressure = 0; // Pa
  double confining_ramp = 0;     // s; 0: the app chooses
  double pressure_path = 0;      // pressure gained per deviator after the cell's own stage
  ConfinementArea confinement_area = ConfinementArea::voronoi;

  double wall_stiffness = 10;    // of the mean bond's; test = uniaxial_strain
  std::vector<double> unload_at; // closure strains, ascending
  double unload_to = 0.1;        // share of the axial stress at the turn

  bool cell() const { return confinement != ConfinementKind::none; }
  bool sleeved() const { return confinement == ConfinementKind::sleeve; }
  bool walled() const { return test == LoadingTest::uniaxial_strain; }
  bool bending() const { return test == LoadingTest::three_point_bending; }
  bool hydrostatic() const { return test == LoadingTest::hydrostatic; }
};

struct Integration {
  double safety = 0.8;  // time step over its limit
  double time_step = 0; // s; 0: safety times the limit
};

} // namespace platen::apps
