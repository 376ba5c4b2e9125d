"""Table of one cylinder by the size of its spheres, and the powers of the size that its figures go by.

Usage: sizes.py FOLDER|FILE.csv [REFERENCE], the radius (mm) that figures are set beside; 1.41. Runs are those of sizes.sh, each kept as
in runs.py. A power is the slope of ln(figure) over ln(radius), all packings of all radii; +- its standard error.
"""
import math
import pathlib
import statistics
import sys

import runs

DIAMETER = 50.0  # mm
found = runs.gather(pathlib.Path(sys.argv[1]))
reference = sys.argv[2] if len(sys.argv) > 2 else "1.41"
radii = sorted({name.split("_")[1] for name in found}, key=float, reverse=True)


def of_radius(ends, radius, what):
    """Figures of all packings of a radius; `what` is a column or takes the run."""
    some = [run for name, run in sorted(found.items()) if name.startswith(f"{ends}_{radius}_")]
    figures = [what(run) if callable(what) else run[what] for run in some]
    return [figure for figure in figures if figure is not None]


def half_angle(run):
    angles = [run[f"half_angle_{end}_deg"] for end in ("top", "bottom")]
    angles = [angle for angle in angles if angle is not None]
    return statistics.mean(angles) if angles else None


def has_cones(run):
    return 1.0 if run["pattern"] == "cones" else 0.0


def said(figures, scale=1.0):
    if not figures:
        return "-"
    figures = [scale * figure for figure in figures]
    if 1 < len(figures) < 5:  # of fewer than five packings a deviation is a guess
        return f"{min(figures):.3g} ... {max(figures):.3g}, {len(figures)} packings"
    scatter = f" +- {statistics.stdev(figures):.2g}" if len(figures) > 1 else ""
    return f"{statistics.mean(figures):.3g}{scatter}"


def power(ends, what):
    """Slope of ln(figure) over ln(radius) and its standard error; None of fewer than three runs or one radius."""
    points = [(math.log(float(radius)), math.log(figure)) for radius in radii for figure in of_radius(ends, radius, what)]
    n = len(points)
    middle = statistics.mean(x for x, _ in points) if points else 0.0
    spread = sum((x - middle) ** 2 for x, _ in points)
    if n < 3 or spread == 0:
        return None
    height = statistics.mean(y for _, y in points)
    slope = sum((x - middle) * (y - height) for x, y in points) / spread
    left = sum((y - height - slope * (x - middle)) ** 2 for x, y in points)
    return slope, math.sqrt(left / (n - 2) / spread)


def row(what, ends, column, scale=1.0, powers=True):
    words = "-"
    if powers and (found_power := power(ends, column)):
        words = f"{found_power[0]:+.3f} +- {found_power[1]:.3f}"
    cells = []
    base = of_radius(ends, reference, column)
    for radius in radii:
        figures = of_radius(ends, radius, column)
        beside = f" ({100 * (statistics.mean(figures) / statistics.mean(base) - 1):+.1f} %)" \
            if powers and figures and base and radius != reference else ""
        cells.append(said(figures, scale) + beside)
    print(f"| {what} | {' | '.join(cells)} | {words} |")


def heading():
    spheres = {radius: of_radius("dry", radius, "particles") or [0] for radius in radii}
    print("| mean radius, mm | " + " | ".join(radii) + " | power of the radius |")
    print("| --- | " + " | ".join("---" for _ in radii) + " | --- |")
    print("| across the diameter | " + " | ".join(f"{0.5 * DIAMETER / float(r):.1f}" for r in radii) + " | |")
    print("| spheres | " + " | ".join(f"{statistics.mean(spheres[r]):.0f}" for r in radii) + " | |")
    print("| packings, dry and greased | " + " | ".join(
        " and ".join(str(len(of_radius(ends, r, "strength_pa"))) for ends in ("dry", "lubricated")) for r in radii) + " | |")


heading()
row("E, GPa", "dry", "youngs_modulus_gauge_pa", 1e-9)
row("Poisson's ratio", "dry", "poisson_ratio")
row("strength, dry, MPa", "dry", "strength_pa", 1e-6)
row("strain at peak, 1e-3", "dry", "strain_at_peak_platen", 1e3)
row("strength, greased, MPa", "lubricated", "strength_pa", 1e-6)
row("damage of the worse end, dry (below .3)", "dry", "worse_end_damage", powers=False)
row("damage of the middle, dry (above .5)", "dry", "middle_damage", powers=False)
row("share with cones, dry", "dry", has_cones, powers=False)
row("half-angle of cones, degrees", "dry", half_angle, powers=False)
row("r0 of the worse end, dry", "dry", "least_base_ratio", powers=False)
row("damage of the worse end, greased (above .4)", "lubricated", "worse_end_damage", powers=False)
row("share with cones, greased", "lubricated", has_cones, powers=False)
row("r0 of the worse end, greased", "lubricated", "least_base_ratio", powers=False)
