"""A curve that a laboratory measured: read from its file as it comes, and compared with that of a run.

curve = read("core_7.csv", area=1.963e-3, height=0.1)   # curve.strain, curve.stress, curve.remarks
"""
import codecs
import csv
import math
import re
import unicodedata
from pathlib import Path
from typing import NamedTuple

import numpy

from ..errors import InputError, path_text
from .house import BLACK, BLUE, GPA, MM, MPA, digits, legend_over
from .pages import Table

# Units that headers have, plain (see _plain), with their factors to SI: they tell what a column holds.
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


class Curve(NamedTuple):
    """strain, stress: arrays of one length, SI, compression positive. remarks: what was taken and changed, sentences."""

    strain: numpy.ndarray
    stress: numpy.ndarray
    remarks: list


class _Column(NamedTuple):
    index: int
    what: str  # a key of UNITS
    factor: float
    header: str


def _plain(text):
    """Small letters without superscripts, so that units of all typists are alike."""
    text = unicodedata.normalize("NFKC", text.replace("−", "-")).casefold().replace("μ", "u").replace("^", "").replace("**", "")
    return re.sub(r"\s+", " ", re.sub(r"\s*/\s*", "/", text)).strip()


def unit_of(header):
    """(what, factor) of a header such as "Stress (MPa)", "Load kN", "strain [%]"; None where it has no unit."""
    text = _plain(header)
    if re.fullmatch(r"(axial_)?strain_(platen|gauge)", text):  # as Platen writes it
        return "strain", 1.0
    for inside in reversed(re.findall(r"[\[({<]([^\])}>]*)[\])}>]", text)):
        inside = inside.strip().removeprefix("in ").removeprefix("x")
        if inside in _OF_UNIT:
            return _OF_UNIT[inside]
    text = text.rstrip(" .:)]")
    for unit in sorted(_OF_UNIT, key=len, reverse=True):
        before = text[: -len(unit)]
        if text.endswith(unit) and unit not in _ONLY_IN_BRACKETS and not (before and before[-1].isalnum() and unit[0].isalpha()):
            return _OF_UNIT[unit]
    return None


def _score(column):
    text = _plain(column.header)
    return 2 * bool(re.search(_NAMES[column.what], text)) + bool(re.search(_ALONG, text))


def _parse_columns(text):
    """{"x": (what, unit or None, column), "y": ...} of "strain=A,stress/kPa=B"."""
    asked = {}
    for part in re.split(r",\s*(?=(?:strain|displacement|stress|load)(?:/[^=]*)?=)", text or "") if text else []:
        found = re.fullmatch(r"\s*(strain|displacement|stress|load)(?:/([^=]*))?=(.*\S)\s*", part)
        unit = _plain(found[2]) if found and found[2] else None
        if not found or (unit and unit not in UNITS[found[1]]):
            raise InputError(f"--columns = {text!r} is not understood at {part!r}. {_HOW}")
        asked["x" if found[1] in ("strain", "displacement") else "y"] = (found[1], unit, found[3].strip())
    return asked


def _asked_column(heads, what, unit, name):
    if name.isdigit():
        index = int(name) - 1
    else:
        fits = [(_plain(head) != _plain(name), k) for k, head in enumerate(heads) if _plain(head).startswith(_plain(name))]
        index = min(fits)[1] if fits else -1
    head = heads[index] if 0 <= index < len(heads) else ""
    found = (what, UNITS[what][unit]) if unit else unit_of(head)
    return _Column(index, what, found[1], head or name) if index >= 0 and found and found[0] == what else None


def _choose(heads, asked):
    """(x, y, others): the _Columns of a header, and further ones that would do as well; None where it has not both."""
    known = [_Column(k, *unit, head) for k, head in enumerate(heads) if (unit := unit_of(head)) and not re.search(_OTHER, _plain(head))]
    chosen, others = [], []
    for axis, kinds in (("x", ("strain", "displacement")), ("y", ("stress", "load"))):
        if axis in asked:
            chosen.append(_asked_column(heads, *asked[axis]))
            continue
        fits = sorted((c for c in known if c.what in kinds), key=lambda c: (-_score(c), kinds.index(c.what), c.index))
        chosen.append(fits[0] if fits else None)
        others += [c.header for c in fits[1:] if c.what == fits[0].what and _score(c) == _score(fits[0])]
    return None if None in chosen else (*chosen, others)


