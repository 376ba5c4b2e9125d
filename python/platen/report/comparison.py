"""The page of runs. Of several beside each other: stress over strain, stress paths, strength under pressure and under two stresses."""
from collections import namedtuple
from functools import partial
from pathlib import Path

import numpy

from . import cracks, curves, laboratory, platens, specimen, tube, view, words
from .curves import axis_stresses, draw_stress_path, has_stress_path
from .envelope import fit_line, mohr, strength_over_pressure
from .house import BLACK, CYCLE, GREY, MARKS, MPA, chart
from .pages import Page, Section
from .platens import has_further_sides

FREE_SHARE = 0.02  # of the largest stress: a side with less counts as free
# Equal stresses on two pairs of sides over the uniaxial strength, between brushes: the one figure of the abstract.
PUBLISHED, SOURCE = 1.16, "Kupfer, Hilsdorf and Ruesch 1969, brushes"
# Size of the specimen and platens: strengths are compared where all of it is alike.
_ALIKE = ("Specimen/Shape", "Specimen/Radius", "Specimen/Height", "Specimen/Width x", "Specimen/Width y", "Platens/Surface", "Platens/Kind",
          "Platens/Friction static", "Platens/Friction dynamic", "Platens/Top/Surface", "Platens/Top/Friction static",
          "Platens/Top/Friction dynamic", "Platens/Top/Mesh file")


class BiaxialPoint(namedtuple("BiaxialPoint", "run surface first second")):
    """The larger and the smaller stress at failure over the uniaxial strength of the same specimen and platens; surface: of these, in
    words."""


def _kind(run):
    return tuple(map(run.entry, _ALIKE))


def _has_failed(run):
    return run.fall_time is not None if run.peak_reached is None else run.peak_reached


def biaxial_strengths(runs):
    """(points, left_out): a BiaxialPoint for each run with platens on its sides that has failed between two stresses, (1, 0) for those with
    free sides, each the reference of the others of its specimen and platens; and runs that give none, with the reason, as sentences."""
    stresses = [numpy.sort(axis_stresses(run)[:, run.peak_row])[::-1] for run in runs]
    free = [s[1] < FREE_SHARE * s[0] for s in stresses]
    uniaxial, points, left_out = {}, [], []
    for run, s, is_free in zip(runs, stresses, free):
        if _has_failed(run) and s[0] > 0 and is_free:
            uniaxial.setdefault(_kind(run), s[0])
    for run, s, is_free in zip(runs, stresses, free):
        if not has_further_sides(run) and not is_free:  # in a cell
            continue
        reference = uniaxial.get(_kind(run))
        why = ("has not failed" if not _has_failed(run) else "is pressed along three axes" if s[2] >= FREE_SHARE * s[0] and not is_free else
               "has no run with the same specimen, the same platens and free sides to compare with" if reference is None else "")
        if not why:
            word, mesh = run.entry("Platens/Surface"), run.entry("Platens/Top/Mesh file")
            surface = f"friction {run.entry('Platens/Friction static')}" if word in ("", "custom") else word
            surface += f", mesh {Path(mesh).stem}" if mesh else ", elastic" * (run.entry("Platens/Kind") == "deformable")
            points.append(BiaxialPoint(run.name, surface, float(s[0] / reference), 0.0 if is_free else float(s[1] / reference)))
        elif has_further_sides(run):
            left_out.append(f"{run.name} {why}: it is not in the picture of biaxial strengths")
    return points, left_out


def biaxial(axes, points):
    """Strengths under two stresses over the uniaxial one, a mark for each kind of platens; diamond: published."""
    end = 1.12 * max(PUBLISHED, *(point.first for point in points))
    axes.plot([0, end], [0, end], "--", color=GREY, label="equal stresses")
    for k, surface in enumerate(sorted({point.surface for point in points})):
        places = numpy.array([(point.first, point.second) for point in points if point.surface == surface])
        axes.plot(*places.T, MARKS[k % len(MARKS)], color=CYCLE[k % len(CYCLE)], ms=6, label=surface)
    axes.plot(PUBLISHED, PUBLISHED, "D", color=BLACK, ms=6, label=SOURCE)
    axes.set(xlabel="Largest stress at failure over uniaxial strength", ylabel="Second stress over it", xlim=(0, end), aspect="equal",
             ylim=(-0.05 * end, end))
    axes.legend(loc="upper left")


