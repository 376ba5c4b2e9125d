#!/usr/bin/env python3
"""How well and how cheaply `platen-study target` keeps what it is ordered (docs/accuracy.md, "Accuracy on order").

Usage: target.py BUILD FOLDER [--only small|cylinder|gain ...] [--repetitions 20] [--accuracy 2 5] [--seeds 15] [-t 2] [--plot PNG] [--tables]

For each subject: (a) reference runs over seeds and speeds (--seeds packings at 15, 30, 60 and 120 wave crossings, of a gain both
scenes), whose line through 1 / N is the truth, with an interval of its own; (b) so many repetitions of each order, on seeds far
apart; (c) what one slow speed would cost for the same accuracy, by the variances and the haste of the reference runs.
All orders of one repetition share its runs: a run of the same seed, speed and scene is the same to the byte, and an order counts each run
that it asks for, whoever made it. Prints a table, leaves it in FOLDER/target.md and draws orders against costs. What is done is kept:
call it again after a stop; --tables runs nothing and tells what is there.
"""
import argparse
import math
import pathlib
import shutil
import statistics
import subprocess
import sys

import numpy
from matplotlib import pyplot

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import platen

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"
SPEEDS = "15, 30, 60, 120"
SUBJECTS = {
    # name: (scene, entries of all its runs, entries of the scene that a gain is over, accuracies)
    "small": ("study_quality_concrete", ["Study/Quality list ="], None, [0.05, 0.04]),
    "cylinder": ("study_target_cylinder", [], None, [0.02, 0.05, 0.01]),
    "gain": ("study_target_gain", [], ["Platens/Friction static = 0"], [0.03]),
}
CONFIDENCE = 0.9
QUANTILE = statistics.NormalDist().inv_cdf(0.5 + CONFIDENCE / 2)
PACKING_STEPS = 3000  # as apps/study/target_figures.cc


def study(build, kind, scene, folder, entries, threads, accuracy=None):
    """Makes a study, or goes on with it; one that has ended, of a target with this accuracy, is left."""
    summary = folder / "study.json"
    if summary.exists():
        left = platen.Study(folder).summary
        if left.get("status") == "done" and left.get("target", {}).get("accuracy") == accuracy:
            return
    command = [str(build / "apps/platen-study"), kind, str(SCENES / f"{scene}.prm"), "-o", str(folder), "-t", str(threads), "--quiet"]
    for entry in entries:
        command += ["-s", entry]
    if folder.exists():
        command.append("--resume" if summary.exists() else "--overwrite")
    status = subprocess.run(command).returncode
    if status not in (0, 1):  # 1: not as accurate as ordered, or an expectation
        raise SystemExit(f"{' '.join(command)}: exit status {status}")


def rows_of(folder):
    """By (wave crossings, seed): strength, steps times spheres, seconds."""
    found = platen.Study(folder)
    return {(row["wave_crossings"], int(row["seed"])): (row["strength_pa"], cost["steps"] * row["particles"], cost["wall_seconds"],
                                                        row["particles"])
            for row, cost in zip(found.table.records(), found.costs.records())}


def spread_of(logs):
    """Variances of packings and of chaos, by analysis of variance of packings that have all speeds."""
    speeds = sorted({n for n, _ in logs})
    whole = [s for s in sorted({s for _, s in logs}) if all((n, s) in logs for n in speeds)]
    table = numpy.array([[logs[n, s] for n in speeds] for s in whole])
    left = table - table.mean(axis=0) - table.mean(axis=1, keepdims=True) + table.mean()
    chaos = (left**2).sum() / ((len(whole) - 1) * (len(speeds) - 1))
    return max(0, table.mean(axis=1).var(ddof=1) - chaos / len(speeds)), chaos


def truth_of(logs, spread):
    """Generalised least squares of m + b / N: m, its standard error, b."""
    speed, seed = numpy.array(list(logs)).T
    weights = numpy.linalg.inv(spread[0] * (seed[:, None] == seed) + spread[1] * numpy.eye(len(seed)))
    x = numpy.stack([numpy.ones(len(speed)), 1 / speed], axis=1)
    covariance = numpy.linalg.inv(x.T @ weights @ x)
    mean, slope = covariance @ x.T @ weights @ numpy.array(list(logs.values()))
    return mean, math.sqrt(covariance[0, 0]), slope


def logs_of(tables):
    """Logarithms of the strength by (wave crossings, seed), of a gain of the ratio; runs that never peaked are left out."""
    return {k: math.log(tables[0][k][0]) - (math.log(tables[1][k][0]) if len(tables) > 1 else 0)
            for k in tables[0] if all(k in t and t[k][0] > 0 for t in tables)}


