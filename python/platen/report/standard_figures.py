"""Figures that standards of testing read off a curve: moduli, crack stresses, corrected strength, type of fracture. A figure that a test
cannot give is Missing, with its reason. SI; compression positive. Where each rule is from: docs/howto/standard_report.md."""
from typing import NamedTuple

import numpy

from .curves import has_cell, stages_of
from .run import listed, number_in, shape_of

GAUGE_START = 50e-6  # strain of the lower point of ASTM C469
WORKING = 0.4  # share of the strength, its upper point
TANGENT = (0.4, 0.6)  # shares of the strength between which the tangent at half of it is fitted
STEP, LEAST, STRAIGHT = 0.05, 0.2, 0.01  # of the straight part: steps of its ends, its least length, its largest deviation; of the strength
ELASTIC = 0.4  # of the crack damage stress: up to it the specimen counts as elastic, for a simulation has no cracks that close first
DEPARTED = 0.05  # of the largest volumetric strain: what the crack volumetric strain has lost where cracks have begun
LOWER, UPPER = (0.095, 0.205), (0.95 / 3, 1.05 / 3)  # stresses of the cycles of EN 12390-13 over the strength
RISE = (0.1, 0.9)  # shares of the strength between which the rate of loading is taken
# Height over diameter, factor of ASTM C42; interpolated. ASTM C39 corrects nothing from SLENDER on.
SLENDERNESS = ((1.0, 1.25, 1.5, 1.75, 2.0), (0.87, 0.93, 0.96, 0.98, 1.0))
SLENDER, ROUND_OFF, CORRECTED = 1.8, 1e-9, (14e6, 41e6)  # Pa: strengths for which the factors are
# Types of fracture of ASTM C39 by the pattern of the summary and by how many ends have a cone.
FRACTURES = {("cones", 2): 1, ("cones", 1): 2, ("splitting", 1): 2, ("splitting", 0): 3, ("shear plane", 0): 4, ("shear plane", 1): 4,
             ("shear plane", 2): 4}
FRACTURE_WORDS = ("", "cones on both ends", "a cone on one end, vertical cracks", "columns: vertical cracks, no cone", "one inclined plane",
                  "side fracture at one end", "side fracture at one end, which is pointed")
ONE_END = 2  # an end is crushed alone where it has so many times the damage of the other one


class Missing(Exception):
    """Why a test does not give a figure."""


def told(run, key, words):
    """A number of the summary, or Missing with what is against it."""
    value, against = number_in(run.info, key), reasons(run, key)
    if not value >= 0:
        raise Missing(f"no {words}: {against or 'the summary has none'}")
    return value


def reasons(run, key):
    """What the summary has against a figure; "" where nothing."""
    return "; ".join(map(str, listed(run.info.get("validity"), key, object)))


class Part(NamedTuple):
    """Of a curve: axial and lateral strain, stress (Pa), time (s)."""

    strain: object
    lateral: object
    stress: object
    time: object

    @property
    def modulus(self):
        """Pa, of the straight line by least squares."""
        return float(numpy.polyfit(self.strain, self.stress, 1)[0])

    @property
    def poisson(self):
        """E over the slope of stress over lateral strain, as E is taken."""
        return -self.modulus / float(numpy.polyfit(self.lateral, self.stress, 1)[0]) if numpy.ptp(self.lateral) > 0 else 0.0

    @property
    def bow(self):
        """Pa, largest distance of the stress from the line through both ends."""
        line = numpy.interp(self.strain, self.strain[[0, -1]], self.stress[[0, -1]])
        return float(numpy.abs(self.stress - line).max())


