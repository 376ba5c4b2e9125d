#!/usr/bin/env python3
"""Every quantity that a test controls, once reached and once not: asked, reached and what is told of it.

Usage: bench/stages/asked.py BUILD/apps/platen-compress FOLDER
Some seconds to a minute a run. Finished runs are skipped."""
import json
import subprocess
import sys
from pathlib import Path

SCENES = Path(__file__).resolve().parents[2] / "tests" / "apps" / "scenes"
program, folder = sys.argv[1], Path(sys.argv[2])
folder.mkdir(parents=True, exist_ok=True)
lattice = folder / "lattice.csv"  # 4 x 4 x 8 spheres of 1 mm
lattice.write_text("# shape: box width_x_m=0.008 width_y_m=0.008 height_m=0.016\nx_m,y_m,z_m,radius_m\n" + "".join(
    f"{x / 1e3},{y / 1e3},{(2 * z + 1) / 1e3},.001\n" for z in range(8) for y in (-3, -1, 1, 3) for x in (-3, -1, 1, 3)))
LATTICE = ["exact_lattice.prm", f"Specimen/File = {lattice.resolve()}"]
SERVO = [*LATTICE, "Platens/Top/Control = stress", "Loading/Ramp = 1 ms", "Loading/Axial rate = 0.02 m/s", "Loading/Target strain = 0.001"]
CRUSHED = ["crushed.prm", "Specimen/Sphere radius = 1.6 mm", "Expect/pattern =", "Output/Every = 10", "Loading/Stop at residual = 0.5"]
SOUND = ["Bond/Tensile strength = unbreakable", "Bond/Shear strength = unbreakable"]
SKIN = [*CRUSHED, "Loading/Confinement = particles"]
CELL = [*SKIN, "Loading/Confining pressure = 3 MPa"]
SLEEVE = [*CRUSHED, "Loading/Confinement = sleeve", "Loading/Confining pressure = 3 MPa", "Sleeve/Thickness = 1 mm", "Sleeve/Modulus = 20 MPa"]
PATH = [*SKIN, "Loading/Pressure path = 0.3", "Loading/Confining pressure = 1 MPa"]
BOX = ["crushed.prm", "Expect/pattern =", "Output/Every = 10", "Specimen/Sphere radius = 1.6 mm", "Specimen/Radius =", "Specimen/Shape = box",
       "Specimen/Width x = 16 mm", "Specimen/Width y = 14 mm", "Specimen/Height = 18 mm", "Platens/Sides = six", "Loading/Stop at residual = 0", *SOUND,
       "Loading/Target strain = 0.001", "Loading/Axial rate = 0.05 m/s", "Loading/Stage 1/Axial = rate", "Loading/Stage 1/Until = strain 0.05 %"]
LED = [*CRUSHED, "Loading/Stage 1/Until = circumferential strain 1 %, strain 2 %"]
SPRING = [*LATTICE, "Loading/Axial rate = 0.002 m/s", "Platens/Stiffness = 1", "Integration/Damping = 0.7"]
WEAK = ["Bond/Tensile strength = 1 kPa", "Bond/Shear strength = 1 kPa", "Loading/Target strain = 0.002", "Loading/Stop at residual = 0"]
RUNS = {
    "stress of a platen": [*SERVO, "Platens/Top/Stress = 1 MPa", "Loading/Hold = 1 ms"],
    "stress of a platen, ramp too short": [*SERVO, "Platens/Top/Stress = 5 MPa"],
    "pressure on the skin": CELL,
    "pressure on a skin that comes loose": [*CELL, *WEAK],
    "pressure through a sleeve": [*SLEEVE, "Loading/Target strain = 0.002"],
    "pressure through a sleeve, around rubble": [*SLEEVE, *WEAK],
    "pressure on a path": PATH,
    "pressure on a path, weak bonds": [*PATH, *WEAK],
    "share of the axial stress": [*BOX, "Loading/Stage 1/Lateral = share of Axial 0.2"],
    "share, side platens too slow": [*BOX, "Loading/Stage 1/Lateral = share of Axial 1", "Loading/Stage 1/Until = time 30 us"],
    "circumferential rate": [*LED, "Loading/Stage 1/Axial = circumferential rate 2 1/s"],
    "circumferential rate beyond the platens": [*LED, "Loading/Stage 1/Axial = circumferential rate 200 1/s"],
    "rate, rigid machine": SPRING,
    "rate behind a soft machine": [*SPRING, "Platens/Machine stiffness = 1e8 N/m", "Platens/Machine mass = 0.002"],
}


def run(name):
    scene, *entries = RUNS[name]
    out = folder / name.replace(",", "").replace(" ", "_")
    if not (out / "summary.json").exists():
        entries = [*entries, "Output/Fields = off", "Checkpoint/Every = 0"]
        made = subprocess.run([program, SCENES / scene, "-o", out, "--quiet", "--overwrite", "-t", "1", *(a for e in entries for a in ("-s", e))],
                              capture_output=True, text=True)
        if made.returncode not in (0, 1):
            return None, made.stderr.strip().splitlines()[-1]
    return json.loads((out / "summary.json").read_text()), (out / "run.log").read_text()


def told(name):
    summary, log = run(name)
    if summary is None:
        return [f"| {name} | {log} | | | | | |"]
    controls = summary.get("controls") or [c for stage in summary["stages"] for c in stage["controls"]]
    null = sum(isinstance(reasons, list) and any("not reached what it asked" in r or "of the lateral surface" in r for r in reasons)
               for reasons in summary["validity"].values())
    lines = []
    for c in controls:
        unit, factor = ("MPa", 1e-6) if c["unit"] == "Pa" else (c["unit"], 1)
        lines.append(f"| {name} | {c['side']} {c['quantity']} | {factor * c['asked']:.4g} | {factor * c['reached']:.4g} {unit} | "
                     f"{'yes' if c['met'] else 'no'} | {summary['ended_by']} | {'yes' if 'has not reached what it asked' in log or 'did not settle' in log else 'no'} | {null} |")
    return lines


print("| test | controlled | asked | reached | within 1 % | ended_by | warned | figures null for it |\n| --- | --- | --- | --- | --- | --- | --- | --- |")
for test in RUNS:
    print("\n".join(told(test)), flush=True)
