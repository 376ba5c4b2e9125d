"""A run as a test: its moments (the peak, the fall to 0.8 of it, the end), strains from the end of consolidation, its spheres."""
import math
import re
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy

from ..errors import InputError
from ..results import Run

# Columns of stress and strain along x, y, z; of the low platen first.
STRESS = (("stress_left_pa", "stress_right_pa"), ("stress_front_pa", "stress_back_pa"), ("axial_stress_bottom_pa", "axial_stress_top_pa"))
STRAIN = ("strain_x", "strain_y", "axial_strain_platen")
SIDES = ("bottom", "top", "left", "right", "front", "back")
_PREFIX = {"": 1, "p": 1e-12, "n": 1e-9, "u": 1e-6, "m": 1e-3, "c": 1e-2, "k": 1e3, "M": 1e6, "G": 1e9, "T": 1e12}
_UNIT = {"m": 1, "s": 1, "N": 1, "Pa": 1, "J": 1, "rad": 1, "bar": 1e5, "g": 1e-3, "psi": 6894.757293168361}
_WHOLE = {"%": 0.01, "percent": 0.01, "degree": math.pi / 180, "deg": math.pi / 180, "min": 60, "h": 3600, "t": 1e3, "inch": 0.0254, "": 1}


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


def scene_entries(folder):
    """{"Platens/Top/Surface": "dry", ...} of the scene.prm of a folder of results; {} where it is not there."""
    entries, sections = {}, []
    path = Path(folder) / "scene.prm"
    if not path.is_file():
        return entries
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        word, _, rest = line.split("#")[0].strip().partition(" ")
        if word == "subsection":
            sections.append(rest.strip())
        elif word == "end" and sections:
            sections.pop()
        elif word == "set":
            key, _, value = rest.partition("=")
            entries["/".join([*sections, key.strip()])] = value.strip()
    return entries


class Spheres(NamedTuple):
    """A frame of the specimen as columns, by sphere. initial: before the test. fragment: 0 the largest; moves_with: since the
    peak, with the platen 1 bottom, 2 top, 0 neither; both None where the frame does not have it."""

    time: float
    position: numpy.ndarray  # n x 3, m
    initial: numpy.ndarray  # n x 3, m
    radius: numpy.ndarray  # m
    intact: numpy.ndarray  # bonds, counted for both their spheres
    broken: numpy.ndarray
    fragment: object
    moves_with: object
    fields: dict  # all point data

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


class Extent(NamedTuple):
    """Size of the specimen before the test, spheres' radii included (m). form: cylinder, box, or disc, which lies with its axis
    along y and is pressed across it."""

    form: str
    half_width: float
    half_depth: float
    bottom: float
    top: float

    @property
    def height(self):
        return self.top - self.bottom

    @property
    def is_plane(self):
        """Neither round nor square from above: what happens in it goes by the distance from the plane x = 0."""
        return self.form == "disc" or (self.form == "box" and self.half_width > 1.5 * self.half_depth)


