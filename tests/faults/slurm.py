#!/usr/bin/env python3
"""Makes a study by array jobs of a real Slurm of one node, and kills its tasks.

    slurm.py FOLDER_OF_PROGRAMS [--kills 6] [--seed 1] [--quick]

munged, slurmctld and slurmd are started with a key, configuration, state and logs of their own, and ended afterwards. Runs of
the plan of a study of friction are submitted in random order by scripts/slurm/study_array.sh; some are killed, stopped or put
back into the queue when they have written a checkpoint. Then the script submits all, and collects. Every file of every run, study.csv and
study.json have the bytes of one process. --quick takes scenes/study_friction_quick.prm in place of a small one.
Exit status: 0; 1 where that does not hold; 77 where Slurm is not installed, or this is not root. Two minutes.
"""

import argparse
import os
import pathlib
import random
import shutil
import socket
import subprocess
import sys
import tempfile
import time

import faults

SCRIPT = faults.SOURCE / "scripts/slurm/study_array.sh"
SMALL = [faults.SOURCE / "tests/apps/scenes/study.prm", "Study/Surface list = dry steel, 0.1, grease", "Study/Sphere radius list =",
         "Specimen/Sphere radius = 0.8 mm", "Loading/Target strain = 0.02", "Loading/Stop at residual = 0.5"]
QUICK = [faults.SOURCE / "scenes/study_friction_quick.prm", "Checkpoint/Every = 500"]
PATIENCE = 600  # s, for anything to happen

CONFIGURATION = """
ClusterName=platen
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
KillWait=5
SchedulerParameters=batch_sched_delay=0,sched_min_interval=100000,requeue_delay=1
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def skip(reason):
    print("skipped: " + reason)
    sys.exit(77)


def until(met, what, seconds=PATIENCE):
    """Waits until met() is true, and returns it."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if value := met():
            return value
        time.sleep(0.05)
    raise TimeoutError(what)


class Slurm:
    """A Slurm of this machine alone, in a folder of its own."""

    def __init__(self, folder):
        self.folder = folder
        self.daemons = []
        self.environment = {name: value for name, value in os.environ.items() if not name.startswith(("SLURM", "SBATCH"))}
        self.environment["SLURM_CONF"] = str(folder / "slurm.conf")

    def start(self):
        self.folder.chmod(0o755)
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        host = socket.gethostname().split(".")[0]
        with socket.socket() as one, socket.socket() as two:
            for taken in (one, two):
                taken.bind(("127.0.0.1", 0))
            ports = [taken.getsockname()[1] for taken in (one, two)]
        (self.folder / "slurm.conf").write_text(
            CONFIGURATION.format(host=host, folder=self.folder, ports=ports, cpus=len(os.sched_getaffinity(0))))
        self.begin("munged", "--foreground", "--force", f"--key-file={key}", f"--socket={self.folder}/munge.socket",
                   f"--pid-file={self.folder}/munge.pid", f"--seed-file={self.folder}/munge.seed",
                   f"--log-file={self.folder}/munge.log")
        until((self.folder / "munge.socket").exists, "munged", 20)
        self.begin("slurmctld", "-D", "-f", self.environment["SLURM_CONF"])
        self.begin("slurmd", "-D", "-N", host, "-f", self.environment["SLURM_CONF"])
        until(lambda: self.call("sinfo", "-h", "-o", "%t").strip() == "idle", "a node that is idle", 60)

    def begin(self, *command):
        with open(self.folder / f"{command[0]}.out", "w", encoding="utf-8") as out:
            self.daemons.append(subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=out, stderr=out))

    def stop(self):
        if len(self.daemons) == 3:
            self.call("scancel", "--user=root")
            try:
                until(lambda: not self.jobs(), "the end of all jobs", 30)
            except TimeoutError:
                pass
        for daemon in reversed(self.daemons):
            daemon.terminate()
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()

    def call(self, *command):
        done = faults.run([str(word) for word in command], env=self.environment)
        return done.stdout + done.stderr

    def jobs(self, states="all"):
        """Ids of jobs and tasks that have not ended."""
        found = self.call("squeue", "-h", "-r", "-o", "%i", "-t", states if states != "all" else "PD,R,CG,CF").split()
        return [job for job in found if job[0].isdigit()]


def checkpoints(run):
    return list((run / "checkpoint").glob("step_????????????.platen"))


