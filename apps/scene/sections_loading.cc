// What the specimen meets: platens, sleeve and loading.
#include "apps/scene/sections.h"
#include "apps/scene/surfaces.h"

namespace platen::apps {
namespace {

void declare_friction_law(Section &section, FrictionLaw &law, double &length, double &velocity,
                          bool of_one_side) {
  std::vector<std::pair<std::string, FrictionLaw>> words{
      {"constant", FrictionLaw::constant},
      {"slip weakening", FrictionLaw::slip_weakening},
      {"velocity weakening", FrictionLaw::velocity_weakening}};
  if (of_one_side) words.insert(words.begin(), {"common", FrictionLaw::common});
  const auto as = [&](const std::string &key) {
    return "As Platens/" + key + (key == "Friction law" ? "; common: as both." : " where not given.");
  };
  section.word<FrictionLaw>(
      "Friction law", law, words,
      of_one_side ? as("Friction law")
                  : "How friction falls from static to dynamic. Constant: at once, and back at rest; slip "
                    "weakening: dynamic + (static - dynamic) s0 / (s0 + s), s the path that the contact has "
                    "slid (Cusatis et al. 2011); velocity weakening: dynamic + (static - dynamic) exp(-v / "
                    "v0), v its speed (Andersson et al. 2007).");
  section.quantity("Slip length", length, "m", above(0),
                   of_one_side ? as("Slip length") : "s0: the slip that takes half (Friction law).");
  section.quantity("Slip velocity", velocity, "m/s", above(0),
                   of_one_side ? as("Slip velocity") : "v0 (Friction law).");
}

void declare_side(Parameters &parameters, const std::string &name, PlatenSide &side) {
  Section section(parameters, name);
  section.word<SurfaceKind>("Surface", side.surface, surface_words(true),
                            "As Platens/Surface, of this platen alone; common: as both.");
  section.number("Friction static", side.friction_static, between(0, 5),
                 "As Platens/Friction static where not given.");
  section.number("Friction dynamic", side.friction_dynamic, between(0, 5),
                 "As Platens/Friction dynamic where not given.");
  declare_friction_law(section, side.friction_law, side.slip_length, side.slip_velocity, true);
  section.file("Mesh file", side.mesh_file,
               "Gmsh mesh of hexahedra (.msh, 2.2 or 4.1) in place of a plate: its extreme plane towards the "
               "specimen is laid on the end, the far plane is the machine's.");
}

} // namespace

void declare_platens(Parameters &parameters, Platens &platens) {
  Section section(parameters, "Platens");
  section.word<PlatenKind>("Kind", platens.kind,
                           {{"rigid", PlatenKind::rigid}, {"deformable", PlatenKind::deformable}},
                           "Rigid bodies, or elastic ones by finite elements.");
  section.word<SurfaceKind>("Surface", platens.surface, surface_words(false),
                            "What both platens' faces are: the entries that a word stands for, each where "
                            "the scene does not give it. " +
                                surface_documentation());
  section.number("Friction static", platens.friction_static, between(0, 5),
                 "Coefficient of friction of grains on both platens while they stick.");
  section.number("Friction dynamic", platens.friction_dynamic, between(0, 5),
                 "The same while they slide; as the static one where not given.");
  declare_friction_law(section, platens.friction_law, platens.slip_length, platens.slip_velocity, false);
  section.stiffness("Stiffness", platens.stiffness, false,
                    "Penalty stiffness of grains on platens; a multiple is that of the mean bond.");
  section.number("Tangential ratio", platens.tangential_ratio, between(0, 5),
                 "Tangential over normal penalty stiffness.");
  section.number("Damping", platens.damping, between(0, 1),
                 "Fraction of critical damping of grains on platens.");
  section.number("Overhang", platens.overhang, between(1, 10),
                 "Half-width of the platens over that of the specimen.");
  section.quantity(
      "Strip width", platens.strip_width, "m", at_least(0),
      "platen-brazilian: width of the strips that the disc lies between; 0: of the whole platens. "
      "Test = three point bending: of the strip above the bar and the two below.");
  section.quantity("Span", platens.span, "m", above(0),
                   "Distance of the middles of the two lower strips (Test = three point bending).");
  section.quantity("Thickness", platens.thickness, "m", at_least(0), "0: a tenth of the specimen's height.");
  section.integer("Elements across", platens.elements_across, 1, 1000, "Finite elements across a platen.");
  section.quantity("Density", platens.density, "kg/m3", above(0), "Density of the platens.");
  section.quantity("Young modulus", platens.young_modulus, "Pa", above(0), "Young modulus of the platens.");
  section.number("Poisson ratio", platens.poisson_ratio, between_open(-1, 0.5),
                 "Poisson ratio of the platens.");
  section.word<PlatenMotion>(
      "Motion", platens.motion,
      {{"explicit", PlatenMotion::explicit_steps}, {"quasi-static", PlatenMotion::quasi_static}},
      "Of deformable platens: with their inertia, step by step; or without, solved for now and then.");
  section.integer("Degree", platens.degree, 1, 2, "Of the elements of deformable platens.");
  section.number(
      "Body damping", platens.body_damping, between(0, 1),
      "Fraction of critical damping of a deformable platen's fastest vibration, less of slower ones "
      "(Motion = explicit).");
  section.integer("Steps per solve", platens.steps_per_solve, 1, 100000,
                  "Time steps over which loads are averaged for each solve (Motion = quasi-static).");
  section.quantity("Pad thickness", platens.pad_thickness, "m", at_least(0),
                   "Of a sheet of another material that faces the specimen, part of the thickness of a "
                   "deformable platen; 0: none.");
  section.quantity("Pad modulus", platens.pad_modulus, "Pa", above(0), "Young modulus of that sheet.");
  section.number("Pad Poisson ratio", platens.pad_poisson_ratio, between_open(-1, 0.5),
                 "Poisson ratio of that sheet.");
  section.quantity("Pad density", platens.pad_density, "kg/m3", above(0), "Density of that sheet.");
  section.quantity("Mesh unit", platens.mesh_unit, "m", above(0), "Unit of length of the mesh files.");
  section.word<Attachment>("Attachment", platens.attachment,
                           {{"contact", Attachment::contact}, {"glued", Attachment::glued}},
                           "Glued: the end grains are held by the platens, in tension too.");
  declare_side(parameters, "Platens/Top", platens.top);
  Section top(parameters, "Platens/Top");
  top.word<PlatenControl>("Control", platens.top_control,
                          {{"motion", PlatenControl::motion}, {"stress", PlatenControl::stress}},
                          "What is prescribed on the top platen.");
  top.word<PlatenSeat>(
      "Seat", platens.top_seat, {{"fixed", PlatenSeat::fixed}, {"spherical", PlatenSeat::spherical}},
      "Spherical: the top platen turns freely about the middle of its face (Kind = deformable).");
  top.quantity("Stress", platens.top_stress, "Pa", at_least(0), "Pressing stress (Control = stress).");
  declare_side(parameters, "Platens/Bottom", platens.bottom);
}

void declare_sleeve(Parameters &parameters, Sleeve &sleeve) {
  Section section(parameters, "Sleeve");
  section.quantity("Thickness", sleeve.thickness, "m", above(0),
                   "Wall of the rubber sleeve (Confinement = sleeve).");
  section.quantity("Modulus", sleeve.modulus, "Pa", above(0), "Young modulus of the unstrained rubber.");
  section.number("Poisson ratio", sleeve.poisson_ratio, {0, 0.5, true, false},
                 "Poisson ratio of the unstrained rubber: the nearer to one half, the less the pressure "
                 "squeezes it and the shorter its steps.");
  section.quantity("Density", sleeve.density, "kg/m3", above(0), "Density of the rubber.");
  section.word<SleeveRims>("Rims", sleeve.rims,
                           {{"bonded", SleeveRims::bonded}, {"sliding", SleeveRims::sliding}},
                           "How the ends go with the platens: held on all sides, or along the axis alone.");
  section.integer("Elements around", sleeve.elements_around, 0, 10000,
                  "Finite elements around the sleeve, and along it as wide; 0: five mean radii wide. Faces "
                  "have to bridge the gaps between the spheres of the skin.");
  section.integer("Elements through", sleeve.elements_through, 1, 20, "The same through its wall.");
  section.number("Friction", sleeve.friction, between(0, 5), "Coefficient of friction of grains on it.");
  section.number("Stiffness", sleeve.stiffness, between(0, 1000),
                 "Penalty stiffness of grains on it, as a multiple of the mean bond's; 0: by the pressure, "
                 "which then presses a sphere in by some 4 % of its radius.");
  section.number("Seat depth", sleeve.seat_depth, between(0, 10),
                 "Grains whose surface lies no deeper, in mean radii, lie flush with it from the start.");
  section.number("Contact damping", sleeve.contact_damping, between(0, 1),
                 "Fraction of critical damping of grains on it.");
  section.number("Damping", sleeve.damping, at_least(0), "Rate at which its own velocities die away, 1/s.");
  section.number("Mass scaling", sleeve.mass_scaling, at_least(0),
                 "Factor on its mass, 1 or more; 0: such that it is stepped about once in eight steps.");
}

void declare_loading(Parameters &parameters, Loading &loading) {
  Section section(parameters, "Loading");
  section.word<LoadingTest>(
      "Test", loading.test,
      {{"compression", LoadingTest::compression},
       {"tension", LoadingTest::tension},
       {"hydrostatic", LoadingTest::hydrostatic},
       {"uniaxial strain", LoadingTest::uniaxial_strain},
       {"three point bending", LoadingTest::three_point_bending}},
      "The platens approach or part; hydrostatic: they and the lateral surface press alike, up to "
      "Confining pressure; uniaxial strain: they approach while a stiff frictionless wall "
      "holds the lateral surface; three point bending: strips approach, one above the middle of a bar "
      "along x, two below.");
  section.quantity("Axial rate", loading.axial_rate, "m/s", above(0),
                   "Speed of closure (tension: of opening).");
  section.number(
      "Wave crossings", loading.wave_crossings, above(0),
      "Sets the speed where Axial rate is not given: how often a wave crosses the specimen while it "
      "closes by 0.1 % (platen-compress; compression, uniaxial strain).");
  section.number("Hurry", loading.hurry, between(1, 100),
                 "How many times as fast the platens go while the specimen is elastic, before it fails and "
                 "where it is unloaded; 1: always at the speed of the test.");
  section.quantity("Ramp", loading.ramp, "s", at_least(0), "Time of the smooth start; 0: chosen by the app.");
  section.quantity(
      "Hold", loading.hold, "s", at_least(0),
      "How long the stress of Platens/Top/Control = stress is held after the ramp; with Confinement: "
      "how long its pressure stands on all sides before the platens move on.");
  section.number("Start strain", loading.start_strain, {0, 1, true, false},
                 "Closure over height that a static solve begins the run with, at rest; 0: from nothing.");
  section.number("Target strain", loading.target_strain, above_up_to(0, 1),
                 "Closure over height at which the run is over.");
  section.number("Stop at residual", loading.stop_at_residual, between(0, 0.99),
                 "Stress after the peak, as a fraction of it, at which the run is over; 0: never.");
  section.number(
      "Servo gain", loading.servo_gain, {0, 10},
      "Of the servo that holds the top platen at Platens/Top/Stress or, while a cell's pressure rises, at "
      "that pressure: 0.1 is slow, 10 quick; 0: chosen by the app (5; in a cell 10).");
  section.word<ConfinementKind>(
      "Confinement", loading.confinement,
      {{"none", ConfinementKind::none},
       {"particles", ConfinementKind::particles},
       {"sleeve", ConfinementKind::sleeve}},
      "How the lateral surface is pressed; particles: by forces on those of the surface; sleeve: by oil "
      "through rubber of finite elements.");
  section.quantity("Confining pressure", loading.confining_pressure, "Pa", at_least(0),
                   "Lateral pressure, and that on the platens while it rises.");
  section.quantity(
      "Confining ramp", loading.confining_ramp, "s", at_least(0),
      "Time in which the pressure rises smoothly; 0: chosen by the app, longer for a slow servo.");
  section.number("Pressure path", loading.pressure_path, {-0.5, 3},
                 "What the pressure gains per deviator of the axial stage: 0 holds it, -1/3 holds the mean "
                 "stress, positive values load proportionally.");
  section.number("Wall stiffness", loading.wall_stiffness, above_up_to(0, 1000),
                 "Of each sphere at the wall, as a multiple of the mean bond's (Test = uniaxial strain).");
  section.list("Unload at", loading.unload_at, "1", above_up_to(0, 1),
               "Closures over height, ascending, at which the platens turn round; empty: never.");
  section.number(
      "Unload to", loading.unload_to, between(0, 0.95),
      "Share of the axial stress at the turn (less a confining pressure) at which they load again.");
  section.word<ConfinementArea>(
      "Confinement area", loading.confinement_area,
      {{"voronoi", ConfinementArea::voronoi}, {"sphere", ConfinementArea::sphere}},
      "What the pressure acts on (Confinement = particles): each sphere's part of the deformed surface, or "
      "pi R^2 of each lateral sphere.");
}

} // namespace platen::apps
