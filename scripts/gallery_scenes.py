"""Scenes of the gallery in the order of its page, and what to see in each: all that is written by hand there."""

from typing import NamedTuple


class Scene(NamedTuple):
    """One scene of scenes/."""

    name: str  # of scenes/NAME.prm
    program: str  # with the kind of a study
    picture: str  # of platen-report, without .png; "" where it draws none
    see: str
    cost: str = ""  # where a run takes more than ten minutes: it is not run unless it is named


COMPRESS, BRAZILIAN, BONDS, BAR = "platen-compress", "platen-brazilian", "platen-bonds", "platen-bar"
CALIBRATE, STUDY = "platen-calibrate", "platen-study"
GROUPS = [
    ("Concrete between platens", [
        Scene("demo_dry", COMPRESS, "cones",
              "Friction restrains the ends: the part that does not move relative to each platen while the stress "
              "falls is a cone, and the material around and between the cones moves outwards. The lines are the "
              "fitted cones."),
        Scene("demo_lubricated", COMPRESS, "outward_displacement",
              "Nothing restrains the ends: one of them opens and moves outwards most at the platen, where the dry "
              "specimen does not move."),
        Scene("concrete_dry", COMPRESS, "outward_displacement",
              "The hourglass shape, with twice as many spheres as in the demo: two cones do not move, the surface of "
              "the middle is pushed outwards."),
        Scene("concrete_lubricated", COMPRESS, "outward_displacement",
              "The same spheres without friction at the platens: the strength is slightly lower, one end opens, and "
              "there are no cones."),
        Scene("cube_dry", COMPRESS, "outward_displacement",
              "A cube is so short that the effect of its restrained ends reaches through its middle: it carries "
              "two fifths more than the prism. Two blunt cones meet in its core, its sides spall."),
        Scene("cube_lubricated", COMPRESS, "outward_displacement",
              "Without friction the cube has the strength of the prism, and its sides open from platen to platen."),
        Scene("prism_dry", COMPRESS, "fragments",
              "In a prism the ends are far apart: the middle fails as if the platens were far away, and a piece is "
              "left on each end. The table has cones by displacement."),
        Scene("prism_lubricated", COMPRESS, "outward_displacement",
              "One end opens and splits, but the strength is nearly that between dry platens: in slender specimens "
              "the ends have little influence on the strength."),
        Scene("flat_dry", COMPRESS, "stress_strain",
              "Flat specimens fail as under confining pressure: nearly twice the strength of the slender cylinder, a "
              "peak because bonds yield, and a slow decrease of the stress."),
        Scene("standard_cylinder", COMPRESS, "outward_displacement",
              "The cylinder of the standards, concrete_dry three times as large with its spheres: the same stresses and "
              "the same hourglass, for it is spheres across the width that count."),
        Scene("standard_cube", COMPRESS, "outward_displacement",
              "The cube of the standards, of the spheres of the standard cylinder: a third stronger than it, as the "
              "small cube is."),
        Scene("brittle_concrete_dry", COMPRESS, "outward_displacement",
              "The cylinder with the brittle bonds of Platen's earlier concrete: the same strength and hourglass "
              "shape. Under pressure its strength increases too much, and flat specimens of it have no peak."),
    ]),
    ("Elastic platens and sleeves", [
        Scene("elastic_platens", COMPRESS, "stress_flow",
              "Stress in concrete and steel in one scale, near the peak: the steel spreads the load of the concrete "
              "and has the lowest stress beyond its edge."),
        Scene("brush_platens", COMPRESS, "outward_displacement",
              "Pins 10 mm wide carry the load like solid steel: the strength and the hourglass shape are those of "
              "demo_dry. But they bend sideways a little, and the damage of the ends is twice as large."),
        Scene("rubber_pads", COMPRESS, "stress_flow",
              "Sheets of hard rubber (the dark lines of the right picture: they carry almost no shear) are pressed "
              "out sideways and pull the ends with them: the upper end splits into columns, visible as streaks of "
              "stress, and the strength is lower by a fifth."),
        Scene("soft_platens", COMPRESS, "damage",
              "Polyethylene expands laterally more than concrete under the same stress and pulls the ends apart, "
              "where steel restrains them: both ends break (left), then the rest, at less than three quarters of the "
              "strength between steel."),
        Scene("triaxial_concrete", COMPRESS, "stress_strain",
              "In a rubber sleeve at 9 MPa: nearly twice the unconfined strength, at twice the strain, and a "
              "residual stress with plastic flow. The table counts strain from the time at which all sides carry 9 "
              "MPa."),
        Scene("brittle_concrete_triaxial", COMPRESS, "stress_strain",
              "Brittle bonds calibrated at 0 and 4.5 MPa only for this test: nearly twice the unconfined strength of "
              "36 MPa, and a residual stress with plastic flow. A third of the cracks are shear cracks."),
        Scene("triaxial_cement", COMPRESS, "stress_strain",
              "A cell at 3.4 MPa: a low peak, then flow, while more and more interfaces fail, most of them in shear. "
              "At the kink all sides carry this pressure and the platens begin to close; from there the table counts "
              "strain."),
        Scene("hydrostatic_concrete", COMPRESS, "stress_strain",
              "The same pressure on all sides: nearly straight lines and almost no crack. The bulk modulus agrees with E / "
              "(3 (1 - 2 nu))."),
        Scene("uniaxial_strain_concrete", COMPRESS, "stress_strain",
              "Restrained by a stiff wall it has no peak, and no strength. "
              "Unloading and reloading (the lines back) break almost no bond."),
    ]),
    ("Stages and platens on all sides", [
        Scene("hold_concrete", COMPRESS, "stress_strain",
              "In a cell at 4 MPa by stages: sheared, unloaded, loaded again, held at 30 MPa, then loaded to "
              "failure. Unloading and reloading follow one line, and while the stress is held nothing moves: no law "
              "here depends on time."),
        Scene("multistage_triaxial", COMPRESS, "stress_strain",
              "One specimen at 2, 5 and 10 MPa: near each peak it is unloaded and the pressure is increased. The "
              "slope of each loading is a little smaller than that of the one before, because bonds have broken."),
        Scene("biaxial_steel", COMPRESS, "side_stresses",
              "A square in plane stress: the platens at the sides carry half the stress of those at top and bottom "
              "during the whole test. It carries 1.8 times its uniaxial strength; between brushes "
              "laboratories find 1.16 times for equal stresses."),
        Scene("biaxial_brush", COMPRESS, "side_stresses",
              "The same square between brushes: steel pins that bend with the concrete. Its strength is an eighth "
              "lower than between dry steel, 1.8 times its strength along one axis; at equal stresses (`Lateral x = "
              "share of Axial 1`) it is 1.6 times that."),
        Scene("true_triaxial", COMPRESS, "side_stresses",
              "Six greased platens: 5 MPa on all sides, then the axial ones close while the others hold their stress "
              "by their servos against a cube that expands faster and faster."),
        Scene("class_two_concrete", COMPRESS, "stress_strain",
              "Controlled by the rate of its circumferential strain: after the peak the platens move apart again and "
              "again, and the strain decreases while the stress falls. Platens that only close cannot show this."),
    ]),
    ("Tension, bending, Brazilian", [
        Scene("concrete_tension", COMPRESS, "damage",
              "One flat crack across; compressive over tensile strength is 9.6, as in laboratories (8 to 12)."),
        Scene("bending_concrete", COMPRESS, "damage",
              "A single crack rises from the lower edge at mid-span. The nominal strength is above that in direct "
              "tension, as in small beams of laboratories."),
        Scene("brazilian_concrete", BRAZILIAN, "crack_times",
              "The first cracks lie along the loaded diameter, separate from each other; after the peak they join "
              "and split the disc."),
    ]),
    ("Cement, concrete and shale of Oñate et al. 2015", [
        Scene("onate_cement", COMPRESS, "damage",
              "Experiment 17 MPa (from the paper's shear strength, which is half of it), here 20. The lower half is crushed; above it almost nothing is broken."),
        Scene("onate_cement_triaxial", COMPRESS, "damage",
              "The same test as triaxial_cement, with the pressure on the spheres of the skin instead of a sleeve: "
              "the same strength. One zone is crushed, the rest remains intact."),
        Scene("onate_cement_uniaxial_strain", COMPRESS, "stress_strain",
              "Compaction with the radius held: the slope of the curve decreases where interfaces yield and is small "
              "where they fail, nearly all in shear. There is no peak, and no "
              "strength."),
        Scene("onate_cement_brazilian", BRAZILIAN, "crack_times",
              "Experiment 2.9 MPa, the paper's model 3.0. This weak cement is first crushed at the lower strip (left), "
              "then at the upper one, from where cracks run inwards (right)."),
        Scene("onate_concrete", COMPRESS, "damage",
              "Experiment 37 MPa; here 41, and E is 30 GPa where the interfaces have 28. Caps of intact spheres remain at both ends; failed interfaces "
              "still carry friction, so the specimen does not fall apart."),
        Scene("onate_concrete_triaxial", COMPRESS, "damage",
              "A cell of 9 MPa: nearly twice the strength of onate_concrete. Damage begins as a belt and spreads "
              "over the whole specimen except the upper end; nearly as many interfaces fail in shear as in tension."),
        Scene("onate_concrete_brazilian", BRAZILIAN, "crack_times",
              "Experiment 3 MPa; here half as much again. Cracks fill the loaded diameter before the peak, and split the disc after it."),
        Scene("onate_shale", COMPRESS, "damage",
              "Experiment 50 MPa, the paper's model 48. A thin layer at both ends stays intact, the surface of the "
              "middle fails first."),
        Scene("onate_shale_brazilian", BRAZILIAN, "crack_times",
              "Experiment 5.0 MPa, the paper's model 5.4. The same packing as the concrete, other interfaces: nearly "
              "the same cracks."),
    ]),
    ("Cylinders of Tannu 2017", [
        Scene("tannu_r1.25_ground", COMPRESS, "damage",
              "With ground ends the strength of this network is 150 MPa, three times the published value, and "
              "failure is sudden: a band two spheres thick fails, the ends remain intact, there are no cones "
              "([why](tannu_cylinder.md))."),
        Scene("tannu_r1.00_ground", COMPRESS, "damage",
              "As tannu_r1.25_ground with spheres of 1 mm.",
              "about a quarter of an hour on one core"),
        Scene("tannu_r0.75_ground", COMPRESS, "damage",
              "As tannu_r1.25_ground with spheres of 0.75 mm.",
              "about half an hour on one core"),
        Scene("tannu_r0.50_ground", COMPRESS, "damage",
              "As tannu_r1.25_ground with spheres of 0.5 mm, 160 110 of them.",
              "about three hours on one core"),
        Scene("tannu_r1.25", COMPRESS, "damage",
              "Ends as packed: the platens touch one protruding sphere after the other, and each is sheared off at 1 "
              "to 12 MPa ([more](tannu_cylinder.md)).",
              "about half an hour on one core"),
        Scene("tannu_r1.00", COMPRESS, "damage",
              "As tannu_r1.25 with spheres of 1 mm.",
              "about an hour on one core"),
        Scene("tannu_r0.75", COMPRESS, "damage",
              "As tannu_r1.25 with spheres of 0.75 mm.",
              "about three hours on one core"),
        Scene("tannu_r0.50", COMPRESS, "damage",
              "As tannu_r1.25 with spheres of 0.5 mm, 160 110 of them.",
              "about 18 hours on one core"),
    ]),
    ("Three laws", [
        Scene("three_laws_parallel_bond", COMPRESS, "damage",
              "One packing with three laws of equal E and tensile strength. Parallel bonds: the middle is destroyed, "
              "the ends are least damaged."),
        Scene("three_laws_cohesive_beam", COMPRESS, "damage",
              "All beams break in tension, at less than half the stress and strain of the other laws: a law for "
              "glass, not for concrete."),
        Scene("three_laws_elasto_damage_plastic", COMPRESS, "damage",
              "The strength with interfaces is that with parallel bonds, at a larger strain, because they yield "
              "before they break; the ends remain intact."),
    ]),
    ("Bonds and bars", [
        Scene("two_particles", BONDS, "",
              "One bond in tension, with the moduli of Tannu 2017 (tables 4 and 5): its stiffness compared with the "
              "closed form, and the load at which it would break."),
        Scene("three_particles", BONDS, "",
              "Two spheres on a plate, pressed apart by a third: lateral over vertical strain compared with the "
              "linear solution. It decreases as the shear stiffness of bonds increases, while the published one "
              "increases."),
        Scene("softening_bond", BONDS, "",
              "One elasto-damage-plastic bond on a prescribed path through its softening: load and energy compared "
              "with the closed form."),
        Scene("yielding_bond", BONDS, "",
              "One parallel bond that yields in compression, loaded, unloaded and loaded again: load and energy "
              "compared with the closed form."),
        Scene("bar_silica", BAR, "",
              "A bar of bonded spheres in tension, bending, torsion and impact: errors against strength of materials "
              "with the effective section of that bar. The energy residual is that of the impact; for the other "
              "tests it is below 0.001."),
        Scene("silica_bulk", BAR, "",
              "The inside of a dense packing under six prescribed uniform strains; published for this glass: 72.5 "
              "GPa and 0.17."),
    ]),
    ("Calibrations", [
        Scene("calibrate_concrete", CALIBRATE, "",
              "Targets: E 17 GPa, Poisson's ratio 0.15, 47.6 MPa in compression, 4 MPa in tension. The bond "
              "parameters found, and the results with five other packings."),
        Scene("calibrate_triaxial", CALIBRATE, "",
              "Targets: 36 MPa unconfined and 54.5 MPa in a cell of 4.5 MPa, E 27 GPa, Poisson's ratio 0.17. The "
              "friction angle of the bonds is the parameter for the pressure; five other packings verify the result."),
        Scene("calibrate_many", CALIBRATE, "",
              "Eight targets at once for one concrete, from bond parameters without any calibration: E 26 GPa, "
              "Poisson's ratio 0.2, 43 MPa at 2.4 mm/m, 4.5 MPa in tension, 62 and 83 MPa under 3 and 9 MPa, a gain "
              "of cubes by friction of 1.45. Coarse spheres; five other packings verify the result."),
        Scene("calibrate_c40", CALIBRATE, "",
              "Ready bonds, `materials/concrete_c40.prm`: the concrete of Imran and Pantazopoulou, 47.4 MPa unconfined, 119.8 and "
              "204.2 MPa under 17.2 and 43 MPa, with what platen friction adds in laboratories.", cost="half an hour on two cores"),
        Scene("calibrate_c70", CALIBRATE, "",
              "Ready bonds, `materials/concrete_c70.prm`: a concrete of class C70, 78 MPa unconfined, 118.7 and 167.5 MPa under 8 "
              "and 20 MPa, with what platen friction adds in laboratories.", cost="half an hour on two cores"),
        Scene("calibrate_granite", CALIBRATE, "",
              "Ready bonds, `materials/granite.prm`: Westerly granite, 256 MPa unconfined, 10 MPa in tension, 385 and 632 MPa under 13 and "
              "42 MPa.", cost="about 15 minutes on two cores"),
        Scene("calibrate_marble", CALIBRATE, "",
              "Ready bonds, `materials/marble.prm`: Carrara marble, 59.5 MPa unconfined, 130.2 and 189.8 MPa under 10 and 30 MPa.",
              cost="about 15 minutes on two cores"),
        Scene("calibrate_sandstone", CALIBRATE, "",
              "Ready bonds, `materials/sandstone.prm`: Berea sandstone, 77 MPa unconfined, 126 and 277 MPa under 10 and 50 MPa.",
              cost="about 15 minutes on two cores"),
        Scene("calibrate_mortar", CALIBRATE, "",
              "Ready bonds, `materials/mortar.prm`: a mortar of lime and volcanic ash, 13 MPa unconfined, 0.55 MPa in tension. No strength "
              "under pressure is known of it.", cost="one minute on two cores"),
        Scene("calibrate_silica", CALIBRATE, "",
              "Ready bonds, `materials/silica.prm`: E, Poisson's ratio and tension of fused silica. Its strength in compression "
              "is not calibrated.", cost="two minutes on two cores"),
        Scene("abacus_silica", CALIBRATE, "",
              "The effect of the radius of beams on the moduli of a glass: rows of abacus.csv with one modulus and "
              "one Poisson's ratio of the beams. Published at 0.71: 72.5 GPa and 0.17."),
    ]),
    ("Studies", [
        Scene("study_friction_quick", f"{STUDY} friction", "strength_slenderness",
              "How much of the strength is due to the platens: at height over width 1 dry steel gives three tenths more "
              "than grease, at 2 about a tenth. The diamonds are laboratory results. One packing."),
        Scene("study_friction_concrete", f"{STUDY} friction", "strength_slenderness",
              "The same on five packings, with finer spheres, more platens and slendernesses: 100 runs. Figures and "
              "a picture of them are in [bench/results/laboratory.md](../bench/results/laboratory.md).",
              "about two hours on one core"),
        Scene("study_laboratory_concrete", f"{STUDY} friction", "strength_friction",
              "Cubes and prisms as tested in a laboratory in 1967, five packings of each: gains by dry platens of "
              "1.44 and 1.06 (measured then: 1.42 and 1.08).",
              "about 20 minutes on one core"),
        Scene("study_laboratory_interfaces", f"{STUDY} friction", "strength_friction",
              "The same with elasto-damage-plastic interfaces: the gain of cubes is 1.43, of prisms 1.14, more than "
              "in the laboratory.",
              "about half an hour on one core"),
        Scene("study_slenderness_concrete", f"{STUDY} slenderness", "strength_slenderness",
              "Short cores between dry steel compared with the factors of ASTM C42 (black diamonds), five packings "
              "of each: equal to them from 1.75 on, increasingly above them for shorter cores.",
              "about 20 minutes on one core"),
        Scene("study_slenderness_interfaces", f"{STUDY} slenderness", "strength_slenderness",
              "The same with elasto-damage-plastic interfaces, equal to the factors at all heights; packings scatter "
              "more.",
              "about half an hour on one core"),
        Scene("study_cones_concrete", f"{STUDY} size", "",
              "Four sphere radii of the thesis on concrete between dry steel: are cones sharper with smaller spheres?",
              "about six hours on one core, most of it for 0.5 mm"),
        Scene("study_size_concrete", f"{STUDY} size", "",
              "Spheres from 6 to 12.5 across the diameter: coarse spheres pack looser and the specimen is softer; "
              "the strengths differ by less than the scatter."),
        Scene("study_size_tannu", f"{STUDY} size", "",
              "The four sphere radii and three cylinders of Tannu 2017, ends ground.",
              "about eight hours on one core"),
        Scene("study_packing_concrete", f"{STUDY} packing", "",
              "A wider gap bonds more neighbours, a thicker bond has a larger section: both make the specimen stiffer "
              "and stronger."),
        Scene("study_rate_concrete", f"{STUDY} rate", "",
              "From four times the speed of study_size_concrete down to half of it, the strength stays within the "
              "scatter."),
        Scene("study_accuracy_concrete", f"{STUDY} accuracy", "accuracy",
              "What accuracy costs: error against the finest run over seconds, one line per parameter. Step and "
              "speed have no effect above the scatter of the seeds (grey) and the chaotic scatter of the strength, 2 "
              "%; a hundredfold mass, coarse spheres and missing physical effects do."),
        Scene("study_quality_concrete", f"{STUDY} accuracy", "accuracy",
              "The words of Scene/Quality and the speed in wave crossings: fast needs a ninth of the steps of "
              "reference, with no visible error of the strength and one percent of the modulus."),
        Scene("study_quality_cylinder", f"{STUDY} accuracy", "accuracy",
              "The same for a cylinder of seven times as many spheres, where chaotic scatter is smaller and the rate "
              "effect is visible: half the speed, half the error. A rate multiplier in the elastic stage causes no "
              "error."),
        Scene("study_target_cylinder", f"{STUDY} target", "target",
              "Accuracy on order: the strength for slow loading within 2 %, by the cheapest runs at several speeds; "
              "the interval becomes narrower with each batch."),
        Scene("study_target_gain", f"{STUDY} target", "target",
              "The gain of a cube by platen friction within 3 %, both platens on the same packings."),
    ]),
]
