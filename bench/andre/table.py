#!/usr/bin/env python3
"""Tables 3 and 4, moduli of the bulk, and figures 12, 19, 20 and 21 of the runs that run.sh made, as CSV.
Usage: table.py FOLDER"""
import pathlib
import statistics
import sys

from runs import figure, platen, summaries, text, write

folder = pathlib.Path(sys.argv[1])

# figure, its path in summary.json, published (andre et al. 2012, tables 1, 3 and 4; errors in percent)
ERRORS = [
    ("static tension", "tension/static_error", 1.20),
    ("static bending, bounding section", "bending/static_error", 4.16),
    ("static bending, effective section", "bending/static_error_effective", None),
    ("static torsion, bounding section", "torsion/static_error", 6.13),
    ("static torsion, effective section", "torsion/static_error_effective", None),
    ("dynamic tension", "tension/dynamic_error", 0.38),
    ("dynamic bending, bounding section", "bending/dynamic_error", 6.63),
    ("dynamic bending, effective section", "bending/dynamic_error_effective", 1.8),
    ("dynamic torsion, bounding section", "torsion/dynamic_error", 0.50),
    ("dynamic torsion, effective section", "torsion/dynamic_error_effective", None),
    ("wave", "impact/wave_error", 0.40),
]
bars, bulks = summaries(folder, "bar_*"), summaries(folder, "bulk_10000_*")
rows, runs = [], []
for label, path, published in ERRORS:
    values = [100 * v for v in (figure(s, path) for s in bars.values()) if v is not None]
    if values:
        sizes = [abs(v) for v in values]
        rows.append([label, "%", published if published is not None else "", f"{statistics.median(sizes):.2f}",
                     f"{statistics.median(values):+.2f}", f"{min(values):+.2f}", f"{max(values):+.2f}"])
for label, path, unit, factor, published in [("bulk modulus of elasticity", "bulk/youngs_modulus_pa", "GPa", 1e-9, 72.5),
                                             ("bulk Poisson ratio", "bulk/poisson_ratio", "1", 1, 0.17)]:
    values = [factor * figure(s, path) for s in bulks.values() if figure(s, path) is not None]
    if values:
        rows.append([label, unit, published, f"{statistics.median(values):.4g}", "", f"{min(values):.4g}", f"{max(values):.4g}"])
write(folder / "tables.csv", ["figure", "unit", "published", "median", "median_signed", "least", "most"], rows)

COLUMNS = ["particles", "bonds", "packing_fraction", "density_kg_m3", "bounding_radius_m", "effective_radius_m",
           "youngs_modulus_gauge_pa", "youngs_modulus_effective_pa", "poisson_ratio", "bulk/youngs_modulus_pa",
           "bulk/poisson_ratio"] + [path for _, path, _ in ERRORS] + ["impact/wave_speed_m_s", "wall_seconds"]
for name, summary in list(bars.items()) + list(bulks.items()):
    runs.append([name] + [figure(summary, c) if figure(summary, c) is not None else "" for c in COLUMNS])
write(folder / "runs.csv", ["run"] + COLUMNS, runs)

# Figure 12: shares of the energy at rest.
shares = ["axial_energy_share", "bending_energy_share", "torsion_energy_share"]
write(folder / "energy_static.csv", ["run", "load"] + shares,
      [[name, load] + [s[load][k] for k in shares] for name, s in bars.items()
       for load in ("tension", "bending", "torsion") if load in s])

# Figures 19, 20 and 21, of the first seed.
if bars:
    history = platen.Run(folder / next(iter(bars))).history.records()
    energy = ["load", "time_s", "kinetic_energy_j", "axial_energy_j", "bending_energy_j", "torsion_energy_j"]
    write(folder / "energy_dynamic.csv", energy, [[text(r[k]) for k in energy] for r in history])
    wave = ["time_s", "end_velocity_m_s", "far_end_velocity_m_s", "quarter_z_m", "half_z_m"]
    write(folder / "wave.csv", wave, [[text(r[k]) for k in wave] for r in history if r["load"] == "impact"])
print((folder / "tables.csv").read_text(), end="")
