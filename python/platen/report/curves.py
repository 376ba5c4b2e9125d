"""Curves of runs over strain and time: stress, broken bonds, volume, energies, a cell's pressure, stresses on the sides and their path,
stages, acoustic events, and where the computing time went. Each function draws on one axes; `pictures_of_...` and `section_of_...` make
the Pictures and Sections that the files of a run allow."""
import math
from collections import namedtuple
from functools import partial

import numpy

from . import laboratory as measured
from .house import BLACK, BLUE, CYCLE, GREEN, GREY, MM, MPA, MS, ORANGE, PALE, PURPLE, SKY, VERMILION
from .house import above, bars, chart, digits, span, titled
from .pages import Section, Table
from .platens import SIDES, has_further_sides, sides_of
from .run import STRAIN, STRESS, listed, number_in

# Column, words, colour, line of the energies; the share of the work from which on a term stands in the first chart.
MAIN = (("boundary_work_j", "work of the platens", BLACK, "-"), ("bond_energy_j", "elastic energy of bonds", BLUE, "-"),
        ("fracture_work_j", "{fracture}", VERMILION, "-"), ("friction_work_j", "friction", ORANGE, "-"),
        ("damping_work_j", "damping", GREY, "-"), ("plastic_work_j", "{plastic}", PURPLE, "-"))
FRACTURE = {"elasto damage plastic": "damage of bonds", "facet": "damage and slip of bonds"}  # by law; else broken bonds
SMALL = (("contact_energy_j", "elastic energy of contacts", SKY, "-"),
         ("body_energy_j", "elastic energy of {bodies}", GREEN, "-"), ("kinetic_energy_j", "kinetic energy", "#882255", "--"))
RESIDUAL = ("energy_residual_j", "residual", BLACK, "--")
MAIN_SHARE, SMALL_SHARE = 0.01, 0.05
_LEFT, _RIGHT = 1.2, 1.5  # that strains are drawn to, over the largest one between the platens
_SMALL_JOULES = 0.01  # below it axes have mJ
_MOST_OPEN = 10  # of what it was at the peak
_STAGE_COLOURS = (*CYCLE, "#882255", "#999933", "#332288")  # after ten they come again, dashed
_ASKED = ("Axial", "Lateral", "Lateral x", "Lateral y", "Bottom", "Top", "Left", "Right", "Front", "Back")


_BROKEN = (("broken_tension", "broken in tension", VERMILION, "-"), ("broken_shear", "broken in shear", BLUE, "--"))


# ---- stress, broken bonds, volume
def _sign(runs):
    """Of stresses and strains that are drawn: those of tension tests by themselves are positive in tension."""
    return -1 if all(run.info.get("test") == "tension" for run in runs) else 1


def _over_strain(axes, runs, columns, factor=1.0, since=False):
    """Columns (name, words, colour, line) of the histories from the end of consolidation on, as far as they have them, over strain; since:
    less what they were there; over time where the strain of all goes back. Of several runs a colour is a run."""
    for k, run in enumerate(runs):
        for column, words, colour, line in columns:
            if run.has(column):
                values = (run.since(column) if since else run.h[column]) * factor
                axes.plot(_along(run, runs)[run.rows], values[run.rows], line, color=CYCLE[k % len(CYCLE)] if len(runs) > 1 else colour,
                          label=words if len(runs) == 1 else None)


def _over_time(runs):
    return all(run.goes_back for run in runs)  # over a strain that goes back curves would be a tangle


def along(run):
    """What the curves of one run are drawn over: its strain (mm/m), or its time (ms) where that goes back."""
    return _along(run, [run])


def _along(run, runs):
    return run.h["time_s"] * MS if _over_time(runs) else _sign(runs) * run.strain * MM


def _strain_label(runs):
    consolidated = [run.zero > 0 for run in runs]
    origin = " from the end of consolidation" * any(consolidated) + ", where there is one" * (any(consolidated) and not all(consolidated))
    return f"Strain{origin} (mm/m), {'compression' if _sign(runs) > 0 else 'tension'} positive"


