"""What a page says before its pictures: a verdict in a sentence, what was tested, figures with what counts against them."""
import json
import math
from pathlib import Path
from typing import NamedTuple

from ..errors import InputError
from .house import digits
from .pages import Table
from .platens import friction_words
from .run import number_in, number_with_unit, scene_entries, unit_factor

# Figures of summary.json: words, keys (the worst of several: the largest, or the least where `least`), unit, its factor from SI,
# whether the ratio of two runs means anything. Always shown: those before the first None.
FIGURES = (
    ("strength", ("strength_pa",), "MPa", 1e-6, True), ("strain at peak, platens", ("strain_at_peak_platen",), "mm/m", 1e3, True),
    ("strain at peak, gauge", ("strain_at_peak_gauge",), "mm/m", 1e3, True),
    ("Young's modulus, gauge", ("youngs_modulus_gauge_pa",), "GPa", 1e-9, True),
    ("Young's modulus, platens", ("youngs_modulus_platen_pa",), "GPa", 1e-9, True), ("Poisson's ratio", ("poisson_ratio",), "", 1, True),
    ("bonds broken in tension", ("broken_tension",), "", 1, True), ("bonds broken in shear", ("broken_shear",), "", 1, True), None,
    ("stress at the end", ("stress_at_end_pa",), "MPa", 1e-6, True), ("deviator at the peak", ("deviator_strength_pa",), "MPa", 1e-6, True),
    ("bulk modulus", ("bulk_modulus_pa",), "GPa", 1e-9, True), ("constrained modulus", ("constrained_modulus_pa",), "GPa", 1e-9, True),
    ("tensile strength", ("tensile_strength_pa",), "MPa", 1e-6, True), ("flexural modulus", ("flexural_modulus_pa",), "GPa", 1e-9, True),
    ("load at failure", ("failure_load_n",), "kN", 1e-3, True), ("opening at peak", ("opening_at_peak_m",), "um", 1e6, True),
    ("deflection at peak", ("deflection_at_peak_m",), "um", 1e6, True),
    ("damage of the worse end", ("end_damage_top", "end_damage_bottom"), "", 1, True), ("damage of the middle", ("middle_damage",), "", 1, True),
    ("spread of the ends", ("end_spread",), "", 1, False), ("barrel at peak", ("barrel_at_peak",), "", 1, False),
    ("base of the worse end's cone, r0", ("dead_zone_top/base_ratio", "dead_zone_bottom/base_ratio"), "", 1, False),
    ("half-angle of the top cone", ("cone_top/half_angle_deg",), "degrees", 1, False),
    ("half-angle of the bottom cone", ("cone_bottom/half_angle_deg",), "degrees", 1, False),
    ("top cone at the end", ("final_cone_top/half_angle_deg",), "degrees", 1, False),
    ("bottom cone at the end", ("final_cone_bottom/half_angle_deg",), "degrees", 1, False),
    ("b-value before the peak", ("acoustic/b_before",), "", 1, False), ("b-value after the peak", ("acoustic/b_after",), "", 1, False))
LEAST = "base of the worse end's cone, r0"
WORDS = (("pattern", "pattern"), ("pattern at the end", "final_pattern"))
ENDINGS = (("_kg_m3", "kg/m3"), ("_pa", "Pa"), ("_m", "m"), ("_n", "N"), ("_s", "s"), ("_deg", "degrees"))
# Sections whose entries change nothing of the specimen and its test.
_ASIDE = ("Output/", "Checkpoint/", "Expect/", "Scene/Title")
# Main parameters of a bond law, as far as a scene has them.
_BOND = ("Modulus", "Stiffness ratio", "Tensile strength", "Shear strength", "Friction angle", "Moment contribution", "Fracture energy")


class Results(NamedTuple):
    """A folder of results: the name of the folder, its summary.json ({} where it is not there), entries of its scene.prm."""

    name: str
    folder: Path
    info: dict
    entries: dict
    friction: list
    mean_radius: float


