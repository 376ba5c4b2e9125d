"""Tables of the runs of run.sh. Usage: table.py FOLDER"""
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import platen

folder = pathlib.Path(sys.argv[1])
runs = platen.runs(folder)


def run(name):
    """Summary and rows of history.csv of a finished run; None where there is none."""
    if name not in runs or runs[name].status != "done":
        return None
    return runs[name].summary, runs[name].history.records()


def axial(row):
    return 0.5e-6 * (row["axial_stress_top_pa"] + row["axial_stress_bottom_pa"])


def mean_of(row, *sides):
    return 1e-6 * statistics.mean(row[f"stress_{side}_pa"] for side in sides)


def spread(values):
    values = list(values)
    if not values:
        return "-"
    if len(values) == 1:
        return f"{values[0]:.2f}"
    if 1 < len(values) < 5:  # of fewer than five packings a deviation is a guess
        return f"{min(values):.2f} ... {max(values):.2f}, {len(values)} packings"
    return f"{statistics.mean(values):.2f} +- {statistics.stdev(values):.2f}"


def head(*cells):
    print("| " + " | ".join(cells) + " |\n" + "| --- " * len(cells) + "|")


def line(*cells):
    print("| " + " | ".join(str(cell) for cell in cells) + " |")


def several(pattern, seeds):
    return [(seed, found) for seed in seeds if (found := run(pattern.format(seed)))]


def biaxial():
    print("## Biaxial strength\n")
    head("platens", "share", "strength, MPa", "over uniaxial", "other stress there, MPa", "strain at peak", "residual", "seconds")
    for platens in ("brush", "steel"):
        bare = run(f"biaxial_{platens}_0")
        for share in ("0", "0.25", "0.5", "1"):
            found = run(f"biaxial_{platens}_{share}")
            if not found:
                continue
            summary, rows = found
            top = max(rows, key=axial)
            over = f"{summary['strength_pa'] / bare[0]['strength_pa']:.2f}" if bare else "-"
            line(platens, share, f"{summary['strength_pa'] / 1e6:.1f}", over, f"{mean_of(top, 'left', 'right'):.1f}",
                 f"{summary['strain_at_peak_platen']:.4f}", f"{summary['energy_residual_relative']:.1e}",
                 f"{summary['wall_seconds']:.0f}")
    print()


def largest_error(rows, stage, asked, columns):
    """Of the stresses in those columns against what is asked (MPa), once it has been within 1 %: share."""
    worst, begun = 0, False
    for row in rows:
        if row["stage"] != stage:
            continue
        error = max(abs(row[column] * 1e-6 / asked - 1) for column in columns)
        begun = begun or error < 0.01
        worst = max(worst, error if begun else 0)
    return worst


SIDES = ["stress_left_pa", "stress_right_pa", "stress_front_pa", "stress_back_pa"]


def true_triaxial():
    print("## Six greased platens beside a cell, 5 MPa\n")
    head("seed", "six platens, MPa", "cell, MPa", "largest error of all six at the end of stage 1",
         "lateral stress at the peak, MPa", "residual, six and cell")
    pairs = [(s, six, cell) for s in range(1, 6) if (six := run(f"six_{s}")) and (cell := run(f"cell_{s}"))]
    for seed, six, cell in pairs:
        end = [row for row in six[1] if row["stage"] == 1][-1]
        error = max(abs(end[column] / 5e6 - 1) for column in SIDES + ["axial_stress_top_pa", "axial_stress_bottom_pa"])
        top = max((row for row in six[1] if row["stage"] == 2), key=axial)
        line(seed, f"{six[0]['strength_pa'] / 1e6:.2f}", f"{cell[0]['strength_pa'] / 1e6:.2f}", f"{100 * error:.2f} %",
             f"{mean_of(top, 'left', 'right', 'front', 'back'):.2f}",
             f"{six[0]['energy_residual_relative']:.1e}, {cell[0]['energy_residual_relative']:.1e}")
    if pairs:
        a = [six[0]["strength_pa"] / 1e6 for _, six, _ in pairs]
        b = [cell[0]["strength_pa"] / 1e6 for _, _, cell in pairs]
        print(f"\nMeans {spread(a)} and {spread(b)} MPa: {100 * (statistics.mean(a) / statistics.mean(b) - 1):+.1f} %.\n")


