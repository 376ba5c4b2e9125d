"""Table of the runs of run.sh beside experiment and paper (Onate et al. 2015). Usage: table.py FOLDER"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import platen

import onate_limit

runs = platen.runs(sys.argv[1])
# Figures that the paper prints as numbers: experiment, the paper's model (MPa).
published = {
    "concrete_ucs": ("37", ""),
    "concrete_brazilian": ("3", ""),
    "shale_ucs": ("50", "48"),
    "shale_brazilian": ("5.0", "5.4"),
    "cement_ucs": ("17", ""),
    "cement_brazilian": ("2.9", "3.0"),
}


def summary(name):
    return runs[name].summary if name in runs and runs[name].status else None


def number(value, scale=1.0, digits=2):
    return "-" if value is None else f"{value * scale:.{digits}f}"


print("| test | spheres | strength MPa | experiment, paper | strain at peak % | E GPa, nu | broken t, s of bonds | residual | seconds |")
print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
for name in runs:
    s = summary(name)
    if s is None:
        continue
    experiment, model = published.get(name, ("", ""))
    print(
        f"| {name} | {s['particles']} | {number(s['strength_pa'], 1e-6)} | {experiment}{', ' if model else ''}{model} | "
        f"{number(s['strain_at_peak_platen'], 100)} | {number(s['youngs_modulus_gauge_pa'], 1e-9, 1)}, "
        f"{number(s['poisson_ratio'], 1, 3)} | {s['broken_tension']}, {s['broken_shear']} of {s['bonds']} | "
        f"{number(s['energy_residual_relative'], 1, 5)} | {s['wall_seconds']:.0f} |"
    )

print("\nOne set of limits for all pressures (8.5, 9, 11 MPa) against the paper's set for each:")
for psi in (500, 1000, 2000, 4000):
    fitted, one = summary(f"cement_{psi}psi"), summary(f"cement_{psi}psi_one_set")
    if fitted and one:
        a, b = fitted["strength_pa"], one["strength_pa"]
        if a is None or b is None:
            print(f"  {psi} psi: no strength measured")
            continue
        print(f"  {psi} psi: {a * 1e-6:.1f} MPa fitted, {b * 1e-6:.1f} MPa with one set, {100 * (b / a - 1):+.1f} %")

if summary("cement_500psi"):
    print("\nCement at 500 psi, broken interfaces by axial strain:")
    rows = runs["cement_500psi"].history.records()
    for strain in (0.0128, 0.0155, 0.018, 0.02):
        near = min(rows, key=lambda row: abs(row["axial_strain_platen"] - strain))
        print(f"  {100 * near['axial_strain_platen']:.2f} %: {near['broken_tension'] + near['broken_shear']:.0f}")

limit = onate_limit.of(runs.get("cement_uniaxial_strain"))
if limit:
    axial, difference = limit
    print(f"\nCement, uniaxial strain: leaves its line at {axial * 1e-6:.1f} MPa axial, {difference * 1e-6:.1f} MPa difference (experiment about 10 MPa)")
