"""Values that a script gives: entries of a scene as text, numbers within their limits. InputError for others."""
import math
import numbers
import operator
import os

import numpy

from .errors import InputError


def value_text(entry, value):
    """A value as a scene has it; on and off may be True and False."""
    if isinstance(value, (bool, numpy.bool_)):
        return "on" if value else "off"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, (list, tuple, numpy.ndarray)):
        return ", ".join(value_text(entry, one) for one in numpy.atleast_1d(numpy.asarray(value, dtype=object)).tolist())
    if not isinstance(value, (str, os.PathLike)):
        raise InputError(f"{entry} = {value!r} is no value. Allowed: a number, a text, True, False, or a list of them", entry=entry)
    text = os.fspath(value)
    try:
        text.encode()
    except UnicodeEncodeError as error:
        raise InputError(f"{entry} = {text!r} is no text: character {error.start + 1} is half of one", entry=entry) from None
    return text


def assignments(entries):
    """"Section/Key = value" of each entry of a dictionary."""
    if entries is None:
        return []
    if not isinstance(entries, dict) or not all(isinstance(entry, str) for entry in entries):
        raise InputError(f"{entries!r} are no entries. Allowed: a dictionary of values by \"Section/Key\"")
    return [f"{value_text('an entry', entry)} = {value_text(entry, value)}" for entry, value in entries.items()]


def number(name, value, most=math.inf):
    """A finite number from 0 to the most; None stays."""
    if value is None:
        return None
    if isinstance(value, (bool, numpy.bool_)) or not isinstance(value, numbers.Real) or not math.isfinite(value) or not 0 <= value <= most:
        raise InputError(f"{name} = {value!r}. Allowed: a number, {'>= 0' if most == math.inf else f'0 ... {most}'}")
    return float(value)


def whole(name, value, least=0, most=math.inf):
    """A whole number from the least to the most; None stays."""
    if value is None:
        return None
    if isinstance(value, (bool, numpy.bool_)) or not isinstance(value, numbers.Integral) or not least <= value <= most:
        raise InputError(f"{name} = {value!r}. Allowed: a whole number, {f'>= {least}' if most == math.inf else f'{least} ... {most}'}")
    return operator.index(value)


def flag(name, value):
    if not isinstance(value, (bool, numpy.bool_)):
        raise InputError(f"{name} = {value!r}. Allowed: True, False")
    return bool(value)
