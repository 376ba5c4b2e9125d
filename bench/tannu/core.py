#!/usr/bin/env python3
"""The spheres of a packing that lie wholly in an upright cylinder about its middle, as specimen.csv on the screen.
Usage: core.py SPECIMEN.CSV RADIUS HEIGHT, in m."""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import platen

if len(sys.argv) != 4:
    sys.exit(__doc__)
radius, height = float(sys.argv[2]), float(sys.argv[3])
spheres = list(zip(*(column.tolist() for column in platen.read_table(sys.argv[1]).values())))
heights = [z for _, _, z, _ in spheres]
middle = 0.5 * (max(heights) + min(heights))
print(f"# shape: cylinder radius_m={radius!r} height_m={height!r}\nx_m,y_m,z_m,radius_m")
for x, y, z, r in spheres:
    if math.hypot(x, y) + r <= radius and abs(z - middle) + r <= 0.5 * height:
        print(f"{x!r},{y!r},{z - middle + 0.5 * height!r},{r!r}")
