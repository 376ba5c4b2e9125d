#!/usr/bin/env python3
"""Page of all scenes: a picture of each, what to see, its main numbers and what it cost, from real runs.

    scripts/gallery.py BUILD RUNS                   runs scenes that RUNS lacks, draws reports, prints the page
    scripts/gallery.py BUILD RUNS --write           ... and writes it to docs/gallery.md and docs/images/gallery; a
                                                    scene that RUNS lacks keeps what the page says of it
    scripts/gallery.py BUILD RUNS --scene NAME ...  runs no scene but these, long ones too
    scripts/gallery.py --check                      runs none: every scene has its place, every picture is there

BUILD is a build folder with the programs; RUNS gets a folder for each scene, which is kept and shown as long as its
run is whole. As many runs as cores at a time, one thread each, with low priority. Scenes are listed in
scripts/gallery_scenes.py.
Exit status: 0; 1 where a run fails, a number that its scene expects does not come out or a check does not hold; 2 on
bad input.
"""

import argparse
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import textwrap
from typing import NamedTuple, Optional

import small_png
from gallery_numbers import tables
from gallery_scenes import GROUPS

SOURCE = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(SOURCE / "python"))
import platen

SCENES = SOURCE / "scenes"
PAGE = SOURCE / "docs/gallery.md"
IMAGES = SOURCE / "docs/images/gallery"
LARGEST = 120_000  # bytes of a picture
WIDTHS = (800, 640, 480)  # pixels, tried in turn until a picture is small enough
HEADING = """# Gallery

Every scene of `scenes/`, run as it stands (long ones at an earlier time, or not at all: their sections say so): what to see, a picture from its
report, its main numbers, and what it cost.
Written by `scripts/gallery.py BUILD RUNS --write`; only the sentences on what to see, which stand first in each section, are written by
hand, here. As many runs at a time as the machine has cores, with low priority: seconds are upper bounds. One seed each, but for studies;
strengths scatter by a few percent from seed to seed.
"""


class Result(NamedTuple):
    """What stands in the folder of a scene: nothing where it was not run."""

    summary: Optional[dict] = None
    machine: str = ""
    missed: list = []  # numbers that the scene expects, and targets of a calibration
    fast: str = ""  # what was not quasi-static
    expects: bool = False
    fault: str = ""  # why there is no run, or no picture


def whole(folder):
    """The run's summary, None where it did not come to its end."""
    run = platen.Run(folder) if (folder / "summary.json").exists() else None
    return run.summary if run and run.status == "done" else None


def said(command):
    """Runs a program of ours; its status and the last line that it wrote about an error."""
    done = subprocess.run([str(c) for c in command], cwd=SOURCE, capture_output=True, text=True)
    return done.returncode, (done.stderr.strip().splitlines() or ["no word of why"])[-1]


def run(scene, build, folder):
    """What it said where it failed, else nothing."""
    program, *kind = scene.program.split()
    path = SCENES / f"{scene.name}.prm"
    print(f"{scene.name}: runs", file=sys.stderr)
    status, word = said([build / "apps" / program, *kind, path.relative_to(SOURCE), "-o", folder, "-t", "1",
                         "--overwrite"])
    return "" if status in (0, 1) else f"{program} ended with status {status}: {word}"  # 1: a number missed, in the log


def draw(scene, build, folder, small):
    """Draws the report where it is older than its run, and from it the small picture if asked to. As `run`."""
    large = folder / "pictures" / f"{scene.picture}.png"
    if not large.exists() or large.stat().st_mtime < (folder / "summary.json").stat().st_mtime:
        print(f"{scene.name}: report", file=sys.stderr)
        status, word = said([build / "apps" / "platen-report", folder, "--quiet"])
        if status != 0:
            return f"platen-report ended with status {status}: {word}"
    if not large.exists():
        return f"platen-report has not drawn {large.name}"
    for width in WIDTHS if small else ():
        small_png.make_small(str(large), str(small), width)
        if small.stat().st_size <= LARGEST:
            return ""
    return f"{small.name} stays above {LARGEST} bytes" if small else ""