def stress(axes, runs):
    """Stress over strain between platens and in the gauge, lateral strain to the left; dots at the peaks. One run: kinds of
    strain have colours; several: runs have."""
    several, furthest, sign = len(runs) > 1, 0.0, _sign(runs)
    for k, run in enumerate(runs):
        colour, y, strain = CYCLE[k % len(CYCLE)] if several else BLACK, sign * run.stress * MPA, sign * run.strain * MM
        along = run.name if several else "axial" if run.axis == 2 else f"along {'xyz'[run.axis]}"
        peak = f"{run.peak_words} {y[run.peak_row]:.4g} MPa at {strain[run.peak_row]:.3g} mm/m"
        kinds = [(STRAIN[run.axis], f"{along}, between platens: {peak if run.peak_stress else 'no stress'}", colour, "-", 1.8)]
        if run.axis == 2:  # the gauge measures along z
            kinds += [("axial_strain_gauge", "axial, gauge (middle half)", GREY, "--", 1.2),
                      ("lateral_strain", "lateral, gauge", GREEN, "-", 1.2)]
        elif not several:
            kinds += [(STRAIN[axis], f"along {'xyz'[axis]}, between platens", GREEN if axis == 2 else GREY, "-", 1.2)
                      for axis in range(3) if axis != run.axis]
        for n, (column, words, own, line, width) in enumerate(kinds):
            if run.has(column):
                axes.plot(sign * run.since(column)[run.rows] * MM, y[run.rows], line, color=colour if several else own, lw=width,
                          label=words if n == 0 or not several else None)
            if n == 0:
                axes.plot(strain[run.peak_row], y[run.peak_row], "o", color=colour)
        furthest = max(furthest, float(numpy.nanmax(strain[run.rows])))
    if furthest > 0:  # what opens once it has failed is cut off
        low, high = axes.get_xlim()
        axes.set_xlim(max(low, -_LEFT * furthest), min(high, _RIGHT * furthest))
    titled(axes, _strain_label(runs), runs[0].stress_title + ", tension positive" * (sign < 0))


def broken_bonds(axes, runs):
    """Bonds broken in tension and shear over strain."""
    _over_strain(axes, runs, _BROKEN)
    titled(axes, "Time (ms)" if _over_time(runs) else _strain_label(runs), "Broken bonds", 2)


def volume(axes, runs):
    """Volumetric strain of the gauge over strain; dots at the peaks."""
    for k, run in enumerate(runs):
        if run.has("volumetric_strain"):
            colour = CYCLE[k % len(CYCLE)] if len(runs) > 1 else GREEN
            x, y = _along(run, runs), _sign(runs) * run.since("volumetric_strain") * MM
            axes.plot(x[run.rows], y[run.rows], color=colour)
            axes.plot(x[run.peak_row], y[run.peak_row], "o", color=colour)
    axes.set(xlabel="Time (ms)" if _over_time(runs) else _strain_label(runs), ylabel="Volumetric\nstrain (mm/m)")


def stress_strain(runs, name, caption):
    """The Picture of stress, broken bonds and volume under one another, as far as the histories have them."""
    draws = [stress, *(draw for draw, columns in ((broken_bonds, ("broken_tension", "broken_shear")), (volume, ("volumetric_strain",)))
                       if any(run.has(column) for run in runs for column in columns))]
    return chart(name, caption, *draws, runs=runs, heights=[3.3 + 0.17 * len(runs), 1.7, 1.5][:len(draws)],
                 shared={2} if _over_time(runs) else True, margin=0.9)


# ---- energies
def along_title(run):
    """Title of the axis of along()."""
    return "Time (ms)" if run.goes_back else run.strain_title + ", tension positive" * (_sign([run]) < 0)


def wall_word(run):
    """What a wall of finite elements around the specimen is called."""
    return "wrap" if run.has("wrap_hoop_strain") else "tube" if run.has("total_load_n") else "sleeve"


def _terms(run, main):
    """Terms of one of both charts that are not zero throughout."""
    most = {term: numpy.abs(numpy.nan_to_num(run.h[term[0]])).max() for term in (*MAIN, *SMALL, RESIDUAL) if run.has(term[0])}
    work = most.get(MAIN[0], 0)
    return [term for term, size in most.items()
            if size > 0 and main == (term is not RESIDUAL and size >= (MAIN_SHARE if term in MAIN else SMALL_SHARE) * work)]


