"""Failure under pressure: the line through strengths, Mohr's circles, what codes and laboratories give. Stresses in MPa. The line of a
study is that of its study.json; one is fitted here through single runs that are compared."""
import math
from collections import namedtuple

import numpy

from .house import BLACK, BLUE, CYCLE, GREEN, MPA, VERMILION, titled
from .run import number_in

LEAST_MISS = 0.05  # of the strength: a line that misses it by more is shown beside a curve


class Line(namedtuple("Line", "count low high q k error q_error k_error cohesion phi cohesion_error phi_error residual sc m")):
    """s1 = q + k s3 by least squares through `count` points over pressures from low to high, the same as Mohr-Coulomb (sin phi =
    (k - 1) / (k + 1), c = q / (2 sqrt(k)); phi in degrees), and as Hoek and Brown's curve s1 = s3 + sc sqrt(m s3 / sc + 1). Errors are
    standard errors, NaN of two points; error: of a strength about the line; residual: largest distance of the mean strength at a
    pressure from the line, over that strength. NaN: c and phi where k < 1 or q < 0; all where there are not two pressures; sc and m
    where there are not three."""

    @property
    def misses(self):
        """Whether a curve says more than the line."""
        return self.residual > LEAST_MISS and math.isfinite(self.m)

    def at(self, pressure):
        return self.q + self.k * pressure

    def curve(self, pressure):
        """Hoek and Brown's s1."""
        return pressure + self.sc * numpy.sqrt(self.m * pressure / self.sc + 1)

    @property
    def range_words(self):
        error = f"standard error {self.error:.2g} MPa" if math.isfinite(self.error) else "two points: no standard error"
        return f"fitted from {self.low:.3g} to {self.high:.3g} MPa, {error}"

    @property
    def curve_words(self):
        return f"Hoek and Brown: sc = {self.sc:.1f} MPa, m = {self.m:.1f}"


_IN_STUDY = (("pressure_low_pa", MPA), ("pressure_high_pa", MPA), ("q_pa", MPA), ("k", 1), ("residual_error_pa", MPA), ("q_error_pa", MPA),
             ("k_error", 1), ("cohesion_pa", MPA), ("friction_angle_deg", 1), ("cohesion_error_pa", MPA), ("friction_angle_error_deg", 1),
             ("largest_miss", 1), ("hoek_brown_sc_pa", MPA), ("hoek_brown_m", 1))  # as Line, behind its count


def line_of(said):
    """The Line of one of the `envelopes` of study.json, or of one of their `packings`."""
    return Line(said["runs"], *(number_in(said, key) * factor for key, factor in _IN_STUDY))


def fit_line(pressure, strength):
    """The Line through strengths at pressures (as many of both, MPa)."""
    p, s = numpy.asarray(pressure, float), numpy.asarray(strength, float)
    n, nan = len(p), math.nan
    pp = ((p - p.mean()) ** 2).sum() if n else 0
    if not pp > 0:
        return Line(n, *([nan] * 14))
    k = ((p - p.mean()) * (s - s.mean())).sum() / pp
    q = s.mean() - k * p.mean()
    error = math.sqrt(((s - q - k * p) ** 2).sum() / (n - 2)) if n > 2 else nan
    k_error, q_error = error / math.sqrt(pp), error * math.sqrt(1 / n + p.mean() ** 2 / pp)
    cohesion = phi = cohesion_error = phi_error = sc = m = nan
    if k >= 1 and q >= 0:
        root = math.sqrt(k)
        cohesion, phi = q / (2 * root), math.degrees(math.asin((k - 1) / (k + 1)))
        by_q, by_k, both = 1 / (2 * root), -q / (4 * k * root), -p.mean() * k_error**2  # derivatives of c; covariance of q and k
        cohesion_error = math.sqrt(max(0.0, (by_q * q_error) ** 2 + (by_k * k_error) ** 2 + 2 * by_q * by_k * both)) if n > 2 else nan
        phi_error = math.degrees(k_error / (root * (k + 1)))
    levels, where = numpy.unique(p, return_inverse=True)
    means = numpy.bincount(where, s) / numpy.bincount(where)
    if len(levels) > 2:  # (s1 - s3)^2 = sc^2 + m sc s3
        slope = ((p - p.mean()) * (s - p) ** 2).sum() / pp
        start = ((s - p) ** 2).mean() - slope * p.mean()
        if start > 0 and slope > 0:
            sc, m = math.sqrt(start), slope / math.sqrt(start)
    residual = numpy.abs((q + k * levels - means) / means).max()
    found = p.min(), p.max(), q, k, error, q_error, k_error, cohesion, phi, cohesion_error, phi_error, residual, sc, m
    return Line(n, *map(float, found))


