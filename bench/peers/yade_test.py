"""The whole test in Yade: the specimen that a run of Platen crushed, with the same bonds, platens, rate, time step, samples and
rule to stop, from the run's scene.prm (all entries, in the state in which they counted). Writes OUT/history.csv and
OUT/summary.json, a few columns and figures of what Platen writes, by the same names.

Usage: yade -n -x -jTHREADS yade_test.py PLATEN_RUN SPECIMEN.csv OUT
"""
import argparse
import csv
import json
import math
import os
import sys
import time
import traceback
from typing import NamedTuple

import numpy as np

UNITS = {"mm": 1e-3, "m": 1, "ms": 1e-3, "us": 1e-6, "s": 1, "m/s": 1, "Pa": 1, "MPa": 1e6, "GPa": 1e9, "kg/m3": 1,
         "degree": math.pi / 180, "R_min": 1}
# What this script knows; a scene that says otherwise is another test.
KNOWN = {"Specimen/Shape": "cylinder", "Specimen/Ends": "as packed", "Effects/Bond": "parallel bond",
         "Effects/Contact": "linear", "Effects/Tangential": "coulomb", "Effects/Rotation": "on",
         "Effects/Bond moments": "on", "Effects/Gravity": "off", "Bond/Moment contribution": "0",
         "Bond/Radius rule": "minimum", "Bond/Radius multiplier": "1", "Bond/Strength scatter": "none",
         "Contact/Stiffness": "1", "Contact/Damping": "0", "Platens/Kind": "rigid", "Platens/Damping": "0",
         "Platens/Friction law": "constant", "Loading/Test": "compression", "Loading/Confinement": "none",
         "Integration/Scheme": "velocity verlet", "Integration/Damping form": "component",
         "Integration/Mass scaling": "1"}

# Boxes grow by this share of the largest radius to each side and are sorted again when a sphere has moved as far. It spans
# bonds across gaps; less sorts more often, more looks at more pairs in each step: while nothing breaks, 0.03, 0.1 and 0.2
# take the same processor time within 7 %.
VERLET = 0.1
UNBREAKABLE = 1e12  # Pa; a bond across a gap holds until lay_bonds has set its zero


class BondLaw(NamedTuple):
    modulus: float  # Pa: k_n = modulus / (R_i + R_j)
    stiffness_ratio: float  # shear over normal
    gap: float  # bond where |d| - R_i - R_j <= gap min(R_i, R_j)
    tensile_strength: float  # Pa
    shear_strength: float  # Pa, without compression
    friction: float  # coefficient; Yade has one for bonds and for what has broken


def read_specimen(path):
    """Centres (n, 3) and radii (n), m, of what platen-pack writes; slab by slab and row by row of cells, so that neighbours lie close in memory:
    about a seventh faster than an order by chance."""
    table = np.loadtxt(path, delimiter=",", skiprows=2)  # after the shape and the header
    x, y, z = np.floor(table[:, :3] / (4 * table[:, 3].max())).astype(int).T
    table = table[np.lexsort((x, y, z))]
    return table[:, :3], table[:, 3]


def grain_material(law, density):
    """Contacts that Yade makes by itself get their stiffness of it: E R is the axial stiffness of a bond of two spheres
    of radius R."""
    return CohFrictMat(young=0.5 * math.pi * law.modulus, poisson=law.stiffness_ratio, density=density,
                       frictionAngle=math.atan(law.friction), isCohesive=True, normalCohesion=UNBREAKABLE,
                       shearCohesion=UNBREAKABLE, momentRotationLaw=True, alphaKr=1,
                       alphaKtw=1)  # stiffnesses and strengths of bonds are set one by one, in lay_bonds


def add_spheres(centre, radius, material):
    """Numbered as given."""
    O.bodies.append([utils.sphere(tuple(c), r, material=material) for c, r in zip(centre.tolist(), radius.tolist())])  # in one call: faster


def touch_of_spheres(law):
    """Finds pairs within reach of the widest gap that is bonded; lay_bonds takes the reach away again."""
    return Ig2_Sphere_Sphere_ScGeom6D(interactionDetectionFactor=1 + 0.5 * law.gap * (1 + 1e-9), updateRotations=True)


def bonds(spheres):
    """Pairs of spheres that are bonded or touch."""
    return [i for i in O.interactions if max(i.id1, i.id2) < spheres and isinstance(i.phys, CohFrictPhys)]