def energies(axes, run, main=True):
    """Over strain (time, where that goes back), where the work of the platens went; with main=False its small terms and the residual."""
    law, terms = run.entry("Effects/Bond"), _terms(run, main)
    plastic = "plastic work of bonds" + (" and tube" if wall_word(run) == "tube" else "") + (" and platens" if run.has("platen_plastic_work_j") else "") + f" ({law or 'all laws'})"
    bodies = [name for name, there in (("platens", "deformable" in run.entries.values()), (wall_word(run), run.series("sleeve")),
                                       ("machine", run.entry("Platens/Machine stiffness"))) if there]
    small = max(numpy.nanmax(numpy.abs(run.h[column]), initial=0) for column, *_ in terms) < _SMALL_JOULES
    for column, words, colour, line in terms:
        label = words.format(plastic=plastic, fracture=FRACTURE.get(law, "broken bonds"), bodies=" and ".join(bodies) or "platens")
        axes.plot(_along(run, [run]), run.h[column] * (1e3 if small else 1), line, color=colour, label=label)
    axes.locator_params(axis="y", nbins=6)
    titled(axes, along_title(run), "Energy (mJ)" if small else "Energy (J)", 2)


# ---- discs, bars, cells
def opening(axes, run, bonds=False):
    """Splitting stress over the widening of a disc, flexural stress over the deflection of a bar, a dot at the peak; bonds: broken ones."""
    bent = run.has("deflection_m")
    way = run.h["deflection_m" if bent else "opening_m"] * MM
    for column, words, colour, line in _BROKEN if bonds else ():
        if run.has(column):
            axes.plot(way, run.h[column], line, color=colour, label=words)
    if not bonds:
        axes.plot(way, run.stress * MPA, color=BLACK, lw=1.8)
        axes.plot(way[run.peak_row], run.peak_stress * MPA, "o", color=BLACK, label=f"{run.peak_words} {run.peak_stress * MPA:.4g} MPa")
    most = _MOST_OPEN * way[run.peak_row]
    if axes.get_xlim()[1] > most > 0:  # halves move apart
        axes.set_xlim(-0.05 * most, most)
    titled(axes, "Deflection at mid-span (mm)" if bent else "Widening across the loaded diameter (mm)",
           "Broken bonds" if bonds else "Nominal flexural stress (MPa)" if bent else "Splitting stress (MPa)", 2)


def deviator(axes, run):
    """Deviator over strain."""
    _over_strain(axes, [run], (("deviator_pa", "axial stress less the pressure of the cell", BLACK, "-"),
                               ("sleeve_deviator_pa", "carried by the ends of the sleeve", PURPLE, "--")), MPA)
    titled(axes, along_title(run), "Deviator (MPa)", 2)


def confined_volume(axes, run):
    """Volumetric strains over strain: of the gauge, and of all that is within a sleeve."""
    _over_strain(axes, [run], (("volumetric_strain", "gauge (middle half)", GREEN, "-"),
                               ("volumetric_strain_sleeve", "all within the sleeve", PURPLE, "--")), MM, since=True)
    titled(axes, along_title(run), "Volumetric\nstrain (mm/m)", 2)


def cell_pressure(axes, run):
    """Pressure of the cell over time, the consolidation marked."""
    time = run.h["time_s"] * MS
    axes.plot(time, run.h["confining_pressure_pa"] * MPA, color=BLACK)
    axes.set_ylim(top=1.2 * axes.get_ylim()[1])
    if run.zero > 0:
        span(axes, time[0], time[run.zero], "consolidation")
    axes.set(xlabel="Time (ms)", ylabel="Pressure of\nthe cell (MPa)")


