"""What pages of studies, calibrations and single programs share: a figure over several packings, bars, checks of files."""
import math
from contextlib import contextmanager
from typing import NamedTuple

import numpy
from matplotlib.ticker import LogLocator, NullLocator

from ..errors import InputError
from ..results import read_table
from .house import BLACK, BLUE
from .run import number_in

FEW = 5  # packings: of fewer a standard deviation says little, their range is given


def with_unit(name, unit):
    """"strength (MPa)"."""
    return f"{name} ({unit})" if unit else name


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


class Spread(NamedTuple):
    """A figure over packings, in one unit: mean, ends of its bar, how many packings gave it."""

    mean: float = math.nan
    low: float = math.nan
    high: float = math.nan
    packings: int = 0

    def words(self, digits, packings=None):
        """"41.0 +- 0.9", of fewer than five packings "40.1 ... 41.9"; how many they are where they are not `packings`. digits: as
        in ".1f"."""
        if math.isnan(self.mean):
            return "-"
        text = f"{self.mean:{digits}}"
        if self.packings >= FEW:
            text += f" +- {self.high - self.mean:{digits[-3:] if digits[-1] == 'f' else '.2g'}}"
        elif self.high > self.low:
            text = f"{self.low:{digits}} ... {self.high:{digits}}"
        return text if packings in (None, self.packings) else f"{text} ({self.packings})"


def over_packings(said, factor=1.0):
    """The Spread of {"mean", "deviation", "low", "high", "runs"} of a study, or with "seeds" of a calibration."""
    mean, deviation, low, high = (number_in(said, key) * factor for key in ("mean", "deviation", "low", "high"))
    packings = int(said["runs"] if "runs" in said else said["seeds"])
    if packings >= FEW:
        low, high = mean - deviation, mean + deviation
    return Spread(mean, low if low <= mean else mean, high if high >= mean else mean, packings)


def scatter_bars(axes, x, low, high, colour):
    """Bars of scatter with ends; none where there is one number."""
    x, low, high = (numpy.asarray(values, float) for values in (x, low, high))
    some = high > low
    axes.vlines(x[some], low[some], high[some], color=colour, lw=1.2)
    axes.scatter(numpy.r_[x[some], x[some]], numpy.r_[low[some], high[some]], marker="_", color=colour, s=30)


def plain_decades(axis):
    """Ticks and plain numbers at 1, 2, 5 of a logarithmic axis, of about one decade at all digits."""
    low, high = axis.get_view_interval()
    axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high > 12 * low else range(1, 10)))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_locator(NullLocator())


def bars(axes, names, values, texts, title, colours=BLUE, mark=None):
    """Horizontal bars from above to below, with a text after each; a line at `mark`."""
    axes.barh(range(len(values)), values, color=colours, height=0.62)
    for k, (value, text) in enumerate(zip(values, texts)):
        axes.annotate(text, (max(value, 0), k), (4, 0), textcoords="offset points", va="center", bbox={"fc": "w", "ec": "none", "pad": 1})
    axes.set_yticks(range(len(values)), names)
    axes.set_xlabel(title)
    axes.invert_yaxis()
    axes.grid(False, axis="y")
    axes.margins(x=0.15)
    if mark is not None:
        axes.axvline(mark, color=BLACK)
