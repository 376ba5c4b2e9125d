"""Scenes of the gallery in the order of its page. What to see in each stands in docs/gallery.md, below its heading."""

from typing import NamedTuple


class Scene(NamedTuple):
    """One scene of scenes/."""

    name: str  # of scenes/NAME.prm
    program: str  # with the kind of a study
    picture: str = ""  # of platen-report, without .png; "" where it draws none
    cost: str = ""  # where a run takes more than ten minutes: it is not run unless it is named


COMPRESS, BRAZILIAN, BONDS, BAR = "platen-compress", "platen-brazilian", "platen-bonds", "platen-bar"
CALIBRATE, STUDY = "platen-calibrate", "platen-study"
GROUPS = [
    ("Concrete between platens", [
        Scene("demo_dry", COMPRESS, "cones"),
        Scene("demo_lubricated", COMPRESS, "outward_displacement"),
        Scene("facet_dry", COMPRESS, "cones"),
        Scene("facet_lubricated", COMPRESS, "outward_displacement"),
        Scene("concrete_dry", COMPRESS, "outward_displacement"),
        Scene("concrete_lubricated", COMPRESS, "outward_displacement"),
        Scene("cube_dry", COMPRESS, "outward_displacement"),
        Scene("cube_lubricated", COMPRESS, "outward_displacement"),
        Scene("prism_dry", COMPRESS, "fragments"),
        Scene("prism_lubricated", COMPRESS, "outward_displacement"),
        Scene("flat_dry", COMPRESS, "stress_strain"),
        Scene("standard_cylinder", COMPRESS, "outward_displacement"),
        Scene("standard_cube", COMPRESS, "outward_displacement"),
        Scene("brittle_concrete_dry", COMPRESS, "outward_displacement"),
    ]),
    ("Elastic platens and sleeves", [
        Scene("elastic_platens", COMPRESS, "stress_flow"),
        Scene("brush_platens", COMPRESS, "outward_displacement"),
        Scene("rubber_pads", COMPRESS, "stress_flow"),
        Scene("soft_platens", COMPRESS, "damage"),
        Scene("triaxial_concrete", COMPRESS, "stress_strain"),
        Scene("brittle_concrete_triaxial", COMPRESS, "stress_strain"),
        Scene("triaxial_cement", COMPRESS, "stress_strain"),
        Scene("filled_tube", COMPRESS, "sleeve"),
        Scene("greased_tube", COMPRESS, "tube"),
        Scene("wrapped", COMPRESS, "wrap"),
        Scene("hydrostatic_concrete", COMPRESS, "stress_strain"),
        Scene("uniaxial_strain_concrete", COMPRESS, "stress_strain"),
    ]),
    ("Stages and platens on all sides", [
        Scene("hold_concrete", COMPRESS, "stress_strain"),
        Scene("multistage_triaxial", COMPRESS, "stress_strain"),
        Scene("biaxial_steel", COMPRESS, "side_stresses"),
        Scene("biaxial_brush", COMPRESS, "side_stresses"),
        Scene("true_triaxial", COMPRESS, "side_stresses"),
        Scene("class_two_concrete", COMPRESS, "stress_strain"),
    ]),
    ("Tension, bending, Brazilian", [
        Scene("concrete_tension", COMPRESS, "damage"),
        Scene("bending_concrete", COMPRESS, "damage"),
        Scene("notched_beam", COMPRESS, "damage"),
        Scene("brazilian_concrete", BRAZILIAN, "crack_openings"),
    ]),
    ("Cement, concrete and shale of Oñate et al. 2015", [
        Scene("onate_cement", COMPRESS, "damage"),
        Scene("onate_cement_triaxial", COMPRESS, "damage"),
        Scene("onate_cement_uniaxial_strain", COMPRESS, "stress_strain"),
        Scene("onate_cement_brazilian", BRAZILIAN, "crack_times"),
        Scene("onate_concrete", COMPRESS, "damage"),
        Scene("onate_concrete_triaxial", COMPRESS, "damage"),
        Scene("onate_concrete_brazilian", BRAZILIAN, "crack_times"),
        Scene("onate_shale", COMPRESS, "damage"),
        Scene("onate_shale_brazilian", BRAZILIAN, "crack_times"),
    ]),
    ("Cylinders of Tannu 2017", [
        Scene("tannu_r1.25_ground", COMPRESS, "damage"),
        Scene("tannu_r1.00_ground", COMPRESS, "damage", "about a quarter of an hour on one core"),
        Scene("tannu_r0.75_ground", COMPRESS, "damage", "about half an hour on one core"),
        Scene("tannu_r0.50_ground", COMPRESS, "damage", "about three hours on one core"),
        Scene("tannu_r1.25", COMPRESS, "damage", "about half an hour on one core"),
        Scene("tannu_r1.00", COMPRESS, "damage", "about an hour on one core"),
        Scene("tannu_r0.75", COMPRESS, "damage", "about three hours on one core"),
        Scene("tannu_r0.50", COMPRESS, "damage", "about 18 hours on one core"),
    ]),
    ("Three laws", [
        Scene("three_laws_parallel_bond", COMPRESS, "damage"),
        Scene("three_laws_cohesive_beam", COMPRESS, "damage"),
        Scene("three_laws_elasto_damage_plastic", COMPRESS, "damage"),
    ]),
    ("Bonds and bars", [
        Scene("two_particles", BONDS),
        Scene("three_particles", BONDS),
        Scene("softening_bond", BONDS),
        Scene("yielding_bond", BONDS),
        Scene("bar_silica", BAR),
        Scene("silica_bulk", BAR),
    ]),
    ("Calibrations", [
        Scene("calibrate_concrete", CALIBRATE),
        Scene("calibrate_triaxial", CALIBRATE),
        Scene("calibrate_many", CALIBRATE),
        Scene("calibrate_c40", CALIBRATE, cost="half an hour on two cores"),
        Scene("calibrate_c70", CALIBRATE, cost="half an hour on two cores"),
        Scene("calibrate_granite", CALIBRATE, cost="about 15 minutes on two cores"),
        Scene("calibrate_marble", CALIBRATE, cost="about 15 minutes on two cores"),
        Scene("calibrate_sandstone", CALIBRATE, cost="about 15 minutes on two cores"),
        Scene("calibrate_mortar", CALIBRATE, cost="one minute on two cores"),
        Scene("calibrate_silica", CALIBRATE, cost="two minutes on two cores"),
        Scene("abacus_silica", CALIBRATE),
    ]),
    ("Studies", [
        Scene("study_friction_quick", f"{STUDY} friction", "strength_slenderness"),
        Scene("study_friction_concrete", f"{STUDY} friction", "strength_slenderness", "about two hours on one core"),
        Scene("study_laboratory_concrete", f"{STUDY} friction", "strength_friction", "about 20 minutes on one core"),
        Scene("study_laboratory_interfaces", f"{STUDY} friction", "strength_friction", "about half an hour on one core"),
        Scene("study_slenderness_concrete", f"{STUDY} slenderness", "strength_slenderness", "about 20 minutes on one core"),
        Scene("study_slenderness_interfaces", f"{STUDY} slenderness", "strength_slenderness", "about half an hour on one core"),
        Scene("study_cones_concrete", f"{STUDY} size", cost="about six hours on one core, most of it for 0.5 mm"),
        Scene("study_size_concrete", f"{STUDY} size"),
        Scene("study_size_tannu", f"{STUDY} size", cost="about eight hours on one core"),
        Scene("study_packing_concrete", f"{STUDY} packing"),
        Scene("study_rate_concrete", f"{STUDY} rate"),
        Scene("study_accuracy_concrete", f"{STUDY} accuracy", "accuracy"),
        Scene("study_quality_concrete", f"{STUDY} accuracy", "accuracy"),
        Scene("study_quality_cylinder", f"{STUDY} accuracy", "accuracy"),
        Scene("study_target_cylinder", f"{STUDY} target", "target"),
        Scene("study_target_gain", f"{STUDY} target", "target"),
    ]),
]
