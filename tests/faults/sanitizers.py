#!/usr/bin/env python3
"""Builds tests under a sanitizer and runs them.

    sanitizers.py thread BUILD     data races: the particle library, whose threads are those of C++
    sanitizers.py address BUILD    memory and undefined behaviour: everything [--only test_dem test_output ...] [--clang]

BUILD is a folder for a build of its own, made where it is not there; two programs run at a time. Programs that link deal.II
are not asked for leaks: MPI and Trilinos keep memory until a process ends. Exit status: 0; 1 where a test fails or a sanitizer
reports; 77 where there is no Clang. Half an hour and an hour on two cores, half of it to compile.
"""

import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

import faults

PARTICLES = ["test_dem", "test_packing"]
OTHERS = ["test_layering", "test_scene", "test_output", "test_fem", "test_coupling", "test_bonds", "test_pack", "test_calibrate",
          "test_bar", "test_compress", "test_study",
          "test_stability"]
KINDS = {"thread": (41, "thread", PARTICLES, "OFF"), "address": (40, "address,undefined", PARTICLES + OTHERS, "ON")}
REPORT = re.compile(r"ERROR: (?:Address|Leak)Sanitizer|WARNING: ThreadSanitizer|runtime error:")


def test(folder, program, chosen):
    leaks = 1 if program in PARTICLES else 0
    environment = dict(os.environ, ASAN_OPTIONS=f"detect_leaks={leaks}", UBSAN_OPTIONS="print_stacktrace=1")
    return faults.run([str(folder / "bin" / program), f"--gtest_filter={chosen}"], env=environment, errors="replace")


def main():
    parser = faults.parser(__doc__)
    parser.add_argument("kind", choices=KINDS)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", nargs="+", metavar="PROGRAM", help="these programs [all]")
    parser.add_argument("--filter", default="-*.long_*", help="tests of them, as gtest has it [all but long forms]")
    parser.add_argument("--clang", action="store_true", help="with Clang, in place of the compiler that CMake finds")
    options = parser.parse_args()
    clang = faults.clang() if options.clang else None
    row, sanitizers, programs, apps = KINDS[options.kind]
    programs = options.only or programs
    folder = options.build.resolve()
    if set(programs) <= set(PARTICLES):
        apps = "OFF"
    faults.build_with(folder, ["-DCMAKE_BUILD_TYPE=RelWithDebInfo", "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g1", f"-DPLATEN_SANITIZE={sanitizers}",
                               f"-DPLATEN_APPS={apps}", "-DPLATEN_BENCH=OFF"], clang)
    subprocess.run(["cmake", "--build", folder, "--target", *programs], check=True, stdout=sys.stderr)
    figures = faults.Figures(row)
    ran = failed = reports = 0
    with concurrent.futures.ThreadPoolExecutor(max_workers=2) as pool:
        for program, done in zip(programs, pool.map(lambda p: test(folder, p, options.filter), programs)):
            told = done.stdout + done.stderr
            tests, bad = len(re.findall(r"^\[       OK \]", told, re.M)), len(re.findall(r"^\[  FAILED  \].*ms\)$", told, re.M))
            found = len(REPORT.findall(told))
            print(f"{program}: {tests} tests passed, {bad} failed, {found} reports, status {done.returncode}", flush=True)
            if bad or found or done.returncode != 0:
                print(told[-20000:], file=sys.stderr)
                figures.fail(program)
            ran, failed, reports = ran + tests + bad, failed + bad, reports + found
    by = " with Clang" if clang else ""
    figures.note(f"tests under {sanitizers.replace(',', ' and ')}{by}", ran)
    figures.exactly(f"tests that failed{by}", failed, 0)
    figures.exactly(f"reports{by}", reports, 0)
    return figures.status()


if __name__ == "__main__":
    sys.exit(main())
