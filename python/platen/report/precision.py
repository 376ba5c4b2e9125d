"""Studies whose result is an error: of accuracy (error over cost), of a target (a required accuracy)."""
import math
from functools import partial

import numpy

from .house import BLACK, BLUE, CYCLE, GPA, MARKS, MM, MPA, PALE, bars, chart, digits, legend_over, plain_decades, scatter_bars, titled
from .pages import Section, Table
from .run import number_in
from .words import over_packings, with_unit

MEASURES = {"strength": "strength", "strain_at_peak": "strain at the peak", "modulus": "Young's modulus", "broken_bonds": "broken bonds"}
PARTS = {"packing": "scatter of packings", "chaos": "chaos of crushing", "speed": "law of speed", "step": "time step"}


# ---- accuracy
def _points(parameter, measure):
    """(value, seconds, error in %) of its values, as far as they have a place on logarithmic axes; the reference has no error."""
    points = [(one["text"], one["seconds"], 100 * number_in(one["errors"][measure], "root_mean_square")) for one in parameter["values"]]
    return [point for point in points if point[1] > 0 and point[2] > 0]


def errors(axes, parameters, measure):
    """Errors of a measure (root mean square, %) over seconds of a run: a line from coarse to fine for each parameter, a symbol for
    each value of one without an order. Grey: within the scatter of packings, mean over the references."""
    drawn = 0
    for one in parameters:
        points, name = _points(one, measure), one["knob"]
        several = max(value["errors"][measure]["runs"] for value in one["values"]) > 1
        for part, label in [(points, name)] if one["ordered"] else [([point], f"{name}: {point[0]}") for point in points]:
            axes.plot([at for _, at, _ in part], [error for *_, error in part], MARKS[drawn % len(MARKS)], ls="-" if several else "",
                      color=CYCLE[drawn % len(CYCLE)], label=label)
            drawn += 1
        for text, at, error in points if one["ordered"] else []:
            axes.annotate(text, (at, error), (5, 4), textcoords="offset points", fontsize=7)
    scatter = [100 * number_in(one["scatter_of_seeds"], measure) for one in parameters]
    axes.set(xscale="log", yscale="log", xlabel="Seconds of a run", ylabel=f"Error of {MEASURES[measure]} (%)")
    axes.margins(0.1, 0.12)
    if numpy.isfinite(scatter).any():
        top, (low, high) = float(numpy.nanmean(scatter)), axes.get_ylim()
        axes.axhspan(min(low, 0.7 * top), top, color=PALE, zorder=0, label="within the scatter of packings")
        axes.set_ylim(min(low, 0.7 * top), max(high, 1.3 * top))
    plain_decades(axes.xaxis)
    plain_decades(axes.yaxis)
    legend_over(axes, 2)


def _table_of_errors(parameter):
    rows = [[value["text"], str(value["errors"]["strength"]["runs"]), *(over_packings(of[key], 100).words("+.2g") for key in MEASURES),
             digits(value["seconds"])] for value in parameter["values"] for of in [value["errors"]]]
    scatter = [100 * number_in(parameter["scatter_of_seeds"], key) for key in MEASURES]
    rows[-1][2:-1] = ["-" if math.isnan(one) else f"({one:.2g})" for one in scatter]
    rows[-1][0] += " (reference)"
    return Table(["value", "packings", "strength", "strain", "E", "broken bonds", "seconds"], rows, f"{parameter['knob']}: errors in %",
                 "Against the reference, on the same packing. In brackets: standard deviation of the packings of the reference.")


def _table_of_prices(prices):
    rows, bounds = {}, list(dict.fromkeys(one["within"] for one in prices))
    for one in prices:
        text = "not reached" if one["value"] is None else f"{digits(one['seconds'])} s ({one['value']})"
        rows.setdefault(f"{one['knob']}, {MEASURES.get(one['of'], one['of'])}", {})[one["within"]] = text
    return Table(["parameter, figure", *(f"{100 * bound:g} %" for bound in bounds)],
                 [[name, *(row.get(bound, "-") for bound in bounds)] for name, row in rows.items()],
                 "Seconds of a run for a given error (value of the parameter)")