NO_LINE = fit_line([], [])


def strength_en_1998_3(unconfined, pressure):
    """After Newman."""
    return unconfined * (1 + 3.7 * (pressure / unconfined) ** 0.86)


def strength_richart(unconfined, pressure):
    """Richart, Brandtzaeg and Brown 1928."""
    return unconfined + 4.1 * pressure


def strength_over_pressure(axes, points, line=NO_LINE):
    """Strengths over pressure. points: (pressure, strength) or (pressure, strength, low, high), by pressure; line: a Line."""
    for k, (pressure, strength, *ends) in enumerate(points):
        bar = [[strength - ends[0]], [ends[1] - strength]] if ends and ends[0] < ends[1] else None
        axes.errorbar(pressure, strength, bar, fmt="o", color=BLUE, capsize=3, label="strength" if k == 0 else None)
    end = 1.05 * max(point[0] for point in points)
    p, inside = numpy.linspace(0, end, 60), numpy.linspace(line.low, line.high, 60)
    if math.isfinite(line.k):
        axes.plot(inside, line.at(inside), color=BLACK, ls="--", label=f"{line.q:.1f} + {line.k:.2f} s3, {line.range_words}")
    if line.misses:
        axes.plot(inside, line.curve(inside), color=BLACK, label=line.curve_words)
    if points[0][0] == 0:
        axes.plot(p, strength_en_1998_3(points[0][1], p), color=VERMILION, label="EN 1998-3")
        axes.plot(p, strength_richart(points[0][1], p), color=GREEN, ls="--", label="Richart 1928: + 4.1 s3")
    titled(axes, "Pressure on the sides, s3 (MPa)", "Axial stress at failure, s1 (MPa)", xlim=(-0.03 * end, end))


def mohr(axes, points, line=NO_LINE):
    """Mohr's circles at failure, one unit as long on both axes, with the line as a tangent and, where it misses, the curved
    envelope. points, line: as in strength_over_pressure; circles are of the mean strengths."""
    most, radius = max(point[1] for point in points), max(0.5 * (point[1] - point[0]) for point in points)
    angle = numpy.linspace(0, math.pi, 91)
    for k, (s3, s1, *_) in enumerate(points):
        r = 0.5 * (s1 - s3)
        axes.plot(s3 + r - r * numpy.cos(angle), r * numpy.sin(angle), color=CYCLE[k % len(CYCLE)], label=f"{s3:.3g} MPa on the sides")
    if math.isfinite(line.cohesion):
        slope = math.tan(math.radians(line.phi))
        touch = 0.5 * (line.high + line.at(line.high)) - 0.5 * (line.at(line.high) - line.high) * math.sin(math.radians(line.phi))
        found = (f" +- {line.cohesion_error:.2g}", f" +- {line.phi_error:.2g}") if line.count > 2 else ("", "")
        axes.plot([0, 1.3 * touch], [line.cohesion, line.cohesion + 1.3 * slope * touch], color=BLACK, ls="--",
                  label=f"c = {line.cohesion:.1f}{found[0]} MPa, phi = {line.phi:.1f}{found[1]} degrees, {line.range_words}")
        radius = max(radius, line.cohesion + 1.3 * slope * touch)
    if line.misses:  # Balmer: normal and shear stress where the circle of s3 touches the envelope
        s3 = numpy.linspace(line.low, line.high, 60)
        s1, rise = line.curve(s3), 1 + line.m / (2 * numpy.sqrt(line.m * s3 / line.sc + 1))
        axes.plot(0.5 * (s1 + s3) - 0.5 * (s1 - s3) * (rise - 1) / (rise + 1), (s1 - s3) * numpy.sqrt(rise) / (rise + 1), color=BLACK,
                  label=line.curve_words)
    box = axes.get_position()
    across, up = box.width * axes.figure.get_figwidth(), box.height * axes.figure.get_figheight()
    titled(axes, "Normal stress (MPa), compression positive", "Shear stress (MPa)", ylim=(0, 1.02 * radius))
    axes.set_xlim(0, max(1.02 * most, axes.get_ylim()[1] * across / up))
    axes.set_ylim(0, axes.get_xlim()[1] * up / across)
    axes.set_aspect("equal")
