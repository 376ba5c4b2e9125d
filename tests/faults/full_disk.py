#!/usr/bin/env python3
"""Runs every app on disks that are too small, from one page to one page less than it needs.

    full_disk.py FOLDER_OF_APPS [--only APP ...] [--sizes 24] [--seed 1] [--mpiexec MPIEXEC] [--environment "NAME=VALUE ..."]

Disks are tmpfs in a mount namespace of its own (unshare). A run must end with status 4 and one message that names a file and
says what is wrong; every file under its own name is whole, none is left half written; with room on the disk the run goes
on, or starts anew, and gives the bytes of one that had room from the start. A folder that cannot be written is refused, one
that turns up read-only in a run is status 4. Exit status: 0; 1 where that does not hold; 77 where nothing may be mounted.
Fifteen minutes.
"""

import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree

import faults

PAGE = 4096
AMPLE = "size=256m"
MPIRUN = []  # empty: nothing is run on ranks


class Case:
    """One app on one scene: its command line for a folder, and what a second try needs."""

    def __init__(self, app, name, words, entries=(), resumes=(), sizes=None):
        self.app, self.name, self.words, self.entries, self.resumes = app, name, words, entries, resumes
        self.sizes = sizes  # at most so many disks; where a run is slow

    def command(self, apps, folder, *options):
        return faults.command(apps / self.app, self.words, folder, self.entries, *options)


def cases():
    crushed, tiny = faults.CRUSHED, faults.TINY
    return [
        Case("platen-compress", "compress", crushed, tiny + ["Checkpoint/Every = 500"], ["checkpoint"]),
        Case("platen-compress", "sleeve", crushed, tiny + faults.PLATENS["sleeve"] + ["Checkpoint/Every = 500"],
             ["checkpoint"], 8),
        Case("platen-brazilian", "brazilian", faults.SCENES / "split.prm", tiny, ["checkpoint"], 8),
        Case("platen-pack", "pack", crushed, tiny),
        Case("platen-bar", "bar", faults.SCENES / "bar.prm", sizes=12),
        Case("platen-bonds", "bonds", faults.SOURCE / "scenes/two_particles.prm"),
        Case("platen-calibrate", "abacus", crushed, tiny + [
            "Calibrate/Mode = abacus", "Calibrate/Modulus list = 18 GPa, 36 GPa",
            "Calibrate/Stiffness ratio list = 0.2, 0.5"], ["trials.csv"]),
        Case("platen-calibrate", "calibration", crushed, tiny + [
            "Calibrate/Seeds = 1", "Calibrate/Verification seeds = 0",  # of 130 spheres another packing tells nothing
            "Loading/Axial rate = 0.1 m/s", "Calibrate/Target 1 = young modulus: 20 GPa", "Calibrate/Target 2 = strength_pa: 40 MPa"], ["trials.csv"], 12),
        Study("platen-study", "study", faults.SCENES / "study.prm", ["Study/Sphere radius list = 2 mm"], ["study.json"], 12),
        Report("platen-report", "report", None, sizes=5),
        OnRanks("platen-compress", "ranks", crushed, ["Loading/Axial rate = 2 m/s", "Loading/Target strain = 0.001",
                "Checkpoint/Every = 40"], ["checkpoint"], 24),
    ]


class OnRanks(Case):
    """On three ranks, which write checkpoints together."""

    def command(self, apps, folder, *options):
        return [*MPIRUN, "-n", "3", *super().command(apps, folder, "-t", "1", *options)]


class Study(Case):
    def command(self, apps, folder, *options):
        line = super().command(apps, folder, *options)
        return [line[0], "size", *line[1:]]


class Report(Case):
    """Of a run that is on the disk already."""

    def command(self, apps, folder, *options):
        del options  # it replaces what is there
        return [str(apps / self.app), str(folder), "--fields", "--quiet"]


