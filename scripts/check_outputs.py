#!/usr/bin/env python3
"""Compares docs/outputs.md with the names in real results. Runs nothing.

    scripts/check_outputs.py FOLDER...   every column of every CSV and every key of every summary below the folders
    scripts/check_outputs.py             the columns of history.csv that the sources declare, and those of studies

Told is each name that the page lacks, with a file that has it. Exit status: 0; 1 where one is told; 2 where a folder
holds no results.
"""

import argparse
import csv
import json
import pathlib
import re
import sys

SOURCE = pathlib.Path(__file__).resolve().parent.parent
PAGE = SOURCE / "docs/outputs.md"
# Members that are names of their own: of other keys, of entries, of patterns.
FREE = {"validity", "inputs_sha256", "patterns", "found", "training", "verification", "sensitivities", "correlations",
        "bulk", "tension", "bending", "torsion", "impact", "bounds", "abacus",
        "targets", "values", "scatter_of_seeds", "prices", "wall_seconds", "correlated", "targets_missed", "missed",
        "undetermined"}
SAME = {"plan.json": None, "curve_2.csv": "curve.csv", "curve_3.csv": "curve.csv"}  # None: not on the page


def names_in(row):
    return re.findall(r"`([^`]+)`", row.strip().strip("|").split("|")[0])


def names_of_page(text):
    """Names by file, and members by object; both from the first column of the tables below a heading."""
    files, members = {}, {}
    file, goals = None, []
    for line in text.splitlines():
        heading = re.match(r"^(#{2,4}) (.*)", line)
        if heading:
            quoted = re.findall(r"`([^`]+)`", heading.group(2))
            if len(heading.group(1)) == 2:
                file, goals = quoted[0], [files.setdefault(quoted[0], set())]
            elif heading.group(1) == "####" or (file == "study.json" and quoted):
                goals = [members.setdefault(name, set()) for name in quoted]
            else:
                goals = [files[file]]
        elif line.startswith("| `"):
            for goal in goals:
                goal.update(names_in(line))
    return files, members


def known_object(name, members):
    """Members of an object; those with `final_` before are as those without."""
    return members.get(name, members.get(name.removeprefix("final_")))


def lacking_keys(tree, allowed, members, figures, path=""):
    """Keys of a summary that the page lacks."""
    for key, value in tree.items():
        if key not in allowed and key not in figures:
            yield path + key
        inner = value[0] if isinstance(value, list) and value and isinstance(value[0], dict) else value
        if not isinstance(inner, dict) or key in FREE:
            continue
        if key in figures:  # mean, deviation, runs of a case
            yield from (f"{path}{key}/{k}" for k in inner if k not in members["cases"])
            continue
        yield from lacking_keys(inner, known_object(key, members) or set(), members,
                                figures if key in ("cases", "envelopes") else set(), path + key + "/")


def columns_of(path):
    with open(path, encoding="utf-8", newline="") as file:
        for row in csv.reader(line for line in file if not line.startswith("#")):
            return row
    return []


def told_of(path, files, members):
    """Names in one file that the page lacks."""
    name = SAME.get(path.name, path.name)
    if name is None or re.match(r"([0-9a-f]{16}|packing_.*\d)\.csv$", path.name):  # spheres of a packing
        return []
    if path.suffix == ".csv":
        allowed = files.get(name, set()) | (files["study.csv"] if name in ("costs.csv", "envelope.csv") else set())
        return [f"column {c}" for c in columns_of(path) if c not in allowed] if name in files else ["the whole file"]
    tree = json.loads(path.read_text(encoding="utf-8"))
    if not isinstance(tree, dict) or tree.get("app") is None and name == "summary.json":
        return []
    allowed = files["summary.json"] | files["study.json"]
    figures = files["study.csv"] | files["costs.csv"] if "cases" in tree else set()
    top = dict.fromkeys(allowed)
    return [f"key {k}" for k in lacking_keys(tree, set(top), members, figures)]


def results_below(folders):
    for folder in folders:
        for path in sorted(folder.rglob("*")):
            if path.suffix == ".csv" or path.name in ("summary.json", "study.json"):
                yield path


def names_in_sources():
    """Columns that the sources declare: file to names."""
    history = (SOURCE / "apps/run/history.cc").read_text(encoding="utf-8")
    parts = re.split(r"\{\"(\w+)\", \"[^\"]*\",", history)[1:]  # a column's name, all up to the next one, ...
    columns = {name for name, rest in zip(parts[::2], parts[1::2]) if not re.search(r"\bstate\s*[,}]", rest)}
    tables = (SOURCE / "apps/study/tables.cc").read_text(encoding="utf-8")
    figures = re.search(r"cells_of\(\s*((?:\"[^\"]*\"\s*)+)\)", tables)
    study = "".join(re.findall(r"\"([^\"]*)\"", figures.group(1))).split(",")
    return {"history.csv": columns, "study.csv": set(study)}


def main():
    parser = argparse.ArgumentParser(description="Compares docs/outputs.md with the names in results.")
    parser.add_argument("folders", nargs="*", type=pathlib.Path)
    asked = parser.parse_args()
    files, members = names_of_page(PAGE.read_text(encoding="utf-8"))
    told, seen = {}, 0
    if asked.folders:
        for path in results_below(asked.folders):
            seen += 1
            for what in told_of(path, files, members):
                told.setdefault(f"{path.name}: {what}", path)
        if seen == 0:
            print("outputs: no results in these folders", file=sys.stderr)
            return 2
    else:
        for name, names in names_in_sources().items():
            seen += len(names)
            told.update({f"{name}: {n}": "the sources" for n in sorted(names - files[name])})
    for what, where in sorted(told.items()):
        print(f"{what} is not on the page ({where})")
    print(f"outputs: {seen} {'files' if asked.folders else 'names'}, {len(told)} lacking")
    return 1 if told or seen == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
