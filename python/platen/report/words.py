"""What a page says before its pictures: a verdict in a sentence, what was tested, figures with what counts against them."""
import math
import re
from pathlib import Path
from typing import NamedTuple

from .house import digits
from .pages import Table
from .platens import friction_words
from .run import TestRun, listed, number_in, number_with_unit, unit_factor

_FACTOR = {"": 1, "degrees": 1, "MPa": 1e-6, "GPa": 1e-9, "kN": 1e-3, "um": 1e6, "mm/m": 1e3, "J/m2": 1}
# Figures of summary.json: unit, keys (the worst of several: the largest, or the least where LEAST). Those that are always shown,
# those that some tests have, and those whose ratio of two runs means nothing.
ALWAYS = {
    "strength": ("MPa", "strength_pa"), "strain at peak, platens": ("mm/m", "strain_at_peak_platen"),
    "strain at peak, gauge": ("mm/m", "strain_at_peak_gauge"), "Young's modulus, gauge": ("GPa", "youngs_modulus_gauge_pa"),
    "Young's modulus, platens": ("GPa", "youngs_modulus_platen_pa"), "Poisson's ratio": ("", "poisson_ratio"),
    "bonds broken in tension": ("", "broken_tension"), "bonds broken in shear": ("", "broken_shear")}
GIVEN = {
    "deviator at the peak": ("MPa", "deviator_strength_pa"),
    "bulk modulus": ("GPa", "bulk_modulus_pa"), "constrained modulus": ("GPa", "constrained_modulus_pa"),
    "tensile strength": ("MPa", "tensile_strength_pa"), "flexural modulus": ("GPa", "flexural_modulus_pa"),
    "load at failure": ("kN", "failure_load_n"), "opening at peak": ("um", "opening_at_peak_m"),
    "deflection at peak": ("um", "deflection_at_peak_m"), "strength of the ligament": ("MPa", "net_strength_pa"),
    "mouth opening at peak": ("um", "cmod_at_peak_m"), "fracture energy": ("J/m2", "fracture_energy_j_m2"),
    "fracture energy of the bonds": ("J/m2", "bond_fracture_energy_j_m2"), "damage of the worse end": ("", "end_damage_top", "end_damage_bottom"),
    "damage of the middle": ("", "middle_damage")}
ALONE = {
    "stress at the end": ("MPa", "stress_at_end_pa"), "spread of the ends": ("", "end_spread"), "barrel at peak": ("", "barrel_at_peak"),
    "base of the worse end's cone, r0": ("", "dead_zone_top/base_ratio", "dead_zone_bottom/base_ratio"),
    "half-angle of the top cone": ("degrees", "cone_top/half_angle_deg"),
    "half-angle of the bottom cone": ("degrees", "cone_bottom/half_angle_deg"),
    "top cone at the end": ("degrees", "final_cone_top/half_angle_deg"),
    "bottom cone at the end": ("degrees", "final_cone_bottom/half_angle_deg"),
    "b-value before the peak": ("", "acoustic/b_before"), "b-value after the peak": ("", "acoustic/b_after")}
FIGURES = {**ALWAYS, **GIVEN, **ALONE}
LEAST = "base of the worse end's cone, r0"
# Of cylinders and boxes that are compressed: a disc and a bent bar have no such ends. Their note.
OF_ENDS = ("damage of the worse end", "damage of the middle", "spread of the ends", "barrel at peak", LEAST)
ENDS = ("Damage: share of the broken bonds, of an end and of the middle; spread: opening of the skin near the ends over its largest; r0: radius "
        "of a cone's base over that of the specimen; all three where the stress has fallen to 0.8 of its peak. Barrel: opening of the skin at "
        "the ends over that of the middle, at the peak.")
ENDINGS = (("_kg_m3", "kg/m3"), ("_j_m2", "J/m2"), ("_pa", "Pa"), ("_m", "m"), ("_n", "N"), ("_s", "s"), ("_deg", "degrees"))
# Sections whose entries change nothing of the specimen and its test.
_ASIDE = ("Output/", "Checkpoint/", "Expect/", "Scene/Title", "Scene/Standard")
# Main parameters of a bond law, as far as a scene has them.
_BOND = ("Modulus", "Stiffness ratio", "Tensile strength", "Shear strength", "Friction angle", "Moment contribution", "Fracture energy",
         "Compression limits", "Compression slopes")
