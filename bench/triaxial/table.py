"""Table of the runs of run.sh. Usage: table.py FOLDER"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import platen

runs = platen.runs(sys.argv[1])
pressures = ("0", "1.5", "4.5", "9", "30", "60")


def figures(law, kind, pressure):
    """Strength (MPa), strain there (%), last over largest deviator, cracks at the peak and at the end, and the rest."""
    run = runs.get(f"{law}_{'none' if pressure == '0' else kind}_{pressure}")
    if run is None or not run.status:
        return None
    summary, rows = run.summary, run.history.records()
    stress = [0.5e-6 * (row["axial_stress_top_pa"] + row["axial_stress_bottom_pa"]) for row in rows]
    cell = float(pressure)
    deviator = [s - row["confining_pressure_pa"] * 1e-6 for s, row in zip(stress, rows)]
    peak = max(range(len(rows)), key=lambda k: deviator[k])
    last = rows[-1]
    tail = deviator[int(0.97 * len(deviator)) :]
    return {
        "strength": deviator[peak] + cell,
        "strain": 100 * summary["strain_at_peak_platen"],
        "residual": sum(tail) / len(tail) / deviator[peak],
        "last strain": 100 * last["axial_strain_platen"],
        "cracks at peak": rows[peak]["broken_tension"] + rows[peak]["broken_shear"],
        "tension": last["broken_tension"],
        "shear": last["broken_shear"],
        "modulus": 1e-9 * (summary["youngs_modulus_gauge_pa"] or 0),
        "book": summary["energy_residual_relative"],
        "sleeve": 1e-6 * last.get("sleeve_deviator_pa", 0),
        "volume": 100 * last["volumetric_strain"],
        "volume in sleeve": 100 * last.get("volumetric_strain_sleeve", float("nan")),
        "seconds": summary["wall_seconds"],
        "steps": summary["steps"],
    }


for law in ("parallel_bond", "elasto_damage_plastic"):
    plain = figures(law, "none", "0")
    if plain is None:
        continue
    fc = plain["strength"]
    print(f"## {law.replace('_', ' ')}\n")
    print(
        "| cell, MPa | by | strength, MPa | (strength - fc)/p | Richart fc + 4.1 p | strain at peak, % | last over peak"
        " | cracks to the peak | at the end: tension, shear | E, GPa | volumetric strain, %: gauge, sleeve"
        " | sleeve's share, MPa | book | steps, s |"
    )
    print("| --- " * 14 + "|")
    for pressure in pressures:
        for kind in ("sleeve", "particles"):
            f = figures(law, kind, pressure)
            if f is None or (pressure == "0" and kind == "particles"):
                continue
            p = float(pressure)
            gain = f"{(f['strength'] - fc) / p:.2f}" if p else "-"
            print(
                f"| {pressure} | {kind if p else 'none'} | {f['strength']:.1f} | {gain} | {fc + 4.1 * p:.0f}"
                f" | {f['strain']:.2f} | {f['residual']:.2f} | {f['cracks at peak']:.0f}"
                f" | {f['tension']:.0f}, {f['shear']:.0f} | {f['modulus']:.1f}"
                f" | {f['volume']:.2f}, {f['volume in sleeve']:.2f} | {f['sleeve']:.3f} | {f['book']:.1e}"
                f" | {f['steps']}, {f['seconds']:.0f} |"
            )
    print()
