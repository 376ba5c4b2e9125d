"""Results of the programs as numpy arrays: a run's folder, and what stands in it."""
import csv
import json
import math
import numbers
from functools import cached_property
from pathlib import Path

import numpy

from . import vtu
from .errors import InputError, MissingError, path_text


class Table(dict):
    """A CSV file: columns by name, each a numpy array; numbers as float64 with NaN for an empty cell, words as strings."""

    def __missing__(self, name):
        raise MissingError(f"no column {name!r}. There are: {', '.join(self)}")

    @property
    def rows(self):
        return len(next(iter(self.values()))) if self else 0

    def to_pandas(self):
        """A pandas.DataFrame. ImportError where pandas is not installed."""
        import pandas

        return pandas.DataFrame(dict(self))

    def records(self):
        """The rows one by one, as dictionaries by column; numbers are Python's own, NaN for an empty cell."""
        return [dict(zip(self, row)) for row in zip(*(column.tolist() for column in self.values()))]


def _column(cells):
    try:
        return numpy.array([float(cell) if cell else numpy.nan for cell in cells])
    except ValueError:
        return numpy.array(cells)


def _read_text(path):
    try:
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: damaged: {error}") from None


def read_table(path):
    """Any CSV file of the programs. A last line without a line end, which a run still writes, is left out, and so are lines of
    comment above the header. InputError where the file cannot be read or a row has another number of cells than the header."""
    path = Path(path_text(path, "path"))
    text = _read_text(path)
    lines = text[: text.rfind("\n") + 1].splitlines()
    above = next((k for k, line in enumerate(lines) if not line.startswith("#")), len(lines))
    if above == len(lines):
        raise InputError(f"{path}: has no header")
    try:
        header, *rows = csv.reader(lines[above:])
    except csv.Error as error:
        raise InputError(f"{path}: damaged: {error}") from None
    if len(set(header)) < len(header):
        raise InputError(f"{path}:{above + 1}: two columns of one name", file=str(path), line=above + 1)
    for number, row in enumerate(rows, above + 2):
        if len(row) != len(header):
            raise InputError(f"{path}:{number}: {len(row)} cells where the header has {len(header)}", file=str(path), line=number)
    return Table((name, _column([row[k] for row in rows])) for k, name in enumerate(header))


def read_json(path):
    """The object of a JSON file."""
    try:
        read = json.loads(_read_text(path))
    except InputError:
        raise
    except (ValueError, RecursionError) as error:
        raise InputError(f"{path}: damaged: {error}") from None
    if not isinstance(read, dict):
        raise InputError(f"{path}: damaged: no object")
    return read


class Frames:
    """A series of frames, such as specimen.pvd: `times` (s); frames[k] reads frame k, frames.at(time) the nearest one."""

    def __init__(self, path):
        self.path = Path(path_text(path, "path"))
        self._frames = vtu.read_pvd(path)
        self.times = numpy.array([time for time, _ in self._frames])

    def __len__(self):
        return len(self._frames)

    def _files(self, k):
        """Of frame k, from the end where it is negative."""
        if isinstance(k, bool) or not isinstance(k, numbers.Integral):
            raise InputError(f"{self.path}: frame {k!r}. Allowed: a whole number")
        if not -len(self) <= k < len(self):
            raise MissingError(f"{self.path}: no frame {k}: there are {len(self)}")
        return self._frames[k][1]

    def __getitem__(self, k):
        grids = self.parts(k)
        return grids[0] if len(grids) == 1 else _joined(grids)

    def parts(self, k):
        """The grids of frame k one by one: of platens.pvd each platen."""
        return [grid for file in self._files(k) for grid in _pieces(file)]

    def at(self, time):
        """The frame nearest to a time (s)."""
        if isinstance(time, bool) or not isinstance(time, numbers.Real) or not math.isfinite(time):
            raise InputError(f"{self.path}: time = {time!r}. Allowed: a finite number of seconds")
        if len(self) == 0:
            raise MissingError(f"{self.path}: no frame is there")
        return self[int(numpy.abs(self.times - time).argmin())]

    def to_pyvista(self, k):
        """A pyvista.UnstructuredGrid of frame k. ImportError where PyVista is not installed."""
        import pyvista

        grids = [pyvista.read(str(file)) for file in self._files(k)]
        return grids[0] if len(grids) == 1 else pyvista.MultiBlock(grids).combine()


def _pieces(file):
    """Grids of a .vtu, or of the pieces that a .pvtu names."""
    if file.suffix != ".pvtu":
        return [vtu.read(file)]
    from xml.etree import ElementTree

    try:
        sources = [piece.get("Source") for piece in ElementTree.fromstring(file.read_bytes()).findall("PUnstructuredGrid/Piece")]
    except (OSError, ElementTree.ParseError) as error:
        raise InputError(f"{file}: cannot be read: {error}") from None
    if not sources or None in sources:
        raise InputError(f"{file}: damaged: names no pieces")
    return [vtu.read(file.parent / source) for source in sources]


def _joined(grids):
    """One grid of several."""

    def of_all(dicts):
        return {name: numpy.concatenate([d[name] for d in dicts]) for name in dicts[0] if all(name in d for d in dicts)}

    points = numpy.cumsum([0] + [len(g.points) for g in grids])
    cells = numpy.cumsum([0] + [len(g.connectivity) for g in grids])
    return vtu.Grid(numpy.concatenate([g.points for g in grids]), of_all([g.point_data for g in grids]),
                    of_all([g.cell_data for g in grids]), grids[0].field_data,
                    numpy.concatenate([g.connectivity + n for g, n in zip(grids, points)]),
                    numpy.concatenate([g.offsets + n for g, n in zip(grids, cells)]))


