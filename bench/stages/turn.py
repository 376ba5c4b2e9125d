"""Turns a box specimen (specimen.csv) by a quarter about an axis, or in a cycle.

Usage: turn.py FROM none|x|y|z|cycle TO. The cycle puts what lies along z along x, x along y, y along z.
Only boxes with three equal sides are turned: the others would not fit between the same platens.
"""
import sys

source, turn, target = sys.argv[1:]
with open(source) as file:
    shape, header, *rows = file.read().splitlines()
sides = dict(word.split("=") for word in shape.split()[3:])
edge = float(sides["height_m"])
if not shape.startswith("# shape: box") or any(float(side) != edge for side in sides.values()):
    sys.exit(f"turn.py: {source}: not a cube")

# Of a point from the middle of the cube: where it comes to lie.
turned = {
    "none": lambda x, y, z: (x, y, z),
    "x": lambda x, y, z: (x, -z, y),
    "y": lambda x, y, z: (z, y, -x),
    "z": lambda x, y, z: (-y, x, z),
    "cycle": lambda x, y, z: (z, x, y),
}[turn]
with open(target, "w") as file:
    file.write(shape + "\n" + header + "\n")
    for row in rows:
        x, y, z, radius = row.split(",")
        x, y, z = turned(float(x), float(y), float(z) - 0.5 * edge)
        file.write(f"{x!r},{y!r},{z + 0.5 * edge!r},{radius}\n")
