"""Spheres, discs and meshes of hexahedra as an image on axes, by a depth buffer: seen along -y, from a little above."""
import numpy
from matplotlib import patheffects
from matplotlib.colors import LinearSegmentedColormap

from ..errors import InputError
from .house import DPI, Picture
from .run import is_round

RISE = 0.12  # tangent of the angle from above, about 7 degrees
_ROUND = 96  # sides of a platen that is round
FINE = 2  # so many times finer than it is shown, so that edges are smooth
LIGHTS = ((0.8, (-0.6, 0.8, 1)), (0.3, (0.7, 0.1, 1)))  # strength, and where it comes from: right, up, towards the eye
STEEL, RUBBER = (0.62, 0.66, 0.70), (0.55, 0.43, 0.40)
DAMAGE = LinearSegmentedColormap.from_list("damage", ["#e2e6e9", "#fdd49e", "#fdaa6e", "#ef6548", "#c81e19", "#780000"])
HALO = [patheffects.withStroke(linewidth=2.5, foreground="white")]  # of letters and lines over spheres
FACES = [[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]]  # of a hexahedron, from outside


def seen(places):
    """How far to the right (that is -x), up and towards the eye n x 3 places or directions are, each n, in the same unit."""
    x, y, z = numpy.asarray(places, float).T
    norm = numpy.hypot(1, RISE)
    return -x, (z - RISE * y) / norm, (y + RISE * z) / norm


def joined(points):
    """Number of the place of each point: elements have corners of their own, which are one place to 1e-6 of the size."""
    key = numpy.zeros(len(points), int)
    for x in points.T:
        order = numpy.argsort(x, kind="stable")
        cluster = numpy.empty(len(x), int)
        cluster[order] = numpy.cumsum(numpy.diff(x[order], prepend=x[order[:1]]) > 1e-6 * numpy.ptp(points, 0).max())
        key = key * (cluster.max() + 1) + cluster
    return numpy.unique(key, return_inverse=True)[1]


def hexahedra(grid, where):
    """Corners of each element of a grid, n x 8; elements of 27 nodes name them first. InputError where it has others."""
    nodes = numpy.diff(grid.offsets, prepend=0)
    if len(nodes) == 0 or not numpy.isin(nodes, (8, 27)).all():
        raise InputError(f"{where}: holds other elements than hexahedra")
    return grid.connectivity[(grid.offsets - nodes)[:, None] + numpy.arange(8)]


def surface(grid, where):
    """Corners of the faces that belong to one element alone, n x 4, counter-clockwise from outside."""
    faces = hexahedra(grid, where)[:, FACES].reshape(-1, 4)
    low, second, third, _ = numpy.sort(joined(grid.points)[faces], 1).T
    _, first, count = numpy.unique((low << 42) + (second << 21) + third, return_index=True, return_counts=True)
    return faces[first[count == 1]]


def boxes_of(grid, where):
    """Of each body of elements that share corners: [low x, y, z, high x, y, z (m), 1 where it is round about z, else 0], in the order of
    their first elements: two supports are two."""
    corners = hexahedra(grid, where)
    places = joined(grid.points)[corners]
    label = numpy.arange(places.max() + 1)
    while True:  # each place takes the smallest number of its element, until nothing changes
        before = label.copy()
        numpy.minimum.at(label, places, label[places].min(1)[:, None])
        label = label[label]
        if numpy.array_equal(label, before):
            break
    body, boxes = label[places[:, 0]], []
    for one in dict.fromkeys(body.tolist()):
        points = grid.points[corners[body == one]].reshape(-1, 3).astype(float)
        low, high = points.min(0), points.max(0)
        reach = numpy.hypot(*(points - (low + high) / 2)[:, :2].T).max()
        boxes.append([*low.round(7).tolist(), *high.round(7).tolist(), int(is_round(reach, *(high - low)[:2] / 2))])
    return boxes


