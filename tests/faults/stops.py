#!/usr/bin/env python3
"""Stops runs and resumes them: what the last one leaves has the bytes of a run that nobody stopped.

    stops.py kills APPS [--kills 200] [--seed 1] [--mpiexec MPIEXEC [--environment "NAME=VALUE ..."]]
        Kills at random moments: a run that writes checkpoints is killed, resumed, killed again and so on until it ends; rigid and elastic platens and
        a sleeve in turn. Every fourth kill comes at any moment, set-up included, the others once the run has written a checkpoint. After every third
        one the newest checkpoint is damaged, by a bit or a cut: the resumed run passes over it and says so, and over no other. Where no checkpoint is
        whole a run is refused. Ten minutes.
        With --mpiexec one of 2 to 4 ranks is killed, and the run is resumed on another number; at least two of five kills come while a checkpoint is
        being written. Ten minutes of two idle cores for 50 kills.
    stops.py stages APPS [--scenes NAME ...]
        The shipped scenes of several sides and stages, of few spheres, are stopped (SIGINT) in each of their stages, once the history has a row of
        it, and resumed with 1, 2 or 4 threads.

APPS is the folder of the programs. Exit status: 0; 1 where that does not hold.
"""

import os
import pathlib
import random
import shutil
import signal
import sys
import time

import faults

PART = "*.part.platen"
ON_RANKS = ["Loading/Axial rate = 2 m/s", "Loading/Target strain = 0.004", "Loading/Stop at residual = 0", "Output/Every = 8",
            "Output/Fields every = 160", "Checkpoint/Every = 4"]
STEPS = {"rigid": 5, "elastic": 20, "sleeve": 20}  # between checkpoints: most of the time goes into writing them
STAGED = {
    "biaxial_steel": ["Specimen/Sphere radius = 3.2 mm"],
    "biaxial_brush": ["Specimen/Sphere radius = 3.2 mm", "Platens/Degree = 1", "Loading/Stage 1/Until = strain 0.3 %"],
    "true_triaxial": ["Specimen/Sphere radius = 4 mm"],
    "hold_concrete": ["Specimen/Sphere radius = 4 mm"],
    "multistage_triaxial": ["Specimen/Sphere radius = 4 mm"],
    "class_two_concrete": ["Specimen/Sphere radius = 4 mm"],
}
THREADS = (1, 2, 4)


def process_of_rank(mpirun, rank):
    """Process id of a rank; None where it has ended. Ranks are the children of mpirun."""
    try:
        for child in pathlib.Path(f"/proc/{mpirun}/task/{mpirun}/children").read_text().split():
            words = pathlib.Path(f"/proc/{child}/environ").read_bytes().split(b"\0")
            if f"OMPI_COMM_WORLD_RANK={rank}".encode() in words:
                return int(child)
    except (FileNotFoundError, ProcessLookupError, PermissionError):
        pass
    return None


