"""A curve that a laboratory measured: read from its file as it comes, and compared with that of a run.

curve = read("core_7.csv", area=1.963e-3, height=0.1)   # curve.strain, curve.stress, curve.remarks
"""
import codecs
import csv
import math
import re
import unicodedata
from collections import namedtuple
from pathlib import Path

import numpy

from ..errors import InputError, path_text
from .house import BLACK, BLUE, GPA, MM, MPA, digits, titled
from .pages import Table

# Units that headers have, plain (see plain), with their factors to SI: they tell what a column holds.
UNITS = {"strain": {"mm/m": 1e-3, "mm per m": 1e-3, "‰": 1e-3, "o/oo": 1e-3, "per mille": 1e-3, "permille": 1e-3, "promille": 1e-3,
                    "10-3": 1e-3, "%": 1e-2, "percent": 1e-2, "per cent": 1e-2, "microstrain": 1e-6, "um/m": 1e-6, "uε": 1e-6, "ue": 1e-6,
                    "ustrain": 1e-6, "10-6": 1e-6, "mm/mm": 1, "m/m": 1, "in/in": 1, "-": 1, "1": 1},
         "displacement": {"mm": 1e-3, "cm": 1e-2, "um": 1e-6, "micron": 1e-6, "m": 1, "inch": 0.0254, "in": 0.0254},
         "stress": {"mpa": 1e6, "n/mm2": 1e6, "kpa": 1e3, "kn/m2": 1e3, "gpa": 1e9, "pa": 1, "n/m2": 1, "kn/cm2": 1e7, "bar": 1e5,
                    "psi": 6894.757, "ksi": 6.894757e6, "kgf/cm2": 98066.5, "kg/cm2": 98066.5},
         "load": {"kn": 1e3, "n": 1, "mn": 1e6, "lbf": 4.448222, "lb": 4.448222, "kip": 4448.222, "kips": 4448.222, "kgf": 9.80665}}
_OF_UNIT = {unit: (what, factor) for what, units in UNITS.items() for unit, factor in units.items()}
_ONLY_IN_BRACKETS = ("-", "1", "in", "10-3", "10-6")
# Parts of words that name the quantity, that name the loaded axis, and that name something else with the same unit.
_NAMES = {"strain": "strain|dehn|stauch|deform|ε|eps", "stress": "stress|spann|σ|sigma|contraint|tension",
          "load": "load|force|kraft|last|charge",
          "displacement": "displ|deform|verform|cross|stroke|position|weg|lvdt|exten|travel|shorten|ram|piston|dépl|depl"}
_ALONG = "axial|axis|long|vert"
_OTHER = "lateral|radial|transv|circum|volum|quer|hoop|umfang|confin|pore|seiten|diamet|width|height|length|humid|feucht|shear"
_HOW = ('Name them: --columns "strain=COLUMN,stress=COLUMN", by name or number from 1; displacement=COLUMN and load=COLUMN are allowed, '
        "and a unit where the header has none: strain/%=COLUMN, load/kN=COLUMN")
_POINTS, _ROWS_OF_HEAD = 500, 200


class Curve(namedtuple("Curve", "strain stress remarks")):
    """strain, stress: arrays of one length, SI, compression positive. remarks: what was taken and changed, sentences."""


class _Column(namedtuple("Column", "index what factor header")):  # what: a key of UNITS
    @property
    def score(self):
        """How well its name fits what it holds, and the loaded axis."""
        text = plain(self.header)
        return 2 * bool(re.search(_NAMES[self.what], text)) + bool(re.search(_ALONG, text))


# ---- headers
def plain(text):
    """Small letters without superscripts, so that units of all typists are alike."""
    text = unicodedata.normalize("NFKC", text.replace("−", "-")).casefold().replace("μ", "u").replace("^", "").replace("**", "")
    return re.sub(r"\s+", " ", re.sub(r"\s*/\s*", "/", text)).strip()


def unit_of(header):
    """(what, factor) of a header such as "Stress (MPa)", "Load kN", "strain [%]"; None where it has no unit."""
    text = plain(header)
    if re.fullmatch(r"(axial_)?strain_(platen|gauge)", text):  # as Platen writes it
        return "strain", 1.0
    for inside in reversed(re.findall(r"[\[({<]([^\])}>]*)[\])}>]", text)):
        inside = inside.strip().removeprefix("in ").removeprefix("x")
        if inside in _OF_UNIT:
            return _OF_UNIT[inside]
    text = text.rstrip(" .:)]")
    for unit in sorted({*_OF_UNIT} - {*_ONLY_IN_BRACKETS}, key=len, reverse=True):
        if text.endswith(unit) and not (text[: -len(unit)][-1:].isalnum() and unit[0].isalpha()):
            return _OF_UNIT[unit]
    return None


