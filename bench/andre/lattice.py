#!/usr/bin/env python3
"""The ordered packing beside the random ones: 4000 equal spheres, face-centred cubic, in the cube of 41 mm of
scenes/silica_bulk.prm. Usage: lattice.py FILE.csv"""
import math
import sys

WIDTH, LAYERS = 0.041, 20  # m; of half a cell each
radius = WIDTH / ((LAYERS - 1) * math.sqrt(2) + 2)
step = math.sqrt(2) * radius  # half a cell: spheres touch along the diagonals of its faces
with open(sys.argv[1], "w") as file:
    file.write(f"# shape: box width_x_m={WIDTH} width_y_m={WIDTH} height_m={WIDTH}\nx_m,y_m,z_m,radius_m\n")
    for i in range(LAYERS):
        for j in range(LAYERS):
            for k in range((i + j) % 2, LAYERS, 2):
                x, y, z = (radius + step * n for n in (i, j, k))
                file.write(f"{x - WIDTH / 2},{y - WIDTH / 2},{z},{radius}\n")