def _number(cell, decimal):
    text = cell.replace("−", "-").translate({ord(c): None for c in " \u00a0\u202f'" + (",.".replace(decimal, ""))}).replace(",", ".")
    return float(text) if re.fullmatch(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", text) else math.nan


def _rows(path):
    """(rows of cells, decimal mark) of a file, its separator found by trial."""
    try:
        data = Path(path_text(path, "path")).read_bytes()
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        text = data.decode("utf-16", "replace")
    else:
        try:
            text = data.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = data.decode("cp1252", "replace")
    lines = [re.sub(r"^\s*(#|//|!|%\s+(?=\w))+\s*", "", line) for line in text.replace("\0", "").splitlines()]
    best = None
    for separator in "\t;,":
        some = list(csv.reader(lines[:_POINTS], delimiter=separator))
        cells = [cell.strip() for row in some for cell in row]
        commas, dots = (sum(bool(re.fullmatch(rf"[-+ \d'.,]*\{mark}\d+([eE][-+]?\d+)?", cell)) for cell in cells) for mark in ",.")
        decimal = "," if commas > dots else "."
        counts = [[not math.isnan(_number(cell, decimal)) for cell in row if cell.strip()] for row in some]
        worth = (sum(len(row) > 1 and all(row) for row in counts), sum(sum(row) > 1 for row in counts))
        if best is None or worth > best[0]:
            best = worth, separator, decimal
    return list(csv.reader(lines, delimiter=best[1])), best[2]


def _with_units(cells):
    """Cells of "Displacement, mm,Load kN" where a comma is the separator too."""
    joined = []
    for cell in cells:
        if joined and _plain(cell) in _OF_UNIT and unit_of(joined[-1]) is None:
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
            both = max(found[0].index, found[1].index)
            data = numpy.array([[_number(row[found[n].index], decimal) for n in (0, 1)] for row in rows[first:] if len(row) > both])
            data = data.reshape(-1, 2)
            there = numpy.isfinite(data).all(1)
            if there.sum() > 2:
                return (*found, data[there], int((~there[there.argmax():]).sum()))
    numbers = [sum(not math.isnan(_number(cell, decimal)) for cell in row) for row in rows]
    data = next((k for k, count in enumerate(numbers) if count > 1), None)
    if data is None:
        raise InputError(f"{path}: no rows with two numbers between comma, semicolon or tab")
    head = next((" | ".join(cell.strip() for cell in row) for row in reversed(rows[:data]) if any(cell.strip() for cell in row)), "none")
    what = f"--columns = {columns!r} does not fit its header" if asked else "its header names no strain and stress with their units"
    raise InputError(f"{path}: {what}. Header found: {head}. {_HOW}")


def _step(values, share):
    """Below it a change is noise, or says nothing."""
    changes = numpy.diff(values)
    back = -changes[changes < 0]
    least = share * abs(values[-1] - values[0])
    return max(least, 3 * float(numpy.median(back))) if len(back) > 0.05 * len(values) else least


def _thinned(strain, stress, peak):
    """Means of rows that follow each other with changes below a step; the row of the peak stays by itself."""
    steps = _step(strain[:peak + 1], 1 / _POINTS), _step(stress[:peak + 1], 5 / _POINTS)
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
    asked, name = _parse_columns(columns), Path(path_text(path, "path")).name
    x, y, others, data, without = _find(path, asked, columns)
    strain, stress, taken = data[:, 0] * x.factor, data[:, 1] * y.factor, []
    for column, size, words, unit in ((x, height, "height", 1e3), (y, area, "area", 1e6)):
        said = f"{'strain' if column is x else 'stress'} from {column.header.strip()!r}"
        if column.what in ("displacement", "load"):
            if not size or not size > 0:
                raise InputError(f"{path}: {column.header.strip()!r} is a {column.what}: it needs the {words} of the specimen, which the "
                                 "run does not say")
            said += f" over the {words} of {size * unit:.4g} mm" + "2" * (column is y)
        taken.append(said)
    strain, stress = (strain / height if x.what == "displacement" else strain), (stress / area if y.what == "load" else stress)
    remarks = [f"{name}: {' and '.join(taken)}"]
    if x.what == "displacement":
        remarks.append(f"{name}: a strain from displacements holds what the testing machine takes up, if it was measured there")
    if others:
        remarks.append(f"{name}: columns that would do as well: {', '.join(others)}")
    if without:
        remarks.append(f"{name}: rows left out because a number is missing: {without}")
    peak = int(numpy.abs(stress).argmax())
    if stress[peak] < 0:
        stress = -stress
        remarks.append(f"{name}: compression is negative in the stress of the file: its sign is turned")
    rise = strain[peak] - strain[0]
    if rise == 0:
        raise InputError(f"{path}: no strain between the first row and the largest stress")
    if abs(stress[0]) < 0.05 * stress[peak] and abs(strain[0]) > 0.01 * abs(rise):
        remarks.append(f"{name}: strain counts from its first value, {strain[0] * MM:.4g} mm/m")
        strain = strain - strain[0]
    if rise < 0:
        strain = -strain
        remarks.append(f"{name}: compression is negative in the strain of the file: its sign is turned")
    thin, mean, step = _thinned(strain, stress, peak)
    if len(thin) < len(strain):
        remarks.append(f"{name}: {len(strain)} rows are thinned to {len(thin)}: rows of one strain, and of strains that differ by less "
                       f"than {step * MM:.2g} mm/m, are their mean")
    return Curve(thin, mean, remarks)


def figures(strain, stress):
    """(E in Pa, strength in Pa, strain at the peak, stress in Pa at 1.5 times that strain) of a curve whose peak is positive. E:
    secant between 10 and 40 % of the peak. NaN where the curve does not have it."""
    peak = int(stress.argmax())

    def rises_to(level):
        k = int((stress >= level).argmax())
        return math.nan if k == 0 else numpy.interp(level, stress[k - 1:k + 1], strain[k - 1:k + 1])

    strength, at, after = stress[peak], strain[peak], strain[peak:] >= 1.5 * strain[peak]
    later = math.nan
    if after.any() and at > 0:
        k = peak + int(after.argmax())
        later = numpy.interp(1.5 * at, strain[k - 1:k + 1], stress[k - 1:k + 1])
    low, high = rises_to(0.1 * strength), rises_to(0.4 * strength)
    return (0.3 * strength / (high - low) if high > low else math.nan), float(strength), float(at), float(later)


def _of_run(run):
    """(sign, strain, stress) of a run from the end of consolidation on: the peak is positive after the sign."""
    sign, strain, stress = -1 if run.peak_stress < 0 else 1, run.strain[run.rows], run.stress[run.rows]
    there = numpy.isfinite(strain) & numpy.isfinite(stress)
    return sign, strain[there], stress[there]


def differences(run, curve):
    """A pages.Table: figures of the run and of the laboratory by one rule, and their difference."""
    sign, strain, stress = _of_run(run)
    ours, theirs = figures(sign * strain, sign * stress), figures(curve.strain, curve.stress)
    rows = []
    titles = ("Young's modulus (GPa)", "strength (MPa)", "strain at the peak (mm/m)", "stress at 1.5 times the strain at the peak (MPa)")
    for words, factor, a, b in zip(titles, (GPA, MPA, MM, MPA), ours, theirs):
        no_peak = run.peak_reached is False and words != titles[0]
        rows.append([words, "no peak reached" if no_peak else digits(a * factor), digits(b * factor),
                     "-" if no_peak or not b else digits(100 * (a - b) / b)])
    return Table(["figure", run.name, "laboratory", "difference (%)"], rows, "The run beside the laboratory",
                 "Young's modulus: secant between 10 and 40 % of the peak of each curve. Strain of the run: between the platens. "
                 "Difference: of the run from the laboratory.")


def against_laboratory(axes, run, curve):
    """Stress over strain of a run and of a laboratory's Curve; dots at the peaks."""
    sign, strain, stress = _of_run(run)
    furthest = 0.0
    for x, y, colour, line, words in ((strain, stress, BLUE, "-", f"{run.name}, between platens"),
                                      (sign * curve.strain, sign * curve.stress, BLACK, "-", "laboratory")):
        peak = int((sign * y).argmax())
        axes.plot(x * MM, y * MPA, line, color=colour, label=words, lw=1.8 if colour == BLUE else 1.2)
        axes.plot(x[peak] * MM, y[peak] * MPA, "o", color=colour)
        furthest = max(furthest, 3 * abs(x[peak]), abs(strain).max())
    low, high = axes.get_xlim()
    axes.set_xlim(max(low, -1.05 * MM * furthest), min(high, 1.05 * MM * furthest))
    axes.set(xlabel=run.strain_title, ylabel=run.stress_title)
    legend_over(axes)
