"""Reads the VTU files of a run into numpy arrays; needs no VTK."""
import base64
import math
import re
import zlib
from pathlib import Path
from xml.etree import ElementTree

import numpy

from .errors import InputError, path_text

_TYPES = {"Float64": "f8", "Float32": "f4", "Int64": "i8", "Int32": "i4", "Int8": "i1", "UInt8": "u1", "UInt32": "u4",
          "UInt64": "u8", "Int16": "i2", "UInt16": "u2"}


class Grid:
    """One frame: `points` (n x 3, m), `point_data` and `cell_data` by name, `connectivity` and `offsets` of the cells,
    `field_data` (single numbers of the frame)."""

    def __init__(self, points, point_data, cell_data, field_data, connectivity, offsets):
        self.points, self.point_data, self.cell_data, self.field_data = points, point_data, cell_data, field_data
        self.connectivity, self.offsets = connectivity, offsets

    def lines(self):
        """Both ends of each cell, n x 2; InputError for a grid whose cells are no lines."""
        if not numpy.array_equal(self.offsets, 2 * numpy.arange(1, len(self.offsets) + 1)):
            raise InputError("the cells of this grid are no lines: they have other numbers of points than 2")
        return self.connectivity.reshape(-1, 2)


def _slice(data, first, last):
    if not 0 <= first <= last <= len(data):
        raise ValueError("an array reaches beyond the file")
    return data[first:last]


class _Arrays:
    """The arrays of one file: appended raw bytes, or base64 or plain text where they stand."""

    def __init__(self, order, header, compressed, appended):
        self.order, self.header, self.compressed, self.appended = order, numpy.dtype(header), compressed, appended

    def _numbers(self, data, at, count):
        return numpy.frombuffer(data, self.header, count, at).astype(int)

    def _decoded(self, data, at):
        """The bytes of an array that begins at `at`."""
        width = self.header.itemsize
        if not self.compressed:
            size = self._numbers(data, at, 1)[0]
            return _slice(data, at + width, at + width + size)
        blocks = self._numbers(data, at, 1)[0]
        sizes = self._numbers(data, at + 3 * width, blocks) if blocks > 0 else []
        ends = at + (3 + blocks) * width + numpy.cumsum([0, *sizes])
        return b"".join(zlib.decompress(_slice(data, first, last)) for first, last in zip(ends, ends[1:]))

    def _from_base64(self, text):
        """Sizes of compressed blocks are encoded by themselves, before the blocks."""
        text = "".join(text.split())
        if not self.compressed:
            return self._decoded(base64.b64decode(text), 0)
        letters = lambda count: (count + 2) // 3 * 4
        width = self.header.itemsize
        blocks = self._numbers(base64.b64decode(text[: letters(width)]), 0, 1)[0]
        head = letters((3 + blocks) * width)
        return self._decoded(base64.b64decode(text[:head]) + base64.b64decode(text[head:]), 0)

    def array(self, element):
        kind = self.order + _TYPES[element.get("type")]
        form = element.get("format")
        if form == "appended":
            values = numpy.frombuffer(self._decoded(self.appended, int(element.get("offset"))), kind)
        elif form == "binary":
            values = numpy.frombuffer(self._from_base64(element.text or ""), kind)
        else:
            values = numpy.array((element.text or "").split(), dtype=kind)
        components = int(element.get("NumberOfComponents", 1))
        return values if components == 1 else values.reshape(-1, components)

    def of(self, element):
        return {} if element is None else {a.get("Name"): self.array(a) for a in element}


def _require_whole(grid):
    """ValueError where arrays do not go together."""
    points, cells = len(grid.points), len(grid.offsets)
    for name, values in grid.point_data.items():
        if len(values) != points:
            raise ValueError(f"{name} has {len(values)} rows for {points} points")
    for name, values in grid.cell_data.items():
        if len(values) != cells:
            raise ValueError(f"{name} has {len(values)} rows for {cells} cells")
    ends = numpy.concatenate([[0], grid.offsets])
    if (numpy.diff(ends) < 0).any() or ends[-1] != len(grid.connectivity):
        raise ValueError("offsets do not cut the connectivity into cells")
    if len(grid.connectivity) > 0 and not (0 <= grid.connectivity.min() and grid.connectivity.max() < points):
        raise ValueError("a cell names a point that is not there")


def read(path):
    """The grid of a .vtu file. InputError where it is no such file, or damaged."""
    path = Path(path_text(path, "path"))
    try:
        data = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    mark = re.search(rb'<AppendedData\s+encoding="raw"\s*>\s*_', data)
    try:
        root = ElementTree.fromstring(data if mark is None else data[: mark.start()] + b"</VTKFile>")
        order = "<" if root.get("byte_order") == "LittleEndian" else ">"
        header = order + _TYPES[root.get("header_type", "UInt32")]
        arrays = _Arrays(order, header, root.get("compressor") is not None, b"" if mark is None else data[mark.end() :])
        piece = root.find("UnstructuredGrid/Piece")
        cells = arrays.of(piece.find("Cells"))
        fields = arrays.of(root.find("UnstructuredGrid/FieldData"))
        grid = Grid(arrays.array(piece.find("Points")[0]), arrays.of(piece.find("PointData")), arrays.of(piece.find("CellData")),
                    {name: float(value[0]) for name, value in fields.items() if value.size == 1}, cells["connectivity"],
                    cells["offsets"])
        _require_whole(grid)
        return grid
    except (OverflowError, ElementTree.ParseError, KeyError, ValueError, AttributeError, IndexError, TypeError, zlib.error) as error:
        raise InputError(f"{path}: no VTU file, or damaged: {error}") from None


def read_pvd(path):
    """Time (s) and files of each frame that a .pvd lists, by time."""
    path = Path(path_text(path, "path"))
    try:
        entries = ElementTree.fromstring(path.read_bytes()).findall("Collection/DataSet")
        frames = {}
        for entry in entries:
            time = float(entry.get("timestep"))
            if not math.isfinite(time):
                raise ValueError(f"a frame at {time} s")
            frames.setdefault(time, []).append(path.parent / entry.get("file"))
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    except (ElementTree.ParseError, TypeError, ValueError) as error:
        raise InputError(f"{path}: no whole .pvd file: {error}") from None
    return sorted(frames.items())