def summary_of(folder):
    """summary.json, {} where it is not there. InputError where it is damaged."""
    path = Path(folder) / "summary.json"
    if path.exists() and not path.is_file():
        raise InputError(f"{path}: is no file")
    if not path.is_file():
        return {}
    try:
        read = json.loads(path.read_text(encoding="utf-8"))
    except (ValueError, RecursionError) as error:
        raise InputError(f"{path}: damaged: {error}") from None
    if not isinstance(read, dict):
        raise InputError(f"{path}: damaged: no object")
    return read


def results_in(folder):
    """Results of any program's folder."""
    folder = Path(folder)
    info = summary_of(folder)
    return Results(folder.resolve().name, folder, info, scene_entries(folder), [], number_in(info, "mean_radius_m"))


def results_of(run):
    """Results of a TestRun."""
    return Results(run.name, run.folder, run.info, run.entries, friction_words(run), run.mean_radius)


def words_of_key(key):
    """"energy_residual_relative" as words; that of FIGURES where it is one."""
    for figure in FIGURES:
        if figure and figure[1] == (key,):
            return figure[0]
    for ending, _ in ENDINGS:
        if key.endswith(ending):
            key = key[: -len(ending)]
            break
    return key.replace("_", " ").replace("/", ": ")


def _list(info, key):
    found = info.get(key)
    return [one for one in found if isinstance(one, (dict, str))] if isinstance(found, list) else []


def true_title(results):
    """The title of the scene, as long as no entry was overridden that changes the test."""
    title = results.entries.get("Scene/Title") or results.info.get("scene") or results.name
    over = [one.get("entry", "") for one in _list(results.info, "overridden") if isinstance(one, dict)]
    changed = [entry for entry in over if not entry.startswith(_ASIDE)]
    if not changed or "Scene/Title" in over:
        return title
    return f"{results.name}: {len(changed)} {'entry' if len(changed) == 1 else 'entries'} of its scene changed"


# ---- verdict
def _reasons(info, key):
    """Against a figure; [] where it is valid or nothing is said."""
    said = info.get("validity", {}).get(key) if isinstance(info.get("validity"), dict) else None
    return [str(one) for one in said] if isinstance(said, list) else []


def _expectations(all_results):
    return [(results, one) for results in all_results for one in _list(results.info, "expectations") if isinstance(one, dict)]


def _of_scene(all_results):
    """"9 of 9 figures that the scene expects are met"; "" where it expects none."""
    verdicts = [one.get("met") for _, one in _expectations(all_results)]
    if not verdicts:
        return ""
    met, missed, count = verdicts.count(True), verdicts.count(False), len(verdicts)
    figures = f"{count} figure" + ("s" if count > 1 else "")
    if met == count:
        return f"As expected: {figures} that the scene expects, all met."
    start = f"Not as expected: {missed} of {figures} that the scene expects not met" if missed else f"{met} of {figures} that the scene expects met"
    unchecked = count - met - missed
    return start + (f", {unchecked} not checked." if unchecked else ".")


def _of_strength(results):
    info, value = results.info, number_in(results.info, "strength_pa")
    if "strength_pa" not in info or "peak_reached" not in info:
        return ""
    against = _reasons(info, "strength_pa")
    if math.isnan(value):
        return "No strength: " + ("; ".join(against) if against else "not measured") + "."
    said = f"Strength {digits(value, 1e-6)} MPa"
    return f"{said}, not valid: {'; '.join(against)}." if against else f"{said}, valid."


def verdict(all_results):
    """Sentences: strength and its validity, whether what the scenes expect came, targets of a study that were not met."""
    missed = [target for results in all_results for target in _list(results.info, "targets_missed")]
    strengths = [(results.name + ": " if len(all_results) > 1 else "") + _of_strength(results) for results in all_results if _of_strength(results)]
    lines = [" ".join([*strengths, _of_scene(all_results)]).strip()]
    if missed:
        lines.insert(0, f"Not met: {len(missed)} target{'s' if len(missed) > 1 else ''}.")
    return [line for line in lines if line]


