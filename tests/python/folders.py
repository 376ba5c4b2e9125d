"""What the Python tests share: the package of the build folder, programs, scenes, and folders of their own."""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BUILD, SOURCE = Path(os.environ["PLATEN_BUILD"]), Path(os.environ["PLATEN_SOURCE"])
sys.path.insert(0, str(BUILD / "python"))
CRUSHED = SOURCE / "tests" / "apps" / "scenes" / "crushed.prm"
# A tenth of a second: a few hundred spheres, the rise of the stress and its fall.
SMALL = {"Specimen/Sphere radius": "1.5 mm", "Loading/Target strain": 0.008, "Loading/Axial rate": "0.6 m/s"}


def run_app(app, scene, folder, *options):
    command = [str(BUILD / "apps" / app), str(scene), "-o", str(folder), "--quiet", *options]
    return subprocess.run(command, capture_output=True, text=True)


def entries(values):
    """The options of a program for a dictionary of entries."""
    return [word for entry, value in values.items() for word in ("-s", f"{entry} = {value}")]


def bytes_in(folder):
    """Content of all files by name, but for those that tell time and machine."""
    skipped = ("run.log", "summary.json")
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(Path(folder).rglob("*"))
            if path.is_file() and path.name not in skipped and path.parent.name != "checkpoint"}


def differing(one, other):
    """Names of the files in which two folders differ; [] where they agree. (A difference of the bytes themselves would take
    minutes to print.)"""
    a, b = bytes_in(one), bytes_in(other)
    return sorted(name for name in {*a, *b} if a.get(name) != b.get(name))


class InFolder(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory(prefix="platen python ")
        self.addCleanup(kept.cleanup)
        self.folder = Path(kept.name)

    def experiment(self, name="run", more=None, **options):
        """The small cylinder, with further entries."""
        import platen

        return platen.Experiment(CRUSHED, set={**SMALL, **(more or {})}, output=self.folder / name, **options)
