"""The specimen, whole or cut at y = 0: displacement, damage, what moves with each platen with the cones fitted to it, fragments;
halves of several runs side by side. The rubber sleeve around it, beside the half specimen and its inner face unrolled."""
import math
from collections import namedtuple
from functools import partial

import numpy
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize, to_rgb
from matplotlib.ticker import MaxNLocator

from ..errors import InputError
from .curves import wall_word
from .house import BLACK, BLUE, GREEN, MM, MPA, ORANGE, PURPLE, SKY, VERMILION, VIRIDIS, Picture, colour_bar
from .platens import has_further_sides
from .run import number_in, point_data, reading
from .spheres import DAMAGE, FACES, HALO, RUBBER, Scene, hexahedra, panels, seen

FRAGMENTS = numpy.array([to_rgb(c) for c in ("#e1e1e1", GREEN, PURPLE, SKY, "#f0e442", VERMILION, "#8c564b", BLACK)])
WITH_PLATENS = numpy.array([to_rgb(c) for c in ("#e1e1e1", BLUE, ORANGE)])
SMALLEST = 30  # spheres of a fragment that has a colour
_DAMAGE = "coloured by the broken fraction of the bonds of each sphere. Grey: no bond is broken."
_FRAGMENTS = f"Each colour is a fragment of {SMALLEST} or more spheres that intact bonds connect. Grey: smaller fragments."
FOOT = 0.48  # inches, of a colour bar below a panel


def half(spheres, turn=numpy.eye(3)):
    """Rows of what stays when y > 0 is taken away, as the specimen was before the test: spheres do not come and go as they move."""
    return numpy.flatnonzero(spheres.initial @ turn[1] <= 0)


def outward(run, spheres):
    """m, one a sphere: away from the axis; of a disc or a long bar from the plane x = 0."""
    return numpy.sign(spheres.initial[:, 0]) * (spheres.position - spheres.initial)[:, 0] if run.extent.is_plane else spheres.outward


def top_of(values):
    """What 95 of 100 values do not exceed: a few splinters must not take the colours from the rest; not below 0."""
    return max(0.0, float(numpy.sort(values)[int(0.95 * (len(values) - 1))])) if len(values) else 0.0


def fragment_colours(spheres):
    """Row of FRAGMENTS of each sphere: 0 for those of small fragments and of all but the seven largest."""
    number = spheres.fragment
    return numpy.where((number < len(FRAGMENTS) - 1) & (numpy.bincount(number) >= SMALLEST)[number], number + 1, 0)


def draw(axes, run, time, colours, title="", whole=False, sleeve=False, turn=numpy.eye(3), **room):
    """The specimen, the platens and a sleeve at a time, cut at y = 0 or whole; colours: n x 3, one a sphere. Returns the Scene."""
    spheres, scene = run.spheres(time), Scene(axes, run.extent, **room)
    rows = slice(None) if whole else half(spheres, turn)
    scene.spheres(spheres.position[rows] @ turn.T, spheres.radius[rows], colours[rows])
    if run.series("platens"):
        before = 0 if not whole else 0.9 * run.extent.half_depth if has_further_sides(run) else math.inf
        scene.bodies(run.grid("platens", time), run.folder / "platens.pvd", before=before, turn=turn)
    if sleeve:
        scene.bodies(run.grid("sleeve", time), run.folder / "sleeve.pvd", RUBBER, 0)
    scene.show()
    axes.set_title(title, fontsize=max(6, min(9, 130 * axes.bbox.width / axes.figure.dpi / (len(title) or 1))))  # long names of runs
    return scene


def field(axes, run, time, values, label, title="", norm=None, colours=VIRIDIS, bar=False, **more):
    """Coloured by values, one a sphere: in a scale of this panel, which stands below it, or in that of a norm, at the right with `bar`."""
    if norm is not None:
        draw(axes, run, time, colours(norm(values))[:, :3], title, **more)
        if bar:
            colour_bar(axes, colours, norm, label)
        return
    top = top_of(values if more.get("whole") else values[half(run.spheres(time))])
    if 0 < top < 0.01:  # numbers of the scale stay short
        values, top, label = values * 1e3, top * 1e3, label.replace("(mm)", "(µm)")
    norm = Normalize(0, top or 1)
    draw(axes, run, time, colours(norm(values))[:, :3], title, foot=FOOT, **more)
    inch = axes.figure.dpi / axes.bbox.height
    if top == 0:
        axes.text(0.5, 0.02 * inch, f"{label}:\n{'not above 0' if values.any() else 'zero everywhere'}", transform=axes.transAxes,
                  ha="center", va="bottom")
    else:
        axes.figure.colorbar(ScalarMappable(norm, colours), cax=axes.inset_axes([0.2, 0.32 * inch, 0.6, 0.1 * inch]),
                             orientation="horizontal", label=label, extend="max", ticks=MaxNLocator(3))


