#!/usr/bin/env python3
"""Every pair of stage kinds on one specimen in a cell, after a consolidation: what is told of the peak, beside what
tests bear that are driven to failure at one pressure.

Usage: bench/stages/pairs.py BUILD/apps/platen-compress SCENE FOLDER [SECTION/KEY=VALUE ...] [--stress 25 ...]
Finished runs are skipped. The table of every pair goes to the screen."""
import argparse
import csv
import json
import subprocess
from pathlib import Path

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("program")
parser.add_argument("scene")
parser.add_argument("folder", type=Path)
parser.add_argument("entries", nargs="*")
parser.add_argument("--stress", type=float, default=25, help="MPa, at which the first stage ends")
parser.add_argument("--pressure", type=float, default=2, help="MPa, of the cell")
parser.add_argument("--rate", type=float, default=2, help="1/s, circumferential")
parser.add_argument("--time", type=float, default=100, help="us, of stages without another end")
parser.add_argument("--first", help="only pairs that begin with this kind")
o = parser.parse_args()
s, p, t = o.stress, o.pressure, o.time
KINDS = {
    "drive": (["Axial = rate", f"Until = Axial stress {s} MPa"], ["Axial = rate", "Until = strain 4 %"]),
    "stress": ([f"Axial = stress {s} MPa", "Until = settled"], [f"Axial = stress {0.4 * s:g} MPa", "Until = settled"]),
    "more stress": ([f"Axial = stress {0.8 * s:g} MPa", "Until = settled"],
                    [f"Axial = stress {8 * s:g} MPa", f"Ramp = {10 * t} us", f"Until = strain 4 %, time {15 * t} us"]),
    "pressure": ([f"Lateral = pressure {3 * p:g} MPa", "Until = settled"], [f"Lateral = pressure {p / 4:g} MPa", "Until = settled"]),
    "more pressure": ([f"Lateral = pressure {4.5 * p:g} MPa", "Until = settled"], [f"Lateral = pressure {6 * p:g} MPa", "Until = settled"]),
    "circumference": ([f"Axial = circumferential rate {o.rate} 1/s", f"Until = Axial stress {s} MPa"],
                      [f"Axial = circumferential rate {o.rate} 1/s", "Until = circumferential strain 3 %, strain 4 %"]),
    "hold": (["Axial = hold", f"Until = time {t / 2} us"], ["Axial = hold", f"Until = time {t} us"]),
    "unload": (["Axial = unload", f"Until = time {t / 5} us"], ["Axial = unload", f"Until = share of start 0.3, time {0.6 * t} us"]),
    "share": (["Lateral = share of Axial 0.5", f"Until = time {t} us"], ["Lateral = share of Axial 0.05", f"Until = time {t} us"]),
}


def run(name, stages, pressure=p):
    folder = o.folder / name.replace(" ", "_").replace(",", "")
    entries = ["Loading/Confinement = particles", "Loading/Stop at residual = 0.5", "Output/Fields = off", "Checkpoint/Every = 0", *o.entries,
               f"Loading/Stage 1/Lateral = pressure {pressure} MPa",
               f"Loading/Stage 1/Top = stress {pressure} MPa", "Loading/Stage 1/Until = settled"]
    entries += [f"Loading/Stage {k + 2}/{entry}" for k, stage in enumerate(stages) for entry in stage]
    if not (folder / "summary.json").exists():
        made = subprocess.run([o.program, o.scene, "-o", folder, "--quiet", "--overwrite", "-t", "1", *(a for e in entries for a in ("-s", e))],
                              capture_output=True, text=True)
        if made.returncode not in (0, 1):
            return None, made.stderr.strip().splitlines()[-1]
    return json.loads((folder / "summary.json").read_text()), list(csv.DictReader((folder / "history.csv").open()))


def mpa(value):
    return "-" if value is None else f"{value / 1e6:.2f}"


def told(name, found):
    summary, rows = found
    if summary is None:
        print(f"| {name} | {rows} |", flush=True)
        return
    column = max((float(r["axial_stress_top_pa"]) + float(r["axial_stress_bottom_pa"])) / 2 for r in rows)
    said = summary["validity"]["strength_pa"]
    print(f"| {name} | {mpa(summary['strength_pa'])} | {mpa(summary['deviator_strength_pa'])} | {mpa(summary['confining_pressure_pa'])} | "
          f"{mpa(summary['largest_stress_pa'])} | {column / 1e6:.2f} | {said if isinstance(said, str) else said[0][:100]} |", flush=True)


print("| pair | strength | deviator | pressure | largest_stress_pa | of history.csv | validity of the strength |")
print("| --- | --- | --- | --- | --- | --- | --- |")
for pressure in (p / 4, p, 3 * p, 4.5 * p, 6 * p):
    stages = [["Axial = rate", "Until = strain 4 %"]]
    told(f"driven at {pressure:g} MPa", run(f"driven {pressure:g}", stages, pressure))
for first, (one, _) in KINDS.items():
    if o.first and first != o.first:
        continue
    for second, (_, two) in KINDS.items():
        told(f"{first}, {second}", run(f"{first}, {second}", [one, two]))
