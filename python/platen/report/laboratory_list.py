"""A laboratory's list of measured figures, as a person writes it; as targets of a calibration.

rows = read("mine.csv")   # SI; a row is case, figure, value, unit, deviation, over, curve
"""
import csv
import math
import re
from pathlib import Path
from typing import NamedTuple

from ..errors import InputError
from .house import MPA
from .laboratory import UNITS, lines_of, number_of, plain
from .run import number_with_unit
from .words import ENDINGS

COLUMNS = ("case", "figure", "value", "unit", "deviation", "over", "curve")
# Figures of a calibration that are no keys of summary.json; units, plain, by the SI unit that they have a factor to.
_SI = {"young modulus": "Pa", "tension": "Pa", "splitting": "Pa"}
_UNITS = {"Pa": UNITS["stress"], "1": UNITS["strain"], "m": UNITS["displacement"], "N": UNITS["load"],
          "degrees": dict.fromkeys(("degree", "degrees", "deg", "°"), 1), "J/m2": {"j/m2": 1, "n/m": 1, "n/mm": 1e3}}
MOST_TARGETS = 20


class Row(NamedTuple):
    """value, deviation: SI, the latter NaN where it is not given. curve: a Path or None. refuse(column, why): raises InputError."""

    case: str
    figure: str
    si: str
    value: float
    deviation: float
    over: str
    curve: object
    refuse: object


# ---- the file
def _entries(text):
    """[("Section/Key", "value"), ...] of "Section/Key = value, Section/Key = value"; [] where it is something else."""
    found = [re.fullmatch(r"([^=]*\w/\w[^=]*?) ?= ?(.*)", one) for one in re.split(r" ?, ?(?=[^,=]+/[^,=]+=)", " ".join(text.split()))]
    return [one.groups() for one in found] if all(found) else []


def alike(text):
    """Entries to compare: in any order, numbers in any unit; empty where the text is none."""
    return {(path, value if math.isnan(si := number_with_unit(value)) else f"{si:.10g}") for path, value in _entries(text)}


def _table(path):
    """(separator, {column: unit in its header}, columns, [(line, cells)])."""
    lines = lines_of(path, comments=False)
    for separator in ";\t,":
        rows = [(number + 1, [cell.strip() for cell in row]) for number, row in enumerate(csv.reader(lines, delimiter=separator))]
        for k, (number, head) in enumerate(rows):
            names = [re.sub(r"\W.*", "", plain(cell)) for cell in head]
            if {"case", "figure", "value"} <= {*names}:
                wrong = next((cell for cell, name in zip(head, names) if cell and (name not in COLUMNS or names.count(name) > 1)), None)
                if wrong is not None:
                    raise InputError(f"{path}:{number}: column {wrong!r} is not known, or is there twice. Allowed: {', '.join(COLUMNS)}",
                                     file=str(path), line=number)
                units = [plain(cell)[len(name):].strip(" ,:([{<>}])") for cell, name in zip(head, names)]
                return separator, dict(zip(names, units)), names, [row for row in rows[k + 1:] if any(row[1])]
    what = "is empty" if not any(line.strip() for line in lines) else "has no header with case, figure and value"
    raise InputError(f"{path}: {what}. Allowed: a row a figure, between comma, semicolon or tab, below a header of {', '.join(COLUMNS)}")


def _quantity(cell, decimal):
    """(number, unit) of "81.2 MPa", "+- 3 %"; NaN where it is none."""
    found = re.fullmatch(r"(?:\+-|\+/-|±)?\s*([-+−]?[\d.,]*\d[.,]?(?:[eE][-+−]?\d+)?)\s*(.*)", cell)
    if found is None or ("." if decimal == "," else ",") in found[1]:
        return math.nan, ""
    return number_of(found[1], decimal), found[2]


