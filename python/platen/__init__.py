"""Platen in Python: results of its programs as numpy arrays, and experiments that a script builds, runs and changes.

    import platen
    run = platen.Run("results/demo_dry")             # what a program has written
    run.history["axial_stress_top_pa"].max()

    experiment = platen.Experiment("demo_dry", set={"Platens/Friction static": 0.1}, output="results/mine")
    experiment.run()

    study = platen.Sweep("demo_dry", vary={"Platens/Friction static": [0, 0.1, 0.3]}).run()    # many runs
"""
import importlib

from .errors import InputError, MissingError, NumericsError, OutputError, PlatenError

# Loaded when asked for: numpy takes a tenth of a second, the compiled part half of one; results are read without the latter.
_FROM = {**dict.fromkeys(("Frames", "Run", "Study", "Table", "read_table", "runs"), "results"),
         **dict.fromkeys(("Experiment", "scenes", "version"), "experiment"), "Sweep": "sweep", "wall_rings": "wall"}


def __getattr__(name):
    if name not in _FROM:
        raise AttributeError(f"module 'platen' has no attribute {name!r}")
    try:
        module = importlib.import_module("." + _FROM[name], __name__)
    except ImportError as error:
        raise ImportError(f"platen.{name} needs the compiled module of Platen: {error}" if _FROM[name] == "experiment" else
                          f"platen.{name}: {error}") from None
    return getattr(module, name)


def __dir__():
    return sorted({*globals(), *_FROM})


__all__ = ["Experiment", "Frames", "InputError", "MissingError", "NumericsError", "OutputError", "PlatenError", "Run", "Study", "Sweep",
           "Table", "read_table", "runs", "scenes", "version", "wall_rings"]