def displacement(axes, run, time, title="", **more):
    """The size of the displacement (mm), see `field`; whole=True: of the specimen from outside."""
    field(axes, run, time, run.spheres(time).displacement * MM, "Displacement (mm)", title, **more)


def outward_displacement(axes, run, time, title="", **more):
    """The half by outward displacement (mm), see `field`."""
    field(axes, run, time, outward(run, run.spheres(time)) * MM, "Outward displacement (mm)", title, **more)


def damage(axes, run, time, title="", **more):
    """The half by the broken share of the bonds of each sphere."""
    field(axes, run, time, run.spheres(time).damage, "Broken fraction\nof the bonds", title, Normalize(0, 1), DAMAGE, **more)


def fragments(axes, run, time, title="", **more):
    """The half, fragments of 30 and more spheres in colours."""
    draw(axes, run, time, FRAGMENTS[fragment_colours(run.spheres(time))], title, **more)


class Cone(namedtuple("Cone", "half_angle confidence base apex axis")):
    """One that was fitted to what moves with a platen, in the specimen before the test. half_angle: rad; base: r0, radius at the platen
    over that of the specimen; apex: m, 3; axis: from the apex towards the platen."""

    def turned(self, turn):
        return self._replace(apex=turn @ self.apex, axis=turn @ self.axis)

    @property
    def words(self):
        return f"{math.degrees(self.half_angle):.0f} degrees, r0 = {self.base:.2f} (confidence {self.confidence:.2f})"


def cone_of(run, end, final):
    """The Cone on "top" or "bottom" of a run, of the fall to 0.8 of the peak or of the end; False where none was found, None where
    none was looked for."""
    start = "final_" if final else ""
    if not run.info.get(f"{start}dead_zone_{end}"):
        return None
    found = run.info.get(f"{start}cone_{end}")
    if not found:
        return False
    with reading(run.folder / "summary.json"):
        return Cone(math.radians(number_in(found, "half_angle_deg")), number_in(found, "confidence"), number_in(found, "base_ratio"),
                    numpy.array(found["apex_m"], float), numpy.array(found["axis"], float))


def turn_to(cones, height):
    """3 x 3: turns the specimen about its axis so that the apexes and axes of its cones lie nearest to y = 0; an axis counts as
    far as it reaches over a third of the height (m), where cones end."""
    x, y = numpy.array([place for cone in cones if cone for place in (cone.apex[:2], height / 3 * cone.axis[:2])]).reshape(-1, 2).T
    angle = 0.5 * math.atan2(2 * (x * y).sum(), (x * x - y * y).sum())
    c, s = math.cos(angle), math.sin(angle)
    return numpy.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])


def section(cone, base, half_width):
    """Where the flank of a cone meets the plane y = 0: n x 2, x and z (m), from its base at the height `base` up one side over the tip
    and down the other. At the base it is as wide as was measured, r0 times the half width, and nowhere wider. Empty where there
    is no closed section."""
    z = numpy.linspace(base, cone.apex[2], 121)
    squared, rim = math.cos(cone.half_angle) ** 2, cone.base * half_width
    # On the plane, at height z, (w . axis)^2 = cos^2 w^2 with w from the apex is quadratic in w_x.
    a, wy, wz = squared - cone.axis[0] ** 2, -cone.apex[1], z - cone.apex[2]
    along = wy * cone.axis[1] + wz * cone.axis[2]
    half_b = cone.axis[0] * along
    root = half_b**2 + a * (along**2 - squared * (wy**2 + wz**2))
    count = numpy.argmax(root < 0) if (root < 0).any() else len(z)  # above it there is no section
    if a <= 0 or count == 0:
        return numpy.empty((0, 2))
    low, high = (numpy.clip(cone.apex[0] + (half_b + sign * numpy.sqrt(numpy.maximum(root, 0)))[:count] / a, -rim, rim) for sign in (-1, 1))
    x = numpy.concatenate([[-rim], low, high[::-1], [rim]])
    return numpy.column_stack([x, numpy.concatenate([[base], z[:count], z[:count][::-1], [base]])])