def turned():
    print("## The packing turned under equal stresses, 5 MPa\n")
    head("seed", "turned about", "strain along the packing's own x, y, z, 1e-6", "largest over smallest - 1",
         "differs from the packing as it was", "residual")
    own = {"none": (0, 1, 2), "x": (0, 2, 1), "y": (2, 1, 0), "z": (1, 0, 2)}  # axis of the box along the packing's axis
    for seed in (1, 2, 3):
        reference = None
        for turn, axes in own.items():
            found = run(f"equal_{seed}_{turn}")
            if not found:
                continue
            end = [row for row in found[1] if row["stage"] == 1][-1]
            strain = [end["strain_x"], end["strain_y"], end["axial_strain_platen"]]
            packing = [1e6 * strain[axis] for axis in axes]
            reference = reference or packing
            differs = max(abs(a / b - 1) for a, b in zip(packing, reference))
            line(seed, turn, ", ".join(f"{value:.2f}" for value in packing), f"{100 * (max(packing) / min(packing) - 1):.2f} %",
                 f"{100 * differs:.3f} %", f"{found[0]['energy_residual_relative'] or float('nan'):.1e}")
    print("\n## The loads turned with the packing\n")
    head("seed", "loaded along z, MPa", "turned, along x, MPa", "residuals")
    for seed in (1, 2, 3):
        z, x = run(f"loads_{seed}_z"), run(f"loads_{seed}_x")
        if not (z and x):
            continue
        along = max(mean_of(row, "left", "right") for row in x[1])
        line(seed, f"{max(map(axial, z[1])):.2f}", f"{along:.2f}",
             f"{z[0]['energy_residual_relative']:.1e}, {x[0]['energy_residual_relative'] or float('nan'):.1e}")
    print()


def multistage():
    print("## One specimen at 2, 5 and 10 MPa beside one at each\n")
    head("seed", "2 MPa: one, each", "5 MPa: one, each", "10 MPa: one, each", "residual of the one")
    gathered = {}
    for seed, (summary, _) in several("multistage_{}", (1, 2, 3)):
        cells = []
        for pressure, stage in ((2, 2), (5, 5), (10, 8)):
            at = [s for s in summary["stages"] if s["stage"] == stage]
            single = run(f"single_{pressure}_{seed}")
            one = at[0]["largest_axial_stress_pa"] / 1e6 if at else float("nan")
            each = single[0]["strength_pa"] / 1e6 if single else float("nan")
            gathered.setdefault(pressure, []).append((one, each))
            cells.append(f"{one:.1f}, {each:.1f}")
        line(seed, *cells, f"{summary['energy_residual_relative']:.1e}")
    if gathered:
        line("mean", *(f"{spread(a for a, _ in v)}, {spread(b for _, b in v)}" for v in gathered.values()), "")
    print()


def class_two():
    print("## Led through the fall by the circumferential strain\n")
    head("seed", "led", "strength, MPa", "strain at peak and where the stress ends", "stress at the end over the peak",
         "kinetic over internal, largest after the peak", "residual")
    for seed in (1, 2, 3):
        for name, word in (("led", "yes"), ("not_led", "no")):
            found = run(f"{name}_{seed}")
            if not found:
                continue
            summary, rows = found
            peak = max(range(len(rows)), key=lambda k: axial(rows[k]))
            kinetic = max(row["kinetic_energy_j"] / (row["bond_energy_j"] + row["contact_energy_j"]) for row in rows[peak:])
            line(seed, word, f"{axial(rows[peak]):.1f}",
                 f"{rows[peak]['axial_strain_platen']:.5f}, {rows[-1]['axial_strain_platen']:.5f}",
                 f"{axial(rows[-1]) / axial(rows[peak]):.2f}", f"{kinetic:.1e}", f"{summary['energy_residual_relative']:.1e}")
    print()


def machine():
    print("## Soft and stiff machines\n")
    head("machine, N/m", "strength, MPa", "from .8 to .2 of the peak, us", "kinetic over internal there", "residual")
    for stiffness in ("rigid", "3e9", "4.5e8", "1e8"):
        found = run(f"machine_{stiffness}")
        if not found:
            continue
        summary, rows = found
        peak = max(range(len(rows)), key=lambda k: axial(rows[k]))
        falls = [row for row in rows[peak:] if axial(row) < 0.8 * axial(rows[peak])]
        below = [row for row in falls if axial(row) < 0.2 * axial(rows[peak])]
        span = f"{1e6 * (below[0]['time_s'] - falls[0]['time_s']):.0f}" if below else "not reached"
        kinetic = max(row["kinetic_energy_j"] / (row["bond_energy_j"] + row["contact_energy_j"]) for row in falls
                      if axial(row) > 0.2 * axial(rows[peak]))
        line(stiffness, f"{summary['strength_pa'] / 1e6:.1f}", span, f"{kinetic:.1e}", f"{summary['energy_residual_relative']:.1e}")
    print()


groups = {"biaxial": biaxial, "six": true_triaxial, "equal": turned, "multistage": multistage, "led": class_two,
          "machine": machine}
for start, part in groups.items():
    if any(folder.glob(start + "_*/summary.json")):
        part()
