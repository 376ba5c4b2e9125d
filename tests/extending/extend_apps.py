#!/usr/bin/env python3
"""Adds a scene key and a column of history.csv to a copy of the sources, as docs/extending.md says, builds and runs them.

    tests/extending/extend_apps.py SOURCE FOLDER PROGRAM [COMPILER]

SOURCE is the project, FOLDER a folder to work in, PROGRAM the platen-compress that has neither: a run that it has begun is
gone on with by the new one. Exit status: 0; 1 where something does not build or hold, or takes another place.
"""

import csv
import json
import math
import pathlib
import shutil
import signal
import subprocess
import sys
import time

COPIED = ["CMakeLists.txt", "cmake", "base", "dem", "fem", "coupling", "apps"]
# (file, text, text in its place): the declaration of the key, its use, the column.
KEY = [
    ("coupling/experiment.h", "  double fixed_step = 0; // s; 0: safety times the limit\n",
     "  double fixed_step = 0; // s; 0: safety times the limit\n  double largest_step = 0; // s; 0: as large as is stable\n"),
    ("coupling/experiment.h", '    v("safety", p.safety,',
     '    v("largest_step", p.largest_step, "s", at_least(0), "0: as large as is stable.");\n    v("safety", p.safety,'),
    ("coupling/experiment_limits.cc", "  const double step = settings_.safety * limit.limit;\n",
     "  double step = settings_.safety * limit.limit;\n"
     "  if (settings_.largest_step > 0) step = std::min(step, settings_.largest_step);\n"),
]
COLUMN = [
    ("apps/run/history.cc", '      {"cell_pressure_pa",',
     '      {"mean_stress_pa", "Pa", nullptr, [](const Seen &s) {\n'
     '         const coupling::PlatenTest &p = s.problem;\n'
     '         return (0.5 * (p.stress_top() + p.stress_bottom()) + 2 * p.confining_pressure()) / 3;\n'
     '       }},\n      {"cell_pressure_pa",'),
]
KEY_FILES, COLUMN_PLACES = 2, 1
STEP = 2e-7  # s, below what is stable


def add(folder, name, changes):
    """Makes the changes; the files that they touch."""
    for file, old, new in changes:
        text = (folder / file).read_text()
        if text.count(old) != 1:
            sys.exit(f"{file}: {old!r} stands there {text.count(old)} times; docs/extending.md and this test want looking at")
        (folder / file).write_text(text.replace(old, new))
    files = {file for file, _, _ in changes}
    print(f"{name}: {len(files)} files, {len(changes)} places")
    return files


def run(*command, status=0):
    """Output and messages of a command; ends the test where its status is another."""
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != status:
        sys.exit(f"{' '.join(map(str, command))}: status {done.returncode}, expected {status}\n{done.stdout[-3000:]}"
                 f"{done.stderr[-3000:]}")
    return done.stdout + done.stderr


def build(source, folder, compiler):
    """The new platen-compress."""
    # Copies keep their times, so a build of an earlier copy would not follow them.
    shutil.rmtree(folder, ignore_errors=True)
    copy = folder / "sources"
    copy.mkdir(parents=True)
    for name in COPIED:
        if (source / name).is_dir():
            shutil.copytree(source / name, copy / name)
        else:
            shutil.copy(source / name, copy / name)
    if len(add(copy, "scene key", KEY)) > KEY_FILES or len(COLUMN) > COLUMN_PLACES:
        sys.exit("a key or a column takes more places than docs/extending.md says")
    add(copy, "column", COLUMN)
    run("cmake", "-S", copy, "-B", folder / "build", "-DCMAKE_BUILD_TYPE=Release", "-DPLATEN_TESTS=OFF", "-DPLATEN_BENCH=OFF",
        *compiler)
    run("cmake", "--build", folder / "build", "--target", "platen-compress", "-j2")
    return folder / "build/apps/platen-compress"


def rows(folder):
    """history.csv of a run, numbers by column."""
    with open(folder / "history.csv", newline="", encoding="utf-8") as file:
        return [{k: float(v) if v else math.nan for k, v in row.items()} for row in csv.DictReader(file)]


def hold(what, expected, found):
    """Ends the test where a number is another."""
    if not abs(found - expected) <= 1e-9 * abs(expected):
        sys.exit(f"{what}: expected {expected!r}, found {found!r}")


def check_new(program, scene, folder):
    """The key limits the time step, is refused below zero and printed; the column is the mean of the principal stresses."""
    run(program, scene, "-o", folder, "--overwrite", "--quiet", "-s", f"Integration/Largest step = {STEP}")
    hold("time step, s", STEP, json.loads((folder / "summary.json").read_text())["time_step_s"])
    if "Largest step" not in (folder / "scene.prm").read_text():
        sys.exit("scene.prm of the run lacks the key")
    refused = run(program, scene, "-o", folder, "--overwrite", "-s", "Integration/Largest step = -1 s", status=2)
    if "Largest step" not in refused:
        sys.exit(f"a negative step is refused without the key: {refused}")
    last = rows(folder)[-1]
    axial = 0.5 * (last["axial_stress_top_pa"] + last["axial_stress_bottom_pa"])
    hold("mean stress, Pa", (axial + 2 * last["confining_pressure_pa"]) / 3, last["mean_stress_pa"])


def check_older(old, new, scene, folder):
    """A run that the old program has begun goes on with the new one: NaN in the column until then."""
    begun = subprocess.Popen([str(c) for c in (old, scene, "-o", folder, "--overwrite", "--quiet")])
    while begun.poll() is None and (not (folder / "history.csv").exists() or len(rows(folder)) < 5):
        time.sleep(0.05)
    begun.send_signal(signal.SIGINT)
    if begun.wait() != 130:
        sys.exit(f"the old program ended with status {begun.returncode}, expected 130: stopped")
    run(new, scene, "-o", folder, "--resume", "--quiet")
    stress = [row["mean_stress_pa"] for row in rows(folder)]
    if not math.isnan(stress[0]) or math.isnan(stress[-1]):
        sys.exit(f"mean stress: expected NaN first and a number last, found {stress[0]} and {stress[-1]}")


def main():
    """The whole test."""
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    source, folder, old = (pathlib.Path(a).resolve() for a in sys.argv[1:4])
    compiler = [f"-DCMAKE_CXX_COMPILER={sys.argv[4]}"] if len(sys.argv) > 4 else []
    new = build(source, folder, compiler)
    scene = source / "scenes/hydrostatic_concrete.prm"
    check_new(new, scene, folder / "new")
    check_older(old, new, scene, folder / "older")
    print("key and column hold")


if __name__ == "__main__":
    main()
