#!/usr/bin/env python3
"""Strength of imperfect tests over that of the perfect one, packing by packing, beside what laboratories state.

    bench/imperfect/imperfect.py BUILD FOLDER [SCENE]   runs what FOLDER lacks, two at a time, then prints the table

SCENE: scenes/facet_dry.prm, or another cylinder of 50 mm between dry platens. Heights of the laboratories' cylinders of 150 mm are a third here.
"""
import concurrent.futures
import pathlib
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import platen

SEEDS = (1, 2, 3, 4, 5)
SEAT, ARM = "Platens/Top/Seat = spherical", "Platens/Top/Seat friction arm"
NRMCA, ACI = "NRMCA publication 179", "ACI frequently asked question 828"


def ends(form, height, *further):
    return [f"Specimen/Ends = {form}", f"Specimen/End height = {height} mm", *further]


def caps(layers):
    return ["Platens/Kind = deformable", "Platens/Motion = quasi-static", f"Platens/Layers = {layers}"]


# name: entries, over which case, change that a laboratory states in % and what it says of it
CASES = {
    "perfect": ([], None, None, ""),
    "on a seat": ([SEAT], "perfect", None, ""),
    "eccentric by 2.5 mm": ([SEAT, "Platens/Top/Eccentricity = 2.5 mm"], "on a seat", -12, f"eccentricity not stated, {NRMCA}"),
    "eccentric by 5 mm": ([SEAT, "Platens/Top/Eccentricity = 5 mm"], "on a seat", -12, f"eccentricity not stated, {NRMCA}"),
    "platen tilted by 0.5 degree": (["Platens/Top/Tilt = 0.5 degree"], "perfect", -8, f"ends not perpendicular, angle not stated, {NRMCA}"),
    "ends not parallel by 0.05 mm": (ends("not parallel", 0.05), "perfect", -8, f"angle not stated, {NRMCA}"),
    "ends not parallel by 0.1 mm": (ends("not parallel", 0.1), "perfect", -8, f"angle not stated, {NRMCA}"),
    "ends not parallel by 0.5 mm": (ends("not parallel", 0.5), "perfect", -8, f"ends not perpendicular, angle not stated, {NRMCA}"),
    "the same on a seat": (ends("not parallel", 0.5, SEAT), "on a seat", None, ""),
    "the same, a seat of friction arm 10 mm": (ends("not parallel", 0.5, SEAT, f"{ARM} = 10 mm"), "perfect", None, ""),
    "convex by 0.083 mm": (ends("convex", 0.083), "perfect", -25, f"0.25 mm of 150 mm, {ACI}; -12, height not stated, {NRMCA}"),
    "convex by 0.25 mm": (ends("convex", 0.25), "perfect", None, ""),
    "both ends convex by 0.25 mm": (ends("convex", 0.25, "Specimen/End faces = both"), "perfect", None, ""),
    "concave by 0.25 mm": (ends("concave", 0.25), "perfect", None, ""),
    "between elastic steel": (caps("platen 10 mm"), "perfect", None, ""),
    "capped by gypsum, 1 mm": (caps("gypsum 1 mm, platen 10 mm"), "between elastic steel", -2, "sulphur caps under ground ends, 45 MPa, NISTIR 5405"),
    "capped by gypsum, 2.7 mm": (caps("gypsum 2.7 mm, platen 10 mm"), "capped by gypsum, 1 mm", -6, f"thick cap, thickness not stated, {NRMCA}"),
    "capped by gypsum, 8 mm": (caps("gypsum 8 mm, platen 10 mm"), "capped by gypsum, 1 mm", -6, f"thick cap, thickness not stated, {NRMCA}"),
    "both ends rough by 0.5 mm": (ends("rough", 0.5, "Specimen/End faces = both"), "perfect", -27, f"before capping, {NRMCA}"),
}


def run(build, folder, scene, name, seed):
    target = folder / f"{name.replace(' ', '_')}_{seed}"
    if not (target / "summary.json").exists():
        entries = [*CASES[name][0], f"Scene/Seed = {seed}", "Output/Fields = off", "Loading/Target strain = 0.016", "Loading/Stop at residual = 0.7"]
        command = [build / "apps/platen-compress", scene, "-o", target, "--overwrite", "--quiet", "-t", "1"]
        subprocess.run([*map(str, command), *(part for entry in entries for part in ("-s", entry))], check=False, stderr=subprocess.DEVNULL)


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    build, folder = map(pathlib.Path, sys.argv[1:3])
    scene = pathlib.Path(sys.argv[3]) if len(sys.argv) == 4 else ROOT / "scenes/facet_dry.prm"
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        list(pool.map(lambda case: run(build, folder, scene, *case), [(name, seed) for seed in SEEDS for name in CASES]))
    runs = {name: [platen.Run(folder / f"{name.replace(' ', '_')}_{seed}").summary for seed in SEEDS] for name in CASES}
    print("| case | strength, MPa | over | change, % | laboratory, % | strain at the peak, 1e-3 | E, GPa | energy residual, % | patterns |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for name, (_, over, stated, said) in CASES.items():
        strengths = [s["strength_pa"] / 1e6 for s in runs[name]]
        changes = [100 * (s["strength_pa"] / other["strength_pa"] - 1) for s, other in zip(runs[name], runs[over])] if over else []
        mean = lambda values, digits: f"{statistics.mean(values):.{digits}f} +- {statistics.stdev(values):.{digits}f}"
        patterns = sorted({s["pattern"]: 0 for s in runs[name]})
        print(f"| {name} | {mean(strengths, 1)} | {over or '-'} | {mean(changes, 1) if changes else '-'} | {f'{stated}: {said}' if stated else '-'} | "
              f"{mean([1e3 * s['strain_at_peak_platen'] for s in runs[name]], 2)} | "
              f"{statistics.mean(s['youngs_modulus_gauge_pa'] for s in runs[name]) / 1e9:.1f} | "
              f"{100 * max(s['energy_residual_relative'] for s in runs[name]):.1g} | {', '.join(patterns)} |")


if __name__ == "__main__":
    main()
