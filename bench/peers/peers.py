#!/usr/bin/env python3
"""Platen and Yade in turn on the same packing, crushed to its peak and past it, from command to prompt, and a table of the ratios. README.md says
what is the same and what is not.

    peers.py BUILD OUT    programs of BUILD/apps; writes OUT/whole.md, whole.csv, the packing, a folder and a log of each run
"""
import argparse
import csv
import datetime
import os
import pathlib
import platform
import re
import resource
import shutil
import statistics
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "python"))
import platen

BONDS_MAY_DIFFER = 1e-3  # of each other: two programs round the same rule
UNDISTURBED = 0.9  # processor seconds over seconds; a program that got less waited for others


def measure(log, *command):
    """Prints seconds from start to end of a command, those of processors, and the peak of its resident memory, MB; its output goes to the log."""
    with open(log, "w") as file:
        begun = time.monotonic()
        status = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=file, stderr=subprocess.STDOUT).returncode
        seconds = time.monotonic() - begun
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"{seconds:.2f} {used.ru_utime + used.ru_stime:.2f} {used.ru_maxrss / 1024:.0f}")
    return 1 if status else 0


def measured(log, *command):
    """What measure() prints, as numbers; a command that waits for its turn (--within) does so outside of it."""
    done = subprocess.run([*asked.within, sys.executable, __file__, "measure", log, *command], stdout=subprocess.PIPE, text=True)
    if done.returncode:
        sys.exit(f"{command[0]} failed; its last lines ({log}):\n" + "\n".join(log.read_text().splitlines()[-5:]))
    return dict(zip(("seconds", "processor_seconds", "memory_mb"), map(float, done.stdout.split())))


def said(*command):
    return subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL).stdout.strip()


