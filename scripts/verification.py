#!/usr/bin/env python3
"""Table of what can go wrong in such a code, the tests that watch it and the figures they reach.

    scripts/verification.py BUILD            runs the tests of tests/verification/rows.json, prints the table
    scripts/verification.py BUILD --write    ... and writes it to docs/verification.md
    scripts/verification.py BUILD --check    runs none: every test named exists, the table has every row

BUILD is a build folder in which everything is built. Figures are those that tests note (tests/measured.h).
Exit status: 0; 1 where a test fails or a check does not hold; 2 on bad input; 77 where tests are not built.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent
ROWS = SOURCE / "tests/verification/rows.json"
TABLE = SOURCE / "docs/verification.md"
HEADING = """# Verification

What can go wrong in such a program, what watches it, and how far off it is. Written by `scripts/verification.py BUILD
--write` from a run of the tests; rows and tests are those of [rows.json](../tests/verification/rows.json). Figures are
what tests have noted on the machine of that run, each beside what its test allows. Rows without a figure pass or fail by
equality, by a refusal, or within the bounds of their tests.

| row | what can go wrong | what is measured | threshold | tests | figures, allowed | result |
| --- | --- | --- | --- | --- | --- | --- |
"""


class Test:
    """One ctest: its name without gtest's remark on parameters, and how to run it."""

    def __init__(self, entry):
        self.name = re.sub(r"\s+# GetParam\(\).*", "", entry["name"])
        self.command = entry.get("command", [])
        properties = {p["name"]: p["value"] for p in entry.get("properties", [])}
        self.folder = properties.get("WORKING_DIRECTORY")
        filters = [a for a in self.command if a.startswith("--gtest_filter=")]
        self.filter = filters[0].split("=", 1)[1] if filters else None


def tests_of(build):
    """All tests of a build folder; exits with status 77 where some are not built."""
    listed = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], capture_output=True, text=True)
    if listed.returncode != 0:
        sys.exit(f"{build}: ctest cannot list its tests: {listed.stderr.strip()}")
    tests = [Test(entry) for entry in json.loads(listed.stdout)["tests"]]
    missing = [t.name for t in tests if t.name.endswith("_NOT_BUILT")]
    if missing:
        print("not built: " + ", ".join(missing), file=sys.stderr)
        sys.exit(77)
    return tests


def matching(pattern, tests):
    return [t for t in tests if re.fullmatch(pattern, t.name)]


def check(rows, tests):
    """Faults of rows and table, as texts."""
    faults = []
    for row in rows:
        faults += [f"row {row['row']}: no test is called {p}" for p in row["tests"] if not matching(p, tests)]
        if not row["tests"] and "missing" not in row:
            faults.append(f"row {row['row']}: has neither tests nor a reason why")
    numbers = [row["row"] for row in rows]
    if numbers != list(range(1, len(rows) + 1)):
        faults.append(f"{ROWS.name}: rows are not numbered from 1 on: {numbers}")
    listed = [int(n) for n in re.findall(r"^\| (\d+) \|", TABLE.read_text(), re.M)] if TABLE.exists() else []
    if listed != numbers:
        faults.append(f"{TABLE.name}: has rows {listed}; write it anew")
    return faults


def outcomes(tests):
    """(pass, fail or skipped, figures) of each test by name; figures: (row, what, value with what is allowed)."""
    result = {}
    programs = {}
    for t in tests:
        programs.setdefault((t.command[0], t.folder) if t.filter else t.name, []).append(t)
    for group in programs.values():
        if group[0].filter is None:
            passed = subprocess.run(group[0].command, cwd=group[0].folder, capture_output=True).returncode == 0
            result[group[0].name] = ("pass" if passed else "fail", [])
            continue
        with tempfile.TemporaryDirectory() as folder:
            report = pathlib.Path(folder) / "report.json"
            command = [group[0].command[0], "--gtest_output=json:" + str(report),
                       "--gtest_filter=" + ":".join(t.filter for t in group)]
            print(f"{len(group)} tests of {pathlib.Path(command[0]).name}", file=sys.stderr)
            subprocess.run(command, cwd=group[0].folder, capture_output=True)
            done = read(report)
        for t in group:
            result[t.name] = done.get(t.filter, ("fail", []))
    return result


def read(report):
    """Outcomes by the name that gtest's filter has; none where the program ended before it wrote them."""
    done = {}
    for suite in json.loads(report.read_text())["testsuites"] if report.exists() else []:
        for case in suite["testsuite"]:
            figures = []
            for key, value in case.items():
                if noted := re.fullmatch(r"row_(\d+)_(\w[\w.]*)", key):
                    reached, allowed = value.split(" ", 1)
                    figures.append((int(noted[1]), noted[2].replace("_", " "), f"{reached} ({allowed})"))
            skipped = case.get("result") == "SKIPPED"
            how = "fail" if case.get("failures") else "skipped" if skipped else "pass"
            done[suite["name"] + "." + case["name"]] = (how, figures)
    return done


def line(row, tests, results):
    """The row's line of the table, and whether it holds."""
    own = {t.name: t for p in row["tests"] for t in matching(p, tests)}
    failed = [name for name in own if results[name][0] == "fail"]
    notes = ["skipped: " + name for name in own if results[name][0] == "skipped"]
    notes += ["missing: " + row["missing"]] if "missing" in row else []
    figures = sorted({f"{what}: {value}" for name in own for number, what, value in results[name][1]
                      if number == row["row"]})
    if failed:
        verdict = "FAILS: " + ", ".join(f"`{name}`" for name in failed)
    else:
        verdict = "; ".join((["pass"] if own else []) + notes)
    patterns = "<br>".join(f"`{p}`".replace("|", "\\|").replace("\\.", ".") for p in row["tests"]) or "-"
    cells = [str(row["row"]), row["hazard"], row["measured"], row["threshold"], patterns,
             "<br>".join(figures) or "-", verdict]
    return "| " + " | ".join(cells) + " |", not failed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", help="build folder")
    parser.add_argument("--write", action="store_true", help="write docs/verification.md")
    parser.add_argument("--check", action="store_true", help="run no test: check names and the table")
    options = parser.parse_args()
    rows = json.loads(ROWS.read_text())
    tests = tests_of(options.build)
    if options.check:
        faults = check(rows, tests)
        print("\n".join(faults) or f"{len(rows)} rows are sound")
        return 1 if faults else 0
    named = {t.name: t for row in rows for p in row["tests"] for t in matching(p, tests)}
    results = outcomes(list(named.values()))
    lines = [line(row, tests, results) for row in rows]
    table = HEADING + "\n".join(text for text, _ in lines) + "\n"
    if options.write:
        TABLE.write_text(table)
    else:
        print(table)
    return 0 if all(holds for _, holds in lines) else 1


if __name__ == "__main__":
    sys.exit(main())
