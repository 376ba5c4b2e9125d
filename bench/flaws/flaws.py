#!/usr/bin/env python3
"""Strength in tension over the radius of a penny crack in the middle of a cylinder, beside linear fracture mechanics.

    bench/flaws/flaws.py BUILD FOLDER   runs what FOLDER lacks, one after the other on one core, then prints the table

A crack of radius a in a bar of radius b: K = stress sqrt(pi a) G(a/b) (Benthem and Koiter 1973, fitted by Tada, Paris and Irwin).
Strength times G is then that in an endless solid, which falls with a to the power -1/2.
"""
import math
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import platen

BAR, HEIGHT, SPHERE = 50, 112.5, 1.25  # mm: radius, height, radius of the spheres
RADII = (10, 14, 20)  # of the crack, in those of the spheres


def run(build, folder, name, entries):
    target = folder / name
    if not (target / "summary.json").exists():
        command = [build / "apps/platen-compress", ROOT / "bench/flaws/flaws.prm", "-o", target, "--overwrite", "--quiet", "-t", "1"]
        subprocess.run([*map(str, command), *(part for entry in ["Output/Fields = off", *entries] for part in ("-s", entry))], check=True)
    return platen.Run(target).summary


def crack(radius):
    return [f"Specimen/Flaw 1 = disc at 0, 0, {HEIGHT / 2} mm normal 0, 0, 1 radius {radius * SPHERE} mm cut"]


def shape(part):
    """G of a crack that takes this part of the bar's radius."""
    return 2 / math.pi * (1 - 0.5 * part + 0.148 * part**3) / math.sqrt(1 - part)


def slope(x, y):
    """Of the line through the points, by least squares."""
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / sum((a - mean_x) ** 2 for a in x)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    build, folder = map(pathlib.Path, sys.argv[1:])
    whole = run(build, folder, "whole", [])
    runs = {radius: run(build, folder, f"crack_{radius}", crack(radius)) for radius in RADII}
    endless = {radius: s["strength_pa"] * shape(radius * SPHERE / BAR) / shape(0) for radius, s in runs.items()}
    print("| crack radius, sphere radii | strength, MPa | in an endless solid, MPa | K at failure, MPa sqrt(m) | E, GPa | seconds |")
    print("| --- | --- | --- | --- | --- | --- |")
    print(f"| none | {whole['strength_pa'] / 1e6:.2f} | - | - | {whole['youngs_modulus_gauge_pa'] / 1e9:.1f} | {whole['wall_seconds']:.0f} |")
    for radius, s in runs.items():
        toughness = endless[radius] * shape(0) * math.sqrt(math.pi * radius * SPHERE * 1e-3)
        modulus = s["youngs_modulus_gauge_pa"]
        print(f"| {radius} | {s['strength_pa'] / 1e6:.2f} | {endless[radius] / 1e6:.2f} | {toughness / 1e6:.3f} | "
              f"{f'{modulus / 1e9:.1f}' if modulus else '-'} | {s['wall_seconds']:.0f} |")
    power = slope([math.log(radius) for radius in runs], [math.log(endless[radius]) for radius in runs])
    print(f"\nThe strength falls with the radius to the power {power:.3f}.")


if __name__ == "__main__":
    main()
