"""Pages of packings (platen-pack), bond tests (platen-bonds), bars (platen-bar), and calibrations (platen-calibrate): targets beside
calibrated values, parameters of the bonds, curves; of an abacus its moduli."""
import math
import re
from functools import partial
from textwrap import fill

import numpy

from ..results import read_table
from .house import BLACK, BLUE, CYCLE, GPA, GREY, MARKS, MM, MPA, PALE, VERMILION, bars, chart, digits, titled
from .pages import Page, Section, Table
from .run import Results, number_in, reading, shape_of, table_with
from .words import Spread, head, over_packings, true_title, with_unit, words_of_key

COSTS = ("steps", "time_step_s", "threads", "wall_seconds", "setup_seconds", "particle_steps_per_second", "peak_memory_bytes")
GAPS = (1e-3, 0.05)  # mean radii: touching, and what a bond of the shipped scenes reaches
# Of a bar: words, keys of what was measured and of strength of materials, factor from SI, unit.
BAR = (("stretch under tension", "tension/static_displacement_m", "tension/static_by_hand", 1e6, "um"),
       ("deflection under bending", "bending/static_displacement_m", "bending/static_by_hand", 1e6, "um"),
       ("twist under torsion", "torsion/static_twist_rad", "torsion/static_by_hand", 1e3, "mrad"),
       ("frequency in tension", "tension/frequency_hz", "tension/frequency_by_hand_hz", 1e-3, "kHz"),
       ("frequency in bending", "bending/frequency_hz", "bending/frequency_by_hand_hz", 1e-3, "kHz"),
       ("frequency in torsion", "torsion/frequency_hz", "torsion/frequency_by_hand_hz", 1e-3, "kHz"),
       ("wave speed after impact", "impact/wave_speed_m_s", "impact/wave_speed_by_hand_m_s", 1e-3, "km/s"),
       ("Young's modulus, in bulk", "bulk/youngs_modulus_pa", "", GPA, "GPa"),
       ("Poisson's ratio, in bulk", "bulk/poisson_ratio", "", 1, ""))
JUDGED = (("training", "packings calibrated on", BLUE), ("verification", "unseen packings", VERMILION))
FINDINGS = (("missed", "not met together"), ("at_bounds", "at its bound"), ("undetermined", "not determined by the targets"),
            ("correlated", "hardly distinguished"))
VARIED = ("radius_multiplier", "stiffness_ratio", "bond_poisson_ratio", "bond_modulus_pa")
LOADS = (("tension", "end_z_m", "Stretch (um)", 1e6), ("bending", "end_x_m", "Deflection (um)", 1e6),
         ("torsion", "end_twist_rad", "Twist (mrad)", 1e3))


# ---- packings
def density_profile(z, radius, height, area, slices):
    """(middles of slices, share of each that spheres fill) of a cylinder or a box from 0 to height (m), of that cross-section (m2);
    exact where no spheres overlap."""
    levels = numpy.linspace(0, height, slices + 1)
    below = numpy.clip(levels[:, None] - z, -radius, radius)  # of each sphere, from its centre
    volume = math.pi * (radius**2 * below - below**3 / 3).sum(1)  # but for a constant
    return 0.5 * (levels[1:] + levels[:-1]), numpy.diff(volume) / (area * height / slices)


def neighbours(position, radius, gap):
    """How many other surfaces lie within a gap (m) of the surface of each sphere. position: n x 3."""
    cell = numpy.floor((position - position.min(0)) / (2 * radius.max() + gap)).astype(int) + 1
    along_y, along_x = cell[:, 2].max() + 2, (cell[:, 2].max() + 2) * (cell[:, 1].max() + 2)
    key = cell @ numpy.array([along_x, along_y, 1])
    order = numpy.argsort(key, kind="stable")
    count, sorted_keys = numpy.zeros(len(radius), int), key[order]
    for column in (x * along_x + y * along_y for x in (-1, 0, 1) for y in (-1, 0, 1)):  # three cells along z each
        start, end = numpy.searchsorted(sorted_keys, key + column - 1), numpy.searchsorted(sorted_keys, key + column + 1, side="right")
        many = end - start
        one = numpy.repeat(numpy.arange(len(radius)), many)
        other = order[numpy.arange(many.sum()) + numpy.repeat(start - numpy.cumsum(many) + many, many)]
        near = ((position[one] - position[other]) ** 2).sum(1) <= (radius[one] + radius[other] + gap) ** 2
        count += numpy.bincount(one[near & (one != other)], minlength=len(radius))
    return count


