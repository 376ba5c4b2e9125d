#!/usr/bin/env python3
"""Entries of small tests are changed. Each run is refused, or stops with a reason, or ends with figures that are valid or null with their reasons.

    entries.py zero APPS [--share 1] [--tests NAME ...]   every entry that may be 0, at 0, in small tests of every kind; no file of a run that ends has
                                                          a number that is not finite. --share: a part of all runs, drawn by the seed
    entries.py random APPS [--count 200]                  scenes that ship, made small, with one to three entries changed at random within their ranges.
                                                          None takes 2 GB, and none goes on for longer than --seconds. Scenes that would by their own
                                                          estimate (a thousandth of the speed) are counted and told, and others drawn for them
    both: [--seed 1] [--table FILE] [--seconds S] [--jobs 1]

APPS is the folder of the programs. The table has one line a run: what was changed, how it ended, what was valid. Exit status: 0; 1 where a run ends
otherwise."""

import collections
import concurrent.futures
import csv
import json
import math
import pathlib
import random
import re
import resource
import shutil
import sys
import threading

import faults

MOST_BYTES = 2e9
COARSE = ["Specimen/Sphere radius = 1.8 mm", "Output/Every = 10", "Expect/pattern =", "Output/Fields = off"]
CELL = ["Loading/Confining pressure = 2 MPa"]
SHORT = "Loading/Target strain = 0.002"
# Tests of crushed.prm by name, and their entries; others with app and scene.
CRUSHED = {
    "plain": [],
    "seats": ["Specimen/Seat = on"],
    "rolling": ["Effects/Tangential = coulomb with rolling resistance", "Contact/Rolling friction = 0.2", "Effects/Gravity = on"],
    "hertz": ["Effects/Contact = hertz", "Platens/Contact = hertz"],
    "no bonds": ["Effects/Bond = none", "Contact/Stiffness = 1e7 N/m", "Platens/Stiffness = 1e7 N/m", SHORT, "Loading/Ramp = 1 ms"],
    "weakening": ["Platens/Friction law = slip weakening", "Platens/Slip length = 10 um"],
    "wall": ["Loading/Test = uniaxial strain"],
    "skin": [*CELL, "Loading/Confinement = particles"],
    "sleeve": [*CELL, "Loading/Confinement = sleeve", "Sleeve/Thickness = 1 mm", "Sleeve/Modulus = 20 MPa", SHORT],
    "elastic": ["Platens/Kind = deformable", "Platens/Thickness = 4 mm", SHORT],
    "machine": ["Platens/Machine stiffness = 1e8 N/m"],
    "tension": ["Loading/Test = tension", "Platens/Attachment = glued"],
    "softening": ["Effects/Bond = elasto damage plastic", "Bond/Poisson ratio = 0.2", "Bond/Friction static = 0.9", "Bond/Friction dynamic = 0.25",
                  "Bond/Compression limits = 20 MPa, 45 MPa, 70 MPa", "Bond/Compression slopes = 3, 12, 22"],
    "yielding": ["Effects/Bond = yielding parallel bond", "Bond/Compression limits = 5 MPa, 10 MPa, 20 MPa", "Bond/Compression slopes = 2, 4, 8"],
    "facets": ["Effects/Bond = facet", "Bond/Tensile strength = 4 MPa", "Bond/Shear strength = 11 MPa", "Bond/Fracture energy = 20 J/m2",
               "Bond/Friction dynamic = 0.6", "Bond/Gap = 0.6 R_min"],
    "beams": ["Effects/Bond = cohesive beam"],
}
TESTS = {name: ("platen-compress", faults.CRUSHED, COARSE + entries) for name, entries in CRUSHED.items()} | {
    "frames": ("platen-compress", faults.CRUSHED, [*COARSE[:-1], "Output/Fields = on", SHORT]),
    "six sides": ("platen-compress", faults.SCENES / "held.prm", [*COARSE, "Platens/Friction static = 0.2", "Platens/Friction dynamic = 0.2"]),
    "disc": ("platen-brazilian", faults.SCENES / "split.prm", COARSE),
    "bar": ("platen-compress", faults.SCENES / "bent.prm", ["Loading/Target strain = 0.001", "Output/Fields = off"]),
}
# Entries that ask for nothing of a single test between platens.
OTHER_SECTIONS = ("Expect", "Study", "Calibrate", "Calibration", "Pair test", "Bar test", "Target", "Scene", "Phases", "Checkpoint")
FAR_STAGE = re.compile(r"/Stage (\d\d|[2-9])/")
# Columns with a cell that may be empty: what a specimen has no spheres for, or no bond bears.
MAY_BE_EMPTY = {"unbalanced_force_ratio", "confined_area_share", "axial_strain_gauge", "lateral_strain", "volumetric_strain", "lateral_strain_extremal",
                "axial_strain_extremal", "opening_m", "circumferential_strain", "magnitude", "mean_stress_pa",
                "mean_pressed_stress_pa", "pressed_over_axial"}
