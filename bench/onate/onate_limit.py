"""Limit of elasticity in uniaxial strain."""


def of(run):
    """Axial stress, and axial less lateral (Pa), where their difference leaves the line through 1 and 4 MPa by a tenth;
    None without such a limit. `run` is a platen.Run, None where there is none."""
    if run is None or not (run.folder / "history.csv").exists():
        return None
    columns = run.history["axial_strain_platen"], run.stress, run.history["confining_pressure_pa"]
    points = list(zip(*(column.tolist() for column in columns)))
    line = [(e, a - p) for e, a, p in points if 1e6 < a - p < 4e6]
    if len(line) < 2:
        return None
    slope = (line[-1][1] - line[0][1]) / (line[-1][0] - line[0][0])
    for e, a, p in points:
        if a - p > 4e6 and a - p < 0.9 * (line[0][1] + slope * (e - line[0][0])):
            return a, a - p
    return None