# What tells deformable platens apart.
_PLATENS = ("Thickness", "Young modulus", "Pad thickness", "Pad modulus", "Layer materials", "Mesh file", "Top/Mesh file")
# How a test ended, as a laboratory says it.
_ENDED = {"stop at residual": "the stress fell to the residual", "target": "the target was reached"}
FEW = 5  # packings: of fewer a standard deviation says little, their range is given


# ---- figures over packings
class Spread(NamedTuple):
    """A figure over packings, in one unit: mean, ends of its bar, how many packings gave it."""

    mean: float = math.nan
    low: float = math.nan
    high: float = math.nan
    packings: int = 0

    def words(self, digits, packings=None):
        """"41.0 +- 0.9", of fewer than five packings "40.1 ... 41.9"; how many they are where they are not `packings`. digits: as
        in ".1f"."""
        if math.isnan(self.mean):
            return "-"
        text = f"{self.mean:{digits}}"
        if self.packings >= FEW:
            text += f" +- {self.high - self.mean:{digits[-3:] if digits[-1] == 'f' else '.2g'}}"
        elif self.high > self.low:
            text = f"{self.low:{digits}} ... {self.high:{digits}}"
        return text if packings in (None, self.packings) else f"{text} ({self.packings})"


def over_packings(said, factor=1.0):
    """The Spread of {"mean", "deviation", "low", "high", "runs"} of a study, or with "seeds" of a calibration."""
    mean, deviation, low, high = (number_in(said, key) * factor for key in ("mean", "deviation", "low", "high"))
    packings = int(said["runs"] if "runs" in said else said["seeds"])
    if packings >= FEW:
        low, high = mean - deviation, mean + deviation
    return Spread(mean, low if low <= mean else mean, high if high >= mean else mean, packings)


def with_unit(name, unit):
    """"strength (MPa)"."""
    return f"{name} ({unit})" if unit else name


def words_of_key(key):
    """"energy_residual_relative" as words; that of FIGURES where it is one."""
    for name, (_, *keys) in FIGURES.items():
        if keys == [key]:
            return name
    ending = next((ending for ending, _ in ENDINGS if key.endswith(ending)), "")
    return key.removesuffix(ending).replace("_", " ").replace("/", ": ")


# ---- verdict
def true_title(results):
    """The title of the scene, as long as no entry was overridden that changes the test."""
    over = [one.get("entry", "") for one in listed(results.info, "overridden")]
    changed = [entry for entry in over if not entry.startswith(_ASIDE)]
    if changed and "Scene/Title" not in over:
        return f"{results.name}: {len(changed)} {'entry' if len(changed) == 1 else 'entries'} of its scene changed"
    return results.entry("Scene/Title") or results.info.get("scene") or results.name


def _reasons(info, key):
    """Against a figure; [] where it is valid or nothing is said."""
    return [str(one) for one in listed(info.get("validity"), key, object)]


def _of_strength(results):
    info, value, against = results.info, number_in(results.info, "strength_pa"), "; ".join(_reasons(results.info, "strength_pa"))
    if "strength_pa" not in info or "peak_reached" not in info:
        return ""
    if math.isnan(value):
        return f"No strength: {against or 'not measured'}."
    return f"Strength {digits(value, 1e-6)} MPa, " + (f"not valid: {against}." if against else "valid.")


def _name(results, all_results):
    return f"{results.name}: " if len(all_results) > 1 else ""


def _of_the_run(results):
    """What makes all figures of a run doubtful."""
    ended, signs = results.info.get("status", "done") == "done", "; ".join(map(str, listed(results.info, "signs_of_haste", (dict, str))))
    return ([] if ended else ["The run has not ended: its figures are of the part that ran."]) + ([f"Not quasi-static: {signs}."] if signs else [])


def verdict(all_results):
    """Sentences: targets, what makes all figures doubtful, strength and its validity, whether what the scenes expect came."""
    missed = sum(len(listed(results.info, "targets_missed", str)) for results in all_results)
    targets = [one.get("met", one.get("met_in_training")) for results in all_results for one in listed(results.info, "targets")]
    unseen = all("met" in one for results in all_results for one in listed(results.info, "targets"))
    said = [_name(results, all_results) + text for results in all_results for text in (*_of_the_run(results), _of_strength(results)) if text]
    judged = [one for results in all_results for one in listed(results.info, "expectations")]
    met, lost = ([one for one in judged if one.get("met") is how] for how in (True, False))
    count = len(judged)
    figures, unchecked = f"{count} figure{'s' if count > 1 else ''} that the scene expects", count - len(met) - len(lost)
    if len(met) == count > 0:
        said.append(f"As expected: {figures}, all met.")
    elif count:
        names = ", ".join(dict.fromkeys(_name_of_expected(one) for one in lost))
        start = f"Not as expected: {len(lost)} of {figures} not met ({names})" if lost else f"{len(met)} of {figures} met"
        said.append(start + (f", {unchecked} not checked." if unchecked else "."))
    first = [f"Not met: {missed} target{'s' if missed > 1 else ''}."] if missed else []
    if targets and not missed and all(targets):
        first = [f"All {len(targets)} targets met on {'unseen packings' if unseen else 'the packings calibrated on, and not judged on others'}."]
    return first + ([" ".join(said)] if said else [])


