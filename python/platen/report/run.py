"""What stands in folders of results. A run as a test: its moments (the peak, the fall to 0.8 of it, the end), strains from the end of
consolidation, its spheres."""
import math
import re
from collections import namedtuple
from contextlib import contextmanager
from functools import cached_property, lru_cache
from pathlib import Path

import numpy

from ..errors import InputError
from ..results import Run, read_json, read_table

# Columns of stress and strain along x, y, z; of the low platen first.
STRESS = (("stress_left_pa", "stress_right_pa"), ("stress_front_pa", "stress_back_pa"), ("axial_stress_bottom_pa", "axial_stress_top_pa"))
_NEAR = 0.05  # of the time to the peak
_BACK = 0.05  # of the largest strain
STRAIN = ("strain_x", "strain_y", "axial_strain_platen")
_PREFIX = {"": 1, "p": 1e-12, "n": 1e-9, "u": 1e-6, "m": 1e-3, "c": 1e-2, "k": 1e3, "M": 1e6, "G": 1e9, "T": 1e12}
_UNIT = {"m": 1, "s": 1, "N": 1, "Pa": 1, "J": 1, "rad": 1, "bar": 1e5, "g": 1e-3, "psi": 6894.757293168361}
_WHOLE = {"%": 0.01, "percent": 0.01, "degree": math.pi / 180, "deg": math.pi / 180, "min": 60, "h": 3600, "t": 1e3, "inch": 0.0254, "": 1}
# What a page lacks where a file of a run is not there.
_WITHOUT = {"summary.json": " (the run has not finished): its figures are left out", "cracks.csv": ": no pictures of broken bonds",
            "specimen.pvd": ": no pictures of the specimen", "platens.pvd": ": pictures are drawn without platens",
            "bonds.pvd": ": crack density is given per volume, not as a fraction of the bonds",
            "contacts.pvd": ": no pictures of the contacts on the platens"}


# ---- texts and numbers of scenes and summaries
def unit_factor(unit):
    """From a unit of a scene ("MPa", "kN/mm2") to SI; None where it is none."""
    factor = 1.0
    for k, part in enumerate(unit.strip().split("/")):
        name, power = re.fullmatch(r"(.*?)([23]?)", part).groups()
        one = _WHOLE.get(name) or next((_PREFIX[name[: -len(u)]] * f for u, f in _UNIT.items()
                                        if name.endswith(u) and name[: -len(u)] in _PREFIX), None)
        if one is None:
            return None
        factor *= one ** (int(power or 1) * (1 if k == 0 else -1))
    return factor


def number_with_unit(text):
    """SI, of "25 mm"; NaN where it is no number with a unit."""
    found = re.fullmatch(r"\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*(.*?)\s*", text)
    factor = unit_factor(found[2]) if found else None
    return math.nan if factor is None else float(found[1]) * factor


def number_in(summary, path):
    """A number of a summary, "cone_top/half_angle_deg"; NaN where it is none."""
    for key in path.split("/"):
        summary = summary.get(key) if isinstance(summary, dict) else None
    return float(summary) if isinstance(summary, (int, float)) and not isinstance(summary, bool) else math.nan


def listed(summary, key, kind=dict):
    """What of a kind a list of a summary holds; [] where it has none."""
    found = summary.get(key) if isinstance(summary, dict) else None
    return [one for one in found if isinstance(one, kind)] if isinstance(found, list) else []


def scene_entries(folder):
    """{"Platens/Top/Surface": "dry", ...} of the scene.prm of a folder of results; {} where it is not there."""
    entries, sections, path = {}, [], Path(folder) / "scene.prm"
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines() if path.is_file() else []:
        word, _, rest = line.split("#")[0].strip().partition(" ")
        if word == "subsection":
            sections.append(rest.strip())
        elif word == "end" and sections:
            sections.pop()
        elif word == "set":
            key, _, value = rest.partition("=")
            entries["/".join([*sections, key.strip()])] = value.strip()
    return entries


# ---- files
@contextmanager
def reading(file):
    """InputError with the file where something that is read from it is not there, or is of another kind."""
    try:
        yield
    except InputError:
        raise
    except (KeyError, TypeError, ValueError, AttributeError, IndexError) as error:
        lacks = f"no {error.args[0]}" if isinstance(error, KeyError) else error
        raise InputError(f"{file}: damaged: {lacks}") from None