def result_of(scene, build, runs, may_run, write):
    """Runs the scene where that is wanted and was not done, draws, and reads what is there."""
    folder = runs / scene.name
    fault = ""
    if may_run and not whole(folder):
        fault = run(scene, build, folder)
    summary = whole(folder)
    if not summary:
        return Result(fault=fault)
    if scene.picture:
        fault = draw(scene, build, folder, IMAGES / f"{scene.name}.png" if write else None)
    if summary.get("failed_runs"):
        fault = f"{summary['failed_runs']} of its runs have failed, see run.log"
    log = (folder / "run.log").read_text()
    expects = (folder / "scene.prm").read_text().split("subsection Expect", 1)[1].split("\nend", 1)[0]
    machine = re.findall(r"^machine (.*?, \d+ cores)", log, re.M)
    missed = re.findall(r"^error: (?:expected|target missed): (.*)", log, re.M)
    return Result(summary, machine[-1], missed, too_fast(folder, log), bool(re.search(r"= *[^ \n]", expects)), fault)


def too_fast(folder, log):
    """What the program said of the speed of a run, and of how many runs of a study; "" where all were slow enough."""
    said_of_run = re.findall(r"^warning: too fast to be quasi-static.*?: (.*)", log, re.M)
    if said_of_run:
        return f"Too fast to be quasi-static: {said_of_run[-1]}."
    runs = [platen.Run(path.parent).summary for path in sorted(folder.glob("runs/*/summary.json"))]
    fast = sum(summary.get("quasi_static") is False for summary in runs)
    return f"{fast} of {len(runs)} runs are too fast to be quasi-static." if fast else ""


def spaced(count):
    return f"{count:,}".replace(",", " ")


def cost(result):
    """What was computed, for how long, on what, by which version."""
    s = result.summary
    kinds = {"particles": "sphere", "bonds": "bond", "steps": "step", "runs": "run", "trials": "trial"}
    counts = [f"{spaced(s[key])} {word}{'s' * (s[key] > 1)}" for key, word in kinds.items()
              if isinstance(s.get(key), int) and s[key] > 0]
    threads = "one thread" if s["threads"] == 1 else f"{s['threads']} threads"
    seconds = s["wall_seconds"]
    return f"{', '.join(counts)}; {seconds:{'.2g' if seconds < 10 else '.0f'}} s on {threads}, {result.machine}; {s['version']}."


def verdict(result):
    if result.missed:
        kind = "Missed on unseen packings" if "targets_missed" in result.summary else "Expected, but"
        words = [f"**{kind}:** " + "; ".join(result.missed) + "."]
    elif result.summary.get("targets"):
        words = ["All targets are met on unseen packings."]
    else:
        words = ["What the scene expects came out." if result.expects else "The scene expects no numbers."]
    return " ".join(words + ([result.fast] if result.fast else []))


def command(scene, result):
    program, *rest = scene.program.split()
    threads = str(result.summary["threads"]) if result.summary else "1"
    return "    " + " ".join([f"build/apps/{program}", *rest, f"scenes/{scene.name}.prm", "-t", threads])


def wrapped(text):
    return textwrap.fill(text, 120, break_long_words=False, break_on_hyphens=False)


def kept_sections():
    """What the page says of each scene, by the scene's name."""
    sections = re.findall(r"^### (\S+)\n(.*?)(?=^##|\Z)", PAGE.read_text(), re.M | re.S)
    return {name: f"### {name}\n{body.rstrip()}\n" for name, body in sections}


def sentence_of(section):
    """What to see, by hand: the first paragraph of a section, without the title of the scene; "" where there is none."""
    first = re.match(r"### \S+\n\n(?:\*\*.*?\*\*\s*)?([^!|\n].*?)\n\n", section, re.S)
    return " ".join(first[1].split()) if first else ""


