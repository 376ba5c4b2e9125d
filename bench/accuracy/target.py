#!/usr/bin/env python3
"""How well and how cheaply `platen-study target` keeps what it is ordered (docs/accuracy.md, "Accuracy on order").

Usage: target.py BUILD FOLDER [--only small|cylinder|gain ...] [--repetitions 20] [--accuracy 5 2] [--seeds 15] [-t 2] [--plot PNG]

For each subject: (a) reference runs over seeds and speeds (--seeds packings at 15, 30, 60 and 120 wave crossings, of a gain both
scenes), whose line through 1 / N is the truth, with an interval of its own; (b) so many repetitions of each order, on seeds far
apart; (c) what one slow speed would cost for the same accuracy, by the variances and the haste of the reference runs. Prints a table,
leaves it in FOLDER/target.md and, where gnuplot is installed, draws orders against seconds. What is done is kept: call it again after a
stop. Runs of finished repetitions are removed, their tables stay.
"""
import argparse
import csv
import json
import math
import pathlib
import shutil
import statistics
import subprocess

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"
SPEEDS = "15, 30, 60, 120"
SUBJECTS = {
    # name: (scene, entries of all its runs, entries of the scene that a gain is over, accuracies)
    "small": ("study_quality_concrete", ["Study/Quality list ="], None, [0.05, 0.04]),
    "cylinder": ("study_target_cylinder", [], None, [0.05, 0.02, 0.01]),
    "gain": ("study_target_gain", [], ["Platens/Friction static = 0"], [0.03]),
}
CONFIDENCE = 0.9
PACKING_STEPS = 3000  # as apps/study/target_figures.cc


def study(build, kind, scene, folder, entries, threads):
    """Makes a study, or goes on with it; one that has ended is left."""
    summary = folder / "study.json"
    if summary.exists() and json.loads(summary.read_text()).get("status") == "done":
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
    rows = {}
    with open(folder / "study.csv") as table, open(folder / "costs.csv") as costs:
        for row, cost in zip(csv.DictReader(table), csv.DictReader(costs)):
            rows[float(row["wave_crossings"]), int(row["seed"])] = (
                float(row["strength_pa"]), float(cost["steps"]) * float(row["particles"]), float(cost["wall_seconds"]),
                float(row["particles"]))
    return rows


def line(x, y):
    """Height at 0 and slope of the straight line, by least squares."""
    mx, my = statistics.fmean(x), statistics.fmean(y)
    slope = sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)
    return my - slope * mx, slope


def reference(build, folder, subject, seeds, threads):
    """The truth: a line in 1 / N on each packing, mean over packings; and what one run costs."""
    scene, entries, over, _ = SUBJECTS[subject]
    entries = entries + [f"Study/Seeds = {seeds}", f"Study/Wave crossings list = {SPEEDS}", "Checkpoint/Every = 0"]
    tables = []
    for name, more in (("reference", []), ("reference_over", over)):
        if more is None:
            continue
        study(build, "accuracy", scene, folder / f"{subject}_{name}", entries + more, threads)
        tables.append(rows_of(folder / f"{subject}_{name}"))
    speeds = sorted({n for n, _ in tables[0]})
    packings = sorted({s for _, s in tables[0]})
    logs = {k: math.log(tables[0][k][0]) - (math.log(tables[1][k][0]) if over else 0)
            for k in tables[0] if all(t[k][0] > 0 for t in tables)}
    whole = [s for s in packings if all((n, s) in logs for n in speeds)]
    fits = [line([1 / n for n in speeds], [logs[n, s] for n in speeds]) for s in whole]
    heights = [f[0] for f in fits]
    slope = statistics.fmean(f[1] for f in fits)
    cost = [sum(statistics.fmean(t[n, s][1] for s in packings) for t in tables) for n in speeds]
    seconds = [sum(statistics.fmean(t[n, s][2] for s in packings) for t in tables) for n in speeds]
    spheres = statistics.fmean(t[k][3] for t in tables for k in t)
    slow = [logs[speeds[-1], s] for s in whole]
    return {"mean": statistics.fmean(heights), "error": statistics.stdev(heights) / math.sqrt(len(heights)), "slope": slope,
            "runs": len(logs) * len(tables), "deviation": statistics.stdev(slow), "fastest": speeds[0],
            "steps": line(speeds, cost), "seconds": line(speeds, seconds), "packing": PACKING_STEPS * spheres}


def one_slow_speed(truth, accuracy):
    """Crossings, packings, steps times spheres and seconds of the cheapest runs at one speed, no haste taken off."""
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
            best = (crossings, packings, steps, packings * (truth["seconds"][0] + truth["seconds"][1] * crossings))
    return best


def order(build, folder, subject, accuracy, number, threads):
    """One repetition; its study.json."""
    scene, entries, _, _ = SUBJECTS[subject]
    here = folder / f"{subject}_{100 * accuracy:g}_{number:02d}"
    study(build, "target", scene, here,
          entries + [f"Scene/Seed = {100000 + 10000 * number}", f"Study/Target/Accuracy = {100 * accuracy:g} %",
                     f"Study/Wave crossings list = {SPEEDS}", "Study/Target/Most runs = 1000", "Checkpoint/Every = 0"], threads)
    for part in ("runs", "packings"):
        shutil.rmtree(here / part, ignore_errors=True)
    return json.loads((here / "study.json").read_text())


