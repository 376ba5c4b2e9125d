"""What yade_step.py and yade_test.py share: a specimen file, an order of its spheres, and bonds with the geometry,
stiffnesses and strengths of Platen's parallel bond. SI. For scripts that Yade runs."""
import math
import sys
from typing import NamedTuple

import numpy as np
from yade import *

UNBREAKABLE = 1e12  # Pa; a bond across a gap holds until lay_bonds has set its zero


class BondLaw(NamedTuple):
    modulus: float  # Pa: k_n = modulus / (R_i + R_j)
    stiffness_ratio: float  # shear over normal
    gap: float  # bond where |d| - R_i - R_j <= gap min(R_i, R_j)
    tensile_strength: float  # Pa
    shear_strength: float  # Pa, without compression
    friction: float  # coefficient; Yade has one for bonds and for what has broken


def read_specimen(path):
    """Centres (n, 3) and radii (n), m, of a specimen file."""
    rows, header = [], False
    with open(path, encoding="utf-8-sig") as file:
        for line in map(str.strip, file):
            if not line or line.startswith("#"):
                continue
            if header:
                rows.append([float(word) for word in line.split(",")])
            elif line == "x_m,y_m,z_m,radius_m":
                header = True
            else:
                sys.exit(f"{path}: \"{line[:60]}\" is not the header line \"x_m,y_m,z_m,radius_m\"")
    table = np.array(rows)
    if table.ndim != 2 or table.shape[1] != 4 or not (table[:, 3] > 0).all():
        sys.exit(f"{path}: wanted rows of x, y, z and a positive radius")
    return in_order(table[:, :3], table[:, 3])


def in_order(centre, radius):
    """Slab by slab and row by row of cells, so that neighbours lie close in memory: about a seventh faster than an
    order by chance."""
    x, y, z = np.floor(centre / (4 * radius.max())).astype(int).T
    order = np.lexsort((x, y, z))
    return centre[order], radius[order]


def grain_material(law, density):
    """Contacts that Yade makes by itself get their stiffness of it: E R is the axial stiffness of a bond of two spheres
    of radius R."""
    return CohFrictMat(young=0.5 * math.pi * law.modulus, poisson=law.stiffness_ratio, density=density,
                       frictionAngle=math.atan(law.friction), isCohesive=True, normalCohesion=UNBREAKABLE,
                       shearCohesion=UNBREAKABLE, momentRotationLaw=True, alphaKr=1,
                       alphaKtw=1)  # stiffnesses and strengths of bonds are set one by one, in lay_bonds


def add_spheres(centre, radius, material, masks=None):
    """Numbered as given."""
    spheres = [utils.sphere(tuple(c), r, material=material) for c, r in zip(centre.tolist(), radius.tolist())]
    for sphere, mask in zip(spheres, [] if masks is None else masks):
        sphere.mask = mask
    O.bodies.append(spheres)  # in one call: faster


def touch_of_spheres(law):
    """Finds pairs within reach of the widest gap that is bonded; lay_bonds takes the reach away again."""
    return Ig2_Sphere_Sphere_ScGeom6D(interactionDetectionFactor=1 + 0.5 * law.gap * (1 + 1e-9), updateRotations=True)


def bonds(spheres):
    """Pairs of spheres that are bonded or touch."""
    return [i for i in O.interactions if max(i.id1, i.id2) < spheres and isinstance(i.phys, CohFrictPhys)]


def contact_of_spheres():
    return Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True)


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
