#!/usr/bin/env python3
"""Limit of elasticity in uniaxial strain: where axial less lateral stress leaves its line through 1 and 4 MPa by a tenth.
Usage: limit.py RUN ..., output folders of scenes/onate_cement_uniaxial_strain.prm."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import platen

for run in map(platen.Run, sys.argv[1:]):
    strain, stress = run.history["axial_strain_platen"], run.stress
    difference = stress - run.history["confining_pressure_pa"]
    first, last = ((1e6 < difference) & (difference < 4e6)).nonzero()[0][[0, -1]]
    slope = (difference[last] - difference[first]) / (strain[last] - strain[first])
    left = ((difference > 4e6) & (difference < 0.9 * (difference[first] + slope * (strain - strain[first])))).nonzero()[0]
    print(f"{run.folder}: " + (f"{1e-6 * stress[left[0]]:.2f} MPa axial, {1e-6 * difference[left[0]]:.2f} MPa difference" if left.size else "no limit"))
