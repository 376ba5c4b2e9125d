#!/usr/bin/env python3
"""The facet bonds in the public benchmarks of the Lattice Discrete Particle Model: runs, table and picture.

    bench/ldpm/ldpm.py BUILD FOLDER [PICTURE.png]   runs what FOLDER lacks, prints the table, draws

A prism between frictionless and between rough platens, in a stiff ring (uniaxial strain) and pulled by glued ends; of spheres as
large as their aggregates (three packings) and of half that size. Their curves: curves.csv, with its source.
"""
import pathlib
import subprocess
import sys

import numpy

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "python"))
import platen

TESTS = {"free": [], "fixed": ["Platens/Friction static = 5", "Loading/Target strain = 0.012"],
         "uniaxial_strain": ["Loading/Test = uniaxial strain", "Loading/Target strain = 0.05", "Loading/Axial rate = 0.5 m/s"],
         "tension": ["Loading/Test = tension", "Platens/Attachment = glued", "Loading/Axial rate = 0.01 m/s", "Loading/Target strain = 0.0008"]}
SIZES = {"5.9": (1, 2, 3), "3": (1,)}  # mm: seeds
NECK_STIFFNESS = 0.3234e12  # Pa/m, of the dog-bone before it cracks


def published():
    table = platen.read_table(HERE / "curves.csv").records()
    return {test: numpy.array([(row["x"], row["stress_mpa"], row["between_codes_mpa"]) for row in table if row["test"] == test]) for test in TESTS}


def run(build, folder, test, size, seed):
    target = folder / f"{test}_{size}_{seed}"
    if not (target / "summary.json").exists():
        entries = [*TESTS[test], f"Specimen/Sphere radius = {size} mm", f"Scene/Seed = {seed}"]
        command = [build / "apps/platen-compress", HERE / "prism.prm", "-o", target, "--overwrite", "--quiet", "-t", "1"]
        subprocess.run([*map(str, command), *(part for entry in entries for part in ("-s", entry))], check=False)
    return platen.Run(target)


def curve(test, run):
    """Strain of the middle half (up to the peak, then of the platens), or opening of the crack in tension, m; stress, MPa."""
    h, height = run.history, 0.2
    stress, platen_strain = abs(h["axial_stress_top_pa"]), abs(h["axial_strain_platen"])
    if test == "tension":
        return platen_strain * height - stress * height / run.summary["youngs_modulus_platen_pa"], stress / 1e6
    if test == "uniaxial_strain":
        return platen_strain, stress / 1e6
    peak = int(stress.argmax())  # beyond it the middle unloads or opens, so that only the platens' strain goes on
    gauge = abs(h["axial_strain_gauge"])
    return numpy.where(numpy.arange(len(stress)) <= peak, gauge, gauge[peak] + platen_strain - platen_strain[peak]), stress / 1e6


def opening(theirs):
    return numpy.column_stack([theirs[:, 0] - theirs[:, 1] * 1e6 / NECK_STIFFNESS, theirs[:, 1]])


def half_width(x, stress):
    """x beyond the peak where the stress has fallen to half of it; None where it has not."""
    peak = int(stress.argmax())
    below = (stress[peak:] < 0.5 * stress[peak]).nonzero()[0]
    return float(x[peak + below[0]]) if below.size else None


def said(values, digits=3):
    values = [value for value in values if value is not None]
    if not values:
        return "-"
    return f"{values[0]:.{digits}g}" if len(values) == 1 else f"{min(values):.{digits}g} ... {max(values):.{digits}g}"


