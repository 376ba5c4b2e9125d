#!/usr/bin/env python3
"""Runs the apps on the smallest scenes, and some unit tests, under valgrind.

    memcheck.py BUILD [--only CASE ...]

An error is ours where one of its three innermost frames lies in a program of BUILD; those of libraries are counted and told
besides. Memory that is not given back is not looked at (sanitizers.py does). Exit status: 0; 1 where an error is ours or a
program fails; 77 where there is no valgrind. Ten minutes.
"""

import argparse
import pathlib
import shutil
import sys
import tempfile
import xml.etree.ElementTree

import faults

SCENES = faults.SOURCE / "tests/apps/scenes"
SHORT = faults.TINY + ["Loading/Target strain = 1e-4", "Checkpoint/Every = 50"]  # a hundred steps and a half
INNERMOST = 3


def cases(build, folder):
    """Command lines by name."""
    apps, tests = build / "apps", build / "bin"

    def app(name, scene, entries=(), *words):
        line = faults.command(apps / ("platen-" + name), scene, folder / "results", entries, "--overwrite", "-t", "2")
        return [line[0], *words, *line[1:]]

    crushed = faults.CRUSHED
    misspelt = folder / "misspelt_key.prm"
    misspelt.write_text(f"include {crushed}\nsubsection Contact\n  set Frictoin = 0.3\nend\n")
    return {
        "pack": app("pack", crushed, faults.TINY),
        "bonds": app("bonds", faults.SOURCE / "scenes/softening_bond.prm"),
        "bar": app("bar", SCENES / "bar.prm", ["Specimen/Radius = 3 mm", "Specimen/Height = 20 mm", "Bar test/Periods = 4"]),
        "rigid": app("compress", crushed, SHORT),
        "elastic": app("compress", crushed, SHORT + faults.PLATENS["elastic"][:1]),
        "sleeve": app("compress", crushed, SHORT + faults.PLATENS["sleeve"][:-1]),
        "brazilian": app("brazilian", SCENES / "split.prm", SHORT),
        "abacus": app("calibrate", crushed, faults.TINY + ["Calibrate/Mode = abacus", "Calibrate/Seeds = 1",
                                                           "Calibrate/Modulus list = 36 GPa",
                                                           "Calibrate/Stiffness ratio list = 0.5"]),
        "files": [str(tests / "test_output"), "--gtest_filter=Checkpoint.*:Csv.*:SpecimenCsv.*:-*cut_off*:*single_bit*:*same_bits"],
        "refusals": [str(apps / "platen-compress"), str(misspelt)],
    }


def errors_of(report, build):
    """(ours, of libraries) of valgrind's report, each as kind and functions."""
    ours, others = [], []
    for error in xml.etree.ElementTree.parse(report).iter("error"):
        if error.findtext("kind").startswith("Leak"):
            continue
        frames = error.find("stack").findall("frame")
        inner = any(str(build) in (frame.findtext("obj") or "") for frame in frames[:INNERMOST])
        (ours if inner else others).append(
            error.findtext("kind") + ": " + " < ".join(frame.findtext("fn") or "?" for frame in frames[:8]))
    return ours, others


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", nargs="+", metavar="CASE")
    options = parser.parse_args()
    if shutil.which("valgrind") is None:
        print("valgrind is not installed")
        return 77
    build = options.build.resolve()
    figures = faults.Figures(42)
    count = own = foreign = 0
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for name, command in cases(build, folder).items():
            if options.only and name not in options.only:
                continue
            report = folder / "report.xml"
            done = faults.run(["valgrind", "--trace-children=yes", "--leak-check=no", "--num-callers=20", "--xml=yes", f"--xml-file={report}", *command])
            ours, others = errors_of(report, build)
            print(f"{name}: {len(ours)} errors, {len(others)} of libraries", flush=True)
            for text in ours + others:
                print("  " + text)
            if done.returncode != (2 if name == "refusals" else 0):
                figures.fail(f"{name}: status {done.returncode}: {done.stdout[-2000:]}{done.stderr[-2000:]}")
            count, own, foreign = count + 1, own + len(ours), foreign + len(others)
    figures.note("cases", count, "any")
    figures.exactly("errors in our frames", own, 0)
    figures.note("errors of libraries", foreign, "any")
    return figures.status()


if __name__ == "__main__":
    sys.exit(main())
