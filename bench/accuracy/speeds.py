#!/usr/bin/env python3
"""The table of docs/theory.md, 5.3: what tells a test that was too fast, at five speeds.
Usage: speeds.py STUDY, the folder of `platen-study rate` of run.sh, study `speeds`."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import platen

COLUMNS = (
    ("wave crossings", "wave_crossings_to_peak", "{:.0f}", 1),
    ("kinetic over internal, largest", "kinetic_to_internal_max", "{:.2g}", 1),
    ("unbalanced over bond forces, median", "unbalanced_force_median", "{:.2g}", 1),
    ("inertial number, largest", "inertial_number_max", "{:.1g}", 1),
    ("strength, MPa", "strength_pa", "{:.1f}", 1e-6),
)


def found(value, key):
    """The number of that key, wherever it stands in a summary."""
    if isinstance(value, dict):
        if isinstance(value.get(key), (int, float)):
            return value[key]
        for part in value.values():
            if (number := found(part, key)) is not None:
                return number
    return None


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    rows = []
    for name, run in platen.Study(sys.argv[1]).runs.items():
        if run.status == "done":
            rows.append((float(name.split("_seed_")[0].rsplit("_", 1)[1]), run.summary))
    print("| speed, m/s | " + " | ".join(c[0] for c in COLUMNS) + " |")
    print("|" + " --- |" * (len(COLUMNS) + 1))
    for speed, summary in sorted(rows, key=lambda row: row[0]):
        cells = [text.format(factor * found(summary, key)) for _, key, text, factor in COLUMNS]
        print(f"| {speed:g} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
