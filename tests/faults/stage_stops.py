#!/usr/bin/env python3
"""Stops tests by stages in each of their stages and resumes them with another number of threads.

    stage_stops.py platen-compress [--scenes NAME ...]

The shipped scenes of several sides and stages, of few spheres. A run is stopped (SIGINT) once its history has a row of the
stage, resumed with 1, 2 or 4 threads, and leaves the bytes of a run that nobody stopped. Exit status: 0; 1 where it does not.
"""

import argparse
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

import faults

SCENES = {
    "biaxial_steel": ["Specimen/Sphere radius = 3.2 mm"],
    "biaxial_brush": ["Specimen/Sphere radius = 3.2 mm", "Platens/Degree = 1", "Loading/Stage 1/Until = strain 0.3 %"],
    "true_triaxial": ["Specimen/Sphere radius = 4 mm"],
    "hold_concrete": ["Specimen/Sphere radius = 4 mm"],
    "multistage_triaxial": ["Specimen/Sphere radius = 4 mm"],
    "class_two_concrete": ["Specimen/Sphere radius = 4 mm"],
}
THREADS = (1, 2, 4)


def last_stage(folder):
    """Number of the stage in the last whole row of history.csv; 0 where there is none."""
    try:
        lines = (folder / "history.csv").read_text().split("\n")[:-1]
    except FileNotFoundError:
        return 0
    return int(lines[-1].split(",")[lines[0].split(",").index("stage")]) if len(lines) > 1 else 0


def stopped_in(stage, command, folder):
    """Runs until a row of that stage is there and stops; its exit status, and the stage that it was stopped in."""
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    while last_stage(folder) < stage and process.poll() is None:
        time.sleep(1e-3)
    process.send_signal(signal.SIGINT)
    said = process.communicate()[1]
    return process.returncode, last_stage(folder), said


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path, help="platen-compress")
    parser.add_argument("--scenes", nargs="*", choices=list(SCENES), default=list(SCENES))
    options = parser.parse_args()
    figures = faults.Figures(49)
    stops = elsewhere = unlike = 0
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        for name in options.scenes:
            scene = faults.SOURCE / f"scenes/{name}.prm"
            entries = SCENES[name] + ["Output/Fields every = 1000000"]

            def command(folder, threads, *more):
                return faults.command(options.program, scene, folder, entries, "-t", str(threads), *more)

            whole = scratch / name
            done = faults.run(command(whole, 1))
            if done.returncode not in (0, 1):  # few spheres: not the strength that the scene expects
                figures.fail(f"{name}: status {done.returncode}: {done.stderr}")
                continue
            wanted = faults.results(whole)
            for stage in range(1, last_stage(whole) + 1):
                for k, threads in enumerate(THREADS):
                    folder = scratch / f"{name}_{stage}_{threads}"
                    status, reached, said = stopped_in(stage, command(folder, THREADS[k - 1]), folder)
                    if status not in (0, 1, 130):
                        figures.fail(f"{name}, stage {stage}: status {status}: {said}")
                        continue
                    stops += status == 130
                    elsewhere += reached != stage
                    if status == 130:
                        faults.run(command(folder, threads, "--resume"))
                    files = faults.difference(wanted, faults.results(folder))
                    unlike += bool(files)
                    if files:
                        figures.fail(f"{name}, stopped in stage {reached}, resumed on {threads} threads: {files}")
    figures.note("stops in a stage", stops, "any")
    figures.note("stops that came a stage late", elsewhere, "any")
    figures.exactly("runs that ended otherwise", unlike, 0)
    return figures.status()


if __name__ == "__main__":
    sys.exit(main())