ENERGIES = re.compile(r"_(energy|work|residual)_j$")
FIGURES = ("strength_pa", "youngs_modulus_gauge_pa", "poisson_ratio", "constrained_modulus_pa")


def entries_of(app, scene, sets=()):
    """All that a scene may say, by path: what --print-parameters --json tells of each entry."""
    def flat(tree, path=""):
        for name, value in tree.items():
            if "default_value" in value:
                yield path + name, value
            else:
                yield from flat(value, f"{path}{name}/")

    asked = faults.run([app, scene, "--print-parameters", "--json", *faults.sets(sets)], check=True)
    return {name: entry for name, entry in flat(json.loads(asked.stdout)) if not name.startswith(OTHER_SECTIONS)}


def number_of(text):
    """(number, unit) that a text begins with."""
    found = re.match(r"^\s*([-+0-9.eE]+)\s*(.*)$", text or "")
    try:
        return (float(found[1]), found[2]) if found else None
    except ValueError:
        return None


def may_be_zero(entry):
    """Whether what the entry allows holds 0."""
    allowed = entry["allowed"].removeprefix("whole, ")
    between = re.fullmatch(r"(above )?([-+0-9.e]+) \.\.\. (below )?([-+0-9.e]+)", allowed)
    if between:
        low, high = float(between[2]), float(between[4])
        return (low < 0 or low == 0 and not between[1]) and (high > 0 or high == 0 and not between[3])
    return allowed.startswith("0, or ") or allowed.endswith("0 or more")


def random_value(entry, chance):
    """A value within what the entry allows; None where it is no number and no word."""
    allowed = entry["allowed"]
    whole, limits = allowed.startswith("whole, "), allowed.removeprefix("whole, ")
    between = re.match(r"^([-+0-9.e]+) (?:\.\.\.|<\.\.\.<) ([-+0-9.e]+)$", limits)
    parts = number_of(entry["value"] or entry["default_value"])
    if between:
        low, high = float(between[1]), float(between[2])
        if low > 0 and high / low > 100 or low == 0 and high > 1000:
            bottom = low if low > 0 else (abs(parts[0]) * 1e-3 if parts and parts[0] else high * 1e-9)
            value = math.exp(chance.uniform(math.log(bottom), math.log(high)))
            if parts and parts[0] and chance.random() < 0.7:  # near what it is, as a slip is
                value = min(high, max(low, abs(parts[0]) * 10 ** chance.uniform(-3, 3)))
        else:
            value = chance.uniform(low, high)
        return str(round(value)) if whole else f"{value:.6g}"
    if re.match(r"^(>|>=|at least|above) ?[-0-9.e]+", limits):
        value = abs(parts[0] if parts and parts[0] else 1.0) * 10 ** chance.uniform(-3, 3)
        return str(max(1, round(value))) if whole else f"{value:.6g}" + (f" {parts[1]}" if parts and parts[0] and parts[1] else "")
    words = [word.strip() for word in allowed.split(",")]
    if len(words) > 1 and all(re.match(r"^[a-z][a-z \-]*$", word) for word in words):
        return chance.choice(words)
    return None


def not_finite(folder):
    """What of a run's files is not finite, as "file: column"; "" where all is."""
    with_ledger = "set Energy ledger = off" not in re.sub(" +", " ", (folder / "scene.prm").read_text())
    for path in sorted(folder.glob("*.csv")):
        with path.open(newline="") as file:
            for number, row in enumerate(csv.DictReader(line for line in file if not line.startswith("#"))):
                for column, cell in row.items():
                    empty = column in MAY_BE_EMPTY or (not with_ledger and ENERGIES.search(column))
                    if cell == "" and not empty or re.fullmatch(r"[-+]?(nan|inf)", cell.lower()):
                        return f"{path.name}: {column} is \"{cell}\" in row {number}"
    found = re.search(r'"[^"]*": *-?(?:NaN|nan|Infinity|inf)\b', (folder / "summary.json").read_text())
    return f"summary.json: {found[0]}" if found else ""


