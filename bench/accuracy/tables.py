#!/usr/bin/env python3
"""The tables of docs/accuracy.md: what each knob of a study errs by and costs.
Usage: tables.py STUDY..., folders of `platen-study accuracy` of run.sh. A row of a table differs from the scene in one entry; errors
are against the last row on the same seed, mean +- standard deviation over the seeds; in the last row, in brackets, the
scatter of the seeds. Below each: what an accuracy costs, by the root mean square over the seeds of a row and all finer ones."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import platen

ERRORS = (("strength", "strength"), ("strain at peak", "strain_at_peak"), ("E", "modulus"), ("broken bonds", "broken_bonds"))


def percent(value, sign="+"):
    if value == 0:
        return "0"
    digits = 3 if abs(value) < 1e-4 else 2 if abs(value) < 5e-3 else 1 if abs(value) < 0.1 else 0
    return f"{100 * value:{sign}.{digits}f}"


def cells_of(value, knob, seconds, last):
    cells = [value["value"]]
    for _, key in ERRORS:
        error = value["errors"][key]
        scatter = knob["scatter_of_seeds"][key]
        if last:
            cells.append("-" if scatter is None else f"({percent(scatter, '')})")
        elif not error["runs"]:
            cells.append("-")
        else:
            exact = error["mean"] == error["deviation"] == 0
            spread = "" if exact else f" +- {percent(error['deviation'], '')}" if error["runs"] > 1 else " (1)"
            cells.append(percent(error["mean"]) + spread)
    for key in ("energy_residual_relative", "kinetic_to_internal_max"):
        cells.append(f"{value[key]['mean']:.1e}".replace("e-0", "e-") if value[key]["runs"] else "-")
    cells.append(f"{value['steps']['mean']:,.0f}".replace(",", " ") if value["steps"]["runs"] else "-")
    cells.append(f"{seconds['mean']:.1f}" if seconds and seconds["runs"] else "-")
    return cells


def price(knob, prices):
    """What it costs to be within 5, 2, 1 and .1 %."""
    said = []
    for of, name in (("strength", "strength"), ("modulus", "E")):
        mine = [p for p in prices if p["knob"] == knob["knob"] and p["of"] == of]
        if mine:
            said.append(name + ": " + ", ".join(
                f"{100 * p['within']:g} % " + (f"{p['seconds']:.1f} s ({p['value']})" if p["seconds"] else "not reached")
                for p in mine))
    return "; ".join(said)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    for folder in sys.argv[1:]:
        study = platen.Study(folder).summary
        print(f"## {pathlib.Path(folder).name}, {len(study['seeds'])} seeds\n")
        for knob in study["accuracy"]:
            unit = f", {knob['unit']}" if knob["unit"] else ""
            head = f"`{knob['entry']}`{unit}" if knob["ordered"] else "change"
            print(f"| {head} | " + " | ".join(f"{name}, %" for name, _ in ERRORS) +
                  " | energy residual | kinetic over internal | steps | seconds |")
            print("|" + " --- |" * 9)
            for k, value in enumerate(knob["values"]):
                seconds = next((s for s in study["costs"]["wall_seconds"]
                                if s["knob"] == knob["knob"] and s["value"] == value["value"]), None)
                print("| " + " | ".join(cells_of(value, knob, seconds, k + 1 == len(knob["values"]))) + " |")
            if said := price(knob, study["costs"]["prices"]):
                print("\n" + said)
            print()


if __name__ == "__main__":
    main()
