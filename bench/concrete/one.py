"""Table of one concrete in every test, beside laboratories. Usage: one.py FOLDER"""
import csv
import json
import pathlib
import statistics
import sys

folder = pathlib.Path(sys.argv[1])
seeds = sorted({int(path.name.rsplit("_", 1)[1]) for path in folder.glob("dry_*") if path.is_dir()})


def summary(name):
    path = folder / name / "summary.json"
    found = json.loads(path.read_text()) if path.exists() else {}
    return found if found.get("status") == "done" else None


def of_seeds(name, key, scale=1.0):
    """Of each seed whose run has it."""
    found = {}
    for seed in seeds:
        s = summary(f"{name}_{seed}")
        if s and s.get(key) is not None:
            found[seed] = scale * s[key]
    return found


def ratio(one, other):
    """Seed by seed: a packing beside itself."""
    return {seed: one[seed] / other[seed] for seed in one if seed in other}


def last_over_peak(name, factor):
    """Stress less pressure at so many times the strain at peak, over the largest; None where the run ends before."""
    found = {}
    for seed in seeds:
        s, path = summary(f"{name}_{seed}"), folder / f"{name}_{seed}" / "history.csv"
        if not s:
            continue
        with open(path) as file:
            rows = [{k: float(v) if v else 0.0 for k, v in row.items()} for row in csv.DictReader(file)]
        # Strains count from the end of consolidation: the first row whose deviator rises for good.
        deviator = [row["deviator_pa"] for row in rows]
        peak = max(range(len(rows)), key=deviator.__getitem__)
        start = rows[peak]["axial_strain_platen"] - s["strain_at_peak_platen"]
        wanted = start + (s["strain_at_peak_platen"] * factor if factor else 0.0345)
        later = [d for row, d in zip(rows[peak:], deviator[peak:]) if row["axial_strain_platen"] >= wanted]
        if later:
            found[seed] = later[0] / deviator[peak]
    return found


def mander(fc, p):
    """MPa, strength of confined concrete (Mander, Priestley and Park 1988)."""
    return fc * (-1.254 + 2.254 * (1 + 7.94 * p / fc) ** 0.5 - 2 * p / fc)


def newman(fc, p):
    """MPa, EN 1998-3 (Newman)."""
    return fc * (1 + 3.7 * (p / fc) ** 0.86)


def row(what, values, low=None, high=None, laboratory=""):
    values = list(values.values())
    if not values:
        print(f"| {what} | - | {band(low, high)} | {laboratory} | not run |")
        return
    mean = statistics.mean(values)
    scatter = f" +- {statistics.stdev(values):.3g}" if len(values) > 1 else ""
    inside = "stated" if low is None and high is None else \
        "within" if (low is None or mean >= low) and (high is None or mean <= high) else "**outside**"
    print(f"| {what} | {mean:.3g}{scatter} ({len(values)}) | {band(low, high)} | {laboratory} | {inside} |")


def band(low, high):
    if low is None and high is None:
        return "-"
    return f"{'' if low is None else f'{low:.3g}'} ... {'' if high is None else f'{high:.3g}'}"


mpa, gpa = 1e-6, 1e-9
dry, lub = of_seeds("dry", "strength_pa", mpa), of_seeds("lub", "strength_pa", mpa)
cube, cube_lub = of_seeds("cube_dry", "strength_pa", mpa), of_seeds("cube_lub", "strength_pa", mpa)
prism, prism_lub = of_seeds("prism_dry", "strength_pa", mpa), of_seeds("prism_lub", "strength_pa", mpa)
print("| | mean +- scatter (packings) | band | laboratory | |\n| --- | --- | --- | --- | --- |")
row("E, GPa", of_seeds("dry", "youngs_modulus_gauge_pa", gpa), 20, 30)
row("Poisson's ratio", of_seeds("dry", "poisson_ratio"), 0.15, 0.22)
row("strength, dry, MPa", dry, 35, 50)
row("strain at peak, 1e-3", of_seeds("dry", "strain_at_peak_platen", 1e3), 2, 4)
row("strength, greased, MPa", lub)
row("compressive over direct tensile strength", ratio(dry, of_seeds("tension", "strength_pa", mpa)), 8, 12)
row("cube, dry over greased", ratio(cube, cube_lub), 1.21, 1.59, "1.42, Hughes and Bahramian 1967")
row("prism, dry over greased", ratio(prism, prism_lub), 1.03, 1.11, "1.08, the same")
row("cube over prism, dry", ratio(cube, prism), 1.21, 1.47, "1.37, the same")
row("cube over prism, greased", ratio(cube_lub, prism_lub), 1.00, 1.10, "1.04, the same")
row("height over width .5 over 2, dry", ratio(of_seeds("flat", "strength_pa", mpa), dry), 1.5, 2.2)
coarse = of_seeds("coarse", "strength_pa", mpa)
for pressure in ("1.5", "3", "4.5", "9", "30"):
    p = float(pressure)
    strength = of_seeds(f"tri_{pressure}", "strength_pa", mpa)
    k = {seed: (strength[seed] - coarse[seed]) / p for seed in strength if seed in coarse}
    fc = statistics.mean(coarse.values()) if coarse else 43
    lines = sorted((f(fc, p) - fc) / p for f in (mander, newman))
    row(f"(strength - fc)/p at {pressure} MPa", k, 0.85 * lines[0], 1.15 * lines[1],
        f"{lines[0]:.1f} ... {lines[1]:.1f}, Mander 1988, EN 1998-3")
row("strain at peak at 9 MPa, 1e-3", of_seeds("tri_9", "strain_at_peak_platen", 1e3), laboratory="authors differ: 2.6 to 6.3 times the unconfined one")
row("last over peak at 9 MPa, at 1.45 times the strain at peak", last_over_peak("tri_9", 1.45))
row("last over peak at 30 MPa, at 3.45e-2", last_over_peak("tri_30", None), 0.9)
row("worse end damage, dry", {s: max(summary(f"dry_{s}")["end_damage_top"], summary(f"dry_{s}")["end_damage_bottom"]) for s in dry}, None, 0.3)
row("middle damage, dry", of_seeds("dry", "middle_damage"), 0.5)
row("worse end damage, greased", {s: max(summary(f"lub_{s}")["end_damage_top"], summary(f"lub_{s}")["end_damage_bottom"]) for s in lub}, 0.4)
names = ("dry", "lub", "tension", "cube_dry", "cube_lub", "prism_dry", "prism_lub", "flat", "coarse", "tri_1.5", "tri_3", "tri_4.5", "tri_9", "tri_30")
row("largest energy residual of all runs", {0: max((v for n in names for v in of_seeds(n, "energy_residual_relative").values()), default=float("nan"))}, None, 0.01)