def sizes(axes, radius):
    """Shares of the spheres by radius (m)."""
    several = numpy.ptp(radius) > 0
    edges = 24 if several else [0.98 * radius[0] * MM, 1.02 * radius[0] * MM]
    axes.hist(radius * MM, edges, weights=numpy.full(len(radius), 100 / len(radius)))
    axes.set(xlabel="Sphere radius (mm)" + ("" if several else ", one size"), ylabel="Fraction of the spheres (%)")


def coordination(axes, position, radius):
    """Shares of the spheres by their neighbours within each of GAPS."""
    for k, gap in enumerate(GAPS):
        of = neighbours(position, radius, gap * radius.mean())
        share = 100 * numpy.bincount(of) / len(of)
        axes.plot(range(len(share)), share, "o-", color=CYCLE[k], label=f"within a gap of {gap:g} mean radii: {of.mean():.2f} in the mean")
    titled(axes, "Neighbours of a sphere", "Fraction of the spheres (%)")


def density(axes, height, share):
    """Filled share over the height (m)."""
    axes.plot(height * MM, share, color=BLUE, label="slices of about a mean radius")
    axes.axhline(share.mean(), color=GREY, ls="--", label=f"mean {share.mean():.3f}")
    titled(axes, "Height above the bottom (mm)", "Solid fraction", 2)


def _pack(folder, summary, remarks):
    table = table_with(folder / "specimen.csv", "x_m", "y_m", "z_m", "radius_m")
    position, radius = numpy.column_stack([table[name] for name in ("x_m", "y_m", "z_m")]), table["radius_m"]
    if not len(radius) or not (numpy.isfinite(position).all() and (radius > 0).all()):
        raise ValueError("no spheres, or one without a place or a radius")
    pictures = [chart("sizes", f"How large the {len(radius)} spheres are, and how many neighbours they have.",
                      partial(sizes, radius=radius), partial(coordination, position=position, radius=radius))]
    shape, of = shape_of(folder)
    if shape in ("cylinder", "box"):
        area = math.pi * of["radius_m"] ** 2 if shape == "cylinder" else of["width_x_m"] * of["width_y_m"]
        slices = int(numpy.clip(round(of["height_m"] / radius.mean()), 8, 200))
        height, share = density_profile(position[:, 2], radius, of["height_m"], area, slices)
        pictures.append(chart("density", "Solid fraction of each slice, from the bottom to the top. At flat walls it is smaller, and it "
                              "oscillates over a few spheres.", density, height=height, share=share))
    else:
        remarks.append("density over the height is drawn for cylinders and boxes only")
    if not summary:
        remarks.append("summary.json is not there: its figures are left out")
    numbers = [[key, digits(value)] for key, value in summary.items()
               if isinstance(value, (int, float)) and not isinstance(value, bool) and key not in COSTS]
    return [Section("The packing", pictures, [Table(["figure (SI)", "value"], numbers)])]


# ---- bond tests
def bond_paths(axes, table, displacement, load):
    """Load over displacement of each run, from rest."""
    factor, name = (1e6, "Displacement (um)") if displacement == "displacement_m" else (1e3, "Rotation (mrad)")
    for k, run in enumerate(numpy.unique(table["run"])):
        rows = table["run"] == run
        modulus, ratio = table["modulus_pa"][rows][0] * GPA, table["stiffness_ratio"][rows][0]
        axes.plot(numpy.r_[0, table[displacement][rows]] * factor, numpy.r_[0, table[load][rows]], color=CYCLE[k % len(CYCLE)], lw=2.6,
                  label=f"modulus {modulus:.4g} GPa, stiffness ratio {ratio:.3g}")
    titled(axes, name, "Force (N)" if load == "force_n" else "Moment (N m)", 2)


