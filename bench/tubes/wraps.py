#!/usr/bin/env python3
"""Strength of wrapped concrete, computed, beside two fits to tests.

    bench/tubes/wraps.py BUILD FOLDER [JOBS]   runs what FOLDER lacks, JOBS (2) at a time; prints the tables, writes wraps.png there

Each is scenes/wrapped.prm, a cylinder of 50 mm x 100 mm, at nine pairs of confinement f_l/f_co and rupture strain e, and two other concretes (concrete.py). f_l = 2 E t e / d. The fits take the
strength f_co and its strain e_co from the model's own bare cylinder.
* Teng, Jiang, Lam and Luo 2009 (J. Compos. Constr. 13, 269-278): f_cc/f_co = 1 + 3.5 (k - .01) e/e_co with k = 2 E t e_co/(f_co d), at least .01; e_cc/e_co = 1.75 + 6.5 k^.8 (e/e_co)^1.45
* Lam and Teng 2003 (Constr. Build. Mater. 17, 471-489): f_cc = f_co + 3.3 f_l
"""
import concurrent.futures
import pathlib
import statistics
import subprocess
import sys

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(pathlib.Path(__file__).parent)]
import concrete
import platen

DIAMETER, MODULUS = 50e-3, 230e9  # m, Pa
BARE = [(f_c, 0.0, 0.0) for f_c in (30e6, concrete.STRENGTH, 60e6)]
CASES = [(concrete.STRENGTH, ratio, strain) for strain in (0.006, 0.010, 0.015) for ratio in (0.1, 0.2, 0.4)] + [(f_c, 0.2, 0.010) for f_c in (30e6, 60e6)]


def thickness(f_c, ratio, strain):
    return ratio * f_c * DIAMETER / (2 * MODULUS * strain)


def folder_of(folder, case):
    return folder / "f{:.0f} l{:.2f} e{:.3f}".format(case[0] / 1e6, *case[1:])


def run(build, folder, case):
    target = folder_of(folder, case)
    if (target / "summary.json").exists():
        return
    entries = [*concrete.entries(case[0]), "Loading/Axial rate = 0.16 m/s", "Loading/Target strain = 0.06", "Output/Fields = off", "Expect/energy_residual_relative ="]
    entries += ([f"Sleeve/Thickness = {thickness(*case):.6g} m", f"Sleeve/Rupture strain = {case[2]}"] if case[1] else ["Loading/Confinement = none"])
    command = [build / "apps/platen-compress", ROOT / "scenes/wrapped.prm", "-o", target, "--overwrite", "--quiet", "-t", "1"]
    with open(folder / (target.name + ".log"), "w") as log:
        subprocess.run([*map(str, command), *(part for entry in entries for part in ("-s", entry))], check=False, stderr=log)


class Answer:
    def __init__(self, folder, case):
        run = platen.Run(folder_of(folder, case))
        column = lambda name: numpy.array(run.history[name])
        self.strain, self.stress = column("axial_strain_platen"), 0.5 * (column("axial_stress_top_pa") + column("axial_stress_bottom_pa"))
        self.peak = int(self.stress.argmax())
        self.f, self.e = self.stress[self.peak], self.strain[self.peak]
        self.summary = run.summary
        if case[1]:
            self.lateral = column("lateral_strain")
            late = (self.strain > 0.5 * self.e) & (self.strain <= self.e)
            self.slope, self.intercept = numpy.polyfit(self.strain[late], self.stress[late], 1)


def draw(answers, bare, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(7, 4.2), layout="constrained")
    shown = [(case, answer) for case, answer in answers.items() if case[0] == concrete.STRENGTH]
    axes.plot(100 * bare.strain, bare.stress / 1e6, color="black", label="bare")
    for case, a in shown:
        colour, style = {0.006: "C0", 0.010: "C1", 0.015: "C2"}[case[2]], {0.1: ":", 0.2: "--", 0.4: "-"}[case[1]]
        axes.plot(100 * a.strain, a.stress / 1e6, style, color=colour, label=f"rupture at {100 * case[2]:.1f} %" if case[1] == 0.4 else None)
        axes.plot(100 * a.lateral, a.stress / 1e6, style, color=colour)
    axes.set(xlabel="Lateral (left) and axial strain, %", ylabel="Axial stress, MPa", ylim=(0, None), xlim=(-2, None))
    axes.set_title("$f_l/f_{co}$ = .1 dotted, .2 dashed, .4 full", loc="left")
    axes.axvline(0, color="black", lw=0.8)
    axes.legend()
    figure.savefig(path, dpi=150)


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    build, folder = map(pathlib.Path, sys.argv[1:3])
    folder.mkdir(parents=True, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(int(sys.argv[3]) if len(sys.argv) == 4 else 2) as pool:
        list(pool.map(lambda case: run(build, folder, case), BARE + CASES))
    bare = {case[0]: Answer(folder, case) for case in BARE}
    answers = {case: Answer(folder, case) for case in CASES if (folder_of(folder, case) / "summary.json").exists()}
    print("| f_co, MPa | f_l/f_co | rupture strain | f_cc/f_co | by Teng et al. | by Lam and Teng | e_cc/e_co | by Teng et al. | second line: intercept over f_co, slope, GPa | mean over rupture strain at the first tear | energy residual |")
    print("| --- " * 11 + "|")
    over_teng, over_lam, strains = [], [], []
    for (f_c, ratio, strain), a in answers.items():
        f_co, e_co = bare[f_c].f, bare[f_c].e
        stiff = 2 * MODULUS * thickness(f_c, ratio, strain) * e_co / (f_co * DIAMETER)
        teng, lam = 1 + 3.5 * max(stiff - 0.01, 0) * strain / e_co, 1 + 3.3 * ratio * f_c / f_co
        teng_strain = 1.75 + 6.5 * stiff**0.8 * (strain / e_co) ** 1.45
        over_teng.append(a.f / f_co / teng), over_lam.append(a.f / f_co / lam), strains.append(a.e / e_co / teng_strain)
        tear = a.summary["hoop_strain_at_first_tear"]
        print(f"| {f_co / 1e6:.1f} | {ratio * f_c / f_co:.2f} | {strain:.3f} | {a.f / f_co:.2f} | {teng:.2f} | {lam:.2f} | {a.e / e_co:.1f} | {teng_strain:.1f} | "
              f"{a.intercept / f_co:.2f}, {a.slope / 1e9:.2f} | {'none' if tear is None else f'{tear / strain:.2f}'} | {a.summary['energy_residual_relative']:.1g} |")
    for name, values in (("f_cc over Teng et al.", over_teng), ("f_cc over Lam and Teng", over_lam), ("e_cc over Teng et al.", strains)):
        print(f"\n{name}: mean {statistics.mean(values):.3f}, variation {100 * statistics.stdev(values) / statistics.mean(values):.1f} %")
    draw(answers, bare[concrete.STRENGTH], folder / "wraps.png")


main()
