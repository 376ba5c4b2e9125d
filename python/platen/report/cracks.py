"""Where, when and which way bonds broke: discs in the half specimen, their density over height and distance from the axis, a rose."""
from collections import namedtuple
from functools import partial

import numpy
from matplotlib.colors import LogNorm, Normalize, to_rgb

from ..errors import InputError
from .house import BLUE, MM, SKY, VERMILION, VIRIDIS, Picture, bars, chart, colour_bar, legend_above, titled
from .run import rows_of
from .spheres import DAMAGE, Scene, panels

FEWEST = 5  # bonds of a cell with a share
WIDTHS = 50e-6, 100e-6, 200e-6  # m, that structures are designed for
NARROWEST = 1e-7  # m, of openings that are drawn


class Cracks(namedtuple("Cracks", "place normal area tension time")):
    """Broken bonds as columns. place: n x 3, m, middle between their spheres before the test, of spheres that are not known where it
    broke; normal: n x 3; area: m2; tension: else shear; time: s."""

    def where(self, chosen):
        return Cracks(*(column[chosen] for column in self))


def cracks_until(run, time):
    """Those of cracks.csv up to a time (s). InputError where a mode is neither tension nor shear."""
    table = run.table("cracks")
    mode = numpy.asarray(table["mode"], str)
    wrong = numpy.flatnonzero((mode != "tension") & (mode != "shear"))
    if len(wrong):
        raise InputError(f'{run.folder / "cracks.csv"}:{wrong[0] + 2}: mode "{mode[wrong[0]]}" is neither tension nor shear')
    place, normal = (numpy.column_stack([table[name] for name in names]) for names in (("x_m", "y_m", "z_m"), ("nx", "ny", "nz")))
    if run.series("specimen") and len(mode):
        (first, is_first), (second, is_second) = (rows_of(run.start.fields["id"], table[name]) for name in ("particle_a", "particle_b"))
        known = is_first & is_second
        place[known] = (run.start.initial[first] + run.start.initial[second])[known] / 2
    return Cracks(place, normal, table["area_m2"], mode == "tension", table["time_s"]).where(table["time_s"] <= time)


class Density(namedtuple("Density", "values is_share")):
    """values: rows from the bottom x columns from the axis (is_plane: from the plane x = 0) to the radius (m); broken over initial
    bonds of the cell (is_share), NaN where these are few, else broken ones a cubic metre."""


def density(places, bonds, extent):
    """Counts cracks (n x 3, m) on cells about as high as wide; bonds: n x 3, of all before the test, None where they are not known.
    What lies outside the extent is counted in the outermost cell: a box reaches to its corners, the map to its half width."""
    columns = 12 if extent.is_plane else 8
    rows = min(64, max(4, round(columns * extent.height / extent.half_width)))

    def count(p):
        r = numpy.abs(p[:, 0]) if extent.is_plane else numpy.hypot(p[:, 0], p[:, 1])
        column = (r / extent.half_width * columns).astype(int).clip(0, columns - 1)
        row = numpy.floor((p[:, 2] - extent.bottom) / extent.height * rows).astype(int).clip(0, rows - 1)
        return numpy.bincount(row * columns + column, minlength=rows * columns).reshape(rows, columns)

    broken = count(places)
    if bonds is not None:
        of = count(bonds)
        return Density(numpy.divide(broken, of, out=numpy.full(broken.shape, numpy.nan), where=of >= FEWEST), True)
    wide = extent.half_width / columns
    area = 4 * extent.half_depth * wide if extent.is_plane else numpy.pi * wide**2 * (2 * numpy.arange(columns) + 1)
    return Density(broken / (extent.height / rows * area), False)


def _density(run):
    bonds = run.series("bonds")
    midpoints = bonds[0].points[bonds[0].lines()].mean(1) if bonds else None
    return density(cracks_until(run, run.pattern_time).place, midpoints, run.extent)


def edges(extent):
    """Lines (n x 3, m) along the edges of the half specimen."""
    w, d = extent.half_width, extent.half_depth
    turn = numpy.linspace(0, 2 * numpy.pi, 97)
    if extent.form == "disc":
        h = extent.height / 2
        return [numpy.column_stack([w * numpy.cos(turn), numpy.full(97, y), extent.bottom + h + h * numpy.sin(turn)]) for y in (0, -d)]
    corners = numpy.array([[w, 0], [w, -d], [-w, -d], [-w, 0], [w, 0]])
    if extent.form == "cylinder":
        corners = numpy.vstack([w * numpy.column_stack([numpy.cos(turn), -numpy.sin(turn)])[:49], corners[:1]])
    rims = [numpy.insert(corners, 2, z, axis=1) for z in (extent.bottom, extent.top)]
    return rims + [numpy.array([[x, 0, extent.bottom], [x, 0, extent.top]]) for x in (-w, w)]


