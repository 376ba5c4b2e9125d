#!/usr/bin/env python3
"""Runs the apps on the smallest scenes, and some unit tests, under valgrind.

    memcheck.py BUILD [--only CASE ...]

An error is ours where one of its three innermost frames lies in a program of BUILD; those of libraries are counted and told
besides. Memory that is not given back is not looked at (sanitizers.py does). Exit status: 0; 1 where an error is ours or a
program fails; 77 where there is no valgrind. Ten minutes.
"""

import pathlib
import shutil
import sys
import xml.etree.ElementTree

import faults

INNERMOST = 3


def cases(build, folder):
    """Command lines by name; those that crush make a hundred steps and a half."""
    short = ["Loading/Target strain = 1e-4", "Checkpoint/Every = 50"]
    runs = {name: [*line, "-t", "2"] for name, line in faults.smallest_runs(build, folder / "results", short).items()}
    misspelt = folder / "misspelt_key.prm"
    misspelt.write_text(f"include {faults.CRUSHED}\nsubsection Contact\n  set Frictoin = 0.3\nend\n")
    abacus = [*faults.TINY, "Calibrate/Mode = abacus", "Calibrate/Seeds = 1", "Calibrate/Modulus list = 36 GPa", "Calibrate/Stiffness ratio list = 0.5"]
    return runs | {
        "abacus": faults.command(build / "apps/platen-calibrate", faults.CRUSHED, folder / "results", abacus, "--overwrite", "-t", "2"),
        "files": [str(build / "bin/test_output"), "--gtest_filter=Checkpoint.*:Csv.*:SpecimenCsv.*:-*cut_off*:*single_bit*:*same_bits"],
        "refusals": [str(build / "apps/platen-compress"), str(misspelt)],
    }


def errors_of(reports, build):
    """(ours, of libraries) of valgrind's reports, one of each process, as kind and functions."""
    ours, others = [], []
    for error in (error for report in reports for error in xml.etree.ElementTree.parse(report).iter("error")):
        if error.findtext("kind").startswith("Leak"):
            continue
        frames = error.find("stack").findall("frame")
        inner = any(str(build) in (frame.findtext("obj") or "") for frame in frames[:INNERMOST])
        (ours if inner else others).append(
            error.findtext("kind") + ": " + " < ".join(frame.findtext("fn") or "?" for frame in frames[:8]))
    return ours, others


def main():
    parser = faults.parser(__doc__)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", nargs="+", metavar="CASE")
    options = parser.parse_args()
    if shutil.which("valgrind") is None:
        faults.skip("valgrind is not installed")
    build = options.build.resolve()
    figures = faults.Figures(42)
    count = own = foreign = 0
    with faults.scratch() as folder:
        for name, command in cases(build, folder).items():
            if options.only and name not in options.only:
                continue
            done = faults.run(["valgrind", "--trace-children=yes", "--leak-check=no", "--num-callers=20", "--xml=yes",
                               f"--xml-file={folder}/{name}_%p.xml", *command])
            ours, others = errors_of(folder.glob(f"{name}_*.xml"), build)
            print(f"{name}: {len(ours)} errors, {len(others)} of libraries", flush=True)
            for text in ours + others:
                print("  " + text)
            if done.returncode != (2 if name == "refusals" else 0):
                figures.fail(f"{name}: status {done.returncode}: {done.stdout[-2000:]}{done.stderr[-2000:]}")
            count, own, foreign = count + 1, own + len(ours), foreign + len(others)
    figures.note("cases", count)
    figures.exactly("errors in our frames", own, 0)
    figures.note("errors of libraries", foreign)
    return figures.status()


if __name__ == "__main__":
    sys.exit(main())