def _parse_columns(text):
    """{"x": (what, unit or None, column), "y": ...} of "strain=A,stress/kPa=B"."""
    asked = {}
    for part in re.split(r",\s*(?=(?:strain|displacement|stress|load)(?:/[^=]*)?=)", text) if text else []:
        found = re.fullmatch(r"\s*(strain|displacement|stress|load)(?:/([^=]*))?=(.*\S)\s*", part)
        unit = plain(found[2]) if found and found[2] else None
        if not found or (unit and unit not in UNITS[found[1]]):
            raise InputError(f"--columns = {text!r} is not understood at {part!r}. {_HOW}")
        asked["x" if found[1] in ("strain", "displacement") else "y"] = (found[1], unit, found[3].strip())
    return asked


def _asked_column(heads, what, unit, name):
    index = int(name) - 1 if name.isdigit() else min(((plain(head) != plain(name), k) for k, head in enumerate(heads)
                                                      if plain(head).startswith(plain(name))), default=(0, -1))[1]
    head = heads[index] if 0 <= index < len(heads) else ""
    found = (what, UNITS[what][unit]) if unit else unit_of(head)
    return _Column(index, *found, head or name) if index >= 0 and found and found[0] == what else None


def _choose(heads, asked):
    """(x, y, others): the _Columns of a header, and further ones that would do as well; None where it has not both."""
    known = [_Column(k, *unit, head) for k, head in enumerate(heads) if (unit := unit_of(head)) and not re.search(_OTHER, plain(head))]
    chosen, others = [], []
    for axis, kinds in (("x", ("strain", "displacement")), ("y", ("stress", "load"))):
        fits = sorted((c for c in known if c.what in kinds), key=lambda c: (-c.score, kinds.index(c.what), c.index))
        if axis in asked:
            fits = [_asked_column(heads, *asked[axis])]
        chosen.append(fits[0] if fits else None)
        others += [c.header for c in fits[1:] if c.what == fits[0].what and c.score == fits[0].score]
    return None if None in chosen else (*chosen, others)


# ---- files
def number_of(cell, decimal):
    text = cell.replace("−", "-").translate({ord(c): None for c in " \u00a0\u202f'" + (",.".replace(decimal, ""))}).replace(",", ".")
    return float(text) if re.fullmatch(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", text) else math.nan


def lines_of(path, comments=True):
    """Lines of a file of any coding. comments: those that a # begins are lines without it, else empty."""
    try:
        data = Path(path_text(path, "path")).read_bytes()
        text = data.decode("utf-16" if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)) else "utf-8-sig")
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        text = data.decode("cp1252", "replace")
    marked = r"^\s*(#|//|!|%\s+(?=\w))+\s*" + ("" if comments else ".*")
    return [re.sub(marked, "", line) for line in text.replace("\0", "").splitlines()]


def _rows(path):
    """(rows of cells, decimal mark) of a file, its separator found by trial."""
    lines, tried = lines_of(path), []
    for separator in "\t;,":
        some = list(csv.reader(lines[:_POINTS], delimiter=separator))
        cells = [cell.strip() for row in some for cell in row]
        commas, dots = (sum(bool(re.fullmatch(rf"[-+ \d'.,]*\{mark}\d+([eE][-+]?\d+)?", cell)) for cell in cells) for mark in ",.")
        decimal = "," if commas > dots else "."
        counts = [[not math.isnan(number_of(cell, decimal)) for cell in row if cell.strip()] for row in some]
        worth = (sum(len(row) > 1 and all(row) for row in counts), sum(sum(row) > 1 for row in counts))
        tried.append((worth, separator, decimal))
    _, separator, decimal = max(tried, key=lambda one: one[0])
    return list(csv.reader(lines, delimiter=separator)), decimal


def _with_units(cells):
    """Cells of "Displacement, mm,Load kN" where a comma is the separator too."""
    joined = []
    for cell in cells:
        if joined and plain(cell) in _OF_UNIT and unit_of(joined[-1]) is None:
            joined[-1] += "," + cell
        else:
            joined.append(cell)
    return joined