def judged_figures(folder):
    """How many of FIGURES are valid, in a word; their values and reasons; and what is wrong with any figure."""
    summary, wrong = json.loads((folder / "summary.json").read_text()), ""
    for figure, told in summary["validity"].items():
        value = summary[figure]
        if told == "valid" and (value is None or isinstance(value, float) and not math.isfinite(value) or
                                figure in FIGURES and figure != "poisson_ratio" and value <= 0):
            wrong = f"{figure} is valid and {value}"
        if told != "valid" and value is not None:
            wrong = f"{figure} is {value} against {told}"
    if summary["peak_memory_bytes"] > MOST_BYTES:
        wrong = f"took {summary['peak_memory_bytes'] / 1e9:.1f} GB"
    told = {figure: summary["validity"][figure] for figure in FIGURES if figure in summary["validity"]}
    valid = [f"{figure} {summary[figure]:.4g}" for figure, said in told.items() if said == "valid"]
    against = [f"{figure}: {'; '.join(said)}" for figure, said in told.items() if said != "valid"]
    all_of_them = valid and len(valid) == len([figure for figure in told if figure != "constrained_modulus_pa"])
    return "valid" if all_of_them else "partly" if valid else "invalid", ", ".join(valid if all_of_them else valid + against[:2]), wrong


def judged(status, error, output):
    """How a run ended, in a word, what that rests on, and what is wrong with it."""
    first = next((line for line in error if "note:" not in line), "").strip()
    if status == 2:
        told = any("Allowed" in line or "error:" in line for line in error)
        return "refused", first, "refused, and wrote a folder" if output.exists() else "" if told else "refused without a message"
    if status == 3:
        return "stopped", first, "" if first else "stopped without a message"
    if status not in (0, 1):
        return "crashed", f"status {status}: {first}", "a status that nothing stands for"
    return judged_figures(output)


def limit():
    resource.setrlimit(resource.RLIMIT_AS, (int(4 * MOST_BYTES), int(4 * MOST_BYTES)))


def ended(command, output, seconds, entry=""):
    """As judged(); a run in which `entry` has no effect, which is as without it, is not waited for, nor one that goes on after `seconds`."""
    run = faults.start(command, preexec_fn=limit)
    clock = threading.Timer(seconds, run.kill)
    clock.start()
    error, idle = [], False
    for line in run.stderr:
        error.append(line)
        if entry and "has no effect" in line and f" {entry} = 0 " in line:
            idle = True
            run.kill()
    status, late = run.wait(), not clock.is_alive()
    clock.cancel()
    if idle:
        return "no effect", "", ""
    return ("hung", f"goes on after {seconds:g} s", "") if late else judged(status, error, output)


def zero_runs(apps, only):
    """(test, entry) of all runs."""
    for test, (app, scene, sets) in TESTS.items():
        for name, entry in entries_of(apps / app, scene, sets).items() if test in (only or TESTS) else ():
            far = re.search(r"/Stage \d|/(Left|Right|Front|Back)/", name) and test != "six sides" or FAR_STAGE.search(name)
            now = number_of(entry["value"] or entry["default_value"])
            if not far and may_be_zero(entry) and not (now and now[0] == 0):  # what is not given is another thing than 0
                yield test, name


def at_zero(asked, folder, number, test, entry):
    """A row: test, entry, and as judged(). A long run is none that is wrong."""
    (app, scene, sets), output = TESTS[test], folder / str(number)
    command = faults.command(asked.apps / app, scene, output, [*sets, f"{entry} = 0"], "-t", "1")
    command.remove("--quiet")  # notes tell what has no effect
    kind, words, wrong = ended(command, output, asked.seconds, entry)
    if kind in ("valid", "partly", "invalid"):
        wrong = not_finite(output) or wrong
    shutil.rmtree(output, ignore_errors=True)
    return test, entry, kind, words, wrong


def zero(asked, pool, folder):
    """Rows of runs with one entry at 0."""
    everything = list(zero_runs(asked.apps, asked.tests))
    chosen = sorted(random.Random(asked.seed).sample(range(len(everything)), max(1, round(asked.share * len(everything)))))
    yield from pool.map(lambda k: at_zero(asked, folder, k, *everything[k]), chosen)
    print(f"{len(chosen)} of {len(everything)} runs, {len({everything[k][1] for k in chosen})} entries")


def shipped_scenes():
    """Scene files of one test between platens, each with its app."""
    others = ("study", "calibrate", "abacus", "bar_", "two_", "three_particles", "silica_bulk", "softening_bond", "yielding_bond")
    return [("platen-brazilian" if "brazilian" in path.stem else "platen-compress", path)
            for path in sorted((faults.SOURCE / "scenes").glob("*.prm")) if not path.stem.startswith(others)]


