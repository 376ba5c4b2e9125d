"""Tests by stages and tests that press several sides: what each stage asked and where it ended, stresses on each side, the
path of all three stresses."""
from functools import partial

import numpy

from .house import BLACK, BLUE, CYCLE, GREEN, GREY, MM, MPA, MS, VERMILION, chart, digits, legend_over
from .pages import Section, Table
from .platens import sides_of
from .run import SIDES, STRAIN, STRESS

_STAGE_COLOURS = (*CYCLE, "#882255", "#999933", "#332288")  # after ten they come again, dashed
SIDE_COLOURS = dict(zip(SIDES, (BLUE, BLUE, VERMILION, VERMILION, GREEN, GREEN)))  # one an axis
_ASKED = ("Axial", "Lateral", "Lateral x", "Lateral y", "Bottom", "Top", "Left", "Right", "Front", "Back")


# ---- sides
def stress_column(side):
    return f"axial_stress_{side}_pa" if side in ("bottom", "top") else f"stress_{side}_pa"


def has_further_sides(run):
    return len(sides_of(run)) > 2


def axis_stresses(run):
    """Pa along x, y, z, 3 x rows: the mean of the platens there, else the pressure of a cell or wall, else 0."""
    beside = run.h["confining_pressure_pa"] if run.has("confining_pressure_pa") else numpy.zeros(run.h.rows)
    return numpy.array([0.5 * (run.h[low] + run.h[high]) if run.has(low, high) else beside for low, high in STRESS])