def section_of_accuracy(said):
    """(Section, remarks) of a study.json of accuracy."""
    seconds = {(one["knob"], one["value"]): number_in(one, "mean") for one in said["costs"]["wall_seconds"]}
    for one in said["accuracy"]:
        factor, unit = (MM, "mm") if one["unit"] == "m" else (1, one["unit"])
        for value in one["values"]:
            number, text = number_in(value, "number"), value["value"] if one["ordered"] else value["value"].rpartition("/")[2]
            value["text"] = f"{f'{number * factor:.6g}' if math.isfinite(number) else text} {unit}".strip()
            value["seconds"] = seconds.get((one["knob"], value["value"]), math.nan)
    tables, pictures = [*map(_table_of_errors, said["accuracy"]), _table_of_prices(said["costs"]["prices"])], []
    for name, keys in (("accuracy", ("strength", "strain_at_peak")), ("accuracy_more", ("modulus", "broken_bonds"))):
        keys = [key for key in keys if any(_points(one, key) for one in said["accuracy"])]
        pictures += [chart(name, "Error against the reference of each parameter, on the same packing, root mean square over the packings, "
                           "over seconds of a run; from coarse to fine along each line. Grey: within the scatter of packings (mean over "
                           "the references): there specimens differ by more than the error.",
                           *(partial(errors, parameters=said["accuracy"], measure=key) for key in keys), heights=3.2)] if keys else []
    return Section("Errors over cost", pictures, tables), [] if pictures else ["no run has an error: there is nothing to draw"]


# ---- target
def estimate(axes, looks, accuracy, title):
    """A figure and its interval after each batch of runs, over seconds of one core; dashed: as accurate as was ordered.
    looks: (runs, seconds, mean, half of the interval as a logarithm, parts)."""
    seconds, mean, half = (numpy.array([look[k] for look in looks]) for k in (1, 2, 3))
    axes.plot(seconds, mean, "o-", color=BLUE, label="estimate and interval")
    scatter_bars(axes, seconds, mean * numpy.exp(-half), mean * numpy.exp(half), BLUE)
    for sign in (-1, 1):
        axes.axhline(mean[-1] * (1 + sign * accuracy), color=BLACK, ls="--", lw=1, label="required accuracy" if sign > 0 else None)
    axes.margins(0.08, 0.1)
    titled(axes, "Seconds of one core", title[0].upper() + title[1:], 2)


def section_of_target(said):
    """(Section, remarks) of a study.json of a target."""
    target, costs = said["target"], said["costs"]
    figure, accuracy, percent = target["figure"], target["accuracy"], lambda value: f"{100 * value:.2g}"
    unit, factor = ("", 1) if figure.startswith("gain") else ("MPa", MPA) if figure == "strength" else ("GPa", GPA)
    looks = [(one["runs"], float(costs["looks_core_seconds"][k]), one["mean"] * factor, float(one["half_interval"]),
              [number_in(one["parts"], part) for part in PARTS]) for k, one in enumerate(target.get("looks", []))]
    if not looks:
        return Section("", []), ["too few runs gave the figure: there is no interval"]
    _, seconds, mean, half, parts = looks[-1]
    title, slow = with_unit(figure, unit), number_in(costs, "one_slow_speed_core_seconds")
    remarks = [f"{figure} of slow loading: {f'{mean:.4g} {unit}'.strip()} +- {percent(half)} % with {100 * target['confidence']:g} % "
               f"confidence; {percent(accuracy)} % were required: {target['verdict']}"]
    if slow > 0:
        of = target["one_slow_speed"]
        remarks.append(f"{seconds:.0f} s of one core; one slow speed would have taken {slow:.0f} s ({number_in(of, 'wave_crossings'):.0f} "
                       f"wave crossings, {of['packings']} packings)")
    remarks.append(f"spheres 1.25 times as large change it by {100 * number_in(target['sphere_size'], 'change'):+.2g} %: a smaller error "
                   "than that has no meaning while the spheres have one size")
    table = Table(["runs", "seconds", title, "+- (%)", *PARTS],
                  [[str(n), f"{at:.0f}", f"{value:.4g}", percent(width), *map(percent, of)] for n, at, value, width, of in looks],
                  "After each batch of runs", f"+-: half of the interval; after it its parts in %: {', '.join(PARTS.values())}.")
    pictures = [
        chart("target", "The figure of slow loading and its interval after each batch of runs. Dashed: the required accuracy.",
              estimate, looks=looks, accuracy=accuracy, title=title),
        chart("target_parts", "Parts of half the interval at the end, in % of the figure. Their squares add up. Line: required accuracy.",
              bars, names=[*PARTS.values(), "all"], values=[100 * part for part in (*parts, half)],
              texts=[percent(part) + " %" for part in (*parts, half)], title="Half of the interval (%)",
              colours=[BLUE] * len(PARTS) + [BLACK], mark=100 * accuracy, heights=1.6, margin=1.6)]
    return Section("Accuracy over cost", pictures, [table]), remarks
