"""What the scripts of this folder share: small runs, what they leave behind, and figures."""

import argparse
import contextlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

os.environ.setdefault("PLATEN_CACHE", "none")  # what is tested is made here, not found
SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
SCENES = SOURCE / "tests/apps/scenes"
CRUSHED = SCENES / "crushed.prm"

# 129 spheres crushed in a second or two, most of it spent on writing.
TINY = ["Specimen/Sphere radius = 1.7 mm"]
PLATENS = {
    "rigid": [],
    "elastic": ["Platens/Kind = deformable", "Loading/Target strain = 0.004"],
    "sleeve": ["Loading/Confinement = sleeve", "Loading/Confining pressure = 20 MPa", "Loading/Confining ramp = 0.1 ms",
               "Sleeve/Thickness = 1 mm", "Loading/Target strain = 0.004"],
}
COSTS = ["threads", "wall_seconds", "setup_seconds", "particle_steps_per_second", "stage_seconds", "peak_memory_bytes",
         "bytes_in_columns_and_search", "trials"]
CHECKPOINT = "step_????????????.platen"


def parser(text):
    """The command line of a script with this docstring."""
    return argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)


@contextlib.contextmanager
def scratch():
    """A folder for as long as the block lasts."""
    with tempfile.TemporaryDirectory() as folder:
        yield pathlib.Path(folder)


def skip(reason):
    """Ends the script as one that cannot be run here."""
    print("skipped: " + reason)
    sys.exit(77)


def clang():
    """Path of Clang; exits with status 77 where there is none."""
    return shutil.which("clang++") or shutil.which("clang++-14") or skip("no clang++ is installed")


def build_with(folder, options, compiler=None):
    """Configures a build of its own in `folder`. CMake forgets all options where it is told another compiler than before."""
    if compiler and not (folder / "CMakeCache.txt").exists():
        options = [*options, f"-DCMAKE_CXX_COMPILER={compiler}", f"-DCMAKE_C_COMPILER={compiler.replace('++', '')}"]
    subprocess.run(["cmake", "-S", SOURCE, "-B", folder, "-G", "Ninja", *options], check=True, stdout=sys.stderr)


def command(program, scene, output, entries=(), *options):
    """Command line of an app that runs `scene` with further `entries` into the folder `output`."""
    return [str(program), str(scene), "-o", str(output), "--quiet", *sets(entries), *options]


def sets(entries):
    return [word for entry in entries for word in ("-s", entry)]


def smallest_runs(build, folder, entries=()):
    """Command lines of the apps on the smallest scenes, by name; `entries`: of those that crush."""
    def app(name, scene, *further):
        return command(build / "apps" / ("platen-" + name), scene, folder, further, "--overwrite")

    crushed = [*TINY, *entries]
    return {"pack": app("pack", CRUSHED, *TINY),
            "bonds": app("bonds", SOURCE / "scenes/softening_bond.prm"),
            "bar": app("bar", SCENES / "bar.prm", "Specimen/Radius = 3 mm", "Specimen/Height = 20 mm", "Bar test/Periods = 4"),
            **{name: app("compress", CRUSHED, *further, *crushed) for name, further in PLATENS.items()},
            "brazilian": app("brazilian", SCENES / "split.prm", *crushed)}


def run(arguments, **keywords):
    return subprocess.run(arguments, stdin=subprocess.DEVNULL, capture_output=True, text=True, **keywords)


def start(arguments, **keywords):
    """A run that goes on beside this script, whose errors can be read."""
    return subprocess.Popen(arguments, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, **keywords)


def checkpoints(folder, pattern=CHECKPOINT):
    return set((folder / "checkpoint").glob(pattern))


def results(folder):
    """Bytes of all that repeats, by name: not run.log, costs, checkpoints, of summary.json not what tells costs."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder)
        if not path.is_file() or path.name in ("run.log", "costs.csv") or "checkpoint" in name.parts:
            continue
        if path.name == "summary.json":
            summary = json.loads(path.read_text())
            found[str(name)] = {key: value for key, value in summary.items() if key not in COSTS}
        else:
            found[str(name)] = path.read_bytes()
    return found


def difference(one, other):
    """Names of files that two results do not have alike."""
    return [name for name in sorted(one.keys() | other.keys()) if one.get(name) != other.get(name)]


class Figures:
    """Figures of one row of tests/verification/rows.json, and what has failed."""

    def __init__(self, row):
        self.row = row
        self.failures = []

    def fail(self, text):
        print("FAILED " + text, flush=True)
        self.failures.append(text)

    def note(self, what, value, allowed="any"):
        print(f"row {self.row} {what}: {value} ({allowed})", flush=True)

    def exactly(self, what, value, wanted):
        self.note(what, value, f"= {wanted}")
        if value != wanted:
            self.fail(f"{what} is {value}, not {wanted}")

    def at_least(self, what, value, wanted):
        self.note(what, value, f">= {wanted}")
        if value < wanted:
            self.fail(f"{what} is {value}, less than {wanted}")

    def status(self):
        return 1 if self.failures else 0
