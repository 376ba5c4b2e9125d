"""Mean and scatter over seeds of the scalars of run.sh, beside experiment and paper (Onate et al. 2015).
Usage: seeds.py FOLDER ... (one folder of run.sh a seed)"""
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import platen

import onate_limit

# name: what, experiment, the paper's model (MPa)
scalars = {
    "cement_ucs": ("cement, unconfined", "17 (twice tau_f)", "-"),
    "cement_brazilian": ("cement, splitting", "2.9", "3.0"),
    "cement_uniaxial_strain": ("cement, limit in uniaxial strain", "about 10", "-"),
    "concrete_ucs": ("concrete, unconfined", "37", "-"),
    "concrete_brazilian": ("concrete, splitting", "3", "-"),
    "shale_ucs": ("shale, unconfined", "50", "48"),
    "shale_brazilian": ("shale, splitting", "5.0", "5.4"),
}


def value(run, name):
    """MPa, of one run; None where it gave none, or is not there."""
    if name == "cement_uniaxial_strain":
        limit = onate_limit.of(run)
        return limit and 1e-6 * limit[1]
    strength = run.summary["strength_pa"] if run and run.status else None
    return strength and 1e-6 * strength


folders = [platen.runs(folder) for folder in sys.argv[1:]]
print("| scalar | experiment, MPa | paper's model, MPa | here, MPa | seeds |")
print("| --- | --- | --- | --- | --- |")
for name, (what, experiment, model) in scalars.items():
    values = [v for v in (value(runs.get(name), name) for runs in folders) if v is not None]
    if not values:
        continue
    here = f"{statistics.mean(values):.2f}" + (f" +- {statistics.stdev(values):.2f}" if len(values) > 4 else "")
    if 1 < len(values) < 5:  # of fewer than five packings a deviation is a guess
        here = f"{min(values):.2f} ... {max(values):.2f}"
    print(f"| {what} | {experiment} | {model} | {here} | {len(values)} |")
