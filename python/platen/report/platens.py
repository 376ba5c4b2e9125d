"""What platens and specimen do to each other: friction, pressure and shear on the ends, loads along strips, which spheres slide."""
import math
import re
from collections import namedtuple
from functools import lru_cache, partial

import numpy
from matplotlib.colors import Normalize

from ..errors import InputError
from .fields import has_stress, picture_of_stress_flow
from .house import BLACK, BLUE, GREEN, GREY, MM, MPA, MS, VERMILION, VIRIDIS, Picture, above, chart, colour_bar, legend_above, span
from .run import number_with_unit, point_data

# Of each side, the low one of each pair first: axis (0 x, 1 y, 2 z), whether it is the high one, column of the history, axes of a
# picture across and up, look of its curves: a colour an axis, the high side dashed.
Side = namedtuple("Side", "axis high column plane look")
SIDES = {name: Side(axis, high, ("axial_" if axis == 2 else "") + f"stress_{name}_pa", [other for other in range(3) if other != axis],
                    {"color": colour, "ls": "--" if high else "-"})
         for axis, pair, colour in ((2, ("bottom", "top"), BLUE), (0, ("left", "right"), VERMILION), (1, ("front", "back"), GREEN))
         for high, name in enumerate(pair)}
_UPRIGHT = 0.7  # of a normal; contacts at the rim of a platen may press aslant, those of a sleeve press sideways
_RINGS = 5  # of equal area; the outermost is wider than a sphere's radius
_FEW = 8  # spheres
_MOST_OVER_MEAN = 2.5  # of colours of pressure


class Contacts(namedtuple("Contacts", "x y normal_force inward_shear sliding shear_force slip")):
    """Of one platen in one frame, in its plane: (x, y) of top and bottom, (y, z) of left and right, (x, z) of front and back, m.
    normal_force: N, pressing; inward_shear: N, on the specimen, towards the origin of the plane; shear_force: N, its size; slip: m,
    until now."""


# ---- sides
def sides_of(run):
    """Names of the sides that have platens, as the columns of the history say: bottom and top, and further ones of a box."""
    return [name for name, side in SIDES.items() if run.has(side.column)]


def has_further_sides(run):
    return len(sides_of(run)) > 2


def contacts_of(run, side, time):
    """Contacts of a platen in the frame nearest to a time. Those that press upwards are the bottom platen's, and so on; those
    of a sleeve press sideways: they are no platen's as long as nobody asks for one there. InputError where an array is missing."""
    grid, where, side = run.grid("contacts", time), run.folder / "contacts.pvd", SIDES[side]
    normal, shear, force, sliding, slip = point_data(grid, where, normal=3, shear=3, normal_force=1, sliding=1, slip=1)
    here = (-1 if side.high else 1) * normal[:, side.axis] > _UPRIGHT
    (x, y), along = grid.points[here][:, side.plane].T, shear[here][:, side.plane]
    away = numpy.hypot(x, y)
    inwards = -numpy.divide(along[:, 0] * x + along[:, 1] * y, away, out=numpy.zeros(len(x)), where=away > 0)
    return Contacts(x, y, force[here], inwards, sliding[here] != 0, numpy.linalg.norm(shear[here], axis=1), slip[here])


# ---- friction
def _number(run, path, unit):
    """SI, of an entry of the scene; NaN where it has none. InputError where it is no number of the unit, "1" or "m"."""
    text = run.entry(path)
    value = number_with_unit(text) if text else math.nan
    if text and (math.isnan(value) or not re.search({"1": r"([\d.%]|percent)$", "m": r"([\d.]|m|inch)$"}[unit], text)):
        raise InputError(f"{run.folder / 'scene.prm'}: {path} = {text} is no number" + (" in a unit of length" if unit == "m" else ""))
    return value