def section(scene, result, kept):
    """All that the page says of a scene. What it said before, where its run is not here."""
    before = kept.get(scene.name, "")
    if "\n|" in before and not result.summary and not result.fault:
        return before
    parts, see = [f"### {scene.name}"], sentence_of(before)
    if result.summary:
        parts.append(f"**{result.summary['scene']}.** {see}")
        if scene.picture and not result.fault:
            parts.append(f"![{result.summary['scene']}](images/gallery/{scene.name}.png)")
        parts += [*tables(result.summary), f"{cost(result)} {verdict(result)}"]
    else:
        parts.append(see)
        if not result.fault:
            parts.append(f"Not run here: {scene.cost}." if scene.cost else "Not run yet.")
    if result.fault:
        parts.append(f"**Fails:** {result.fault}.")
    texts = [p if p.startswith(("###", "!", "|")) else wrapped(p) for p in parts]
    return "\n\n".join(texts + [command(scene, result)]) + "\n"


def page(results):
    texts, kept = [HEADING], kept_sections()
    for title, scenes in GROUPS:
        texts += [f"## {title}\n"] + [section(scene, results[scene.name], kept) for scene in scenes]
    return "\n".join(texts)


def check(listed):
    """Faults of list, page and pictures, as texts."""
    there, text = {p.stem for p in SCENES.glob("*.prm")}, PAGE.read_text()
    named, made = set(re.findall(r"\(images/gallery/(.*?)\.png\)", text)), {p.stem for p in IMAGES.glob("*.png")}
    faults = [f"scenes/{name}.prm is not in gallery_scenes.py" for name in sorted(there - set(listed))]
    faults += [f"gallery_scenes.py: there is no scenes/{name}.prm" for name in listed if name not in there]
    faults += [f"gallery_scenes.py: {name} stands there twice" for name in there if listed.count(name) > 1]
    faults += [f"{PAGE.name}: names {name}.png, which is not there" for name in sorted(named - made)]
    faults += [f"{PAGE.name}: does not show {name}.png" for name in sorted(made - named)]
    faults += [f"{PAGE.name}: does not say what to see in {name}" for name, section in kept_sections().items() if not sentence_of(section)]
    if re.findall(r"^### (.*)", text, re.M) != listed:
        faults.append(f"{PAGE.name}: has not the scenes of gallery_scenes.py; write it anew")
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", nargs="?", type=pathlib.Path, help="build folder")
    parser.add_argument("runs", nargs="?", type=pathlib.Path, help="folder for results")
    parser.add_argument("--scene", nargs="+", metavar="NAME", help="run no scene but these")
    parser.add_argument("--write", action="store_true", help="write docs/gallery.md and its pictures")
    parser.add_argument("--check", action="store_true", help="run nothing: check list, page and pictures")
    options = parser.parse_args()
    scenes = [scene for _, group in GROUPS for scene in group]
    listed = [scene.name for scene in scenes]
    if options.check:
        faults = check(listed)
        print("\n".join(faults) or f"{len(listed)} scenes have their place")
        return 1 if faults else 0
    if not options.runs or not (options.build / "apps/platen-report").exists():
        parser.error("needs a folder in which the programs are built, and one for results")
    if unknown := set(options.scene or []) - set(listed):
        parser.error("no such scene: " + ", ".join(sorted(unknown)))
    if options.write:
        IMAGES.mkdir(parents=True, exist_ok=True)
    build, runs = options.build.resolve(), options.runs.resolve()
    with concurrent.futures.ProcessPoolExecutor(initializer=os.nice, initargs=(10,)) as pool:
        wanted = options.scene or [s.name for s in scenes if not s.cost]
        waiting = {s.name: pool.submit(result_of, s, build, runs, s.name in wanted, options.write) for s in scenes}
        results = {name: future.result() for name, future in waiting.items()}
    if options.write:
        PAGE.write_text(page(results))
    else:
        print(page(results))
    return 1 if any(r.fault or r.missed for r in results.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
