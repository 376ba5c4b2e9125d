"""Scenes that ship, made small, with one to three entries changed at random within their ranges: each is refused, or stops
with a reason, or ends with figures that are valid or null with their reasons. None takes 2 GB, and none goes on for longer
than its dry run told. Scenes that would take longer than --seconds by their own estimate (a thousandth of the speed) are
counted and told, and others drawn for them.

    random_scenes.py APPS [--count 200] [--seed 1] [--table FILE] [--seconds 600] [--jobs 1]

APPS is the folder of the programs. The table has one line a scene: what was changed, how it ended, what was valid."""

import argparse
import concurrent.futures
import json
import math
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
SPHERES = 500
MOST_BYTES = 2e9
# Entries that ask for nothing of a single test between platens, or name files.
OTHER_SECTIONS = ("Expect", "Study", "Calibrate", "Calibration", "Pair test", "Bar test", "Target", "Scene", "Phases", "Checkpoint")
FIGURES = ("strength_pa", "youngs_modulus_gauge_pa", "poisson_ratio", "constrained_modulus_pa")


def scenes():
    """Scene files of one test between platens, each with its app."""
    names = sorted((SOURCE / "scenes").glob("*.prm"))
    found = []
    for path in names:
        if path.stem.startswith(("study", "calibrate", "abacus", "bar_", "two_", "three_particles", "silica_bulk")) or \
                path.stem in ("softening_bond", "yielding_bond"):
            continue
        app = "platen-brazilian" if "brazilian" in path.stem else "platen-compress"
        found.append((app, path))
    return found


def flat(tree, path=""):
    """Entries of a parameter tree as (path, entry)."""
    for name, value in tree.items():
        where = f"{path}/{name}" if path else name
        if "default_value" in value:
            yield where, value
        else:
            yield from flat(value, where)


def number_of(text):
    found = re.match(r"^\s*([-+0-9.eE]+)\s*(.*)$", text)
    try:
        return (float(found.group(1)), found.group(2)) if found else None
    except ValueError:
        return None


def random_value(entry, chance):
    """A value within what the entry allows; None where it is no number and no word."""
    allowed, now = entry["allowed"], entry["value"] or entry["default_value"]
    whole = allowed.startswith("whole, ")
    limits = allowed.removeprefix("whole, ")
    between = re.match(r"^([-+0-9.e]+) (?:\.\.\.|<\.\.\.<) ([-+0-9.e]+)$", limits)
    parts = number_of(now) if now else None
    if between:
        low, high = float(between.group(1)), float(between.group(2))
        if low > 0 and high / low > 100 or low == 0 and high > 1000:
            bottom = low if low > 0 else (abs(parts[0]) * 1e-3 if parts and parts[0] else high * 1e-9)
            value = math.exp(chance.uniform(math.log(bottom), math.log(high)))
            if parts and parts[0] and chance.random() < 0.7:  # near what it is, as a slip is
                value = min(high, max(low, abs(parts[0]) * 10 ** chance.uniform(-3, 3)))
        else:
            value = chance.uniform(low, high)
        return str(round(value)) if whole else f"{value:.6g}"
    if re.match(r"^(>|>=|at least|above) ?[-0-9.e]+", limits):
        base = parts[0] if parts and parts[0] else 1.0
        value = abs(base) * 10 ** chance.uniform(-3, 3)
        return str(max(1, round(value))) if whole else f"{value:.6g}" + (f" {parts[1]}" if parts and parts[0] and parts[1] else "")
    words = [word.strip() for word in allowed.split(",")]
    if len(words) > 1 and all(re.match(r"^[a-z][a-z \-]*$", word) for word in words):
        return chance.choice(words)
    return None


def parameters(app, path, apps):
    asked = subprocess.run([apps / app, path, "--print-parameters", "--json"], capture_output=True, text=True, check=True)
    return dict(flat(json.loads(asked.stdout)))


def small(entries, changes):
    """Entries that make a scene one of some 500 spheres."""
    new = dict(one.split(" = ") for one in changes)

    def si(key):
        value = number_of(new.get(key) or entries[key]["value"] or "")
        return value[0] * {"mm": 1e-3, "m": 1, "cm": 1e-2, "": 1}[value[1]] if value else None

    height, radius = si("Specimen/Height"), si("Specimen/Radius")
    wide, deep = si("Specimen/Width x"), si("Specimen/Width y")
    volume = (math.pi * radius ** 2 if radius else wide * deep) * height
    sphere = (volume * 0.6 / (SPHERES * 4 / 3 * math.pi)) ** (1 / 3)
    sets = [f"Specimen/Sphere radius = {sphere:.4g}", "Output/Fields = off"]
    return sets


def estimated(command):
    """Seconds that a dry run tells; None where it refuses, infinity where it tells none."""
    done = subprocess.run(command + ["--dry-run"], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          preexec_fn=limit)
    if done.returncode != 0:
        return None
    found = re.search(r"estimate: (.*?) or more", done.stdout)
    units = {"s": 1, "min": 60, "h": 3600, "d": 86400, "day": 86400, "days": 86400, "years": 3e7}
    return sum(float(n) * units.get(unit, 3e7) for n, unit in re.findall(r"([0-9.e+]+) ([a-z]+)", found.group(1))) \
        if found else math.inf