def carried(cone, spheres):
    """m, 3: how far the spheres in a cone have moved; medians, so that those that fell out of it do not count."""
    w = spheres.initial - cone.apex
    inside = w @ cone.axis > math.cos(cone.half_angle) * numpy.linalg.norm(w, axis=1)
    return numpy.median((spheres.position - spheres.initial)[inside], 0) if inside.any() else numpy.zeros(3)


def cones(axes, run, time, title="", **more):
    """The half by what moves with the bottom platen (blue) and the top one (orange), with outlines of the cones: of the end after the
    fall to 0.8 of the peak, else of the fall. A cylinder is turned so that the cut lies along their axes."""
    final, extent = time > run.pattern_time, run.extent
    found = {end: cone_of(run, end, final) for end in ("top", "bottom")}
    turn = turn_to(found.values(), extent.height) if extent.form == "cylinder" else numpy.eye(3)
    spheres = run.spheres(time)
    scene = draw(axes, run, time, WITH_PLATENS[spheres.moves_with.astype(int)], title, turn=turn, **more)
    for end, cone in found.items():
        base, sign = (extent.top, -1) if end == "top" else (extent.bottom, 1)
        words = "" if cone is None else "no cone"
        if cone:
            places = numpy.insert(section(cone.turned(turn), base, extent.half_width), 1, 0, axis=1) + turn @ carried(cone, spheres)
            for colour, width in (("white", 3.5), ("black", 1.5)):
                scene.line(places, color=colour, lw=width)
            names = ("half-angle ", "r0 = ", "confidence ") if axes.bbox.width > 2.5 * axes.figure.dpi else ("", "", "")
            values = (f"{math.degrees(cone.half_angle):.0f}°", f"{cone.base:.2f}", f"{cone.confidence:.2f}")
            words = ", ".join(map(str.__add__, names, values))
        height = float(seen([[0, 0, base - sign * 0.05 * max(extent.height, 2 * extent.half_width)]])[1])
        axes.text(0, height, words, ha="center", va="center", fontsize=8, path_effects=HALO)  # on the platen, beside the outline


def cones_caption(run):
    text, found = "", False
    for final, when in ((False, run.pattern_words), (True, "the end")):
        both = {end: cone_of(run, end, final) for end in ("top", "bottom")}
        if any(cone is not None for cone in both.values()):
            words = {end: cone.words if cone else "not measured" if cone is None else "none" for end, cone in both.items()}
            found |= any(both.values())
            text += f" Cones at {when}, half-angles: on the top platen {words['top']}, on the bottom platen {words['bottom']}."
    cut = "along the axes of the cones" if found and run.extent.form == "cylinder" else "at y = 0"
    return (f"Half specimen, cut {cut}. Blue spheres have moved with the bottom platen since the {run.peak_words}, orange ones with the "
            f"top platen.{text}" + found * (" Outlines: the cones fitted to these spheres, with the measured radius at the platen: r0 "
                                            "times that of the specimen."))


def _with_cones(shown):
    return [one for one in shown if one[0].fall_time is not None and one[0].spheres(one[0].end_time).moves_with is not None]


def _row(name, caption, act, shown, has_bar=False, foot=0.0, **more):
    """Pictures: one of act(axes, run, time, title) for each of `shown`, in one size; none of none. has_bar: with a scale at the right."""
    if not shown:
        return []
    extents = [run.extent for run, _, _ in shown]
    size = max(e.half_width for e in extents), max(e.height for e in extents)
    draws = [partial(act, run=run, time=time, title=title, size=size, **more) for run, time, title in shown]
    if has_bar:
        draws[-1].keywords["bar"] = True
    return [panels(name, caption, draws, extents, has_bar, foot)]