def strain_ratios(axes, table):
    """Strain ratio of the triangle over the stiffness ratio of its bonds, at the end of each run."""
    last = [numpy.flatnonzero(table["run"] == run)[-1] for run in numpy.unique(table["run"])]
    axes.plot(table["stiffness_ratio"][last], table["strain_ratio"][last], "o", color=BLUE, ms=7)
    titled(axes, "Stiffness ratio of the bonds", "Strain ratio of the triangle", 2)


def _bonds(folder, summary, remarks):
    table = table_with(folder / "bonds.csv", "run", "modulus_pa", "stiffness_ratio", "force_n", "displacement_m", "moment_nm",
                       "rotation_rad", "strain_ratio")
    moment = table["moment_nm"]
    displacement, load = ("rotation_rad", "moment_nm") if (numpy.isfinite(moment) & (moment != 0)).any() else ("displacement_m", "force_n")
    pictures, of_triangle = [], numpy.isfinite(table["strain_ratio"]).any()
    if table.rows:
        draws = [partial(bond_paths, table=table, displacement=displacement, load=load)]
        draws += [partial(strain_ratios, table=table)] if of_triangle else []
        pictures = [chart("bonds", "Load over displacement of each run.", *draws, heights=3.2)]
    else:
        remarks.append("bonds.csv has no row: there is nothing to draw")
    keys = ("stiffness_ratio", "stiffness", "break_load")
    rows = [[str(k + 1), *(digits(value) for value in (number_in(run, "modulus_pa") * GPA, *(number_in(run, key) for key in keys)))]
            for k, run in enumerate(summary.get("runs", []))]
    units = ("N m/rad", "N m") if load == "moment_nm" else ("N/m", "N")
    header = ["run", "modulus (GPa)", "stiffness ratio", f"stiffness ({units[0]})", f"break load ({units[1]})"]
    return [Section("Load and displacement", pictures, [Table(header, rows)])]


# ---- bars
def oscillations(axes, history, load, column, title, factor, static):
    """Motion of the free end since the load was removed; dashed: under the load, by strength of materials."""
    rows = history["load"] == load
    time = (history["time_s"][rows] - history["time_s"][rows][0]) * 1e3
    axes.plot(time, history[column][rows] * factor, color=BLUE, label=f"{load}, free end")
    if math.isfinite(static):
        axes.axhline(static * factor, color=VERMILION, ls="--", label=f"under the load, strength of materials: {static * factor:.4g}")
    titled(axes, "Time since the load was removed (ms)", title, 2)


def _bar(folder, summary, remarks):
    found = [(name, unit, number_in(summary, key) * factor, number_in(summary, theory) * factor or math.nan)
             for name, key, theory, factor, unit in BAR if math.isfinite(number_in(summary, key))]
    rows = [[name, unit, *map(digits, (value, theory, value / theory))] for name, unit, value, theory in found]
    off = [(name, value / theory - 1) for name, _, value, theory in found if math.isfinite(theory)]
    for name, key, *_ in BAR:  # what a scene judges: the section that the bonds really fill
        load, kind = key.split("/")[0], "dynamic" if "frequency" in key else "static"
        error = number_in(summary, f"{load}/{kind}_error_effective")
        off += [(f"{name}, effective section", error)] if math.isfinite(error) else []
    pictures = [chart("bar", "By how much the measured values differ from strength of materials, for the bounding section of the bar and for the "
                      "effective one, which has the radius of gyration of its bonds.",
                      bars, names=[name for name, _ in off], values=[100 * error for _, error in off],
                      texts=[f"{100 * error:+.2f} %" for _, error in off], title="Measured against strength of materials (%)", mark=0,
                      heights=0.32 * len(off) + 0.2, margin=2.9)] if off else []
    if (folder / "history.csv").exists():
        history = read_table(folder / "history.csv")
        history["load"] = numpy.array(history["load"] if "load" in history else [], str)
        draws = []
        for load, column, title, factor in LOADS:
            if numpy.count_nonzero(history["load"] == load) > 1:
                table_with(folder / "history.csv", "time_s", column)
                draws.append(partial(oscillations, history=history, load=load, column=column, title=title, factor=factor,
                                     static=number_in(summary, f"{load}/static_by_hand")))
        pictures += [chart("swings", "Motion of the free end after the load was removed. Dashed: its position under the load, by strength "
                           "of materials.", *draws, margin=0.85)] if draws else []
    else:
        remarks.append("history.csv is not there: no picture of how the bar oscillates")
    if not pictures:
        remarks.append("neither summary.json nor history.csv has a load: there is nothing to draw")
    table = Table(["figure", "unit", "measured", "strength of materials", "ratio"], rows)
    return [Section("Comparison with strength of materials", pictures, [table])]


