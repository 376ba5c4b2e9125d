#!/usr/bin/env python3
"""Types the lessons of docs/tutorial as they stand, in one folder, and checks what they say.

    lessons.py APPS DOCS [FOLDER]     APPS: folder of the programs, or - where they are in the PATH
    lessons.py --built-by DEMO DOCS   types nothing: the script DEMO builds all that the lessons type

Code blocks of `sh` are run one after the other; `sh status=2` has to end so. Comments in the text say what it claims, and
claims are checked where they stand; a number that is claimed has to be in the text that follows its comment:

    said: WORDS                           the last block printed them
    there: FILE                           is there, and not empty
    figure: FILE KEY FACTOR VALUE SCATTER  of a summary.json: FACTOR * value is VALUE +- SCATTER
    figure: FILE KEY WORD                 the value is that word
    below: FILE KEY BOUND                 the value is below it
    ratio: FILE OTHER KEY VALUE SCATTER   of the values in both
    number: WORDS VALUE SCATTER           the last block printed a number after the words
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

faults = []


def value_in(folder, file, key):
    value = json.loads((folder / file).read_text())
    for part in key.split("/"):
        value = value[part]
    return value


def check(condition, where, text):
    print(f"    {'holds' if condition else 'DOES NOT HOLD'}: {text}", flush=True)
    if not condition:
        faults.append(f"{where}: {text}")


def near(where, what, value, expected, scatter):
    good = isinstance(value, (int, float)) and abs(value - float(expected)) <= float(scatter)
    check(good, where, f"{what} = {value if not good else format(value, '.4g')}, the lesson says {expected} +- {scatter}")


def claim(words, folder, said, where):
    kind, _, rest = words.partition(":")
    parts = rest.split()
    if kind == "said":
        check(rest.strip() in said, where, f"the program says \"{rest.strip()}\"")
    elif kind == "there":
        path = folder / parts[0]
        check(path.is_file() and path.stat().st_size > 0, where, f"{parts[0]} is there")
    elif kind == "figure" and len(parts) == 3:
        found = value_in(folder, parts[0], parts[1])
        check(found == parts[2], where, f"{parts[1]} = {found}, the lesson says {parts[2]}")
    elif kind == "figure":
        near(where, parts[1], float(parts[2]) * value_in(folder, parts[0], parts[1]), parts[3], parts[4])
    elif kind == "below":
        found = value_in(folder, parts[0], parts[1])
        check(found < float(parts[2]), where, f"{parts[1]} = {found:.3g}, the lesson says below {parts[2]}")
    elif kind == "ratio":
        near(where, parts[2], value_in(folder, parts[0], parts[2]) / value_in(folder, parts[1], parts[2]), *parts[3:])
    elif kind == "number":
        words = " ".join(parts[:-2])
        found = re.search(re.escape(words) + r"\s*([-+0-9.e]+)", said)
        near(where, words, float(found.group(1)) if found else None, *parts[-2:])
    else:
        check(False, where, f"no such claim: {words}")


def claimed_number(words):
    """What has to stand in the text after the comment; None where nothing has."""
    kind, _, rest = words.partition(":")
    parts = rest.split()
    if kind == "figure":
        return parts[2] if len(parts) == 3 else parts[3]
    return {"below": lambda: parts[2], "ratio": lambda: parts[3], "number": lambda: parts[-2]}.get(kind, lambda: None)()


def run(block, status, folder, environment, where):
    start = time.time()
    done = subprocess.run(["bash", "-e", "-c", block], cwd=folder, env=environment, text=True, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    print(f"  {block.strip().splitlines()[-1]}   ({time.time() - start:.1f} s)", flush=True)
    check(done.returncode == status, where, f"status {done.returncode}, {status} is expected")
    if done.returncode != status:
        print(done.stdout[-3000:])
    return done.stdout


def type_lesson(path, folder, environment):
    print(path.name, flush=True)
    said, lines, k = "", path.read_text().splitlines(), 0
    while k < len(lines):
        where = f"{path.name}:{k + 1}"
        fence = re.match(r"```sh(?: status=(\d+))?$", lines[k])
        comment = re.match(r"<!-- (.*) -->$", lines[k])
        if fence:
            end = lines.index("```", k + 1)
            said = run("\n".join(lines[k + 1 : end]) + "\n", int(fence.group(1) or 0), folder, environment, where)
            k = end
        elif comment:
            try:
                claim(comment.group(1), folder, said, where)
            except (OSError, KeyError, TypeError, ValueError) as error:
                check(False, where, f"{comment.group(1)}: {error!r}")
            number = claimed_number(comment.group(1))
            text = " ".join(line for line in lines[k + 1 : k + 14] if not line.startswith("<!--"))
            if number is not None:
                check(re.search(r"(?<![0-9.])" + re.escape(number) + r"(?![0-9]|\.[0-9])", text) is not None, where,
                      f"the text names {number}")
        k += 1


def programs_typed(lesson):
    """Targets of the build that a lesson's blocks need."""
    blocks = "\n".join(re.findall(r"```sh.*?\n(.*?)```", lesson.read_text(), re.DOTALL))
    typed = set(re.findall(r"(?:^|\$\(|\| )(platen(?:-[a-z]+)?)\b", blocks, re.MULTILINE))
    typed |= {f"platen-{job}" for job in re.findall(r"(?:^|\$\()platen (pack|bonds|bar|compress|brazilian|calibrate|study|report)\b", blocks, re.MULTILINE)}
    return typed | ({"platen_core"} if "import platen" in blocks else set())


def check_demo(script, docs):
    """Whoever has run the demo can type the lessons."""
    builds = re.search(r"scripts/build\.sh (.*)", script.read_text())
    built = set(builds.group(1).split()) if builds else set()
    typed = set().union(*(programs_typed(lesson) for lesson in docs.glob("lesson*.md")))
    print(f"typed: {' '.join(sorted(typed))}; built: {' '.join(sorted(built))}; missing: {' '.join(sorted(typed - built)) or 'none'}")
    sys.exit(1 if typed - built or len(typed) < 5 else 0)


def main():
    if len(sys.argv) == 4 and sys.argv[1] == "--built-by":
        check_demo(Path(sys.argv[2]), Path(sys.argv[3]))
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    environment = dict(os.environ)
    if sys.argv[1] != "-":
        apps = Path(sys.argv[1]).resolve()
        environment["PATH"] = f"{apps}:{environment['PATH']}"
        environment["PYTHONPATH"] = str(apps.parent / "python")
        # python3 of the lessons is the one that the package was built for
        if Path("/usr/bin/python3").exists():
            environment["PATH"] = "/usr/bin:" + environment["PATH"]
    lessons = sorted(Path(sys.argv[2]).resolve().glob("lesson*.md"))
    with tempfile.TemporaryDirectory(prefix="platen lessons ") as temporary:
        folder = Path(sys.argv[3]).resolve() if len(sys.argv) > 3 else Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        for lesson in lessons:
            type_lesson(lesson, folder, environment)
    print(f"{len(lessons)} lessons, {len(faults)} faults")
    for fault in faults:
        print("fault:", fault)
    sys.exit(1 if faults or not lessons else 0)


if __name__ == "__main__":
    main()
