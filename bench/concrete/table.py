#!/usr/bin/env python3
"""Tables of the runs that run.sh made: one row a run, then means, scatter and ratios. Usage: table.py FOLDER"""
import json
import pathlib
import statistics
import sys

folder = pathlib.Path(sys.argv[1])
runs = {}
for path in sorted(folder.glob("*/summary.json")):
    runs[path.parent.name] = json.loads(path.read_text())

COLUMNS = [
    ("strength", "strength_pa", 1e-6, "%.2f"), ("strain", "strain_at_peak_platen", 1e3, "%.2f"),
    ("E", "youngs_modulus_gauge_pa", 1e-9, "%.1f"), ("nu", "poisson_ratio", 1, "%.3f"),
    ("top", "end_damage_top", 1, "%.2f"), ("bottom", "end_damage_bottom", 1, "%.2f"),
    ("middle", "middle_damage", 1, "%.2f"), ("spread", "end_spread", 1, "%.2f"),
    ("barrel", "barrel_at_peak", 1, "%.2f"), ("residual", "energy_residual_relative", 1, "%.1e"),
    ("kinetic", "kinetic_to_internal_max", 1, "%.1e"), ("crossings", "wave_crossings_to_peak", 1, "%.0f"),
    ("seconds", "wall_seconds", 1, "%.0f")]


def text(run, key, factor, form):
    value = run.get(key)
    return "-" if value is None else form % (factor * value)


print("strength MPa, strain at peak mm/m (platens), E GPa (gauge); damage and spread at 0.8 of the peak")
print("| run | " + " | ".join(c[0] for c in COLUMNS) + " |")
print("|---" * (len(COLUMNS) + 1) + "|")
for name, run in runs.items():
    print("| " + name + " | " + " | ".join(text(run, *c[1:]) for c in COLUMNS) + " |")


def values(prefix, key="strength_pa"):
    found = {n[len(prefix) + 1:]: r[key] for n, r in runs.items() if n.startswith(prefix + "_") and r.get(key) is not None}
    return {seed: v for seed, v in found.items() if seed.isdigit()}


def mean(prefix, key, factor, form):
    v = [factor * x for x in values(prefix, key).values()]
    if not v:
        return
    spread = statistics.stdev(v) if len(v) > 1 else float("nan")
    print(("%-28s %-26s " + form + " +- " + form + " (%d seeds)") % (prefix, key, statistics.mean(v), spread, len(v)))


def ratio(what, above, below):
    a, b = values(above), values(below)
    seeds = sorted(set(a) & set(b))
    if not seeds:
        return
    r = [a[s] / b[s] for s in seeds]
    spread = statistics.stdev(r) if len(r) > 1 else float("nan")
    print("%-44s %.3f +- %.3f (%d seeds)" % (what, statistics.mean(r), spread, len(r)))


print()
for prefix in ["concrete_dry", "concrete_lubricated", "concrete_tension", "cube_dry", "cube_lubricated", "prism_dry",
               "prism_lubricated", "friction_0.1", "friction_0.3", "friction_1", "layer_dry", "layer_lubricated",
               "half_rate"]:
    mean(prefix, "strength_pa", 1e-6, "%.2f")
for key, factor, form in [("strain_at_peak_platen", 1e3, "%.3f"), ("strain_at_peak_gauge", 1e3, "%.3f"),
                          ("youngs_modulus_gauge_pa", 1e-9, "%.2f"), ("poisson_ratio", 1, "%.4f")]:
    mean("concrete_dry", key, factor, form)
print()
ratio("compressive over tensile", "concrete_dry", "concrete_tension")
ratio("dry over lubricated, h/d 2", "concrete_dry", "concrete_lubricated")
ratio("dry over lubricated, h/d 2.4", "prism_dry", "prism_lubricated")
ratio("dry over lubricated, h/d 1", "cube_dry", "cube_lubricated")
ratio("cube over prism, dry", "cube_dry", "prism_dry")
ratio("cube over prism, lubricated", "cube_lubricated", "prism_lubricated")
ratio("friction 0.1 over 0.57", "friction_0.1", "concrete_dry")
ratio("friction 0.3 over 0.57", "friction_0.3", "concrete_dry")
ratio("friction 1 over 0.57", "friction_1", "concrete_dry")
ratio("end layer 0.6 over 0.3, dry", "layer_dry", "concrete_dry")
ratio("end layer 0.6 over 0.3, lubricated", "layer_lubricated", "concrete_lubricated")
ratio("half the rate over the rate", "half_rate", "concrete_dry")
