#!/usr/bin/env python3
"""Builds the fuzzers of the readers and lets them run, two at a time.

    fuzz.py BUILD [--runs 1200000] [--only fuzz_tables ...] [--seed 1]

BUILD is a folder for a build with Clang, made where it is not there; BUILD/corpus keeps what runs find, for the next ones to
go on from. They begin with the scenes of the project, the faulty ones of the tests, and a small checkpoint. An input that
ends a fuzzer stays in BUILD. Exit status: 0; 1 where an input crashes, leaks, takes more than a second or 2 GB; 77 where
there is no Clang. An hour on two cores.
"""

import concurrent.futures
import copy
import os
import pathlib
import re
import resource
import subprocess
import sys

import faults

# Share of the runs: a scene with all its checks takes some hundred times as long as a table.
SHARES = {"fuzz_scene_text": 0.1, "fuzz_scene": 0.01, "fuzz_tables": 0.39, "fuzz_checkpoint": 0.3, "fuzz_mesh": 0.2}
LARGEST = 4096  # bytes of an input
CORNERS = [f"{x} {y} {z}" for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
MESH = ("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n" + "".join(f"{k + 1} {at}\n" for k, at in enumerate(CORNERS)) +
        "$EndNodes\n$Elements\n3\n1 1 2 0 1 1 2\n2 3 2 9 1 1 2 3 4\n3 5 2 7 1 1 2 3 4 5 6 7 8\n$EndElements\n")
BLOCKS = ("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 9 \"foot\"\n$EndPhysicalNames\n"
          "$Entities\n0 0 1 1\n1 0 0 0 1 1 0 1 9 0\n1 0 0 0 1 1 1 1 7 1 1\n$EndEntities\n"
          "$Nodes\n1 8 1 8\n3 1 0 8\n" + "".join(f"{k}\n" for k in range(1, 9)) + "\n".join(CORNERS) + "\n"
          "$EndNodes\n$Elements\n2 2 1 2\n2 1 3 1\n1 1 2 3 4\n3 1 5 1\n2 1 2 3 4 5 6 7 8\n$EndElements\n")


def faulty_scenes():
    """Texts by name from tests/apps/faulty.txt, which says itself how they are written."""
    bases, blocks, base = {}, {}, ""
    for line in (faults.SOURCE / "tests/apps/faulty.txt").read_text().splitlines():
        text = line.strip().partition(" > ")[0]
        if text == "" or text.startswith(("#", "> ")):
            continue
        if line.startswith("["):
            base, _, other = line[1:-1].partition(": ")
            entries, lines = bases.setdefault(base, copy.deepcopy(bases[other]) if other else ({}, []))
            continue
        if not line.startswith(" "):
            kind = "json" if base.startswith("json") else "prm"
            entries, lines = blocks[f"faulty_{len(blocks)}.{kind}"] = copy.deepcopy(bases[base])
        if text.startswith("| "):
            lines.append(text[2:])
        elif text.startswith("- "):
            entries.pop(text[2:], None)
        else:
            key, _, value = text.partition(" =")
            entries[key] = value
    scenes = {}
    for name, (entries, lines) in blocks.items():
        text = ""
        for key, value in entries.items():
            *sections, key = key.split("/")
            text += "".join(f"subsection {word}\n" for word in sections) + f"set {key} ={value}\n" + "end\n" * len(sections)
        scenes[name] = (text + "".join(line + "\n" for line in lines)).encode()
    return scenes


def seed(folder):
    """Inputs to begin with, a folder for each fuzzer."""
    corpus = {name: folder / "corpus" / name for name in SHARES}
    for path in corpus.values():
        path.mkdir(parents=True, exist_ok=True)
    scenes = {path.name: path.read_bytes() for path in [*faults.SOURCE.glob("scenes/*.prm"), faults.CRUSHED]} | faulty_scenes()
    for name, text in scenes.items():
        (corpus["fuzz_scene_text"] / name).write_bytes(text)
        (corpus["fuzz_scene"] / name).write_bytes(b"\x03" + text)  # as platen-compress reads it
    tables = {"cylinder": b"\1# shape: cylinder radius_m=0.01 height_m=0.02\nx_m,y_m,z_m,radius_m\n0,0.001,0.01,0.001\n",
              "box": b"\1# shape: box width_x_m=1 width_y_m=2 height_m=3\r\nx_m,y_m,z_m,radius_m\r\n1,1,1e-1,0.5\r\n",
              "disc": b"\1# shape: disc radius_m=1 thickness_m=2\nx_m,y_m,z_m,radius_m\n\n# no sphere\n 1 , 1 ,1,.5\n",
              "ids": b"\x03# ids\n12\n13 # and another\n\n0\n"}
    for name, text in tables.items():
        (corpus["fuzz_tables"] / name).write_bytes(text)
    for name, text in {"singly": MESH, "in_blocks": BLOCKS}.items():
        (corpus["fuzz_mesh"] / name).write_text(text)
    checkpoint = folder / "seed.platen"
    subprocess.run([folder / "bin/fuzz_checkpoint"], check=True, env={**os.environ, "PLATEN_FUZZ_SEED": str(checkpoint)})
    for first in (b"\0", b"\1"):
        (corpus["fuzz_checkpoint"] / f"whole_{first[0]}").write_bytes(first + checkpoint.read_bytes())
    words = {word for text in scenes.values() for word in re.findall(rb"[A-Za-z][A-Za-z ]{2,30}(?= =|\n|\"|$)", text)}
    words |= {b"subsection ", b"set ", b"end", b"include ", b"\\\n", b"MPa", b"mm", b" degree", b"R_min", b"1e308", b"{\"", b"\": "}
    escaped = ["".join(f"\\x{letter:02x}" for letter in word) for word in sorted(words)]
    (folder / "words.txt").write_text("".join(f'"{word}"\n' for word in escaped))
    return corpus


def fuzz(folder, name, corpus, runs, first):
    """(runs, largest memory in MB, inputs that ended it or were slow) of one fuzzer, which goes on after each."""
    done, memory = 0, 0
    before = set(folder.glob(f"{name}-*"))
    while done < runs and len(set(folder.glob(f"{name}-*")) - before) < 10:
        words = [f"-dict={folder / 'words.txt'}"] if "scene" in name else []
        ran = subprocess.run(
            [folder / "bin" / name, corpus, *words, f"-runs={runs - done}", f"-seed={first + done}", f"-max_len={LARGEST}",
             "-timeout=60", "-report_slow_units=1", "-rss_limit_mb=2048", "-print_final_stats=1",
             f"-artifact_prefix={folder / name}-"], capture_output=True, text=True, errors="replace")
        told = {key: int(value) for key, value in re.findall(r"stat::(\w+):\s+(\d+)", ran.stderr)}
        counts = [int(count) for count in re.findall(r"^#(\d+)", ran.stderr, re.M)]
        done += max([told.get("number_of_executed_units", 0), *counts, 1])
        memory = max([memory, told.get("peak_rss_mb", 0), *map(int, re.findall(r"rss: (\d+)Mb", ran.stderr))])
        if ran.returncode != 0:
            print(f"{name}:\n{ran.stderr[-3000:]}", file=sys.stderr)
    return done, memory, sorted(set(folder.glob(f"{name}-*")) - before)


def is_slow(folder, name, path):
    """Whether an input takes more than a second of the processor: on a busy machine, others seem to."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([folder / "bin" / name, path], capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime > 1


def main():
    parser = faults.parser(__doc__)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=1200000, help="of all fuzzers together")
    parser.add_argument("--only", nargs="+", choices=SHARES, default=list(SHARES))
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    folder = options.build.resolve()
    faults.build_with(folder, ["-DPLATEN_FUZZ=ON"], faults.clang())
    subprocess.run(["cmake", "--build", folder], check=True, stdout=sys.stderr)
    corpus = seed(folder)
    share = sum(SHARES[name] for name in options.only)
    figures = faults.Figures(34)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        started = [pool.submit(fuzz, folder, name, corpus[name], int(options.runs * SHARES[name] / share), options.seed)
                   for name in options.only]
        results = [one.result() for one in started]
    crashes = slow = large = 0
    for name, (runs, memory, inputs) in zip(options.only, results):
        print(f"{name}: {runs} runs, {memory} MB, {len(inputs)} inputs looked at again")
        for path in inputs:
            if "-slow-unit-" in path.name or "-timeout-" in path.name:
                slow += is_slow(folder, name, path)
            else:
                crashes, large = crashes + ("-oom-" not in path.name), large + ("-oom-" in path.name)
    figures.at_least("runs", sum(runs for runs, _, _ in results), 1000000 if set(options.only) == set(SHARES) else 1)
    figures.exactly("crashes and leaks", crashes, 0)
    figures.exactly("inputs that take more than a second", slow, 0)
    figures.exactly("inputs that take more than 2 GB", large, 0)
    figures.note("memory in MB", max(memory for _, memory, _ in results), "< 2048")
    return figures.status()


if __name__ == "__main__":
    sys.exit(main())
