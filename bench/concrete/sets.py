#!/usr/bin/env python3
"""What trades against what: sets of facet bonds (sets.csv) in the main tests, on one packing each.

    bench/concrete/sets.py BUILD FOLDER [PICTURE.png]   runs what FOLDER lacks, two at a time, prints a table and draws

Spheres of 2.2 mm (11 across a cylinder), in plane stress of 1.78 mm; one_concrete and any_stress have finer ones and more packings.
"""
import concurrent.futures
import math
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import platen

COARSE = ["Specimen/Sphere radius = 2.2 mm"]
PLANE = ["Specimen/Sphere radius = 1.78 mm", "Platens/Friction static = 0"]
TESTS = {
    "dry": ("concrete_dry", COARSE), "tension": ("concrete_tension", COARSE), "split": ("brazilian_concrete", COARSE),
    "bi0": ("biaxial_steel", [*PLANE, "Loading/Stage 1/Lateral x = free"]),
    "bi5": ("biaxial_steel", [*PLANE, "Loading/Stage 1/Lateral x = share of Axial 0.5"]),
    "bi1": ("biaxial_steel", [*PLANE, "Loading/Stage 1/Lateral x = share of Axial 1"]),
    "t9": ("triaxial_concrete", COARSE), "t30": ("triaxial_concrete", [*COARSE, "Loading/Confining pressure = 30 MPa"]),
    **{f"{form}{mu[-1]}": (f"{form}_dry", [*COARSE, f"Platens/Friction static = {mu}"]) for form in ("cube", "prism") for mu in ("0.3", "0")},
    "h1": ("concrete_dry", [*COARSE, "Specimen/Height = 50 mm", "Loading/Target strain = 0.012", "Loading/Stop at residual = 0.7"]),
    "flat": ("flat_dry", COARSE)}
# figure: band of laboratories (any_stress.md)
BANDS = {"strength, MPa": (35, 45), "strain at peak, 1e-3": (2, 2.6), "over tension": (8, 12), "splitting over tension": (0.9, 1.15),
         "two stresses 1 : 1": (1.08, 1.24), "1 : 0.5": (1.15, 1.35), "k at 9 MPa": (3.68, 5.74), "strain at 9 MPa over bare": (3, 6.5),
         "last over peak at 9 MPa": (0.85, math.inf), "volume at the peak at 9 MPa, %": (-0.3, 0.5), "k at 30 MPa": (2.41, 4.66),
         "volume at 30 MPa, %": (-1, 0.2), "cube": (1.21, 1.59), "prism": (1.03, 1.12), "height 1 over 2": (1.09, 1.21), "height .5 over 2": (1.5, 2.2),
         "cones": (1, 1)}


def run(build, folder, name, entries, test, seed=1):
    target = folder / name.replace(" ", "_").replace("/", "_") / f"{test}_{seed}"
    if not (target / "summary.json").exists():
        target.parent.mkdir(parents=True, exist_ok=True)
        scene, own = TESTS[test]
        file = target.parent / f"{test}.prm"
        file.write_text(f"include {ROOT}/scenes/{scene}.prm\ninclude {ROOT}/scenes/parts/facet_bonds.prm\n")
        program = "platen-brazilian" if test == "split" else "platen-compress"
        command = [build / "apps" / program, file, "-o", target, "--overwrite", "--quiet", "-t", "1", "-s", "Output/Fields = off", "-s", f"Scene/Seed = {seed}"]
        given = [entry if "/" in entry.split("=")[0] else f"Bond/{entry}" for entry in entries]
        subprocess.run([*map(str, command), *(part for entry in [*own, *given] for part in ("-s", entry))], check=False, stderr=subprocess.DEVNULL)
    return platen.Run(target)


def strength(run):
    s = run.summary
    return (s["largest_stress_pa"] if s["strength_pa"] is None else s["strength_pa"]) / 1e6


