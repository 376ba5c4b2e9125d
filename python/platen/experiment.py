"""Experiments that a script builds, runs and changes on the way."""
import json
import os
import threading
from pathlib import Path

from . import _core
from .errors import InputError, path_text
from .results import Run, Table
from .values import assignments, flag, number, whole


def version():
    """What Platen was made of, as `platen --version --json` says it."""
    return json.loads(_core.version_json())


def scenes():
    """Paths of the scenes that came with Platen, by name."""
    return {path.stem: path for path in sorted(Path(_core.shipped_scenes()).glob("*.prm"))}


def _path_of(scene):
    """A file, or the name of a scene that came with Platen."""
    path = path_text(scene, "scene")
    return path if os.path.isfile(path) else os.fspath(scenes().get(path, path))


class Experiment:
    """A test between platens, as platen-compress makes it, under the hands of a script.

    experiment = platen.Experiment("demo_dry", set={"Platens/Friction static": 0.1}, output="results/mine", threads=2)
    experiment.on_sample = lambda row: print(row["axial_strain_platen"])
    experiment.advance(strain=0.001)
    experiment.change({"Platens/Friction static": 0.3})
    run = experiment.run()              # to its end: a platen.Run

    scene: a file, or the name of a scene that came with Platen; set: entries of it, numbers in SI or texts with units;
    output: the folder, results/NAME by default; overwrite: an earlier run there is replaced; disc: the specimen lies on its
    rim, as platen-brazilian lays it; verbose: it prints what the program prints. What it writes without a change is what the
    program writes, byte by byte. Raises InputError, NumericsError, OutputError.
    """

    def __init__(self, scene, set=None, output="", threads=1, overwrite=False, disc=False, verbose=False):
        if threads is None:
            raise InputError("threads = None. Allowed: a whole number")
        threads = whole("threads", threads, 1, max(64, 4 * (os.cpu_count() or 1)))
        # Names of files in bytes: they need not be text.
        self._core = _core.make(os.fsencode(_path_of(scene)), assignments(set), os.fsencode(path_text(output, "output")), threads,
                                flag("disc", disc), flag("overwrite", overwrite), flag("verbose", verbose))
        self._on_sample = None
        self.expected = None
        self._failures = {}  # of callbacks, by the thread that makes the pass

    def __getattr__(self, name):
        if name == "_core":
            raise InputError("the experiment was not made: platen.Experiment(scene)")
        raise AttributeError(f"an Experiment has no {name}")

    # ---- running
    def advance(self, strain=None, time=None, steps=None, samples=None):
        """Runs until the strain of the platens (1, its size: positive in tension too), the time (s), so many steps or so many
        samples more are reached, or the test is over; at least one of them. It stops at the next moment that something is
        written or looked at, 16 steps at most beyond. True while the test goes on. InputError for what is no such number. Threads
        take turns, pass by pass: each one's limits hold for the one experiment that all of them advance."""
        if all(limit is None for limit in (strain, time, steps, samples)):
            raise InputError("advance() needs a limit: strain, time, steps or samples")
        strain, time = number("strain", strain, most=1), number("time", time)
        steps, samples = whole("steps", steps), whole("samples", samples)
        core = self._core
        last_step = None if steps is None else core.steps + steps
        last_sample = None if samples is None else core.samples + samples
        if core.ended:
            raise InputError("the experiment has ended: make a new one")
        while not core.finished:
            if ((strain is not None and abs(core.strain) >= strain) or (time is not None and core.time >= time)
                    or (last_step is not None and core.steps >= last_step)
                    or (last_sample is not None and core.samples >= last_sample)):
                return True
            self._pass()
        return False

    def run(self):
        """Runs to the end and writes the results: the platen.Run. `expected` tells whether what the scene expects holds."""
        while not self._core.finished:
            self._pass()
        return self.end()

    def end(self):
        """Ends here: events, cracks, the last frame and summary.json are written. The platen.Run. Before its target the test has not
        measured what the scene expects: `expected` is None then, and `ended_by` in the summary is "script"."""
        if not self._core.ended:
            finished = self._core.finished
            held = self._core.end()
            self.expected = held if finished else None
        return Run(self.folder)

    def close(self):
        """Leaves the test where it is, without summary.json: checkpoints stay, and the folder is free for another run, for the program
        with --resume for one. `with platen.Experiment(...) as experiment:` closes at its end. Views stay right."""
        if not self._core.ended:
            self._core.close()

    def __enter__(self):
        return self

    def __exit__(self, *failure):
        self.close()

    def _pass(self):
        """Python looks at Ctrl-C between two passes."""
        self._core.passes()
        failure = self._failures.pop(threading.get_ident(), None)
        if failure is not None:
            raise failure

    # ---- changing
    def change(self, entries):
        """From the next step on: friction of platens and grains, Loading/Axial rate, Loading/Stop at residual, Output/Every,
        Output/Fields every, Checkpoint/Every. It is noted in run.log and summary.json. InputError for anything else."""
        self._core.change(assignments(entries))

    @property
    def on_sample(self):
        """Called with each row of history.csv, a dictionary, once it is written, by the thread that advances; None: nothing is. It
        may look at the experiment and change it; advance(), end() and close() are refused within it."""
        return self._on_sample

    @on_sample.setter
    def on_sample(self, function):
        if function is not None and not callable(function):
            raise InputError(f"on_sample = {function!r}. Allowed: a function of a row, None")
        self._on_sample = function
        if function is None:
            self._core.listen(None)
            return
        failures = self._failures  # and not self, which would keep the experiment for ever

        def call(row):
            try:
                function(row)
            except BaseException as failure:  # what a callback raises comes out of advance() and run()
                failures[threading.get_ident()] = failure

        self._core.listen(call)

    # ---- looking
    finished = property(lambda self: self._core.finished, doc="Whether the test is over.")
    folder = property(lambda self: Path(os.fsdecode(self._core.folder)), doc="Where it writes.")
    time = property(lambda self: self._core.time, doc="s")
    time_step = property(lambda self: self._core.time_step, doc="s")
    steps = property(lambda self: self._core.steps, doc="Made so far.")
    strain = property(lambda self: self._core.strain, doc="Closure of the platens over the length; compression positive.")
    stress = property(lambda self: self._core.stress, doc="Pa, mean of both platens; compression positive.")

    @property
    def history(self):
        """The rows of history.csv so far: a platen.Table, a copy."""
        return Table(self._core.history())

    @property
    def summary(self):
        """What summary.json would say now."""
        return json.loads(self._core.summary())

    @property
    def spheres(self):
        """Columns of the spheres by name: id, position (n x 3, m), reference_position, velocity, force, radius, mass and, where
        the scene has rotation, orientation, angular_velocity, torque, inertia. Views of the memory, no copies: to be read, and
        right whenever no step is being made."""
        return self._core.spheres()

    @property
    def bonds(self):
        """Columns of all bonds that ever were: first, second (rows of spheres), state (0 intact, 1 damaged, 2 broken in tension, 3
        in shear), break_time (s). Views, as those of the spheres."""
        return self._core.bonds()

    @property
    def units(self):
        """Unit of each column of spheres and bonds."""
        return self._core.units()

    def __repr__(self):
        return f"<platen.Experiment in {self.folder}: step {self.steps}, strain {self.strain:.5f}>"