class TestRun(Run):
    """A platen.Run with the moments of its test. All times in s, stresses in Pa, strains as fractions, compression positive."""

    __test__ = False  # no test of pytest

    def __init__(self, folder):
        super().__init__(folder)
        for name in ("history.csv", "summary.json", "cracks.csv", "events.csv", "scene.prm", *(s + ".pvd" for s in self._series)):
            path = self.folder / name
            if path.exists() and not path.is_file():
                raise InputError(f"{path}: is no file")
        if not (self.folder / "history.csv").is_file():
            raise InputError(f"{self.folder}: no output folder of a run, it has no history.csv")
        self.h, self.remarks = self.history, []
        self.info = self.summary if (self.folder / "summary.json").is_file() else {}
        self.entries = scene_entries(self.folder)
        self.name = self.folder.resolve().name
        word = self.info.get("loaded_axis")
        self.axis = "xyz".index(word) if word in ("x", "y") else 2
        self._take_moments()
        self.zero = self._zero_row()
        self._note_what_is_missing()

    # ---- moments
    def _take_moments(self):
        stress, time = self.stress, self.h["time_s"]
        finite = numpy.isfinite(stress)
        if not finite.any():
            raise InputError(f"{self.folder / 'history.csv'}: no sample with a stress along {'xyz'[self.axis]}")
        if not finite.all():
            self.remarks.append(f"history.csv has {(~finite).sum()} of {len(stress)} rows without a stress, the first at the time "
                                f"{time[~finite][0]:.6g} s: the largest may be one of them")
        self.peak_row = int(numpy.abs(numpy.where(finite, stress, 0)).argmax())
        told = number_in(self.info, "peak_time_s")
        if math.isfinite(told):
            self.peak_row = self.row_at(told)
        self.peak_stress, self.end_time = float(stress[self.peak_row]), float(time[-1])
        self.fall_time = self._fall(stress, time)
        if "fall_time_s" in self.info:
            told = number_in(self.info, "fall_time_s")
            self.fall_time = told if math.isfinite(told) else None

    def _fall(self, stress, time):
        """s, interpolated; None where the stress never fell to 0.8 of the peak."""
        sign, limit = (-1 if self.peak_stress < 0 else 1), 0.8 * abs(self.peak_stress)
        for k in range(self.peak_row + 1, len(stress)):
            before, now = sign * stress[k - 1], sign * stress[k]
            if now <= limit < before:
                return float(time[k - 1] + (time[k] - time[k - 1]) * (before - limit) / (before - now))
        return None

    def row_at(self, time):
        """The last row of the history up to a time."""
        return max(0, int(numpy.searchsorted(self.h["time_s"], time * (1 + 1e-9), side="right")) - 1)

    def _zero_row(self):
        told = number_in(self.info, "consolidation_end_time_s")
        return self.row_at(told) if math.isfinite(told) else 0

    @property
    def stress(self):
        low, high = STRESS[self.axis]
        return 0.5 * (self.h[low] + self.h[high])

    @property
    def peak_time(self):
        return float(self.h["time_s"][self.peak_row])

    @property
    def pattern_time(self):
        """When the crack pattern is judged: the fall to 0.8 of the peak, or the end where it did not come."""
        return self.end_time if self.fall_time is None else self.fall_time

    @property
    def pattern_words(self):
        return "the end" if self.fall_time is None else "the fall to 0.8 of the peak"

    @property
    def peak_reached(self):
        """Whether the run went over its peak; None where the summary does not say."""
        return self.info.get("peak_reached")

    # ---- curves
    def has(self, *columns):
        return all(column in self.h for column in columns)

    def since(self, column):
        """A column less what it was at the end of consolidation."""
        return self.h[column] - self.h[column][self.zero]

    @property
    def strain(self):
        """Of the platens along the loaded axis, from the end of consolidation; one a row of the history."""
        return self.since(STRAIN[self.axis])

    @property
    def rows(self):
        """From the end of consolidation on."""
        return slice(self.zero, None)

    @property
    def stress_title(self):
        return "Axial stress (MPa)" if self.axis == 2 else f"Stress along {'xyz'[self.axis]} (MPa)"

    @property
    def strain_title(self):
        along = "Axial strain" if self.axis == 2 else f"Strain along {'xyz'[self.axis]}"
        return f"{along} between platens{self.strain_origin} (mm/m)"

    @property
    def strain_origin(self):
        return " from the end of consolidation" if self.zero > 0 else ""

    # ---- scene and files
    def entry(self, path):
        """Text of an entry of scene.prm; "" where it has none."""
        return self.entries.get(path, "")

    def number(self, path):
        """SI, of an entry of scene.prm; NaN where it is empty or no number."""
        return number_with_unit(self.entry(path)) if self.entry(path) else math.nan

    def series(self, name):
        """Frames of specimen, bonds, platens, contacts, sleeve; None where the run wrote none."""
        path = self.folder / f"{name}.pvd"
        frames = getattr(self, name) if path.is_file() else None
        return frames if frames is not None and len(frames) else None

    def table(self, name):
        """cracks, events; None where the run wrote none."""
        return getattr(self, name) if (self.folder / self._tables[name]).is_file() else None

    @lru_cache(maxsize=64)
    def grid(self, series, time):
        """The frame of a series nearest to a time, read once."""
        return self.series(series).at(time)

    @lru_cache(maxsize=64)
    def spheres(self, time):
        """Spheres of the frame nearest to a time. InputError where a field is missing."""
        frames = self.series("specimen")
        at = float(frames.times[int(numpy.abs(frames.times - time).argmin())])
        grid = self.grid("specimen", at)
        fields = grid.point_data
        lacking = [name for name in ("displacement", "radius", "intact_bonds", "broken_bonds") if name not in fields]
        if lacking:
            raise InputError(f"{frames.path}: a frame has no {lacking[0]}")
        return Spheres(at, grid.points, grid.points - fields["displacement"], fields["radius"], fields["intact_bonds"].astype(float),
                       fields["broken_bonds"].astype(float), fields.get("fragment"), fields.get("moves_with"), fields)

    @property
    def start(self):
        """Spheres before the test."""
        return self.spheres(0.0)

    @property
    def extent(self):
        return _extent(self)

    @property
    def mean_radius(self):
        """m; NaN where nothing says it."""
        told = number_in(self.info, "mean_radius_m")
        return told if math.isfinite(told) or self.series("specimen") is None else float(self.start.radius.mean())

    def _note_what_is_missing(self):
        if self.fall_time is None:
            self.remarks.append("the stress did not fall to 0.8 of the peak: crack patterns are shown at the end")
        if not self.info:
            self.remarks.append("summary.json is not there (the run has not finished): its figures are left out")
        if not (self.folder / "cracks.csv").is_file():
            self.remarks.append("cracks.csv is not there: no pictures of broken bonds")
        for name, without in (("specimen", "no pictures of the specimen"), ("platens", "pictures are drawn without platens"),
                              ("bonds", "crack density is given per volume, not as a share of the bonds"),
                              ("contacts", "no pictures of what presses on the platens")):
            path = self.folder / f"{name}.pvd"
            if not path.is_file():
                self.remarks.append(f"{name}.pvd is not there: {without}")
            elif self.series(name) is None:
                self.remarks.append(f"{name}.pvd lists no frame: {without}")


@lru_cache(maxsize=32)
def _extent(run):
    place, radius = run.start.initial, run.start.radius
    width, depth = (numpy.abs(place[:, :2]) + radius[:, None]).max(0)
    bottom, top = float((place[:, 2] - radius).min()), float((place[:, 2] + radius).max())

    def is_circle(x, y, a, b):
        """In a box the corners are filled: the reach is up to sqrt(2) half widths, in a circle it is one."""
        reach = (numpy.hypot(x, y) + radius).max()
        return reach < 1.15 * min(a, b) and max(a, b) < 1.15 * min(a, b)

    form = "cylinder" if is_circle(place[:, 0], place[:, 1], width, depth) else (
        "disc" if is_circle(place[:, 0], place[:, 2] - (bottom + top) / 2, width, (top - bottom) / 2) else "box")
    return Extent(form, float(width), float(depth), bottom, top)