def measure(build, folder, subject, accuracy, truth, repetitions, threads):
    studies = [order(build, folder, subject, accuracy, k, threads) for k in range(repetitions)]
    targets = [s["target"] for s in studies]
    errors = [math.log(t["mean"]) - truth["mean"] for t in targets]
    slow = one_slow_speed(truth, accuracy)
    return {"subject": subject, "accuracy": accuracy, "repetitions": repetitions,
            "held": sum(abs(e) <= t["half_interval"] for e, t in zip(errors, targets)),
            "half": statistics.fmean(t["half_interval"] for t in targets),
            "error": math.sqrt(statistics.fmean(e * e for e in errors)),
            "runs": statistics.fmean(s["runs"] for s in studies), "steps": statistics.fmean(t["sphere_steps"] for t in targets),
            "seconds": statistics.fmean(s["costs"]["core_seconds"] for s in studies),
            "pilot": statistics.fmean(s["costs"]["looks_core_seconds"][0] for s in studies), "slow": slow}


def text_of(truths, results):
    text = ""
    for subject, t in truths.items():
        unit = math.exp(t["mean"]) * (1 if SUBJECTS[subject][2] else 1e-6)
        text += (f"{subject}: {t['runs']} reference runs, truth {unit:.4g} +- {100 * 1.645 * t['error']:.2g} % (90 %), haste b "
                 f"{t['slope']:.2g}, one run at the slowest speed scatters by {100 * t['deviation']:.2g} %\n")
    text += ("\n| order | held | interval, +- % | root mean square error, % | runs | seconds of one core (pilot) | steps x spheres, 1e8 | one slow "
             "speed: crossings x packings | its seconds | its steps x spheres, 1e8 | order over it |\n" + "|" + " --- |" * 11 + "\n")
    for r in results:
        n, packings, steps, seconds = r["slow"]
        text += (f"| {r['subject']} {100 * r['accuracy']:g} % | {r['held']} of {r['repetitions']} | {100 * r['half']:.2g} | {100 * r['error']:.2g} | "
                 f"{r['runs']:.0f} | {r['seconds']:.0f} ({r['pilot']:.0f}) | {1e-8 * r['steps']:.2f} | {n:.0f} x {packings} | {seconds:.0f} | "
                 f"{1e-8 * steps:.2f} | {r['steps'] / steps:.2f} |\n")
    return text


def draw(results, png):
    """Orders against seconds, by gnuplot where it is installed; the script stays beside the picture."""
    subjects = list(dict.fromkeys(r["subject"] for r in results))
    blocks, curves = "", []
    for colour, subject in enumerate(subjects, 1):
        mine = [r for r in results if r["subject"] == subject]
        for name, seconds, style in (("on order", [r["seconds"] for r in mine], "pt 7 dt 1"),
                                     ("one slow speed", [r["slow"][3] for r in mine], "pt 6 dt 2")):
            block = f"${subject}_{name.split()[0]}"
            rows = "\n".join(f"{s:.6g} {100 * r['accuracy']:g}" for s, r in zip(seconds, mine))
            blocks += f"{block} << EOD\n{rows}\nEOD\n"
            curves.append(f"{block} with linespoints lc {colour} {style} lw 2 ps 1.5 title '{subject}, {name}'")
    script = (f"set terminal pngcairo size 1000,640 font 'sans,14'\nset output '{png.resolve()}'\n{blocks}set logscale xy\nset grid\n"
              "set xlabel 'Seconds of one core'\nset ylabel 'Accuracy that is ordered (%)'\nset yrange [0.5:10]\nset key top right\n"
              "set ytics (0.5, 1, 2, 3, 5, 10)\nplot " + ", ".join(curves) + "\n")
    png.with_suffix(".gnuplot").write_text(script)
    if shutil.which("gnuplot") is None:
        print(f"gnuplot is not installed: {png.with_suffix('.gnuplot')} draws {png} where it is")
        return
    subprocess.run(["gnuplot", str(png.with_suffix(".gnuplot"))], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--only", nargs="+", choices=SUBJECTS, default=["cylinder", "gain"])
    parser.add_argument("--repetitions", type=int, default=20)
    parser.add_argument("--accuracy", nargs="+", type=float, metavar="PERCENT", help="orders, in place of those of each subject")
    parser.add_argument("--seeds", type=int, default=15)
    parser.add_argument("-t", "--threads", type=int, default=2)
    parser.add_argument("--plot", type=pathlib.Path)
    wishes = parser.parse_args()
    wishes.folder.mkdir(parents=True, exist_ok=True)
    truths, results = {}, []
    for subject in wishes.only:
        truths[subject] = reference(wishes.build, wishes.folder, subject, wishes.seeds, wishes.threads)
        for accuracy in [p / 100 for p in wishes.accuracy or []] or SUBJECTS[subject][3]:
            results.append(measure(wishes.build, wishes.folder, subject, accuracy, truths[subject], wishes.repetitions, wishes.threads))
            text = text_of(truths, results)
            (wishes.folder / "target.md").write_text(text)
    print(text)
    draw(results, wishes.plot or wishes.folder / "target.png")


if __name__ == "__main__":
    main()
