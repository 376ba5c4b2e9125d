#!/usr/bin/env python3
"""Adds a scene key, a column of history.csv, a boundary and a loading stage, each of them with a key, to a copy of the sources,
as docs/extending.md says, builds and runs them.

    tests/extending/extend_apps.py SOURCE FOLDER PROGRAM [COMPILER]

SOURCE is the project, FOLDER a folder to work in, PROGRAM the platen-compress that has none of them: a run that it has begun is
gone on with by the new one. Exit status: 0; 1 where something does not build or hold, or takes another place.
"""

import csv
import json
import math
import pathlib
import signal
import subprocess
import sys
import time

from extend import add, build, copy_of, run

COPIED = ["CMakeLists.txt", "cmake", "debian", "base", "dem", "dist", "fem", "coupling", "apps", "python"]
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
SETTINGS = "coupling/platen_test_settings.h"
BOUNDARY = [
    ("coupling/platen_test.cc", '#include "coupling/platens_of_test.h"\n',
     '#include "coupling/boundaries/jacket.h"\n#include "coupling/platens_of_test.h"\n'),
    ("coupling/platen_test.cc", "  add_lateral(mean_bond_stiffness(model));\n",
     "  add_lateral(mean_bond_stiffness(model));\n"
     "  if (settings_.loading.jacket_stiffness > 0)\n"
     "    add(std::make_unique<Jacket>(model.particles, specimen.shape,\n"
     "                                 Jacket::Parameters{settings_.loading.jacket_stiffness, 1}));\n"),
    (SETTINGS, "  double unload_to = 0.1;\n",
     "  double unload_to = 0.1;\n  double jacket_stiffness = 0; // N/m, of its modulus and thickness; 0: none\n"),
    (SETTINGS, '  v("unload_to", p.unload_to,',
     '  v("jacket_stiffness", p.jacket_stiffness, "N/m", at_least(0), "Modulus times thickness of a jacket; 0: none.");\n'
     '  v("unload_to", p.unload_to,'),
]
STAGE = [
    ("coupling/program_of_test.cc", '#include "coupling/program/pressure_task.h"\n',
     '#include "coupling/program/pressure_task.h"\n#include "coupling/program/standstill.h"\n'),
    ("coupling/program_of_test.cc", "    return std::make_unique<Program>(test_, std::move(stages), std::move(drives_));\n",
     "    const double standstill = test_.settings().loading.standstill;\n"
     "    if (standstill > 0) stages.push_back(std::make_unique<Standstill>(standstill));\n"
     "    return std::make_unique<Program>(test_, std::move(stages), std::move(drives_));\n"),
    (SETTINGS, "  double start_strain = 0; ",
     "  double standstill = 0; // s, that the platens stand at last\n  double start_strain = 0; "),
    (SETTINGS, '  v("start_strain", p.start_strain,',
     '  v("standstill", p.standstill, "s", at_least(0), "Time that the platens stand in the end.");\n'
     '  v("start_strain", p.start_strain,'),
]
KEY_FILES, COLUMN_PLACES = 2, 1
PART_FILES = 3  # of a boundary, and of a stage, its own and that of its key included
STEP = 2e-7  # s, below what is stable
STANDSTILL = 1e-4  # s


def extended(source, folder, compiler):
    """The new platen-compress."""
    copy = copy_of(source, folder, COPIED)
    if len(add(copy, "scene key", KEY)) > KEY_FILES or len(COLUMN) > COLUMN_PLACES:
        sys.exit("a key or a column takes more places than docs/extending.md says")
    add(copy, "column", COLUMN)
    jacket = (source / "examples/extend/jacket.h", "coupling/boundaries/jacket.h")
    standstill = (source / "tests/extending/standstill.h", "coupling/program/standstill.h")
    parts = add(copy, "boundary with its key", BOUNDARY, jacket), add(copy, "stage with its key", STAGE, standstill)
    if max(map(len, parts)) > PART_FILES:
        sys.exit("a boundary or a stage touches more files than docs/extending.md says")
    return build(copy, "platen-compress", "-DPLATEN_PYTHON=OFF", *compiler) / "apps/platen-compress"


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


def check_parts(program, scene, folder):
    """A jacket strengthens a cylinder and its energy balance closes; the platens stand for their time in the end."""
    folder.mkdir()
    bare = folder.with_suffix(".prm")
    bare.write_text(scene.read_text().split("subsection Expect")[0])  # what is expected is of finer spheres
    coarse = [bare, "--overwrite", "--quiet", "-s", "Specimen/Sphere radius = 3.5 mm"]
    strengths = []
    for stiffness in (0, 1e8):
        jacket = ["-s", f"Loading/Jacket stiffness = {stiffness} N/m"]
        run(program, *coarse, "-o", folder, *jacket, "-s", "Effects/Energy ledger = on")
        summary = json.loads((folder / "summary.json").read_text())
        strengths.append(summary["largest_stress_pa"])  # in a stiff jacket there is no peak
        if not summary["energy_residual_relative"] < 0.01:
            sys.exit(f"jacket of {stiffness} N/m: energy residual {summary['energy_residual_relative']}, expected below 0.01")
    if not strengths[1] > 1.1 * strengths[0]:
        sys.exit(f"largest stress bare and in a jacket: expected a gain above 10 %, found {strengths} Pa")
    run(program, *coarse, "-o", folder, "-s", "Loading/Target strain = 0.001", "-s", f"Loading/Standstill = {STANDSTILL} s")
    first, second, *_, last = rows(folder)
    begin = next(row for row in rows(folder) if row["axial_strain_platen"] >= 0.001 * (1 - 1e-9))
    interval = second["time_s"] - first["time_s"]  # the stage begins between two samples
    hold("closure strain after the standstill", last["axial_strain_platen"], begin["axial_strain_platen"])
    if not 0 <= STANDSTILL - (last["time_s"] - begin["time_s"]) <= interval:
        sys.exit(f"standstill, s: expected {STANDSTILL} less up to {interval}, found {last['time_s'] - begin['time_s']}")


def check_older(old, new, scene, folder):
    """A run that the old program has begun is not mixed with the new one: its table has other columns, which is said."""
    begun = subprocess.Popen([str(c) for c in (old, scene, "-o", folder, "--overwrite", "--quiet")])
    while begun.poll() is None and (not (folder / "history.csv").exists() or len(rows(folder)) < 5):
        time.sleep(0.05)
    begun.send_signal(signal.SIGINT)
    if begun.wait() != 130:
        sys.exit(f"the old program ended with status {begun.returncode}, expected 130: stopped")
    refused = run(new, scene, "-o", folder, "--resume", "--quiet", status=2)
    if "history.csv: error: its header line is not that of this run" not in refused:
        sys.exit(f"the table of an older run is refused with other words: {refused}")


def main():
    """The whole test."""
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    # The program is a link whose name says which one it is.
    source, folder, old = (pathlib.Path(a).absolute() for a in sys.argv[1:4])
    compiler = [f"-DCMAKE_CXX_COMPILER={sys.argv[4]}"] if len(sys.argv) > 4 else []
    new = extended(source, folder, compiler)
    scene = source / "scenes/hydrostatic_concrete.prm"
    check_new(new, scene, folder / "new")
    check_older(old, new, scene, folder / "older")
    check_parts(new, source / "scenes/demo_dry.prm", folder / "parts")
    print("key, column, boundary and stage hold")


if __name__ == "__main__":
    main()