def friction_limits(run, side):
    """Coefficients of friction of a platen (at rest, sliding), as the scene says for it, else for all; NaN where it says none."""

    def entry(key):
        own = _number(run, f"Platens/{side.capitalize()}/{key}", "1")
        return _number(run, f"Platens/{key}", "1") if math.isnan(own) else own

    rest, sliding = entry("Friction static"), entry("Friction dynamic")
    return rest, rest if math.isnan(sliding) else sliding


def is_glued(run):
    """Whether the scene glues the ends to the platens."""
    return run.entry("Platens/Attachment") == "glued"


def sides_with_friction(run):
    """Those to which spheres are neither glued nor pressed without friction, as the scene says."""
    return [side for side in sides_of(run) if not is_glued(run) and friction_limits(run, side) != (0, 0)]


def friction_words(run):
    """Coefficients of friction of each platen, ["bottom 0.57, sliding 0.5"], or ["glued"]; [] where the scene says none."""
    if is_glued(run):
        return ["glued"]
    limits = {side: friction_limits(run, side) for side in sides_of(run)}
    return [f"{side} {rest:.4g}" + (f", sliding {sliding:.4g}" if sliding != rest else "")
            for side, (rest, sliding) in limits.items() if not math.isnan(rest)]


def friction_state(contacts):
    """What one platen's contacts do together: share of them that slide; friction over pressing force; mean slip, each as heavy as it
    presses (m); each with its standard error by the scatter of the contacts (NaN of one). NaN where nothing presses."""

    def ratio(parts, wholes):
        n, whole = len(parts), wholes.sum()
        if not whole > 0:
            return math.nan, math.nan
        value = parts.sum() / whole
        return value, math.sqrt(n / (n - 1) * ((parts - value * wholes) ** 2).sum()) / whole if n > 1 else math.nan

    force, one = contacts.normal_force, numpy.ones(len(contacts.x)) * (contacts.normal_force.sum() > 0)
    return numpy.array([ratio(contacts.sliding * one, one), ratio(contacts.shear_force, force), ratio(contacts.slip * force, force)])


@lru_cache(maxsize=4)
def _states(run):
    """By side: frames x (share, friction, slip) x (value, error)."""
    return {side: numpy.array([friction_state(contacts_of(run, side, time)) for time in run.series("contacts").times])
            for side in sides_with_friction(run)}


def has_friction(run):
    """Whether spheres press on a top or bottom with friction in any frame."""
    return any(numpy.isfinite(states[:, 1, 0]).any() for side, states in _states(run).items() if side in ("bottom", "top"))


def _over_time(axes, run, title, words=False):
    """Title of the y axis, the time on x, and the stretches of the test, which may be named at the top."""
    if run.zero > 0:
        span(axes, run.h["time_s"][0] * MS, run.h["time_s"][run.zero] * MS, "consolidation" if words else "")
    axes.axvline(run.peak_time * MS, color=GREY, lw=0.8)
    if words:
        above(axes, run.peak_time * MS, run.peak_words, va="top", bbox={"fc": "w", "ec": "none", "pad": 1})
    axes.set(xlabel="Time (ms)", ylabel=title, xlim=(0, run.end_time * MS))


def friction(axes, run, which="friction"):
    """Over time, with its standard error: the "share" of the contacts that slide; "friction" over pressing force, with the limits of
    the scene; or the mean "slip"."""
    k = ("share", "friction", "slip").index(which)
    factor, title = ((1, "Fraction that slides"), (1, "Friction / pressure"), (1e6, "Slip (µm)"))[k]
    time, most, limits = run.series("contacts").times * MS, 0, {}
    for side, states in _states(run).items():
        value, error = states[:, k].T * factor
        axes.plot(time, value, label=side, **SIDES[side].look)
        axes.fill_between(time, value - error, value + error, color=SIDES[side].look["color"], alpha=0.15, lw=0)
        most = max(most, numpy.nanmax(value, initial=0))
        for words, limit in zip(("static", "sliding"), friction_limits(run, side) if which == "friction" else ()):
            if not math.isnan(limit):
                limits.setdefault(limit, words)
    axes.set_ylim(0, None if most > 0 else 1)
    for limit, words in limits.items():
        axes.axhline(limit, color=GREY, ls=":", lw=1)
        axes.annotate(f"limit, {words}: {limit:.3g}", (1, limit), xycoords=("axes fraction", "data"), ha="right", va="bottom", fontsize=8)
    _over_time(axes, run, title, words=which == "friction")
    axes.set_ylim(0, max(axes.get_ylim()[1], 1.2 * max(limits, default=0)))
    if which == "share":
        legend_above(axes, ncols=6)