def draw_half(axes, extent, cracks, colours):
    """Those in the half y < 0, as discs of their areas."""
    scene, shown = Scene(axes, extent, margin=0.06), cracks.place[:, 1] <= 0
    scene.spheres(cracks.place[shown], numpy.sqrt(cracks.area / numpy.pi)[shown], colours[shown], cracks.normal[shown])
    scene.show()
    for line in edges(extent):
        scene.line(line)


def discs(axes, run, which):
    """The bonds broken up to the fall to 0.8 of the peak in the half y < 0, as discs of their areas: those "in tension", those "in shear";
    or those "before the peak", those "after the peak", coloured by their time over that of the peak."""
    cracks = cracks_until(run, run.pattern_time)
    over_peak = cracks.time / (run.peak_time or 1)
    norm = Normalize(over_peak.min(initial=1), over_peak.max(initial=1))
    if which in ("in tension", "in shear"):
        chosen = cracks.tension == (which == "in tension")
        colours = numpy.broadcast_to(to_rgb(VERMILION if which == "in tension" else BLUE), cracks.place.shape)
    else:
        chosen, colours = (cracks.time < run.peak_time) == (which == "before the peak"), VIRIDIS(norm(over_peak))[:, :3]
    draw_half(axes, run.extent, cracks.where(chosen), colours[chosen])
    axes.set_title(f"{chosen.sum()} {which.replace('peak', run.peak_words)} (both halves)")
    if which == "after the peak":
        colour_bar(axes, VIRIDIS, norm, f"Time over that of the {run.peak_words}")


def density_map(axes, run):
    """Broken bonds over height and distance from the axis; the left half mirrors the right."""
    found, extent = _density(run), run.extent
    values = found.values if found.is_share else found.values * 1e-6
    norm = Normalize(0, max(0.1, numpy.nanmax(values, initial=0)) if found.is_share else values.max() or 1)
    half_width = extent.half_width * MM
    axes.imshow(numpy.hstack([values[:, ::-1], values]), DAMAGE, norm, aspect="auto", origin="lower",
                extent=(-half_width, half_width, 0, extent.height * MM))
    axes.grid(False)
    axes.xaxis.set_major_formatter(lambda x, _: f"{abs(x):g}")
    axes.set(xlabel=f"Distance from the {'plane x = 0' if extent.is_plane else 'axis'} (mm)", ylabel="Height (mm)")
    colour_bar(axes, DAMAGE, norm, "Broken fraction\nof the bonds" if found.is_share else "Broken bonds per cm³")


def scatter_of_rose(area, bins):
    """Standard deviation that each bin of the rose would have by chance if cracks of these areas (m2) faced all ways alike."""
    p = -numpy.diff(numpy.cos(numpy.linspace(0, numpy.pi / 2, bins + 1)))
    return numpy.sqrt((1 - p) / p * (area**2).sum()) / area.sum()


def _ways(run):  # of cracks whose normals are along and across the axis: a bar lies
    return ("is horizontal", "is vertical") if run.extent.form == "box" and run.extent.is_plane else ("lies across", "lies along")


def rose(axes, run):
    """Area of cracks by the angle of their normals to the axis, over that of cracks that face all ways alike."""
    values, area = numpy.array(run.info["crack_rose"], float), run.table("cracks")["area_m2"]
    step, k = 90 / len(values), numpy.arange(len(values))
    names = [f"{step * j:.0f} to {step * (j + 1):.0f}°" for j in k]
    names[0] += f", crack {_ways(run)[0]}"
    names[-1] += f", crack {_ways(run)[1]}"
    texts = [f"{value:.2f}" for value in values]
    bars(axes, names, values, texts, "Area of cracks over that of cracks in random directions", "#777777", mark=1)
    if len(area):
        scatter = 2 * scatter_of_rose(area, len(values))
        low = numpy.maximum(1 - scatter, 0)
        axes.barh(k, 1 + scatter - low, 0.9, low, color=SKY, alpha=0.6, label="scatter of as many cracks in random directions")
    legend_above(axes)


def shares_of_widths(opening, area, edges_of_bins):
    """Shares of the area of all cracks in bins of opening (m); what is narrower or wider than all bins is in none."""
    return numpy.histogram(opening, edges_of_bins, weights=area)[0] / area.sum()