def pictures_of_curves(run, laboratory=None):
    """The Pictures of the section "Stress and energy" that the files of a run allow. laboratory: a laboratory.Curve beside."""
    caption = "Stress over strain."
    if run.has("broken_tension"):
        caption += f" Broken bonds and volume are drawn below, over {'time' if run.goes_back else 'the strain between the platens'}."
    if run.axis == 2 and run.has("axial_strain_gauge"):
        caption += (" The strain between platens includes the deformation of the ends; the gauge measures the middle half. Lateral strains "
                    f"are negative where the specimen {'widens' if _sign([run]) > 0 else 'narrows'}.")
    if run.has("volumetric_strain"):
        caption += " Where the volume begins to grow, cracks open."
    columns = ("axial_strain_gauge", "lateral_strain") if run.axis == 2 else STRAIN
    strains = _sign([run]) * numpy.array([run.strain, *(run.since(column) for column in columns if run.has(column))])[:, run.rows]
    furthest = numpy.nanmax(strains[0])
    if furthest > 0 and ((strains < -_LEFT * furthest) | (strains > _RIGHT * furthest)).any():
        caption += " The largest strains are cut off."
    pictures = [stress_strain([run], "stress_strain", f"{caption} Dots: the {run.peak_words}.")]
    if run.has("opening_m") or run.has("deflection_m"):
        words = ("Nominal flexural stress over the deflection of the bar at mid-span" if run.has("deflection_m") else
                 "Splitting stress over the widening of the disc across the loaded diameter")
        draws = [opening] + [partial(opening, bonds=True)] * run.has("broken_tension")
        words += f", broken bonds below, up to {_MOST_OPEN} times its value at the {run.peak_words} (dot)."
        pictures = [chart("opening", words, *draws, run=run, heights=[3.2, 1.7][:len(draws)], shared=True, margin=0.8)]
    if laboratory is not None:
        pictures.append(chart("laboratory", "Stress over strain of the run and of the laboratory. Dots: the peaks. The table above "
                              "compares them.", measured.against_laboratory, run=run, curve=laboratory, heights=3.6))
    halves = [main for main in (True, False) if _terms(run, main)]
    if halves:
        caption = "The energy balance: the parts of the work of the platens."
        if False in halves:
            caption += (" The lower chart has another scale: the small terms, and the residual, which is the error of the balance and "
                        "should stay near zero.")
        pictures.append(chart("energies", caption, *(partial(energies, main=main) for main in halves), run=run,
                              heights=[3.4, 2.0][:len(halves)], shared=True, margin=0.85))
    if run.has("deviator_pa") and has_cell(run):
        pictures.append(chart("confinement", f"Deviator and volume over {'time' if run.goes_back else 'strain'}, compression positive, and "
                              "the pressure of the cell over time. Where the volume begins to grow, cracks open against the pressure.",
                              deviator, confined_volume, cell_pressure, run=run, heights=[2.8, 1.7, 1.5],
                              shared=True if run.goes_back else {1}, margin=0.9))
    if has_stress_path(run):
        pictures.append(chart("stress_path", "Stress path: mean stress and deviator of the stresses along x, y and z. A specimen whose "
                              "sides are free follows the dashed line. Stress on the sides moves the path away from it. "
                              f"Dot: the {run.peak_words}.",
                              draw_stress_path, runs=[run], heights=3.4))
    return pictures


# ---- sides
def has_cell(run):
    """Whether a cell, a sleeve or a wall presses the sides."""
    return run.has("confining_pressure_pa") and bool((run.h["confining_pressure_pa"] > 0).any())


def has_stress_path(run):
    """Whether anything presses the sides."""
    return has_further_sides(run) or has_cell(run)


def axis_stresses(run):
    """Pa along x, y, z, 3 x rows: the mean of the platens there, else the pressure of a cell or wall, else 0."""
    beside = run.h["confining_pressure_pa"] if run.has("confining_pressure_pa") else numpy.zeros(run.h.rows)
    return numpy.array([0.5 * (run.h[low] + run.h[high]) if run.has(low, high) else beside for low, high in STRESS])


