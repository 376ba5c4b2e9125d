"""Curves of runs over strain and time: stress, broken bonds, volume, energies, a cell's pressure, acoustic events, and where the
computing time went. Each function draws on one axes; `pictures_of_...` make the Pictures that the files of a run allow."""
import math
from functools import partial
from typing import NamedTuple

import numpy

from . import laboratory as measured
from .house import BLACK, BLUE, CYCLE, GREEN, GREY, MM, MPA, MS, ORANGE, PURPLE, SKY, VERMILION, chart, legend_over, span
from .run import STRAIN, number_in
from .stages import draw_stress_path, has_stress_path

# Column, words, colour, line of the energies; the share of the work from which on a term stands in the first chart.
MAIN = (("boundary_work_j", "work of the platens", BLACK, "-"), ("bond_energy_j", "elastic energy of bonds", BLUE, "-"),
        ("fracture_work_j", "broken bonds", VERMILION, "-"), ("friction_work_j", "friction", ORANGE, "-"),
        ("damping_work_j", "damping", GREY, "-"), ("plastic_work_j", "plastic work of bonds ({law})", PURPLE, "-"))
SMALL = (("contact_energy_j", "elastic energy of contacts", SKY, "-"),
         ("body_energy_j", "elastic energy of platens, sleeve and machine", GREEN, "-"), ("kinetic_energy_j", "kinetic energy", BLUE, "--"))
RESIDUAL = ("energy_residual_j", "residual", BLACK, "--")
MAIN_SHARE, SMALL_SHARE = 0.01, 0.05


# ---- stress, broken bonds, volume
def _peak_words(run):
    if run.peak_stress == 0:
        return "no stress"
    reached = "no peak reached, largest" if run.peak_reached is False else "peak"
    return f"{reached} {run.peak_stress * MPA:.4g} MPa at {run.strain[run.peak_row] * MM:.3g} mm/m"


def _strain_label(runs):
    consolidated = [run.zero > 0 for run in runs]
    origin = " from the end of consolidation" * any(consolidated) + ", where there is one" * (any(consolidated) and not all(consolidated))
    return f"Strain{origin} (mm/m), compression positive"


def _plot(axes, run, column, y, line, **more):
    """y over a column of strains, from the end of consolidation on."""
    axes.plot(run.since(column)[run.rows] * MM, y[run.rows], line, **more)


def stress(axes, runs):
    """Stress over strain between platens and in the gauge, lateral strain to the left; dots at the peaks. One run: kinds of
    strain have colours; several: runs have."""
    several, furthest = len(runs) > 1, 0.0
    for k, run in enumerate(runs):
        colour, y = CYCLE[k % len(CYCLE)], run.stress * MPA
        along = run.name if several else "axial" if run.axis == 2 else f"along {'xyz'[run.axis]}"
        _plot(axes, run, STRAIN[run.axis], y, "-", color=colour, label=f"{along}, between platens: {_peak_words(run)}", lw=1.8)
        axes.plot(run.strain[run.peak_row] * MM, run.peak_stress * MPA, "o", color=colour)
        furthest = max(furthest, float(numpy.nanmax(run.strain[run.rows])) * MM)
        if run.axis == 2:  # the gauge measures along z
            others = (("axial_strain_gauge", "axial, gauge (middle half)", VERMILION, "--"),
                      ("lateral_strain", "lateral, gauge", GREEN, "-"))
        else:
            others = [] if several else [(STRAIN[axis], f"along {'xyz'[axis]}, between platens", GREEN if axis == 2 else VERMILION, "-")
                                         for axis in range(3) if axis != run.axis]
        for column, words, other, line in others:
            if run.has(column):
                _plot(axes, run, column, y, line, color=colour if several else other, label=None if several else words, lw=1.2)
    if furthest > 0:  # what opens once it has failed is cut off
        low, high = axes.get_xlim()
        axes.set_xlim(max(low, -1.2 * furthest), min(high, 1.5 * furthest))
    axes.set(xlabel=_strain_label(runs), ylabel=runs[0].stress_title)
    legend_over(axes)


def broken_bonds(axes, runs):
    """Bonds broken in tension and shear over strain."""
    several = len(runs) > 1
    for k, run in enumerate(runs):
        for column, words, colour, line in (("broken_tension", "broken in tension", VERMILION, "-"),
                                            ("broken_shear", "broken in shear", BLUE, "--")):
            if run.has(column):
                _plot(axes, run, STRAIN[run.axis], run.h[column], line, color=CYCLE[k % len(CYCLE)] if several else colour,
                      label=None if several else words)
    axes.set(xlabel=_strain_label(runs), ylabel="Broken bonds")
    legend_over(axes, 2)