def friction_work(axes, run):
    """Work of friction over time: of each platen where the history has it, and of all."""
    for side in sides_with_friction(run):
        if run.has(f"friction_work_{side}_j"):
            axes.plot(run.h["time_s"] * MS, run.h[f"friction_work_{side}_j"], label=side, **SIDES[side].look)
    if run.has("friction_work_j"):
        axes.legend(handles=axes.plot(run.h["time_s"] * MS, run.h["friction_work_j"], color=BLACK, label="platens and spheres"),
                    loc="upper left")
    _over_time(axes, run, "Work (J)")


# ---- pressure
def sums(values, part, parts):
    """By part: the sum of its values, their number, and the standard error of the sum by the scatter of the values (of a single one:
    itself)."""
    n = numpy.bincount(part, minlength=parts)
    total = numpy.bincount(part, values, parts)
    scatter = numpy.bincount(part, (values - (total / numpy.maximum(n, 1))[part]) ** 2, parts)
    return total, n, numpy.where(n > 1, numpy.sqrt(n / numpy.maximum(n - 1, 1) * scatter), numpy.abs(total))


def ring_profile(contacts, radius, rings=_RINGS):
    """Of rings of equal area from the axis to radius (m): the radius that halves each (m); pressure and inward shear, (value, standard
    error) x rings, Pa; number of spheres. The outermost holds what lies beyond."""
    part = numpy.minimum(rings - 1, (contacts.x**2 + contacts.y**2) / radius**2 * rings).astype(int)
    area = math.pi * radius**2 / rings
    (pressure, n, error), (shear, _, of_shear) = sums(contacts.normal_force, part, rings), sums(contacts.inward_shear, part, rings)
    middle = radius * numpy.sqrt((numpy.arange(rings) + 0.5) / rings)
    return middle, numpy.array([pressure, error]) / area, numpy.array([shear, of_shear]) / area, n


def profile(axes, run, shear=False):
    """Pressure on both platens, or shear on the ends that have any, over the radius near the peak. Round specimens."""
    for side in [side for side in ("bottom", "top") if not shear or is_glued(run) or side in sides_with_friction(run)]:
        middle, *stresses, n = ring_profile(contacts_of(run, side, run.peak_time), run.extent.half_width)
        value, error = stresses[shear] * MPA
        axes.errorbar(middle * MM, value, error, label=f"{side} platen", capsize=3, elinewidth=0.8, marker="os"[side == "top"],
                      **SIDES[side].look)
        axes.scatter(middle[n < _FEW] * MM, value[n < _FEW], 4, "white", zorder=5)
    axes.set(xlabel="Distance from the axis (mm)", ylabel="Inward shear (MPa)" if shear else "Pressure (MPa)",
             xlim=(0, run.extent.half_width * MM))
    if not shear:
        legend_above(axes)


def face_pressure(contacts, low, high, square):
    """Means of the normal force over squares of about that edge (m) of a face from low to high: Pa, rows from below x columns. What lies
    beyond counts at its border."""
    edges = numpy.subtract(high, low)
    columns, rows = counts = numpy.maximum(1, edges / square + 0.5).astype(int)
    place = numpy.floor((numpy.stack([contacts.x, contacts.y], axis=1) - low) / edges * counts)
    column, row = numpy.clip(place, 0, counts - 1).astype(int).T
    force = numpy.bincount(row * columns + column, contacts.normal_force, columns * rows)
    return force.reshape(rows, columns) / (edges / counts).prod()