class Chain:
    """A run that is killed and resumed again and again."""

    def __init__(self, options, kind, folder):
        self.ranks, self.folder, self.damaged = bool(options.mpiexec), folder, (None, b"")
        entries = ON_RANKS if self.ranks else [*faults.TINY, *faults.PLATENS[kind], f"Checkpoint/Every = {STEPS[kind]}"]
        self.line = faults.command(options.apps / "platen-compress", faults.CRUSHED, folder, entries)
        self.line.remove("--quiet")  # what is passed over is told by a warning
        self.mpiexec = options.mpiexec
        self.environment = dict(os.environ, **dict(word.split("=", 1) for word in options.environment.split()))

    def start(self, threads, *options):
        mpirun, threads = ([self.mpiexec, "-n", str(threads)], 1) if self.ranks and threads else ([], threads or 1)
        return faults.start([*mpirun, *self.line, "-t", str(threads), *options], env=self.environment)

    def go_on(self, draw, seconds, due):
        """Starts or resumes the run and kills it, where that is `due`, after a random time. A run without any checkpoint is not killed. Gives its
        status, "killed", and what it has said; whether a checkpoint was being written, whether one was written before, and seconds to its end."""
        first, before = not self.folder.exists(), faults.checkpoints(self.folder)
        at_work, threads = self.ranks or draw.random() < 0.75, draw.randint(2, 4) if self.ranks else draw.choice([1, 2])
        in_write = self.ranks and draw.random() < 0.6
        victim = 0 if in_write and draw.random() < 0.5 else draw.randrange(threads)  # the writer itself half of the times that it writes
        delay = draw.uniform(0, 2 if self.ranks else 0.1 * seconds if at_work else 1)
        process = self.start(threads, *([] if first else ["--resume"]))
        while (first or at_work) and faults.checkpoints(self.folder) <= before and process.poll() is None:
            time.sleep(1e-3)
        wrote, until = bool(faults.checkpoints(self.folder) - before), time.monotonic() + delay
        while due and process.poll() is None:
            if time.monotonic() > until and (not in_write or faults.checkpoints(self.folder, PART)):
                if (pid := process_of_rank(process.pid, victim) if self.ranks else process.pid) is not None:
                    os.kill(pid, signal.SIGKILL)
                break
            time.sleep(1e-3 if time.monotonic() < until else 1e-5)
        hit, struck = bool(faults.checkpoints(self.folder, PART)), time.monotonic()
        said = process.communicate(timeout=1800)[1]
        status = "killed" if process.returncode == (128 + signal.SIGKILL if self.ranks else -signal.SIGKILL) else process.returncode
        return status, said, hit, wrote, time.monotonic() - struck

    def damage(self, draw):
        """Damages the newest checkpoint if an older one is left."""
        files = sorted(faults.checkpoints(self.folder))
        if len(files) > 1 and not self.is_damaged():
            self.damaged = files[-1], spoil(files[-1], draw)

    def is_damaged(self):
        file, data = self.damaged
        return file is not None and file.exists() and file.read_bytes() == data


def spoil(file, draw):
    """Turns a bit of a file over, or cuts it; returns its bytes."""
    data = bytearray(file.read_bytes())
    if draw.random() < 0.5:
        data = data[:draw.randrange(len(data))]
    else:
        data[draw.randrange(len(data))] ^= 1 << draw.randrange(8)
    file.write_bytes(data)
    return bytes(data)


def unlike(apps, one, other):
    """Files that two runs do not have alike, and what differs between their newest checkpoints but for seconds."""
    names = faults.difference(faults.results(one), faults.results(other))
    compared = faults.run([apps / "platen", "state", one, other] if (one / "checkpoint").exists() else ["true"])
    if compared.returncode not in (0, 1) or compared.returncode == 1 and "wall_seconds" not in compared.stdout:
        names.append("checkpoint: " + compared.stdout.strip() + compared.stderr.strip())
    return names


def kills(options, scratch, figures):
    draw, whole, damaged = random.Random(options.seed), {}, faults.Figures(36)
    for kind in ["ranks"] if options.mpiexec else faults.PLATENS:
        begin, process = time.monotonic(), Chain(options, kind, scratch / kind).start(0)
        said = process.communicate()[1]
        whole[kind] = time.monotonic() - begin
        if process.returncode:
            figures.fail(f"{kind}: {said}")
    wanted_in_write = 0.4 * options.kills if options.mpiexec else 0
    count = in_write = chains = passed_over = longest = 0
    while (count < options.kills or in_write < wanted_in_write) and not figures.failures:
        kind = list(whole)[chains % len(whole)]
        chain, status = Chain(options, kind, scratch / f"{kind}_{chains}"), "killed"
        while status == "killed" and not figures.failures:
            expected, due = chain.is_damaged(), count < options.kills or in_write < wanted_in_write and count < 2 * options.kills
            status, said, hit, wrote, seconds = chain.go_on(draw, whole[kind], due)
            found = said.count("checkpoint not used")
            passed_over += found
            if found > expected or found < expected and (wrote or status == 0) or status not in ("killed", 0):
                figures.fail(f"{kind}, after {count} kills: status {status}, {found} checkpoints not used, {expected:d} damaged: {said}")
            if status == "killed":
                count, in_write, longest = count + 1, in_write + hit, max(longest, seconds)
            if status == "killed" and draw.random() < 1 / 3:
                chain.damage(draw)
        chains += 1
        if not figures.failures and (files := unlike(options.apps, scratch / kind, chain.folder)):
            figures.fail(f"{kind}, after {count} kills: not as in the run that was not killed: {files}")
        shutil.rmtree(chain.folder)
    for kind in whole:
        chain, before = Chain(options, kind, scratch / kind), faults.results(scratch / kind)
        names = [file.name for file in faults.checkpoints(chain.folder) if spoil(file, draw)]
        process = chain.start(0, "--resume")
        said = process.communicate()[1]
        if process.returncode != 2 or not all(name in said for name in names) or faults.difference(before, faults.results(chain.folder)):
            damaged.fail(f"{kind}: without a whole checkpoint: status {process.returncode}: {said}")
    figures.at_least("kills of a rank" if options.mpiexec else "kills", count, options.kills)
    figures.at_least("kills while a checkpoint was written", in_write, wanted_in_write)
    figures.note("runs killed again and again, compared with one that was not", chains)
    figures.note("seconds that a run went on after a kill, at most", round(longest, 1), "< 60")
    if longest > 60:
        figures.fail(f"a run went on for {longest:.0f} s after a kill")
    figures.exactly("kills without a whole checkpoint, another status, runs unlike", len(figures.failures), 0)
    damaged.note("damaged checkpoints passed over", passed_over)
    damaged.exactly("runs that went on without a whole one", len(damaged.failures), 0)
    figures.failures += damaged.failures


