"""Which numbers of a summary.json the gallery shows, and how."""

import math
from typing import NamedTuple


class Column(NamedTuple):
    """A number of summary.json: its path, what it is divided by, unit and format in the table."""

    words: str
    key: str
    divisor: float = 1
    unit: str = ""
    form: str = "#.3g"


ELASTIC = [
    Column("E", "youngs_modulus_gauge_pa", 1e9, " GPa"),
    Column("Poisson's ratio", "poisson_ratio"),
]
OF_A_RUN = [
    Column("strength", "strength_pa", 1e6, " MPa"),
    Column("strain at peak", "strain_at_peak_platen", 1e-3, " mm/m"),
    Column("widening at peak", "opening_at_peak_m", 1e-6, " um"),
    Column("deflection at peak", "deflection_at_peak_m", 1e-6, " um"),
    *ELASTIC,
    Column("largest stress (no strength)", "largest_without_peak_pa", 1e6, " MPa"),
    Column("largest deviator", "deviator_strength_pa", 1e6, " MPa"),
    Column("load of tube and specimen", "largest_load_n", 1e3, " kN"),
    Column("of which on the tube", "tube_load_at_largest_n", 1e3, " kN"),
    Column("hoop stress of the tube", "tube_hoop_stress_at_largest_pa", 1e6, " MPa"),
    Column("mean hoop strain at the first tear", "hoop_strain_at_first_tear", 1e-2, " %"),
    Column("bulk modulus", "bulk_modulus_pa", 1e9, " GPa"),
    Column("constrained modulus", "constrained_modulus_pa", 1e9, " GPa"),
    Column("lateral over axial stress", "lateral_over_axial_stress"),
    Column("flexural modulus", "flexural_modulus_pa", 1e9, " GPa"),
    Column("mouth opening at peak", "cmod_at_peak_m", 1e-6, " um"),
    Column("fracture energy", "fracture_energy_j_m2", 1, " J/m2"),
    Column("lost in bonds", "bond_fracture_energy_j_m2", 1, " J/m2"),
    Column("cracks on the loaded diameter", "cracks_on_loaded_diameter", 1e-2, " %"),
    Column("cracks near mid-span", "cracks_near_midspan", 1e-2, " %"),
    Column("E of the interior", "bulk/youngs_modulus_pa", 1e9, " GPa"),
    Column("Poisson's ratio of the interior", "bulk/poisson_ratio"),
    Column("energy residual", "energy_residual_relative", 1, "", ".1e"),
]
LOADS = ("tension", "bending", "torsion", "impact")  # of platen-bar
OF_A_LOAD = [
    Column("of a bar", "load"),
    Column("error at rest", "static_error_effective", 1e-2, " %", ".2g"),
    Column("error swinging", "dynamic_error_effective", 1e-2, " %", ".2g"),
    Column("error of the wave's speed", "wave_error", 1e-2, " %", ".2g"),
]
OF_A_FAILURE = [
    Column("when", "when"),
    Column("pattern", "pattern"),
    Column("half-angle of the top cone", "cone_top/half_angle_deg", 1, " degrees", ".0f"),
    Column("half-angle of the bottom cone", "cone_bottom/half_angle_deg", 1, " degrees", ".0f"),
    Column("bonds broken at the top", "end_damage_top", 1e-2, " %", ".0f"),
    Column("broken in the middle", "middle_damage", 1e-2, " %", ".0f"),
    Column("broken at the bottom", "end_damage_bottom", 1e-2, " %", ".0f"),
]
OF_A_BOND = [
    Column("modulus", "modulus_pa", 1e9, " GPa"),
    Column("stiffness ratio", "stiffness_ratio"),
    Column("stiffness", "stiffness", 1e6, " MN/m", ".5g"),
    Column("strain ratio", "strain_ratio", 1, "", ".4f"),
    Column("breaks at", "break_load", 1, " N", ".4g"),
    Column("energy of fracture", "fracture_energy_j_m2", 1, " J/m2", ".4g"),
]
OF_A_CASE = [
    Column("case", "name"),
    Column("runs", "runs", 1, "", ".0f"),
    Column("strength", "strength_pa", 1e6, " MPa"),
    Column("strain at peak", "strain_at_peak_platen", 1e-3, " mm/m"),
    *ELASTIC,
    Column("energy residual", "energy_residual_relative", 1, "", ".1e"),
]
OF_A_CALIBRATION = [
    Column("modulus of bonds", "found/bond_modulus_pa", 1e9, " GPa"),
    Column("stiffness ratio", "found/stiffness_ratio"),
    Column("tensile strength", "found/bond_tensile_strength_pa", 1e6, " MPa"),
    Column("shear strength", "found/bond_shear_strength_pa", 1e6, " MPa"),
    Column("moment contribution", "found/moment_contribution"),
    Column("friction angle", "found/friction_angle_rad", math.pi / 180, " degrees"),
    Column("factor of compression limits", "found/compression_limits_factor"),
    Column("contact friction", "found/contact_friction"),
]
OF_UNSEEN_PACKINGS = [
    Column("E of unseen packings", "youngs_modulus_gauge_pa", 1e9, " GPa"),
    Column("Poisson's ratio", "poisson_ratio"),
    Column("compressive strength", "compressive_strength_pa", 1e6, " MPa"),
    Column("tensile strength", "tensile_strength_pa", 1e6, " MPa"),
    Column("triaxial strength", "triaxial_strength_pa", 1e6, " MPa"),
    Column("a second one", "triaxial_strength_pa_2", 1e6, " MPa"),
    Column("strain at peak", "strain_at_peak_platen", 1e-3, " mm/m"),
    Column("gain by friction", "gain_by_friction"),
]
OF_AN_ABACUS = [
    Column("modulus of beams", "bond_modulus_pa", 1e9, " GPa"),
    Column("radius multiplier", "radius_multiplier"),
    Column("Poisson's ratio of beams", "bond_poisson_ratio"),
    *ELASTIC,
]