# ---- calibrations
def _named(key, value, name=None):
    """Words of a key of a summary, or its name, with a unit, and its factor from SI; of a second one of its kind the key ends in "_2"."""
    key = re.sub(r"_\d+$", "", key)
    unit, factor = ("degrees", 180 / math.pi) if key.endswith("_rad") else ("", 1)
    if key.endswith("_pa"):
        unit, factor = ("GPa", GPA) if abs(value) >= 1e9 else ("MPa", MPA)
    return with_unit(name or words_of_key(key.removesuffix("_rad")), unit), factor


def ratios(axes, targets):
    """Calibrated values over their targets, with the scatter of packings; grey: the tolerance."""
    for row, target in enumerate(targets):
        tolerance, label = number_in(target, "tolerance"), row == 0
        axes.barh(row, 2 * tolerance, 0.8, 1 - tolerance, color=PALE, zorder=0, label="tolerance" if label else None)
        for k, (of, (_, name, colour)) in enumerate(zip(target["spreads"], JUDGED)):
            mean, low, high, y = *(value / target["value"] for value in of[:3]), row - 0.15 + 0.3 * k
            axes.errorbar(mean, y, None, [[mean - low], [high - mean]], MARKS[k], color=colour, capsize=3, label=name if label else None)
            if math.isfinite(mean):
                axes.annotate(f"{mean:.3f}", (high, y), (5, 0), textcoords="offset points", va="center", fontsize=8)
    axes.axvline(1, color=BLACK, lw=1)
    axes.margins(x=0.1)
    axes.set(xlabel="Calibrated value over target", ylim=(len(targets) - 0.4, -0.6))
    axes.set_yticks(range(len(targets)), [fill(target.get("name") or words_of_key(target["key"]), 24) for target in targets])
    axes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=3)


def curve(axes, table):
    """Stress over strain of curve.csv, from rest: the target, the mean of the packings calibrated on, that of unseen ones."""
    gauge = "strain_gauge" in table
    for column, name, colour, line in (("calibrated_pa", JUDGED[0][1], BLUE, "-"), ("unseen_pa", JUDGED[1][1], VERMILION, "-"),
                                       ("wanted_pa", "target", BLACK, "--")):
        strain = table["strain_gauge" if gauge else "strain_platen"]
        axes.plot(numpy.r_[0, strain] * MM, numpy.r_[0, table[column]] * MPA, color=colour, ls=line, label=name)
    titled(axes, f"Axial strain {'of the gauge' if gauge else 'between platens'} (mm/m)", "Axial stress (MPa)", 3)


def abacus(axes, rows, key, title):
    """A figure of the specimen over the first parameter of its bonds that was varied, a curve for each choice of the others; a
    modulus over that of the bonds. rows: as in the summary."""
    x, *others = [one for one in VARIED if len({row[one] for row in rows}) > 1] or VARIED[-1:]
    curves = {}
    for row in rows:
        name = ", ".join(f"{words_of_key(one)} {row[one]:.4g}" for one in others if one != "bond_modulus_pa")
        curves.setdefault(name, {})[row[x]] = number_in(row, key) / (row["bond_modulus_pa"] if key.endswith("_pa") else 1)
    for k, (name, values) in enumerate(curves.items()):
        axes.plot(list(values), list(values.values()), MARKS[k % len(MARKS)] + "-", color=CYCLE[k % len(CYCLE)], label=name or None)
    titled(axes, words_of_key(x).capitalize(), title, 2)


