"""Table of the runs of run.sh. Usage: table.py FOLDER"""
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import platen

folder = pathlib.Path(sys.argv[1])
laws = ("parallel_bond", "cohesive_beam", "elasto_damage_plastic")


def summaries(law, pulled):
    found = platen.runs(folder, f"{law}_*")
    return [run.summary for name, run in found.items() if name.endswith("_tension") == pulled and run.status]


def figure(all_of, key, scale=1.0, digits=2):
    values = [scale * s[key] for s in all_of if s[key] is not None]
    if not values:
        return "-"
    if 1 < len(values) < 5:  # of fewer than five packings a deviation is a guess
        return f"{min(values):.{digits}f} ... {max(values):.{digits}f}, {len(values)} packings"
    scatter = f" +- {statistics.stdev(values):.{digits}f}" if len(values) > 1 else ""
    return f"{statistics.mean(values):.{digits}f}{scatter}"


print("| | " + " | ".join(law.replace("_", " ") for law in laws) + " |")
print("| --- | --- | --- | --- |")
pressed = {law: summaries(law, False) for law in laws}
pulled = {law: summaries(law, True) for law in laws}
rows = [
    ("bonds", pressed, "bonds", 1, 0),
    ("compressive strength, MPa", pressed, "strength_pa", 1e-6, 1),
    ("strain at the peak, %", pressed, "strain_at_peak_platen", 100, 3),
    ("E (gauge), GPa", pressed, "youngs_modulus_gauge_pa", 1e-9, 1),
    ("Poisson's ratio", pressed, "poisson_ratio", 1, 3),
    ("tensile strength, MPa", pulled, "strength_pa", 1e-6, 2),
    ("broken in tension", pressed, "broken_tension", 1, 0),
    ("broken in shear", pressed, "broken_shear", 1, 0),
    ("end damage, top, at 0.8 of the peak", pressed, "end_damage_top", 1, 2),
    ("end damage, bottom", pressed, "end_damage_bottom", 1, 2),
    ("middle damage", pressed, "middle_damage", 1, 2),
    ("end spread", pressed, "end_spread", 1, 2),
    ("energy residual over work", pressed, "energy_residual_relative", 1, 5),
    ("steps to the end", pressed, "steps", 1, 0),
    ("seconds (one thread)", pressed, "wall_seconds", 1, 0),
]
for title, of, key, scale, digits in rows:
    print(f"| {title} | " + " | ".join(figure(of[law], key, scale, digits) for law in laws) + " |")
