#!/usr/bin/env python3
"""Kills runs that write checkpoints at random moments, and resumes them.

    kills.py platen-compress [--kills 200] [--seed 1]

A run is killed, resumed, killed again and so on until it ends: rigid and elastic platens and a sleeve in turn. Every fourth
kill comes at any moment, set-up included, the others once the run has written a checkpoint. After every kill the resumed
run finds a whole checkpoint, passes over none, and what the last one leaves has the bytes of a run that nobody killed.
Exit status: 0; 1 where that does not hold. Ten minutes.
"""

import argparse
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

import faults

STEPS = {"rigid": 5, "elastic": 20, "sleeve": 20}  # between checkpoints: most of the time goes into writing them


class Chain:
    """One run and what is left of it from kill to kill."""

    def __init__(self, program, kind, folder):
        entries = faults.TINY + faults.PLATENS[kind] + [f"Checkpoint/Every = {STEPS[kind]}"]
        self.base = faults.command(program, faults.CRUSHED, folder, entries)
        self.folder = folder

    def checkpoints(self):
        return sorted((self.folder / "checkpoint").glob("step_????????????.platen"))

    def start(self, threads, *options):
        return subprocess.Popen([*self.base, "-t", str(threads), *options], stdin=subprocess.DEVNULL,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def killed_after(self, seconds, threads, first, at_work):
        """Starts a run and kills it `seconds` after its start, or, where it is to be at work, after its next checkpoint.
        Gives its status and what it has said. A run without any checkpoint is not killed."""
        before = self.checkpoints()
        process = self.start(threads, *([] if first else ["--resume"]))
        while (first or at_work) and self.checkpoints() == before and process.poll() is None:
            time.sleep(1e-3)
        try:
            process.wait(seconds)
        except subprocess.TimeoutExpired:
            process.kill()
        return "killed" if process.wait() == -signal.SIGKILL else process.returncode, process.stderr.read()


def whole_run(program, kind, folder, figures):
    """Results of the run that is not killed, and its seconds."""
    begin = time.monotonic()
    chain = Chain(program, kind, folder)
    process = chain.start(1)
    if process.wait() != 0:
        figures.fail(f"{kind}: {process.stderr.read()}")
    return faults.results(folder), time.monotonic() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path, help="platen-compress")
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    draw = random.Random(options.seed)
    figures = faults.Figures(35)
    kills = in_a_write = passed_over = chains = unlike = 0
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        whole = {kind: whole_run(options.program, kind, scratch / kind, figures) for kind in faults.PLATENS}
        while kills < options.kills and not figures.failures:
            kind = list(whole)[chains % len(whole)]
            wanted, seconds = whole[kind]
            chain = Chain(options.program, kind, scratch / f"{kind}_{chains}")
            status, first = "killed", True
            while status == "killed":
                at_work = draw.random() < 0.75
                delay = draw.uniform(0, 0.1 * seconds if at_work else 1)
                status, said = chain.killed_after(delay if kills < options.kills else 1e3, draw.choice([1, 2]), first,
                                                  at_work)
                passed_over += said.count("checkpoint not used")
                first = False
                kills += status == "killed"
                in_a_write += status == "killed" and any((chain.folder / "checkpoint").glob("*.part.platen"))
                if status not in ("killed", 0):
                    figures.fail(f"{kind}, after {kills} kills: status {status}: {said}")
            chains += 1
            files = faults.difference(wanted, faults.results(chain.folder))
            unlike += bool(files)
            if files:
                figures.fail(f"{kind}, after {kills} kills: not as in the run that was not killed: {files}")
    figures.at_least("kills", kills, options.kills)
    figures.note("kills within the write of a checkpoint", in_a_write, "any")
    figures.exactly("checkpoints that were not whole", passed_over, 0)
    figures.note("runs killed again and again", chains, "any")
    figures.exactly("of them ended otherwise", unlike, 0)
    return figures.status()


if __name__ == "__main__":
    sys.exit(main())
