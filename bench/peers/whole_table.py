#!/usr/bin/env python3
"""Tables of the runs that whole.sh listed in OUT/runs.csv: seconds and their ratios, then what both programs measured on the
same specimen, found by the same rules from the histories of both. Writes OUT/whole.csv too, a row for each run.
Usage: whole_table.py OUT"""
import collections
import csv
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import platen

BONDS_MAY_DIFFER = 1e-3  # of each other: two programs round the same rule
UNDISTURBED = 0.9  # processor seconds over seconds; a program that got less waited for others


def told(out, run):
    """A row of runs.csv with what the run found."""
    folder = f"{out}/{run['folder']}"
    results = platen.Run(folder)  # Yade's as well: yade_test.py writes the same files
    summary = results.summary
    curve = list(zip(results.history["axial_strain_platen"].tolist(), results.stress.tolist()))
    if run["program"] == "platen":
        summary["step_seconds"] = summary["wall_seconds"] - summary["setup_seconds"]
        summary["broken"] = summary["broken_tension"] + summary["broken_shear"]
    strain, strength = max(curve, key=lambda point: point[1])
    if summary["ended_by"] != "stop at residual" or curve[-1][1] > 0.9 * strength or not summary["broken"]:
        sys.exit(f"{folder}: no fall after a peak (ended by \"{summary['ended_by']}\"): the seconds do not compare")
    rise = [point for point in curve[:curve.index((strain, strength))] if 0.1 * strength < point[1] < 0.4 * strength]
    modulus = (rise[-1][1] - rise[0][1]) / (rise[-1][0] - rise[0][0])
    row = {k: run[k] for k in ("program", "threads", "pair", "memory_mb")}
    row.update(seconds=float(run["seconds"]), processor_seconds=float(run["processor_seconds"]), step_seconds=summary["step_seconds"], steps=summary["steps"],
               particles=summary["particles"], bonds=summary["bonds"], time_step_s=summary["time_step_s"],
               strength_pa=strength, strain_at_peak=strain, modulus_pa=modulus, broken=summary["broken"],
               strain_at_end=curve[-1][0], stress_at_end_pa=curve[-1][1])
    if run["program"] == "platen":
        row.update(instruction_set=summary["instruction_set"], version=summary["version"])
    return row


def check(platen, yade):
    if platen["particles"] != yade["particles"] or \
            abs(platen["bonds"] - yade["bonds"]) > BONDS_MAY_DIFFER * platen["bonds"]:
        sys.exit("particles and bonds differ, the seconds do not compare: %s, %s" % (platen, yade))


def per_step(row):
    return row["step_seconds"] / row["steps"]


def print_seconds(pairs):
    print("| threads | pair | Platen, s | of it steps | of processors | Yade, s | of it steps | of processors "
          "| **Yade over Platen** | of one step | of processors | Platen, MB | Yade, MB |")
    print("| --- " * 13 + "|")
    ratios = collections.defaultdict(list)
    for (threads, pair), both in sorted(pairs.items()):
        p, y = both["platen"], both["yade"]
        of = (y["seconds"] / p["seconds"], per_step(y) / per_step(p), y["processor_seconds"] / p["processor_seconds"])
        ratios[threads].append(of)
        print("| %d | %d | %.2f | %.2f | %.2f | %.1f | %.1f | %.1f | **%.1f** | %.1f | %.1f | %s | %s |" % (
            threads, pair, *(r[k] for r in (p, y) for k in ("seconds", "step_seconds", "processor_seconds")), *of,
            p["memory_mb"], y["memory_mb"]))
    for threads, values in sorted(ratios.items()):
        if len(values) > 1:
            print("| %d | median | | | | | | | **%.1f** | %.1f | %.1f | | |" % (
                threads, *map(statistics.median, zip(*values))))


def print_disturbed(rows):
    shares = [(r["processor_seconds"] / r["seconds"], r) for r in rows]
    waited = ["%s with %s threads %.0f %%" % (r["program"].capitalize(), r["threads"], 100 * share)
              for share, r in shares if share < UNDISTURBED]
    if waited:
        print("\n**Other work on the machine took its processors: of one of them, %s. Seconds do not compare then; on one thread "
              "those of processors do.**" % ", ".join(waited))


def print_measured(pairs):
    print("| threads | pair | | strength, MPa | strain at peak | Young's modulus, GPa | broken bonds | steps | strain at end |")
    print("| --- " * 9 + "|")
    for (threads, pair), both in sorted(pairs.items()):
        for name in ("platen", "yade"):
            r = both[name]
            print("| %d | %d | %s | %.2f | %.5f | %.2f | %d | %d | %.5f |" % (
                threads, pair, name.capitalize(), r["strength_pa"] / 1e6, r["strain_at_peak"], r["modulus_pa"] / 1e9,
                r["broken"], r["steps"], r["strain_at_end"]))


def main():
    out = sys.argv[1]
    with open(f"{out}/runs.csv") as file:
        rows = [told(out, run) for run in csv.DictReader(file)]
    pairs = collections.defaultdict(dict)  # (threads, pair) -> program -> row
    for row in rows:
        pairs[int(row["threads"]), int(row["pair"])][row["program"]] = row
    for both in pairs.values():
        check(both["platen"], both["yade"])
    with open(f"{out}/whole.csv", "w", newline="") as file:
        table = csv.DictWriter(file, rows[0].keys(), restval="")
        table.writeheader()
        table.writerows(rows)
    p, y = pairs[min(pairs)]["platen"], pairs[min(pairs)]["yade"]
    print("- %s" % p["version"])
    print("- kernels of Platen: %s; step %.4g s in both\n" % (p["instruction_set"], y["time_step_s"]))
    print("%d particles; bonds: Platen %d, Yade %d.\n" % (p["particles"], p["bonds"], y["bonds"]))
    print_seconds(pairs)
    print_disturbed(rows)
    print("\nSeconds from command to prompt. The rest of the steps' is start, reading, bonding and the last "
          "files. Of one step: seconds of the steps over their number, Yade over Platen. Of processors: their time in user and "
          "system, which other work on the machine disturbs less.\n")
    print_measured(pairs)
    print("\nModulus: slope between a tenth and four tenths of the strength.")


main()
