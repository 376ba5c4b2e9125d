#!/usr/bin/env python3
"""Loads of the filled tubes of tests.csv, computed, beside those measured and those of codes.

    bench/tubes/tubes.py BUILD FOLDER [JOBS]   runs what FOLDER lacks, JOBS (2) at a time; prints the tables, writes tubes.png there

Each is scenes/filled_tube.prm at a reduced scale, its concrete 50 mm wide with 14 spheres across (without inertia and weight size does not count, and the fracture energy goes with it): the
wall, the length and nothing else after the test. Concrete: concrete.py. Steel: ideally plastic at the measured yield strength, since no row has more. Friction .57; of greased ones .03. Largest load: up to 3 % of closure.
"""
import concurrent.futures
import pathlib
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(pathlib.Path(__file__).parent)]
import codes
import concrete
import platen

RADIUS = 25e-3  # m, of the model's concrete
CLOSURES = (0.01, 0.02, 0.03)


def entries(tube):
    scale = RADIUS / (tube.d / 2 - tube.t)
    steel = {"Steel": "custom", "Modulus": "210 GPa", "Poisson ratio": "0.3", "Density": "7850 kg/m3", "Yield strength": f"{tube.f_y:.6g} Pa",
             "Thickness": f"{tube.t * scale:.6g} m", "Friction": "0.03" if tube.greased else "0.57"}
    return [*concrete.entries(tube.f_c), *(f"Sleeve/{key} = {value}" for key, value in steel.items()), f"Specimen/Height = {tube.length * scale:.6g} m",
            f"Loading/Target strain = {CLOSURES[-1]}", "Loading/Axial rate = 0.16 m/s", "Output/Fields = off"]


def folder_of(folder, tube):
    return folder / "".join(c if c.isalnum() else "_" for c in tube.name)


def run(build, folder, tube):
    target = folder_of(folder, tube)
    if not (target / "summary.json").exists():
        command = [build / "apps/platen-compress", ROOT / "scenes/filled_tube.prm", "-o", target, "--overwrite", "--quiet", "-t", "1"]
        with open(folder / (target.name + ".log"), "w") as log:
            subprocess.run([*map(str, command), *(part for entry in entries(tube) for part in ("-s", entry))], check=False, stderr=log)


class Answer:
    """What a run bears, at the size of the test."""

    def __init__(self, folder, tube):
        run = platen.Run(folder_of(folder, tube))
        factor = ((tube.d / 2 - tube.t) / RADIUS) ** 2
        strain, load = run.history["axial_strain_platen"], factor * run.history["total_load_n"]
        self.loads = [max(n for n, e in zip(load, strain) if e <= closure) for closure in CLOSURES]  # N
        row = max((n, k) for k, n in enumerate(load))[1]
        at = lambda column: run.history[column][row]
        self.strain, self.axial, self.hoop = at("axial_strain_platen"), at("tube_axial_stress_pa") / tube.f_y, at("tube_hoop_stress_pa") / tube.f_y
        self.pressure = at("tube_pressure_pa") / tube.f_c
        self.residual = run.summary["energy_residual_relative"]


def variation(values):
    return f"{statistics.mean(values):.3f}, {100 * statistics.stdev(values) / statistics.mean(values):.1f} %"


def draw(answers, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(7, 4.2), layout="constrained")
    ratio = [tube.t / tube.d for tube in answers]
    for label, marker, values in (("model", "o", [tube.load / a.loads[-1] for tube, a in answers.items()]),
                                  ("EN 1994-1-1", "s", [tube.load / tube.confined() for tube in answers]),
                                  ("plain sum", "^", [tube.load / tube.plain() for tube in answers])):
        axes.plot(ratio, values, marker, fillstyle="full" if label == "model" else "none", label=label)
    axes.axhline(1, color="black", lw=0.8)
    axes.axhspan(0.9, 1.1, color="0.9", zorder=0)
    axes.set(xlabel="Wall over diameter", ylabel="Measured over computed load", ylim=(0, None))
    axes.legend()
    figure.savefig(path, dpi=150)


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    build, folder = map(pathlib.Path, sys.argv[1:3])
    folder.mkdir(parents=True, exist_ok=True)
    tubes = codes.tubes()
    with concurrent.futures.ThreadPoolExecutor(int(sys.argv[3]) if len(sys.argv) == 4 else 2) as pool:
        list(pool.map(lambda tube: run(build, folder, tube), tubes))
    all_of = {tube: Answer(folder, tube) for tube in tubes if (folder_of(folder, tube) / "summary.json").exists()}
    chosen = {tube: answer for tube, answer in all_of.items() if tube.chosen}
    print("| test | t/d | f_c, MPa | load, kN | over the model's largest load up to 1, 2, 3 % | closure there | axial, hoop over f_y | pressure over f_c | over EN 1994-1-1 | energy residual |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for tube, a in chosen.items():
        print(f"| {tube.name} | {tube.t / tube.d:.4f} | {tube.f_c / 1e6:.1f} | {tube.load / 1e3:.0f} | {', '.join(f'{tube.load / n:.3f}' for n in a.loads)} | {a.strain:.3f} | "
              f"{a.axial:.2f}, {a.hoop:.2f} | {a.pressure:.3f} | {tube.load / tube.confined():.3f} | {a.residual:.1g} |")
    print("\n| measured over | mean, variation |\n| --- | --- |")
    for k, closure in enumerate(CLOSURES):
        print(f"| the model, up to {100 * closure:.0f} % ({len(chosen)}) | {variation([tube.load / a.loads[k] for tube, a in chosen.items()])} |")
    print(f"| EN 1994-1-1 | {variation([tube.load / tube.confined() for tube in chosen])} |")
    print(f"| plain sum | {variation([tube.load / tube.plain() for tube in chosen])} |")
    print("\n| greased over bonded | measured | model |\n| --- | --- | --- |")
    for greased in (tube for tube in all_of if tube.greased):
        for bonded in (tube for tube in all_of if not tube.greased and tube.pair == greased.pair):
            print(f"| {greased.name} over {bonded.name} | {greased.load / bonded.load:.3f} | {all_of[greased].loads[-1] / all_of[bonded].loads[-1]:.3f} |")
    draw(chosen, folder / "tubes.png")


main()