def disturb(slurm, draw, job, run, counts):
    """Once the run of a task has written a checkpoint, or when it is done, what a cluster does to it."""
    before = checkpoints(run)
    until(lambda: job not in slurm.jobs() or checkpoints(run) not in ([], before), f"a checkpoint of {run.name}")
    if job not in slurm.jobs("R"):
        return
    time.sleep(draw.uniform(0, 0.3))
    how = ("killed", "requeued", "cancelled")[sum(counts.values()) % 3]
    command = {"killed": ["scancel", "--signal=KILL", "--full", job], "requeued": ["scontrol", "requeue", job],
               "cancelled": ["scancel", job]}[how]
    slurm.call(*command)
    counts[how] += 1


def comparable(folder):
    """Bytes of a study and its runs, by name: not the plan, packings, logs, and what the study cost."""
    return {name: content for name, content in faults.results(folder).items()
            if name not in ("plan.csv", "plan.json", "summary.json") and not name.endswith(".log")
            and not name.startswith("packings/")}


def make(slurm, options, scratch, figures):
    draw = random.Random(options.seed)
    scene, *entries = QUICK if options.quick else SMALL
    study = options.programs / "platen-study"
    sets = [word for entry in entries for word in ("-s", entry)]
    whole, folder = scratch / "whole", scratch / "by_slurm"
    done = faults.run(faults.command(study, "friction", whole, [], str(scene), *sets))
    if done.returncode != 0:
        return figures.fail(f"in one process: status {done.returncode}: {done.stderr}")
    slurm.environment["PLATEN_STUDY"] = str(study)
    planned = faults.run([study, "friction", scene, "-o", folder, *sets, "--plan", "--quiet"])
    rows = (folder / "plan.csv").read_text().splitlines()[1:]
    if planned.returncode != 0 or not rows:
        return figures.fail(f"no plan: {planned.stderr}")
    names = {int(row.split(",")[0]): row.split(",")[1] for row in rows}
    counts = {"killed": 0, "requeued": 0, "cancelled": 0}
    numbers = []
    while sum(counts.values()) < options.kills and len(numbers) < 10 * options.kills:
        numbers = numbers or draw.sample(sorted(names), len(names))
        number = numbers.pop()
        job = slurm.call("sbatch", "--parsable", f"--array={number}", f"--output={folder}/task_%A_%a.log", SCRIPT, folder, "friction",
                         scene, *sets).strip()
        disturb(slurm, draw, f"{job}_{number}", folder / "runs" / names[number], counts)
    for how, count in counts.items():
        figures.note(f"tasks {how}", count, "any")
    figures.at_least("tasks killed, requeued or cancelled", sum(counts.values()), options.kills)
    until(lambda: not slurm.jobs(), "the end of what was requeued")
    said = faults.run([SCRIPT, folder, "friction", scene, *sets], env=slurm.environment)
    if said.returncode != 0:
        return figures.fail(f"the script: {said.stdout}{said.stderr}")
    until(lambda: not slurm.jobs(), "the end of all tasks")
    logs = {log.name: log.read_text() for log in sorted(folder.glob("*.log"))}
    wanted, found = comparable(whole), comparable(folder)
    unlike = faults.difference(wanted, found)
    figures.note("files compared", len(wanted), "any")
    figures.exactly("files unlike those of one process", len(unlike), 0)
    resumed = sum("resumed at step" in log.read_text() for log in folder.glob("runs/*/run.log"))
    figures.at_least("runs that went on from a checkpoint", resumed, 1)
    if unlike:
        print("\n".join(unlike), *(f"{name}:\n{text}" for name, text in logs.items()), sep="\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", type=pathlib.Path, help="folder of the apps")
    parser.add_argument("--kills", type=int, default=6)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--quick", action="store_true", help="the shipped quick study of friction")
    options = parser.parse_args()
    options.programs = options.programs.resolve()
    missing = [name for name in ("munged", "slurmctld", "slurmd", "sbatch") if shutil.which(name) is None]
    if missing:
        skip("not installed: " + ", ".join(missing) + " (scripts/setup.sh --cluster)")
    if os.geteuid() != 0:
        skip("slurmd runs as root")
    figures = faults.Figures(61)
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        (scratch / "slurm").mkdir()
        slurm = Slurm(scratch / "slurm")
        try:
            slurm.start()
            make(slurm, options, scratch, figures)
        except TimeoutError as error:
            figures.fail(f"waited in vain for {error}")
            for log in sorted(slurm.folder.glob("*.log")) + sorted(slurm.folder.glob("*.out")):
                print(f"{log.name}:\n" + "\n".join(log.read_text().splitlines()[-20:]))
        finally:
            slurm.stop()
    return figures.status()


if __name__ == "__main__":
    sys.exit(main())