def under_pressure(run):
    """Last over largest deviator at a strain of 3.45e-2, and volume of the middle half at the largest, %."""
    deviator, strain = run.history["deviator_pa"], run.history["axial_strain_platen"]
    start = strain[run.history["time_s"] >= run.summary["consolidation_end_time_s"]][0]
    peak = int(deviator.argmax())
    later = (strain[peak:] >= start + 0.0345).nonzero()[0]
    last = deviator[peak + later[0]] / deviator[peak] if later.size else math.nan
    return last, -100 * run.history["volumetric_strain"][peak]


def figures(runs):
    at = {test: strength(run) for test, run in runs.items()}
    dry = runs["dry"].summary
    last, volume = under_pressure(runs["t9"])
    at_peak = runs["t9"].summary["strain_at_peak_platen"]
    return dict(zip(BANDS, (
        at["dry"], 1e3 * dry["strain_at_peak_platen"], at["dry"] / at["tension"], at["split"] / at["tension"], at["bi1"] / at["bi0"], at["bi5"] / at["bi0"],
        (at["t9"] - at["dry"]) / 9, at_peak / dry["strain_at_peak_platen"] if at_peak else math.nan, last, volume, (at["t30"] - at["dry"]) / 30,
        under_pressure(runs["t30"])[1], at["cube3"] / at["cube0"], at["prism3"] / at["prism0"], at["h1"] / at["dry"], at["flat"] / at["dry"],
        float(dry["pattern"] == "cones"))))


def within(figure, value):
    low, high = BANDS[figure]
    return low <= value <= high


def draw(found, picture):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    pairs = (("1 : 0.5", "height .5 over 2"), ("1 : 0.5", "last over peak at 9 MPa"), ("1 : 0.5", "strain at peak, 1e-3"))
    chart, axes = plt.subplots(1, len(pairs), figsize=(13, 5.8))
    chart.subplots_adjust(left=0.05, right=0.99, top=0.97, bottom=0.33, wspace=0.2)
    for place, (x, y) in zip(axes, pairs):
        for k, (name, values) in enumerate(found.items()):
            inside = sum(within(figure, value) for figure, value in values.items())
            place.plot(values[x], values[y], marker="os"[k // 10], ms=4 + inside / 2, ls="", color=f"C{k % 10}", mec="black",
                       label=f"{name}: {inside} of {len(BANDS)}" if place is axes[0] else None)
        for axis, figure in ((place.axvspan, x), (place.axhspan, y)):
            low, high = BANDS[figure]
            axis(low, min(high, 3 if figure != "last over peak at 9 MPa" else 1), color="#009e73", alpha=0.12, lw=0)
        values = [v[y] for v in found.values() if v[y] == v[y]]
        low, high = BANDS[y]
        place.set(xlabel=f"Strength under two stresses {x} over one", ylabel=y[0].upper() + y[1:], xlim=(1.1, 1.52),
                  ylim=(0.95 * min(*values, low), 1.05 * max(*values, low * 1.03)))
    chart.legend(loc="lower center", ncol=3, fontsize=8, title="set of bonds: figures within the bands of laboratories (green)")
    chart.savefig(picture, dpi=80)


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    build, folder = map(pathlib.Path, sys.argv[1:3])
    sets = {row["set"]: [e.strip() for e in (row["entries"] or "").split(";") if e.strip()] for row in
            platen.read_table(pathlib.Path(__file__).with_name("sets.csv")).records()}
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        made = {(name, test): pool.submit(run, build, folder, name, entries, test) for name, entries in sets.items() for test in TESTS}
    found = {name: figures({test: made[name, test].result() for test in TESTS}) for name in sets}
    print("| | " + " | ".join(found) + " |")
    print("| --- |" + " --- |" * len(found))
    for figure in BANDS:
        print(f"| {figure} | " + " | ".join("-" if (v := values[figure]) != v else f"{v:.3g}" if within(figure, v) else f"**{v:.3g}**" for values in found.values()) + " |")
    print("| within | " + " | ".join(f"{sum(within(f, v) for f, v in values.items())} of {len(BANDS)}" for values in found.values()) + " |")
    if len(sys.argv) == 4:
        draw(found, sys.argv[3])


main()