class Disk:
    """A tmpfs of so many bytes."""

    def __init__(self, folder, options):
        self.folder = folder
        folder.mkdir(parents=True, exist_ok=True)
        subprocess.run(["mount", "-t", "tmpfs", "-o", options, "none", str(folder)], check=True)

    def __enter__(self):
        return self

    def __exit__(self, *error):
        subprocess.run(["umount", str(self.folder)], check=True)

    def change(self, options):
        subprocess.run(["mount", "-o", f"remount,{options}", str(self.folder)], check=True)

    def pages(self):
        space = os.statvfs(self.folder)
        return (space.f_blocks - space.f_bfree) * space.f_frsize // PAGE


ENDS = {".vtu": b"</VTKFile>\n", ".vti": b"</VTKFile>\n", ".png": b"IEND\xaeB`\x82", ".html": b"</html>\n", ".prm": b"end\n"}


def is_whole(path):
    """Whether a file ends as its kind does, and what it names is there."""
    data = path.read_bytes()
    if path.suffix == ".json":
        json.loads(data)
    elif path.suffix == ".csv":
        rows = [row for row in data.split(b"\n") if not row.startswith(b"#")]
        return len(rows) > 1 and rows[-1] == b"" and all(row.count(b",") == rows[0].count(b",") for row in rows[:-1])
    elif path.suffix == ".pvd":
        frames = xml.etree.ElementTree.fromstring(data).iter("DataSet")
        return all((path.parent / frame.get("file")).is_file() for frame in frames)
    return data.endswith(ENDS.get(path.suffix, b""))  # run.log: any; checkpoints are read by the resumed run


def torn_files(folder):
    """Names of files that are not whole, or not under their own name."""
    torn = []
    for path in folder.rglob("*"):
        if not path.is_file():
            continue
        try:
            whole = ".part." not in path.name and is_whole(path)
        except (ValueError, xml.etree.ElementTree.ParseError):
            whole = False
        if not whole:
            torn.append(str(path.relative_to(folder)))
    return torn


class Trial:
    def __init__(self, apps, scratch, figures):
        self.apps, self.scratch, self.figures = apps, scratch, figures
        self.disk = scratch / "disk"
        self.refused = 0
        self.kinds = set()  # of files that could not be written

    def folder(self, case, before=None):
        """The output folder, with what must be there beforehand."""
        folder = self.disk / "results"
        if isinstance(case, Report) and before is not None:
            shutil.copytree(before, folder)
        return folder

    def whole(self, case, before):
        """Pages and results of a run that has room."""
        with Disk(self.disk, AMPLE) as disk:
            folder = self.folder(case, before)
            first = disk.pages()
            done = faults.run(case.command(self.apps, folder))
            if done.returncode != 0:
                self.figures.fail(f"{case.name}, with room: {done.stderr}")
            return first, disk.pages(), faults.results(folder)

    def check(self, case, pages, wanted, before):
        """The run on a disk of so many pages, and what becomes of it."""
        say = lambda text: self.figures.fail(f"{case.name}, {pages} pages: {text}")
        with Disk(self.disk, AMPLE) as disk:
            folder = self.folder(case, before)
            disk.change(f"size={pages * PAGE}")
            done = faults.run(case.command(self.apps, folder))
            self.refused += done.returncode == 4
            if done.returncode != 4:
                say(f"status {done.returncode}: {done.stderr}")
            errors = [line for line in done.stderr.splitlines() if line.startswith("error: ")]
            others = 0 if isinstance(case, OnRanks) else 1  # mpirun has words of its own
            if len(errors) != 1 or others * len(done.stderr.splitlines()) > 2 or "No space left" not in errors[0]:
                say(f"told as: {done.stderr}")
            named = re.findall(re.escape(str(self.disk)) + r"\S*?([\w.]+):", done.stderr)
            self.kinds |= {re.sub(r"\d+", "N", name.replace(".part", "")) for name in named[-1:]}
            if torn := torn_files(folder):
                say(f"not whole: {torn}")
            disk.change(AMPLE)
            goes_on = case.resumes and all((folder / name).exists() for name in case.resumes)
            again = faults.run(case.command(self.apps, folder, "--resume" if goes_on else "--overwrite"))
            if again.returncode == 2 and goes_on:  # nothing to go on from yet, and said so
                again = faults.run(case.command(self.apps, folder, "--overwrite"))
            if again.returncode != 0:
                say(f"second try: status {again.returncode}: {again.stderr}")
            if files := faults.difference(wanted, faults.results(folder)):
                say(f"second try gives other files: {files}")

    def read_only(self, case):
        """Refused at the start; status 4 where a folder of a run turns up so."""
        def expect(what, status, word):
            done = faults.run(case.command(self.apps, self.disk / "results"))
            if done.returncode != status or word not in done.stderr:
                self.figures.fail(f"{case.name}, {what}read-only: status {done.returncode}: {done.stderr}")

        with Disk(self.disk, AMPLE) as disk:
            disk.change("ro")
            expect("", 2, "permission")
            disk.change("rw")
            for name in ("checkpoint", "frames") if "checkpoint" in case.resumes else ():
                with Disk(self.disk / "results" / name, "ro"):
                    expect(f"{name} ", 4, "Read-only")
                shutil.rmtree(self.disk / "results")


