#!/usr/bin/env python3
"""Figures of summary.json of many runs, as a table: a row for all runs whose names differ in `_seed_N` alone, with mean +- standard deviation
over the packings, of fewer than five their range; with --median always median and range.

Usage: figures.py [--median] FOLDER KEY ...: FOLDER, a study or a folder of runs; KEY, a number (strength_pa, sleeve_deviator_pa,
acoustic/b_before, stages/-1/strain_x), in MPa or GPa where its name says _pa."""
import math
import pathlib
import re
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "python"))
import platen


def figure(found, key):
    """The number at a/b/c of a summary, NaN where it was not measured."""
    for part in key.split("/"):
        found = (found or {}).get(part) if not isinstance(found, list) else found[int(part)]
    return math.nan if found is None else found * (1e-9 if "modulus" in key else 1e-6 if key.endswith("_pa") else 1)


def words(values, median):
    values = [value for value in values if not math.isnan(value)]
    if median and values:
        return f"{statistics.median(values):.4g}, {min(values):.4g} ... {max(values):.4g} ({len(values)})"
    if len(values) > 4:
        return f"{statistics.mean(values):.4g} +- {statistics.stdev(values):.2g}"
    return " ... ".join(f"{value:.4g}" for value in sorted({min(values), max(values)})) + f" ({len(values)})" if values else "-"


if __name__ == "__main__":
    folder, *keys = [word for word in sys.argv[1:] if word != "--median"] or [""]
    if not keys:
        sys.exit(__doc__)
    rows, inside = {}, pathlib.Path(folder, "runs")
    for name, run in platen.runs(inside if inside.is_dir() else folder).items():
        if run.status:
            rows.setdefault(re.sub(r"_seed_\d+$", "", name), []).append(run.summary)
    print(f"| run | {' | '.join(keys)} |\n|" + " --- |" * (len(keys) + 1))
    for name, found in rows.items():
        print(f"| {name} | " + " | ".join(words([figure(summary, key) for summary in found], "--median" in sys.argv) for key in keys) + " |")