def _name_of_expected(one):
    return words_of_key(str(one.get("entry", "")).partition("/")[2])


def _in_unit_of(one):
    """A range and what was found, in the unit of the range: "38 MPa ... 40 MPa", "38.55 MPa"; strains in mm/m."""
    value, wanted, entry = one.get("value"), str(one.get("range", "")), str(one.get("entry", ""))
    ends = [end for end in wanted.split("...") if not math.isnan(number_with_unit(end))]
    units = [end.strip().partition(" ")[2].strip() for end in ends] + [unit for ending, unit in ENDINGS if entry.endswith(ending)]
    unit = next(filter(None, units), "")
    if re.search(r"strain(?!_ratio)", entry) and not unit:
        unit, wanted = "mm/m", re.sub(r"[-+]?\d*\.?\d+(?:[eE][-+]?\d+)?", lambda one: f"{1e3 * float(one[0]):.4g} mm/m", wanted)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return wanted, value if isinstance(value, str) else "-"
    return wanted, f"{value / (1e-3 if unit == 'mm/m' else unit_factor(unit) or 1):.4g} {unit}".strip()


def table_of_expectations(all_results):
    """What is not met first; of a study's runs only what is not met. Doubts on the run stand above."""
    doubts, judged = [], {"not met": [], "not checked": [], "met": []}
    for results in all_results:
        name, info, status = _name(results, all_results), results.info, results.info.get("status", "done")
        signs = "; ".join(map(str, listed(info, "signs_of_haste", (dict, str))))
        doubts += [[name + "status", "done", status, "incomplete: figures are of the part that ran"]] if status != "done" else []
        doubts += [[name + "quasi-static", "yes", "no", signs]] if signs else []
        doubts += [[name + "target", "-", "-", f"not met: {target}"] for target in listed(info, "targets_missed", str)]
        for one in listed(info, "expectations"):
            words = "met" if one.get("met") is True else "not met" if one.get("met") is False else "not checked"
            run, reason = one.get("run"), one.get("reason") if one.get("value") is None else None
            if not (words == "met" and "run" in one):
                judged[words].append([name + (f"{run}: " if run else "") + _name_of_expected(one),
                                      *_in_unit_of(one), f"{words}: {reason}" if reason else words])
    return Table(["expected by the scene", "expected", "found", ""], [*doubts, *(row for rows in judged.values() for row in rows)])


# ---- what was tested
def _facts(results):
    """Specimen, platens, bonds, loading, overrides in words, by title; "" and "-" where a folder does not say it."""
    entry, info = results.entry, results.info
    number = lambda key: digits(number_in(info, key))  # noqa: E731
    shape, over, app = entry("Specimen/Shape"), listed(info, "overridden"), info.get("app")
    varied = " ".join(map(str, listed(info, "varied", str))) + str(info.get("kind", ""))  # of a study: not the same in all cases
    sizes = [f"{word} {entry('Specimen/' + key)}" for key, word in (
        ("Radius", "radius"), ("Width x", "width"), ("Width y", "depth"), ("Height", "thickness" if shape == "disc" else "height"))
        if entry("Specimen/" + key) and not (word == "height" and re.search("height|slenderness|friction|size", varied))]
    shape = "" if app == "platen-bonds" else ", ".join([shape, *sizes])
    packing = (("", entry("Specimen/Packing") if shape else ""), ("solid fraction ", number("packing_fraction")),
               ("coordination ", number("coordination_number")))
    law, friction = entry("Effects/Bond"), friction_words(results) if isinstance(results, TestRun) else []
    bond = [law, *(f"{key.lower()} {entry('Bond/' + key)}" for key in _BOND if entry("Bond/" + key))] if law else []
    kind = [entry("Platens/Kind")] if friction else []
    kind += [f"{key.rpartition('/')[2].lower()} {Path(entry('Platens/' + key)).name}" for key in _PLATENS
             if "deformable" in kind and entry("Platens/" + key) not in ("", "0")]
    rate, beside, ended = entry("Loading/Axial rate"), entry("Loading/Confinement").replace("none", ""), str(info.get("ended_by") or "")
    stages, pressure = len(listed(info, "stages")), number_with_unit(entry("Loading/Confining pressure"))
    test = "splitting" if app == "platen-brazilian" else info.get("test")
    loading = [test, rate and f"axial rate {rate}", beside and beside + (f" at {entry('Loading/Confining pressure')}" if pressure > 0 else ""),
               f"{stages} stages" if stages else "", ended and f"ended: {_ENDED.get(ended, ended)}"]
    entries = "; ".join(f"{one.get('entry')} = {one.get('value')} (scene file: {one.get('in_scene_file') or 'empty'})" for one in over)
    return {"specimen": shape, "spheres": number("particles"), "bonds": number("bonds"),
            "mean radius (mm)": digits(results.mean_radius, 1e3),
            "packing": ", ".join(name + value for name, value in packing if value not in ("", "-")), "seed": entry("Scene/Seed"),
            "platens": ", ".join(kind), "friction of the platens": "; ".join(friction),
            ("bonds to start from" if app == "platen-calibrate" else "bond law"): ", ".join(bond), "loading": ", ".join(str(part) for part in loading if part),
            "title in the scene file": entry("Scene/Title") if over else "", "scene file": str(info.get("scene_file") or ""),
            "overridden": entries, "program": str(info.get("version") or "")}