class Curve:
    """The rising branch of a test, from the end of consolidation to the peak. stress: axial, in a cell the deviator; strain: of the gauge in
    the middle half where the run has it, else between the platens; strength: on this branch, or Missing."""

    def __init__(self, run):
        self.run, self.confined = run, has_cell(run)
        rows = slice(run.zero, run.peak_row + 1)
        of = lambda name: run.since(name)[rows] if run.has(name) else numpy.full(rows.stop - rows.start, numpy.nan)  # noqa: E731
        stress = run.stress - (run.h["confining_pressure_pa"] if self.confined else 0)
        gauge = of("axial_strain_gauge")
        self.by_gauge = run.axis == 2 and bool(numpy.isfinite(gauge).all())
        known = numpy.isfinite(stress[rows])
        self.strain = (gauge if self.by_gauge else run.strain[rows])[known]
        self.whole = Part(self.strain, of("lateral_strain")[known], stress[rows][known], run.h["time_s"][rows][known])
        self.volume = of("volumetric_strain")[known]

    @property
    def strain_words(self):
        return "gauge of the middle half" if self.by_gauge else "between the platens"

    @property
    def strength_words(self):
        return "deviator at the peak" if self.confined else "strength"

    @property
    def strength(self):
        return told(self.run, "deviator_strength_pa" if self.confined else "strength_pa", "strength")

    def elastic(self, lateral=False):
        """Itself, where the run allows moduli to be read off, and with `lateral` Poisson's ratio; else Missing."""
        against = reasons(self.run, "youngs_modulus_gauge_pa" if self.by_gauge else "youngs_modulus_platen_pa")
        if lateral:
            against = reasons(self.run, "poisson_ratio") or against
            against = against or "no lateral strain was measured" * (not numpy.isfinite(self.whole.lateral).all())
        if against:
            raise Missing(against)
        return self

    def at(self, level, along):
        """Where the values `along` first come to the level: a row and a share on from it."""
        above = numpy.flatnonzero(along >= level)
        if not len(above):
            raise Missing("the curve does not come to it before the peak")
        if above[0] == 0:
            if along[0] > level:
                raise Missing("the first row of history.csv lies above it")
            return 0.0
        k = above[0]
        return float(k - 1 + (level - along[k - 1]) / (along[k] - along[k - 1]))

    def point(self, place):
        """strain, lateral strain, stress, time, interpolated between rows."""
        rows = numpy.arange(len(self.strain))
        return Part(*(float(numpy.interp(place, rows, values)) for values in self.whole))

    def part(self, low, high):
        """Between two shares of the strength, both ends interpolated; 0: the first row, where a cell may have left a little stress."""
        start, end = (self.at(share * self.strength, self.whole.stress) if share else 0.0 for share in (low, high))
        inner = numpy.arange(int(start) + 1, int(numpy.ceil(end)))
        ends = self.point(start), self.point(end)
        return Part(*(numpy.concatenate([[a], values[inner], [b]]) for a, values, b in zip(ends[0], self.whole, ends[1])))


# ---- moduli
def c469_points(test, lateral=False):
    """The two points of ASTM C469: at a strain of 50e-6, and at 0.4 of the strength."""
    curve = test.curve.elastic(lateral)
    low = curve.point(curve.at(GAUGE_START, curve.strain))
    high = curve.point(curve.at(WORKING * curve.strength, curve.whole.stress))
    if not high.strain > low.strain:
        raise Missing("0.4 of the strength is reached at a strain below 50e-6")
    return low, high


def chord_modulus(test):
    low, high = c469_points(test)
    return (high.stress - low.stress) / (high.strain - low.strain)


def chord_poisson(test):
    low, high = c469_points(test, lateral=True)
    return -(high.lateral - low.lateral) / (high.strain - low.strain)


def tangent(test, lateral=False):
    return test.curve.elastic(lateral).part(*TANGENT)


def secant_modulus(test):
    curve = test.curve.elastic()
    part = curve.part(0, 0.5)
    return float((part.stress[-1] - part.stress[0]) / part.strain[-1])


def straight_part(test, lateral=False):
    """(Part, low, high): the longest part between two shares of the strength, multiples of STEP, that leaves the line through its ends by
    STRAIGHT of the strength at most; of equally long ones the straightest."""
    curve, count, strength, found = test.curve.elastic(lateral), round(1 / STEP), test.curve.strength, []
    for length in range(count, round(LEAST / STEP) - 1, -1):
        for first in range(count - length + 1):
            low, high = first * STEP, (first + length) * STEP
            try:
                part = curve.part(low, high)
            except Missing:  # not measured from so low a stress on
                continue
            if part.bow <= STRAIGHT * strength:
                found.append((part.bow, part, low, high))
        if found:
            return min(found, key=lambda one: one[0])[1:]
    raise Missing(f"no part of {LEAST:g} of the strength is straight to {STRAIGHT:g} of it")


# ---- cracks
def crack_damage(test):
    """Stress where the volume is least (Pa), this over the strength, and the row."""
    curve, strength = test.curve.elastic(lateral=True), test.curve.strength
    if not numpy.isfinite(curve.volume).all():
        raise Missing("no volumetric strain was measured")
    row = int(curve.volume.argmax())
    if row == len(curve.volume) - 1:
        raise Missing("the volumetric strain does not reverse before the peak")
    if not curve.volume[row] > 0:
        raise Missing("the volume grows from the start")
    stress = float(curve.whole.stress[row])
    return stress, stress / strength, row


def crack_initiation(test):
    """(Pa, over the strength) where the crack volumetric strain, which is the volumetric strain less (1 - 2 nu) / E of the stress (Martin
    and Chandler 1994), has fallen from its largest by DEPARTED of the largest volumetric strain. E and nu: from the start to ELASTIC of the crack damage
    stress."""
    curve, (_, share, damaged) = test.curve, crack_damage(test)
    elastic, largest = curve.part(0, ELASTIC * share), curve.volume[damaged]
    cracks = curve.volume - (1 - 2 * elastic.poisson) / elastic.modulus * curve.whole.stress
    start = int(cracks[:damaged + 1].argmax())
    lost = cracks[start] - cracks[start:damaged + 1]
    if not (lost >= DEPARTED * largest).any():
        raise Missing("the crack volumetric strain departs from its largest no sooner than the volumetric strain reverses")
    stress = curve.point(start + curve.at(DEPARTED * largest, lost)).stress
    return stress, stress / curve.strength