def pictures_of_specimen(run):
    """The Pictures of the section "Specimen" that the files of a run allow."""
    if not run.series("specimen"):
        return []
    end = (run, run.end_time, "at the end")
    moments = [(run, run.start.time, "before the test"), (run, run.peak_time, run.near_peak("specimen")), end]
    judged = [end] if run.fall_time is None else [(run, run.fall_time, f"at {run.pattern_words}"), end]
    scales = "Each panel has its own scale. The largest 5 % have the last colour."
    dark = any(cone_of(run, side, final) for side in ("top", "bottom") for final in (False, True))
    with_green = any((fragment_colours(run.spheres(time)) == 1).any() for _, time, _ in judged)
    aside = " The platen in front of it is not drawn." if has_further_sides(run) else ""
    return [
        *_row("specimen_outside", f"The specimen from outside, along y and a little from above; x points to the left.{aside} Colours: "
              f"displacement of each sphere. {scales}", displacement, moments, foot=FOOT, whole=True),
        *_row("specimen_inside", f"The same specimen cut in half at y = 0. {scales}", displacement, moments, foot=FOOT),
        *_row("outward_displacement", "Half specimen, coloured by the displacement of each sphere away from the "
              f"{'plane x = 0' if run.extent.is_plane else 'axis'}.{' Cones are dark; the material that they push aside is light.' * dark} "
              f"Inward displacement has the colour of 0. {scales}", outward_displacement, judged, foot=FOOT),
        *_row("damage", f"Half specimen, {_DAMAGE}", damage, judged, True),
        *_row("cones", cones_caption(run), cones, _with_cones(judged)),
        *_row("fragments", f"Half specimen. {_FRAGMENTS}{' Green: the largest.' * with_green}", fragments, judged)]


def comparison(runs):
    """Pictures of the halves of several runs side by side, in one scale; runs without frames, or without the quantity, are left out."""
    runs = [run for run in runs if run.series("specimen")]
    end = [(run, run.end_time, run.name) for run in runs]
    judged = [(run, run.pattern_time, run.name + (" (at the end)" if run.fall_time is None else "")) for run in runs]
    values = [outward(run, run.spheres(time))[half(run.spheres(time))] * MM for run, time, _ in end]
    return [
        *_row("comparison_displacement", "Half specimens at the end, coloured by outward displacement, all in one scale. Dark: little "
              "outward displacement. The largest 5 % have the last colour.", outward_displacement, end, True,
              norm=Normalize(0, top_of(numpy.concatenate([[], *values])) or 1)),
        *_row("comparison_damage", f"Half specimens at the fall to 0.8 of the peak, {_DAMAGE}", damage, judged, True),
        *_row("comparison_cones", "Half specimens at the fall to 0.8 of the peak. Blue spheres have moved with the bottom platen since the "
              "peak, orange ones with the top platen. Outlines: the cones fitted to these spheres. Numbers: half-angle, r0 (radius at the "
              "platen over that of the specimen), confidence.", cones, _with_cones(judged)),
        *_row("comparison_fragments", f"Half specimens at the end. {_FRAGMENTS}", fragments, end)]


# ---- the sleeve
class Faces(namedtuple("Faces", "inner outer initial")):
    """inner, outer: points of the frame at the corners of each face, n x 4: low, low, high, high along z, around. initial: places of
    all points before the test (m)."""


def faces_of(grid, where):
    """Faces of a tube around the axis, from any of its frames. InputError where it is none."""
    corners = hexahedra(grid, where)[:, FACES].reshape(-1, 4)
    initial = grid.points - point_data(grid, where, displacement=3)[0]
    x, y, z = initial.T
    radius = numpy.hypot(x, y)
    nearly = 0.01 * numpy.ptp(radius)  # of the wall

    def ordered(faces):
        faces = numpy.take_along_axis(faces, z[faces].argsort(1, kind="stable"), 1)
        a, b, c, d = faces.T
        turns = lambda p, q: x[p] * y[q] - y[p] * x[q] > 0  # from p to q the shorter way around
        lower, upper = turns(a, b), turns(c, d)
        return numpy.column_stack([numpy.where(lower, a, b), numpy.where(lower, b, a), numpy.where(upper, d, c), numpy.where(upper, c, d)])

    inner = ordered(corners[(radius < radius.min() + nearly)[corners].all(1)])
    outer = ordered(corners[(radius > radius.max() - nearly)[corners].all(1)])
    if len(inner) == 0 or len(outer) == 0:
        raise InputError(f"{where}: no tube around the axis")
    return Faces(inner, outer, initial)


def same(faces, grid, where):
    """The grid; InputError where it is another sleeve than that of the faces."""
    if len(grid.points) != len(faces.initial):
        raise InputError(f"{where}: another sleeve than in the first frame")
    return grid