def _section_of_targets(summary, remarks):
    rows, drawn, found = [], [], []
    for target in summary["targets"]:
        name, factor = _named(target["key"], target["wanted"], target.get("name"))
        target["value"], is_curve = target["wanted"] * factor, target["key"].startswith("curve_miss")
        target["spreads"] = spreads = [over_packings(target[key], factor) if key in target else Spread() for key, *_ in JUDGED]
        misses = [number_in(target, key + "_miss") if is_curve else math.nan for key, *_ in JUDGED]
        rows.append([name, "the curve" if is_curve else digits(target["value"]),
                     *(of.words(".4g", 0) if math.isnan(miss) else f"error {100 * miss:.4g} %" for of, miss in zip(spreads, misses)),
                     f"{100 * number_in(target, 'tolerance'):.3g} %", "yes" if target.get("met", target["met_in_training"]) else "no"])
        drawn += [target] if target["wanted"] and any(math.isfinite(of.mean) for of in spreads) else []
    tables = [Table(["target", "value", *(name for _, name, _ in JUDGED), "tolerance", "met"], rows, "Targets and calibrated values",
                    "In brackets: how many packings. +-: standard deviation; ...: range of fewer than five. The error of a curve is the "
                    "root mean square of its differences over the largest stress.")]
    for key, value in summary.get("found", {}).items():
        name, factor = _named(key, value or 0)
        found += [[name, digits(value, factor)]] if value is not None else []
    tables.append(Table(["parameter of the bonds", "calibrated value"], found))
    remarks += [] if drawn else ["summary.json has no value of a target: there is no picture of them"]
    caption = ("Each calibrated value over its target, mean of the packings with their scatter (standard deviation, of fewer than five "
               "packings their range). Grey: the tolerance.")
    picture = chart("targets", caption, ratios, targets=drawn, heights=0.4 + 0.5 * len(drawn), margin=1.9, titles=True)
    return Section("Targets and calibrated values", [picture] if drawn else [], tables)


def _calibration(folder, summary, remarks):
    sections, curves = [], []
    remarks += [f"{how}: {line}" for key, how in FINDINGS for line in summary.get(key, [])]
    if "targets" in summary:
        sections.append(_section_of_targets(summary, remarks))
    if summary.get("abacus"):
        draws = [partial(abacus, key=key, title=title) for key, title in (
            ("youngs_modulus_gauge_pa", "Young's modulus over that of the bonds"), ("poisson_ratio", "Poisson's ratio"))]
        caption = "Moduli of the specimen over the parameters of its bonds, mean of the packings."
        sections.append(Section("Abacus", [chart("abacus", caption, *draws, rows=summary["abacus"], heights=2.8, shared=True)]))
    for file in sorted(folder.glob("curve*.csv"), key=lambda file: (len(file.name), file.name)):
        table = table_with(file, "wanted_pa", "calibrated_pa", "unseen_pa")
        table_with(file, "strain_gauge" if "strain_gauge" in table else "strain_platen")
        caption = "Dashed: the target curve. Blue: mean of the packings calibrated on. Red: mean of unseen packings."
        curves.append(chart(file.stem, caption, curve, table=table, heights=3.2))
    return [*sections, Section("Curves", curves)]


# ---- pages
def page_of(folder):
    """The Page of a packing, a bond test, a bar or a calibration, None of another folder. InputError where a file is missing or damaged."""
    results, remarks = Results(folder), []
    folder, summary = results.folder, results.info
    app = summary.get("app", "platen-pack" if (folder / "specimen.csv").exists() and not (folder / "history.csv").exists() else "")
    made, file = {"platen-pack": (_pack, "specimen.csv"), "platen-bonds": (_bonds, "summary.json"), "platen-bar": (_bar, "summary.json"),
                  "platen-calibrate": (_calibration, "summary.json")}.get(app, (None, ""))
    if made is None:
        return None
    with reading(folder / file):
        return Page(true_title(results), *head([results]), made(folder, summary, remarks), remarks)