# ---- cycles of EN 12390-13
def loadings(test):
    """[((stress, strain, time) at the lower, at the upper stress), ...]: stages that begin and end at these stresses of EN 12390-13."""
    run, curve, strength = test.run, test.curve.elastic(), test.curve.strength
    strain = run.since("axial_strain_gauge") if curve.by_gauge else run.strain
    ends = [tuple(float(column[last]) for column in (run.stress, strain, run.h["time_s"])) for _, _, last in stages_of(run)]
    within = lambda stress, limits: limits[0] <= stress / strength <= limits[1]  # noqa: E731
    found = [pair for pair in zip(ends, ends[1:]) if within(pair[0][0], LOWER) and within(pair[1][0], UPPER)]
    if len(found) < 3:
        raise Missing(f"{len(found)} stages lead from the lower stress (0.1 to 0.2 of the strength) to the upper one (a third of it); "
                      "three are needed")
    return found


def cycle_modulus(test, number):
    """Pa, secant of a loading, from 1 on."""
    low, high = loadings(test)[number - 1]
    return (high[0] - low[0]) / (high[1] - low[1])


def cycle_rate(test):
    """Pa/s, mean of the first loading."""
    low, high = loadings(test)[0]
    return (high[0] - low[0]) / (high[2] - low[2])


# ---- strength, fracture, rate
def slenderness_factor(test):
    """Of ASTM C42, by which ASTM C39 multiplies the strength of a cylinder that is less than 1.8 times as high as wide."""
    ratio = test.height / test.width
    if ratio >= SLENDER - ROUND_OFF:
        return 1.0
    if ratio < SLENDERNESS[0][0] - ROUND_OFF:
        raise Missing(f"height over diameter is {ratio:.3g}: there is no factor below {SLENDERNESS[0][0]:g}")
    if not CORRECTED[0] <= test.curve.strength <= CORRECTED[1]:
        raise Missing("the factors are for strengths of 14 to 41 MPa")
    return float(numpy.interp(ratio, *SLENDERNESS))


def fracture_type(test):
    """1 to 6 of ASTM C39, by the pattern of the summary at 0.8 of the peak (at the end, where it has none there)."""
    info, at = test.run.info, "" if test.run.info.get("pattern") else "final_"
    pattern = info.get(f"{at}pattern")
    if not pattern:
        raise Missing("the summary has no pattern of failure")
    cones = {end for end in ("top", "bottom") if number_in(info, f"{at}cone_{end}/half_angle_deg") > 0}
    if pattern == "crushing":
        damage = {end: number_in(info, f"{at}end_damage_{end}") for end in ("top", "bottom")}
        worse, other = sorted(damage, key=damage.get, reverse=True)
        if not damage[worse] >= ONE_END * damage[other]:
            raise Missing("both ends are crushed: none of the six types")
        return 6 if worse in cones else 5
    if (pattern, len(cones)) not in FRACTURES:
        raise Missing(f"the pattern is \"{pattern}\" with {len(cones)} cones: none of the six types")
    return FRACTURES[pattern, len(cones)]


def loading_rate(test):
    """Pa/s, mean between RISE of the strength."""
    part = test.curve.part(*RISE)
    return float((part.stress[-1] - part.stress[0]) / (part.time[-1] - part.time[0]))


def splitting_strength(test):
    """Pa: 2 P / (pi L d)."""
    return 2 * told(test.run, "failure_load_n", "load at failure") / (numpy.pi * test.height * test.diameter)


class Test:
    """A TestRun, its curve, and the sizes of its specimen (m)."""

    __test__ = False  # no test of pytest

    def __init__(self, run):
        self.run, self.curve = run, Curve(run)
        self._shape, self._sizes = shape_of(run.folder)

    def entry(self, path):
        if not self.run.entry(path):
            raise Missing(f"the scene has no {path}")
        return self.run.entry(path)

    @property
    def shape(self):
        if not self._shape:
            raise Missing("specimen.csv does not say the shape")
        return self._shape

    def size(self, key):
        if key not in self._sizes:
            raise Missing(f"specimen.csv does not say it: {self.shape}")
        return self._sizes[key]

    @property
    def diameter(self):
        return 2 * self.size("radius_m")

    @property
    def height(self):
        return self.size("thickness_m" if self.shape == "disc" else "height_m")

    @property
    def width(self):
        """The least across."""
        return min(self.size("width_x_m"), self.size("width_y_m")) if self.shape == "box" else self.diameter

    @property
    def area(self):
        """m2, over which stresses are."""
        told_area = number_in(self.run.info, "section/area_m2")
        return told_area if told_area > 0 else numpy.pi / 4 * self.diameter**2