def volume(axes, runs):
    """Volumetric strain of the gauge over strain; dots at the peaks."""
    for k, run in enumerate(runs):
        if run.has("volumetric_strain"):
            colour, y = CYCLE[k % len(CYCLE)] if len(runs) > 1 else GREEN, run.since("volumetric_strain") * MM
            _plot(axes, run, STRAIN[run.axis], y, "-", color=colour)
            axes.plot(run.strain[run.peak_row] * MM, y[run.peak_row], "o", color=colour)
    axes.set(xlabel=_strain_label(runs), ylabel="Volumetric\nstrain (mm/m)")


def stress_strain(runs, name, caption):
    """The Picture of stress, broken bonds and volume under one another, as far as the histories have them."""
    draws = [partial(stress, runs=runs)]
    if any(run.has("broken_tension") or run.has("broken_shear") for run in runs):
        draws.append(partial(broken_bonds, runs=runs))
    if any(run.has("volumetric_strain") for run in runs):
        draws.append(partial(volume, runs=runs))
    return chart(name, caption, *draws, heights=[3.3 + 0.17 * len(runs), 1.7, 1.5][:len(draws)], shared=True, margin=0.8)


# ---- energies
def _terms(run, main):
    """Terms of one of both charts that are not zero throughout."""
    most = {term: numpy.abs(numpy.nan_to_num(run.h[term[0]])).max() for term in (*MAIN, *SMALL, RESIDUAL) if run.has(term[0])}
    work = most.get(MAIN[0], 0)
    return [term for term, size in most.items()
            if size > 0 and main == (term is not RESIDUAL and size >= (MAIN_SHARE if term in MAIN else SMALL_SHARE) * work)]


def energies(axes, run, main=True):
    """Over strain, where the work of the platens went; with main=False its small terms and the residual."""
    for column, words, colour, line in _terms(run, main):
        axes.plot(run.strain * MM, run.h[column], line, color=colour, label=words.format(law=run.entry("Effects/Bond") or "all laws"))
    axes.set(xlabel=run.strain_title, ylabel="Energy (J)")
    axes.locator_params(axis="y", nbins=6)
    legend_over(axes, 2)


def _energies_pictures(run):
    halves = [main for main in (True, False) if _terms(run, main)]
    caption = "The energy balance: where the work of the platens went."
    if False in halves:
        caption += (" The lower chart has another scale: the small terms, and the residual, which is the error of the balance and should "
                    "stay near zero.")
    return [chart("energies", caption, *(partial(energies, run=run, main=main) for main in halves), heights=[3.4, 2.0][:len(halves)],
                  shared=True, margin=0.85)] if halves else []


# ---- discs, bars, cells
def opening(axes, run):
    """Splitting stress over the widening of a disc, flexural stress over the deflection of a bar; a dot at the peak."""
    bent = run.has("deflection_m")
    way = run.h["deflection_m" if bent else "opening_m"] * MM
    axes.plot(way, run.stress * MPA, color=BLUE, lw=1.8)
    axes.plot(way[run.peak_row], run.peak_stress * MPA, "o", color=BLUE, label=f"peak {run.peak_stress * MPA:.4g} MPa")
    axes.set(xlabel="Deflection at mid-span (mm)" if bent else "Widening across the loaded diameter (mm)",
             ylabel="Nominal flexural stress (MPa)" if bent else "Splitting stress (MPa)")
    legend_over(axes)


def has_cell(run):
    """Whether a cell, a sleeve or a wall presses the sides, so that the history has a deviator."""
    return run.has("deviator_pa", "confining_pressure_pa") and bool((run.h["confining_pressure_pa"] > 0).any())


def deviator(axes, run):
    """Deviator over strain."""
    for column, words, colour, line in (("deviator_pa", "axial stress less the pressure of the cell", BLUE, "-"),
                                        ("sleeve_deviator_pa", "carried by the ends of the sleeve", VERMILION, "--")):
        if run.has(column):
            _plot(axes, run, STRAIN[run.axis], run.h[column] * MPA, line, color=colour, label=words)
    axes.set(xlabel=run.strain_title, ylabel="Deviator (MPa)")
    legend_over(axes, 2)