def _holds_run(folder):
    return (folder / "history.csv").is_file() or (folder / "summary.json").is_file()


def runs(folder, pattern="*"):
    """The runs in a folder by name, in order, of those whose name fits the pattern: {"dry_1": platen.Run, ...}."""
    try:
        paths = sorted(Path(path_text(folder, "folder")).glob(pattern))
    except (AttributeError, NotImplementedError, TypeError, ValueError) as error:
        raise error if isinstance(error, InputError) else InputError(f"pattern = {pattern!r}. Allowed: a name with * and ?") from None
    return {path.name: Run(path) for path in paths if _holds_run(path)}


class Run:
    """The folder of a run. Files are read when they are asked for, and kept.

    run = platen.Run("results/demo_dry")
    run.summary["strength_pa"]           # what summary.json says; null is None
    run.history["axial_strain_platen"]   # numpy arrays by column, also run.cracks, run.events, run.bond_stress
    run.specimen[-1].point_data["damage"], run.bonds.at(run.peak_time), run.platens, run.contacts, run.sleeve
    """

    _tables = {"history": "history.csv", "cracks": "cracks.csv", "crack_state": "crack_state.csv", "events": "events.csv", "bond_stress": "bond_stress.csv",
               "spheres": "specimen.csv"}
    _series = ("specimen", "bonds", "platens", "contacts", "sleeve")

    def __init__(self, folder):
        self.folder = Path(path_text(folder, "folder"))
        if not self.folder.is_dir():
            raise InputError(f"{self.folder}: no folder")
        self._read = {}
        if not _holds_run(self.folder):
            raise InputError(f"{self.folder}: holds no run: neither history.csv nor summary.json is there")

    def _once(self, name, read):
        if name not in self._read:
            self._read[name] = read()
        return self._read[name]

    @property
    def summary(self):
        """summary.json as a dictionary; InputError where the run has not ended."""
        return self._once("summary", lambda: read_json(self.folder / "summary.json"))

    @property
    def status(self):
        """How the run has ended, in the word of summary.json ("done", "failed", ...); None where it has not."""
        return self.summary.get("status") if (self.folder / "summary.json").is_file() else None

    @property
    def scene(self):
        """Every parameter as used: the text of scene.prm."""
        return _read_text(self.folder / "scene.prm")

    def __getattr__(self, name):
        if name in Run._tables:
            path = self.folder / Run._tables[name]
            return self._once(name, lambda: read_table(path))
        if name in Run._series:
            path = self.folder / f"{name}.pvd"
            return self._once(name, lambda: Frames(path))
        raise AttributeError(f"a Run has no {name}")

    def __dir__(self):
        return [*super().__dir__(), *Run._tables, *Run._series]

    @property
    def stress(self):
        """Pa, mean of both platens that load, one a row of the history; compression positive."""
        axis = self.summary.get("loaded_axis", "z") if (self.folder / "summary.json").is_file() else "z"
        all_sides = {"x": ("stress_left_pa", "stress_right_pa"), "y": ("stress_front_pa", "stress_back_pa"),
                     "z": ("axial_stress_top_pa", "axial_stress_bottom_pa")}
        sides = all_sides.get(axis) if isinstance(axis, str) else None
        if sides is None:
            raise InputError(f"{self.folder / 'summary.json'}: damaged: loaded_axis is {axis!r}. Allowed: x, y, z")
        return 0.5 * (self.history[sides[0]] + self.history[sides[1]])

    @property
    def peak_time(self):
        """s, of the largest stress by size. InputError where a stress of the history is no finite number, or there is none."""
        stress = self.stress
        missing = int((~numpy.isfinite(stress)).sum())
        if len(stress) == 0 or missing > 0:
            raise InputError(f"{self.folder / 'history.csv'}: no peak: " +
                             ("no rows" if len(stress) == 0 else f"{missing} of {len(stress)} rows have no stress"))
        return float(self.history["time_s"][int(numpy.abs(stress).argmax())])

    def __repr__(self):
        return f"platen.Run({str(self.folder)!r})"


class Study:
    """The folder of a platen-study: `table` (study.csv, a row a run), `costs` (costs.csv; None where it is not there), `summary`
    (study.json), runs[name]; `rows` for pandas.DataFrame(study.rows). Files are read when they are asked for, and kept."""

    def __init__(self, folder):
        self.folder = Path(path_text(folder, "folder"))
        if not (self.folder / "study.csv").is_file() and not (self.folder / "study.json").is_file():
            raise InputError(f"{self.folder}: holds no study: neither study.csv nor study.json is there")

    @cached_property
    def table(self):
        return read_table(self.folder / "study.csv")

    @cached_property
    def rows(self):
        """A dictionary a run: the columns of study.csv in SI. A varied entry that has no number ("on") has its word there, from
        study.json."""
        words = {case["name"]: dict(zip(self.summary["varied"], (text.partition(" = ")[2] for text in case["overrides"])))
                 for case in self.summary.get("cases", []) if self.summary.get("kind") == "vary"}
        return [{**row, **{column: word for column, word in words.get(row.get("case"), {}).items() if row[column] != row[column]}}
                for row in self.table.records()]

    @cached_property
    def costs(self):
        path = self.folder / "costs.csv"
        return read_table(path) if path.is_file() else None

    @cached_property
    def summary(self):
        path = self.folder / "study.json"
        return read_json(path) if path.is_file() else {}

    @property
    def runs(self):
        return runs(self.folder / "runs")

    def __repr__(self):
        return f"platen.Study({str(self.folder)!r})"
