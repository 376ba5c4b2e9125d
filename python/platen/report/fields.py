"""Stress, strain, displacement and damage through specimen and platens on one regular grid: a picture, and files for ParaView."""
import math
import struct
import zlib
from collections import namedtuple
from functools import lru_cache, partial

import numpy
from matplotlib.colors import Normalize

from ..errors import InputError, OutputError
from .house import MM, MPA, VIRIDIS, Picture, colour_bar, over_cores, write_aside
from .run import nearest, number_in, point_data, rows_of

_REACH_IN_FILES, _REACH_IN_PICTURES, _FINENESS = 3.5, 5, 0.25  # of averages; of the nodes of pictures: mean radii
OUTSIDE, SPECIMEN, PLATEN = 0, 1, 2  # `body` of a node
# Solid share from which a node is in the specimen. Dense packings have 0.55 to 0.64 within, half of it at a flat surface, and
# less where the ends were packed against a wall.
_AT_SURFACE = 0.2
_FLAT = 1e-4  # determinant of the spheres' scatter over the cube of its mean; below it they lie in a plane or on a line
_ONE_PLACE = 1e-8  # mean of the scatter over the square of the reach; below it, it is the rounding of a single sphere
_UPPER, _FULL = [0, 1, 2, 4, 5, 8], [0, 1, 2, 1, 3, 4, 2, 4, 5]  # of a symmetric tensor, row by row
_PAIRS = 1_000_000  # of spheres and nodes at a time: limits the memory
_NEARLY = 1e-6  # of an element's edge


class Grid(namedtuple("Grid", "origin spacing nodes")):
    """Regular nodes, x runs fastest. origin: the first one, m; spacing: m; nodes: numbers along x, y, z."""

    @property
    def places(self):
        """n x 3, m."""
        k, j, i = numpy.indices(self.nodes[::-1]).reshape(3, -1)
        return self.origin + self.spacing * numpy.stack([i, j, k], axis=1)

    def within(self, low, high):
        """First and last node in each box (m, n x 3), along x, y, z; n x 3 each."""
        return (numpy.ceil((low - self.origin) / self.spacing).astype(int).clip(0),
                numpy.floor((high - self.origin) / self.spacing).astype(int).clip(max=self.nodes - 1))


class Fields(namedtuple("Fields", "solid_share stress damage displacement strain body")):
    """A row a node; NaN where a node has no such number. Tension positive, tensors row by row. stress: n x 9, Pa; displacement: n x 3, m,
    and strain: n x 9, both None where they were not asked for."""


def wendland(distance, reach):
    """Kernel of Wendland (1995), C2, in three dimensions, 1/m^3; its integral over space is 1."""
    rest = 1 - numpy.minimum(distance / reach, 1)
    return 21 / (2 * math.pi * reach**3) * rest**2 * rest**2 * (5 - 4 * rest)


