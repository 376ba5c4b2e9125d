#!/usr/bin/env python3
"""Seconds of one test on a machine that others use too.

    bench/time/busy.py APPS [--repeats 3] [--busy N] [--threads 1 2 8] [--scene SCENE]

APPS is a folder of apps (build/apps). The test is run with each number of threads on an idle machine and beside N processes that
compute without end (as many as cores unless told). A fair share beside N of them on as many cores is half of the machine: twice the idle
seconds of a thread on each core. The table has medians, all in turn, and CPU seconds: what they are above those of one thread is
waiting for each other without sleep. For a machine that is quiet but for this. Exit status: 0; 1 where a run fails.
"""

import argparse
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent


def seconds(app, scene, threads):
    """Wall and CPU seconds of one run."""
    with tempfile.TemporaryDirectory() as folder:
        before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        done = subprocess.run([app, scene, "-o", f"{folder}/run", "--quiet", "-t", str(threads)], cwd=folder, capture_output=True,
                              text=True, stdin=subprocess.DEVNULL, env=dict(os.environ, PLATEN_CACHE="none"))
        wall, after = time.monotonic() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        sys.exit(f"status {done.returncode}: {' '.join(map(str, done.args))}\n{done.stderr}")
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def beside(count, measure):
    busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(count)]
    try:
        return measure()
    finally:
        for process in busy:
            process.kill()
            process.wait()


def main():
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("apps", type=pathlib.Path)
    words.add_argument("--repeats", type=int, default=3)
    words.add_argument("--busy", type=int, default=os.cpu_count())
    words.add_argument("--threads", type=int, nargs="+", default=[1, os.cpu_count(), 4 * os.cpu_count()])
    words.add_argument("--scene", type=pathlib.Path, default=SOURCE / "scenes" / "demo_dry.prm")
    chosen = words.parse_args()
    app, scene = (chosen.apps / "platen-compress").resolve(), chosen.scene.resolve()
    found = {}
    for _ in range(chosen.repeats):
        for count in (0, chosen.busy):
            for threads in chosen.threads:
                figures = beside(count, lambda: seconds(app, scene, threads))
                found.setdefault((count, threads), []).append(figures)
                print(f"# beside {count}, {threads} threads: {figures[0]:.2f} s, {figures[1]:.2f} CPU s", file=sys.stderr, flush=True)
    median = {key: [statistics.median(column) for column in zip(*rows)] for key, rows in found.items()}
    cores = os.cpu_count()
    fair = median.get((0, cores), [float("nan")])[0] * (cores + chosen.busy) / cores
    print(f"{scene.stem}, {cores} cores, medians of {chosen.repeats}; fair share beside {chosen.busy}: {fair:.2f} s\n")
    print("| busy processes | threads | seconds | CPU seconds | over fair share | over a thread on each core |")
    print("| --- | --- | --- | --- | --- | --- |")
    for (count, threads), (wall, cpu) in median.items():
        share = f"{wall / fair:.2f}" if count else "-"
        same = wall / median[count, cores][0] if (count, cores) in median else float("nan")
        print(f"| {count} | {threads} | {wall:.2f} | {cpu:.2f} | {share} | {same:.2f} |")


if __name__ == "__main__":
    main()