def stress_path(run):
    """(p, q) in Pa: p = (s1 + s2 + s3) / 3, q = sqrt(3 J2) of the stresses along the axes, taken for principal ones."""
    x, y, z = axis_stresses(run)
    return (x + y + z) / 3, numpy.sqrt(0.5 * ((x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2))


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
    titled(axes, "Mean stress p = (s1 + s2 + s3) / 3 (MPa), compression positive", "Deviator q = sqrt(3 J2) (MPa)")


def side_stresses(axes, run):
    """A curve for each side over strain: a colour an axis, the high side dashed; dots at the peak."""
    sides = sides_of(run)
    for side in sides:
        stress, look = run.h[SIDES[side].column] * MPA, SIDES[side].look
        covered = side in ("left", "right") and "front" in sides  # where both pairs bear the same
        axes.plot(run.strain * MM, stress, label=side, lw=3.2 if covered else 1.4, **look)
        if not SIDES[side].high:
            axes.plot(run.strain[run.peak_row] * MM, stress[run.peak_row], "o", color=look["color"])
    titled(axes, run.strain_title, "Stress (MPa), compression positive", 6)


def section_of_sides(run):
    """The Section "Sides", with a row for each side: largest stress, stress at the peak, work of friction until the end; None where no
    platens but the bottom and the top one press."""
    if not has_further_sides(run):
        return None
    rows = []
    for side in sides_of(run):
        stress, work = run.h[SIDES[side].column] * MPA, f"friction_work_{side}_j"
        rows.append([side, digits(stress.max()), digits(stress[run.peak_row]), digits(run.h[work][-1]) if run.has(work) else "-"])
    picture = chart("side_stresses", "Stress on each platen: its force over the face of the specimen. A colour is a pair of opposite "
                    f"platens. They differ only by the friction that the other platens take up. Dots: the {run.peak_words}.",
                    side_stresses, run=run, heights=3.6)
    header = ["side", "largest stress (MPa)", f"stress at the {run.peak_words} (MPa)", "work of friction (J)"]
    return Section("Sides", [picture], [Table(header, rows)])


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


def _across(run):
    """(how it is measured, strain across the loaded axis, negative where the specimen widens): around it, of the gauge, or of the
    platens there."""
    if run.has("circumferential_strain"):
        return "circumferential", -run.since("circumferential_strain")
    if run.axis == 2:
        return "lateral", run.since("lateral_strain")
    return "lateral", numpy.mean([run.since(column) for axis, column in enumerate(STRAIN) if axis != run.axis and run.has(column)], 0)


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
    titled(axes, run.strain_title, run.stress_title)


def stages_across(axes, run):
    """Deviator (or stress, where nothing presses the sides) over the strains along and across, which is to the left."""
    stress, (how, across) = stress_path(run)[1] if has_stress_path(run) else run.stress, _across(run)
    for strain in (run.strain, across):
        _plot_stages(axes, run, strain * MM, stress * MPA)
    furthest = float(numpy.nanmax(run.strain)) * MM
    if furthest > 0 and how == "lateral":  # what opens once it has failed is cut off
        axes.set_xlim(left=max(axes.get_xlim()[0], -1.2 * furthest))
    way, along = "across" if how == "lateral" else "around", "the axis" if run.axis == 2 else "xyz"[run.axis]
    axes.set(xlabel=f"Strain {way} (left) and along {along}{run.strain_origin} (mm/m), compression positive",
             ylabel="Deviator q (MPa)" if has_stress_path(run) else run.stress_title)


def stages_over_time(axes, run):
    """Stresses over time, the number of each stage above."""
    time, stresses, found, end = run.h["time_s"] * MS, axis_stresses(run) * MPA, stages_of(run), -1.0
    for axis, pair in enumerate(("left and right platens", "front and back platens", "bottom and top platens")):
        if has_further_sides(run) and axis != run.axis and run.has(*STRESS[axis]):
            axes.plot(time, stresses[axis], "--", color=GREY if axis == (run.axis + 1) % 3 else BLACK, label=pair)
    if has_stress_path(run) and not has_further_sides(run):
        axes.plot(time, stresses[0], "--", color=GREY, label="pressure on the sides")
    _plot_stages(axes, run, time, run.stress * MPA, widths=False)
    for k, (number, first, last) in enumerate(found if len(found) > 1 else []):
        if k % 2:
            axes.axvspan(time[first], time[last], color=PALE, zorder=0)
        middle = 0.5 * (time[first] + time[last])
        if middle - end > 0.02 * time[-1]:  # numbers of short stages would cover each other
            above(axes, middle, str(number))
            end = middle
    titled(axes, "Time (ms)", run.stress_title, 2)


def table_of_stages(run):
    """A row for each stage: what it asked, what ended it, and where."""
    confined, stress, (how, across), q = has_stress_path(run), run.stress * MPA, _across(run), stress_path(run)[1] * MPA
    said = {one.get("stage"): one for one in listed(run.info, "stages")}
    header = ["stage", "prescribed", "until", "ended by", "at (ms)", "strain (mm/m)", f"{how} strain (mm/m)", "stress (MPa)",
              "largest stress (MPa)"]
    rows = []
    for number, first, last in stages_of(run):
        numbers = [run.h["time_s"][last] * MS, run.strain[last] * MM, across[last] * MM, stress[last], stress[first:last + 1].max()]
        rows.append([str(number), stage_words(run, number) or "-", run.entry(f"Loading/Stage {number}/Until") or "-",
                     said.get(number, {}).get("ended_by") or "-", *map(digits, numbers + [q[last]] * confined)])
    return Table(header + ["deviator q (MPa)"] * confined, rows)


def section_of_stages(run):
    """The Section "Stages"; None where the scene has none."""
    count, draws = len(stages_of(run)), [(stages_stress, 2.9), (stages_over_time, 2.2)]
    if not count:
        return None
    around = run.has("circumferential_strain")
    if has_stress_path(run) or around:
        draws.insert(1, (stages_across, 2.8))
    caption = "The test stage by stage."
    if count > 1:
        caption = ("The test stage by stage, a colour for each. A later stage is drawn narrower: where it returns on the path of an "
                   "earlier one, both are visible. The numbers over the lowest chart are those of the stages.")
    if len(draws) > 2 and not around:
        caption += " The largest lateral strains are cut off."
    return Section("Stages", [chart("stages", caption, *(draw for draw, _ in draws), run=run, titles=True,
                                    heights=[height + 0.17 * count * (draw is stages_stress) for draw, height in draws])],
                   [table_of_stages(run)])


# ---- acoustic events
class PowerLaw(namedtuple("PowerLaw", "b error limit upper events above")):
    """Of events by magnitude: b with its standard error, the range from limit to upper, events in it and above it."""

    def count(self, magnitude):
        """Events of a magnitude or more; bounded above as Page 1968 has it."""
        beta = math.log(10) * self.b
        least = math.exp(-beta * (self.upper - self.limit))  # 0 where nothing bounds them
        return self.above + self.events * (numpy.exp(-beta * (magnitude - self.limit)) - least) / (1 - least)

    @property
    def end(self):
        """Where one event is left, or the range ends."""
        return min(self.upper, self.limit + math.log10(self.events) / self.b)


def power_law(run, before):
    """(law, reason): the PowerLaw of the summary, or None and why there is none."""
    start = f"acoustic/b_{'before' if before else 'after'}"
    b, error, limit, upper, events, more = (number_in(run.info, start + key)
                                            for key in ("", "_error", "_limit", "_upper", "_events", "_above"))
    if b > 0 and not math.isnan(error + limit + events):
        return PowerLaw(b, error, limit, math.inf if math.isnan(upper) else upper, events, 0 if math.isnan(more) else more), ""
    told = run.info.get("acoustic")
    return None, (told.get(start.partition("/")[2] + "_reason") or "") if isinstance(told, dict) else ""


def acoustic(axes, run):
    """How many events have at least a magnitude, before and after the peak; black: the power laws of the summary."""
    time, magnitude = run.events["time_s"], run.events["magnitude"]  # those without energy have none
    for before, when, colour, line in ((True, "before the peak", GREEN, "-"), (False, "after the peak", PURPLE, "--")):
        when = when.replace("peak", run.peak_words)
        sizes, law = numpy.sort(magnitude[numpy.isfinite(magnitude) & ((time <= run.peak_time) == before)]), power_law(run, before)[0]
        if not len(sizes):
            continue
        words = f"{len(sizes)} events {when}" + ": no b-value" * (law is None)
        axes.plot(sizes, numpy.arange(len(sizes), 0, -1), color=colour, label=words)
        if law is not None:
            m = numpy.linspace(law.limit, law.end, 61)
            m = m[law.count(m) > 0.999]  # a bounded law falls to nothing at its end
            upper = "on" if math.isinf(law.upper) else f"to {law.upper:.1f}"
            axes.plot(m, law.count(m), line, color=BLACK, lw=1.1,
                      label=f"b = {law.b:.2f} +- {law.error:.2f} {when}, M from {law.limit:.1f} {upper}: {law.events:.0f} events")
    titled(axes, "Magnitude M", "Events of magnitude M or more", yscale="log")


def pictures_of_events(run):
    """The Pictures of the section "Acoustic emission"; none where the run has no events with a magnitude."""
    if run.table("events") is None or "magnitude" not in run.events or not numpy.isfinite(run.events["magnitude"]).any():
        return []
    caption = ("Cracks that are near in space and time count as one event, of magnitude M = (log10(E/J) - 4.8)/1.5 where they set the "
               "energy E free. The number of events falls with their magnitude. Where it follows a power law, b is its slope (black line).")
    for before, words in ((True, "before"), (False, "after")):
        if reason := power_law(run, before)[1]:
            caption += f" No b-value {words} the {run.peak_words}: {reason}."
    return [chart("acoustic", caption, acoustic, run=run, heights=3.4)]


# ---- computing time
_PARTS = {"motion": "motion of the spheres", "search": "search for neighbours", "bonds": "forces of bonds",
          "contacts": "contacts of spheres", "surfaces": "contacts with platens", "bodies": "platens, sleeve, machine",
          "stable_step": "choice of the time step", "measures": "stresses and strains", "output": "writing of files"}


def costs_of(run):
    """[(name, seconds, whether it is a part of the time steps), ...]: the largest first, the rest last; [] of a run that has not ended."""
    parts = run.info.get("stage_seconds")
    if not isinstance(parts, dict):
        return []
    found = [(_PARTS.get(name, name), number_in(parts, name), True) for name in parts]
    found.append(("setting up", number_in(run.info, "setup_seconds"), False))
    found = sorted((cost for cost in found if cost[1] > 0), key=lambda cost: -cost[1])
    rest = number_in(run.info, "wall_seconds") - sum(cost[1] for cost in found)
    return found + [("other", rest, False)] * (rest > 0)


def machine_words(run):
    """"6.91 million sphere steps a second; 1 thread; AMD EPYC, 2 cores; 201 MB of memory at most"; what is not known is left out."""
    rate, threads, memory = (number_in(run.info, key) for key in ("particle_steps_per_second", "threads", "peak_memory_bytes"))
    log = run.folder / "run.log"
    lines = log.read_text(encoding="utf-8", errors="replace").splitlines() if log.is_file() else []
    machine = next((line.removeprefix("machine ") for line in lines if line.startswith("machine ")), "")
    words = ((rate > 0, f"{rate * 1e-6:.2f} million sphere steps a second"), (threads > 0, f"{threads:.0f} thread{'s' * (threads != 1)}"),
             (machine, machine), (memory > 0, f"{memory * 1e-6:.0f} MB of memory at most"))
    return "; ".join(word for known, word in words if known)


def costs(axes, run):
    """Seconds of each part as bars."""
    names, seconds, of_steps = zip(*costs_of(run))
    whole = sum(seconds)
    bars(axes, names, seconds, [f"{one:.3g} s   {100 * one / whole:.1f} %" for one in seconds], f"Wall time (s), {whole:.4g} s in total",
         [BLUE if part else GREY for part in of_steps])
    axes.set_xlim(0, 1.25 * max(seconds))


def pictures_of_costs(run):
    """The Pictures of the section "Computing time"; none where the summary does not say it."""
    count, words = len(costs_of(run)), machine_words(run)
    caption = "Parts of the computing time. Blue: of the time steps; grey: outside them." + f" {words}." * bool(words)
    return [chart("seconds", caption, costs, run=run, heights=0.4 + 0.26 * count, margin=1.75)] if count else []