def _pairs(position, grid, reach):
    """Spheres and nodes of all pairs in reach, with their distances (m), in batches."""
    first, last = grid.within(position - reach, position + reach)
    rows = numpy.flatnonzero((first <= last).all(1))
    size = numpy.minimum(int(2 * reach / grid.spacing) + 1, grid.nodes)
    first = numpy.minimum(first, grid.nodes - size)
    for batch in numpy.array_split(rows, 1 + len(rows) * int(size.prod()) // _PAIRS):
        index = [first[batch, d, None] + numpy.arange(size[d]) for d in range(3)]
        x, y, z = ((position[batch, d, None] - grid.origin[d] - grid.spacing * index[d]) ** 2 for d in range(3))
        square = z[:, :, None, None] + y[:, None, :, None] + x[:, None, None, :]
        near = square < reach**2
        node = ((index[2] * grid.nodes[1])[:, :, None, None] + index[1][:, None, :, None]) * grid.nodes[0] + index[0][:, None, None, :]
        yield numpy.repeat(batch, near.sum((1, 2, 3))), node[near], numpy.sqrt(square[near])


def _inverse(matrices):
    """Inverses (n x 3 x 3) and determinants (n)."""
    cofactors = numpy.cross(matrices[:, [1, 2, 0]], matrices[:, [2, 0, 1]])
    determinant = (matrices[:, 0] * cofactors[:, 0]).sum(1)
    with numpy.errstate(all="ignore"):
        return cofactors.transpose(0, 2, 1) / determinant[:, None, None], determinant


def _fit(w, x, xx, u, ux, place, reach):
    """Of the linear field nearest to displacements u: at places, and the symmetric part of its gradient. Sums over spheres of
    weight, weight times place and so on; a row a node."""
    x, u = x / w, u / w
    scatter = (xx / w)[:, _FULL].reshape(-1, 3, 3) - x[:, :, None] * x[:, None, :]
    moved = (ux / w).reshape(-1, 3, 3) - u[:, :, None] * x[:, None, :]
    (inverse, determinant), mean = _inverse(scatter), scatter.trace(axis1=1, axis2=2) / 3
    flat = ~((determinant > _FLAT * mean**3) & (mean > _ONE_PLACE * reach**2))
    inverse[flat] = 0
    gradient = moved @ inverse
    strain = 0.5 * (gradient + gradient.transpose(0, 2, 1)).reshape(-1, 9)
    strain[flat] = numpy.nan
    return u + (gradient @ (place - x)[:, :, None])[:, :, 0], strain


def coarse_grain(position, radius, columns, grid, reach, displacement=None):
    """(solid share, means of the columns (n x c), displacement, strain) at the nodes of a grid; the last two None without
    displacements. Each sphere counts by its volume times wendland of its distance. Means are weighted by that (Shepard 1968):
    they keep constants, and weighted by the solid share they have the spheres' integral. Displacement and strain are those of
    the linear field that is nearest to the spheres' by the same weights (moving least squares, Lancaster and Salkauskas 1981):
    linear fields come out as they are, up to the surface. NaN where no sphere reaches; strain also where they lie in a plane."""
    parts, middle = [columns], position.mean(0)
    if displacement is not None:
        x = position - middle  # keeps the digits
        parts += [x, (x[:, :, None] * x[:, None, :]).reshape(-1, 9)[:, _UPPER], displacement,
                  (displacement[:, :, None] * x[:, None, :]).reshape(-1, 9)]
    carried = numpy.hstack([numpy.ones((len(radius), 1)), *parts]) * (4 / 3 * math.pi * radius**3)[:, None]
    sums = numpy.zeros((carried.shape[1], grid.nodes.prod()))
    for sphere, node, distance in _pairs(position, grid, reach):
        weight = wendland(distance, reach)
        for row, column in zip(sums, carried.T.copy()):
            row += numpy.bincount(node, weight * column[sphere], len(row))
    reached = numpy.flatnonzero(sums[0] > 0)
    w, *found = numpy.split(sums[:, reached].T, numpy.cumsum([1, *(part.shape[1] for part in parts[:-1])]), axis=1)

    def spread(values):
        full = numpy.full((sums.shape[1], values.shape[1]), numpy.nan)
        full[reached] = values
        return full

    if displacement is None:
        return sums[0], spread(found[0] / w), None, None
    return (sums[0], spread(found[0] / w), *map(spread, _fit(w, *found[1:], grid.places[reached] - middle, reach)))


def with_contacts(spheres, contacts, packing_fraction, folder):
    """Stress of the spheres of a frame (n x 9, Pa) with the forces of platens and sleeve added as those of bonds are: arm times
    force over the sphere's volume and its share of the voids."""
    stress, number, radius = point_data(spheres, folder / "specimen.pvd", stress=9, id=1, radius=1)
    normal, shear, size, particle = point_data(contacts, folder / "contacts.pvd", normal=3, shear=3, normal_force=1, particle=1)
    row, known = rows_of(number, particle)  # a frame of another time may have others
    arm, force = contacts.points - spheres.points[row], size[:, None] * normal + shear
    brought = 0.5 * (arm[:, :, None] * force[:, None, :] + arm[:, None, :] * force[:, :, None]).reshape(-1, 9)
    stress = stress.copy()
    numpy.add.at(stress, row[known], (brought / (4 / 3 * math.pi * radius[row] ** 3 / packing_fraction)[:, None])[known])
    return stress


# Points of an element in halves of its edges, in the order of the files; the first 8 of an element of degree 1.
_POINTS = numpy.array([list(map(int, xyz)) for xyz in "000 200 220 020 002 202 222 022 100 210 120 010 102 212 122 012 001 201 221 021 011 "
                       "211 101 121 110 112 111".split()]) / 2


def _terms(at, degree, along=None):
    """Products of powers up to the degree of three coordinates (3 x n), or their slopes along one; 8 or 27 x n."""
    one = numpy.ones(at.shape[1])
    x, y, z = (numpy.stack(([0 * one, one, 2 * t] if d == along else [one, t, t * t])[: degree + 1]) for d, t in enumerate(at))
    return (x[:, None, None] * y[:, None] * z).reshape((degree + 1) ** 3, at.shape[1])


_OF_POINTS = {size: numpy.linalg.inv(_terms(_POINTS[:size].T, degree).T) for size, degree in ((8, 1), (27, 2))}


def in_hexahedra(grid, cells, where):
    """Nodes of a grid that lie in the elements (8 or 27 points each) of a vtu.Grid, each once; the points of their elements and the
    weights of these. InputError, of the file `where`, for other elements."""
    size = int(cells.offsets[0]) if len(cells.offsets) else 8
    if size not in _OF_POINTS or len(cells.connectivity) != size * len(cells.offsets):
        raise InputError(f"{where}: holds other elements than hexahedra")
    corners, degree = cells.connectivity.reshape(-1, size), 1 if size == 8 else 2
    box = cells.points.astype(float)[corners]
    low, high = grid.within(box.min(1) - _NEARLY * grid.spacing, box.max(1) + _NEARLY * grid.spacing)
    shape = (high - low + 1).clip(0)
    count = shape.prod(1)
    cell = numpy.repeat(numpy.arange(len(count)), count)
    k = numpy.arange(len(cell)) - (numpy.cumsum(count) - count)[cell]
    nx, ny = shape[cell, 0], shape[cell, 1]
    i, j, k = low[cell].T + (k % nx, k // nx % ny, k // (nx * ny))
    place = (grid.origin + grid.spacing * numpy.stack([i, j, k], axis=1)).T
    factors, at = numpy.einsum("kp,cpd->kdc", _OF_POINTS[size], box)[:, :, cell], numpy.full(place.shape, 0.5)
    for _ in range(20):  # Newton's steps; one in a brick
        found, *slopes = (numpy.einsum("kn,kdn->dn", _terms(at, degree, along), factors) for along in (None, 0, 1, 2))
        step = numpy.einsum("dn,ndc->cn", place - found, _inverse(numpy.stack(slopes).transpose(2, 0, 1))[0])
        at = (at + step).clip(-1, 2)
        if not numpy.nanmax(numpy.abs(step), initial=0) > 1e-5:  # it converges by squares
            break
    inside = (numpy.abs(at - 0.5) <= 0.5 + _NEARLY).all(0)
    nodes, first = numpy.unique(((k * grid.nodes[1] + j) * grid.nodes[0] + i)[inside], return_index=True)
    return nodes, corners[cell[inside][first]], _terms(at[:, inside][:, first], degree).T @ _OF_POINTS[size]


def fields_at(run, time, grid, reach, whole=True):
    """Fields of the frame nearest to a time (s). reach: of the averages, m. whole: displacement and strain too. InputError where an
    array is missing."""
    frames, platens = run.series("specimen"), run.series("platens")
    number = nearest(frames.times, time)
    spheres, time = frames[number], float(frames.times[number])
    stress = with_contacts(spheres, run.series("contacts").at(time), number_in(run.info, "packing_fraction"), run.folder)
    radius, intact, broken, moved = point_data(spheres, frames.path, radius=1, intact_bonds=1, broken_bonds=1, displacement=3)
    damage = broken / numpy.maximum(intact + broken, 1)
    share, means, displacement, strain = coarse_grain(spheres.points, radius, numpy.column_stack([damage, stress[:, _UPPER]]), grid,
                                                      reach, moved if whole else None)
    damage, stress = means[:, 0], means[:, 1:][:, _FULL]
    body = numpy.where(share > _AT_SURFACE, SPECIMEN, OUTSIDE).astype(numpy.uint8)
    stress[body == OUTSIDE] = numpy.nan
    for platen in platens.parts(nearest(platens.times, time)) if platens else []:
        nodes, points, weights = in_hexahedra(grid, platen, platens.path)
        body[nodes] = PLATEN
        there = platen.point_data.get("stress")  # rigid ones have none
        stress[nodes] = numpy.nan if there is None else (weights[:, :, None] * there[points]).sum(1)
    for values in (damage, *([displacement, strain] if whole else [])):
        values[body != SPECIMEN] = numpy.nan
    share[body != SPECIMEN] = 0
    return Fields(share, stress, damage, displacement, strain, body)


def has_stress(run):
    """Whether the run has what fields need: frames with stress, contacts, and the packing fraction."""
    return (math.isfinite(number_in(run.info, "packing_fraction")) and bool(run.series("specimen") and run.series("contacts"))
            and "stress" in run.start.fields)


# ---- files
def _vti(grid, arrays):
    """Bytes of an image file of VTK, arrays by name: Float32, or UInt8; compressed, a block an array."""
    extent, head, data = " ".join(f"0 {n - 1}" for n in grid.nodes), [], b""
    for name, values in arrays.items():
        form, kind = ("u1", "UInt8") if values.dtype == numpy.uint8 else ("<f4", "Float32")
        raw, width = values.astype(form).tobytes(), values.shape[1] if values.ndim > 1 else 1
        head.append(f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{width}" format="appended" offset="{len(data)}"/>\n')
        packed = zlib.compress(raw, 1)
        data += struct.pack("<4Q", 1, len(raw), 0, len(packed)) + packed
    place = " ".join(map(repr, map(float, grid.origin)))
    return (f'<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64" compressor="vtkZLibDataCompressor">\n'
            f'<ImageData WholeExtent="{extent}" Origin="{place}" Spacing="{" ".join([repr(grid.spacing)] * 3)}">\n'
            f'<Piece Extent="{extent}">\n<PointData>\n{"".join(head)}</PointData>\n</Piece>\n</ImageData>\n'
            f'<AppendedData encoding="raw">\n_').encode() + data + b"\n</AppendedData>\n</VTKFile>\n"


def write_fields(run):
    """Writes fields.pvd and frames/fields_*.vti into the run's folder, on one grid through platens and specimen with nodes a mean
    radius apart: `stress` (Pa, tension positive; in deformable platens too), `strain`, `displacement` (m), `damage`,
    `solid_share`, and `body` (0 nothing, 1 specimen, 2 platen). NaN where a node has no such number. Returns the path of fields.pvd.
    InputError where its frames do not allow it, OutputError."""
    if not has_stress(run):
        raise InputError(f"{run.folder}: no fields can be made: they need specimen.pvd with stress, contacts.pvd and packing_fraction in "
                         "summary.json")
    # What holds specimen and platens before the test, a little more for what spreads.
    spacing, points = float(run.start.radius.mean()), run.extent.corners
    if run.series("platens"):
        points = numpy.vstack([points, run.series("platens")[0].points.astype(float)])
    low, high = points.min(0), points.max(0)
    grid = Grid(low - spacing, spacing, 3 + numpy.ceil((high - low) / spacing).astype(int))
    path, names = run.folder / "fields.pvd", ("stress", "strain", "displacement", "damage", "solid_share", "body")
    files = {f"frames/fields_{k:06d}.vti": float(time) for k, time in enumerate(run.series("specimen").times)}

    def write(file):
        found = fields_at(run, files[file], grid, _REACH_IN_FILES * spacing)
        write_aside(run.folder / file, _vti(grid, {name: getattr(found, name) for name in names}))

    try:
        (run.folder / "frames").mkdir(exist_ok=True)
        list(over_cores(write, files))
        lines = [f'    <DataSet timestep="{time!r}" group="" part="0" file="{name}"/>\n' for name, time in files.items()]
        write_aside(path, ('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n  <Collection>\n'
                           + "".join(lines) + "  </Collection>\n</VTKFile>\n").encode())
    except OSError as error:
        raise OutputError(f"{error.filename or path}: cannot be written: {error.strerror}") from None
    return path


# ---- picture
@lru_cache(maxsize=2)
def _section(run):
    """(grid, Fields) of the plane beside y = 0, which may lie between the bristles of a brush, near the peak: the specimen and the
    near quarter of its height of each platen."""
    extent, spacing = run.extent, _FINENESS * float(run.start.radius.mean())
    size = numpy.array([2 * 1.35 * extent.half_width, 0, 1.5 * extent.height])
    grid = Grid(numpy.array([-size[0] / 2, spacing, extent.bottom - 0.25 * extent.height]), spacing, 1 + (size / spacing).astype(int))
    return grid, fields_at(run, run.peak_time, grid, _REACH_IN_PICTURES / _FINENESS * spacing, whole=False)


def stress_flow(axes, run, shear=False, beside=False):
    """Vertical stress, or the largest shear stress, in the plane beside y = 0 near the peak, from platen to platen. beside: another
    panel, which has the labels of z."""
    grid, fields = _section(run)
    value = -fields.stress[:, 8] * MPA
    known = numpy.isfinite(value)
    if shear:
        principal = numpy.linalg.eigvalsh(fields.stress[known].reshape(-1, 3, 3)) * MPA
        value[known] = 0.5 * (principal[:, 2] - principal[:, 0])
    norm, ramp = Normalize(*(numpy.percentile(value[known], (2, 98)) if known.any() else (0, 1))), VIRIDIS.copy()
    ramp.colorbar_extend = "both"
    image = ramp(norm(value), bytes=True)[:, :3]
    image[~known] = 255  # white
    image[~known & (fields.body == PLATEN)] = 184, 191, 199
    low, high = ((grid.origin + grid.spacing * (end * grid.nodes - 0.5)) * MM for end in (0, 1))
    axes.imshow(image.reshape(grid.nodes[2], grid.nodes[0], 3), origin="lower", aspect="auto", extent=(low[0], high[0], low[2], high[2]))
    axes.set_box_aspect((high - low)[2] / (high - low)[0])
    axes.invert_xaxis()  # as in all pictures of the specimen
    axes.grid(False)
    axes.tick_params(labelleft=not beside)
    axes.set(xlabel="x (mm)", ylabel="" if beside else "z (mm)", title="Largest shear stress (MPa)" if shear else "Vertical stress (MPa)")
    colour_bar(axes, ramp, norm, "")


def picture_of_stress_flow(run):
    """Panels beside each other, of a wide specimen one over the other."""
    radius, ratio = run.start.radius.mean() * MM, 1.5 * run.extent.height / (2.7 * run.extent.half_width)
    tall = ratio > 1
    height = min(4.6, 2.4 * ratio) if tall else 5.6 * ratio
    width = 0.72 + 0.95 + (0.72 + 2 * height / ratio if tall else 5.6)
    draws = [partial(stress_flow, run=run), partial(stress_flow, run=run, shear=True, beside=tall)]
    rigid = bool(run.series("platens")) and "stress" not in run.grid("platens", run.peak_time).point_data
    caption = (f"Stress in the plane y = {_FINENESS * radius:.2g} mm {run.near_peak('specimen')}: vertical stress, compression positive, "
               f"and the largest shear stress; x points to the left. Each value is an average over the spheres within "
               f"{_REACH_IN_PICTURES * radius:.2g} mm. Each colour scale covers 96 % of the values; smaller and larger ones have the "
               f"colours of its ends. White: neither specimen nor platen.{' Grey: rigid platens, which have no stress.' * rigid}")
    rows = [draws] if tall else [[draw] for draw in draws]
    return Picture("stress_flow", caption, rows, height, width, raster=True, bar=True, titles=True)
