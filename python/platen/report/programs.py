"""Pages of programs that crush nothing: packings (platen-pack), bond tests (platen-bonds), bars (platen-bar)."""
import math
import re
from functools import partial
from pathlib import Path

import numpy

from . import words
from ..results import read_table
from .house import BLACK, BLUE, CYCLE, GPA, GREY, MM, VERMILION, chart, legend_over
from .kit import bars, reading, table_with
from .pages import Page, Section, Table
from .run import number_in

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
    axes.set(xlabel="Sphere radius (mm)" + ("" if several else ", one size"), ylabel="Share of the spheres (%)")


def coordination(axes, position, radius):
    """Shares of the spheres by their neighbours within each of GAPS."""
    for k, gap in enumerate(GAPS):
        of = neighbours(position, radius, gap * radius.mean())
        share = 100 * numpy.bincount(of) / len(of)
        axes.plot(range(len(share)), share, "o-", color=CYCLE[k], label=f"within a gap of {gap:g} mean radii: {of.mean():.2f} in the mean")
    axes.set(xlabel="Neighbours of a sphere", ylabel="Share of the spheres (%)")
    legend_over(axes)


def density(axes, height, share):
    """Filled share over the height (m)."""
    axes.plot(height * MM, share, color=BLUE, label="slices of about a mean radius")
    axes.axhline(share.mean(), color=GREY, ls="--", label=f"mean {share.mean():.3f}")
    axes.set(xlabel="Height above the bottom (mm)", ylabel="Share of the volume that is filled")
    legend_over(axes, 2)


def _pack(folder, summary, remarks):
    table = table_with(folder / "specimen.csv", "x_m", "y_m", "z_m", "radius_m")
    position, radius = numpy.column_stack([table[name] for name in ("x_m", "y_m", "z_m")]), table["radius_m"]
    if not len(radius) or not (numpy.isfinite(position).all() and (radius > 0).all()):
        raise ValueError("no spheres, or one without a place or a radius")
    pictures = [chart("sizes", f"How large the {len(radius)} spheres are, and how many neighbours they have.",
                      partial(sizes, radius=radius), partial(coordination, position=position, radius=radius))]
    shape = re.match(r"# shape: (cylinder|box) (.*)", (folder / "specimen.csv").read_text(encoding="utf-8"))
    if shape:
        of = {name: float(value) for name, value in re.findall(r"(\w+)=(\S+)", shape[2])}
        area = math.pi * of["radius_m"] ** 2 if shape[1] == "cylinder" else of["width_x_m"] * of["width_y_m"]
        slices = int(numpy.clip(round(of["height_m"] / radius.mean()), 8, 200))
        height, share = density_profile(position[:, 2], radius, of["height_m"], area, slices)
        pictures.append(chart("density", "Share of each slice that spheres fill, from the bottom to the top. At flat walls it is smaller, "
                              "and it goes up and down over a few spheres.", partial(density, height=height, share=share)))
    else:
        remarks.append("density over the height is drawn of cylinders and boxes alone")
    if not summary:
        remarks.append("summary.json is not there: its figures are left out")
    numbers = [[key, words.digits(value)] for key, value in summary.items()
               if isinstance(value, (int, float)) and not isinstance(value, bool) and key not in COSTS]
    return Section("The packing", pictures, [Table(["figure (SI)", "value"], numbers)] if numbers else [])


# ---- bond tests
def _compared(table, measured):
    """Which of the measured columns stands in `by_hand`: the one whose differences the table has."""
    known = numpy.isfinite(table["by_hand"]) & numpy.isfinite(table["difference"]) & (table["by_hand"] != 0)
    misses = {}
    for name in measured:
        rows = known & numpy.isfinite(table[name])
        if rows.any():
            misses[name] = numpy.abs(table[name][rows] / table["by_hand"][rows] - 1 - table["difference"][rows]).max()
    return min(misses, key=misses.get) if misses else measured[0]


def bond_paths(axes, table, displacement, load, compared):
    """Load over displacement of each run, from rest; dashed: the closed form, where it is of one of both."""
    factor, name = (1e6, "Displacement (um)") if displacement == "displacement_m" else (1e3, "Rotation (mrad)")
    for k, run in enumerate(numpy.unique(table["run"])):
        rows = table["run"] == run
        modulus, ratio = table["modulus_pa"][rows][0] * GPA, table["stiffness_ratio"][rows][0]
        axes.plot(numpy.r_[0, table[displacement][rows]] * factor, numpy.r_[0, table[load][rows]], color=CYCLE[k % len(CYCLE)], lw=2.6,
                  label=f"modulus {modulus:.4g} GPa, stiffness ratio {ratio:.3g}")
        rows &= numpy.isfinite(table["by_hand"])
        if compared in (displacement, load) and rows.any():
            x, y = (table["by_hand" if compared == column else column][rows] for column in (displacement, load))
            axes.plot(numpy.r_[0, x] * factor, numpy.r_[0, y], "--", color=BLACK, lw=1, label="closed form" if k == 0 else None)
    axes.set(xlabel=name, ylabel="Force (N)" if load == "force_n" else "Moment (N m)")
    legend_over(axes, 2)