def table_of_facts(all_results):
    """Specimen, platens, bonds, loading, overrides: a row where any of the results has something."""
    facts = [_facts(results) for results in all_results]
    rows = [[title, *(of[title] or "-" for of in facts)] for title in facts[0]]
    return Table(["what was tested", *(results.name for results in all_results)], [row for row in rows if {*row[1:]} != {"-"}])


# ---- figures of runs
def table_of_figures(runs):
    """Figures of the runs; with several also the first over each other one, where a ratio means something."""
    without_ends = all(run.info.get("app") == "platen-brazilian" or "bending" in str(run.info.get("test")) for run in runs)
    cones = any(math.isfinite(number_in(run.info, f"cone_{end}/half_angle_deg")) for run in runs for end in ("top", "bottom"))
    table = Table(["figure", *(run.name for run in runs), *(f"{runs[0].name} / {run.name}" for run in runs[1:])], [],
                  "", "" if without_ends else ENDS)
    for name, (unit, *keys) in FIGURES.items():
        if (without_ends and name in OF_ENDS) or (name == LEAST and not cones):
            continue
        found = [[value for value in (number_in(run.info, key) for key in keys) if math.isfinite(value)] for run in runs]
        values = [(min if name == LEAST else max)(of, default=math.nan) for of in found]
        if not any(found) and name != "strength":
            continue
        cells = [digits(value, _FACTOR[unit]) for value in values]
        if name == "strength":
            cells = [cell if run.peak_reached is not False else "no peak reached" if cell == "-" else f"{cell}, no peak reached"
                     for cell, run in zip(cells, runs)]
        ratios = [digits(values[0] / value) if name not in ALONE and value and math.isfinite(value) else "-" for value in values[1:]]
        table.rows.append([with_unit(name, unit), *cells, *ratios])
    for title, key in (("pattern", "pattern"), ("pattern at the end", "final_pattern")):
        if any(run.info.get(key) for run in runs):
            table.rows.append([title, *(str(run.info.get(key) or "-") for run in runs), *("-" for _ in runs[1:])])
    return table


def table_of_validity(runs):
    """Figures with a reason against them, in words, a row for those that share theirs; without rows where there is none."""
    alike = {}
    for key in dict.fromkeys(key for run in runs for key in run.info.get("validity") or () if _reasons(run.info, key)):
        cells = tuple(_in_words("; ".join(_reasons(run.info, key))) or "valid" for run in runs)
        alike.setdefault(cells, []).append(words_of_key(key))
    return Table(["figures that are not valid", *(run.name for run in runs)],
                 [[", ".join(dict.fromkeys(names)), *cells] for cells, names in alike.items()])


def _in_words(reason):
    """A reason with the words of the keys that it names."""
    return re.sub(r"\b[a-z]+(?:_[a-z0-9]+)+\b", lambda key: words_of_key(key[0]), reason)


def head(all_results):
    """(sentences, tables) that lead a page of Results; of TestRuns also their figures, and what is not valid."""
    of_runs = [table_of_figures, table_of_validity] if isinstance(all_results[0], TestRun) else []
    return verdict(all_results), [table(all_results) for table in (table_of_facts, *of_runs, table_of_expectations)]