def _in_unit_of(one):
    """A found value in the unit of its range: "38.55 MPa"."""
    value, ends = one.get("value"), str(one.get("range", "")).split("...")
    if isinstance(value, str):
        return value
    if not isinstance(value, (int, float)) or isinstance(value, bool):
        return "-"
    for end in ends:
        unit = end.strip().partition(" ")[2].strip()
        if unit and unit_factor(unit) and not math.isnan(number_with_unit(end)):
            return f"{value / unit_factor(unit):.4g} {unit}"
    unit = next((unit for ending, unit in ENDINGS if str(one.get("entry", "")).endswith(ending)), "")
    return f"{value:.4g} {unit}".strip()


def table_of_expectations(all_results):
    """What is not met first; of a study's runs only what is not met. Doubts on the run stand above."""
    table = Table(["expected by the scene", "expected", "found", ""], [])
    for results in all_results:
        name = results.name + ": " if len(all_results) > 1 else ""
        status = results.info.get("status", "done")
        if status != "done":
            table.rows.append([name + "status", "done", status, "incomplete: figures are of what ran"])
        signs = [str(sign) for sign in _list(results.info, "signs_of_haste")]
        if signs:
            table.rows.append([name + "quasi-static", "yes", "no", "; ".join(signs)])
        table.rows.extend([name + "target", "-", "-", f"not met: {target}"] for target in _list(results.info, "targets_missed"))
    for wanted, words in ((False, "not met"), (None, "not checked"), (True, "met")):
        for results, one in _expectations(all_results):
            met = one.get("met") if isinstance(one.get("met"), bool) else None
            if met is not wanted or (met and "run" in one):
                continue
            name = f"{results.name}: " if len(all_results) > 1 else ""
            name += f"{one['run']}: " if one.get("run") else ""
            reason = one.get("reason") if one.get("value") is None else None
            table.rows.append([name + words_of_key(str(one.get("entry", "")).partition("/")[2]), str(one.get("range", "")), _in_unit_of(one),
                               f"{words}: {reason}" if reason else words])
    return table


# ---- what was tested
def _size(results):
    entry = lambda key: results.entries.get("Specimen/" + key) or ""  # noqa: E731
    shape = entry("Shape")
    if shape == "cylinder":
        return f"cylinder, radius {entry('Radius')}, height {entry('Height')}"
    if shape in ("box", "bar"):
        sides = [entry(key) for key in ("Width x", "Width y", "Height") if entry(key)]
        return f"{shape}, {' x '.join(sides)}"
    return shape


def _loading(results):
    entries, info = results.entries, results.info
    parts = [str(info.get("test") or "")]
    if entries.get("Loading/Axial rate"):
        parts.append(f"axial rate {entries['Loading/Axial rate']}")
    if entries.get("Loading/Confinement", "none") != "none":
        parts.append(f"{entries['Loading/Confinement']} at {entries.get('Loading/Confining pressure', '')}")
    if info.get("ended_by"):
        parts.append(f"ended by {info['ended_by']}")
    return ", ".join(part for part in parts if part)


def _bonds(results):
    law, entries = results.entries.get("Effects/Bond", ""), results.entries
    main = [f"{key.lower()} {entries['Bond/' + key]}" for key in _BOND if entries.get("Bond/" + key)]
    return ", ".join([law, *main]) if law else ""


