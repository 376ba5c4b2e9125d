// The table of everything that a scene file may say. Defaults stand in scene.h, with the members.
#include "apps/scene/declare.h"

namespace platen::apps {
namespace {

constexpr double right_angle = 1.5707963267948966; // rad

void declare_general(Parameters &parameters, General &general) {
  Section section(parameters, "Scene");
  section.text("Title", general.title, "A line that names the scene in logs and reports.");
  section.integer(
      "Seed", general.seed, 0, 4294967295.0,
      "Start of the random numbers of packing and perturbations; the same seed gives the same result.");
  section.word<Quality>(
      "Quality", general.quality,
      {{"fast", Quality::fast}, {"standard", Quality::standard}, {"reference", Quality::reference}},
      {"fast", "reference"}, "A choice of accuracy against time for all that is left open.");
}

void declare_specimen(Parameters &parameters, SpecimenSection &specimen) {
  Section section(parameters, "Specimen");
  section.word<SpecimenShape>(
      "Shape", specimen.shape,
      {{"cylinder", SpecimenShape::cylinder},
       {"box", SpecimenShape::box},
       {"bar", SpecimenShape::bar},
       {"disc", SpecimenShape::disc}},
      {},
      "Shape of the specimen; its axis is z. A bar is round (Radius) or rectangular; a disc (Radius, Height) "
      "is laid on its rim by platen-brazilian. Test = three point bending bends a box that is long along x, "
      "or lays a rectangular bar down along x with its x up.");
  section.quantity("Radius", specimen.radius, "m", above(0), "Radius of a cylinder or round bar.");
  section.quantity("Height", specimen.height, "m", above(0), "Extent along z.");
  section.quantity("Width x", specimen.width_x, "m", above(0), "Width of a box or rectangular bar along x.");
  section.quantity("Width y", specimen.width_y, "m", above(0), "Width of a box or rectangular bar along y.");
  section.quantity("Sphere radius", specimen.sphere_radius, "m", above(0), "Mean radius of the spheres.");
  section.number("Radius spread", specimen.radius_spread, between(0, 1.5),
                 "Kappa, largest minus smallest radius over the mean (Radius distribution = uniform).");
  section.word<RadiusDistribution>("Radius distribution", specimen.radius_distribution,
                                   {{"equal", RadiusDistribution::equal},
                                    {"two sizes", RadiusDistribution::two_sizes},
                                    {"uniform", RadiusDistribution::uniform}},
                                   {}, "How radii are drawn; uniform with a spread of 0 is equal spheres.");
  section.number("Second radius ratio", specimen.second_radius_ratio, above_up_to(0, 1),
                 "Two sizes: smaller radius over the larger one.");
  section.number("Second fraction", specimen.second_fraction, between(0, 1),
                 "Two sizes: share of the number of spheres that has the smaller radius.");
  section.word<PackingKind>("Packing", specimen.packing,
                            {{"advancing front", PackingKind::advancing_front},
                             {"random close", PackingKind::random_close},
                             {"file", PackingKind::file}},
                            {}, "How the spheres are placed; file takes them from File.");
  section.file("File", specimen.file, "A specimen.csv to load (Packing = file).");
  section.word<EndsKind>(
      "Ends", specimen.ends, {{"as packed", EndsKind::as_packed}, {"ground", EndsKind::ground}}, {},
      "As packed: the platens meet spheres where they are. Ground: spheres of the end layer are "
      "seated flush, as if sawn.");
  section.number("End layer", specimen.end_layer, between(0.05, 10),
                 "Depth of the ground layer in mean sphere radii; it decides the strength below 1.");
  section.flag("Seat", specimen.seat, "Ground spheres resist rocking on the platen by their flat face.");
}

void declare_material(Parameters &parameters, Material &material) {
  Section section(parameters, "Material");
  section.quantity("Density", material.density, "kg/m3", above(0), "Density of the grains, or of the solid.");
  section.word<DensityOf>("Density of", material.density_of,
                          {{"grains", DensityOf::grains}, {"solid", DensityOf::solid}}, {},
                          "Solid: grains are heavier, so that the specimen with its voids has that density.");
  section.quantity("Young modulus", material.young_modulus, "Pa", above(0),
                   "Young modulus of the grains (hertz contact; bulk stiffness of linear contact).");
  section.number("Poisson ratio", material.poisson_ratio, between_open(-1, 0.5),
                 "Poisson ratio of the grains.");
}

void declare_effects(Parameters &parameters, Effects &effects) {
  Section section(parameters, "Effects");
  section.word<BondKind>("Bond", effects.bond,
                         {{"none", BondKind::none},
                          {"parallel bond", BondKind::parallel_bond},
                          {"cohesive beam", BondKind::cohesive_beam},
                          {"elasto damage plastic", BondKind::elasto_damage_plastic}},
                         {}, "What holds the grains together.");
  section.word<ContactKind>(
      "Contact", effects.contact,
      {{"none", ContactKind::none}, {"linear", ContactKind::linear}, {"hertz", ContactKind::hertz}}, {},
      "Normal force between grains that touch without a bond.");
  section.word<TangentialKind>(
      "Tangential", effects.tangential,
      {{"none", TangentialKind::none},
       {"coulomb", TangentialKind::coulomb},
       {"coulomb with rolling resistance", TangentialKind::coulomb_with_rolling_resistance}},
      {}, "Friction between grains that touch without a bond.");
  section.flag("Rotation", effects.rotation, "Grains turn; without it bonds and contacts carry no moments.");
  section.flag("Bond moments", effects.bond_moments,
               "Bonds resist bending and twisting; without it they carry forces alone (needs Rotation).");
  section.flag("Gravity", effects.gravity, "9.80665 m/s2 along -z.");
  section.flag("Energy ledger", effects.energy_ledger,
               "Energies and works in history.csv; without it their columns are nan.");
  section.flag("Crack log", effects.crack_log, "cracks.csv; without it broken bonds are counted alone.");
}

// Of Effects/Bond = elasto damage plastic alone.
void declare_interface(Section &section, Bond &bond) {
  section.number("Interaction range", bond.interaction_range, between(0, 1),
                 "Pairs whose distance differs from the sum of their radii by at most this share of it are "
                 "bonded (elasto damage plastic, instead of Gap).");
  section.number(
      "Area factor", bond.area_factor, between(0, 10),
      "Alpha, on the area of the bond; 0: 40 times porosity over mean number of bonds of a sphere.");
  section.number("Friction static", bond.friction_static, between(0, 5),
                 "Shear strength grows by this times the compression, while the bond holds (mu_1).");
  section.number("Friction dynamic", bond.friction_dynamic, between(0, 5),
                 "Coefficient of friction of a bond that has failed (mu_2).");
  section.number("Softening tension", bond.softening_tension, {1e-3, 1000, true, true},
                 "Opening from the strength to nothing, over that at the strength (delta_n).");
  section.number("Softening shear", bond.softening_shear, {1e-3, 1000, true, true},
                 "The same in shear (delta_s).");
  section.quantity("Fracture energy tension", bond.fracture_energy_tension, "J/m2", at_least(0),
                   "Area under the softening branch, for any size of spheres; 0: by Softening tension.");
  section.quantity("Fracture energy shear", bond.fracture_energy_shear, "J/m2", at_least(0),
                   "The same in shear.");
  section.list("Compression limits", bond.compression_limits, "Pa", above(0),
               "Up to three stresses, ascending, where the branches of compression begin (LCS); empty: "
               "elastic without limit.");
  section.list("Compression slopes", bond.compression_slopes, "1", at_least(1),
               "Modulus over that of each branch, not descending (YRC); as many as limits.");
  section.word<FailureLine>(
      "Failure line", bond.failure_line,
      {{"uncoupled", FailureLine::uncoupled}, {"coupled", FailureLine::coupled}}, {},
      "Coupled: tension takes from the shear strength, and shear from the tensile strength.");
}

void declare_bond(Parameters &parameters, Bond &bond) {
  Section section(parameters, "Bond");
  section.quantity("Modulus", bond.modulus, "Pa", above(0), "Young modulus of the bond.");
  section.number("Stiffness ratio", bond.stiffness_ratio, between(0, 5),
                 "Shear over normal stiffness, k_s / k_n (parallel bond).");
  section.number(
      "Poisson ratio", bond.poisson_ratio, between_open(-1, 0.5),
      "Of the bond: its shear modulus is Modulus / (2 (1 + nu)) (cohesive beam, elasto damage plastic).");
  section.quantity("Tensile strength", bond.tensile_strength, "Pa", at_least(0),
                   "0: never breaks in tension.");
  section.quantity("Shear strength", bond.shear_strength, "Pa", at_least(0),
                   "Cohesion of the bond; 0: never breaks in shear.");
  section.quantity("Friction angle", bond.friction_angle, "rad", {0, right_angle, true, false},
                   "Shear strength grows by its tangent times the compression of the bond.");
  section.number("Moment contribution", bond.moment_contribution, between(0, 1),
                 "Share of bending and twisting moment that counts towards failure.");
  section.number("Radius multiplier", bond.radius_multiplier, above_up_to(0, 10),
                 "Bond radius over the radius that the rule gives.");
  section.word<RadiusRule>("Radius rule", bond.radius_rule,
                           {{"minimum", RadiusRule::minimum},
                            {"mean", RadiusRule::mean},
                            {"harmonic", RadiusRule::harmonic},
                            {"given", RadiusRule::given}},
                           {}, "Bond radius from the radii of the pair; given: from Radius.");
  section.quantity("Radius", bond.radius, "m", above(0), "Bond radius (Radius rule = given).");
  section.gap(
      "Gap", bond.gap,
      "Pairs with at most this distance between their surfaces are bonded; R_min is the smaller radius.");
  section.number("Damping", bond.damping, between(0, 1),
                 "Dashpot of the bond, fraction of critical damping.");
  section.word<StrengthScatter>("Strength scatter", bond.strength_scatter,
                                {{"none", StrengthScatter::none}, {"weibull", StrengthScatter::weibull}}, {},
                                "Weibull: a random factor of mean 1 multiplies both strengths of each bond.");
  section.number("Weibull modulus", bond.weibull_modulus, between(0.5, 1000),
                 "Of the factors (Strength scatter = weibull): the larger, the less scatter.");
  declare_interface(section, bond);
}

void declare_phases(Parameters &parameters, PhasesSection &phases) {
  Section section(parameters, "Phases");
  section.word<PhasesBy>("By", phases.by,
                         {{"none", PhasesBy::none}, {"radius", PhasesBy::radius}, {"file", PhasesBy::file}},
                         {}, "What tells the spheres of the aggregate from those of the matrix.");
  section.quantity("Radius above", phases.radius_above, "m", above(0),
                   "Larger spheres are aggregate (By = radius).");
  section.file("File", phases.file, "Ids of the spheres that are aggregate, one a line (By = file).");
  const auto factor = [&](const char *key, double &value, const char *meaning) {
    section.number(key, value, {0, 1e3, false, true}, meaning);
  };
  factor("Aggregate modulus factor", phases.aggregate_modulus,
         "Modulus of bonds between two spheres of the aggregate, over Bond/Modulus.");
  factor("Aggregate strength factor", phases.aggregate_strength,
         "Both strengths of bonds between two spheres of the aggregate, over those of Bond.");
  factor("Interface modulus factor", phases.interface_modulus,
         "Modulus of bonds between a sphere of the aggregate and one of the matrix, over Bond/Modulus.");
  factor("Interface strength factor", phases.interface_strength,
         "Both strengths of bonds between aggregate and matrix, over those of Bond.");
}

void declare_contact(Parameters &parameters, Contact &contact) {
  Section section(parameters, "Contact");
  section.number("Friction", contact.friction, between(0, 5), "Coefficient of friction between grains.");
  section.stiffness(
      "Stiffness", contact.stiffness, true,
      "Normal stiffness of linear contact; \"bulk\" is a multiple of what the bulk modulus of the grains "
      "gives (NormK of LS-DYNA).");
  section.number("Tangential ratio", contact.tangential_ratio, between(0, 5),
                 "Tangential over normal stiffness of linear contact.");
  section.number("Damping", contact.damping, between(0, 1), "Linear contact: fraction of critical damping.");
  section.number("Restitution", contact.restitution, above_up_to(0, 1),
                 "Hertz contact: coefficient of restitution.");
  section.number("Rolling friction", contact.rolling_friction, between(0, 5),
                 "Largest rolling moment over normal force and effective radius.");
}

void declare_side(Parameters &parameters, const std::string &name, PlatenSide &side) {
  Section section(parameters, name);
  section.number("Friction static", side.friction_static, between(0, 5),
                 "As Platens/Friction static where not given.");
  section.number("Friction dynamic", side.friction_dynamic, between(0, 5),
                 "As Platens/Friction dynamic where not given.");
}

void declare_platens(Parameters &parameters, Platens &platens) {
  Section section(parameters, "Platens");
  section.word<PlatenKind>("Kind", platens.kind,
                           {{"rigid", PlatenKind::rigid}, {"deformable", PlatenKind::deformable}},
                           {"deformable"}, "Rigid bodies, or elastic ones by finite elements.");
  section.number("Friction static", platens.friction_static, between(0, 5),
                 "Coefficient of friction of grains on both platens while they stick.");
  section.number("Friction dynamic", platens.friction_dynamic, between(0, 5),
                 "The same while they slide; as the static one where not given.");
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
  section.word<Attachment>("Attachment", platens.attachment,
                           {{"contact", Attachment::contact}, {"glued", Attachment::glued}}, {},
                           "Glued: the end grains are held by the platens, in tension too.");
  declare_side(parameters, "Platens/Top", platens.top);
  Section top(parameters, "Platens/Top");
  top.word<PlatenControl>("Control", platens.top_control,
                          {{"motion", PlatenControl::motion}, {"stress", PlatenControl::stress}}, {},
                          "What is prescribed on the top platen.");
  top.quantity("Stress", platens.top_stress, "Pa", at_least(0), "Pressing stress (Control = stress).");
  declare_side(parameters, "Platens/Bottom", platens.bottom);
}

void declare_sleeve(Parameters &parameters, Sleeve &sleeve) {
  Section section(parameters, "Sleeve");
  section.quantity("Thickness", sleeve.thickness, "m", above(0),
                   "Wall of the sleeve (Confinement = sleeve).");
  section.quantity("Modulus", sleeve.modulus, "Pa", above(0), "Young modulus of the sleeve.");
  section.number("Poisson ratio", sleeve.poisson_ratio, between_open(-1, 0.5),
                 "Poisson ratio of the sleeve.");
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
      {},
      "The platens approach or part; hydrostatic: they and the lateral surface press alike, up to "
      "Confining pressure; uniaxial strain: they approach while a stiff frictionless wall "
      "holds the lateral surface; three point bending: strips approach, one above the middle of a bar "
      "along x, two below.");
  section.quantity("Axial rate", loading.axial_rate, "m/s", above(0),
                   "Speed of closure (tension: of opening).");
  section.quantity("Ramp", loading.ramp, "s", at_least(0), "Time of the smooth start; 0: chosen by the app.");
  section.quantity(
      "Hold", loading.hold, "s", at_least(0),
      "How long the stress of Platens/Top/Control = stress is held after the ramp; with Confinement: "
      "how long its pressure stands on all sides before the platens move on.");
  section.number("Target strain", loading.target_strain, above_up_to(0, 1),
                 "Closure over height at which the run is over.");
  section.number("Stop at residual", loading.stop_at_residual, between(0, 0.99),
                 "Stress after the peak, as a fraction of it, at which the run is over; 0: never.");
  section.word<ConfinementKind>(
      "Confinement", loading.confinement,
      {{"none", ConfinementKind::none},
       {"particles", ConfinementKind::particles},
       {"sleeve", ConfinementKind::sleeve}},
      {"sleeve"}, "How the lateral surface is pressed; particles: by forces on those of the surface.");
  section.quantity("Confining pressure", loading.confining_pressure, "Pa", at_least(0),
                   "Lateral pressure, and that on the platens while it rises.");
  section.quantity("Confining ramp", loading.confining_ramp, "s", at_least(0),
                   "Time in which the pressure rises smoothly; 0: chosen by the app.");
  section.number("Wall stiffness", loading.wall_stiffness, above_up_to(0, 1000),
                 "Of each sphere at the wall, as a multiple of the mean bond's (Test = uniaxial strain).");
  section.list("Unload at", loading.unload_at, "1", above_up_to(0, 1),
               "Closures over height, ascending, at which the platens turn round; empty: never.");
  section.number(
      "Unload to", loading.unload_to, between(0, 0.95),
      "Share of the axial stress at the turn (less a confining pressure) at which they load again.");
  section.word<ConfinementArea>(
      "Confinement area", loading.confinement_area,
      {{"voronoi", ConfinementArea::voronoi}, {"sphere", ConfinementArea::sphere}}, {},
      "What the pressure acts on (Confinement = particles): each sphere's part of the deformed surface, or "
      "pi R^2 of each lateral sphere.");
}

void declare_integration(Parameters &parameters, Integration &integration) {
  Section section(parameters, "Integration");
  section.word<Scheme>(
      "Scheme", integration.scheme,
      {{"velocity verlet", Scheme::velocity_verlet}, {"tchamwa wielgosz", Scheme::tchamwa_wielgosz}}, {},
      "Tchamwa Wielgosz takes energy from fast swings by the drift itself, for slow tests.");
  section.number(
      "Dissipation", integration.dissipation, between(1, 1.5),
      "phi of tchamwa wielgosz: a swing of frequency w is damped by (phi - 1) w dt / 2 of critical; "
      "1: none, which is velocity Verlet.");
  section.number("Safety", integration.safety, above_up_to(0, 1), "Time step over the stability limit.");
  section.number("Mass scaling", integration.mass_scaling, between(1, 1e6),
                 "Factor on all masses; the time step grows by its root, and inertia with it.");
  section.number("Damping", integration.damping, {0, 1, true, false},
                 "Local damping: force against the motion, as a fraction of the unbalanced force.");
  section.quantity("Time step", integration.time_step, "s", at_least(0),
                   "0: Safety times the limit; a larger one than the limit is refused.");
  section.word<InstructionSet>("Instruction set", integration.instruction_set,
                               {{"best", InstructionSet::best}, {"baseline", InstructionSet::baseline}}, {},
                               "Baseline repeats to the bit on every x86-64 processor.");
}

void declare_output(Parameters &parameters, Output &output, Checkpoint &checkpoint) {
  Section section(parameters, "Output");
  section.interval("Every", output.every,
                   "Rows of history.csv: steps or simulated time; 0: chosen by the app.");
  section.interval("Fields every", output.fields_every,
                   "Frames for ParaView: steps or simulated time; 0: chosen by the app.");
  section.flag("Fields", output.fields, "Write frames for ParaView.");
  Section checkpoints(parameters, "Checkpoint");
  checkpoints.interval("Every", checkpoint.every,
                       "Steps, or time of wall clock (\"10 min\"); 0: no checkpoints.");
}

struct ExpectedNumber {
  const char *key;  // of summary.json; a member of an object after "/"
  const char *unit; // of the number in summary.json
};

constexpr ExpectedNumber expected_numbers[] = {
    {"particles", "1"},
    {"bonds", "1"},
    {"coordination_number", "1"},
    {"packing_fraction", "1"},
    {"grain_density_kg_m3", "kg/m3"},
    {"steps", "1"},
    {"time_step_s", "s"},
    {"strength_pa", "Pa"},
    {"strain_at_peak_platen", "1"},
    {"strain_at_peak_gauge", "1"},
    {"youngs_modulus_gauge_pa", "Pa"},
    {"youngs_modulus_platen_pa", "Pa"},
    {"deviator_strength_pa", "Pa"},
    {"bulk_modulus_pa", "Pa"},
    {"constrained_modulus_pa", "Pa"},
    {"failure_load_n", "N"},
    {"cracks_on_loaded_diameter", "1"},
    {"first_cracks_in_middle_of_diameter", "1"},
    {"deflection_at_peak_m", "m"},
    {"flexural_modulus_pa", "Pa"},
    {"moment_over_nominal", "1"},
    {"cracks_near_midspan", "1"},
    {"lateral_over_axial_stress", "1"},
    {"poisson_ratio", "1"},
    {"broken_tension", "1"},
    {"broken_shear", "1"},
    {"energy_residual_relative", "1"},
    {"kinetic_to_internal_max", "1"},
    {"end_damage_top", "1"},
    {"end_damage_bottom", "1"},
    {"middle_damage", "1"},
    {"end_spread", "1"},
    {"barrel_at_peak", "1"},
    {"fragments", "1"},
    {"cone_top/height_m", "m"},
    {"cone_top/half_angle_deg", "degree"},
    {"cone_top/volume_fraction", "1"},
    {"cone_bottom/height_m", "m"},
    {"cone_bottom/half_angle_deg", "degree"},
    {"cone_bottom/volume_fraction", "1"},
    {"bulk/youngs_modulus_pa", "Pa"},
    {"bulk/poisson_ratio", "1"},
    {"effective_radius_m", "m"},
    {"density_kg_m3", "kg/m3"},
    {"tension/static_error", "1"},
    {"tension/dynamic_error", "1"},
    {"bending/static_error", "1"},
    {"bending/static_error_effective", "1"},
    {"bending/dynamic_error", "1"},
    {"bending/dynamic_error_effective", "1"},
    {"torsion/static_error", "1"},
    {"torsion/static_error_effective", "1"},
    {"torsion/dynamic_error", "1"},
    {"torsion/dynamic_error_effective", "1"},
    {"impact/wave_error", "1"},
};

void declare_expect(Parameters &parameters, std::vector<Expectation> &expect) {
  Section section(parameters, "Expect");
  for (const ExpectedNumber &number : expected_numbers)
    section.expectation(number.key, expect, number.unit,
                        "Range of the number in summary.json, one side may be left out; empty: not checked.");
}

void declare_pair_test(Parameters &parameters, PairTest &pair) {
  Section section(parameters, "Pair test");
  section.integer("Particles", pair.particles, 2, 3, "Two in a row, or three as a pyramid.");
  section.word<PairPath>("Path", pair.path,
                         {{"tension", PairPath::tension},
                          {"compression", PairPath::compression},
                          {"shear", PairPath::shear},
                          {"bending", PairPath::bending},
                          {"twisting", PairPath::twisting},
                          {"cyclic", PairPath::cyclic}},
                         {}, "How the upper particle is moved against the lower ones.");
  section.word<PairPlate>("Plate", pair.plate,
                          {{"frictionless", PairPlate::frictionless},
                           {"rolling", PairPlate::rolling},
                           {"sticking", PairPlate::sticking}},
                          {}, "Three particles: what the lower two stand on.");
  section.flag("Base bond", pair.base_bond, "Three particles: a bond between the lower two.");
  section.quantity("Force", pair.force, "N", above(0), "Largest force.");
  section.quantity("Displacement", pair.displacement, "m", above(0), "Largest displacement.");
  section.list("Modulus list", pair.moduli, "Pa", above(0), "Bond moduli to run; empty: Bond/Modulus.");
  section.list("Stiffness ratio list", pair.stiffness_ratios, "1", between(0, 5),
               "Stiffness ratios to run; empty: Bond/Stiffness ratio.");
  section.integer("Steps", pair.steps, 1, 1e9, "Steps of loading.");
}

void declare_calibrate(Parameters &parameters, Calibrate &c) {
  Section section(parameters, "Calibrate");
  section.word<CalibrateMode>(
      "Mode", c.mode,
      {{"bounds", CalibrateMode::bounds},
       {"abacus", CalibrateMode::abacus},
       {"search", CalibrateMode::search}},
      {}, "Estimates at once, a table of elastic moduli, or bonds for a wanted material.");
  section.quantity("Young modulus", c.young_modulus, "Pa", above(0),
                   "Wanted of the specimen's middle; may be left out.");
  section.number("Poisson ratio", c.poisson_ratio, between_open(-1, 0.5),
                 "Wanted of the specimen's middle; may be left out.");
  section.quantity("Compressive strength", c.compressive_strength, "Pa", above(0),
                   "Wanted between the platens of the scene; may be left out.");
  section.quantity("Tensile strength", c.tensile_strength, "Pa", above(0),
                   "Wanted between glued ends; may be left out.");
  section.integer("Seeds", c.seeds, 1, 1000, "Packings to calibrate on: Scene/Seed and those after it.");
  section.integer("Verification seeds", c.verification_seeds, 0, 1000,
                  "Packings after those, on which what was found is judged.");
  section.number("Strain", c.strain, above_up_to(0, 0.01), "Closure over height in the static solves.");
  section.quantity("Tension rate", c.tension_rate, "m/s", above(0),
                   "Speed of opening in tension tests; where not given, Loading/Axial rate times the wanted "
                   "tensile over compressive strength (a tenth where one is not wanted).");
  section.integer("Most trials", c.most_trials, 1, 1000, "Sets of strengths that are tried.");
  section.number("Tolerance", c.tolerance, above_up_to(0, 0.5),
                 "Relative difference of the strengths that ends the search.");
  section.list("Modulus list", c.moduli, "Pa", above(0), "Abacus; empty: Bond/Modulus.");
  section.list("Stiffness ratio list", c.stiffness_ratios, "1", between(0, 5),
               "Abacus; empty: Bond/Stiffness ratio (parallel bond).");
  section.list("Radius multiplier list", c.radius_multipliers, "1", above_up_to(0, 10),
               "Abacus; empty: Bond/Radius multiplier.");
  section.list("Poisson ratio list", c.poisson_ratios, "1", between_open(-1, 0.5),
               "Abacus; empty: Bond/Poisson ratio (cohesive beam).");
  section.number("Smallest stiffness ratio", c.ratio_low, above_up_to(0, 5),
                 "Search for Poisson's ratio (parallel bond).");
  section.number("Largest stiffness ratio", c.ratio_high, above_up_to(0, 5),
                 "Search for Poisson's ratio (parallel bond).");
  section.number("Smallest radius multiplier", c.multiplier_low, above_up_to(0, 10),
                 "Search for Poisson's ratio (cohesive beam).");
  section.number("Largest radius multiplier", c.multiplier_high, above_up_to(0, 10),
                 "Search for Poisson's ratio (cohesive beam).");
  section.number(
      "Smallest moment contribution", c.moments_low, between(0, 1),
      "Search for the ratio of the strengths, once shear over tensile strength is at its largest.");
  section.number("Smallest shear over tensile strength", c.strengths_low, above_up_to(0, 1000),
                 "Search for the ratio of the strengths.");
  section.number("Largest shear over tensile strength", c.strengths_high, above_up_to(0, 1000),
                 "Search for the ratio of the strengths.");
}

void declare_bar_test(Parameters &parameters, BarTest &bar) {
  Section section(parameters, "Bar test");
  section.word<BarLoad>("Load", bar.load,
                        {{"all", BarLoad::all},
                         {"tension", BarLoad::tension},
                         {"bending", BarLoad::bending},
                         {"torsion", BarLoad::torsion},
                         {"impact", BarLoad::impact},
                         {"none", BarLoad::none}},
                        {}, "What is done to a bar clamped at its lower end; none: its moduli alone.");
  section.word<BarMethod>(
      "Method", bar.method,
      {{"both", BarMethod::both}, {"static", BarMethod::at_rest}, {"dynamic", BarMethod::dynamic}}, {},
      "Static: the bar at rest under the load. Dynamic: it is let go from there and swings; an impact is "
      "dynamic.");
  section.word<BarSide>("Bent along", bar.side, {{"x", BarSide::x}, {"y", BarSide::y}}, {},
                        "The way in which bending pushes the free end.");
  section.number("Strain", bar.strain, above_up_to(0, 0.01),
                 "Size of the load: strain at the skin of the clamped end by strength of materials; impact: "
                 "speed of the struck end over that of the wave.");
  section.number("End depth", bar.end_depth, between(0.05, 10),
                 "Spheres whose surface is within this many mean radii of an end plane are clamped, loaded "
                 "or struck.");
  section.number("Periods", bar.periods, between(4, 1000), "Recorded of each oscillation.");
  section.flag("Bulk moduli", bar.bulk_moduli,
               "Measure the moduli of the interior too, under six strains of its skin.");
}

void declare_study(Parameters &parameters, Study &study) {
  Section section(parameters, "Study");
  section.integer("Seeds", study.seeds, 1, 1000, "Runs of each case: Scene/Seed and those after it.");
  section.list("Sphere radius list", study.sphere_radii, "m", above(0),
               "Study of size: mean radii, in place of Specimen/Sphere radius. With Domain list empty too: "
               "0.5, 0.75, 1 and 1.25 mm (Tannu 2017).");
  section.domains("Domain list", study.domains,
                  "Study of size: further cylinders, height x radius, at Specimen/Sphere radius.");
  section.gaps("Gap list", study.gaps, "Study of the packing, in place of Bond/Gap.");
  section.list("Radius multiplier list", study.radius_multipliers, "1", above_up_to(0, 10),
               "Study of the packing, in place of Bond/Radius multiplier; each with every gap and spread.");
  section.list("Radius spread list", study.radius_spreads, "1", between(0, 1.5),
               "Study of the packing, in place of Specimen/Radius spread.");
  section.list("Axial rate list", study.axial_rates, "m/s", above(0),
               "Study of the rate, in place of Loading/Axial rate.");
}

} // namespace

void declare_scene(Parameters &parameters, Scene &scene) {
  declare_general(parameters, scene.general);
  declare_specimen(parameters, scene.specimen);
  declare_material(parameters, scene.material);
  declare_effects(parameters, scene.effects);
  declare_bond(parameters, scene.bond);
  declare_phases(parameters, scene.phases);
  declare_contact(parameters, scene.contact);
  declare_platens(parameters, scene.platens);
  declare_sleeve(parameters, scene.sleeve);
  declare_loading(parameters, scene.loading);
  declare_integration(parameters, scene.integration);
  declare_output(parameters, scene.output, scene.checkpoint);
  declare_expect(parameters, scene.expect);
  declare_pair_test(parameters, scene.pair_test);
  declare_calibrate(parameters, scene.calibrate);
  declare_bar_test(parameters, scene.bar_test);
  declare_study(parameters, scene.study);
}

} // namespace platen::apps
