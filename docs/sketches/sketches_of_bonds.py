"""Sketches of spheres and bonds."""

import math

from sketch import BLUE, LIGHT, ORANGE, PALE_BLUE, PALE_ORANGE, PALE_RED, RED, SHADE, Sketch, by_name


def coordination_number():
    s = Sketch("Coordination number: neighbours of a sphere")
    for k in range(6):
        angle = 2 * math.pi * k / 6 + .3
        x, y = 130 + 50 * math.cos(angle), 88 + 50 * math.sin(angle)
        s.line(130, 88, x, y, width=4, stroke=BLUE)
        s.circle(x, y, 22)
    s.circle(130, 88, 24, fill=SHADE)
    s.words(130, 92, "6", "middle", size=14)
    s.words(130, 182, "bonds of a sphere, in the mean", "middle")
    return s


def bond():
    s = Sketch("Bond between two spheres: radius, gap")
    s.circle(80, 90, 48)
    s.circle(186, 90, 48)
    s.box(80, 60, 106, 60, fill=PALE_BLUE, stroke=BLUE)
    s.circle(80, 90, 3, fill=BLUE)
    s.circle(186, 90, 3, fill=BLUE)
    s.arrow(133, 90, 133, 60, stroke=BLUE)
    s.words(138, 80, "R_b", fill=BLUE)
    s.line(128, 110, 128, 158, dash="3 3")
    s.line(138, 110, 138, 158, dash="3 3")
    s.words(133, 172, "gap", "middle")
    s.words(133, 26, "bond: a short beam", "middle", fill=BLUE)
    return s


def moment_contribution():
    s = Sketch("Moment contribution: share of bending in the stress that breaks a bond", 300, 190)
    s.box(30, 50, 70, 80, fill=PALE_BLUE, stroke=BLUE)
    for y in range(58, 130, 12):
        s.arrow(100, y, 124, y, stroke=BLUE)
    s.words(78, 148, "from the force", "middle", fill=BLUE, size=10)
    s.words(150, 95, "+ beta", "middle", size=13)
    s.box(180, 50, 50, 80, fill=PALE_RED, stroke=RED)
    for y in range(54, 132, 12):
        length = (90 - y) * .75
        s.arrow(230, y, 230 + length if length > 0 else 230 - abs(length), y, stroke=RED)
    s.words(212, 148, "from the moment", "middle", fill=RED, size=10)
    s.words(150, 176, "their sum at the rim, against the strength", "middle")
    return s


def stiffness_ratio():
    s = Sketch("Stiffness ratio: shear over normal stiffness of a bond")
    for x, way in ((66, "n"), (190, "s")):
        s.circle(x, 70, 26)
        s.circle(x, 126, 26, fill=SHADE)
        if way == "n":
            s.arrow(x, 70, x, 34, stroke=BLUE)
            s.words(x, 28, "k_n", "middle", fill=BLUE)
        else:
            s.arrow(x, 70, x + 40, 70, stroke=RED)
            s.words(x + 44, 62, "k_s", fill=RED)
    s.words(130, 180, "k_s / k_n", "middle")
    return s


def end_layer():
    s = Sketch("End layer: spheres near the end plane that touch the platen from the start")
    s.box(30, 24, 200, 16, fill=SHADE)
    s.line(30, 70, 230, 70, dash="4 3", stroke=RED)
    for x, y, r, near in ((52, 58, 15, 1), (84, 66, 18, 1), (118, 58, 16, 1), (152, 78, 17, 0), (186, 62, 17, 1),
                          (214, 82, 14, 0), (64, 98, 17, 0), (100, 104, 17, 0), (134, 112, 16, 0), (176, 110, 17, 0)):
        s.circle(x, y, r, fill=PALE_ORANGE if near else LIGHT)
        if near:
            s.line(x, y - r, x, 40, stroke=ORANGE, width=3)
    s.arrow(240, 40, 240, 70, stroke=RED, both=True)
    s.lines_of_words(130, 150, ("distance of the surface to the plane:", "at most End layer times the mean radius"),
                     spacing=14, anchor="middle", size=10)
    return s


def unbalanced_force():
    s = Sketch("Unbalanced force: what is left when all forces on a sphere are added")
    s.circle(120, 92, 34, fill=SHADE)
    for angle, length in ((.2, 46), (1.9, 40), (3.0, 44), (4.6, 42)):
        x, y = 120 + 36 * math.cos(angle), 92 + 36 * math.sin(angle)
        s.arrow(x + length * math.cos(angle), y + length * math.sin(angle), x, y, stroke=BLUE)
    s.arrow(120, 92, 134, 104, stroke=RED, width=2.2)
    s.words(140, 112, "net", fill=RED)
    s.words(130, 182, "net force over forces of bonds", "middle")
    return s


def crack():
    s = Sketch("Crack: a bond that broke, in tension or in shear", 300, 170)
    for x, way in ((80, "tension"), (220, "shear")):
        s.circle(x - 28, 70, 24)
        s.circle(x + 28, 70 + (12 if way == "shear" else 0), 24)
        s.path([(x, 38), (x - 4, 54), (x + 4, 70), (x - 4, 86), (x, 104)], stroke=RED, width=2.2)
        if way == "tension":
            s.arrow(x - 30, 70, x - 66, 70, stroke=BLUE)
            s.arrow(x + 30, 70, x + 66, 70, stroke=BLUE)
        else:
            s.arrow(x - 28, 84, x - 28, 40, stroke=BLUE)
            s.arrow(x + 28, 66, x + 28, 116, stroke=BLUE)
        s.words(x, 146, way, "middle")
    return s


BONDS = by_name(coordination_number, bond, moment_contribution, stiffness_ratio, end_layer, unbalanced_force, crack)
