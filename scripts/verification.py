#!/usr/bin/env python3
"""Table of what can go wrong in such a code, the tests that watch it and the figures they reach.

    scripts/verification.py BUILD            runs the tests of tests/verification/rows.json, prints the table
    scripts/verification.py BUILD --long     ... their long forms as well (ctest -C Long): hours
    scripts/verification.py BUILD --rows 4 12    ... those rows only [--tests REGEX]
    scripts/verification.py BUILD --write    ... keeps what it found (tests/verification/found.json) and writes
                                             docs/verification.md from all that is kept
    scripts/verification.py BUILD --check    runs none: every test named exists, the table has every row

BUILD is a build folder in which everything is built. Figures are those that tests note (tests/measured.h), or that
scripts print as "row 34 runs: 1200000 (>= 1000000)".
Exit status: 0; 1 where a test fails or a check does not hold; 2 on bad input; 77 where tests are not built.
"""

import argparse
import copy
import datetime
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent
ROWS = SOURCE / "tests/verification/rows.json"
FOUND = SOURCE / "tests/verification/found.json"
TABLE = SOURCE / "docs/verification.md"
HEADING = """# Verification

What can go wrong in such a program, the tests that check it, and the size of the errors. Written by
`scripts/verification.py BUILD --write` from a run of the tests; rows and tests are those of
[rows.json](../tests/verification/rows.json). Figures are the values that tests have recorded on the machine of that run,
each with the value that its test allows. Rows without a figure pass or fail by equality, by a refusal, or within the
bounds of their tests. Tests in *italics* are long forms, which `scripts/test_long.sh` runs; the date is that of the row's
oldest run.

| row | what can go wrong | what is measured | threshold | tests | figures, allowed | run | result |
| --- | --- | --- | --- | --- | --- | --- | --- |
"""


class Test:
    """One ctest, or one test of a gtest suite, and how to run it."""

    def __init__(self, entry):
        self.name = entry["name"]
        self.command = entry.get("command", [])
        properties = {p["name"]: p["value"] for p in entry.get("properties", [])}
        self.folder = properties.get("WORKING_DIRECTORY")
        self.environment = dict(line.split("=", 1) for line in properties.get("ENVIRONMENT", []))
        filters = [a for a in self.command if a.startswith("--gtest_filter=")]
        self.filter = filters[0].split("=", 1)[1] if filters else None

    def single(self, case):
        """The test of this suite that gtest calls Suite.case."""
        one = copy.copy(self)
        one.name, one.filter = f"{self.name}.{case}", f"{self.filter.split('.*')[0]}.{case}"
        return one


def cases_of(program):
    """{suite: [test, ...]} of a gtest program."""
    cases, suite = {}, None
    for line in subprocess.run([program, "--gtest_list_tests"], capture_output=True, text=True, check=True).stdout.splitlines():
        word = line.split("#")[0].rstrip()
        if line.startswith("  "):
            cases[suite].append(word.strip())
        elif word.endswith(".") and " " not in word:
            suite = word[:-1]
            cases[suite] = []
    return cases


def tests_of(build):
    """All tests of a build folder, long ones included; exits with status 77 where some are not built."""
    listed = subprocess.run(["ctest", "--test-dir", build, "-C", "Long", "--show-only=json-v1"], capture_output=True,
                            text=True)
    if listed.returncode != 0:
        print(f"{build}: ctest lists no tests here; is it a build folder? {listed.stderr.strip()}", file=sys.stderr)
        sys.exit(2)
    tests = [Test(entry) for entry in json.loads(listed.stdout)["tests"]]
    missing = [t.name for t in tests if t.name.endswith("_NOT_BUILT")]
    if missing:
        print("not built: " + ", ".join(missing), file=sys.stderr)
        sys.exit(77)
    cases, single = {}, []
    for test in tests:
        suite = test.filter.split(".*")[0] if test.filter and ".*" in test.filter else None
        if suite is None:
            single.append(test)
            continue
        if test.command[0] not in cases:
            cases[test.command[0]] = cases_of(test.command[0])
        single += [test.single(case) for case in cases[test.command[0]][suite] if not case.startswith("long_")]
    return single


def matching(patterns, tests):
    return [t for t in tests if any(re.fullmatch(p, t.name) for p in patterns)]


def patterns_of(row):
    """Patterns of all tests of a row, quick ones first."""
    return row["tests"] + row.get("long", [])


def alternatives(pattern):
    """The pattern once for each word of its groups (a|b)."""
    group = re.search(r"\(([^()]*\|[^()]*)\)", pattern)
    if group is None:
        return [pattern]
    begin, end = pattern[: group.start()], pattern[group.end() :]
    return [one for word in group[1].split("|") for one in alternatives(begin + word + end)]


def check(rows, tests):
    """Faults of rows and table, as texts."""
    faults = []
    for row in rows:
        named = [one for pattern in patterns_of(row) for one in alternatives(pattern)]
        faults += [f"row {row['row']}: no test is called {one}" for one in named if not matching([one], tests)]
        if not patterns_of(row) and "missing" not in row:
            faults.append(f"row {row['row']}: has neither tests nor a reason why")
    numbers = [row["row"] for row in rows]
    if numbers != list(range(1, len(rows) + 1)):
        faults.append(f"{ROWS.name}: rows are not numbered from 1 on: {numbers}")
    lines = re.findall(r"^\| (\d+) \|.*", TABLE.read_text(), re.M) if TABLE.exists() else []
    if [int(n) for n in lines] != numbers:
        faults.append(f"{TABLE.name}: has rows {lines}; write it anew")
    faults += [f"{TABLE.name}: row {row['row']} does not name its tests; write it anew" for row in rows
               if TABLE.exists() and f"| {names_of(row)} |" not in TABLE.read_text()]
    return faults