def head(title):
    commit = said("git", "-C", HERE, "describe", "--always", "--dirty= with changes") or "unknown"
    model = re.search(r"^model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text(), re.M)
    memory = int(re.search(r"MemTotal: *(\d+)", pathlib.Path("/proc/meminfo").read_text())[1]) / 1048576
    yade = re.search(r"Yade version: *(\S+)", said("yade", "--version"))
    return (f"# {title}, measured\n\nWritten by `bench/peers/peers.py`; bench/peers/README.md says what is the same and what is not.\n\n"
            f"- machine: {model[1] if model else platform.machine()}, {os.cpu_count()} cores, {memory:.0f} GB, "
            f"{platform.freedesktop_os_release()['PRETTY_NAME']}\n- date: {datetime.date.today()}; commit: {commit}\n"
            f"- Yade: {yade[1] if yade else 'unknown'}, package {said('dpkg-query', '-W', '-f', '${Version}', 'yade') or 'not of Debian'}\n")


def pairs_of(one):
    """Rows of both programs in turn: [{"platen": row, "yade": row}, ...]. Particles and bonds have to agree."""
    pairs = []
    for threads in asked.threads:
        for pair in range(1, asked.pairs + 1):
            both = {program: {"program": program, "threads": threads, "pair": pair, **one(program, threads, f"{program}_{threads}_{pair}")}
                    for program in ("platen", "yade")}
            p, y = both["platen"], both["yade"]
            print(f"{threads} threads, pair {pair}: {p['seconds']:.2f} s, {y['seconds']:.2f} s", flush=True)
            if p["particles"] != y["particles"] or abs(p["bonds"] - y["bonds"]) > BONDS_MAY_DIFFER * p["bonds"]:
                sys.exit(f"particles and bonds differ, the figures do not compare: {p}, {y}")
            pairs.append(both)
    rows = [row for both in pairs for row in both.values()]
    with open(asked.out / "whole.csv", "w", newline="") as file:
        table = csv.DictWriter(file, rows[0].keys(), restval="", lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    return pairs


def lines(header, rows):
    return "\n".join("| " + " | ".join(cells) + " |" for cells in (header, ["---"] * len(header), *rows)) + "\n"


def told(folder):
    """What a run found, by the same rules from the histories of both programs: yade_test.py writes the same files."""
    results = platen.Run(folder)
    s, curve = results.summary, list(zip(results.history["axial_strain_platen"].tolist(), results.stress.tolist()))
    broken = s["broken"] if "broken" in s else s["broken_tension"] + s["broken_shear"]
    strain, strength = max(curve, key=lambda point: point[1])
    if s["ended_by"] != "stop at residual" or curve[-1][1] > 0.9 * strength or not broken:
        sys.exit(f"{folder}: no fall after a peak (ended by \"{s['ended_by']}\"): the seconds do not compare")
    rise = [point for point in curve[:curve.index((strain, strength))] if 0.1 * strength < point[1] < 0.4 * strength]
    return {"step_seconds": s.get("step_seconds", s.get("wall_seconds", 0) - s.get("setup_seconds", 0)), "steps": s["steps"],
            "particles": s["particles"], "bonds": s["bonds"], "time_step_s": s["time_step_s"], "strength_pa": strength, "strain_at_peak": strain,
            "modulus_pa": (rise[-1][1] - rise[0][1]) / (rise[-1][0] - rise[0][0]), "broken": broken, "strain_at_end": curve[-1][0],
            "stress_at_end_pa": curve[-1][1], "instruction_set": s.get("instruction_set", ""), "version": s.get("version", "")}


def whole():
    apps, out = asked.build / "apps", asked.out.resolve()
    size = ["-s", f"Specimen/Sphere radius = {asked.radius}"]
    measured(out / "packing.log", apps / "platen-pack", HERE / "whole.prm", "-o", out / "packing", "--overwrite", "--quiet", *size)
    specimen = out / "packing" / "specimen.csv"

    def one(program, threads, name):
        command = [apps / "platen-compress", HERE / "whole.prm", "-o", out / name, "--overwrite", "-t", str(threads), *size, "-s",
                   "Specimen/Packing = file", "-s", f"Specimen/File = {specimen}"] if program == "platen" else [
            "yade", "-n", "-x", f"-j{threads}", HERE / "yade_test.py", out / name.replace("yade", "platen"), specimen, out / name]
        cost = measured(out / f"{name}.log", *command)
        return {**cost, **told(out / name)}

    pairs, seconds, figures = pairs_of(one), [], []
    for both in pairs:
        p, y = both["platen"], both["yade"]
        both["ratios"] = [y["seconds"] / p["seconds"], y["step_seconds"] / y["steps"] / p["step_seconds"] * p["steps"],
                          y["processor_seconds"] / p["processor_seconds"]]
        seconds.append([str(p["threads"]), str(p["pair"])] + [f"{row[key]:.2f}" for row in (p, y) for key in ("seconds", "step_seconds", "processor_seconds")] +
                       ["**%.1f**" % both["ratios"][0], *("%.1f" % ratio for ratio in both["ratios"][1:]), f"{p['memory_mb']:.0f}", f"{y['memory_mb']:.0f}"])
        figures += [[str(row["threads"]), str(row["pair"]), row["program"].capitalize(), f"{1e-6 * row['strength_pa']:.2f}", f"{row['strain_at_peak']:.5f}",
                     f"{1e-9 * row['modulus_pa']:.2f}", str(row["broken"]), str(row["steps"]), f"{row['strain_at_end']:.5f}"] for row in (p, y)]
    for threads in asked.threads if asked.pairs > 1 else []:
        middle = map(statistics.median, zip(*(both["ratios"] for both in pairs if both["yade"]["threads"] == threads)))
        seconds.append([str(threads), "median", *[""] * 6, "**%.1f**" % next(middle), *("%.1f" % ratio for ratio in middle), "", ""])
    waited = [f"{row['program'].capitalize()} with {row['threads']} threads {100 * row['processor_seconds'] / row['seconds']:.0f} %"
              for both in pairs for row in (both["platen"], both["yade"]) if row["processor_seconds"] < UNDISTURBED * row["seconds"]]
    p, y = pairs[0]["platen"], pairs[0]["yade"]
    return (head("A whole test in Platen and in Yade") + f"- {p['version']}\n- kernels of Platen: {p['instruction_set']}; step {y['time_step_s']:.4g} s in both\n\n"
            f"{p['particles']} particles; bonds: Platen {p['bonds']}, Yade {y['bonds']}.\n\n" +
            lines(["threads", "pair", "Platen, s", "of it steps", "of processors", "Yade, s", "of it steps", "of processors", "**Yade over Platen**",
                   "of one step", "of processors", "Platen, MB", "Yade, MB"], seconds) +
            (f"\n**Other work on the machine took its processors: of one of them, {', '.join(waited)}. Seconds do not compare then; on one thread those "
             "of processors do.**\n" if waited else "") +
            "\nSeconds from command to prompt. The rest of the steps' is start, reading, bonding and the last files. Of one step: seconds of the steps over "
            "their number, Yade over Platen. Of processors: their time in user and system, which other work on the machine disturbs less.\n\n" +
            lines(["threads", "pair", "", "strength, MPa", "strain at peak", "Young's modulus, GPa", "broken bonds", "steps", "strain at end"], figures) +
            "\nModulus: slope between a tenth and four tenths of the strength.\n")


if __name__ == "__main__":
    if sys.argv[1:2] == ["measure"]:
        sys.exit(measure(*sys.argv[2:]))
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--pairs", type=int, default=1, help="of runs")
    parser.add_argument("--within", type=str.split, default=[], help='command that runs each program, such as "flock FILE"')
    parser.add_argument("--radius", default="1.78 mm", help='of the spheres; "3 mm" for a quick look')
    asked = parser.parse_args()
    if shutil.which("yade") is None:
        parser.error("yade is missing: apt-get install yade")
    if max(asked.threads) > os.cpu_count():
        parser.error(f"{max(asked.threads)} threads on {os.cpu_count()} cores would measure the scheduler")
    asked.out.mkdir(parents=True, exist_ok=True)
    page = asked.out / "whole.md"
    page.write_text(whole())
    print(page.read_text())