def widths(axes, run):
    """Shares of the area of broken bonds by their opening at the end, eight bins a decade."""
    opening, area = (run.table("crack_state")[name] for name in ("opening_m", "area_m2"))
    low, high = numpy.log10(NARROWEST), numpy.ceil(numpy.log10(opening.max()))
    bins = numpy.logspace(low, high, int(8 * (high - low)) + 1)
    axes.stairs(100 * shares_of_widths(opening, area, bins), bins * 1e6, fill=True, color=BLUE, alpha=0.8)
    axes.set_xscale("log")
    for limit in WIDTHS:
        wider = 100 * area[opening > limit].sum() / area.sum()
        axes.axvline(limit * 1e6, color=VERMILION, linewidth=1)
        axes.annotate(f" {wider:.0f} %", (limit * 1e6, 1), xycoords=("data", "axes fraction"), va="top", fontsize=7, color=VERMILION)
    titled(axes, "Opening of the crack (µm)", "Area of broken\nbonds (%)")


def openings(axes, run, wide):
    """Broken bonds that are open at the end, as discs coloured by their opening: those wider than 50 um, or the others above .1 um."""
    state = run.table("crack_state")
    opening = state["opening_m"]
    place, normal = (numpy.column_stack([state[name] for name in names]) for names in (("x_m", "y_m", "z_m"), ("nx", "ny", "nz")))
    norm = LogNorm(NARROWEST * 1e6, numpy.nanmax(opening) * 1e6)
    chosen = opening > WIDTHS[0] if wide else (opening > NARROWEST) & (opening <= WIDTHS[0])
    cracks = Cracks(place, normal, state["area_m2"], state["mode"] == "tension", state["time_s"]).where(chosen)
    draw_half(axes, run.extent, cracks, VIRIDIS(norm(opening[chosen] * 1e6))[:, :3])
    axes.set_title(f"{chosen.sum()} {'wider than' if wide else 'up to'} {WIDTHS[0] * 1e6:.0f} µm (both halves)")
    if wide:
        colour_bar(axes, VIRIDIS, norm, "Opening (µm)")


def pictures_of_cracks(run):
    """The Pictures of the section "Cracks" that the files of a run allow."""
    if run.table("cracks") is None or not run.series("specimen"):
        return []
    extent, until = run.extent, run.pattern_words
    wide = min(5.5, 4.4 * 2 * extent.half_width / extent.height)
    found = _density(run)
    white = f" White cells had fewer than {FEWEST} bonds before the test: no fraction." if numpy.isnan(found.values).any() else ""
    pictures = [
        panels("cracks", f"Bonds broken until {until} as discs of their size, in the half specimen: in tension (left), in shear (right).",
               [partial(discs, run=run, which=which) for which in ("in tension", "in shear")], [extent], margin=0.06),
        panels("crack_times", f"The same discs by the time when they broke, until {until}: before the {run.peak_words} (left) and after it "
               "(right). Where the right half is empty, no bond broke after it.",
               [partial(discs, run=run, which=which) for which in ("before the peak", "after the peak")], [extent], True, margin=0.06),
        Picture("crack_density", f"Bonds broken until {until} over the height and the distance from the "
                f"{'plane x = 0' if extent.is_plane else 'axis'}; the left half mirrors the right.{white}",
                [[partial(density_map, run=run)]], wide * extent.height / (2 * extent.half_width), wide + 0.72 + 0.95, bar=True)]
    if isinstance(run.info.get("crack_rose"), list) and run.info["crack_rose"][:1] not in ([], [None]):
        pictures.append(chart(
            "crack_rose", "The angle between the normal of a crack and the axis of the specimen, all of the run. Beyond the line there are "
            f"more cracks than in random directions. At 90 degrees a crack {_ways(run)[1].replace('along', 'along the axis')}. A bar that "
            "ends in the blue band (two standard deviations) may differ from the line by chance.", rose, run=run,
            heights=3, margin=2.05, titles=True))
    state = run.table("crack_state")
    if state is not None and (state["opening_m"] > NARROWEST).any():
        closed = 100 * state["area_m2"][state["opening_m"] <= NARROWEST].sum() / state["area_m2"].sum()
        pictures.append(chart("crack_widths", "Widths of the cracks at the end of the run: area of broken bonds by their opening. Beside the lines, "
                              f"at 50, 100 and 200 µm: the share that is wider. Pressed together, or below .1 µm, and not drawn: {closed:.0f} %. Of parts that are "
                              "crushed, openings are distances in a heap.", widths, run=run, heights=2.6, margin=0.9))
        pictures.append(panels("crack_openings", "Broken bonds by their opening at the end of the run, in the half specimen, as discs of their size "
                               "where they were before the test: up to 50 µm (left), and wider (right). Below .1 µm none is drawn.",
                               [partial(openings, run=run, wide=wide) for wide in (False, True)], [extent], True, margin=0.06))
    return pictures