def outcomes(tests):
    """What each test found, by its name: result (pass, fail, skipped), figures [row, what, value with what is
    allowed], date."""
    result = {}
    programs = {}
    for t in tests:
        programs.setdefault((t.command[0], t.folder) if t.filter else t.name, []).append(t)
    for group in programs.values():
        done = read_printed(group[0]) if group[0].filter is None else read_noted(group)
        for t in group:
            how, figures = done.get(t.filter, ("fail", []))
            result[t.name] = {"result": how, "figures": figures, "date": datetime.date.today().isoformat()}
    return result


def read_printed(test):
    """Outcome of a script, under None."""
    print(test.name, file=sys.stderr)
    ran = subprocess.run(test.command, cwd=test.folder, env={**os.environ, **test.environment}, capture_output=True, text=True)
    figures = [[int(n), what, value] for n, what, value
               in re.findall(r"^row (\d+) ([^:\n]+): (.+)$", ran.stdout, re.M)]
    if ran.returncode not in (0, 77):
        print(ran.stdout[-2000:] + ran.stderr[-60000:], file=sys.stderr)
    return {None: ({0: "pass", 77: "skipped"}.get(ran.returncode, "fail"), figures)}


def read_noted(group):
    """Outcomes of tests of one program by the name that gtest's filter has; none where it ended before it wrote."""
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        command = [group[0].command[0], "--gtest_output=json:" + str(report),
                   "--gtest_filter=" + ":".join(t.filter for t in group)]
        print(f"{len(group)} tests of {pathlib.Path(command[0]).name}", file=sys.stderr)
        subprocess.run(command, cwd=group[0].folder, capture_output=True)
        suites = json.loads(report.read_text())["testsuites"] if report.exists() else []
    done = {}
    for suite in suites:
        for case in suite["testsuite"]:
            figures = []
            for key, value in case.items():
                if noted := re.fullmatch(r"row_(\d+)_(\w[\w.]*)", key):
                    reached, allowed = value.split(" ", 1)
                    figures.append([int(noted[1]), noted[2].replace("_", " "), f"{reached} ({allowed})"])
            skipped = case.get("result") == "SKIPPED"
            how = "fail" if case.get("failures") else "skipped" if skipped else "pass"
            done[suite["name"] + "." + case["name"]] = (how, figures)
    return done


def names_of(row):
    """The row's tests as the table has them, long forms in italics."""
    named = [f"`{p}`" for p in row["tests"]] + [f"*`{p}`*" for p in row.get("long", [])]
    return "<br>".join(named).replace("|", "\\|").replace("\\.", ".") or "-"


def line(row, tests, found):
    """The row's line of the table, and whether it holds."""
    own = [t.name for t in matching(patterns_of(row), tests)]
    ran = {name: found[name] for name in own if name in found}
    failed = [name for name in ran if ran[name]["result"] == "fail"]
    notes = ["skipped: " + name for name in ran if ran[name]["result"] == "skipped"]
    notes += ["not run: " + name for name in own if name not in ran]
    notes += ["missing: " + row["missing"]] if "missing" in row else []
    figures = sorted({f"{what}: {value}" for test in ran.values() for number, what, value in test["figures"]
                      if number == row["row"]})
    if failed:
        verdict = "FAILS: " + ", ".join(f"`{name}`" for name in failed)
    else:
        verdict = "; ".join((["pass"] if ran else []) + notes)
    date = min((test["date"] for test in ran.values()), default="-")
    cells = [str(row["row"]), row["hazard"], row["measured"], row["threshold"], names_of(row),
             "<br>".join(figures) or "-", date, verdict]
    return "| " + " | ".join(cells) + " |", not failed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", help="build folder")
    parser.add_argument("--long", action="store_true", help="run long forms as well")
    parser.add_argument("--rows", nargs="+", type=int, metavar="N", help="these rows only [all]")
    parser.add_argument("--tests", metavar="REGEX", default="", help="of them, tests whose name has it [all]")
    parser.add_argument("--write", action="store_true", help="keep what is found and write docs/verification.md")
    parser.add_argument("--check", action="store_true", help="run no test: check names and the table")
    options = parser.parse_args()
    rows = json.loads(ROWS.read_text())
    if options.rows and not set(options.rows) <= {row["row"] for row in rows}:
        parser.error(f"--rows: rows go from 1 to {len(rows)}")
    tests = tests_of(options.build)
    if options.check:
        faults = check(rows, tests)
        print("\n".join(faults) or f"{len(rows)} rows are sound")
        return 1 if faults else 0
    chosen = [row for row in rows if not options.rows or row["row"] in options.rows]
    patterns = [p for row in chosen for p in (patterns_of(row) if options.long else row["tests"])]
    found = outcomes([t for t in matching(patterns, tests) if re.search(options.tests, t.name)])
    if options.write:
        kept = json.loads(FOUND.read_text()) if FOUND.exists() else {}
        named = {t.name for t in matching([p for row in rows for p in patterns_of(row)], tests)}
        found = {name: test for name, test in sorted({**kept, **found}.items()) if name in named}
        FOUND.write_text("{\n" + ",\n".join(f"{json.dumps(n)}: {json.dumps(t)}" for n, t in found.items()) + "\n}\n")
        chosen = rows
    lines = [line(row, tests, found) for row in chosen]
    table = HEADING + "\n".join(text for text, _ in lines) + "\n"
    if options.write:
        TABLE.write_text(table)
    else:
        print(table)
    return 0 if all(holds for _, holds in lines) else 1


if __name__ == "__main__":
    sys.exit(main())
