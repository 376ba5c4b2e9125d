#!/usr/bin/env python3
"""Do the tests notice a single fault? Makes some in a copy of the sources and runs the tests that come by them.

    scripts/mutation.py WORK                      draws, builds and runs; the result goes to WORK/result.json
    scripts/mutation.py WORK --count 24           ... so many drawn faults beside the named ones (default 120)
    scripts/mutation.py WORK --build              ... only draws and builds
    scripts/mutation.py WORK --survivors          ... runs no fault but those that survived the last time
    scripts/mutation.py WORK --only 17 23         ... none but these
    scripts/mutation.py WORK --write FILE.md      ... and writes the list (what is said above it stays)
    scripts/mutation.py --check                   runs none: named faults and argued equivalents against the sources

WORK is a scratch folder; what is in it is kept for the next time. Faults are signs, factors, powers, indices, bounds,
min for max and forgotten terms and conditions, drawn with a fixed seed from every group of files of
scripts/mutation/groups.json; those of scripts/mutation/named.json are added. One build holds them all behind switches
(scripts/mutation/fault.h), those that do not compile are replaced by the next of the draw. The tests run once without
a fault and tell which they come by; each fault is then run with those tests, quick ones first, until one fails: by an
expectation, a crash, or four times the time that it took (a loop without end). Tests that take longer than --longest
seconds are left out. What survives is a gap in the tests or makes no difference; why it makes none stands in
scripts/mutation/equivalent.json.
Exit status: 0; 1 where more than one of twenty survives, one without an argument, or a test fails without a fault; 2 on
bad input.
"""

import argparse
import hashlib
import json
import math
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import time

import mutation_draw
from mutation_copy import DATA, SOURCE, Copy
from mutation_draw import Fault

ALLOWED = 0.05  # share that may survive, each argued
FIRST, SECOND = 4.0, 25.0  # s, of tests in the first two goes at a fault


def say(text):
    print(f"{time.strftime('%H:%M:%S')} {text}", flush=True)


def flat(text):
    return " ".join(text.split())


class Sources(dict):
    """Texts of the files of all groups, by their paths."""

    def __init__(self, groups):
        super().__init__()
        self.of_group = {}
        for group, patterns in groups.items():
            paths = sorted({p.relative_to(SOURCE).as_posix() for pattern in patterns for p in SOURCE.glob(pattern)})
            self.of_group[group] = paths
            for path in paths:
                self[path] = (SOURCE / path).read_text()

    def __missing__(self, path):
        self[path] = (SOURCE / path).read_text()
        return self[path]


def located(sources, entry):
    """The span of a named text in its file, None where it is not there exactly once."""
    if not (SOURCE / entry["file"]).is_file():
        return None
    text = sources[entry["file"]]
    words = r"\s+".join(re.escape(word) for word in entry["before"].split())
    spans = [m.span() for m in re.finditer(words, text)]
    return spans[0] if len(spans) == 1 else None


def named_faults(sources):
    """Those of the fixed list whose text is still there, and what is not."""
    faults, gone = [], []
    for entry in json.loads((DATA / "named.json").read_text()):
        span = located(sources, entry)
        if span is None:
            gone.append(entry["name"])
            continue
        whole = sources[entry["file"]][span[0] : span[1]]
        faults.append((entry["name"], Fault(entry["file"], *span, "named", entry["after"], whole.endswith(";"))))
    return faults, gone


def equivalents(sources):
    """Arguments by fault, and those whose text is no longer there."""
    argued, stale = {}, []
    for entry in json.loads((DATA / "equivalent.json").read_text()):
        if not (SOURCE / entry["file"]).is_file() or flat(entry["line"]) not in flat(sources[entry["file"]]):
            stale.append(f"{entry['file']}: {entry['line']}")
        argued[(entry["file"], flat(entry["line"]), entry["before"], entry["after"])] = entry["reason"]
    return argued, stale


def line_of(text, fault):
    """The lines that a fault stands in, as one."""
    end = text.find("\n", fault.end)
    return flat(text[text.rfind("\n", 0, fault.begin) + 1 : end])


