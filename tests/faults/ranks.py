#!/usr/bin/env python3
"""Runs on several ranks of mpirun beside runs in one process, to the byte.

    ranks.py table FOLDER_OF_APPS --mpiexec MPIEXEC [--only CASE ...] [--ranks 2 3 4 7 16] [--delay LIBRARY]
    ranks.py large FOLDER_OF_APPS --mpiexec MPIEXEC [--only CASE ...] [--ranks 2 3 4 7 16]

table: boundaries and laws on some 3 000 spheres (7 blocks); with a library of delays (tests/dist/delay) each message waits for a random moment.
large: the boundaries and laws with more than 10 000 spheres (16 ranks have work), 1 and 2 threads a rank. One line of result a run. Exit status: 0;
1 where a byte differs, a run hangs or ends otherwise. The table takes an hour on two idle cores, large two. Kills of ranks: stops.py.
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import time

import faults
from stops import unlike

PATIENCE = 1800  # s: a run that takes longer hangs
RANKS = [2, 3, 4, 7, 16]
SHORT = ["Loading/Axial rate = 2 m/s", "Loading/Target strain = 0.004", "Loading/Stop at residual = 0",
         "Output/Every = 8", "Output/Fields every = 160", "Checkpoint/Every = 100"]
CELL = ["Loading/Confining pressure = 20 MPa", "Loading/Confining ramp = 0.02 ms"]
YIELDING = ["Effects/Bond = yielding parallel bond", "Bond/Compression limits = 20 MPa, 45 MPa, 70 MPa",
            "Bond/Compression slopes = 3, 12, 22"]
FACETS = ["Effects/Bond = facet", "Bond/Modulus = 28 GPa", "Bond/Stiffness ratio = 0.25", "Bond/Tensile strength = 4 MPa",
          "Bond/Shear strength = 11 MPa", "Bond/Fracture energy = 10 J/m2", "Bond/Friction static = 0.2", "Bond/Friction dynamic = 0.6",
          "Bond/Transitional stress = 600 MPa", "Bond/Compression limits = 20 MPa, 45 MPa, 70 MPa",
          "Bond/Compression slopes = 3, 12, 22", "Bond/Gap = 0.6 R_min"]
TRUE_TRIAXIAL = faults.SOURCE / "scenes/true_triaxial.prm"
STAGES = faults.SOURCE / "scenes/multistage_triaxial.prm"
CLASS_TWO = faults.SOURCE / "scenes/class_two_concrete.prm"


def crushed(*entries):
    """The test cylinder with some 3 000 spheres and 600 steps."""
    return "platen-compress", faults.CRUSHED, ["Specimen/Sphere radius = 0.6 mm", *SHORT, *entries]


CASES = {
    "rigid": crushed(),
    "elastic_explicit": crushed("Platens/Kind = deformable", "Platens/Motion = explicit"),
    "elastic_quasi_static": crushed("Platens/Kind = deformable", "Platens/Motion = quasi-static"),
    "sleeve": crushed("Loading/Confinement = sleeve", "Sleeve/Thickness = 1 mm", *CELL),
    "skin": crushed("Loading/Confinement = particles", *CELL),
    "servo": crushed("Platens/Top/Control = stress", "Platens/Top/Stress = 60 MPa", "Loading/Ramp = 0.02 ms",
                     "Loading/Hold = 0.02 ms"),
    "machine": crushed("Platens/Machine stiffness = 50 MN/m"),
    "seat": crushed("Platens/Top/Seat = spherical"),
    "wall": crushed("Loading/Test = uniaxial strain"),
    "cohesive_beam": crushed("Effects/Bond = cohesive beam"),
    "elasto_damage_plastic": crushed("Effects/Bond = elasto damage plastic"),
    "facets": crushed(*FACETS),
    "yielding": crushed(*YIELDING),
    "hertz_rolling": crushed("Effects/Contact = hertz", "Effects/Tangential = coulomb with rolling resistance",
                             "Contact/Rolling friction = 0.1"),
    "bond_dashpots": crushed("Bond/Damping = 0.1"),
    "scatter_phases": crushed("Bond/Strength scatter = weibull", "Bond/Weibull modulus = 6", "Phases/By = radius",
                              "Phases/Radius above = 0.63 mm", "Phases/Interface modulus factor = 0.7"),
    "seats_gravity_scheme": crushed("Effects/Gravity = on", "Specimen/Seat = on", "Integration/Mass scaling = 2",
                                    "Integration/Scheme = tchamwa wielgosz", "Integration/Dissipation = 1.2"),
    "no_rotation": crushed("Effects/Rotation = off"),
    "start_strain": crushed("Loading/Start strain = 4e-4"),
    "tension": crushed("Loading/Test = tension", "Platens/Attachment = glued", "Loading/Target strain = 0.002"),
    "bending": ("platen-compress", faults.SCENES / "bent.prm", []),
    "notched": ("platen-compress", faults.SCENES / "bent.prm", ["Specimen/Notch depth = 4 mm", "Loading/Stage 1/Axial = cmod rate 20 mm/s",
                                                         "Loading/Stage 1/Until = cmod 20 um"]),
    "brazilian": ("platen-brazilian", faults.SCENES / "split.prm", []),
    "six_platens": ("platen-compress", TRUE_TRIAXIAL, ["Specimen/Sphere radius = 2.4 mm"]),
    "stages": ("platen-compress", STAGES, ["Specimen/Sphere radius = 2.8 mm"]),
    "class_two": ("platen-compress", CLASS_TWO, ["Specimen/Sphere radius = 2.8 mm"]),
}
# Cases with more than 10 000 spheres (16 ranks have work), through the peak and to the end.
FINE = ["Specimen/Sphere radius = 0.39 mm", "Loading/Target strain = 0.006", "Loading/Axial rate = 1.5 m/s",
        "Output/Every = 25", "Output/Fields every = 800", "Checkpoint/Every = 800"]
LARGE = {name: (CASES[name][0], CASES[name][1], [*CASES[name][2], *FINE])
         for name in ["rigid", "elastic_explicit", "elastic_quasi_static", "sleeve", "skin", "servo", "cohesive_beam",
                      "elasto_damage_plastic", "yielding"]}
LARGE["servo"][2].extend(["Platens/Top/Stress = 150 MPa", "Loading/Ramp = 0.05 ms"])  # more than it bears
LARGE["six_platens"] = ("platen-compress", TRUE_TRIAXIAL, ["Specimen/Sphere radius = 1.18 mm", *FINE[2:]])


class Runs(faults.Figures):
    """Starts runs in one process and on ranks."""

    def __init__(self, options):
        super().__init__(62)
        self.compared = 0
        self.apps, self.mpiexec, self.delay = options.apps, options.mpiexec, options.delay
        self.environment = dict(os.environ, **dict(word.split("=", 1) for word in options.environment.split()))

    def command(self, case, folder, ranks, threads=1, *options):
        app, scene, entries = case
        line = faults.command(self.apps / app, scene, folder, entries, "-t", str(threads), *options)
        delayed = ["env", f"LD_PRELOAD={self.delay}", "PLATEN_DELAY_US=200", f"PLATEN_DELAY_SEED={ranks}"]
        return line if ranks == 0 else [str(self.mpiexec), "-n", str(ranks), *(delayed if self.delay else []), *line]

    def whole(self, *arguments):
        """Status, what it said and seconds of a run that nobody disturbs; status None: it hangs."""
        begin = time.monotonic()
        try:
            done = faults.run(self.command(*arguments), env=self.environment, timeout=PATIENCE)
            return done.returncode, done.stderr, time.monotonic() - begin
        except subprocess.TimeoutExpired as late:
            return None, str(late.stderr), PATIENCE


def compare(runs, name, case, cuts, scratch):
    """One line for each of `cuts`: so many ranks of so many threads."""
    whole = scratch / name
    status, said, seconds = runs.whole(case, whole, 0)
    if status not in (0, 1):  # few spheres: not the strength that a scene expects
        return runs.fail(f"{name}: status {status}: {said}")
    rows = (whole / "history.csv").read_bytes().count(b"\n") - 1
    cracks = (whole / "cracks.csv").read_bytes().count(b"\n") - 1 if (whole / "cracks.csv").exists() else 0
    summary = json.loads((whole / "summary.json").read_text())
    print(f"{name}: one process, {summary['particles']} spheres, {summary['steps']} steps, {rows} rows, {cracks} cracks, "
          f"{'with' if summary.get('peak_reached') else 'without'} a peak, {seconds:.1f} s", flush=True)
    for ranks, threads in cuts:
        folder = scratch / f"{name}_{ranks}"
        on_ranks, said, seconds = runs.whole(case, folder, ranks, threads)
        if on_ranks != status:
            runs.fail(f"{name} on {ranks} ranks of {threads} threads: status {on_ranks}, not {status}: {said[-2000:]}")
            continue
        files = unlike(runs.apps, whole, folder)
        runs.compared += 1
        print(f"{name}: {ranks} ranks of {threads} threads, {seconds:.1f} s, {'the same bytes' if not files else 'unlike'}", flush=True)
        if files:
            runs.fail(f"{name} on {ranks} ranks of {threads} threads: not as in one process: {files}")
        shutil.rmtree(folder)
    shutil.rmtree(whole)


def main():
    parser = faults.parser(__doc__)
    parser.add_argument("what", choices=["table", "large"])
    parser.add_argument("apps", type=pathlib.Path, help="folder of the apps")
    parser.add_argument("--mpiexec", required=True)
    parser.add_argument("--environment", default="", help="for mpirun: NAME=VALUE ...")
    parser.add_argument("--delay", default="", help="library that delays messages")
    parser.add_argument("--only", nargs="*", choices=list(CASES), default=[], help="of table and large")
    parser.add_argument("--ranks", type=int, nargs="*", default=RANKS)
    options = parser.parse_args()
    runs = Runs(options)
    with faults.scratch() as scratch:
        cases = CASES if options.what == "table" else LARGE
        for name in options.only or cases:
            # The small ones on one thread but for two ranks, the large ones on one and two.
            cuts = [(ranks, threads) for ranks in options.ranks for threads in (1, 2)
                    if options.what == "large" or threads == (2 if ranks == 2 else 1)]
            if options.what == "large":
                cuts.insert(0, (1, 2))
            compare(runs, name, cases[name], cuts, scratch)
        size = "above 10 000" if options.what == "large" else "some 3 000"
        late = ", late messages" if runs.delay else ""
        runs.note(f"runs on ranks compared, {size} spheres{late}", runs.compared)
        runs.exactly(f"runs on ranks unlike, {size} spheres{late}", len(runs.failures), 0)
    return runs.status()


if __name__ == "__main__":
    sys.exit(main())