def _row(cells, heads, decimal, refuse, folder):
    """The Row of the cells of a line by column."""
    figure, over, curve, numbers = cells["figure"], cells["over"], None, []
    if not figure:
        refuse("figure", "is empty. Allowed: a number of summary.json, as strength_pa")
    si = "1" if over else _SI.get(figure) or next((unit for ending, unit in ENDINGS if figure.endswith(ending)), "1")
    units = _UNITS.get(si, {si.casefold(): 1})
    for column in ("value", "deviation") if cells["deviation"] else ("value",):
        number, unit = _quantity(cells[column], decimal)
        if not math.isfinite(number) or (column == "deviation" and number < 0):
            refuse(column, f"is no number. Allowed: a {'deviation from 0 on' if numbers else 'number'} with {decimal!r} as decimal mark and no "
                           "other, a unit behind it or in a column of its own")
        said = [plain(one) for one in (unit, "" if numbers else cells["unit"]) if one] or [*filter(None, [heads.get(column, "")])]
        of_value = numbers and said[:1] == ["%"] and numbers[0][1] != "%"
        word = said[0] if said else numbers[0][1] if numbers else ""
        if not of_value and (len({*said}) > 1 or (word not in units and (word or si != "1" or (figure.startswith("strain") and not over)))):
            refuse("unit" if cells["unit"] and unit == "" else column,
                   f"has {'the unit ' + ' and '.join(map(repr, dict.fromkeys(said))) if said else 'no unit'}. Allowed for "
                   f"{figure}{' over another case' if over else ''}: {', '.join([*units][:10])}")
        numbers.append((number / 100 * abs(numbers[0][0]) if of_value else number * units.get(word, 1), word))
    if cells["curve"]:
        curve = folder / cells["curve"]
        if not curve.is_file():
            refuse("curve", f"is not there. Allowed: a file, its path from {folder or '.'}")
    return Row(cells["case"], figure, si, numbers[0][0], numbers[1][0] if len(numbers) > 1 else math.nan, over, curve, refuse)


def read(path):
    """The Rows of a list. InputError with file, line, column and value for what it cannot mean."""
    path, found = Path(path), []
    try:
        separator, heads, names, rows = _table(path)
    except csv.Error as error:
        raise InputError(f"{path}: damaged: {error}") from None
    numbers = [k for k, name in enumerate(names) if name in ("value", "deviation")]
    decimal = "," if separator != "," and any("," in row[k] for _, row in rows for k in numbers if k < len(row)) else "."
    for line, row in rows:
        if any(row[len(names):]):
            raise InputError(f"{path}:{line}: {len(row)} cells where the header has {len(names)}. Allowed: a text that holds {separator!r} in "
                             "quotes", file=str(path), line=line)
        cells = {**dict.fromkeys(COLUMNS, ""), **dict(zip(names, row))}

        def refuse(column, why, line=line, cells=cells):
            raise InputError(f"{path}:{line}: {column} = {cells[column]!r} {why}", file=str(path), line=line)
        found.append(_row(cells, heads, decimal, refuse, path.parent))
    if not found:
        raise InputError(f"{path}: has no row below its header")
    return found


def once(rows, keys):
    for k, key in enumerate(keys):
        if key in keys[:k]:
            rows[k].refuse("case", f"has {rows[k].figure} twice. Allowed: one row for each case and figure")


# ---- targets
def targets(path):
    """The list as a section Calibrate, as platen-calibrate reads it. InputError for what it does not take."""
    rows, lines = read(path), []
    if len(rows) > MOST_TARGETS:
        rows[MOST_TARGETS].refuse("figure", f"is one too many. Allowed: {MOST_TARGETS} targets")
    for number, row in enumerate(rows, 1):
        for column, text in (("case", row.case), ("over", row.over)):
            if text and (not _entries(text) or re.search(r"[:#\\]|\+-| at | over ", text)):
                row.refuse(column, "cannot be turned into entries. Allowed: \"Section/Key = value, Section/Key = value\", as -s takes them")
        at, over = (", ".join(" = ".join(one) for one in _entries(text)) for text in (row.case, row.over))
        lost = [entry for entry, _ in _entries(row.case) if over and entry not in dict(_entries(row.over))]
        if lost:
            row.refuse("over", f"does not set {lost[0]}, which the case sets and a target keeps. Allowed: all entries of the case")
        if not row.value > 0 or row.deviation > 0.5 * row.value:
            row.refuse("deviation" if row.value > 0 else "value", "is no target. Allowed: values above 0, deviations to half of the value")
        factor, unit = (MPA, " MPa") if row.si == "Pa" else (1, "")
        line = row.figure + (f" at {at}" if at else "") + (f" over {over}" if over else "") + f": {row.value * factor:.9g}{unit}"
        if row.deviation > 0:  # of a number without a unit a tolerance is relative
            line += f" +- {row.deviation * factor:.9g}{unit}" if unit else f" +- {100 * row.deviation / row.value:.4g} %"
        lines.append(f"  set Target {number} = {line}\n")
        if row.curve:
            lines.append(f"  # {row.curve.name} is no target: --laboratory {row.curve.name} --curve NEW makes it one\n")
    once(rows, [(row.figure, alike(row.case), alike(row.over)) for row in rows])
    return f"subsection Calibrate\n{''.join(lines)}end\n"
