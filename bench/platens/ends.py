#!/usr/bin/env python3
"""Of runs of scenes/elastic_platens.prm: load of the spheres on the lower platen in five rings of equal area over their mean, in the frame nearest
to a closure of 0.1 %, and where the first 50 cracks are: mm from the nearer end, and the share of them within 15 mm of it.
Usage: ends.py RUN ..."""
import pathlib
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import platen

HEIGHT, RADIUS, RINGS = 0.1, 0.025, 5  # m, m, of the specimen
print("| run |" + "".join(f" ring {k + 1} |" for k in range(RINGS)) + " first cracks, mm | within 15 mm |\n|" + " --- |" * (RINGS + 3))
for run in map(platen.Run, sys.argv[1:]):
    frame = run.contacts.at(run.history["time_s"][run.history["axial_strain_platen"] >= 0.001][0])
    below = frame.points[:, 2] <= 0.5 * HEIGHT
    share = numpy.minimum(0.999, (frame.points[below, :2] ** 2).sum(axis=1) / RADIUS**2)
    load = numpy.bincount((RINGS * share).astype(int), frame.point_data["normal_force"][below], RINGS)
    ends = numpy.minimum(run.cracks["z_m"], HEIGHT - run.cracks["z_m"])[:50]
    print(f"| {run.folder.name} |" + "".join(f" {one:.3f} |" for one in load / load.mean()) + f" {1e3 * ends.mean():.0f} | {(ends < 0.015).mean():.0%} |")