def _face_size(run):  # across and up, m, of what all sides of the specimen fit into
    return numpy.max([numpy.ptp(run.extent.corners, 0)[SIDES[side].plane] for side in sides_of(run)], axis=0)


def _face(axes, run, side):
    """Limits and titles of a picture of a face; all sides in one scale. Returns its low and high corner, m."""
    corners, size = run.extent.corners[:, SIDES[side].plane], _face_size(run)
    (left, low), (right, high) = ((corners.mean(0) + sign * 0.525 * size) * MM for sign in (-1, 1))
    across, up = ("xyz"[axis] for axis in SIDES[side].plane)
    axes.set(xlabel=f"{across} (mm)", ylabel=f"{up} (mm)", xlim=(left, right), ylim=(low, high))
    axes.set_box_aspect(size[1] / size[0])
    return corners


def face(axes, run, side, bar=True):
    """Pressure on a platen of a box over its face near the peak, over the mean of the platen, in squares of two spheres an edge."""
    low, high = _face(axes, run, side)
    pressure = face_pressure(contacts_of(run, side, run.peak_time), low, high, 4 * run.mean_radius)
    ramp, norm, mean = VIRIDIS.copy(), Normalize(0, _MOST_OVER_MEAN), pressure.mean()
    ramp.colorbar_extend = "max"
    axes.imshow(pressure / mean if mean > 0 else pressure, cmap=ramp, norm=norm, origin="lower", aspect="auto",
                extent=numpy.ravel([low, high], "F") * MM)
    axes.grid(False)
    axes.set_title(f"{side}: mean {mean * MPA:.3g} MPa")
    if bar:
        colour_bar(axes, ramp, norm, "Pressure / mean")


def stick_and_slip(axes, run, side):
    """Every sphere at a platen near the peak in its plane: whether it sticks or slides. Areas go by the pressing force."""
    contacts = contacts_of(run, side, run.peak_time)
    _face(axes, run, side)
    force = numpy.abs(contacts.normal_force)
    area = 22 * len(force) * force / (force.sum() or 1)
    for chosen, mark, colour, words in ((~contacts.sliding, "o", BLUE, f"{side}: {(~contacts.sliding).sum()} stick"),
                                        (contacts.sliding, "x", VERMILION, f"{contacts.sliding.sum()} slide")):
        axes.plot([], [], mark, color=colour, label=words)
        axes.scatter(contacts.x[chosen] * MM, contacts.y[chosen] * MM, area[chosen], colour, mark, lw=1 if mark == "x" else 0,
                     rasterized=len(area) > 500)
    legend_above(axes, columnspacing=0.8, handletextpad=0.1)


# ---- strips
def has_strips(run):
    """Whether strips press, not whole platens: as the scene says."""
    return _number(run, "Platens/Strip width", "m") > 0