def confined_volume(axes, run):
    """Volumetric strains over strain: of the gauge, and of all that is within a sleeve."""
    for column, words, colour, line in (("volumetric_strain", "gauge (middle half)", GREEN, "-"),
                                        ("volumetric_strain_sleeve", "all within the sleeve", PURPLE, "--")):
        if run.has(column):
            _plot(axes, run, STRAIN[run.axis], run.since(column) * MM, line, color=colour, label=words)
    axes.set(xlabel=run.strain_title, ylabel="Volumetric strain (mm/m)")
    legend_over(axes, 2)


def cell_pressure(axes, run):
    """Pressure of the cell over time, the consolidation marked."""
    time = run.h["time_s"] * MS
    axes.plot(time, run.h["confining_pressure_pa"] * MPA, color=BLACK)
    if run.zero > 0:
        span(axes, time[0], time[run.zero], "consolidation")
    axes.set(xlabel="Time (ms)", ylabel="Pressure of\nthe cell (MPa)")


def pictures_of_curves(run, laboratory=None):
    """The Pictures of the section "Stress and energy" that the files of a run allow. laboratory: a laboratory.Curve beside."""
    caption = "Stress over strain."
    if run.has("broken_tension"):
        caption += " Broken bonds and volume stand below, over the strain between the platens."
    if run.axis == 2 and run.has("axial_strain_gauge"):
        caption += (" The strain between platens holds what the ends take up; the gauge measures the middle half. Lateral strains are "
                    "negative where the specimen widens.")
    if run.has("volumetric_strain"):
        caption += " Where the volume begins to grow, cracks open."
    pictures = [stress_strain([run], "stress_strain", caption + " Dots: the peak. The largest strains are cut off.")]
    if laboratory is not None:
        pictures.append(chart("laboratory", "Stress over strain of the run and of the laboratory. Dots: the peaks. The table above "
                              "compares them.", partial(measured.against_laboratory, run=run, curve=laboratory), heights=3.6))
    pictures += _energies_pictures(run)
    if run.has("opening_m") or run.has("deflection_m"):
        words = ("Nominal flexural stress over the deflection of the bar at mid-span." if run.has("deflection_m") else
                 "Splitting stress over the widening of the disc across the loaded diameter.")
        pictures.append(chart("opening", words + " Dot: the peak.", partial(opening, run=run), heights=3.2))
    if has_cell(run):
        pictures.append(chart("confinement", "Deviator and volume over strain, compression positive, and the pressure of the cell over "
                              "time. Where the volume begins to grow, cracks open against the pressure.", partial(deviator, run=run),
                              partial(confined_volume, run=run), partial(cell_pressure, run=run), heights=[2.8, 2.0, 1.5], titles=True))
    if has_stress_path(run):
        pictures.append(chart("stress_path", "Stress path: mean stress and deviator of the stresses along x, y and z. A specimen whose "
                              "sides are free follows the dashed line. Stress on the sides leads the path away from it. Dot: the peak.",
                              partial(draw_stress_path, runs=[run]), heights=3.4))
    return pictures


# ---- acoustic events
def magnitudes(run, before):
    """Of the events that began before (or after) the peak, from the smallest on. Those without energy have none."""
    time, found = run.events["time_s"], run.events["magnitude"]
    return numpy.sort(found[numpy.isfinite(found) & ((time <= run.peak_time) == before)])


class PowerLaw(NamedTuple):
    """Of events by magnitude: b with its standard error, the range from limit to upper, events in it and above it."""

    b: float
    error: float
    limit: float
    upper: float
    events: float
    above: float

    def count(self, magnitude):
        """Events of a magnitude or more; bounded above as Page 1968 has it."""
        beta = math.log(10) * self.b
        if math.isinf(self.upper):
            return self.events * numpy.exp(-beta * (magnitude - self.limit))
        least = math.exp(-beta * (self.upper - self.limit))
        return self.above + self.events * (numpy.exp(-beta * (magnitude - self.limit)) - least) / (1 - least)

    @property
    def end(self):
        """Where one event is left, or the range ends."""
        return min(self.upper, self.limit + math.log10(self.events) / self.b)


def power_law(run, before):
    """(law, reason): the PowerLaw of the summary, or None and why there is none."""
    start = f"acoustic/b_{'before' if before else 'after'}"
    law = PowerLaw(*(number_in(run.info, start + key) for key in ("", "_error", "_limit", "_upper", "_events", "_above")))
    law = law._replace(upper=math.inf if math.isnan(law.upper) else law.upper, above=0 if math.isnan(law.above) else law.above)
    if law.b > 0 and not math.isnan(law.error + law.limit + law.events):
        return law, ""
    acoustic = run.info.get("acoustic")
    return None, (acoustic.get(start.partition("/")[2] + "_reason") or "") if isinstance(acoustic, dict) else ""


