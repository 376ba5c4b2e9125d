"""The rubber sleeve around a specimen: beside the half specimen, and its inner face unrolled."""
from functools import partial
from typing import NamedTuple

import matplotlib
import numpy
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from matplotlib.ticker import MaxNLocator

from ..errors import InputError
from .house import MM, MPA, Picture
from .specimen import FOOT, outward_displacement
from .spheres import _FACES, hexahedra, panels

VIRIDIS = matplotlib.colormaps["viridis"]


class Faces(NamedTuple):
    """inner, outer: points of the frame at the corners of each face, n x 4: low, low, high, high along z, around. initial: places of
    all points before the test (m)."""

    inner: numpy.ndarray
    outer: numpy.ndarray
    initial: numpy.ndarray


def faces_of(grid, where):
    """Faces of a tube around the axis, from any of its frames. InputError where it is none."""
    corners = hexahedra(grid, where)[:, _FACES].reshape(-1, 4)
    if "displacement" not in grid.point_data:
        raise InputError(f"{where}: a frame has no displacement")
    initial = grid.points - grid.point_data["displacement"]
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
    grid = same(faces, grid, where)
    lacking = [name for name in ("contact_pressure", "slip") if name not in grid.point_data]
    if lacking:
        raise InputError(f"{where}: a frame has no {lacking[0]}")

    def stretch(*edges):
        now, before = (sum(numpy.linalg.norm(of[faces.inner[:, a]] - of[faces.inner[:, b]], axis=1) for a, b in edges)
                       for of in (grid.points, faces.initial))
        return now / before - 1

    mean = lambda name: grid.point_data[name][faces.inner].mean(1)
    return stretch((0, 1), (2, 3)), stretch((0, 3), (1, 2)), mean("contact_pressure"), mean("slip")


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
    axes.set(xlim=(-round_ / 2, round_ / 2), ylim=(z.min() * MM, z.max() * MM), xlabel="Around (mm)")
    axes.set_ylabel("z (mm)" if left else "", labelpad=1)
    axes.tick_params(labelleft=left)
    axes.set_title(title, loc="left")
    axes.grid(False)
    bar = axes.inset_axes([1.015, 0, 0.025, 1])
    axes.figure.colorbar(matplotlib.cm.ScalarMappable(norm, VIRIDIS), cax=bar, ticks=MaxNLocator(4))
    bar.tick_params(labelsize=8)


def pictures_of_sleeve(run):
    """The Pictures of the section "Sleeve" that the files of a run allow."""
    if not run.series("sleeve") or not run.series("specimen"):
        return []
    zero = (float(run.h["time_s"][run.zero]), "after consolidation" if run.zero > 0 else "before the test")
    later = [(run.peak_time, "near the peak"), (run.end_time, "at the end")]

    maps = ((0, 100, "stretch around (%)"), (2, MPA, "pressure of the spheres (MPa)"), (3, MM, "slip of the spheres (mm)"))
    rows = [[partial(unrolled, run=run, time=time, title=f"{when}: {words}", which=which, factor=factor, left=k == 0)
             for k, (time, when) in enumerate(later)]
            for which, factor, words in maps]
    return [
        panels("sleeve", "Half of the specimen in its sleeve (brown), as they are deformed. Spheres are coloured by outward displacement: "
               "where the sleeve bulges, the specimen fails. Each panel has its own scale. The largest 5 % have the last colour.",
               [partial(outward_displacement, run=run, time=time, title=words, sleeve=True) for time, words in (zero, *later)],
               [run.extent], foot=FOOT),
        Picture("sleeve_unrolled", "The inner face of the sleeve, unrolled: how much it is stretched around, the pressure of the spheres "
                "on it (in gaps between spheres the pressure of the cell acts on the sleeve alone), and how far spheres have slid "
                "along it. Each panel has its own scale; the outer 2 % have the last colours.", rows, 1.5, titles=True, bar=True)]