def last_stage(folder):
    """Number of the stage in the last whole row of history.csv; 0 where there is none."""
    try:
        lines = (folder / "history.csv").read_text().split("\n")[:-1]
    except FileNotFoundError:
        return 0
    return int(lines[-1].split(",")[lines[0].split(",").index("stage")]) if len(lines) > 1 else 0


def stopped_in(stage, command, folder):
    """Runs until a row of that stage is there and stops; its exit status, and the stage that it was stopped in."""
    process = faults.start(command)
    while last_stage(folder) < stage and process.poll() is None:
        time.sleep(1e-3)
    process.send_signal(signal.SIGINT)
    said = process.communicate()[1]
    return process.returncode, last_stage(folder), said


def stages(options, scratch, figures):
    stops = elsewhere = unlike = 0
    for name in options.scenes:
        def command(folder, threads, *more):
            entries = [*STAGED[name], "Output/Fields every = 1000000"]
            return faults.command(options.apps / "platen-compress", faults.SOURCE / f"scenes/{name}.prm", folder, entries, "-t", str(threads), *more)

        whole = scratch / name
        done = faults.run(command(whole, 1))
        if done.returncode not in (0, 1):  # few spheres: not the strength that the scene expects
            figures.fail(f"{name}: status {done.returncode}: {done.stderr}")
            continue
        wanted = faults.results(whole)
        for stage in range(1, last_stage(whole) + 1):
            for k, threads in enumerate(THREADS):
                folder = scratch / f"{name}_{stage}_{threads}"
                status, reached, said = stopped_in(stage, command(folder, THREADS[k - 1]), folder)
                if status not in (0, 1, 130):
                    figures.fail(f"{name}, stage {stage}: status {status}: {said}")
                    continue
                stops += status == 130
                elsewhere += reached != stage
                if status == 130:
                    faults.run(command(folder, threads, "--resume"))
                if files := faults.difference(wanted, faults.results(folder)):
                    unlike += 1
                    figures.fail(f"{name}, stopped in stage {reached}, resumed on {threads} threads: {files}")
    figures.note("stops in a stage", stops)
    figures.note("stops that came a stage late", elsewhere)
    figures.exactly("runs that ended otherwise", unlike, 0)


def main():
    parser = faults.parser(__doc__)
    parser.add_argument("how", choices=("kills", "stages"))
    parser.add_argument("apps", type=pathlib.Path, help="folder of the apps")
    parser.add_argument("--mpiexec", default="", help="starts ranks")
    parser.add_argument("--environment", default="", help="for it: NAME=VALUE ...")
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scenes", nargs="*", choices=list(STAGED), default=list(STAGED))
    options = parser.parse_args()
    figures = faults.Figures(49 if options.how == "stages" else 63 if options.mpiexec else 35)
    with faults.scratch() as scratch:
        (kills if options.how == "kills" else stages)(options, scratch, figures)
    return figures.status()


if __name__ == "__main__":
    sys.exit(main())