def reference(build, folder, subject, seeds, threads):
    """Runs of --seeds packings at all speeds: the truth by them, how they scatter, and what one costs."""
    scene, entries, over, _ = SUBJECTS[subject]
    entries = entries + [f"Study/Seeds = {seeds}", f"Study/Wave crossings list = {SPEEDS}", "Checkpoint/Every = 0"]
    tables = []
    for name, more in (("reference", []), ("reference_over", over)):
        if more is None:
            continue
        if build:
            study(build, "accuracy", scene, folder / f"{subject}_{name}", entries + more, threads)
        tables.append(rows_of(folder / f"{subject}_{name}"))
    speeds = sorted({n for n, _ in tables[0]})
    logs = logs_of(tables)
    spread = spread_of(logs)
    mean, error, slope = truth_of(logs, spread)
    cost = [sum(statistics.fmean(t[k][1] for k in t if k[0] == n) for t in tables) for n in speeds]
    spheres = statistics.fmean(t[k][3] for t in tables for k in t)
    return {"mean": mean, "error": error, "slope": slope, "logs": logs, "spread": spread, "runs": sum(len(t) for t in tables),
            "deviation": math.sqrt(sum(spread)), "fastest": speeds[0], "steps": numpy.polyfit(speeds, cost, 1)[::-1], "packing": PACKING_STEPS * spheres}


def one_slow_speed(truth, accuracy):
    """Crossings, packings and steps times spheres of the cheapest runs at one speed, no haste taken off, all known beforehand."""
    normal, best = statistics.NormalDist(), None
    for packings in range(2, 1000):
        deviation = truth["deviation"] / math.sqrt(packings)

        def within(bias):
            return normal.cdf((accuracy - bias) / deviation) - normal.cdf((-accuracy - bias) / deviation)

        if within(0) < CONFIDENCE:
            continue
        low, high = 0.0, accuracy
        for _ in range(40):
            middle = (low + high) / 2
            low, high = (low, middle) if within(middle) < CONFIDENCE else (middle, high)
        crossings = max(truth["fastest"], abs(truth["slope"]) / low)
        steps = packings * (truth["steps"][0] + truth["steps"][1] * crossings + truth["packing"])
        if best is None or steps < best[2]:
            best = (crossings, packings, steps)
    return best


def name_of(subject, accuracy, number):
    return f"{subject}_{100 * accuracy:g}_{number:02d}"


def order(build, folder, subject, accuracy, number, threads):
    """One repetition, in the folder of its runs; its study.json and what its table has are kept apart."""
    kept = folder / "orders" / name_of(subject, accuracy, number)
    if (kept / "study.json").exists():
        return
    scene, entries, _, _ = SUBJECTS[subject]
    here = folder / f"{subject}_{number:02d}"
    study(build, "target", scene, here,
          entries + [f"Scene/Seed = {100000 + 10000 * number}", f"Study/Target/Accuracy = {100 * accuracy:g} %",
                     f"Study/Wave crossings list = {SPEEDS}", "Study/Target/Most runs = 1000", "Checkpoint/Every = 0"], threads, accuracy)
    kept.mkdir(parents=True, exist_ok=True)
    for name in ("study.csv", "costs.csv", "study.json"):  # the last says that all are there
        shutil.copy(here / name, kept / name)


def tables_of(folder, over):
    """Rows of an order; of a gain those of both scenes."""
    tables = {False: {}, True: {}}
    for row in platen.Study(folder).table.records():
        tables[row["case"].startswith("over_")][row["wave_crossings"], int(row["seed"])] = (row["strength_pa"],)
    return [tables[False], tables[True]] if over else [tables[False]]


def measure(folder, subject, accuracy, truth, repetitions):
    """Of the repetitions that are there. The truth of each: by the reference and by all runs of the other repetitions."""
    orders = [folder / "orders" / name_of(subject, accuracy, k) for k in range(repetitions)]
    studies = {k: platen.Study(o).summary for k, o in enumerate(orders) if (o / "study.json").exists()}
    if not studies:
        return None
    all_logs = {}
    for k in range(repetitions):
        all_logs[k] = {}
        for o in sorted((folder / "orders").glob(f"{subject}_*_{k:02d}")):
            all_logs[k].update(logs_of(tables_of(o, SUBJECTS[subject][2])))
    pooled, alone, errors, truths = 0, 0, [], []
    for k, s in studies.items():
        others = dict(truth["logs"])
        for other, logs in all_logs.items():
            others.update(logs if other != k else {})
        mean, error, _ = truth_of(others, truth["spread"])
        errors.append(math.log(s["target"]["mean"]) - mean)
        truths.append(error)
        pooled += abs(errors[-1]) <= s["target"]["half_interval"]
        alone += abs(math.log(s["target"]["mean"]) - truth["mean"]) <= s["target"]["half_interval"]
    targets = [s["target"] for s in studies.values()]
    return {"subject": subject, "accuracy": accuracy, "repetitions": len(studies), "held": pooled, "held_alone": alone,
            "truth_error": statistics.fmean(truths), "half": statistics.fmean(t["half_interval"] for t in targets),
            "error": math.sqrt(statistics.fmean(e * e for e in errors)), "runs": statistics.fmean(s["runs"] for s in studies.values()),
            "steps": statistics.fmean(t["sphere_steps"] for t in targets),
            "pilot": statistics.fmean(t["looks"][0]["sphere_steps"] for t in targets), "slow": one_slow_speed(truth, accuracy),
            "blind": statistics.fmean(t["one_slow_speed_after_pilot"]["sphere_steps"] for t in targets)}