class Mutation:
    def __init__(self, args):
        self.args = args
        plan = json.loads((DATA / "groups.json").read_text())
        self.programs = plan["programs"]
        self.sources = Sources(plan["groups"])
        self.work = args.work.resolve()
        self.work.mkdir(parents=True, exist_ok=True)
        self.copy = Copy(self.work, self.programs, args.cores)
        self.refused_file = self.work / "refused.json"
        self.refused = set(map(tuple, json.loads(self.refused_file.read_text()))) if self.refused_file.exists() else set()
        self.argued, self.stale = equivalents(self.sources)

    def key(self, fault):
        text = self.sources[fault.file]
        return fault.file, line_of(text, fault), flat(text[fault.begin : fault.end]), fault.text

    def refuses(self, fault):
        return self.key(fault) in self.refused

    def plan(self):
        """All faults: named ones, then so many of each group in turn."""
        named, self.gone = named_faults(self.sources)
        faults = [(name, "named", f) for name, f in named if not self.refuses(f)]
        groups = list(self.sources.of_group.items())
        for k, (group, files) in enumerate(groups):
            share = self.args.count // len(groups) + (k < self.args.count % len(groups))
            taken = [f for _, _, f in faults]
            for f in mutation_draw.draw(self.args.seed, self.sources, files, taken, share, self.refuses):
                faults.append(("", group, f))
        self.faults = {n + 1: fault for n, fault in enumerate(faults)}

    def switched(self):
        of_file = {}
        for number, (_, _, fault) in self.faults.items():
            of_file.setdefault(fault.file, []).append((number, fault))
        return {file: mutation_draw.switched(self.sources[file], numbered) for file, numbered in of_file.items()}

    def refuse_at(self, errors):
        """Takes out of the draw what an error points at; how many that were."""
        found, others = self.copy.places(errors)
        for places in (found, others):
            guilty = [f for _, _, f in self.faults.values()
                      if any(file == f.file and f.line(self.sources[file]) <= line <=
                             self.sources[file].count("\n", 0, f.end) + 1 for file, line in places)]
            if guilty:
                self.refused |= {self.key(f) for f in guilty}
                self.refused_file.write_text(json.dumps(sorted(self.refused), indent=1))
                return len(guilty)
        sys.exit("a mutated copy does not compile, by no fault that is known:\n" + errors[:6000])

    def prepare(self):
        """A copy with as many faults as asked for that compiles."""
        notes = self.work / "checked.json"  # texts that the compiler has taken
        checked = json.loads(notes.read_text()) if notes.exists() else {}
        for attempt in range(20):
            self.plan()
            changed = self.switched()
            self.copy.take(changed)
            if attempt == 0:
                self.copy.configure()
            refused = 0
            for file, text in changed.items():
                mark = hashlib.sha256(text.encode()).hexdigest()
                if checked.get(file) == mark:
                    continue
                readers = [file] if file in self.copy.commands else self.copy.readers_of(file)[:1]
                errors = "".join(self.copy.errors_of(r) for r in readers)
                if errors:
                    refused += self.refuse_at(errors)
                else:
                    checked[file] = mark
            notes.write_text(json.dumps(checked))
            say(f"draw {attempt + 1}: {len(self.faults)} faults in {len(changed)} files, {refused} do not compile")
            if refused:
                continue
            if not (errors := self.copy.make()):
                return
            say(f"{self.refuse_at(errors)} faults do not compile in the build")
        sys.exit("no draw compiles")

    def baseline(self):
        """Runs all tests without a fault: their times and what they come by. Kept as long as a program is the same."""
        self.tests = {}  # (program, test): (seconds, faults)
        failed = []
        for program in self.programs:
            built = (self.copy.build / "bin" / program).stat().st_mtime_ns
            left_out = ":".join(self.args.without)
            notes = self.work / f"{program}.{built}.{hashlib.sha256(left_out.encode()).hexdigest()[:8]}.reached"
            if not notes.exists():
                fresh = self.work / f"{program}.reached"
                for path in (fresh, pathlib.Path(f"{fresh}.children")):
                    path.unlink(missing_ok=True)
                run = self.run_program(program, ["--gtest_filter=-*.long_*:" + left_out], 0, None, fresh)
                if not fresh.exists() or run.returncode and "[  FAILED  ]" not in run.stdout:
                    sys.exit(f"{program} does not come to its end without a fault:\n"
                             f"{run.stdout[-2000:]}{run.stderr[-2000:]}")
                fresh.rename(notes)
            for line in notes.read_text().splitlines():
                name, verdict, seconds, *reached = line.split()
                self.tests[(program, name)] = (float(seconds), set(map(int, reached)))
                if verdict == "failed":
                    failed.append(f"{program} {name}")
            say(f"{program}: {sum(p == program for p, _ in self.tests)} tests, "
                f"{sum(s for (p, _), (s, _) in self.tests.items() if p == program):.0f} s")
        if failed:
            sys.exit("these fail without a fault:\n" + "\n".join(failed))

    def run_program(self, program, options, fault, limit, notes=None):
        environment = dict(os.environ, PLATEN_FAULT=str(fault))
        environment.pop("PLATEN_FAULTS_REACHED", None)
        if notes is not None:
            environment["PLATEN_FAULTS_REACHED"] = str(notes)
        path = self.copy.build / "bin" / program
        folder = self.work / "run"
        folder.mkdir(exist_ok=True)

        def bounded():  # by the time on the processor: others may be at work on the machine
            if limit is not None:
                resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5))

        try:
            return subprocess.run([path, *options], env=environment, cwd=folder,
                                  timeout=None if limit is None else 20 * limit, preexec_fn=bounded,
                                  capture_output=True, text=True, errors="replace")
        except subprocess.TimeoutExpired as late:
            out = late.stdout or b""
            return subprocess.CompletedProcess([], -signal.SIGXCPU, out.decode(errors="replace"), "")

    def goes(self, number):
        """Tests that come by a fault, in up to three goes: quick, slower, the rest with what shares their state."""
        near = {t: s for t, (s, reached) in self.tests.items() if number in reached}
        suites = {(p, t.split(".")[0]) for p, t in near}
        beside = {t: s for t, (s, _) in self.tests.items() if t not in near and (t[0], t[1].split(".")[0]) in suites}
        goes = [[], [], []]
        total = 0.0
        for test, seconds in sorted(near.items(), key=lambda item: item[1]):
            if seconds > self.args.longest:
                continue
            total += seconds
            goes[0 if total < FIRST else 1 if total < SECOND else 2].append((test, seconds))
        goes[2] += [(t, s) for t, s in beside.items() if s < 2]
        return [go for go in goes if go]

    def kill(self, number):
        """What kills a fault and how, or that nothing does; the tests that had a go."""
        tried = 0
        for go in self.goes(number):
            for program in self.programs:
                mine = [(t, s) for (p, t), s in go if p == program]
                if not mine:
                    continue
                tried += len(mine)
                limit = 10 + math.ceil(4 * sum(s for _, s in mine))
                run = self.run_program(program, ["--gtest_filter=" + ":".join(t for t, _ in mine), "--gtest_fail_fast",
                                                 "--gtest_color=no"], number, limit)
                if run.returncode == 0:
                    continue
                begun = re.findall(r"\[ RUN      \] (\S+)", run.stdout)
                failed = re.findall(r"\[  FAILED  \] ([\w/.]+\.[\w/]+)", run.stdout)
                if run.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
                    how, test = "time", begun[-1] if begun else "?"
                elif failed:
                    how, test = "expectation", failed[0]
                else:
                    how, test = "crash", begun[-1] if begun else "?"
                return {"killed": how, "by": f"{program} {test}", "tests": tried}
        return {"killed": "", "by": "", "tests": tried}

    def run(self):
        begun = time.time()
        self.prepare()
        say("built")
        if self.args.build:
            return 0
        self.baseline()
        last = self.work / "result.json"
        old = {}
        if last.exists():
            old = {(r["file"], r["line_text"], r["before"], r["after"]): r for r in json.loads(last.read_text())["faults"]}
        results = []
        self.result = {"seed": self.args.seed, "gone": self.gone, "faults": results}
        for number, (name, group, fault) in self.faults.items():
            key = self.key(fault)
            entry = {"number": number, "name": name, "group": group, "kind": fault.kind, "file": fault.file,
                     "line": fault.line(self.sources[fault.file]), "line_text": key[1], "before": key[2],
                     "after": key[3] or ("false" if not fault.statement else "")}
            ident = (entry["file"], entry["line_text"], entry["before"], entry["after"])
            was = old.get(ident)
            wanted = (not self.args.survivors or was is None or not was["killed"]) and (
                not self.args.only or number in self.args.only)
            entry |= self.kill(number) if wanted else {k: was[k] for k in ("killed", "by", "tests")} if was else {
                "killed": "not run", "by": "", "tests": 0}
            entry["argument"] = "" if entry["killed"] else self.argued.get(ident, "")
            results.append(entry)
            if wanted:
                last.write_text(json.dumps(self.result, indent=1))
                say(f"{number:3} {entry['file']}:{entry['line']} {entry['kind']}: {entry['before'][:60]} -> "
                    f"{entry['after'][:60] or 'left out'} | {entry['killed'] or 'SURVIVES'} {entry['by']} "
                    f"({entry['tests']} tests)")
        self.result["seconds"] = round(time.time() - begun)
        last.write_text(json.dumps(self.result, indent=1))
        return self.sum_up()

    def sum_up(self):
        faults = self.result["faults"]
        survivors = [f for f in faults if not f["killed"]]
        say(f"{len(faults)} faults, {len(survivors)} survive, {sum(bool(f['argument']) for f in survivors)} of them "
            f"argued; {self.result['seconds']} s")
        for f in survivors:
            print(f"  {f['number']} {f['file']}:{f['line']} {f['kind']}: {f['before']} -> {f['after'] or 'left out'}"
                  f"{' [' + f['argument'] + ']' if f['argument'] else ''}")
        for name in self.gone:
            print(f"  not found: {name}")
        for place in self.stale:
            print(f"  argued, but no longer there: {place}")
        good = len(survivors) <= ALLOWED * len(faults) and all(f["argument"] for f in survivors)
        return 0 if good and not self.stale else 1


