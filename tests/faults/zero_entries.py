"""Every entry that may be 0, at 0, in small tests of every kind: each is refused, or stops with a reason, or ends without a
number that is not finite in any of its files, and with figures that are valid or null with their reasons.

    zero_entries.py APPS [--share 1] [--seed 1] [--table FILE] [--seconds 120] [--jobs 1]

APPS is the folder of the programs. --share takes a part of all runs, drawn by the seed. The table has one line a run."""

import argparse
import collections
import concurrent.futures
import csv
import json
import math
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import threading

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
SCENES = SOURCE / "tests" / "apps" / "scenes"
COARSE = ["Specimen/Sphere radius = 1.8 mm", "Output/Every = 10", "Expect/pattern ="]
CELL = ["Loading/Confining pressure = 2 MPa"]
# Test by name: app, scene, entries.
TESTS = {
    "plain": ("platen-compress", "crushed.prm", COARSE),
    "frames": ("platen-compress", "crushed.prm", [*COARSE, "Output/Fields = on", "Loading/Target strain = 0.002"]),
    "seats": ("platen-compress", "crushed.prm", [*COARSE, "Specimen/Seat = on"]),
    "rolling": ("platen-compress", "crushed.prm", [*COARSE, "Effects/Tangential = coulomb with rolling resistance",
                                                   "Contact/Rolling friction = 0.2", "Effects/Gravity = on"]),
    "hertz": ("platen-compress", "crushed.prm", [*COARSE, "Effects/Contact = hertz", "Platens/Contact = hertz"]),
    "no bonds": ("platen-compress", "crushed.prm", [*COARSE, "Effects/Bond = none", "Contact/Stiffness = 1e7 N/m",
                                                    "Platens/Stiffness = 1e7 N/m", "Loading/Target strain = 0.002",
                                                    "Loading/Ramp = 1 ms"]),
    "weakening": ("platen-compress", "crushed.prm", [*COARSE, "Platens/Friction law = slip weakening", "Platens/Slip length = 10 um"]),
    "wall": ("platen-compress", "crushed.prm", [*COARSE, "Loading/Test = uniaxial strain"]),
    "skin": ("platen-compress", "crushed.prm", [*COARSE, *CELL, "Loading/Confinement = particles"]),
    "sleeve": ("platen-compress", "crushed.prm", [*COARSE, *CELL, "Loading/Confinement = sleeve", "Sleeve/Thickness = 1 mm",
                                                  "Sleeve/Modulus = 20 MPa", "Loading/Target strain = 0.002"]),
    "elastic": ("platen-compress", "crushed.prm", [*COARSE, "Platens/Kind = deformable", "Platens/Thickness = 4 mm",
                                                   "Loading/Target strain = 0.002"]),
    "machine": ("platen-compress", "crushed.prm", [*COARSE, "Platens/Machine stiffness = 1e8 N/m"]),
    "tension": ("platen-compress", "crushed.prm", [*COARSE, "Loading/Test = tension", "Platens/Attachment = glued"]),
    "softening": ("platen-compress", "crushed.prm",
                  [*COARSE, "Effects/Bond = elasto damage plastic", "Bond/Poisson ratio = 0.2", "Bond/Friction static = 0.9",
                   "Bond/Friction dynamic = 0.25", "Bond/Compression limits = 20 MPa, 45 MPa, 70 MPa", "Bond/Compression slopes = 3, 12, 22"]),
    "yielding": ("platen-compress", "crushed.prm", [*COARSE, "Effects/Bond = yielding parallel bond",
                                                    "Bond/Compression limits = 5 MPa, 10 MPa, 20 MPa", "Bond/Compression slopes = 2, 4, 8"]),
    "facets": ("platen-compress", "crushed.prm", [*COARSE, "Effects/Bond = facet", "Bond/Tensile strength = 4 MPa", "Bond/Shear strength = 11 MPa",
                                                  "Bond/Fracture energy = 20 J/m2", "Bond/Friction dynamic = 0.6", "Bond/Gap = 0.6 R_min"]),
    "beams": ("platen-compress", "crushed.prm", [*COARSE, "Effects/Bond = cohesive beam"]),
    "six sides": ("platen-compress", "held.prm", [*COARSE, "Platens/Friction static = 0.2", "Platens/Friction dynamic = 0.2"]),
    "disc": ("platen-brazilian", "split.prm", COARSE),
    "bar": ("platen-compress", "bent.prm", ["Loading/Target strain = 0.001"]),
}
# Entries that ask for nothing of a single test, or are strings.
OTHER_SECTIONS = ("Expect", "Study", "Calibrate", "Calibration", "Pair test", "Bar test", "Target", "Scene", "Phases", "Checkpoint")
# Columns with a cell that may be empty: what a specimen has no spheres for, or no bond bears.
MAY_BE_EMPTY = {"unbalanced_force_ratio", "confined_area_share", "axial_strain_gauge", "lateral_strain", "volumetric_strain", "lateral_strain_extremal",
                "axial_strain_extremal", "opening_m", "circumferential_strain", "magnitude", "mean_stress_pa",
                "mean_pressed_stress_pa", "pressed_over_axial"}
ENERGIES = re.compile(r"_(energy|work|residual)_j$")


def flat(tree, path=""):
    """Entries of a parameter tree as (path, entry)."""
    for name, value in tree.items():
        where = f"{path}/{name}" if path else name
        if "default_value" in value:
            yield where, value
        else:
            yield from flat(value, where)