def number(row, key):
    """A number, a word or a mean with deviation; None where it was not measured."""
    if key in row:
        return row[key]
    for part in key.split("/"):
        row = row.get(part) if isinstance(row, dict) else None
    return row


def cell(row, column):
    """Text of a number with its unit, of a mean with its deviation, of fewer than five packings their range; "-" where there is none."""
    value, scatter = number(row, column.key), None
    if isinstance(value, dict):
        count, low, high = value.get("runs", value.get("seeds", 0)), value.get("low"), value.get("high")
        if 1 < count < 5 and low is not None:
            return (f"{low / column.divisor:{column.form}} ... {high / column.divisor:{column.form}}{column.unit}, "
                    f"{count} packings")
        value, scatter = value.get("mean"), value.get("deviation") if count >= 5 else None
    if value is None or isinstance(value, str):
        return value or "-"
    text = f"{value / column.divisor:{column.form}}".rstrip(".")
    return text + (f" +- {scatter / column.divisor:.2g}" if scatter is not None else "") + column.unit


def table(rows, columns):
    """Markdown; columns that are empty in all rows are left out."""
    kept = [c for c in columns if any(cell(row, c) != "-" for row in rows)]
    lines = [[c.words for c in kept], ["---"] * len(kept)] + [[cell(row, c) for c in kept] for row in rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def slice_of(abacus):
    """Its rows of the middle modulus and Poisson's ratio: some of many."""
    fixed = ("bond_modulus_pa", "bond_poisson_ratio")
    values = [sorted({row[key] for row in abacus}) for key in fixed]
    middle = [v[len(v) // 2] for v in values]
    return [row for row in abacus if [row[key] for key in fixed] == middle]


def failure(summary):
    """How the specimen has failed, at two moments; no rows where it was not judged."""
    at_end = {key.removeprefix("final_"): value for key, value in summary.items() if key.startswith("final_")}
    rows = [{**summary, "when": "at 0.8 of the peak"}, {**at_end, "when": "at the end"}]
    return [row for row in rows if row.get("pattern")]


def target(found):
    """What the runs of an ordered accuracy say together."""
    factor, unit = (1e6, " MPa") if found["unit"] == "Pa" else (1, "")
    low, mean, high = (f"{found[key] / factor:.3g}{unit}" for key in ("low", "mean", "high"))
    return (f"| {found['figure']} | estimate | {100 * found['confidence']:.0f} % interval | ordered | came out |\n| --- | --- | --- | --- | --- |\n"
            f"| for slow loading | {mean} | {low} to {high} | +- {100 * found['accuracy']:g} % | +- {100 * found['half_interval']:.2g} % |")


def tables(summary):
    """Markdown tables of what the program has found."""
    app = summary["app"]
    if app == "platen-bonds":
        return [table(summary["runs"], OF_A_BOND)]
    if app == "platen-study":
        return [table(summary["cases"], OF_A_CASE)] + ([target(summary["target"])] if "target" in summary else [])
    if "abacus" in summary:
        return [table(slice_of(summary["abacus"]), OF_AN_ABACUS)]
    if app == "platen-calibrate":
        return [table([summary], OF_A_CALIBRATION), table([summary["verification"]], OF_UNSEEN_PACKINGS)]
    if summary.get("strength_pa") is None:
        summary = {**summary, "largest_without_peak_pa": summary.get("largest_stress_pa")}
    loads = [{"load": load, **summary[load]} for load in LOADS if load in summary]
    further = [(loads, OF_A_LOAD), (failure(summary), OF_A_FAILURE)]
    return [table([summary], OF_A_RUN)] + [table(rows, columns) for rows, columns in further if rows]