def changed(entries, chance):
    """One to three assignments."""
    names = [name for name in entries if "ile" not in name.rsplit("/", 1)[-1] and name != "Specimen/Sphere radius" and not FAR_STAGE.search(name)]
    own = [name for name in names if entries[name]["value"] != entries[name]["default_value"]]  # of the scene
    wanted, sets = chance.choice((1, 2, 3)), {}
    while len(sets) < wanted:
        name = chance.choice(own if own and chance.random() < 0.7 else names)
        value = random_value(entries[name], chance)
        if value is not None:
            sets.setdefault(name, value)
    return sets


def small(entries, changes):
    """Entries that make a scene one of some 500 spheres."""
    def si(key):
        value = number_of(changes.get(key) or entries[key]["value"])
        return value[0] * {"mm": 1e-3, "m": 1, "cm": 1e-2, "": 1}[value[1]] if value else None

    radius = si("Specimen/Radius")
    volume = (math.pi * radius ** 2 if radius else si("Specimen/Width x") * si("Specimen/Width y")) * si("Specimen/Height")
    return [f"Specimen/Sphere radius = {(volume * 0.6 / (500 * 4 / 3 * math.pi)) ** (1 / 3):.4g}", "Output/Fields = off"]


def estimated(command):
    """Seconds that a dry run tells; None where it refuses, infinity where it tells none."""
    done = faults.run(command + ["--dry-run"], preexec_fn=limit)
    found = re.search(r"estimate: (.*?) or more", done.stdout)
    units = {"s": 1, "min": 60, "h": 3600, "d": 86400, "day": 86400, "days": 86400}
    return None if done.returncode else math.inf if not found else sum(
        float(n) * units.get(unit, 3e7) for n, unit in re.findall(r"([0-9.e+]+) ([a-z]+)", found[1]))


def at_random(asked, folder, number):
    """A row: scene, what was changed, and as judged()."""
    chance, output = random.Random(f"{asked.seed} {number}"), folder / str(number)
    app, path = chance.choice(shipped_scenes())
    entries = entries_of(asked.apps / app, path)
    changes = changed(entries, chance)
    told = [f"{name} = {value}" for name, value in changes.items()]
    command = faults.command(asked.apps / app, path, output, small(entries, changes) + told, "-t", "1")
    seconds = estimated([word for word in command if word != "--quiet"])
    if seconds is not None and seconds > asked.seconds:
        return path.stem, "; ".join(told), "long", f"{seconds:.0f} s by its own estimate", ""
    kind, rests_on, wrong = ended(command, output, asked.seconds)
    shutil.rmtree(output, ignore_errors=True)
    return path.stem, "; ".join(told), kind, rests_on, f"it told {seconds} s" if kind == "hung" else wrong


def at_chance(asked, pool, folder):
    """Rows of scenes with entries changed at random, until so many are none of those that are too long."""
    drawn = done = 0
    while (missing := asked.count - done) > 0:
        for row in pool.map(lambda n: at_random(asked, folder, n), range(drawn + 1, drawn + missing + 1)):
            done += row[2] != "long"
            yield row
        drawn += missing


def main():
    parser = faults.parser(__doc__)
    parser.add_argument("what", choices=("zero", "random"))
    parser.add_argument("apps", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--share", type=float, default=1)
    parser.add_argument("--tests", nargs="*", default=[])
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--table", type=pathlib.Path)
    parser.add_argument("--seconds", type=float)
    parser.add_argument("--jobs", type=int, default=1)
    asked = parser.parse_args()
    asked.seconds = asked.seconds or (120 if asked.what == "zero" else 600)
    rows = []
    with faults.scratch() as folder, concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
        for row in (zero if asked.what == "zero" else at_chance)(asked, pool, folder):
            rows.append(row)
            print(" | ".join(row), flush=True)
    if asked.table:
        lines = ["| test | changed | ended | by |", "| --- | --- | --- | --- |"]
        lines += [f"| {test} | {change} | {kind} | {wrong + ': ' if wrong else ''}{words} |" for test, change, kind, words, wrong in rows]
        asked.table.write_text("\n".join(lines) + "\n")
    print(dict(collections.Counter(row[2] for row in rows)))
    wrong = [row for row in rows if row[4]]
    for row in wrong:
        print("wrong:", row, file=sys.stderr)
    return 1 if wrong or not rows else 0


if __name__ == "__main__":
    sys.exit(main())
