"""Tables of the runs of run.sh. Usage: table.py FOLDER"""
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import platen

runs = platen.runs(sys.argv[1])
height, radius = 0.1, 0.025  # m, of the specimen
first = 50  # cracks that are called the first
rings = 5  # of equal area, for the pressure on the platen


def summary(name):
    return runs[name].summary if name in runs and runs[name].status else None


def number(value, scale=1.0, digits=2):
    return "-" if value is None else f"{value * scale:.{digits}f}"


def spread(values, digits=2):
    if len(values) < 2:
        return " ".join(f"{v:.{digits}f}" for v in values)
    if 1 < len(values) < 5:  # of fewer than five packings a deviation is a guess
        return f"{min(values):.{digits}f} ... {max(values):.{digits}f}, {len(values)} packings"
    return f"{statistics.mean(values):.{digits}f} +- {statistics.stdev(values):.{digits}f}"


def first_cracks(name):
    """Mean height from the nearer end (mm), and the share of them within 15 mm of an end."""
    ends = [min(h, height - h) for h in runs[name].cracks["z_m"][:first].tolist()]
    return statistics.mean(ends) * 1e3, sum(e < 0.015 for e in ends) / len(ends)


def pressure_profile(name, strain):
    """Load of the spheres on the lower platen in rings of equal area, over their mean, in the frame nearest to a
    closure strain before the peak."""
    history = runs[name].history
    time = next(t for t, e in zip(history["time_s"], history["axial_strain_platen"]) if e >= strain)
    frame = runs[name].contacts.at(time)
    load = [0.0] * rings
    for point, force in zip(frame.points.tolist(), frame.point_data["normal_force"].tolist()):
        if point[2] > 0.5 * height:
            continue
        ring = int(rings * min(0.999, (point[0] ** 2 + point[1] ** 2) / radius**2))
        load[ring] += force
    mean = sum(load) / rings
    return [value / mean for value in load]


def row(*cells):
    print("| " + " | ".join(str(c) for c in cells) + " |")


print("## Steel platens beside rigid ones\n")
row("platens", "strength MPa", "E GPa", "damage top, middle, bottom", "end spread", "residual", "seconds")
row(*["---"] * 7)
for kind in ["rigid", "across_8"]:
    for seed in (1, 2, 3):
        s = summary(f"{kind}_{seed}")
        if s:
            row(f"{'rigid' if kind == 'rigid' else 'steel'}, seed {seed}", number(s["strength_pa"], 1e-6),
                number(s["youngs_modulus_gauge_pa"], 1e-9),
                f"{number(s['end_damage_top'])}, {number(s['middle_damage'])}, {number(s['end_damage_bottom'])}",
                number(s["end_spread"]), number(s["energy_residual_relative"], 1, 5), number(s["wall_seconds"], 1, 0))

print("\n## Mesh\n")
row("elements across", "strength MPa, seeds 1, 2, 3", "mean", *[f"ring {k + 1}" for k in range(rings)])
row(*["---"] * (3 + rings))
for name in ["rigid"] + [f"across_{n}" for n in (3, 4, 8, 16)]:
    found = [s["strength_pa"] * 1e-6 for s in (summary(f"{name}_{seed}") for seed in (1, 2, 3)) if s]
    if not found:
        continue
    profiles = [pressure_profile(f"{name}_{seed}", 0.001) for seed in (1, 2, 3) if summary(f"{name}_{seed}")]
    mean = [statistics.mean(p[k] for p in profiles) for k in range(rings)]
    row(name.replace("across_", ""), ", ".join(f"{v:.2f}" for v in found), spread(found), *[f"{m:.3f}" for m in mean])

print("\n## Stiffness\n")
row("E platen / E concrete", "strength MPa", "strain at peak %", f"first {first} cracks: mm from the nearer end",
    "of them within 15 mm of an end", "damage top, middle, bottom", "end spread", "barrel", "residual")
row(*["---"] * 9)
for name in ["rigid_1", "ratio_10", "ratio_3", "ratio_1", "ratio_0.05"]:
    s = summary(name)
    if not s:
        continue
    distance, share = first_cracks(name)
    row(name.replace("ratio_", "").replace("_1", ""), number(s["strength_pa"], 1e-6),
        number(s["strain_at_peak_platen"], 100, 3), f"{distance:.0f}", f"{share:.0%}",
        f"{number(s['end_damage_top'])}, {number(s['middle_damage'])}, {number(s['end_damage_bottom'])}",
        number(s["end_spread"]), number(s["barrel_at_peak"], 1, 3), number(s["energy_residual_relative"], 1, 5))

print("\n## Cost\n")
row("spheres", "rigid, seconds a 1000 steps", "steel", "over rigid")
row(*["---"] * 4)
for size in ("1.78", "1.121"):
    per_step = {"rigid": [], "deformable": []}
    spheres = 0
    for kind in per_step:
        for turn in (1, 2, 3):
            s = summary(f"cost_{size}_{kind}_{turn}")
            if s:
                spheres = s["particles"]
                per_step[kind].append(1e3 * (s["wall_seconds"] - s["setup_seconds"]) / s["steps"])
    if all(per_step.values()):
        ratios = [d / r - 1 for r, d in zip(per_step["rigid"], per_step["deformable"])]
        row(spheres, *[", ".join(f"{v:.3f}" for v in per_step[k]) for k in ("rigid", "deformable")],
            ", ".join(f"{r:+.0%}" for r in ratios))