def rows(theirs, ours):
    """(what, theirs, of each size) of the table."""
    def figure(test, f):
        return [said([f(*curve(test, run), run) for run in runs[test]]) for runs in ours.values()]

    def ratio(one, other):
        return [said([curve(one, a)[1].max() / curve(other, b)[1].max() for a, b in zip(runs[one], runs[other])]) for runs in ours.values()]

    free, fixed, pulled, ring = (theirs[test] for test in ("free", "fixed", "tension", "uniaxial_strain"))
    at_peak = lambda x, s, run: 1e3 * x[s.argmax()]
    return [
        ("Young's modulus, GPa (one factor is fitted to it)", "37.5", figure("free", lambda x, s, run: run.summary["youngs_modulus_gauge_pa"] / 1e9)),
        ("frictionless: peak, MPa", f"{free[:, 1].max():.3g}", figure("free", lambda x, s, run: s.max())),
        ("frictionless: strain at the peak, 1e-3", "2.14", figure("free", at_peak)),
        ("rough over frictionless", f"{fixed[:, 1].max() / free[:, 1].max():.3g}", ratio("fixed", "free")),
        ("rough: strain at the peak, 1e-3", "3.2", figure("fixed", at_peak)),
        ("tension: peak, MPa", f"{pulled[:, 1].max():.3g}", figure("tension", lambda x, s, run: s.max())),
        ("frictionless compression over tension", f"{free[:, 1].max() / pulled[:, 1].max():.3g}", ratio("free", "tension")),
        ("tension: opening at half of the peak, um", f"{1e6 * half_width(*opening(pulled).T):.2g}",
         figure("tension", lambda x, s, run: (w := half_width(x, s)) and 1e6 * w)),
        *((f"uniaxial strain: stress at {x:g}, MPa", f"{numpy.interp(x, ring[:, 0], ring[:, 1]):.3g}",
           figure("uniaxial_strain", lambda e, s, run, x=x: float(numpy.interp(x, e, s)))) for x in (0.0025, 0.01, 0.03, 0.045)),
        ("energy residual over work, largest of all tests, %", "2e-5 to .7 (six codes)",
         [f"{100 * max(run.summary['energy_residual_relative'] for test in runs.values() for run in test):.1g}" for runs in ours.values()]),
    ]


def draw(theirs, ours, picture):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(1, 3, figsize=(12, 4), layout="constrained")
    colours = dict(zip(SIZES, ("#0072b2", "#d55e00")))
    for test, place, style in (("free", 0, "-"), ("fixed", 0, "--"), ("tension", 1, "-"), ("uniaxial_strain", 2, "-")):
        for size, runs in ours.items():
            x, stress = curve(test, runs[test][0])
            axes[place].plot(1e6 * x if test == "tension" else 1e3 * x, stress, style, color=colours[size], lw=1.2,
                             label=f"facet bonds, {size} mm" + (", rough" if test == "fixed" else ""))
        points = opening(theirs[test]) if test == "tension" else theirs[test]
        axes[place].plot((1e6 if test == "tension" else 1e3) * points[:, 0], points[:, 1], "s" if test == "fixed" else "o", color="black", ms=4, mfc="none",
                         label="LDPM, six codes" + (", held ends" if test == "fixed" else ""))
    for place, (title, label, right) in enumerate((("Compression", "Axial strain (mm/m)", 9), ("Tension", "Opening of the crack (um)", 100),
                                                   ("Uniaxial strain", "Axial strain (mm/m)", 50))):
        axes[place].set(title=title, xlabel=label, ylabel="Stress (MPa)", xlim=(0, right), ylim=(0, None))
        axes[place].legend(fontsize=8, loc="upper right" if title == "Tension" else "lower right")
    figure.savefig(picture, dpi=100)


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    build, folder = map(pathlib.Path, sys.argv[1:3])
    theirs = published()
    ours = {size: {test: [run(build, folder, test, size, seed) for seed in seeds] for test in TESTS} for size, seeds in SIZES.items()}
    print("| | six codes | " + " | ".join(f"facet bonds, {size} mm ({len(seeds)})" for size, seeds in SIZES.items()) + " |")
    print("| --- | --- |" + " --- |" * len(SIZES))
    for what, their, our in rows(theirs, ours):
        print(f"| {what} | {their} | " + " | ".join(our) + " |")
    if len(sys.argv) == 4:
        draw(theirs, ours, sys.argv[3])


main()
