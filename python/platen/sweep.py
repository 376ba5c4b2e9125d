"""One scene over a grid of values, on several packings: `platen-study vary` from Python. The compiled module is not needed."""
import subprocess
from pathlib import Path

from .errors import InputError, path_text
from .programs import call, program
from .results import Study
from .values import assignments, flag, value_text, whole

_MOST = 4  # entries Study/Vary 1 ... 4


def _scene(scene):
    """A file, or the path of the scene of this name that came with Platen."""
    text = path_text(scene, "scene")
    if Path(text).exists() or "/" in text or text.endswith((".prm", ".json")):
        return text
    asked = subprocess.run([program("platen"), "scenes", text], capture_output=True, text=True, check=False)
    if asked.returncode:
        raise InputError(f"scene = {text!r} is no file, and no scene of this name came with Platen. `platen scenes` lists them")
    return asked.stdout.strip()


def _vary(entry, values):
    """"Section/Key: value, value"."""
    if isinstance(values, (str, bytes, dict)) or not hasattr(values, "__iter__"):
        raise InputError(f"{entry} is varied over {values!r}. Allowed: a list of values", entry=entry)
    texts = [value_text(entry, value) for value in values]
    if any("," in text for text in texts):
        raise InputError(f"{entry} is varied over {values!r}: no value may be a list or hold a comma", entry=entry)
    return f"{value_text('an entry', entry)}: {', '.join(texts)}"


class Sweep:
    """Tests of one scene with each value of one entry, or with all combinations of the values of up to four, on several packings each.

    study = platen.Sweep("demo_dry", vary={"Platens/Friction static": [0, 0.1, 0.3]}, packings=3, output="results/friction").run()
    pandas.DataFrame(study.rows)

    scene: a file, or the name of a scene that came with Platen; vary: lists of values by "Section/Key": numbers in SI, texts with units,
    True and False (on, off); packings: runs of each case, Scene/Seed and those after it (None: as the scene says); set: further entries;
    output: the folder, results/NAME by default; threads: of all runs together (None: all cores).
    """

    def __init__(self, scene, vary, packings=None, set=None, output=None, threads=None):
        if not isinstance(vary, dict) or not 1 <= len(vary) <= _MOST:
            raise InputError(f"vary = {vary!r}. Allowed: a dictionary of one to {_MOST} lists by \"Section/Key\"")
        lists = [_vary(entry, values) for entry, values in vary.items()] + [""] * (_MOST - len(vary))
        options = assignments(set) + [f"Study/Vary {k} = {one}" for k, one in enumerate(lists, 1)]
        options += [] if packings is None else [f"Study/Seeds = {whole('packings', packings, 1)}"]
        self.scene = _scene(scene)
        self.folder = Path("results") / Path(self.scene).stem if output is None else Path(path_text(output, "output"))
        self._options = [word for option in options for word in ("-s", option)]
        self._options += [] if threads is None else ["-t", str(whole("threads", threads, 1))]

    def run(self, resume=False, overwrite=False):
        """Makes all runs and returns their platen.Study; run.log in its folder tells how far it is. resume: goes on with a study that was
        stopped; overwrite: replaces an earlier one. A run that fails is a row with another status than "done". InputError, NumericsError
        where no run came to its end, OutputError. Ctrl-C stops all runs, each with a checkpoint."""
        again = ["--resume"] * flag("resume", resume) + ["--overwrite"] * flag("overwrite", overwrite)
        call("platen-study", "vary", self.scene, "--quiet", "-o", str(self.folder), *self._options, *again)
        return Study(self.folder)

    def __repr__(self):
        return f"platen.Sweep({self.scene!r}, output={str(self.folder)!r})"