def sizes_of(first, last, most, draw):
    """Pages to try of [first, last): all, or those at both ends and some between."""
    every = list(range(first, last))
    if len(every) <= most:
        return every
    third = most // 3
    return every[:third] + sorted(draw.sample(every[third:-third], most - 2 * third)) + every[-third:]


def main():
    parser = faults.parser(__doc__)
    parser.add_argument("apps", type=pathlib.Path, help="folder of the apps")
    parser.add_argument("--only", nargs="+", metavar="CASE", help="names of cases: " + ", ".join(c.name for c in cases()))
    parser.add_argument("--sizes", type=int, default=24, help="disks a case [24]")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--mpiexec", help="starts ranks; without it nothing is run on ranks")
    parser.add_argument("--environment", default="", help="for it: NAME=VALUE ...")
    options = parser.parse_args()
    if options.mpiexec:
        MPIRUN.append(options.mpiexec)
        os.environ.update(word.split("=", 1) for word in options.environment.split())
    if "PLATEN_OWN_MOUNTS" not in os.environ:
        os.environ["PLATEN_OWN_MOUNTS"] = "1"
        may = subprocess.run(["unshare", "-rm", "mount", "-t", "tmpfs", "none", "/mnt"], capture_output=True, text=True)
        if may.returncode != 0:
            print("nothing may be mounted: " + may.stderr.strip())
            return 77
        os.execvp("unshare", ["unshare", "-rm", sys.executable, *sys.argv])
    figures = faults.Figures(37)
    draw = random.Random(options.seed)
    tried = 0
    with faults.scratch() as scratch:
        trial = Trial(options.apps.resolve(), scratch, figures)
        run_before = scratch / "run"
        for case in cases():
            if options.only and case.name not in options.only or isinstance(case, OnRanks) and not MPIRUN:
                continue
            if isinstance(case, Report):
                faults.run(faults.command(trial.apps / "platen-compress", faults.CRUSHED, run_before, faults.TINY))
            first, last, wanted = trial.whole(case, run_before)
            trial.kinds = set()
            pages = sizes_of(max(first, 1), last, min(options.sizes, case.sizes or options.sizes), draw)
            for count in pages:
                trial.check(case, count, wanted, run_before)
            if not isinstance(case, Report):
                trial.read_only(case)
            tried += len(pages)
            print(f"{case.name}: {len(pages)} disks of {pages[0]} to {pages[-1]} pages; not written: "
                  + ", ".join(sorted(trial.kinds)), flush=True)
    figures.note("disks too small", tried)
    figures.exactly("runs on them that ended with status 4", trial.refused, tried)
    figures.exactly("faults of what they left or said", len(figures.failures), 0)
    return figures.status()


if __name__ == "__main__":
    sys.exit(main())
