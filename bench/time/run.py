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

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
SCENES = SOURCE / "scenes"


class Case:
    def __init__(self, app, *words, threads=(1, 2), long=False, status=(0,), folder=True):
        self.app, self.words, self.threads, self.long, self.status, self.folder = app, words, threads, long, status, folder

    def command(self, apps, folder, threads):
        line = [str(apps / self.app), *[str(word) for word in self.words]]
        if self.folder:
            line += ["-o", str(folder), "--quiet"]
        return line + (["-t", str(threads)] if threads else [])


CASES = {
    "help": Case("platen-compress", "--help", threads=(0,), folder=False),
    "refused scene": Case("platen-compress", SCENES / "demo_dry.prm", "-s", "Bond/Modulus = -1", threads=(0,), status=(2,),
                          folder=False),
    "demo_dry": Case("platen-compress", SCENES / "demo_dry.prm"),
    "concrete_dry": Case("platen-compress", SCENES / "concrete_dry.prm", long=True),
    "triaxial_concrete": Case("platen-compress", SCENES / "triaxial_concrete.prm", long=True),
    "interface triaxial": Case("platen-compress", SCENES / "brittle_concrete_triaxial.prm", "-s",
                               "Effects/Bond = elasto damage plastic", long=True),
    "study_friction_quick": Case("platen-study", "friction", SCENES / "study_friction_quick.prm", long=True),
    "packing 5 018": Case("platen-pack", SCENES / "demo_dry.prm"),
    "packing 22 500": Case("platen-pack", SCENES / "demo_dry.prm", "-s", "Specimen/Sphere radius = 1.08 mm"),
}


def run(case, apps, folder, threads):
    begin = time.monotonic()
    environment = dict(os.environ, PLATEN_CACHE="none")  # packings of earlier runs would be found
    done = subprocess.run(case.command(apps, folder, threads), capture_output=True, text=True, stdin=subprocess.DEVNULL,
                          cwd=folder.parent, env=environment)
    seconds = time.monotonic() - begin
    if done.returncode not in case.status:
        print(f"status {done.returncode}: {' '.join(done.args)}\n{done.stderr}", file=sys.stderr)
        return None, seconds
    return done, seconds


def same(one, other):
    files = [folder / "history.csv" for folder in (one, other)]
    files = files if files[0].exists() else [folder / "specimen.csv" for folder in (one, other)]
    if not files[0].exists():
        return ""
    return "same" if files[0].read_bytes() == files[1].read_bytes() else "other"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before", type=pathlib.Path)
    parser.add_argument("after", type=pathlib.Path)
    parser.add_argument("--only", nargs="+", choices=list(CASES), default=[])
    parser.add_argument("--pairs", type=int, default=3)
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    before, after = options.before.resolve(), options.after.resolve()
    failed = False
    print(f"{platform.node()}, {os.cpu_count()} cores, {datetime.date.today()}, {options.pairs} pairs\n")
    print("| case | threads | before, s | after, s | ratio | history |\n| --- | --- | --- | --- | --- | --- |", flush=True)
    for name, case in CASES.items():
        if options.only and name not in options.only or options.quick and case.long:
            continue
        for threads in case.threads:
            seconds, told = {before: [], after: []}, ""
            for _ in range(options.pairs):
                with tempfile.TemporaryDirectory() as scratch:
                    folders = {before: pathlib.Path(scratch) / "one", after: pathlib.Path(scratch) / "two"}
                    for apps, folder in folders.items():
                        done, took = run(case, apps, folder, threads)
                        failed |= done is None
                        seconds[apps].append(took)
                    told = same(*folders.values())
            ratio = statistics.median(a / b for a, b in zip(seconds[before], seconds[after]))
            print(f"| {name} | {threads or ''} | {statistics.median(seconds[before]):.3g} | "
                  f"{statistics.median(seconds[after]):.3g} | {ratio:.2f} | {told} |", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
