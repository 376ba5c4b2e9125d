"""What goes wrong, as exceptions. The programs tell the same by their exit status (2, 3, 4)."""
import os


class PlatenError(Exception):
    """Any failure of Platen."""


class InputError(PlatenError, ValueError):
    """Bad input: a scene, an argument or a results folder. `entry` is the entry of the scene that is refused
    ("Bond/Gap"), `file` and `line` where it was set; each None where the failure has none. `reason` is the message without
    its place. Of several faults they tell the first, and the text tells all."""

    def __init__(self, text, entry=None, file=None, line=None, reason=None):
        super().__init__(text)
        self.entry, self.file, self.line, self.reason = entry, file, line, reason if reason is not None else text


class MissingError(InputError, KeyError, IndexError):
    """A column, a run or a frame that is not there: also a KeyError and an IndexError."""

    __str__ = Exception.__str__  # a KeyError would quote its text


class NumericsError(PlatenError, ArithmeticError):
    """The computation stopped: not finite, a time step above the limit, a solver that did not converge."""


class OutputError(PlatenError, OSError):
    """Reading or writing failed during a run."""


def path_text(path, what):
    """The text of a path, or of a name. InputError where it is none: `what` is refused with its value."""
    try:
        text = os.fsdecode(path)
        os.fsencode(text)
    except (TypeError, UnicodeError):
        raise InputError(f"{what} = {path!r} is no path. Allowed: a text, or a pathlib.Path") from None
    if "\0" in text:
        raise InputError(f"{what} = {path!r} is no path: it holds a NUL")
    return text
