"""Stress intensity of a penny crack in the middle of a round bar in tension, by finite elements.

Quadratic elements of half of the bar (radius 1, stress 1, Young's modulus 1), graded towards the crack's tip. The energy W that the bar
stores under one load grows with the crack by the energy release rate, dW = G dA, and K^2 = G E / (1 - nu^2). In a long bar .3 % too low.
"""
import math

import numpy as np

POINTS = [(-math.sqrt(0.6), 5 / 9), (0.0, 8 / 9), (math.sqrt(0.6), 5 / 9)]  # of Gauss


def towards_zero(count, growth=2.0):
    """Ends of intervals in 0 ... 1, each larger than the one before."""
    ends = np.concatenate([[0], np.cumsum(growth ** np.arange(count))])
    return ends / ends[-1]


def along(x):
    """The three shapes on -1 ... 1, and their slopes."""
    return np.array([x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2]), np.array([x - 0.5, -2 * x, x + 0.5])


def compliance(crack, half_height, glued, nu, count=6):
    """Lengthening of half of the bar under a unit force: by an even stress, or by ends that neither widen nor bend."""
    r = np.concatenate([crack * (1 - towards_zero(count)[::-1]), crack + (1 - crack) * towards_zero(count)[1:]])
    z = half_height * towards_zero(count + 2)
    rows = 2 * len(z) - 1
    degrees = np.arange(2 * (2 * len(r) - 1) * rows).reshape(-1, rows, 2)  # by node along r, along z, and direction
    law = 1 / (1 + nu) * (np.diag([1, 1, 1, 0.5]) + np.pad(np.full((3, 3), nu / (1 - 2 * nu)), (0, 1)))  # of rr, zz, hoop, rz
    stiffness, load = np.zeros((degrees.size, degrees.size)), np.zeros(degrees.size)
    for i, half_r in enumerate(np.diff(r) / 2):
        for k, half_z in enumerate(np.diff(z) / 2):
            mine = degrees[2 * i:2 * i + 3, 2 * k:2 * k + 3].ravel()
            for (x, weight_x) in POINTS:
                radius, (shape_r, slope_r) = r[i] + half_r * (1 + x), along(x)
                for (y, weight_y) in POINTS:
                    shape_z, slope_z = along(y)
                    b, by_r, by_z = np.zeros((4, 18)), np.outer(slope_r, shape_z).ravel() / half_r, np.outer(shape_r, slope_z).ravel() / half_z
                    b[0, ::2], b[3, 1::2], b[1, 1::2], b[3, ::2] = by_r, by_r, by_z, by_z
                    b[2, ::2] = np.outer(shape_r, shape_z).ravel() / radius
                    stiffness[np.ix_(mine, mine)] += b.T @ law @ b * (weight_x * weight_y * half_r * half_z * 2 * math.pi * radius)
        for (x, weight_x) in POINTS:
            load[degrees[2 * i:2 * i + 3, -1, 1]] += along(x)[0] * weight_x * half_r * 2 * (r[i] + half_r * (1 + x))  # sum is 1
    end = degrees[:, -1, 1]
    held = np.concatenate([degrees[0, :, 0], degrees[2 * count:, 0, 1], *([degrees[:, -1, 0], end] if glued else [])])
    free, moved = np.setdiff1d(degrees, held), np.zeros(degrees.size)
    if not glued:
        moved[free] = np.linalg.solve(stiffness[np.ix_(free, free)], load[free])
        return load @ moved
    moved[end] = 1
    moved[free] = np.linalg.solve(stiffness[np.ix_(free, free)], -(stiffness @ moved)[free])
    return 1 / (stiffness @ moved)[end].sum()


def factor(part, half_height=3.0, glued=False, nu=0.2, step=0.01):
    """K over stress sqrt(pi a) of a crack that takes this part of the bar's radius; half the height in those radii."""
    energies = [math.pi**2 * compliance(part * (1 + sign * step), half_height, glued, nu) for sign in (-1, 1)]  # of both halves
    return math.sqrt((energies[1] - energies[0]) / (4 * math.pi * part**2 * step) / (1 - nu**2) / (math.pi * part))
