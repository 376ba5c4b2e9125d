#!/usr/bin/env python3
"""Specimens for measurements, as specimen.csv on the screen.

    specimen.py turn none|x|y|z|cycle CUBE.csv     a cube turned by a quarter about an axis; the cycle puts what lies along z along x, x along y, y
                                                   along z. Only boxes with three equal sides are turned: others would not fit between the same platens
    specimen.py core RADIUS HEIGHT PACKING.csv     the spheres that lie wholly in an upright cylinder (m) about the middle of a packing
    specimen.py lattice WIDTH LAYERS               equal spheres, face-centred cubic, in a cube (m), so many layers of half a cell
"""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "python"))
import platen

TURNS = {  # of a point from the middle of the cube: where it comes to lie
    "none": lambda x, y, z: (x, y, z), "x": lambda x, y, z: (x, -z, y), "y": lambda x, y, z: (z, y, -x),
    "z": lambda x, y, z: (-y, x, z), "cycle": lambda x, y, z: (z, x, y)}


def spheres(path):
    return list(zip(*(column.tolist() for column in platen.read_table(path).values())))


def turn(which, path):
    shape = pathlib.Path(path).read_text().split("\n", 1)[0]
    sides = {word.split("=")[1] for word in shape.split()[3:]}
    if not shape.startswith("# shape: box") or len(sides) > 1:
        sys.exit(f"specimen.py: {path}: not a cube")
    half = 0.5 * float(sides.pop())
    turned = ((*TURNS[which](x, y, z - half), r) for x, y, z, r in spheres(path))
    return shape, ((x, y, z + half, r) for x, y, z, r in turned)


def core(radius, height, path):
    radius, height, all_of_them = float(radius), float(height), spheres(path)
    heights = [z for _, _, z, _ in all_of_them]
    middle = 0.5 * (max(heights) + min(heights))
    return f"# shape: cylinder radius_m={radius!r} height_m={height!r}", (
        (x, y, z - middle + 0.5 * height, r) for x, y, z, r in all_of_them
        if math.hypot(x, y) + r <= radius and abs(z - middle) + r <= 0.5 * height)


def lattice(width, layers):
    width, layers = float(width), int(layers)
    radius = width / ((layers - 1) * math.sqrt(2) + 2)
    step = math.sqrt(2) * radius  # half a cell: spheres touch along the diagonals of its faces
    at = [radius + step * k for k in range(layers)]
    return f"# shape: box width_x_m={width} width_y_m={width} height_m={width}", (
        (at[i] - width / 2, at[j] - width / 2, at[k], radius)
        for i in range(layers) for j in range(layers) for k in range((i + j) % 2, layers, 2))


if __name__ == "__main__":
    made = {"turn": (turn, 2), "core": (core, 3), "lattice": (lattice, 2)}.get(" ".join(sys.argv[1:2]))
    if made is None or len(sys.argv) != 2 + made[1]:
        sys.exit(__doc__)
    shape, rows = made[0](*sys.argv[2:])
    print(shape + "\nx_m,y_m,z_m,radius_m")
    for row in rows:
        print(",".join(map(repr, row)))