def acoustic(axes, run):
    """How many events have at least a magnitude, before and after the peak; black: the power laws of the summary."""
    for before, when, colour, line in ((True, "before the peak", BLUE, "-"), (False, "after the peak", VERMILION, "--")):
        sizes, law = magnitudes(run, before), power_law(run, before)[0]
        if not len(sizes):
            continue
        axes.plot(sizes, numpy.arange(len(sizes), 0, -1), color=colour,
                  label=f"{len(sizes)} events {when}" + ": no b-value" * (law is None))
        if law is not None:
            m = numpy.linspace(law.limit, law.end, 61)
            m = m[law.count(m) > 0.999]  # a bounded law falls to nothing at its end
            upper = "on" if math.isinf(law.upper) else f"to {law.upper:.1f}"
            axes.plot(m, law.count(m), line, color=BLACK, lw=1.1,
                      label=f"b = {law.b:.2f} +- {law.error:.2f} {when}, M from {law.limit:.1f} {upper}: {law.events:.0f} events")
    axes.set(xlabel="Magnitude M", ylabel="Events of magnitude M or more", yscale="log")
    legend_over(axes)


def pictures_of_events(run):
    """The Pictures of the section "Acoustic emission"; none where the run has no events with a magnitude."""
    if run.table("events") is None or "magnitude" not in run.events or not numpy.isfinite(run.events["magnitude"]).any():
        return []
    caption = ("Cracks that are near in place and time are one event. The number of events falls with their magnitude. Where it follows a "
               "power law, b is its slope (black line).")
    for before, words in ((True, "before"), (False, "after")):
        if reason := power_law(run, before)[1]:
            caption += f" No b-value {words} the peak: {reason}."
    return [chart("acoustic", caption, partial(acoustic, run=run), heights=3.4)]


# ---- computing time
def costs_of(run):
    """[(name, seconds, whether it is a part of the time steps), ...]: the largest first, the rest last; [] of a run that has not
    ended."""
    parts = run.info.get("stage_seconds")
    if not isinstance(parts, dict):
        return []
    found = [(name.replace("_", " "), number_in(parts, name), True) for name in parts]
    found.append(("setting up", number_in(run.info, "setup_seconds"), False))
    found = sorted((cost for cost in found if cost[1] > 0), key=lambda cost: -cost[1])
    rest = number_in(run.info, "wall_seconds") - sum(cost[1] for cost in found)
    return found + [("the rest", rest, False)] * (rest > 0)


def machine_words(run):
    """"6.91 million sphere steps a second; 1 thread; AMD EPYC, 2 cores; 201 MB at most"; what is not known is left out."""
    rate, threads, memory = (number_in(run.info, key) for key in ("particle_steps_per_second", "threads", "peak_memory_bytes"))
    log = run.folder / "run.log"
    lines = log.read_text(encoding="utf-8", errors="replace").splitlines() if log.is_file() else []
    machine = next((line.removeprefix("machine ") for line in lines if line.startswith("machine ")), "")
    words = ((rate > 0, f"{rate * 1e-6:.2f} million sphere steps a second"), (threads > 0, f"{threads:.0f} thread{'s' * (threads != 1)}"),
             (machine, machine), (memory > 0, f"{memory * 1e-6:.0f} MB at most"))
    return "; ".join(word for known, word in words if known)


def costs(axes, run):
    """Seconds of each part as bars."""
    found = costs_of(run)
    whole = sum(cost[1] for cost in found)
    axes.barh(range(len(found)), [cost[1] for cost in found], 0.7, color=[BLUE if cost[2] else GREY for cost in found])
    for k, (_, seconds, _) in enumerate(found):
        axes.annotate(f"{seconds:.3g} s   {100 * seconds / whole:.1f} %", (seconds, k), (5, 0), textcoords="offset points", va="center",
                      fontsize=8)
    axes.set(xlabel=f"Wall clock (s), {whole:.4g} s together", xlim=(0, 1.25 * max(cost[1] for cost in found)))
    axes.set_yticks(range(len(found)), [cost[0] for cost in found])
    axes.invert_yaxis()
    axes.grid(False, axis="y")


def pictures_of_costs(run):
    """The Pictures of the section "Computing time"; none where the summary does not say it."""
    if not costs_of(run):
        return []
    words = machine_words(run)
    caption = "Where the computing time went. Blue: parts of the time steps; grey: what is not." + f" {words}." * bool(words)
    return [chart("seconds", caption, partial(costs, run=run), heights=0.4 + 0.26 * len(costs_of(run)), margin=1.2)]
