#!/usr/bin/env python3
"""What codes give for the short filled tubes of tests.csv beside the measured loads: the plain sum of steel and concrete, and EN 1994-1-1:2004 with
confinement. Partial factors 1, measured strengths; concrete without the factor .85, as 6.7.3.2 (1) has it for filled sections.

Usage: codes.py      prints a row for each test, mean and coefficient of variation of test over code, and the greased pairs
"""
import csv
import math
import pathlib
import statistics

TESTS = pathlib.Path(__file__).with_name("tests.csv")
CYLINDER_OVER_CUBE = 0.8  # EN 1992-1-1 table 3.1: .78 to .83 in C20/25 to C50/60, .84 in C80/95; one factor for all tests
STEEL_MODULUS = 210e9     # Pa, EN 1993-1-1 3.2.6
# Ends between thick flat platens do not turn in so short a specimen: fixed ends, EN 1994-1-1 6.7.3.3 with half the length.
BUCKLING_LENGTH = 0.5     # of the specimen's length


class Tube:
    """A filled tube of tests.csv, in SI; `load` is what was measured."""

    def __init__(self, row):
        self.name = f"{row['author']} {row['year']} {row['specimen']}"
        self.d, self.t, self.length = (float(row[key]) * 1e-3 for key in ("diameter_mm", "wall_mm", "length_mm"))
        self.f_y, self.f_c = float(row["steel_yield_mpa"]) * 1e6, float(row["concrete_strength_mpa"]) * 1e6
        if row["concrete_strength_of"] == "cube":
            self.f_c *= CYLINDER_OVER_CUBE
        self.load = float(row["largest_load_kn"]) * 1e3
        self.chosen, self.pair, self.greased = row["chosen"] == "1", row["pair"], row["greased"] == "1"
        inner = self.d - 2 * self.t
        self.concrete_area = math.pi / 4 * inner**2
        self.steel_area = math.pi / 4 * self.d**2 - self.concrete_area
        self.concrete_inertia = math.pi / 64 * inner**4
        self.steel_inertia = math.pi / 64 * self.d**4 - self.concrete_inertia

    def plain(self):
        """A_a f_y + A_c f_c, (6.30): N."""
        return self.steel_area * self.f_y + self.concrete_area * self.f_c

    def slenderness(self, buckling_length=BUCKLING_LENGTH):
        """(6.39) with N_cr of (EI)_eff = E_a I_a + .6 E_cm I_c, (6.40); E_cm of EN 1992-1-1 table 3.1."""
        concrete_modulus = 22e9 * (self.f_c / 10e6) ** 0.3
        stiffness = STEEL_MODULUS * self.steel_inertia + 0.6 * concrete_modulus * self.concrete_inertia
        return math.sqrt(self.plain() / (math.pi**2 * stiffness)) * buckling_length * self.length

    def confined(self, buckling_length=BUCKLING_LENGTH):
        """(6.33) to (6.35), load in the axis: N. The section's resistance; buckling (6.44) reduces it above a slenderness of .2 only."""
        slenderness = self.slenderness(buckling_length)
        if slenderness > 0.5:  # 6.7.3.2 (6): no confinement
            return self.plain()
        eta_a = 0.25 * (3 + 2 * slenderness)  # 1 at .5
        eta_c = max(4.9 - 18.5 * slenderness + 17 * slenderness**2, 0.0)
        return eta_a * self.steel_area * self.f_y + self.concrete_area * self.f_c * (1 + eta_c * self.t / self.d * self.f_y / self.f_c)

    def within_the_code(self):
        """6.7.1 (2): S235 to S460 and C20/25 to C50/60, whose mean strengths are 28 to 58 MPa; table 6.3: d/t up to 90 x 235 MPa/f_y."""
        return self.f_y <= 460e6 and 28e6 <= self.f_c <= 58e6 and self.d / self.t <= 90 * 235e6 / self.f_y


def tubes(path=TESTS):
    with open(path, encoding="utf-8") as file:
        return [Tube(row) for row in csv.DictReader(line for line in file if not line.startswith("#"))]


def spread(values):
    """Mean and coefficient of variation."""
    return statistics.mean(values), statistics.stdev(values) / statistics.mean(values)


def rows():
    """The tables, line by line."""
    chosen = [tube for tube in tubes() if tube.chosen]
    yield "| test | t/d | slenderness | f_c, MPa | load, kN | over plain sum | over EN 1994-1-1 |\n|" + " --- |" * 7
    for tube in chosen:
        yield (f"| {tube.name}{'' if tube.within_the_code() else ' *'} | {tube.t / tube.d:.4f} | {tube.slenderness():.3f} | {tube.f_c / 1e6:.1f} "
               f"| {tube.load / 1e3:.0f} | {tube.load / tube.plain():.3f} | {tube.load / tube.confined():.3f} |")
    yield "\n*: outside of what the code allows (steel, concrete or d/t)\n"
    yield "| tests | over plain sum | over EN 1994-1-1 | the same, buckling length L |\n|" + " --- |" * 4
    codes = (Tube.plain, Tube.confined, lambda tube: tube.confined(1.0))
    for words, some in (("all", chosen), ("within the code", [tube for tube in chosen if tube.within_the_code()])):
        cells = (spread([tube.load / code(tube) for tube in some]) for code in codes)
        yield f"| {words} ({len(some)}) | " + " | ".join(f"{mean:.3f}, {100 * variation:.1f} %" for mean, variation in cells) + " |"
    yield "\n| same concrete, bonded and greased | bonded, kN | greased, kN | greased over bonded |\n|" + " --- |" * 4
    for bonded, greased in pairs():
        yield f"| {bonded.name}, {greased.name.split()[-1]} | {bonded.load / 1e3:.0f} | {greased.load / 1e3:.0f} | {greased.load / bonded.load:.3f} |"


def pairs(path=TESTS):
    """Of each pair the bonded and the greased tube."""
    paired = sorted((tube for tube in tubes(path) if tube.pair), key=lambda tube: (tube.pair, tube.greased))
    return list(zip(paired[::2], paired[1::2]))


if __name__ == "__main__":
    print("\n".join(rows()))