def page(result, before):
    """The page of the result: what each fault was, and what has killed it; what an older page says above its list stays."""

    def cell(text):
        text = text.replace("|", "\\|")
        return f"`{text if len(text) < 90 else text[:87] + '...'}`" if text else "left out"

    def verdict(f):
        if not f["killed"]:
            return "**survives**: " + f["argument"] if f["argument"] else "**survived**"
        return {"expectation": "", "crash": "crash: ", "time": "time: "}.get(f["killed"], "") + f["by"].split(" ")[-1]

    ways = {way: sum(f["killed"] == way for f in result["faults"]) for way in ("", "expectation", "crash", "time")}
    head = f"{len(result['faults'])} faults, seed"
    lines = ["# Single faults, and the tests that notice them", "",
             f"{head} {result['seed']}: {ways['']} survive, {ways['expectation']} are killed by an expectation, {ways['crash']} by a crash, "
             f"{ways['time']} by time.", "", "|  | where | fault | text | becomes | killed by |", "|" + "---|" * 6]
    lines += [f"| {f['number']} | {f['file']}:{f['line']} | {f['name'] or f['kind']} | {cell(f['before'])} | {cell(f['after'])} | {verdict(f)} |"
              for f in result["faults"]]
    text, old = "\n".join(lines) + "\n", re.search(r"^\d+ faults, seed", before, re.MULTILINE)
    return before[: old.start()] + text[text.index(head) :] if old else text


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("work", type=pathlib.Path, nargs="?", metavar="WORK")
    parser.add_argument("--count", type=int, default=120)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cores", type=int, default=os.cpu_count())
    parser.add_argument("--longest", type=float, default=12, help="s, of a test without a fault")
    parser.add_argument("--only", type=int, nargs="+", default=[])
    parser.add_argument("--build", action="store_true", help="... and nothing else")
    parser.add_argument("--survivors", action="store_true")
    parser.add_argument("--without", nargs="+", default=[], metavar="PATTERN", help="tests to leave out")
    parser.add_argument("--write", type=pathlib.Path, metavar="FILE")
    parser.add_argument("--check", action="store_true")
    args = parser.parse_args()
    if not args.check and args.work is None:
        parser.error("WORK is missing: a scratch folder")
    return args


def check():
    sources = Sources(json.loads((DATA / "groups.json").read_text())["groups"])
    empty = [group for group, files in sources.of_group.items() if not files]
    named, gone = named_faults(sources)
    argued, stale = equivalents(sources)
    for text in [f"no file in group: {g}" for g in empty] + [f"not found: {g}" for g in gone] + [
            f"argued, but no longer there: {s}" for s in stale]:
        print(text)
    print(f"{len(named)} named faults, {len(argued)} argued")
    return 1 if empty or gone or stale else 0


def main():
    args = arguments()
    if args.check:
        return check()
    os.nice(max(0, 10 - os.nice(0)))
    mutation = Mutation(args)
    status = mutation.run()
    if args.write and not args.build:
        args.write.write_text(page(mutation.result, args.write.read_text() if args.write.is_file() else ""))
    return status


if __name__ == "__main__":
    sys.exit(main())