def _find(path, asked, columns):
    """(x, y, others, array of the two columns, rows without a number) of a file."""
    try:
        rows, decimal = _rows(path)
    except csv.Error as error:
        raise InputError(f"{path}: damaged: {error}") from None
    for k in range(-1, min(len(rows), _ROWS_OF_HEAD)):
        head, below = rows[k] if k >= 0 else [], rows[k + 1] if k + 1 < len(rows) else []
        joined = [f"{one} {two}" for one, two in zip(head, below)] if len(head) == len(below) else []
        for heads, first in ((head if len(head) <= len(below) else _with_units(head), k + 1), (joined, k + 2)):
            found = _choose(heads, asked)
            if found is None:
                continue
            both = [column.index for column in found[:2]]
            data = numpy.array([[number_of(row[n], decimal) for n in both] for row in rows[first:] if len(row) > max(both)]).reshape(-1, 2)
            there = numpy.isfinite(data).all(1)
            if there.sum() > 2:
                return (*found, data[there], int((~there[there.argmax():]).sum()))
    numbers = [sum(not math.isnan(number_of(cell, decimal)) for cell in row) for row in rows]
    data = next((k for k, count in enumerate(numbers) if count > 1), None)
    if data is None:
        raise InputError(f"{path}: no rows with two numbers between comma, semicolon or tab")
    head = next((" | ".join(cell.strip() for cell in row) for row in reversed(rows[:data]) if any(cell.strip() for cell in row)), "none")
    what = f"--columns = {columns!r} does not fit its header" if asked else "its header names no strain and stress with their units"
    raise InputError(f"{path}: {what}. Header found: {head}. {_HOW}")


def _thinned(strain, stress, peak):
    """Means of rows that follow each other with changes below a step, and that of the strain; the row of the peak stays by itself."""

    def step(values, share):  # below it a change is noise, or says nothing
        changes = numpy.diff(values)
        back = -changes[changes < 0]
        least = share * abs(values[-1] - values[0])
        return max(least, 3 * float(numpy.median(back))) if len(back) > 0.05 * len(values) else least

    steps = step(strain[:peak + 1], 1 / _POINTS), step(stress[:peak + 1], 5 / _POINTS)
    x, y, starts = strain.tolist(), stress.tolist(), [0]
    for k in range(1, len(x)):
        start = starts[-1]
        if k in (peak, peak + 1) or (x[k] != x[start] and (abs(x[k] - x[start]) >= steps[0] or abs(y[k] - y[start]) >= steps[1])):
            starts.append(k)
    counts = numpy.diff([*starts, len(x)])
    return numpy.add.reduceat(strain, starts) / counts, numpy.add.reduceat(stress, starts) / counts, steps[0]


def read(path, columns=None, area=None, height=None):
    """The Curve of a laboratory's file: any header with units, comma, semicolon or tab between columns, decimal point or comma,
    lines before the header. columns: "strain=COLUMN,stress=COLUMN" where the header does not say them. area (m2), height (m) of
    the specimen: for load and displacement. InputError where columns cannot be found, or a size is wanted that is not given."""
    x, y, others, data, without = _find(path, _parse_columns(columns), columns)
    values, taken = [], []
    for k, (column, size, words, unit) in enumerate(((x, height, "height", "{:.4g} mm"), (y, area, "area", "{:.4g} mm2"))):
        values.append(data[:, k] * column.factor)
        taken.append(f"{('strain', 'stress')[k]} from {column.header.strip()!r}")
        if column.what in ("displacement", "load"):
            if not size or not size > 0:
                raise InputError(f"{path}: {column.header.strip()!r} is a {column.what}: it needs the {words} of the specimen, which the "
                                 "run does not give")
            values[k] = values[k] / size
            taken[k] += f" over the {words} of " + unit.format(size * 1e3 ** (k + 1))
    strain, stress = values
    said = [" and ".join(taken)]
    if x.what == "displacement":
        said.append("a strain from displacements includes the deformation of the testing machine, if the displacement was measured there")
    if others:
        said.append(f"other columns that fit: {', '.join(others)}")
    if without:
        said.append(f"rows left out because a number is missing: {without}")
    peak = int(numpy.abs(stress).argmax())
    if stress[peak] < 0:
        stress = -stress
        said.append("compression is negative in the stress of the file: its sign is reversed")
    rise = strain[peak] - strain[0]
    if rise == 0:
        raise InputError(f"{path}: no strain between the first row and the largest stress")
    if abs(stress[0]) < 0.05 * stress[peak] and abs(strain[0]) > 0.01 * abs(rise):
        said.append(f"strain counts from its first value, {strain[0] * MM:.4g} mm/m")
        strain = strain - strain[0]
    if rise < 0:
        strain = -strain
        said.append("compression is negative in the strain of the file: its sign is reversed")
    thin, mean, step = _thinned(strain, stress, peak)
    if len(thin) < len(strain):
        said.append(f"{len(strain)} rows are thinned to {len(thin)}: rows of one strain, and of strains that differ by less than "
                    f"{step * MM:.2g} mm/m, are their mean")
    return Curve(thin, mean, [f"{Path(path).name}: {text}" for text in said])