def state(faces, grid, where):
    """Of each inner face: (stretch less 1 around, along z, of the means of opposite edges; pressure of the spheres on it, Pa; how far
    spheres have slid along it, m)."""
    pressure, slip = point_data(same(faces, grid, where), where, contact_pressure=1, slip=1)

    def stretch(*edges):
        now, before = (sum(numpy.linalg.norm(of[faces.inner[:, a]] - of[faces.inner[:, b]], axis=1) for a, b in edges)
                       for of in (grid.points, faces.initial))
        return now / before - 1

    return stretch((0, 1), (2, 3)), stretch((0, 3), (1, 2)), pressure[faces.inner].mean(1), slip[faces.inner].mean(1)


def unrolled(axes, run, time, title, which, factor, left=True):
    """One of the quantities of `state` (times a factor) over the inner face as it was before the test, at a time; left: with names
    of heights."""
    frames = run.series("sleeve")
    faces = faces_of(run.grid("sleeve", frames.times[0]), frames.path)
    values = state(faces, run.grid("sleeve", time), frames.path)[which] * factor
    x, y, z = faces.initial[faces.inner].transpose(2, 0, 1)
    radius, turn = numpy.hypot(x, y).min(), numpy.arctan2(y, x)
    turn = turn[:, :1] + (turn - turn[:, :1] + numpy.pi) % (2 * numpy.pi) - numpy.pi  # a face hangs together
    places = numpy.stack([turn * radius, z], 2) * MM
    round_ = 2 * numpy.pi * radius * MM
    low, high = min(0, numpy.quantile(values, 0.02)), max(0, numpy.quantile(values, 0.98))
    norm = Normalize(low, high if high > low else low + 1)
    places = numpy.concatenate([places + [k * round_, 0] for k in (-1, 0, 1)])  # those over the seam stand at both ends
    shown = (places[:, :, 0].max(1) > -round_ / 2) & (places[:, :, 0].min(1) < round_ / 2)
    axes.add_collection(PolyCollection(places[shown], array=numpy.tile(values, 3)[shown], cmap=VIRIDIS, norm=norm, edgecolors="face",
                                       lw=0.3, rasterized=True))
    axes.set(xlim=(-round_ / 2, round_ / 2), ylim=(z.min() * MM, z.max() * MM), xlabel="Circumference (mm)")
    axes.set_ylabel("z (mm)" if left else "", labelpad=1)
    axes.tick_params(labelleft=left)
    axes.set_title(title, loc="left")
    axes.grid(False)
    bar = axes.inset_axes([1.015, 0, 0.025, 1])
    axes.figure.colorbar(ScalarMappable(norm, VIRIDIS), cax=bar, ticks=MaxNLocator(4))
    bar.tick_params(labelsize=8)


def pictures_of_sleeve(run):
    """The Pictures of the section "Sleeve" that the files of a run allow."""
    if not run.series("sleeve") or not run.series("specimen"):
        return []
    zero = (float(run.h["time_s"][run.zero]), "after consolidation" if run.zero > 0 else "before the test")
    later = [(run.peak_time, run.near_peak("sleeve")), (run.end_time, "at the end")]
    rows = [[partial(unrolled, run=run, time=time, title=f"{when}: {words}", which=which, factor=factor, left=k == 0)
             for k, (time, when) in enumerate(later)]
            for which, factor, words in ((0, 100, "circumferential stretch (%)"), (2, MPA, "pressure of the spheres (MPa)"),
                                         (3, MM, "slip of the spheres (mm)"))]
    name = wall_word(run)
    gaps = "" if name != "sleeve" else " (in gaps between spheres the pressure of the cell acts on the sleeve alone)"
    return [
        *_row("sleeve", f"Half of the specimen in its {name} (brown), as they are deformed. Spheres are coloured by outward displacement: "
              f"where the {name} bulges, the specimen fails. Each panel has its own scale. The largest 5 % have the last colour.",
              outward_displacement, [(run, time, words) for time, words in (zero, *later)], foot=FOOT, sleeve=True),
        Picture("sleeve_unrolled", f"The inner face of the {name}, unrolled: its circumferential stretch, the pressure of the spheres "
                f"on it{gaps}, and the slip of the spheres along it. Each panel has its own scale; the outer 2 % have the last colours.", rows, 1.5, titles=True, bar=True)]