def load_along(contacts, half_depth, parts):
    """Load along a strip and its standard error, N/m, in equal parts of the depth from -half_depth to half_depth (m) along y."""
    length = 2 * half_depth / parts
    total, _, error = sums(contacts.normal_force, numpy.clip((contacts.y + half_depth) // length, 0, parts - 1).astype(int), parts)
    return total / length, error / length


def strip_loads(axes, run):
    """Load along each strip near the peak; two supports apart."""
    half = run.extent.half_depth
    parts = max(3, int(half / (2 * run.mean_radius)))  # so that most have a sphere at least
    top, below = (contacts_of(run, side, run.peak_time) for side in ("top", "bottom"))
    strips = {"top": (top, BLUE, "--"), "bottom": (below, BLUE, "-")}
    if _number(run, "Platens/Span", "m") > 0:
        del strips["bottom"]
        for name, here, colour in (("left support", below.x < 0, VERMILION), ("right support", below.x >= 0, GREEN)):
            strips[name] = Contacts(*(values[here] for values in below)), colour, "-"
    edges = numpy.linspace(-half, half, parts + 1) * MM
    for k, (name, (contacts, colour, line)) in enumerate(strips.items()):
        load, error = (values * 1e-3 for values in load_along(contacts, half, parts))
        axes.plot(numpy.repeat(edges, 2)[1:-1], numpy.repeat(load, 2), color=colour, ls=line, label=name)
        places = edges[:-1] + (edges[1] - edges[0]) * (k + 1) / (len(strips) + 1)
        axes.errorbar(places, load, error, fmt="none", ecolor=colour, elinewidth=0.8, capsize=3)
    axes.set(xlabel="y, along the strips (mm)", ylabel="Load (kN/m)", xlim=(edges[0], edges[-1]))
    legend_above(axes)


# ---- pictures
def _faces(name, caption, draw, run, sides, bar):
    """A Picture of sides; of more than two, the low ones are below the high ones of their axis."""
    size = _face_size(run)
    rows = [sides] if len(sides) <= 2 else [[side for side in sides if SIDES[side].high == high] for high in (1, 0)]
    width = (7.6 - 0.72 * len(rows[0]) - (0.95 if bar else 0.15)) / len(rows[0])
    draws = [[partial(draw, run=run, side=side, **({"bar": side == rows[0][-1]} if bar else {})) for side in row] for row in rows]
    return Picture(name, caption, draws, width * size[1] / size[0], bar=bar, titles=True)


def pictures_of_ends(run):
    """The Pictures of the section "Platens and ends" that the files of a run allow."""
    if not run.series("contacts"):
        return []
    found = [picture_of_stress_flow(run)] if has_stress(run) else []
    if has_friction(run):
        found.append(chart(
            "friction", "Friction between specimen and platens over time. From the top: the fraction of the spheres at each platen that "
            "slide; friction over pressure, with the limits of the scene; the mean slip, weighted by pressure; the work of friction. A "
            "platen does not slide as a whole while its friction is below the limit. Shaded: one standard error by the scatter of the "
            "spheres.", *(partial(friction, which=which) for which in ("share", "friction", "slip")), friction_work, run=run,
            heights=[1.5, 1.9, 1.5, 1.5], shared=True, titles=True))
    near, of_spheres = run.near_peak("contacts"), "one standard error by the scatter of the spheres"
    if has_strips(run):
        found.append(chart("strip_loads", f"Load along each strip {near}. Under an even load all steps have one height. Error bars: "
                           f"{of_spheres} in a step.", strip_loads, run=run, heights=3, titles=True))
    elif has_further_sides(run) or run.extent.form == "box":
        found.append(_faces("side_pressure", f"Pressure on each platen over the face of the specimen {near}, over the mean of that platen. "
                            "A square has an edge of two spheres, so single spheres show. In dark squares the pressure is small or zero.",
                            face, run, sides_of(run), bar=True))
    elif run.extent.form == "cylinder":
        sheared = is_glued(run) or sides_with_friction(run)
        found.append(chart(
            "platen_pressure", f"Pressure on the platens{' and shear on the ends' if sheared else ''} over the radius {near}, in five "
            f"rings of equal area. {'Inward shear confines an end; negative' if sheared else 'Negative'} pressure is tension. Error bars: "
            f"{of_spheres} in a ring; a mark with a white centre: fewer than {_FEW} spheres.", profile,
            *([partial(profile, shear=True)] if sheared else []), run=run, heights=2.4, shared=True, titles=True))
    if sides_with_friction(run):
        found.append(_faces("stick_slip", f"Spheres at each platen {near}: which stick and which slide. The larger a mark, the larger its "
                            "pressing force.", stick_and_slip, run, sides_with_friction(run), bar=False))
    return found