def strengths_in_cells(runs):
    """(pressure, strength) in MPa at the peaks of the runs without platens on their sides that have failed, by pressure: of those
    of one specimen and platens, the most that are beside each other."""
    kinds = {}
    for run in runs:
        if run.axis == 2 and run.peak_stress > 0 and _has_failed(run) and not has_further_sides(run):
            kinds.setdefault(_kind(run), []).append((float(axis_stresses(run)[0, run.peak_row]) * MPA, run.peak_stress * MPA))
    return sorted(max(kinds.values(), key=len, default=[]))


def pictures(runs):
    """The Pictures of charts of the section "Comparison" that the files of the runs allow."""
    made = [curves.stress_strain(runs, "comparison_stress_strain",
                          "Stress, broken bonds and volume over strain, a colour for each run. Stress: thick line between the platens, "
                          "dashed line of the gauge, thin line to the left the lateral strain. Bonds: solid line broken in tension, dashed "
                          "line in shear. Broken bonds and volume are drawn over the strain between the platens. Dots: the peaks. The "
                          "largest strains are cut off.")]
    if any(has_stress_path(run) for run in runs):
        made.append(chart("comparison_stress_path",
                          "Mean stress and deviator of each run whose sides are pressed. Dots: the peaks, where it failed.",
                          draw_stress_path, runs=runs, heights=3.4))
    points, strengths = strengths_in_cells(runs), biaxial_strengths(runs)[0]
    line = fit_line(*zip(*points)) if points else None
    if line is not None and line.high > line.low + 0.01 * points[-1][1]:
        caption = ("Strength under pressure of the runs of one specimen and platens that failed, and Mohr's circles with the line of Mohr "
                   f"and Coulomb ({line.range_words}). The errors behind +- are standard errors.")
        if line.misses:
            caption += " At some pressure the line misses the strength by more than 5 %: the curve of Hoek and Brown is drawn too."
        made.append(chart("comparison_envelope", caption, strength_over_pressure, mohr, points=points, line=line, heights=[3.0, 3.8]))
    if any(point.second > 0 for point in strengths):
        equal = [point for point in strengths if point.second > 0.9 * point.first]  # how they stand to the published one
        made.append(chart("comparison_biaxial", "Strength under two stresses over the uniaxial strength of the same specimen between "
                          f"the same platens. Each mark is one run. Diamond: published for equal stresses, {PUBLISHED}."
                          + "".join(f" {point.run}: {point.second:.2f} and {point.first:.2f} ({point.surface})." for point in equal),
                          biaxial, points=strengths, heights=5.2, width=6.2))
    return made


def page_of_runs(runs, measured=None):
    """The page of a run, or of a run beside others; measured: a laboratory.Curve."""
    run, several, (leads, head) = runs[0], len(runs) > 1, words.head(runs)
    remarks = [f"{run.name}: {remark}" if several else remark for run in runs for remark in run.remarks]
    remarks += [f"{run.name}: no peak reached: the largest stress is not a strength" for run in runs if run.peak_reached is False]
    remarks += [*(measured.remarks if measured else []), *(biaxial_strengths(runs)[1] if several else [])]
    wall = curves.wall_word(run)
    sections = [
        Section("Comparison", [*pictures(runs), *specimen.comparison(runs)] if several else []),
        Section("Stress and energy", curves.pictures_of_curves(run, measured), [laboratory.differences(run, measured)] if measured else []),
        Section(f"The {wall}", tube.pictures_of_tube(run)), curves.section_of_stages(run), curves.section_of_sides(run), Section("Acoustic emission", curves.pictures_of_events(run)),
        Section("Interactive view", [], element=partial(view.element, run) if run.series("specimen") else None),
        Section("The specimen", specimen.pictures_of_specimen(run)), Section("Cracks", cracks.pictures_of_cracks(run)),
        Section("Platens and ends", platens.pictures_of_ends(run)), Section("The sleeve" if wall == "sleeve" else f"The {wall}, as it deforms", specimen.pictures_of_sleeve(run)),
        Section("Computing time", curves.pictures_of_costs(run))]
    if several:  # all after the comparison is of the first run
        sections[1:] = [section and section._replace(heading=f"{section.heading}: {run.name}") for section in sections[1:]]
    return Page(" and ".join(map(words.true_title, runs)), leads, head, sections, remarks)
