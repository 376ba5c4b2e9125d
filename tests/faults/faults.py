"""What the scripts of this folder share: small runs, what they leave behind, and figures."""

import json
import os
import pathlib
import shutil
import subprocess
import sys

os.environ.setdefault("PLATEN_CACHE", "none")  # what is tested is made here, not found
SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
CRUSHED = SOURCE / "tests/apps/scenes/crushed.prm"

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


def clang():
    """Path of Clang; exits with status 77 where there is none."""
    compiler = shutil.which("clang++") or shutil.which("clang++-14")
    if compiler is None:
        print("no clang++ is installed")
        sys.exit(77)
    return compiler


def command(program, scene, output, entries=(), *options):
    """Command line of an app that runs `scene` with further `entries` into the folder `output`."""
    sets = [word for entry in entries for word in ("-s", entry)]
    return [str(program), str(scene), "-o", str(output), "--quiet", *sets, *options]


def run(arguments, **keywords):
    return subprocess.run(arguments, stdin=subprocess.DEVNULL, capture_output=True, text=True, **keywords)


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

    def note(self, what, value, allowed):
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