def text_of(truths, results, rate):
    text = ""
    for subject, t in truths.items():
        unit = math.exp(t["mean"]) * (1 if SUBJECTS[subject][2] else 1e-6)
        text += (f"{subject}: {t['runs']} reference runs, {unit:.4g} +- {100 * QUANTILE * t['error']:.2g} % (90 %), haste b {t['slope']:.2g}, "
                 f"packings scatter by {100 * math.sqrt(t['spread'][0]):.2g} %, chaos {100 * math.sqrt(t['spread'][1]):.2g} %\n")
    text += (f"seconds of one core: steps x spheres times {1e9 * rate:g} ns\n\n| order | held (by the reference alone) | truth, +- % | interval, "
             "+- % | root mean square error, % | runs | seconds (first batch) | one slow speed, all known: crossings x packings | its seconds | order "
             "over it | one slow speed after the same first batch, seconds | order over it |\n|" + " --- |" * 12 + "\n")
    for r in results:
        n, packings, steps = r["slow"]
        text += (f"| {r['subject']} {100 * r['accuracy']:g} % | {r['held']} ({r['held_alone']}) of {r['repetitions']} | "
                 f"{100 * QUANTILE * r['truth_error']:.2g} | {100 * r['half']:.2g} | {100 * r['error']:.2g} | {r['runs']:.1f} | {rate * r['steps']:.0f} "
                 f"({rate * r['pilot']:.0f}) | {n:.0f} x {packings} | {rate * steps:.0f} | {r['steps'] / steps:.2f} | {rate * r['blind']:.0f} | "
                 f"{r['steps'] / r['blind']:.2f} |\n")
    return text


def draw(results, png, rate):
    """Accuracies against seconds."""
    figure, axes = pyplot.subplots(figsize=(10, 6.4))
    for colour, subject in enumerate(dict.fromkeys(r["subject"] for r in results)):
        mine = sorted((r for r in results if r["subject"] == subject), key=lambda r: r["accuracy"])
        for name, steps, style in (("on order", [r["steps"] for r in mine], "o-"), ("one slow speed, all known", [r["slow"][2] for r in mine], "o:"),
                                   ("one slow speed, same first batch", [r["blind"] for r in mine], "s--")):
            axes.plot([rate * s for s in steps], [100 * r["accuracy"] for r in mine], style, color=f"C{colour}", label=f"{subject}, {name}")
    axes.set(xscale="log", yscale="log", xlabel="Seconds of one core", ylabel="Accuracy that is ordered (%)", ylim=(0.7, 10))
    axes.grid()
    axes.legend()
    figure.savefig(png, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--only", nargs="+", choices=SUBJECTS, default=["cylinder", "gain"])
    parser.add_argument("--repetitions", type=int, default=20)
    parser.add_argument("--accuracy", nargs="+", type=float, metavar="PERCENT", help="orders, in place of those of each subject")
    parser.add_argument("--seeds", type=int, default=15)
    parser.add_argument("--rate", type=float, default=120e-9, help="seconds of one core for a step of a sphere")
    parser.add_argument("--tables", action="store_true", help="of what is there; nothing is run")
    parser.add_argument("-t", "--threads", type=int, default=2)
    parser.add_argument("--plot", type=pathlib.Path)
    wishes = parser.parse_args()
    wishes.folder.mkdir(parents=True, exist_ok=True)
    truths, results = {}, []
    for subject in wishes.only:
        if wishes.tables and not (wishes.folder / f"{subject}_reference/summary.json").exists():
            continue
        truths[subject] = reference(None if wishes.tables else wishes.build, wishes.folder, subject, wishes.seeds, wishes.threads)
        for accuracy in [p / 100 for p in wishes.accuracy or []] or SUBJECTS[subject][3]:
            for k in range(0 if wishes.tables else wishes.repetitions):
                order(wishes.build, wishes.folder, subject, accuracy, k, wishes.threads)
            if (result := measure(wishes.folder, subject, accuracy, truths[subject], wishes.repetitions)) is not None:
                results.append(result)
    text = text_of(truths, results, wishes.rate)
    (wishes.folder / "target.md").write_text(text)
    print(text)
    if results:
        draw(results, wishes.plot or wishes.folder / "target.png", wishes.rate)


if __name__ == "__main__":
    main()
