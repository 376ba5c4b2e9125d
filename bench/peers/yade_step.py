"""Speed of one step of Yade: the spheres of a specimen file, bonded by cohesive-frictional contacts that carry
normal and shear force, bending and twisting, between two rigid walls that press the ends. Prints "N M bond-steps/s"
(median over repeats) like bench_step, with which it shares packing, pairs, stiffnesses, masses, damping and loading.

Usage: yade -n -x -jTHREADS yade_step.py SPECIMEN.csv [--steps N] [--repeats N] [--time-step SECONDS]
"""
import argparse
import math
import os
import resource
import statistics
import sys
import time
import traceback

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from yade_specimen import (UNBREAKABLE, BondLaw, add_spheres, bonds, contact_of_spheres, grain_material, lay_bonds,
                           read_specimen, touch_of_spheres)

# As in bench_step.cc; SI. Nothing breaks: the elastic stage is timed.
LAW = BondLaw(modulus=40e9, stiffness_ratio=0.4, gap=0.1, tensile_strength=UNBREAKABLE, shear_strength=UNBREAKABLE,
              friction=0.5)
DENSITY = 2400  # kg/m^3
PLATEN_FRICTION = 0.57
LOCAL_DAMPING = 0.5
RATE = 0.05  # m/s, closure of both platens together

# Boxes grow by this share of the largest radius to each side: two of them span the widest gap that is bonded, and no
# sphere moves as far while it is timed, so that boxes are sorted once.
VERLET = 0.5 * LAW.gap * 1.02


def megabytes():
    """Peak of resident memory so far, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def add_bodies(centre, radius):
    """Spheres first, numbered as given, then the walls at the ends."""
    grain = grain_material(LAW, DENSITY)
    steel = FrictMat(young=grain.young, poisson=grain.poisson, density=DENSITY)  # friction: see set_engines
    O.materials.append(grain)
    O.materials.append(steel)
    add_spheres(centre, radius, grain)
    for end, side in (((centre[:, 2] - radius).min(), 1), ((centre[:, 2] + radius).max(), -1)):
        wall = utils.wall(float(end), axis=2, sense=side, material=steel)
        O.bodies.append(wall)
        wall.state.vel = (0, 0, 0.5 * side * RATE)


def set_engines(largest, touch, contact):
    """No more than a step needs. Moments in the total form, Yade's default and the form of Platen's law."""
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=VERLET * largest, targetInterv=-1,
                              sortAxis=2, label="collider"),
        InteractionLoop(
            [touch, Ig2_Wall_Sphere_ScGeom()],
            [contact,
             Ip2_FrictMat_FrictMat_FrictPhys(frictAngle=MatchMaker(algo="val", val=math.atan(PLATEN_FRICTION)))],
            [Law2_ScGeom6D_CohFrictPhys_CohesionMoment(useIncrementalForm=False),
             Law2_ScGeom_FrictPhys_CundallStrack()]),
        NewtonIntegrator(damping=LOCAL_DAMPING),
    ]
    O.timingEnabled = False
    O.trackEnergy = False


def safe_step(radius):
    """Half the step that the stiffest sphere would stand if its bonds all pulled one way."""
    stiffness = np.zeros(len(radius))
    for i in bonds(len(radius)):
        stiffness[[i.id1, i.id2]] += i.phys.kn
    mass = DENSITY * 4 / 3 * math.pi * radius**3
    return 0.5 * math.sqrt((2 * mass / np.maximum(stiffness, 1e-300)).min())


def main():
    parser = argparse.ArgumentParser(prog="yade_step.py")
    parser.add_argument("specimen", help="spheres, as Platen writes them")
    parser.add_argument("--steps", type=int, default=500, help="steps per repeat")
    parser.add_argument("--repeats", type=int, default=5, help="repeats; the median is printed")
    parser.add_argument("--time-step", type=float, default=0, help="s; default: one that is safe")
    chosen = parser.parse_args(sys.argv[1:])
    empty = megabytes()

    centre, radius = read_specimen(chosen.specimen)
    touch, contact = touch_of_spheres(LAW), contact_of_spheres()
    set_engines(radius.max(), touch, contact)
    add_bodies(centre, radius)
    lay_bonds(centre, radius, LAW, touch, contact)
    laid = len(bonds(len(radius)))
    O.dt = chosen.time_step or safe_step(radius)
    print(f"{len(radius)} particles, {laid} bonds, {O.numThreads} threads, step {O.dt:.4g} s", flush=True)

    # O.run looks only every 40 ms whether it is done: steps must be so many that this does not count.
    O.run(max(chosen.steps // 5, 1), True)  # warm
    rates = []
    for _ in range(chosen.repeats):
        start = time.perf_counter()
        O.run(chosen.steps, True)
        rates.append(laid * chosen.steps / (time.perf_counter() - start) * 1e-6)

    left = bonds(len(radius))
    intact = sum(not i.phys.cohesionBroken for i in left)
    pressed = sum(max(i.id1, i.id2) >= len(radius) for i in O.interactions)
    force = [abs(O.forces.f(k)[2]) for k in (len(radius), len(radius) + 1)]
    moment = max((i.phys.moment_bending.norm() + i.phys.moment_twist.norm() for i in left), default=0)
    print(f"platens: {pressed} contacts, {force[0]:.4g} N and {force[1]:.4g} N after {O.time:.3g} s; "
          f"largest moment {moment:.2g} N m; boxes sorted {collider.numAction} times")
    if intact != laid or len(left) != laid:
        sys.exit(f"{laid} bonds were laid, {len(left)} are left, {intact} of them intact: the figures would be wrong")
    if not (0 < force[0] < math.inf and 0 < force[1] < math.inf):
        sys.exit("the platens do not press: the figures would be wrong")
    print(f"peak memory {megabytes():.0f} MB, {empty:.0f} MB of it before the first sphere")
    print(f"smallest {min(rates):.3f}, largest {max(rates):.3f} M bond-steps/s")
    print(f"{statistics.median(rates):.3f} M bond-steps/s", flush=True)


try:
    main()
except Exception:  # which Yade would print and then leave with status 0
    traceback.print_exc()
    sys.exit(1)
