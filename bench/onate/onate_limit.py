"""Limit of elasticity in uniaxial strain."""
import csv


def of(run):
    """Axial stress, and axial less lateral (Pa), where their difference leaves the line through 1 and 4 MPa by a tenth;
    None without such a run. `run` is its folder."""
    path = run / "history.csv"
    if not path.exists():
        return None
    with open(path, newline="") as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    points = [(r["axial_strain_platen"], 0.5 * (r["axial_stress_top_pa"] + r["axial_stress_bottom_pa"]), r["confining_pressure_pa"])
              for r in rows]
    line = [(e, a - p) for e, a, p in points if 1e6 < a - p < 4e6]
    if len(line) < 2:
        return None
    slope = (line[-1][1] - line[0][1]) / (line[-1][0] - line[0][0])
    for e, a, p in points:
        if a - p > 4e6 and a - p < 0.9 * (line[0][1] + slope * (e - line[0][0])):
            return a, a - p
    return None
