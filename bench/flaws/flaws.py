#!/usr/bin/env python3
"""Strength in tension over the radius of a penny crack in the middle of a cylinder, beside linear fracture mechanics.

    bench/flaws/flaws.py BUILD FOLDER   runs what FOLDER lacks, one after the other on one core, then prints the table

A crack of radius a in a bar of radius b: K = stress sqrt(pi a) G(a/b) (Benthem and Koiter 1973, fitted by Tada, Paris and Irwin; within .5 %
of finite elements, which tests compare). Strength times G over 2/pi is then that in an endless solid, which falls with a to the power -1/2.
The bar is not long, and its glued ends do not widen: its own G is from finite elements, penny.py.
"""
import math
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import penny
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
    """G of a crack that takes this part of a long bar's radius; the fit is of the stress over what the crack leaves of the section."""
    of_net_stress = 2 / math.pi * (1 + part / 2 - 5 / 8 * part**2 + 0.421 * part**3) * math.sqrt(1 - part)
    return of_net_stress / (1 - part**2)


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
    shapes = {
        "in a long bar": {radius: shape(radius * SPHERE / BAR) for radius in RADII},
        "in this bar": {radius: penny.factor(radius * SPHERE / BAR, HEIGHT / 2 / BAR, glued=True) for radius in RADII},
    }
    print("| crack radius, sphere radii | strength, MPa | K at failure by G in a long bar, MPa sqrt(m) | in this bar | E, GPa | seconds |")
    print("| --- | --- | --- | --- | --- | --- |")
    print(f"| none | {whole['strength_pa'] / 1e6:.2f} | - | - | {whole['youngs_modulus_gauge_pa'] / 1e9:.1f} | {whole['wall_seconds']:.0f} |")
    for radius, s in runs.items():
        toughness = [s["strength_pa"] * factors[radius] * math.sqrt(math.pi * radius * SPHERE * 1e-3) / 1e6 for factors in shapes.values()]
        modulus = s["youngs_modulus_gauge_pa"]
        print(f"| {radius} | {s['strength_pa'] / 1e6:.2f} | {toughness[0]:.3f} | {toughness[1]:.3f} | "
              f"{f'{modulus / 1e9:.1f}' if modulus else '-'} | {s['wall_seconds']:.0f} |")
    for name, factors in shapes.items():
        power = slope([math.log(radius) for radius in runs], [math.log(s["strength_pa"] * factors[radius]) for radius, s in runs.items()])
        print(f"\nThe strength in an endless solid, by G {name}, falls with the radius to the power {power:.3f}.")


if __name__ == "__main__":
    main()