def lay_bonds(centre, radius, law, touch, contact):
    """One step makes every contact within reach of the widest pair; what the rule does not bond goes again. Bonds are
    at rest where they were made, with the stiffnesses of Platen's parallel bond, and break at the forces at which it
    does: area times strength."""
    O.dt = 1e-30  # nothing moves
    O.step()
    touch.interactionDetectionFactor = 1
    contact.setCohesionNow = False  # the next step would set the strengths again
    for i in bonds(len(radius)):
        ri, rj = radius[i.id1], radius[i.id2]
        smaller = min(ri, rj)
        if np.linalg.norm(centre[i.id1] - centre[i.id2]) - ri - rj > law.gap * smaller:
            O.interactions.erase(i.id1, i.id2)
            continue
        area = math.pi * smaller**2
        axial = law.modulus / (ri + rj) * area  # N/m
        shear = law.stiffness_ratio * axial
        i.phys.kn, i.phys.ks = axial, shear
        i.phys.kr, i.phys.ktw = axial * smaller**2 / 4, shear * smaller**2 / 2  # I = A R^2/4, J = 2 I
        i.phys.normalAdhesion, i.phys.shearAdhesion = law.tensile_strength * area, law.shear_strength * area
        i.phys.unp = i.geom.penetrationDepth
        i.phys.normalForce = i.phys.shearForce = (0, 0, 0)
    for k in range(len(radius)):
        O.bodies[k].state.vel = O.bodies[k].state.angVel = (0, 0, 0)
    O.forces.reset()


class Scene:
    """Entries "Section/Key" of a scene file without further levels, which are skipped."""

    def __init__(self, path):
        self.entries, sections = {}, []
        with open(path) as file:
            for line in map(str.strip, file):
                word, _, rest = line.partition(" ")
                if word == "subsection":
                    sections.append(rest)
                elif word == "end":
                    sections.pop()
                elif word == "set" and len(sections) == 1:
                    key, _, value = rest.partition("=")
                    self.entries[f"{sections[0]}/{key.strip()}"] = value.strip()
        for entry, value in KNOWN.items():
            if self.entries.get(entry) != value:
                sys.exit(f"{path}: {entry} = {self.entries.get(entry)}; this script knows {value} alone")

    def __getitem__(self, entry):
        """SI."""
        number, _, unit = self.entries[entry].partition(" ")
        return float(number) * (UNITS[unit] if unit else 1)


class PlatenTest:
    """The platens, and what is measured on them. Stresses and strains are positive in compression."""

    def __init__(self, scene, ends, walls, spheres, laid):
        self.area = math.pi * scene["Specimen/Radius"]**2  # m^2
        self.rate, self.ramp = scene["Loading/Axial rate"], scene["Loading/Ramp"]
        self.share, self.target = scene["Loading/Stop at residual"], scene["Loading/Target strain"]
        self.walls, self.height = walls, ends[1] - ends[0]
        self.spheres, self.laid = spheres, laid  # numbers
        self.peak, self.rows, self.ended_by = 0, [], ""

    def drive(self):
        """Both platens approach, from rest by x^2 (3 - 2 x) within the ramp, as Platen's do."""
        x = min(O.time / self.ramp, 1)
        for wall, side in zip(self.walls, (1, -1)):
            wall.state.vel = (0, 0, 0.5 * side * self.rate * x * x * (3 - 2 * x))
        if x == 1:
            driver.dead = True

    def sample(self):
        bottom, top = (side * O.forces.f(wall.id)[2] / self.area for wall, side in zip(self.walls, (-1, 1)))
        strain = 1 - (self.walls[1].state.pos[2] - self.walls[0].state.pos[2]) / self.height
        self.rows.append((O.time, strain, top, bottom))
        stress = 0.5 * (top + bottom)
        self.peak = max(self.peak, stress)
        if stress < self.share * self.peak and self.broken():
            self.ended_by = "stop at residual"
        elif strain >= self.target:
            self.ended_by = "target"
        if self.ended_by:
            O.pause()

    def broken(self):
        """How many bonds. A pair that was torn apart is gone, or is a new contact without a bond."""
        return self.laid - sum(not i.phys.cohesionBroken for i in bonds(self.spheres))