def stress_path(run):
    """(p, q) in Pa: p = (s1 + s2 + s3) / 3, q = sqrt(3 J2) of the stresses along the axes, taken for principal ones."""
    x, y, z = axis_stresses(run)
    return (x + y + z) / 3, numpy.sqrt(0.5 * ((x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2))


def has_stress_path(run):
    """Whether anything presses the sides."""
    return has_further_sides(run) or (run.has("confining_pressure_pa") and bool((run.h["confining_pressure_pa"] > 0).any()))


def draw_stress_path(axes, runs):
    """q over p of those runs that have a path; dots at their peaks."""
    reach = 0.0
    for k, run in enumerate(runs):
        if has_stress_path(run):
            p, q = (MPA * one for one in stress_path(run))
            axes.plot(p, q, color=CYCLE[k % len(CYCLE)], label=run.name if len(runs) > 1 else "path of the test")
            axes.plot(p[run.peak_row], q[run.peak_row], "o", color=CYCLE[k % len(CYCLE)])
            reach = max(reach, float(numpy.nanmax(numpy.minimum(p, q / 3))))
    axes.plot([0, reach], [0, 3 * reach], ls="--", color=GREY, label="sides without stress: q = 3 p")
    axes.set(xlabel="Mean stress p = (s1 + s2 + s3) / 3 (MPa), compression positive", ylabel="Deviator q = sqrt(3 J2) (MPa)")
    legend_over(axes)


def side_stresses(axes, run):
    """A curve for each side over strain: a colour an axis, the high side dashed; dots at the peak."""
    sides = sides_of(run)
    for side in sides:
        stress, high = run.h[stress_column(side)] * MPA, side in ("top", "right", "back")
        covered = side in ("left", "right") and "front" in sides  # where both pairs bear the same
        axes.plot(run.strain * MM, stress, "--" if high else "-", color=SIDE_COLOURS[side], label=side, lw=3.2 if covered else 1.4)
        if not high:  # one of each pair
            axes.plot(run.strain[run.peak_row] * MM, stress[run.peak_row], "o", color=SIDE_COLOURS[side])
    axes.set(xlabel=run.strain_title, ylabel="Stress (MPa), compression positive")
    legend_over(axes, 6)


def table_of_sides(run):
    """A row for each side: largest stress, stress at the peak, work of friction until the end."""
    rows = []
    for side in sides_of(run):
        stress, work = run.h[stress_column(side)] * MPA, f"friction_work_{side}_j"
        rows.append([side, digits(stress.max()), digits(stress[run.peak_row]), digits(run.h[work][-1]) if run.has(work) else "-"])
    return Table(["side", "largest stress (MPa)", "stress at the peak (MPa)", "work of friction (J)"], rows)


def section_of_sides(run):
    """The Section "Sides"; None where no platens but the bottom and the top one press."""
    if not has_further_sides(run):
        return None
    return Section("Sides", [chart("side_stresses", "Stress on each platen: its force over the face of the specimen. A colour is a pair of "
                                   "opposite platens. They differ only by the friction that the other platens take up. Dots: the peak.",
                                   partial(side_stresses, run=run), heights=3.6)], [table_of_sides(run)])


# ---- stages
def stages_of(run):
    """[(number, first, last), ...]: rows of the history of each stage, the first one the last of the stage before; [] where the
    scene has none."""
    if not run.has("stage"):
        return []
    stage = run.h["stage"]
    starts = [0, *(numpy.flatnonzero(numpy.diff(stage)) + 1)]
    return [(int(stage[start]), max(0, start - 1), end - 1) for start, end in zip(starts, [*starts[1:], len(stage)])]


def stage_words(run, number):
    """"Lateral pressure 4 MPa, Top stress 4 MPa", as the scene has it."""
    asked = ((side, run.entry(f"Loading/Stage {number}/{side}")) for side in _ASKED)
    return ", ".join(f"{side} {words}" for side, words in asked if words)


def _by_circumference(run):
    return run.has("circumferential_strain")


def strain_across(run):
    """Across the loaded axis, negative where the specimen widens: around it, of the gauge, or of the platens there."""
    if _by_circumference(run):
        return -run.since("circumferential_strain")
    if run.axis == 2:
        return run.since("lateral_strain")
    return numpy.mean([run.since(column) for axis, column in enumerate(STRAIN) if axis != run.axis and run.has(column)], 0)


def _plot_stages(axes, run, x, y, widths=True, labels=False):
    """Earlier stages are wider, so that a path is seen on which a later one comes back."""
    found = stages_of(run)
    for k, (number, first, last) in enumerate(found):
        words = stage_words(run, number) if labels else ""
        words = words if len(words) < 62 else words[:58] + "..."
        wider = 1 - k / (len(found) - 1) if widths and len(found) > 1 else 0
        axes.plot(x[first:last + 1], y[first:last + 1], "-" if k % 20 < 10 else "--", color=_STAGE_COLOURS[k % 10], lw=1.6 + 2.6 * wider,
                  label=f"{number}: {words}".rstrip(": ") if labels else None)


def stages_stress(axes, run):
    """Stress over strain along the loaded axis, a colour for each stage."""
    _plot_stages(axes, run, run.strain * MM, run.stress * MPA, labels=True)
    axes.set(xlabel=run.strain_title, ylabel=run.stress_title)
    legend_over(axes)


def stages_across(axes, run):
    """Deviator (or stress, where nothing presses the sides) over the strains along and across, which is to the left."""
    stress = stress_path(run)[1] if has_stress_path(run) else run.stress
    for strain in (run.strain, strain_across(run)):
        _plot_stages(axes, run, strain * MM, stress * MPA)
    furthest, around = float(numpy.nanmax(run.strain)) * MM, _by_circumference(run)
    if furthest > 0 and not around:  # what opens once it has failed is cut off
        axes.set_xlim(left=max(axes.get_xlim()[0], -1.2 * furthest))
    axes.set(xlabel=f"Strain {'around' if around else 'across'} (left) and along {'the axis' if run.axis == 2 else 'xyz'[run.axis]}"
             f"{run.strain_origin} (mm/m), compression positive",
             ylabel="Deviator q (MPa)" if has_stress_path(run) else run.stress_title)


def stages_over_time(axes, run):
    """Stresses over time, the number of each stage above."""
    time, stresses = run.h["time_s"] * MS, axis_stresses(run) * MPA
    if has_further_sides(run):
        pairs = ("left and right platens", "front and back platens", "bottom and top platens")
        for axis in range(3):
            if axis != run.axis and run.has(*STRESS[axis]):
                axes.plot(time, stresses[axis], "--", color=GREY if axis == (run.axis + 1) % 3 else BLACK, label=pairs[axis])
    elif has_stress_path(run):
        axes.plot(time, stresses[0], "--", color=GREY, label="pressure on the sides")
    _plot_stages(axes, run, time, run.stress * MPA, widths=False)
    found, end = stages_of(run), -1.0
    for k, (number, first, last) in enumerate(found if len(found) > 1 else []):
        if k % 2:
            axes.axvspan(time[first], time[last], color="#eeeeee", zorder=0)
        middle = 0.5 * (time[first] + time[last])
        if middle - end > 0.02 * time[-1]:  # numbers of short stages would cover each other
            axes.annotate(str(number), (middle, 1), xycoords=("data", "axes fraction"), ha="center", va="bottom", fontsize=8)
            end = middle
    axes.set(xlabel="Time (ms)", ylabel=run.stress_title)
    legend_over(axes, 2)


def table_of_stages(run):
    """A row for each stage: what it asked, what ended it, and where."""
    confined, stress, across, q = has_stress_path(run), run.stress * MPA, strain_across(run) * MM, stress_path(run)[1] * MPA
    said = {one.get("stage"): one for one in run.info.get("stages") or [] if isinstance(one, dict)}
    header = ["stage", "asked", "until", "ended by", "at (ms)", "strain (mm/m)",
              f"{'circumferential' if _by_circumference(run) else 'lateral'} strain (mm/m)", "stress (MPa)", "largest stress (MPa)"]
    rows = []
    for number, first, last in stages_of(run):
        numbers = [run.h["time_s"][last] * MS, run.strain[last] * MM, across[last], stress[last], stress[first:last + 1].max()]
        rows.append([str(number), stage_words(run, number) or "-", run.entry(f"Loading/Stage {number}/Until") or "-",
                     said.get(number, {}).get("ended_by") or "-", *map(digits, numbers + [q[last]] * confined)])
    return Table(header + ["deviator q (MPa)"] * confined, rows)


def section_of_stages(run):
    """The Section "Stages"; None where the scene has none."""
    found = stages_of(run)
    if not found:
        return None
    draws, heights = [stages_stress], [2.9 + 0.17 * len(found)]
    if has_stress_path(run) or _by_circumference(run):
        draws, heights = [*draws, stages_across], [*heights, 2.8]
    caption = "The test stage by stage."
    if len(found) > 1:
        caption = ("The test stage by stage, a colour for each. A later stage is drawn narrower: where it comes back on the path of an "
                   "earlier one, both are seen. The numbers over the lowest chart are those of the stages.")
    if len(draws) > 1 and not _by_circumference(run):
        caption += " The largest lateral strains are cut off."
    return Section("Stages", [chart("stages", caption, *(partial(draw, run=run) for draw in [*draws, stages_over_time]),
                                    heights=[*heights, 2.2], titles=True)], [table_of_stages(run)])
