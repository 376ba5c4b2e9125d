"""Mean and scatter over seeds of the scalars of run.sh, beside experiment and paper (Onate et al. 2015).
Usage: seeds.py FOLDER ... (one folder of run.sh a seed)"""
import json
import pathlib
import statistics
import sys

import onate_limit

# name: what, experiment, the paper's model (MPa)
scalars = {
    "cement_ucs": ("cement, unconfined", "17", "-"),
    "cement_brazilian": ("cement, splitting", "2.9", "3.0"),
    "cement_uniaxial_strain": ("cement, limit in uniaxial strain", "about 10", "-"),
    "concrete_ucs": ("concrete, unconfined", "32.8 to 38", "-"),
    "concrete_brazilian": ("concrete, splitting", "3", "-"),
    "shale_ucs": ("shale, unconfined", "50", "48"),
    "shale_brazilian": ("shale, splitting", "5.0", "5.4"),
}


def value(run, name):
    """MPa, of one run; None where it gave none."""
    if name == "cement_uniaxial_strain":
        limit = onate_limit.of(run)
        return limit and 1e-6 * limit[1]
    path = run / "summary.json"
    strength = json.loads(path.read_text())["strength_pa"] if path.exists() else None
    return strength and 1e-6 * strength


print("| scalar | experiment, MPa | paper's model, MPa | here, MPa | seeds |")
print("| --- | --- | --- | --- | --- |")
for name, (what, experiment, model) in scalars.items():
    values = [v for v in (value(pathlib.Path(folder) / name, name) for folder in sys.argv[1:]) if v is not None]
    if not values:
        continue
    scatter = f" +- {statistics.stdev(values):.2f}" if len(values) > 1 else ""
    print(f"| {what} | {experiment} | {model} | {statistics.mean(values):.2f}{scatter} | {len(values)} |")
