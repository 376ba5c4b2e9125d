#!/usr/bin/env python3
"""Makes a study of friction run by run, as a cluster does, and disturbs its runs.

    cluster.py slurm FOLDER_OF_PROGRAMS [--kills 6] [--seed 1] [--quick]
        A real Slurm of one node: munged, slurmctld and slurmd are started with a key, configuration, state and logs of their own, and ended
        afterwards. Runs of the plan are submitted in random order by scripts/slurm/study_array.sh; some are killed, stopped or put back into the
        queue when they have written a checkpoint. Then the script submits all, and collects. --quick takes scenes/study_friction_quick.prm in place
        of a small one. Two minutes.
    cluster.py parallel FOLDER_OF_PROGRAMS [--seed 1]
        GNU parallel, in random order; some of the runs are killed, and it is taken up again. A minute.

Every file of every run, study.csv and study.json have the bytes of one process. Exit status: 0; 1 where that does not hold; 77 where Slurm or
GNU parallel is not installed, or Slurm is not started by root.
"""

import os
import pathlib
import random
import shutil
import signal
import socket
import subprocess
import sys
import time

import faults

SCRIPT = faults.SOURCE / "scripts/slurm/study_array.sh"
SMALL = [faults.SCENES / "study.prm", "Study/Surface list = dry steel, 0.1, grease", "Study/Sphere radius list =",
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


def disturb(slurm, draw, job, run, counts):
    """Once the run of a task has written a checkpoint, or when it is done, what a cluster does to it."""
    before = faults.checkpoints(run)
    until(lambda: job not in slurm.jobs() or not faults.checkpoints(run) <= before, f"a checkpoint of {run.name}")
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


class Study:
    """A study of friction: made in one process, planned in another folder, and compared once that is collected."""

    def __init__(self, options, scratch, figures):
        scene, *entries = QUICK if options.quick else SMALL
        self.program, self.words, self.figures = str(options.programs / "platen-study"), ["friction", str(scene), *faults.sets(entries)], figures
        self.whole, self.folder = scratch / "whole", scratch / "by_runs"
        for folder, plan in ((self.whole, []), (self.folder, ["--plan"])):
            done = faults.run([*self.command(folder), "--quiet", *plan])
            if done.returncode != 0:
                figures.fail(f"{' '.join(plan) or 'in one process'}: status {done.returncode}: {done.stderr}")
        plan = self.folder / "plan.csv"
        rows = plan.read_text().splitlines()[1:] if plan.exists() else []
        self.names = {int(row.split(",")[0]): row.split(",")[1] for row in rows}  # of the runs' folders, by number
        if not rows:
            figures.fail("no plan")

    def command(self, folder):
        return [self.program, *self.words, "-o", str(folder)]

    def compare(self, by):
        wanted, found = ({name: content for name, content in faults.results(folder).items()  # not the plan, packings, logs, and what it cost
                          if name not in ("plan.csv", "plan.json", "summary.json") and not name.endswith(".log") and not name.startswith("packings/")}
                         for folder in (self.whole, self.folder))
        unlike = faults.difference(wanted, found)
        self.figures.note(f"files compared{by}", len(wanted))
        self.figures.exactly(f"files unlike those of one process{by}", len(unlike), 0)
        if unlike:
            print("\n".join(unlike), *(f"{log.name}:\n{log.read_text()}" for log in sorted(self.folder.glob("*.log"))), sep="\n")


def by_slurm(study, slurm, options, figures):
    draw, folder = random.Random(options.seed), study.folder
    slurm.environment["PLATEN_STUDY"] = study.program
    counts = {"killed": 0, "requeued": 0, "cancelled": 0}
    numbers = []
    while sum(counts.values()) < options.kills and len(numbers) < 10 * options.kills:
        numbers = numbers or draw.sample(sorted(study.names), len(study.names))
        number = numbers.pop()
        job = slurm.call("sbatch", "--parsable", f"--array={number}", f"--output={folder}/task_%A_%a.log", SCRIPT, folder, *study.words).strip()
        disturb(slurm, draw, f"{job}_{number}", folder / "runs" / study.names[number], counts)
    for how, count in counts.items():
        figures.note(f"tasks {how}", count)
    figures.at_least("tasks killed, requeued or cancelled", sum(counts.values()), options.kills)
    until(lambda: not slurm.jobs(), "the end of what was requeued")
    said = faults.run([SCRIPT, folder, *study.words], env=slurm.environment)
    if said.returncode != 0:
        return figures.fail(f"the script: {said.stdout}{said.stderr}")
    until(lambda: not slurm.jobs(), "the end of all tasks")
    study.compare("")
    resumed = sum("resumed at step" in log.read_text() for log in folder.glob("runs/*/run.log"))
    figures.at_least("runs that went on from a checkpoint", resumed, 1)


def processes(folder):
    """Ids of the runs that are at work in a study's folder."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0") if entry.name.isdigit() else []
            name = (entry / "comm").read_text().strip() if words else ""
        except OSError:  # it has ended
            continue
        # A run may be a copy of platen-study, whose command line it has.
        if name == "platen-compress" and any(word.startswith(os.fsencode(folder)) for word in words):
            found.append(int(entry.name))
    return sorted(found)


def by_parallel(study, options, figures):
    draw, folder, kills = random.Random(options.seed), study.folder, 0
    numbers = "\n".join(map(str, draw.sample(sorted(study.names), len(study.names))))
    parallel = ["parallel", "--quote", "-j", "2", "--joblog", str(folder / "jobs.log"), "--resume-failed", *study.command(folder), "--run", "{}",
                "-t", "1"]
    with subprocess.Popen(parallel, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, text=True) as process:
        process.stdin.write(numbers)
        process.stdin.close()
        while process.poll() is None:
            at_work = [run for run in folder.glob("runs/*") if faults.checkpoints(run) and not (run / "summary.json").exists()]
            if kills < 3 and at_work and (victims := processes(folder)):
                os.kill(draw.choice(victims), signal.SIGKILL)
                kills += 1
            time.sleep(0.3)
    figures.at_least("runs killed under GNU parallel", kills, 1)
    again = subprocess.run(parallel, input=numbers, text=True, capture_output=True)
    if again.returncode != 0:
        figures.fail(f"taken up again: status {again.returncode}: {again.stderr}")
    figures.exactly("exit status of --collect", faults.run([*study.command(folder), "--collect"]).returncode, 0)
    study.compare(" under GNU parallel")


def main():
    parser = faults.parser(__doc__)
    parser.add_argument("by", choices=("slurm", "parallel"))
    parser.add_argument("programs", type=lambda path: pathlib.Path(path).resolve(), help="folder of the apps")
    parser.add_argument("--kills", type=int, default=6)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--quick", action="store_true", help="the shipped quick study of friction")
    options = parser.parse_args()
    wanted = ("munged", "slurmctld", "slurmd", "sbatch") if options.by == "slurm" else ("parallel",)
    if missing := [name for name in wanted if shutil.which(name) is None]:
        faults.skip("not installed: " + ", ".join(missing) + " (scripts/setup.sh --cluster)")
    if options.by == "slurm" and os.geteuid() != 0:
        faults.skip("slurmd runs as root")
    figures = faults.Figures(61)
    with faults.scratch() as scratch:
        study = Study(options, scratch, figures)
        if figures.failures:
            return figures.status()
        if options.by == "parallel":
            by_parallel(study, options, figures)
            return figures.status()
        (scratch / "slurm").mkdir()
        slurm = Slurm(scratch / "slurm")
        try:
            slurm.start()
            by_slurm(study, slurm, options, figures)
        except TimeoutError as error:
            figures.fail(f"waited in vain for {error}")
            for log in sorted(slurm.folder.glob("*.log")) + sorted(slurm.folder.glob("*.out")):
                print(f"{log.name}:\n" + "\n".join(log.read_text().splitlines()[-20:]))
        finally:
            slurm.stop()
    return figures.status()


if __name__ == "__main__":
    sys.exit(main())