def cylinder(box):
    """Points and faces (see Scene.mesh) of the upright cylinder in one of boxes_of."""
    low, high, n = numpy.array(box[:3]), numpy.array(box[3:6]), _ROUND
    turn, k, m = 2 * numpy.pi / n * numpy.arange(n), numpy.arange(n), numpy.arange(n // 2 - 1)
    rim = (low + high)[:2] / 2 + (high - low)[:2] / 2 * numpy.column_stack([numpy.cos(turn), numpy.sin(turn)])
    around, top = [k, (k + 1) % n, n + (k + 1) % n, n + k], [n + m, n + m + 1, 2 * n - 2 - m, 2 * n - 1 - m]
    faces = numpy.hstack([around, top, numpy.subtract(top[::-1], n)]).T
    return numpy.vstack([numpy.insert(rim, 2, z, axis=1) for z in (low[2], high[2])]), faces


def _shade(right, up, near):
    """How bright a face with this normal is."""
    bright = 0.3
    for strength, light in LIGHTS:
        a, b, c = 0.8 * strength * numpy.array(light, "f4") / numpy.linalg.norm(light).astype("f4")
        bright = bright + numpy.maximum(right * a + up * b + near * c, 0)
    return bright


def _filled(first, last):
    """All whole numbers of the stretches first ... last, one after the other, and which stretch each is of. (Steps that are summed
    up take a third of the time of numpy.repeat.)"""
    kept = numpy.flatnonzero(last >= first)
    if len(kept) == 0:
        return numpy.empty(0, int), numpy.empty(0, int)
    first, last = first[kept], last[kept]
    end = numpy.cumsum(last - first + 1)
    value, stretch = numpy.ones(end[-1], int), numpy.zeros(end[-1], "i4")
    value[0], stretch[0] = first[0], kept[0]
    value[end[:-1]], stretch[end[:-1]] = first[1:] - last[:-1], numpy.diff(kept)
    return numpy.cumsum(value, out=value), numpy.cumsum(stretch, out=stretch)


class Scene:
    """What is drawn into one axes. Axes of it are to the right and up in m; what `show` puts there covers the whole axes.

    scene = Scene(axes, run.extent) scene.spheres(position, radius, colour) scene.show()
    """

    def __init__(self, axes, extent, size=None, margin=0.15, foot=0.0):
        """size: half width and height (m) to hold, where not the extent's; margin: what is seen around it, over its longer side;
        foot: inches left empty below."""
        self.axes = axes
        half, height = size or (extent.half_width, extent.height)
        around = margin * max(2 * half, height)
        self.columns, self.rows = (FINE * (DPI * axes.bbox.size / axes.figure.dpi).round()).astype(int)
        self.foot = int(FINE * DPI * foot)
        room = self.rows - self.foot
        self.scale = min(self.columns / (2 * half + 2 * around), room / (height + 2 * around))  # pixels a metre
        self.left = -self.columns / 2 / self.scale
        self.top = float(seen([[0, 0, (extent.bottom + extent.top) / 2]])[1]) + room / 2 / self.scale
        # Of each pixel: how near (pixels), number of its colour, how bright.
        self.depth, self.which, self.bright = (numpy.full(self.rows * self.columns, of, kind)
                                               for of, kind in ((-numpy.inf, "f4"), (0, "i4"), (1, "f4")))
        self.colours = [numpy.ones((1, 3), "f4")]

    def _pixels(self, places):
        """To the right, down, and towards the eye, in pixels."""
        right, up, near = seen(places)
        return (right - self.left) * self.scale, (self.top - up) * self.scale, near * self.scale

    def _put(self, at, depth, bright, which, colours):
        """Shows what is nearer than all before; which: of the n x 3 colours."""
        which = which + sum(map(len, self.colours))
        self.colours.append(numpy.asarray(colours, "f4"))
        nearer = numpy.flatnonzero(depth > self.depth[at])
        at = at[nearer]
        self.depth[at], self.which[at], self.bright[at] = depth[nearer], which[nearer], bright[nearer]

    def spheres(self, position, radius, colour, normal=None):
        """position: n x 3, m; radius: n, m; colour: n x 3 of 0 ... 1. normal: n x 3, where discs are drawn."""
        x, y, near = self._pixels(position)
        r = numpy.asarray(radius, float) * self.scale
        # Bodies that do not overlap are in the order of their centres wherever one hides the other: the last drawn is the nearest.
        order = numpy.argsort(near, kind="stable")
        order = order[((x > r) & (x < self.columns - r - 1) & (y > r) & (y < self.rows - r - 1))[order]]
        if len(order) == 0:
            return
        x, y, near, r = (of[order].astype("f4") for of in (x, y, near, r))
        a = b = numpy.zeros(1, "f4")  # slope of a disc to the right and down
        if normal is not None:
            n = numpy.array(seen(normal)).T[order].astype("f4")
            n *= numpy.where(n[:, 2:] < 0, -1, 1)
            n[:, 2] = numpy.maximum(n[:, 2], 0.5 / r)  # one that is seen from its edge is a line
            n /= numpy.linalg.norm(n, axis=1)[:, None]
            a, b = -n[:, 0] / n[:, 2], n[:, 1] / n[:, 2]
        # In each row what has x^2 + y^2 + (a x + b y)^2 < r^2.
        reach = int(r.max()) + 1
        row = y.astype("i4")[:, None] + numpy.arange(-reach, reach + 1, dtype="i4")
        down = (row + 0.5).astype("f4") - y[:, None]
        middle, root = (a * b)[:, None] * down, (r * r)[:, None] - (1 + b * b)[:, None] * down * down
        root = middle * middle + (1 + a * a)[:, None] * root
        wide = numpy.sqrt(numpy.maximum(root, 0))
        start = x[:, None] - 0.5
        first = numpy.ceil(start - (middle + wide) / (1 + a * a)[:, None]).astype("i4")
        last = numpy.where(root > 0, numpy.floor(start + (wide - middle) / (1 + a * a)[:, None]), first - 1).astype("i4")
        pixels, stretch = _filled((row * self.columns + first).ravel(), (row * self.columns + last).ravel())
        which = numpy.full(self.rows * self.columns, -1, "i4")
        which[pixels] = stretch // (2 * reach + 1)
        at = numpy.flatnonzero(which >= 0)
        k = which[at]
        right, down = (at % self.columns + 0.5).astype("f4") - x[k], (at // self.columns + 0.5).astype("f4") - y[k]
        if normal is None:
            over = numpy.sqrt(numpy.maximum(r[k] ** 2 - right**2 - down**2, 0))
            bright = _shade(right / r[k], -down / r[k], over / r[k])
        else:
            over, bright = a[k] * right + b[k] * down, _shade(*n.T)[k]
        self._put(at, near[k] + over, bright, order[k], colour)

    def mesh(self, points, faces, colour, before=numpy.inf):
        """Faces (n x 4 numbers of points, counter-clockwise from outside) of closed bodies of one colour, cut at y = before (m):
        where one looks into a body, it is filled."""
        x, y, near = self._pixels(points)
        corner = numpy.stack([x, -y, near], 1)[faces]
        normal = numpy.cross(corner[:, 2] - corner[:, 0], corner[:, 3] - corner[:, 1])
        shown = (normal[:, 2] > 0) | ((normal[:, 2] < 0) & (before < numpy.inf))
        shown &= points[faces, 1].min(1) <= before
        order = numpy.argsort(corner[:, :, 2].mean(1), kind="stable")
        order = order[shown[order]]
        if len(order) == 0:
            return
        corner, normal = corner[order], normal[order] / numpy.linalg.norm(normal[order], axis=1)[:, None]
        x, y = corner[:, :, 0], -corner[:, :, 1]
        low, high = (numpy.clip(numpy.ceil(end - 0.5), 0, self.rows).astype(int) for end in (y.min(1), y.max(1)))
        row, face = _filled(low, high - 1)
        down, first, last = row + 0.5, numpy.full(len(row), -numpy.inf), numpy.full(len(row), numpy.inf)
        for k in range(4):
            x0, y0, x1, y1 = (of[:, k + d][face] if k + d < 4 else of[:, 0][face] for d in (0, 1) for of in (x, y))
            with numpy.errstate(divide="ignore", invalid="ignore"):
                at = x0 + (x1 - x0) * (down - y0) / (y1 - y0)
            on_left = (y1 > y0) == (normal[face, 2] > 0)  # of a face that is seen counter-clockwise
            first = numpy.where(on_left & (y1 != y0), numpy.maximum(first, at), first)
            last = numpy.where(~on_left & (y1 != y0), numpy.minimum(last, at), last)
        first, last = (numpy.clip(numpy.ceil(end - 0.5), 0, self.columns).astype(int) for end in (first, last))
        pixels, stretch = _filled(row * self.columns + first, row * self.columns + last - 1)
        # Depth over a row from the plane through the middle of the face.
        middle, (right, up, towards) = corner.mean(1), normal.T
        slope, rise = right / towards, up / towards
        depth = (middle[face, 2] + (down + middle[face, 1]) * rise[face] + (middle[face, 0] - 0.5) * slope[face])[stretch]
        face = face[stretch]
        depth -= pixels % self.columns * slope[face]
        bright = _shade(right, up, towards)[face]
        nearest, shade = numpy.full(self.rows * self.columns, -numpy.inf), numpy.zeros(self.rows * self.columns)
        if before < numpy.inf:
            norm, height = numpy.hypot(1, RISE), self.top * self.scale - numpy.arange(self.rows) - 0.5
            plane = numpy.repeat(before * norm * self.scale + RISE * height, self.columns)
            away = (towards < 0)[face]
            kept = depth <= plane[pixels]
            # Where more faces look away than towards the eye, the plane lies in a body.
            inside = numpy.bincount(pixels[kept], 2.0 * away[kept] - 1, self.rows * self.columns) > 0.5
            pixels, depth, bright = (of[kept & ~away] for of in (pixels, depth, bright))
        nearest[pixels], shade[pixels] = depth, bright
        if before < numpy.inf:
            nearest[inside], shade[inside] = plane[inside], _shade(*seen([[0, 1, 0]]))
        at = numpy.flatnonzero(nearest > -numpy.inf)
        self._put(at, nearest[at], shade[at], numpy.zeros(len(at), "i4"), [colour])

    def bodies(self, grid, where, colour=STEEL, before=numpy.inf, turn=None):
        """A frame of platens or of a sleeve; turn: 3 x 3, of its places. Rigid round platens, whose elements are few, are drawn round."""
        boxes, meshes = boxes_of(grid, where), [(grid.points, surface(grid, where))]
        across, heights = (len(numpy.unique(grid.points[:, axes].round(7), axis=0)) for axes in ([0, 1], [2]))
        upright = joined(grid.points).max() + 1 == across * heights  # no dome
        if upright and all(box[6] for box in boxes) and colour is STEEL and "stress" not in grid.point_data:
            meshes = map(cylinder, boxes)
        for points, faces in meshes:
            self.mesh(points if turn is None else points @ turn.T, faces, colour, before)

    def line(self, places, **more):
        """n x 3 places joined by a line, over all else."""
        right, up, _ = seen(places)
        self.axes.plot(right, up, **{"color": "#4d4d4d", "lw": 0.8, **more})

    def show(self):
        """Puts the image onto the axes."""
        foot = slice((self.rows - self.foot) * self.columns, None)
        self.which[foot], self.bright[foot] = 0, 1
        image = (numpy.concatenate(self.colours).take(self.which, 0) * self.bright[:, None]).reshape(self.rows, self.columns, 3)
        fine = sum(image[k::FINE, j::FINE] for k in range(FINE) for j in range(FINE)) * (255 / FINE**2)
        edges = (self.left, -self.left, self.top - self.rows / self.scale, self.top)
        self.axes.imshow(numpy.minimum(fine, 255).astype("u1"), extent=edges)
        self.axes.set(xlim=edges[:2], ylim=edges[2:])
        self.axes.axis("off")


def panels(name, caption, draws, extents, bar=False, foot=0.0, margin=0.15):
    """A Picture of scenes that hold the largest of the extents, in rows of at most four, as high as they need."""
    across = min(4, len(draws))
    draws = draws + [lambda axes: axes.axis("off")] * (-len(draws) % across)
    half_width, height = max(e.half_width for e in extents), max(e.height for e in extents)
    wide = (7.5 - (0.95 if bar else 0.15) - 0.12 * (across - 1)) / across
    around = margin * max(2 * half_width, height)
    high = wide * (height + 2 * around) / (2 * half_width + 2 * around) + foot
    rows = [draws[k : k + across] for k in range(0, len(draws), across)]
    return Picture(name, caption, rows, min(4.4, high), raster=True, bar=bar, titles=True, margin=0.1)