def add_platens(scene, ends, axial, steel_contact):
    """Walls at the outermost spheres. `axial`: N/m, of the mean bond."""
    steel = FrictMat(young=1, poisson=1, density=1)  # its contacts have the stiffness and friction set here
    O.materials.append(steel)
    stiffness = scene["Platens/Stiffness"] * axial
    steel_contact.kn = MatchMaker(algo="val", val=stiffness)
    steel_contact.ks = MatchMaker(algo="val", val=scene["Platens/Tangential ratio"] * stiffness)
    steel_contact.frictAngle = MatchMaker(algo="val", val=math.atan(scene["Platens/Friction static"]))
    walls = [utils.wall(float(end), axis=2, sense=side, material=steel) for end, side in zip(ends, (1, -1))]
    for wall in walls:
        O.bodies.append(wall)
    return walls


def write(folder, test, summary):
    os.makedirs(folder, exist_ok=True)
    with open(f"{folder}/history.csv", "w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(("time_s", "axial_strain_platen", "axial_stress_top_pa", "axial_stress_bottom_pa"))
        rows.writerows(test.rows)
    with open(f"{folder}/summary.json", "w") as file:
        json.dump(summary, file, indent=2)


def main():
    global test, driver  # for the commands of engines
    parser = argparse.ArgumentParser(prog="yade_test.py")
    parser.add_argument("platen_run", help="output folder of platen-compress")
    parser.add_argument("specimen", help="spheres, as Platen writes them")
    parser.add_argument("output", help="folder")
    chosen = parser.parse_args(sys.argv[1:])
    scene = Scene(f"{chosen.platen_run}/scene.prm")
    with open(f"{chosen.platen_run}/history.csv") as file:
        time_step = float(next(csv.DictReader(file))["time_step_s"])

    law = BondLaw(scene["Bond/Modulus"], scene["Bond/Stiffness ratio"], scene["Bond/Gap"],
                  scene["Bond/Tensile strength"], scene["Bond/Shear strength"], math.tan(scene["Bond/Friction angle"]))
    if abs(law.friction - scene["Contact/Friction"]) > 1e-4 or \
            law.stiffness_ratio != scene["Contact/Tangential ratio"]:
        sys.exit("Yade's contacts have the friction and the ratio of stiffnesses of its bonds; those of the scene differ")
    centre, radius = read_specimen(chosen.specimen)
    touch, contact = touch_of_spheres(law), Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True)
    steel_contact = Ip2_FrictMat_FrictMat_FrictPhys()
    driver = PyRunner(command="test.drive()", iterPeriod=1)
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=VERLET * radius.max(), targetInterv=-1,
                              sortAxis=2),
        InteractionLoop(
            [touch, Ig2_Wall_Sphere_ScGeom()],
            [contact, steel_contact],
            [Law2_ScGeom6D_CohFrictPhys_CohesionMoment(useIncrementalForm=False),
             Law2_ScGeom_FrictPhys_CundallStrack()]),
        NewtonIntegrator(damping=scene["Integration/Damping"]),
    ]
    grain = grain_material(law, scene["Material/Density"])
    O.materials.append(grain)
    add_spheres(centre, radius, grain)
    lay_bonds(centre, radius, law, touch, contact)
    stiffness = [i.phys.kn for i in bonds(len(radius))]
    ends = (centre[:, 2] - radius).min(), (centre[:, 2] + radius).max()
    walls = add_platens(scene, ends, np.mean(stiffness), steel_contact)
    test = PlatenTest(scene, ends, walls, len(radius), len(stiffness))
    # Measured where forces are known and positions are those that they belong to.
    sampler = PyRunner(command="test.sample()", iterPeriod=int(scene["Output/Every"]), firstIterRun=O.iter)
    O.engines = O.engines[:3] + [sampler] + O.engines[3:] + [driver]
    O.dt = time_step
    O.resetTime()
    begun, first = time.perf_counter(), O.iter
    O.run(wait=True)
    seconds = time.perf_counter() - begun

    summary = {"particles": len(radius), "bonds": test.laid, "broken": test.broken(), "steps": O.iter - first,
               "time_step_s": time_step, "threads": O.numThreads, "step_seconds": seconds, "ended_by": test.ended_by,
               "boxes_sorted": O.engines[1].numAction}
    write(chosen.output, test, summary)
    print(json.dumps(summary), flush=True)
    if not test.ended_by:
        sys.exit("Yade stopped before the test was over")


try:
    main()
except Exception:  # which Yade would print and then leave with status 0
    traceback.print_exc()
    sys.exit(1)