def may_be_zero(entry):
    """Whether what the entry allows holds 0."""
    allowed = entry["allowed"].removeprefix("whole, ")
    between = re.fullmatch(r"(above )?([-+0-9.e]+) \.\.\. (below )?([-+0-9.e]+)", allowed)
    if between:
        low, high = float(between.group(2)), float(between.group(4))
        return (low < 0 or low == 0 and not between.group(1)) and (high > 0 or high == 0 and not between.group(3))
    return allowed.startswith("0, or ") or allowed.endswith("0 or more")


def is_zero(text):
    found = re.match(r"^\s*([-+0-9.eE]+)", text)
    return bool(found) and float(found.group(1)) == 0  # what is not given is another thing than 0


def not_finite(folder, with_ledger):
    """What of a run's files is not finite, as "file: column"; "" where all is."""
    for path in sorted(folder.glob("*.csv")):
        with path.open(newline="") as file:
            for number, row in enumerate(csv.DictReader(line for line in file if not line.startswith("#"))):
                for column, cell in row.items():
                    empty = column in MAY_BE_EMPTY or (not with_ledger and ENERGIES.search(column))
                    if cell == "" and not empty or re.fullmatch(r"[-+]?(nan|inf)", cell.lower()):
                        return f"{path.name}: {column} is \"{cell}\" in row {number}"
    text = (folder / "summary.json").read_text()
    found = re.search(r'"[^"]*": *-?(?:NaN|nan|Infinity|inf)\b', text)
    return f"summary.json: {found.group(0)}" if found else ""


def faults_of_figures(folder):
    summary = json.loads((folder / "summary.json").read_text())
    for figure, said in summary["validity"].items():
        value = summary[figure]
        if said == "valid" and (value is None or isinstance(value, float) and not math.isfinite(value)):
            return f"{figure} is valid and {value}"
        if said != "valid" and value is not None:
            return f"{figure} is {value} against {said}"
    return ""


def judged(status, error, output, with_ledger):
    """How a run ended, in a word, what it said, and what is wrong with it."""
    first = next((line for line in error if "note:" not in line), "").strip()
    if status == 2:
        return "refused", first, "refused, and wrote a folder" if output.exists() else "" if first else "refused without a message"
    if status == 3:
        return "stopped", first, "" if first else "stopped without a message"
    if status not in (0, 1):
        return "crashed", first, f"status {status}"
    return "ended", "", not_finite(output, with_ledger) or faults_of_figures(output)


def runs_of(apps, only):
    """All runs: name of the test, entry."""
    runs = []
    for test, (app, scene, sets) in TESTS.items():
        if only and test not in only:
            continue
        asked = subprocess.run([apps / app, SCENES / scene, "--print-parameters", "--json", *overriding(sets)],
                               capture_output=True, text=True, check=True)
        for name, entry in flat(json.loads(asked.stdout)):
            far = re.search(r"/Stage \d|/(Left|Right|Front|Back)/", name) and test != "six sides" or re.search(r"/Stage (\d\d|[2-9])/", name)
            if name.startswith(OTHER_SECTIONS) or far or not may_be_zero(entry):
                continue
            if not is_zero(entry["value"] or entry["default_value"]):
                runs.append((test, name))
    return runs


def overriding(sets):
    return [word for one in sets for word in ("-s", one)]


def run_one(apps, folder, seconds, number, test, entry):
    app, scene, sets = TESTS[test]
    output = folder / str(number)
    command = [str(apps / app), str(SCENES / scene), "-o", str(output), "-t", "1", "-s", "Output/Fields = off",
               *overriding(sets), "-s", f"{entry} = 0"]
    if test == "frames":
        command.remove("Output/Fields = off"), command.pop(command.index("-s"))
    run = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    clock = threading.Timer(seconds, run.kill)
    clock.start()
    error, idle = [], False
    for line in run.stderr:
        error.append(line)
        if "has no effect" in line and f" {entry} = 0 " in line:  # as without it
            idle = True
            run.kill()
    status = run.wait()
    if idle:
        kind, words, wrong = "no effect", "", ""
    elif not clock.is_alive():
        kind, words, wrong = "long", f"goes on after {seconds} s", ""
    else:
        kind, words, wrong = judged(status, error, output, entry != "Effects/Energy ledger")
    clock.cancel()
    shutil.rmtree(output, ignore_errors=True)
    return test, entry, kind, words, wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("apps", type=pathlib.Path)
    parser.add_argument("--share", type=float, default=1)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--table", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=120)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--tests", nargs="*", default=[])
    a = parser.parse_args()
    apps = a.apps.resolve()
    all_runs = runs_of(apps, a.tests)
    chosen = sorted(random.Random(a.seed).sample(range(len(all_runs)), max(1, round(a.share * len(all_runs)))))
    rows = []
    with tempfile.TemporaryDirectory() as scratch, concurrent.futures.ThreadPoolExecutor(a.jobs) as pool:
        for row in pool.map(lambda k: run_one(apps, pathlib.Path(scratch), a.seconds, k, *all_runs[k]), chosen):
            rows.append(row)
            print(" | ".join(row), flush=True)
    if a.table:
        lines = ["| test | entry at 0 | ended | by |", "| --- | --- | --- | --- |"]
        lines += [f"| {test} | {entry} | {kind} | {wrong or words} |" for test, entry, kind, words, wrong in rows]
        a.table.write_text("\n".join(lines) + "\n")
    entries = len({entry for _, entry, *_ in rows})
    print(f"{len(rows)} of {len(all_runs)} runs, {entries} entries:", dict(collections.Counter(row[2] for row in rows)))
    faults = [row for row in rows if row[4]]
    for row in faults:
        print("wrong:", row, file=sys.stderr)
    sys.exit(1 if faults or not rows else 0)


if __name__ == "__main__":
    main()