def of_specimen(run, file, columns=None):
    """The Curve of a file of a laboratory, over the size of the specimen of a TestRun."""
    height = run.extent.height if run.series("specimen") else None
    return read(file, columns, run.info.get("section", {}).get("area_m2"), height)


# ---- beside a run
def figures(strain, stress):
    """(E in Pa, strength in Pa, strain at the peak, stress in Pa at 1.5 times that strain) of a curve whose peak is positive. E:
    secant between 10 and 40 % of the peak. NaN where the curve does not have it."""
    peak = int(stress.argmax())
    strength, at = stress[peak], strain[peak]

    def rises_to(level):
        k = int((stress >= level).argmax())
        return numpy.interp(level, stress[k - 1:k + 1], strain[k - 1:k + 1]) if k else math.nan

    after, later = strain[peak:] >= 1.5 * at, math.nan
    if after.any() and at > 0:
        k = peak + int(after.argmax())
        later = numpy.interp(1.5 * at, strain[k - 1:k + 1], stress[k - 1:k + 1])
    low, high = rises_to(0.1 * strength), rises_to(0.4 * strength)
    return (0.3 * strength / (high - low) if high > low else math.nan), float(strength), float(at), float(later)


def _of_run(run):
    """(sign, strain, stress) of a run from the end of consolidation on: the peak is positive after the sign."""
    strain, stress = run.strain[run.rows], run.stress[run.rows]
    there = numpy.isfinite(strain) & numpy.isfinite(stress)
    return -1 if run.peak_stress < 0 else 1, strain[there], stress[there]


def differences(run, curve):
    """A pages.Table: figures of the run and of the laboratory by one rule, and their difference."""
    sign, strain, stress = _of_run(run)
    said, rows, reasons = run.info.get("validity"), [], {}
    for key, words, factor, a, b in zip(
            ("youngs_modulus_platen_pa", "strength_pa", "strain_at_peak_platen", "strain_at_peak_platen"),
            ("Young's modulus (GPa)", "strength (MPa)", "strain at the peak (mm/m)", "stress at 1.5 times the strain at the peak (MPa)"),
            (GPA, MPA, MM, MPA), figures(sign * strain, sign * stress), figures(curve.strain, curve.stress)):
        against = said.get(key) if isinstance(said, dict) else None
        if isinstance(against, list):  # of a bent bar or a disc the closure is no strain of the material
            reasons.update(dict.fromkeys(map(str, against)))
            rows.append([words, "not valid", digits(b * factor), "-"])
            continue
        no_peak = run.peak_reached is False and factor != GPA
        rows.append([words, "no peak reached" if no_peak else digits(a * factor), digits(b * factor),
                     "-" if no_peak or not b else digits(100 * (a - b) / b)])
    return Table(["figure", run.name, "laboratory", "difference (%)"], rows, "The run and the laboratory",
                 "Young's modulus: secant between 10 and 40 % of the peak of each curve. Strain of the run: between the platens. "
                 "Difference: of the run from the laboratory." + (f" Not valid: {'; '.join(reasons)}." if reasons else ""))


def against_laboratory(axes, run, curve):
    """Stress over strain of a run and of a laboratory's Curve; dots at the peaks."""
    sign, strain, stress = _of_run(run)
    furthest = 0.0
    for x, y, colour, width, words in ((strain, stress, BLUE, 1.8, f"{run.name}, between platens"),
                                       (sign * curve.strain, sign * curve.stress, BLACK, 1.2, "laboratory")):
        peak = int((sign * y).argmax())
        axes.plot(x * MM, y * MPA, color=colour, label=words, lw=width)
        axes.plot(x[peak] * MM, y[peak] * MPA, "o", color=colour)
        furthest = max(furthest, 3 * abs(x[peak]), abs(strain).max())
    low, high = axes.get_xlim()
    axes.set_xlim(max(low, -1.05 * MM * furthest), min(high, 1.05 * MM * furthest))
    titled(axes, run.strain_title, run.stress_title)