def changed(entries, chance):
    """One to three assignments."""
    names = [name for name in entries if not name.startswith(OTHER_SECTIONS) and "ile" not in name.rsplit("/", 1)[-1] and name != "Specimen/Sphere radius"
             and not re.search(r"/Stage (\d\d|[2-9])/", name)]
    own = [name for name in names if entries[name]["value"] != entries[name]["default_value"]]  # of the scene
    wanted, sets = chance.choice((1, 2, 3)), []
    while len(sets) < wanted:
        name = chance.choice(own if own and chance.random() < 0.7 else names)
        value = random_value(entries[name], chance)
        if value is not None and not any(one.startswith(name + " =") for one in sets):
            sets.append(f"{name} = {value}")
    return sets


def limit():
    resource.setrlimit(resource.RLIMIT_AS, (int(4 * MOST_BYTES), int(4 * MOST_BYTES)))


def judged(status, output, error):
    """How a run ended, in a word, what that rests on, and what is wrong with it."""
    first = error.strip().splitlines()[0] if error.strip() else ""
    if status == 2:
        wrong = "" if "Allowed" in error or "error:" in error else "refused without a message"
        if output.exists():
            wrong = "refused, and wrote a folder"
        return "refused", first, wrong
    if status == 3:
        return "stopped", first, "" if first else "stopped without a message"
    if status not in (0, 1):
        return "crashed", f"status {status}: {first}", "a status that nothing stands for"
    summary = json.loads((output / "summary.json").read_text())
    validity = summary["validity"]
    told = [figure for figure in FIGURES if figure in validity]
    valid = [f"{figure} {summary[figure]:.4g}" for figure in told if validity[figure] == "valid"]
    against = [f"{figure}: {'; '.join(validity[figure])}" for figure in told if validity[figure] != "valid"]
    wrong = ""
    for figure in told:
        value = summary[figure]
        if validity[figure] == "valid" and (value is None or not math.isfinite(value)):
            wrong = f"{figure} is valid and {value}"
        if validity[figure] != "valid" and value is not None:
            wrong = f"{figure} is {value} against {validity[figure]}"
        if validity[figure] == "valid" and figure != "poisson_ratio" and value <= 0:
            wrong = f"{figure} is valid and {value}"
    if summary["peak_memory_bytes"] > MOST_BYTES:
        wrong = f"took {summary['peak_memory_bytes'] / 1e9:.1f} GB"
    if valid and len(valid) == len([f for f in told if not (f == "constrained_modulus_pa")]):
        return "valid", ", ".join(valid), wrong
    return ("partly" if valid else "invalid"), ", ".join(valid + against[:2]), wrong


def run_one(number, seed, apps, folder, seconds):
    chance = random.Random(f"{seed} {number}")
    app, path = chance.choice(scenes())
    entries = parameters(app, path, apps)
    changes = changed(entries, chance)
    sets = small(entries, changes) + changes
    output = folder / str(number)
    command = [str(apps / app), str(path), "-o", str(output), "--quiet", "-t", "1"]
    for one in sets:
        command += ["-s", one]
    told = estimated([word for word in command if word != "--quiet"])
    if told is not None and told > seconds:
        return number, path.stem, "; ".join(changes), "long", f"{told:.0f} s by its own estimate", ""
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=seconds,
                              preexec_fn=limit)
        kind, rests_on, wrong = judged(done.returncode, output, done.stderr)
    except subprocess.TimeoutExpired:
        kind, rests_on, wrong = "hung", f"{told} s by its own estimate", f"goes on after {seconds} s"
    shutil.rmtree(output, ignore_errors=True)
    return number, path.stem, "; ".join(changes), kind, rests_on, wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("apps", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--table", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=600)
    parser.add_argument("--jobs", type=int, default=1)
    a = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as scratch, concurrent.futures.ThreadPoolExecutor(a.jobs) as pool:
        drawn = 0
        while (missing := a.count - sum(row[3] != "long" for row in rows)) > 0:
            numbers = range(drawn + 1, drawn + missing + 1)
            drawn += missing
            for row in pool.map(lambda n: run_one(n, a.seed, a.apps.resolve(), pathlib.Path(scratch), a.seconds), numbers):
                rows.append(row)
                print(" | ".join(str(cell) for cell in row), flush=True)
    if a.table:
        lines = ["| scene | changed | ended | by |", "| --- | --- | --- | --- |"]
        lines += [f"| {name} | {sets} | {kind} | {(wrong + ': ' if wrong else '') + rests_on} |"
                  for _, name, sets, kind, rests_on, wrong in rows]
        a.table.write_text("\n".join(lines) + "\n")
    kinds = {kind: sum(row[3] == kind for row in rows) for kind in sorted({row[3] for row in rows})}
    print(kinds)
    faults = [row for row in rows if row[5]]
    for row in faults:
        print("wrong:", row, file=sys.stderr)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
