#!/usr/bin/env python3
"""The runs of run.sh as a table: mean over the seeds, and in brackets their number where there are several.
Usage: table.py FOLDER"""
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import platen

PACKINGS = {"front": "front in its own mould", "core": "core of a larger front", "jammed": "grown until it jams"}
STIFFNESSES = {"thesis": "thesis", "bond": "that of the bond"}
KEYS = (("packing_fraction", 1, "{:.3f}"), ("coordination_number", 1, "{:.2f}"), ("youngs_modulus_gauge_pa", 1e-9, "{:.0f}"),
        ("strength_pa", 1e-6, "{:.0f}"), ("strain_at_peak_platen", 1e3, "{:.2f}"))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    print("| packing | unbonded stiffness | spheres over volume | neighbours | modulus, GPa | strength, MPa | strain at peak, mm/m |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for packing, name in PACKINGS.items():
        for stiffness, of in STIFFNESSES.items():
            found = platen.runs(sys.argv[1], f"{packing}_{stiffness}_*").values()
            runs = [run.summary for run in found if run.status == "done"]
            if not runs:
                continue
            cells = [text.format(factor * statistics.mean(run[key] for run in runs)) for key, factor, text in KEYS]
            seeds = f" ({len(runs)} seeds)" if len(runs) > 1 else ""
            print(f"| {name}{seeds} | {of} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
