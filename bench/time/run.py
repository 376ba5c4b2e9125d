#!/usr/bin/env python3
"""Seconds from command to prompt of two builds, side by side.

    bench/time/run.py BEFORE AFTER [--only CASE ...] [--pairs 3] [--quick]

BEFORE and AFTER are folders of apps (build/apps). Each case is run in turn by one and the other, `--pairs` times; the table
has medians and the median of the ratios of pairs. Every run starts in an empty folder, without a cache of packings. Where
both end, the line says whether they gave the same history.csv. --quick leaves out what takes above a minute. For a quiet
machine. Exit status: 0; 1 where a run fails.
"""

import argparse
import datetime
import os
import pathlib
import platform
import statistics
import subprocess
import sys
import tempfile
import time

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"
DEMO, QUIET = SCENES / "demo_dry.prm", ("-o", "run", "--quiet")
CASES = {  # command, numbers of threads (0: none is asked), exit status
    "help": (["platen-compress", "--help"], (0,), 0),
    "refused scene": (["platen-compress", DEMO, "-s", "Bond/Modulus = -1"], (0,), 2),
    "demo_dry": (["platen-compress", DEMO, *QUIET], (1, 2), 0),
    "concrete_dry": (["platen-compress", SCENES / "concrete_dry.prm", *QUIET], (1, 2), 0),
    "triaxial_concrete": (["platen-compress", SCENES / "triaxial_concrete.prm", *QUIET], (1, 2), 0),
    "interface triaxial": (["platen-compress", SCENES / "brittle_concrete_triaxial.prm", "-s", "Effects/Bond = elasto damage plastic", *QUIET], (1, 2), 0),
    "study_friction_quick": (["platen-study", "friction", SCENES / "study_friction_quick.prm", *QUIET], (1, 2), 0),
    "packing 5 018": (["platen-pack", DEMO, *QUIET], (1, 2), 0),
    "packing 22 500": (["platen-pack", DEMO, "-s", "Specimen/Sphere radius = 1.08 mm", *QUIET], (1, 2), 0),
}
LONG = ("concrete_dry", "triaxial_concrete", "interface triaxial", "study_friction_quick")


def run(command, apps, folder, threads, status):
    """Seconds, and the bytes of what it found; None where it failed."""
    line = [apps / command[0], *command[1:]] + (["-t", str(threads)] if threads else [])
    begin = time.monotonic()
    done = subprocess.run(line, capture_output=True, text=True, stdin=subprocess.DEVNULL, cwd=folder,
                          env=dict(os.environ, PLATEN_CACHE="none"))  # packings of earlier runs would be found
    seconds = time.monotonic() - begin
    if done.returncode != status:
        print(f"status {done.returncode}: {' '.join(map(str, done.args))}\n{done.stderr}", file=sys.stderr)
        return seconds, None
    files = [file for name in ("history.csv", "specimen.csv") if (file := pathlib.Path(folder, "run", name)).exists()]
    return seconds, files[0].read_bytes() if files else b""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before", type=pathlib.Path)
    parser.add_argument("after", type=pathlib.Path)
    parser.add_argument("--only", nargs="+", choices=list(CASES), default=list(CASES))
    parser.add_argument("--pairs", type=int, default=3)
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    failed = False
    print(f"{platform.node()}, {os.cpu_count()} cores, {datetime.date.today()}, {options.pairs} pairs\n")
    print("| case | threads | before, s | after, s | ratio | history |\n| --- | --- | --- | --- | --- | --- |", flush=True)
    for name in [name for name in options.only if not (options.quick and name in LONG)]:
        command, several, status = CASES[name]
        for threads in several:
            pairs = []
            for _ in range(options.pairs):
                pair = []
                for apps in (options.before.resolve(), options.after.resolve()):
                    with tempfile.TemporaryDirectory() as folder:
                        pair.append(run(command, apps, folder, threads, status))
                pairs.append([seconds for seconds, _ in pair])
                failed |= any(found is None for _, found in pair)
            told = "" if not pair[0][1] else "same" if pair[0][1] == pair[1][1] else "other"
            before, after = map(statistics.median, zip(*pairs))
            print(f"| {name} | {threads or ''} | {before:.3g} | {after:.3g} | {statistics.median(b / a for b, a in pairs):.2f} | {told} |", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