def table_with(path, *columns):
    """The Table of a CSV file. InputError where it lacks one of the columns, or one holds something else than numbers."""
    table = read_table(path)
    for column in columns:
        if column not in table:
            raise InputError(f"{path}: no column {column}")
        if table[column].dtype.kind != "f":
            raise InputError(f"{path}: column {column} holds something else than numbers")
    return table


def shape_of(folder):
    """("cylinder", {"radius_m": 0.025, "height_m": 0.1}) by the first line of specimen.csv; ("", {}) where it does not say it."""
    path = Path(folder) / "specimen.csv"
    with reading(path):
        found = re.match(r"# shape: (\w+) (.*)", path.read_text(encoding="utf-8")) if path.is_file() else None
        return (found[1], {name: float(value) for name, value in re.findall(r"(\w+)=(\S+)", found[2])}) if found else ("", {})


def point_data(grid, where, **widths):
    """Arrays of a vtu.Grid by name; widths: numbers a point. InputError, of the file `where`, for one that is not there so."""
    found = []
    for name, width in widths.items():
        array, shape = grid.point_data.get(name), (len(grid.points), width)[: 1 + (width > 1)]
        if array is None and len(grid.points) == 0:
            array = numpy.zeros(shape)
        if array is None or array.shape != shape:
            raise InputError(f"{where}: a frame has no point data {name!r} of {width} components")
        found.append(array)
    return found


def nearest(values, wanted):
    """Number of the value nearest to what is wanted."""
    return int(numpy.abs(values - wanted).argmin())


def rows_of(numbers, wanted):
    """(rows, known): where each wanted number stands among the numbers, and whether it does."""
    order = numpy.argsort(numbers)
    rows = order[numpy.searchsorted(numbers, wanted, sorter=order).clip(0, len(order) - 1)]
    return rows, numbers[rows] == wanted