def strain_ratios(axes, table):
    """Strain ratio of the triangle over the stiffness ratio of its bonds, at the end of each run."""
    last = [numpy.flatnonzero(table["run"] == run)[-1] for run in numpy.unique(table["run"])]
    for column, name, colour, mark, size in (("strain_ratio", "measured", BLUE, "o", 7), ("by_hand", "closed form", VERMILION, "D", 3)):
        axes.plot(table["stiffness_ratio"][last], table[column][last], mark, color=colour, ms=size, label=name)
    axes.set(xlabel="Stiffness ratio of the bonds", ylabel="Strain ratio of the triangle")
    legend_over(axes, 2)


def _bonds(folder, summary, remarks):
    table = table_with(folder / "bonds.csv", "run", "modulus_pa", "stiffness_ratio", "force_n", "displacement_m", "moment_nm",
                       "rotation_rad", "by_hand", "difference")
    moment = table["moment_nm"]
    displacement, load = ("rotation_rad", "moment_nm") if (numpy.isfinite(moment) & (moment != 0)).any() else ("displacement_m", "force_n")
    pictures = []
    if table.rows:
        compared = _compared(table, [displacement, load, *(["strain_ratio"] if "strain_ratio" in table else [])])
        draws = [partial(bond_paths, table=table, displacement=displacement, load=load, compared=compared)]
        draws += [partial(strain_ratios, table=table)] if compared == "strain_ratio" else []
        pictures = [chart("bonds", "Load over displacement of each run. Dashed, or diamonds: the closed form.", *draws, heights=3.2)]
    else:
        remarks.append("bonds.csv has no row: there is nothing to draw")
    keys = ("stiffness_ratio", "stiffness", "stiffness_by_hand", "break_load", "break_load_by_hand", "largest_difference")
    rows = [[str(k + 1), *(words.digits(value) for value in (number_in(run, "modulus_pa") * GPA, *(number_in(run, key) for key in keys)))]
            for k, run in enumerate(summary.get("runs", []))]
    header = ["run", "modulus (GPa)", "stiffness ratio", "stiffness", "closed form", "break load", "closed form", "difference"]
    note = "Stiffness and load in SI units; moments over rotations where the bond is bent or twisted. Difference: the largest."
    figures = Table(header, rows, "", note)
    return Section("Load and displacement", pictures, [figures] if rows else [])


# ---- bars
def oscillations(axes, history, load, column, title, factor, static):
    """Motion of the free end since the load was removed; dashed: under the load, by strength of materials."""
    rows = history["load"] == load
    time = (history["time_s"][rows] - history["time_s"][rows][0]) * 1e3
    axes.plot(time, history[column][rows] * factor, color=BLUE, label=f"{load}, free end")
    if math.isfinite(static):
        axes.axhline(static * factor, color=VERMILION, ls="--", label=f"under the load, strength of materials: {static * factor:.4g}")
    axes.set(xlabel="Time since the load was removed (ms)", ylabel=title)
    legend_over(axes, 2)


def _bar(folder, summary, remarks):
    found = [(name, unit, number_in(summary, key) * factor, number_in(summary, theory) * factor or math.nan)
             for name, key, theory, factor, unit in BAR if math.isfinite(number_in(summary, key))]
    rows = [[name, unit, *map(words.digits, (value, theory, value / theory))] for name, unit, value, theory in found]
    both = [(name, value / theory) for name, _, value, theory in found if math.isfinite(theory)]
    pictures = [chart("bar", "Measured value over that of strength of materials for the same bar, and by how much they differ.",
                      partial(bars, names=[name for name, _ in both], values=[100 * (ratio - 1) for _, ratio in both],
                              texts=[f"{ratio:.4g}" for _, ratio in both], title="Measured against strength of materials (%)", mark=0),
                      heights=0.32 * len(both) + 0.2, margin=1.9)] if both else []
    if (folder / "history.csv").exists():
        history = read_table(folder / "history.csv")
        history["load"] = numpy.array(history["load"] if "load" in history else [], str)
        draws = []
        for load, column, title, factor in LOADS:
            if numpy.count_nonzero(history["load"] == load) > 1:
                table_with(folder / "history.csv", "time_s", column)
                draws.append(partial(oscillations, history=history, load=load, column=column, title=title, factor=factor,
                                     static=number_in(summary, f"{load}/static_by_hand")))
        pictures += [chart("swings", "Motion of the free end after the load was removed. Dashed: its place under the load, by strength of "
                           "materials.", *draws, margin=0.85)] if draws else []
    else:
        remarks.append("history.csv is not there: no picture of how the bar oscillates")
    if not pictures:
        remarks.append("neither summary.json nor history.csv has a load: there is nothing to draw")
    figures = Table(["figure", "unit", "measured", "strength of materials", "ratio"], rows)
    return Section("Comparison with strength of materials", pictures, [figures] if rows else [])


def page_of(folder):
    """The Page of a packing, a bond test or a bar, None of another folder. InputError where a file is missing or damaged."""
    folder = Path(folder)
    results = words.results_in(folder)
    summary = results.info
    app = summary.get("app", "platen-pack" if (folder / "specimen.csv").exists() and not (folder / "history.csv").exists() else "")
    made = {"platen-pack": (_pack, "specimen.csv"), "platen-bonds": (_bonds, "summary.json"), "platen-bar": (_bar, "summary.json")}.get(app)
    if made is None:
        return None
    remarks, (leads, head) = [], words.head([results])
    with reading(folder / made[1]):
        section = made[0](folder, summary, remarks)
    return Page(words.true_title(results), leads, head, [section], remarks)
