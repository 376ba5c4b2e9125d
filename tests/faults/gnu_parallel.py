#!/usr/bin/env python3
"""Makes a study by GNU parallel in random order, kills some of its runs, and takes it up again.

    gnu_parallel.py FOLDER_OF_PROGRAMS [--seed 1]

Every file of every run, study.csv and study.json have the bytes of one process.
Exit status: 0; 1 where that does not hold; 77 where GNU parallel is not installed. A minute.
"""

import argparse
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import faults
import slurm


def processes(folder):
    """Ids of the runs that are at work in a study's folder."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0") if entry.name.isdigit() else []
            name = (entry / "comm").read_text().strip() if words else ""
        except OSError:  # it has ended
            continue
        # A run may be a copy of platen-study, whose command line it has.
        if name == "platen-compress" and any(word.startswith(os.fsencode(folder)) for word in words):
            found.append(int(entry.name))
    return sorted(found)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", type=pathlib.Path, help="folder of the apps")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    if shutil.which("parallel") is None:
        slurm.skip("not installed: parallel (scripts/setup.sh --cluster)")
    draw = random.Random(options.seed)
    figures = faults.Figures(61)
    scene, *entries = slurm.SMALL
    sets = [word for entry in entries for word in ("-s", entry)]
    study = str(options.programs.resolve() / "platen-study")
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        whole, folder = scratch / "whole", scratch / "by_parallel"
        base = [study, "friction", str(scene), "-o", str(folder), *sets]
        if faults.run([study, "friction", str(scene), "-o", str(whole), *sets]).returncode != 0:
            figures.fail("in one process")
        faults.run([*base, "--plan"])
        count = len((folder / "plan.csv").read_text().splitlines()) - 1
        numbers = "\n".join(str(number) for number in draw.sample(range(1, count + 1), count))
        parallel = ["parallel", "--quote", "-j", "2", "--joblog", str(folder / "jobs.log"), "--resume-failed", *base, "--run", "{}", "-t",
                    "1"]
        kills = 0
        with subprocess.Popen(parallel, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                              text=True) as process:
            process.stdin.write(numbers)
            process.stdin.close()
            while process.poll() is None:
                at_work = [run for run in folder.glob("runs/*") if slurm.checkpoints(run) and not (run / "summary.json").exists()]
                if kills < 3 and at_work and (victims := processes(folder)):
                    os.kill(draw.choice(victims), signal.SIGKILL)
                    kills += 1
                time.sleep(0.3)
        figures.at_least("runs killed under GNU parallel", kills, 1)
        again = subprocess.run(parallel, input=numbers, text=True, capture_output=True)
        if again.returncode != 0:
            figures.fail(f"taken up again: status {again.returncode}: {again.stderr}")
        collected = faults.run([*base, "--collect"])
        figures.exactly("exit status of --collect", collected.returncode, 0)
        wanted, found = slurm.comparable(whole), slurm.comparable(folder)
        unlike = faults.difference(wanted, found)
        figures.exactly("files unlike those of one process under GNU parallel", len(unlike), 0)
        if unlike:
            print("\n".join(unlike))
    return figures.status()


if __name__ == "__main__":
    sys.exit(main())
