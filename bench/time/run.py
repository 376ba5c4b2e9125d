#!/usr/bin/env python3
"""Seconds from command to prompt: of two builds side by side, or of one test on a machine that others use too.

    bench/time/run.py BEFORE AFTER [--only CASE ...] [--repeats 3] [--quick]
    bench/time/run.py APPS --busy 2 [--threads 1 2 8] [--repeats 3]

Folders are those of apps (build/apps). Every run starts in an empty folder, without a cache of packings; all are run in turn, and tables have
medians. Two builds: of each case also the median of the ratios of pairs, and, where both end, whether they gave the same history.csv; --quick leaves
out what takes above a minute. --busy N: demo_dry with each number of threads on an idle machine and beside N processes that compute without end. A
fair share beside N of them on as many cores is half of the machine: twice the idle seconds of a thread on each core; CPU seconds above those of
one thread are waiting for each other without sleep. For a machine that is quiet but for this. Exit status: 0; 1 where a run fails.
"""

import argparse
import datetime
import os
import pathlib
import platform
import resource
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


def run(apps, case, threads):
    """Wall and CPU seconds of one run, and the bytes of what it found; None where it failed."""
    command, _, status = CASES[case]
    line = [apps.resolve() / command[0], *command[1:]] + (["-t", str(threads)] if threads else [])
    with tempfile.TemporaryDirectory() as folder:
        before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        done = subprocess.run(line, capture_output=True, text=True, stdin=subprocess.DEVNULL, cwd=folder,
                              env=dict(os.environ, PLATEN_CACHE="none"))  # packings of earlier runs would be found
        wall, after = time.monotonic() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
        files = [file for name in ("history.csv", "specimen.csv") if (file := pathlib.Path(folder, "run", name)).exists()]
        found = files[0].read_bytes() if files else b""
    if done.returncode != status:
        print(f"status {done.returncode}: {' '.join(map(str, done.args))}\n{done.stderr}", file=sys.stderr)
        found = None
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, found


def side_by_side(builds, cases, pairs):
    """The table of two builds; whether no run failed."""
    failed = False
    print("| case | threads | before, s | after, s | ratio | history |\n| --- | --- | --- | --- | --- | --- |", flush=True)
    for case in cases:
        for threads in CASES[case][1]:
            rows = [[run(apps, case, threads) for apps in builds] for _ in range(pairs)]
            found = [of for row in rows for _, _, of in row]
            failed |= None in found
            told = "" if not found[-1] else "same" if found[-1] == found[-2] else "other"
            before, after = ([row[k][0] for row in rows] for k in (0, 1))
            print(f"| {case} | {threads or ''} | {statistics.median(before):.3g} | {statistics.median(after):.3g} | "
                  f"{statistics.median(b / a for b, a in zip(before, after)):.2f} | {told} |", flush=True)
    return not failed


def beside_others(apps, count, numbers, repeats):
    """The table of one test beside `count` processes; whether no run failed."""
    found = {(others, threads): [] for others in (0, count) for threads in numbers}
    for _ in range(repeats):
        for (others, threads), rows in found.items():
            busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(others)]
            try:
                rows.append(run(apps, "demo_dry", threads))
            finally:
                for process in busy:
                    process.kill()
                    process.wait()
    median = {key: [statistics.median(column) for column in list(zip(*rows))[:2]] for key, rows in found.items()}
    cores = os.cpu_count()
    fair = median.get((0, cores), [float("nan")])[0] * (cores + count) / cores
    print(f"Fair share beside {count}: {fair:.2f} s\n\n| busy processes | threads | seconds | CPU seconds | over fair share | "
          "over a thread on each core |\n| --- | --- | --- | --- | --- | --- |")
    for (others, threads), (wall, cpu) in median.items():
        same = wall / median[others, cores][0] if (others, cores) in median else float("nan")
        print(f"| {others} | {threads} | {wall:.2f} | {cpu:.2f} | {f'{wall / fair:.2f}' if others else '-'} | {same:.2f} |")
    return not any(row[2] is None for rows in found.values() for row in rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("builds", nargs="+", type=pathlib.Path, metavar="APPS")
    parser.add_argument("--only", nargs="+", choices=list(CASES), default=list(CASES))
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--busy", type=int, default=0, metavar="N")
    parser.add_argument("--threads", type=int, nargs="+", default=[1, os.cpu_count(), 4 * os.cpu_count()], help="with --busy")
    asked = parser.parse_args()
    if len(asked.builds) != (1 if asked.busy else 2):
        parser.error("BEFORE AFTER, or APPS --busy N")
    print(f"{platform.node()}, {os.cpu_count()} cores, {datetime.date.today()}, medians of {asked.repeats}\n")
    if asked.busy:
        return 0 if beside_others(asked.builds[0], asked.busy, asked.threads, asked.repeats) else 1
    cases = [case for case in asked.only if not (asked.quick and case in LONG)]
    return 0 if side_by_side(asked.builds, cases, asked.repeats) else 1


if __name__ == "__main__":
    sys.exit(main())
