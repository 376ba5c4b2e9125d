"""Platen in Python: results of its programs as numpy arrays, and experiments that a script builds, runs and changes.

    import platen
    run = platen.Run("results/demo_dry")             # what a program has written
    run.history["axial_stress_top_pa"].max()

    experiment = platen.Experiment("demo_dry", set={"Platens/Friction static": 0.1}, output="results/mine")
    experiment.run()
"""
from .errors import InputError, MissingError, NumericsError, OutputError, PlatenError
from .results import Frames, Run, Study, Table, read_table, runs

try:
    from .experiment import Experiment, scenes, version
except ImportError as error:  # results can be read without the compiled part
    _missing = error

    def __getattr__(name):
        if name in ("Experiment", "scenes", "version"):
            raise ImportError(f"platen.{name} needs the compiled module of Platen: {_missing}")
        raise AttributeError(f"module 'platen' has no attribute {name!r}")


__all__ = ["Experiment", "Frames", "InputError", "MissingError", "NumericsError", "OutputError", "PlatenError", "Run", "Study", "Table",
           "read_table", "runs", "scenes", "version"]