def table_of_facts(all_results):
    """Specimen, platens, bonds, loading, overrides: a row where any of the results has something."""
    def packing(results):
        said = (("", results.entries.get("Specimen/Packing", "")), ("solid fraction ", digits(number_in(results.info, "packing_fraction"))),
                ("coordination ", digits(number_in(results.info, "coordination_number"))))
        return ", ".join(name + value for name, value in said if value not in ("", "-"))

    def over(results):
        return "; ".join(f"{one.get('entry')} = {one.get('value')} (scene file: {one.get('in_scene_file') or 'empty'})"
                         for one in _list(results.info, "overridden") if isinstance(one, dict))

    rows = (("specimen", _size), ("spheres", lambda r: digits(number_in(r.info, "particles"))), ("bonds", lambda r: digits(number_in(r.info, "bonds"))),
            ("mean radius (mm)", lambda r: digits(r.mean_radius, 1e3)), ("packing", packing), ("seed", lambda r: r.entries.get("Scene/Seed", "")),
            ("platens", lambda r: r.entries.get("Platens/Kind", "") if r.friction else ""), ("friction of the platens", lambda r: "; ".join(r.friction)),
            ("bond law", _bonds), ("loading", _loading), ("title in the scene file", lambda r: r.entries.get("Scene/Title", "") if over(r) else ""),
            ("scene file", lambda r: str(r.info.get("scene_file") or "")), ("overridden", over),
            ("program", lambda r: str(r.info.get("version") or "")))
    table = Table(["what was tested", *(r.name for r in all_results)], [])
    for title, words in rows:
        cells = [words(results) or "-" for results in all_results]
        if any(cell != "-" for cell in cells):
            table.rows.append([title, *cells])
    return table


def head(all_results):
    """(sentences, tables) that lead a page."""
    tables = [table_of_facts(all_results), table_of_expectations(all_results)]
    return verdict(all_results), [table for table in tables if table.rows]


# ---- figures
def _value(info, figure):
    values = [v for v in (number_in(info, key) for key in figure[1]) if math.isfinite(v)]
    return (min(values) if figure[0] == LEAST else max(values)) if values else math.nan


def table_of_figures(runs):
    """Figures of the runs; with several also the first over each other one, where a ratio means something."""
    table = Table(["figure", *(run.name for run in runs), *(f"{runs[0].name} / {run.name}" for run in runs[1:])], [])
    always = True
    for figure in FIGURES:
        if figure is None:
            always = False
            continue
        values = [_value(run.info, figure) for run in runs]
        if not (always or any(map(math.isfinite, values))):
            continue
        cells = [digits(value, figure[3]) for value in values]
        if figure[1] == ("strength_pa",):
            cells = [cell if run.peak_reached is not False else "no peak reached" if cell == "-" else f"{cell}, no peak reached"
                     for cell, run in zip(cells, runs)]
        ratios = [digits(values[0] / value) if figure[4] and value and math.isfinite(value) else "-" for value in values[1:]]
        table.rows.append([figure[0] + (f" ({figure[2]})" if figure[2] else ""), *cells, *ratios])
    for title, key in WORDS:
        cells = [str(run.info.get(key) or "-") for run in runs]
        if any(cell != "-" for cell in cells):
            table.rows.append([title, *cells, *("-" for _ in runs[1:])])
    return table


def table_of_validity(runs):
    """Only figures with a reason against them, in words; None where there is none."""
    keys = list(dict.fromkeys(key for run in runs for key in (run.info.get("validity") or {}) if _reasons(run.info, key)))
    if not keys:
        return None
    return Table(["figure that is not valid", *(run.name for run in runs)],
                 [[words_of_key(key), *("; ".join(_reasons(run.info, key)) or "valid" for run in runs)] for key in keys])


def head_of_runs(runs):
    """(sentences, tables) of a page of TestRuns: verdict, what was tested, figures, what is not valid."""
    all_results = [results_of(run) for run in runs]
    tables = [table_of_facts(all_results), table_of_figures(runs), table_of_validity(runs), table_of_expectations(all_results)]
    return verdict(all_results), [table for table in tables if table is not None and table.rows]


__all__ = ["Results", "head", "head_of_runs", "digits", "results_in", "results_of", "summary_of", "true_title", "words_of_key"]