class Results:
    """A folder of results of any program. name: of the folder; info: summary.json ({} where it is not there); entries: of its scene.prm;
    mean_radius: of the spheres (m), NaN where nothing says it. InputError where a file is damaged, or something else has its name."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.name = self.folder.resolve().name
        for file in ("summary.json", "scene.prm"):
            _refuse_what_is_no_file(self.folder / file)
        path = self.folder / "summary.json"
        self.info = read_json(path) if path.is_file() else {}
        self.entries, self.mean_radius = scene_entries(folder), number_in(self.info, "mean_radius_m")

    def entry(self, path):
        """Text of an entry of scene.prm; "" where it has none."""
        return self.entries.get(path, "")


def _refuse_what_is_no_file(path):
    if path.exists() and not path.is_file():
        raise InputError(f"{path}: is no file")


# ---- a run
class Spheres(namedtuple("Spheres", "time position initial radius intact broken fragment moves_with fields")):
    """A frame of the specimen as columns, by sphere. position, initial (before the test): n x 3, m; radius: m; intact, broken: bonds,
    counted for both their spheres; fragment: 0 the largest; moves_with: since the peak, with the platen 1 bottom, 2 top, 0 neither;
    None where no platen moves spheres; fields: all point data."""

    @property
    def displacement(self):
        """m, size."""
        return numpy.linalg.norm(self.position - self.initial, axis=1)

    @property
    def outward(self):
        """m, away from the axis x = y = 0 in the plane across it."""
        return numpy.hypot(*self.position.T[:2]) - numpy.hypot(*self.initial.T[:2])

    @property
    def damage(self):
        """Broken share of the bonds; 0 for a sphere that had none."""
        total = self.intact + self.broken
        return numpy.divide(self.broken, total, out=numpy.zeros(len(total)), where=total > 0)


class Extent(namedtuple("Extent", "form half_width half_depth bottom top")):
    """Size of the specimen before the test, spheres' radii included (m). form: cylinder, box, or disc, which lies with its axis
    along y and is pressed across it."""

    @property
    def height(self):
        return self.top - self.bottom

    @property
    def corners(self):
        """Low and high one, 2 x 3, m."""
        return numpy.array([[-self.half_width, -self.half_depth, self.bottom], [self.half_width, self.half_depth, self.top]])

    @property
    def is_plane(self):
        """Neither round nor square from above: what happens in it goes by the distance from the plane x = 0."""
        return self.form == "disc" or (self.form == "box" and self.half_width > 1.5 * self.half_depth)


def is_round(reach, a, b):
    """Whether what reaches so far from its middle is a circle: with filled corners it would be up to sqrt(2) half widths a, b."""
    return max(reach, a, b) < 1.15 * min(a, b)


def extent_of(spheres):
    """The Extent of Spheres before the test."""
    x, y, z = spheres.initial.T
    width, depth = (float((numpy.abs(across) + spheres.radius).max()) for across in (x, y))
    bottom, top = float((z - spheres.radius).min()), float((z + spheres.radius).max())
    middle, half = (bottom + top) / 2, (top - bottom) / 2
    form = ("cylinder" if is_round((numpy.hypot(x, y) + spheres.radius).max(), width, depth) else
            "disc" if is_round((numpy.hypot(x, z - middle) + spheres.radius).max(), width, half) else "box")
    return Extent(form, width, depth, bottom, top)


class TestRun(Run, Results):
    """A platen.Run as a test. All times in s, stresses in Pa, strains as fractions, compression positive.

    h: its history. axis: that is loaded, 0 ... 2; strain: between the platens along it, one a row. zero: the row at the end of
    consolidation, from which strains count; rows: from it on; goes_back: whether the strain does, as in unloading. peak_row, peak_time,
    peak_stress; peak_reached: whether it went over its peak, None where the summary does not say; peak_words: "peak", or "largest stress"
    where that is no strength. fall_time: of the fall to 0.8 of the peak, None where it did not come. end_time. pattern_time,
    pattern_words: when the crack pattern is judged, at the fall, or at the end. remarks: what its files lack.
    """

    __test__ = False  # no test of pytest
    peak_time = math.nan  # no property as that of a Run

    def __init__(self, folder):
        Run.__init__(self, folder)
        for name in ("history.csv", "cracks.csv", "events.csv", *(series + ".pvd" for series in self._series)):
            _refuse_what_is_no_file(self.folder / name)
        if not (self.folder / "history.csv").is_file():
            raise InputError(f"{self.folder}: no output folder of a run, it has no history.csv")
        Results.__init__(self, self.folder)
        self.h, self.remarks, self.peak_reached = self.history, [], self.info.get("peak_reached")
        self.axis = "xyz".find(str(self.info.get("loaded_axis", "z")))
        self._take_moments()
        self.strain, self.strain_origin = self.since(STRAIN[self.axis]), " from the end of consolidation" if self.zero > 0 else ""
        stress, strain = (f"Axial {of}" if self.axis == 2 else f"{of.capitalize()} along {'xyz'[self.axis]}" for of in ("stress", "strain"))
        self.stress_title, self.strain_title = f"{stress} (MPa)", f"{strain} between platens{self.strain_origin} (mm/m)"
        for column, across in (("deflection_m", "depth"), ("opening_m", "diameter")):  # bars and discs have no strain between platens
            if self.has(column):
                self.strain_title = f"Closure over the {across} (mm/m)"
        for file, without in _WITHOUT.items():
            if not (self.folder / file).is_file():
                self.remarks.append(f"{file} is not there{without}")
            elif file.endswith(".pvd") and self.series(file.removesuffix(".pvd")) is None:
                self.remarks.append(f"{file} lists no frame{without}")
        if math.isnan(self.mean_radius) and self.series("specimen"):
            self.mean_radius = float(self.start.radius.mean())

    def _take_moments(self):
        stress, time = self.stress, self.h["time_s"]
        finite = numpy.isfinite(stress)
        if not finite.any():
            raise InputError(f"{self.folder / 'history.csv'}: no sample with a stress along {'xyz'[self.axis]}")
        if not finite.all():
            self.remarks.append(f"history.csv has {(~finite).sum()} of {len(stress)} rows without a stress, the first at the time "
                                f"{time[~finite][0]:.6g} s: the largest may be one of them")
        self.zero = self._told_row("consolidation_end_time_s", 0)
        if self.zero > len(time) - 3:  # all of a hydrostatic test is consolidation
            self.zero = 0
        self.rows = slice(self.zero, None)
        strain = numpy.nan_to_num(self.since(STRAIN[self.axis])[self.rows])
        back = numpy.maximum.accumulate(numpy.abs(strain)) - numpy.abs(strain)
        self.goes_back = bool(back.max() > _BACK * numpy.abs(strain).max())
        self.peak_row = self._told_row("peak_time_s", int(numpy.abs(numpy.where(finite, stress, 0)).argmax()))
        self.peak_time, self.peak_stress, self.end_time = float(time[self.peak_row]), float(stress[self.peak_row]), float(time[-1])
        told = number_in(self.info, "fall_time_s") if "fall_time_s" in self.info else self._fall(stress, time)
        failed = not math.isnan(told) if self.peak_reached is None else self.peak_reached
        self.peak_words = "peak" if failed and not listed(self.info.get("validity"), "strength_pa", object) else "largest stress"
        self.fall_time, self.pattern_time, self.pattern_words = told, told, f"the fall to 0.8 of the {self.peak_words}"
        if math.isnan(told):
            self.fall_time, self.pattern_time, self.pattern_words = None, self.end_time, "the end"
            self.remarks.append(f"the stress did not fall to 0.8 of the {self.peak_words}: crack patterns are shown at the end")

    def _fall(self, stress, time):
        """s, interpolated; NaN where the stress never fell to 0.8 of the peak."""
        size, limit = stress * math.copysign(1, self.peak_stress), 0.8 * abs(self.peak_stress)
        fallen = numpy.flatnonzero((size[1:] <= limit) & (size[:-1] > limit))
        for k in fallen[fallen >= self.peak_row][:1]:
            return float(time[k] + (time[k + 1] - time[k]) * (size[k] - limit) / (size[k] - size[k + 1]))
        return math.nan

    def _told_row(self, key, otherwise):
        """The last row of the history up to a time that the summary tells."""
        told = number_in(self.info, key)
        if not math.isfinite(told):
            return otherwise
        return max(0, int(numpy.searchsorted(self.h["time_s"], told * (1 + 1e-9), side="right")) - 1)

    def has(self, *columns):
        return all(column in self.h for column in columns)

    def since(self, column):
        """A column less what it was at the end of consolidation."""
        return self.h[column] - self.h[column][self.zero]

    def near_peak(self, series):
        """In words: how near to the peak the frame of a series is that is drawn for it."""
        times = self.series(series).times
        time = float(times[nearest(times, self.peak_time)])
        if abs(time - self.peak_time) <= _NEAR * self.peak_time:
            return f"near the {self.peak_words}"
        return f"at {time * 1e3:.4g} ms ({100 * time / (self.peak_time or math.inf):.0f} % of the time to the {self.peak_words})"

    def series(self, name):
        """Frames of specimen, bonds, platens, contacts, sleeve; None where the run wrote none."""
        return (getattr(self, name) or None) if (self.folder / f"{name}.pvd").is_file() else None

    def table(self, name):
        """cracks, events; None where the run wrote none."""
        return getattr(self, name) if (self.folder / self._tables[name]).is_file() else None

    def read_all(self):
        """Reads the frames that pictures are drawn of. InputError where one is damaged."""
        for name in ("cracks", "events"):
            self.table(name)
        for time in (0.0, self.peak_time, self.pattern_time, self.end_time) if self.series("specimen") else ():
            self.spheres(time)
        if self.series("contacts"):
            self.grid("contacts", self.peak_time)

    @lru_cache(maxsize=64)
    def grid(self, series, time):
        """The frame of a series nearest to a time, read once."""
        return self.series(series).at(time)

    @lru_cache(maxsize=64)
    def spheres(self, time):
        """Spheres of the frame nearest to a time. InputError where a field is missing."""
        frames = self.series("specimen")
        at = float(frames.times[nearest(frames.times, time)])
        grid = self.grid("specimen", at)
        moved, radius, intact, broken, fragment = point_data(grid, frames.path, displacement=3, radius=1, intact_bonds=1, broken_bonds=1,
                                                             fragment=1)
        return Spheres(at, grid.points, grid.points - moved, radius, intact.astype(float), broken.astype(float), fragment.astype(int),
                       grid.point_data.get("moves_with"), grid.point_data)

    @property
    def start(self):
        """Spheres before the test."""
        return self.spheres(0.0)

    @cached_property
    def extent(self):
        return extent_of(self.start)
