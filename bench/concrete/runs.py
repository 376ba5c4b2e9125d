"""What the table of one concrete takes from its runs: one line each, kept in FOLDER/runs.csv when their folders are gone."""
import csv
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import platen

OF_SUMMARY = ("strength_pa", "strain_at_peak_platen", "youngs_modulus_gauge_pa", "poisson_ratio", "bulk_modulus_pa",
              "constrained_modulus_pa", "lateral_over_axial_stress", "worse_end_damage", "middle_damage",
              "energy_residual_relative", "platen_unbalanced_work_relative")
OF_CONES = ("least_base_ratio", "half_angle_top_deg", "half_angle_bottom_deg", "final_half_angle_top_deg",
            "final_half_angle_bottom_deg")
OF_HISTORY = ("left_at_1.45", "left_at_0.0345", "least_volume_percent", "volume_at_peak_percent")
COLUMNS = ("run", "version", "particles", "pattern") + OF_SUMMARY + OF_CONES + OF_HISTORY
TEXT = COLUMNS[:2] + ("pattern",)


def cones(s):
    figures = {}
    zones = [s.get(f"dead_zone_{end}") for end in ("top", "bottom")]
    if any(zones):
        figures["least_base_ratio"] = min((zone or {}).get("base_ratio") or 0.0 for zone in zones)
    for state in ("", "final_"):
        for end in ("top", "bottom"):
            cone = s.get(f"{state}cone_{end}")
            figures[f"{state}half_angle_{end}_deg"] = cone["half_angle_deg"] if cone else None
    return figures


def under_pressure(run):
    """Of a test in the sleeve: what is left of the deviator at 1.45 times the strain at peak, and at a strain of 3.45e-2, over
    the largest, none where the run ends before; and the volume inside of the sleeve, %, larger positive, from the bare specimen.
    Strains count from the end of the consolidation. One that flows has no peak: its strength here is the largest stress."""
    s, rows = run.summary, run.history.records()
    peak = max(range(len(rows)), key=lambda i: rows[i]["deviator_pa"])
    start = next(row for row in rows if row["time_s"] >= s["consolidation_end_time_s"])["axial_strain_platen"]
    at_peak = s["strain_at_peak_platen"]

    def left(strain):
        later = [row["deviator_pa"] for row in rows[peak:] if row["axial_strain_platen"] >= start + strain]
        return later[0] / rows[peak]["deviator_pa"] if later else None

    volumes = [-100 * row["volumetric_strain_sleeve"] for row in rows]
    return {"strength_pa": s["largest_stress_pa"] if s["strength_pa"] is None else s["strength_pa"],
            "left_at_1.45": left(1.45 * at_peak) if at_peak is not None else None, "left_at_0.0345": left(0.0345),
            "least_volume_percent": min(volumes[:peak + 1]), "volume_at_peak_percent": volumes[peak]}


def figures(name, run):
    """Of a finished run."""
    found = {"run": name, **{key: run.summary.get(key) for key in COLUMNS[1:]}, **cones(run.summary)}
    if name.startswith("triaxial_") and not name.startswith("triaxial_0_"):
        found.update(under_pressure(run))
    return found


def read(path):
    with open(path) as file:
        return {row["run"]: {k: v if k in TEXT else float(v) if v else None for k, v in row.items()}
                for row in csv.DictReader(file)}


def write(path, runs):
    def said(value):
        return "" if value is None else value if isinstance(value, str) else f"{value:.7g}"

    with open(path, "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(COLUMNS)
        for name in sorted(runs):
            table.writerow([said(runs[name][column]) for column in COLUMNS])


def gather(where):
    """{name: figures} of a file of runs, or of a folder: its runs.csv and its finished runs, which are added to that file."""
    if where.is_file():
        return read(where)
    kept = where / "runs.csv"
    runs = read(kept) if kept.exists() else {}
    for name, run in platen.runs(where).items():
        if run.status == "done":
            runs[name] = figures(name, run)
    write(kept, runs)
    return runs
