#!/usr/bin/env python3
"""Runs each unit test, and the apps on the smallest scenes, with floating-point traps set.

    traps.py LIBRARY BUILD [--only PROGRAM ...]

LIBRARY is preloaded and ends a program where an operation of its own is invalid, divides by zero or overflows. ON_PURPOSE are
tests that want such numbers: what is not finite on its way in, or what grows beyond all bounds; they may trap, and run without
traps in the quick tests. Exit status: 0; 1 where another one traps or fails. Ten minutes.
"""

import os
import pathlib
import re
import subprocess
import sys

import faults

TRAPPED = 99
PROGRAMS = ["test_packing", "test_dem", "test_fem", "test_coupling", "test_stability", "test_scene"]
ON_PURPOSE = {
    "not a number, or infinity, is given and has to be refused or found":
        r".*\.(.*_)?(refuses?|refused)(_.*)?|cell_grid\.a_centre_that_is_no_place.*|not_finite\..*|"
        r"contact_plate\.a_sphere_may_move.*|strength_scatter\.gives_the_same.*",
    "spheres with one centre": r"coincident\..*",
    "steps above the limit grow until they overflow":
        r"dissipative_scheme/DissipativeLimit.*|elastic_solid\.the_stable_step_is_the_limit",
    "a Bessel function of the standard library, compiled into the test": r"spectrum\.a_dispersed_pulse.*",
}


def tests_of(program):
    listed = subprocess.run([program, "--gtest_list_tests", "--gtest_filter=-*.long_*"], capture_output=True, text=True,
                            check=True).stdout
    suite = None
    for line in listed.splitlines():
        name = line.split("#")[0].rstrip()
        if name.startswith("  "):
            yield suite + name.strip()
        elif name.endswith("."):
            suite = name


def main():
    parser = faults.parser(__doc__)
    parser.add_argument("library", type=pathlib.Path)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", nargs="+", metavar="PROGRAM", help="these test programs, and no apps [all, and apps]")
    options = parser.parse_args()
    build = options.build.resolve()
    environment = dict(os.environ, LD_PRELOAD=str(options.library.resolve()))
    on_purpose = re.compile("|".join(ON_PURPOSE.values()))
    figures = faults.Figures(43)
    ran = trapped = meant = 0

    def look(name, command):
        nonlocal ran, trapped, meant
        done = faults.run(command, env=environment, errors="replace", timeout=600)
        ran += 1
        if done.returncode == TRAPPED and on_purpose.fullmatch(name):
            meant += 1
        elif done.returncode != 0:
            trapped += done.returncode == TRAPPED
            figures.fail(f"{name}: status {done.returncode}")
            print(done.stderr[-3000:], file=sys.stderr)

    for program in options.only or PROGRAMS:
        for test in tests_of(build / "bin" / program):
            look(test, [str(build / "bin" / program), "--gtest_filter=" + test])
        print(f"{program}: {ran} runs so far, {trapped} trapped", flush=True)
    if not options.only:
        with faults.scratch() as folder:
            runs = faults.smallest_runs(build, folder / "results", ["Checkpoint/Every = 100"])
            runs["quasi-static"] = runs["elastic"] + faults.sets(["Platens/Motion = quasi-static"])
            for name, command in runs.items():
                look(name, command)
    figures.note("tests and runs of apps", ran)
    figures.note("of them that make such numbers on purpose", meant)
    figures.exactly("traps beside these", trapped, 0)
    return figures.status()


if __name__ == "__main__":
    sys.exit(main())
