#!/usr/bin/env python3
"""Table of one concrete in every test, beside laboratories. Usage: one.py FOLDER|FILE.csv

A row is a figure: mean +- standard deviation over packings (how many), of those it was calibrated for and of unseen ones.
Where the mean lies outside of its band the row says so. What the table takes from each run of one.sh is kept in FOLDER/runs.csv, which makes the
table alone as well.
"""
import csv
import math
import pathlib
import re
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import platen

KNOWN, UNSEEN = (1, 2, 3, 4, 5), (6, 7)  # seeds
MPA, GPA = 1e-6, 1e-9
STRENGTH = "strength_pa"
PRESSURES = ("1.5", "3", "4.5", "9", "30", "60")
OF_SUMMARY = ("version", "particles", "pattern", "strength_pa", "strain_at_peak_platen", "youngs_modulus_gauge_pa", "poisson_ratio", "bulk_modulus_pa",
              "constrained_modulus_pa", "lateral_over_axial_stress", "worse_end_damage", "middle_damage", "energy_residual_relative",
              "platen_unbalanced_work_relative")
ENDS = [(f"{state}cone_{end}", f"{state}half_angle_{end}_deg") for state in ("", "final_") for end in ("top", "bottom")]
OF_HISTORY = ("left_at_1.45", "left_at_0.0345", "least_volume_percent", "volume_at_peak_percent")
COLUMNS = ("run", *OF_SUMMARY, "least_base_ratio", *(name for _, name in ENDS), *OF_HISTORY)


def under_pressure(run):
    """Of a test in the sleeve: what is left of the deviator at 1.45 times the strain at peak, and at a strain of 3.45e-2, over
    the largest, none where the run ends before; and the volume of the middle half, %, larger positive, from the bare specimen, as a laboratory has
    it from axial and lateral strain (the volume within the sleeve also has what its springs give way, docs/theory.md 12: .6 % here).
    Strains count from the end of the consolidation. One that flows has no peak: its strength here is the largest stress."""
    s, deviator, strain = run.summary, run.history["deviator_pa"], run.history["axial_strain_platen"]
    peak = int(deviator.argmax())
    start = strain[run.history["time_s"] >= s["consolidation_end_time_s"]][0]

    def left(further):
        later = (strain[peak:] >= start + further).nonzero()[0]
        return deviator[peak + later[0]] / deviator[peak] if later.size else None

    volumes, at_peak = -100 * run.history["volumetric_strain"], s["strain_at_peak_platen"]
    return {STRENGTH: s["largest_stress_pa"] if s[STRENGTH] is None else s[STRENGTH], "left_at_1.45": at_peak and left(1.45 * at_peak),
            "left_at_0.0345": left(0.0345), "least_volume_percent": volumes[:peak + 1].min(), "volume_at_peak_percent": volumes[peak]}


def figures(name, run):
    """Of a finished run."""
    s = run.summary
    found = {"run": name, **{key: s.get(key) for key in OF_SUMMARY}, **{name: (s.get(cone) or {}).get("half_angle_deg") for cone, name in ENDS}}
    if any(zones := [s.get(f"dead_zone_{end}") for end in ("top", "bottom")]):
        found["least_base_ratio"] = min((zone or {}).get("base_ratio") or 0.0 for zone in zones)
    return {**found, **(under_pressure(run) if name.startswith("triaxial_") and not name.startswith("triaxial_0_") else {})}


def gather(where):
    """{name: figures} of a file of runs, or of a folder of studies: its runs.csv and its finished runs, which are added to that file."""
    kept = where if where.is_file() else where / "runs.csv"
    found = {row["run"]: row for row in platen.read_table(kept).records()} if kept.exists() else {}
    if where.is_file():
        return found
    for folder in where.glob("*/runs"):
        for name, run in platen.runs(folder).items():
            if run.status == "done":  # triaxial, confining_pressure_4.5_mpa_seed_1: triaxial_4.5_1
                value, seed = re.search(r"(?:_(\d[\d.]*|free)(?:_mm|_mpa)?_)?seed_(\d+)$", name).groups()
                name = "_".join(filter(None, (folder.parent.name.split("-")[0], value, seed)))
                found[name] = figures(name, run)
    with open(kept, "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(COLUMNS)
        for name in sorted(found):
            cells = [found[name].get(column) for column in COLUMNS]
            table.writerow(["" if cell is None or cell != cell else cell if isinstance(cell, str) else f"{cell:.7g}" for cell in cells])
    return {row["run"]: row for row in platen.read_table(kept).records()}


found = gather(pathlib.Path(sys.argv[1])) if len(sys.argv) == 2 else sys.exit(__doc__)


def of_seeds(name, what, scale=1.0):
    """{seed: figure} of each seed whose run has it; `what` is a column or takes the run."""
    runs = {seed: found[f"{name}_{seed}"] for seed in KNOWN + UNSEEN if f"{name}_{seed}" in found}
    values = {seed: what(run) if callable(what) else run[what] for seed, run in runs.items()}
    return {seed: scale * value for seed, value in values.items() if not math.isnan(value)}


def ratio(one, other):
    """Seed by seed: a packing beside itself."""
    return {seed: one[seed] / other[seed] for seed in one if seed in other}


def mander(fc, p):
    """MPa, strength of confined concrete (Mander, Priestley and Park 1988)."""
    return fc * (-1.254 + 2.254 * (1 + 7.94 * p / fc) ** 0.5 - 2 * p / fc)


def newman(fc, p):
    """MPa, EN 1998-3 (Newman)."""
    return fc * (1 + 3.7 * (p / fc) ** 0.86)


def mander_strain(fc, p):
    """Strain at the peak over the unconfined one (Richart 1928, EN 1998-3 A.7, with Mander's strength)."""
    return 1 + 5 * (mander(fc, p) / fc - 1)


def attard_setunge_strain(fc, p):
    """The same (Attard and Setunge 1996; p from 1 to 20 MPa; 4.29 at fc 40 and p 9 MPa, 2.64 at p 4.5 MPa)."""
    return 1 + (17 - 0.06 * fc) * p / fc


def said(values):
    if not values:
        return "-"
    if 1 < len(values) < 5:  # of fewer than five packings a deviation is a guess
        return f"{min(values):.3g} ... {max(values):.3g} ({len(values)})"
    scatter = f" +- {statistics.stdev(values):.2g}" if len(values) > 1 else ""
    return f"{statistics.mean(values):.3g}{scatter} ({len(values)})"


def verdict(values, low, high):
    if not values:
        return "not run"
    if low is None and high is None:
        return "stated"
    mean = statistics.mean(values)
    if (low is None or mean >= low) and (high is None or mean <= high):
        return "within"
    return "**outside**"


def row(what, figures, low=None, high=None, laboratory=""):
    one, other = ([figures[s] for s in some if s in figures] for some in (KNOWN, UNSEEN))
    band = "-" if low is None and high is None else \
        f"{'' if low is None else f'{low:.3g}'} ... {'' if high is None else f'{high:.3g}'}"
    words = verdict(one, low, high)
    if other and verdict(other, low, high) != words:
        words += f", unseen {verdict(other, low, high)}"
    print(f"| {what} | {said(one)} | {said(other)} | {band} | {laboratory} | {words} |")


def heading(what):
    print(f"\n**{what}**\n\n| | packings | unseen packings | band | laboratory | |\n| --- | --- | --- | --- | --- | --- |")


def plain():
    heading("Strength, moduli, short and slender")
    dry, lub = (of_seeds(f"concrete_{mu}", STRENGTH, MPA) for mu in ("0.57", "0"))
    cube, cube_lub = (of_seeds(f"cube_{mu}", STRENGTH, MPA) for mu in ("0.57", "0"))
    prism, prism_lub = (of_seeds(f"prism_{mu}", STRENGTH, MPA) for mu in ("0.57", "0"))
    tension = of_seeds("tension", STRENGTH, MPA)
    row("E, GPa", of_seeds("concrete_0.57", "youngs_modulus_gauge_pa", GPA), 20, 30)
    row("Poisson's ratio", of_seeds("concrete_0.57", "poisson_ratio"), 0.15, 0.22)
    row("strength, dry, MPa", dry, 35, 50)
    row("strain at peak, 1e-3", of_seeds("concrete_0.57", "strain_at_peak_platen", 1e3), 2, 4)
    row("strength, greased, MPa", lub)
    row("compressive over direct tensile strength", ratio(dry, tension), 8, 12)
    hughes = "Hughes and Bahramian 1967"
    row("cube, dry over greased", ratio(cube, cube_lub), 1.21, 1.59, f"1.42, {hughes}")
    row("prism, dry over greased", ratio(prism, prism_lub), 1.03, 1.11, "1.08, the same")
    row("cube over prism, dry", ratio(cube, prism), 1.21, 1.47, "1.37, the same")
    row("cube over prism, greased", ratio(cube_lub, prism_lub), 1.00, 1.10, "1.04, the same")
    for friction in ("0.0048", "0.03"):
        free = ratio(of_seeds(f"cube_{friction}", STRENGTH, MPA), of_seeds(f"prism_{friction}", STRENGTH, MPA))
        row(f"the same, friction {friction}", free, 1.00, 1.10, "1.04, the same")
    row("height over diameter .5 over 2, dry", ratio(of_seeds("flat", STRENGTH, MPA), dry), 1.5, 2.2)
    row("1 over 2", ratio(of_seeds("core_50", STRENGTH, MPA), dry), laboratory="1.15 to 1.18, ASTM C42")
    for height, factor in (("62.5", 1 / 0.93), ("75", 1 / 0.96), ("87.5", 1 / 0.98)):
        row(f"{float(height) / 50:g} over 2", ratio(of_seeds(f"core_{height}", STRENGTH, MPA), dry), 0.95 * factor,
            1.05 * factor, f"{factor:.2f}, ASTM C42")
    row("1.25 over 2, friction 0.1", ratio(of_seeds("smooth_core_62.5", STRENGTH, MPA), of_seeds("concrete_0.1", STRENGTH, MPA)),
        0.95 / 0.93, 1.05 / 0.93, "1.08, ASTM C42")
    row("splitting strength over direct tension", ratio(of_seeds("splitting", STRENGTH, MPA), tension))
    row("bending strength over direct tension", ratio(of_seeds("bending", STRENGTH, MPA), tension),
        laboratory="1.3 to 2 in small beams")
    row("bulk modulus, GPa", of_seeds("hydrostatic", "bulk_modulus_pa", GPA))
    row("uniaxial strain: lateral over axial stress", of_seeds("uniaxial_strain", "lateral_over_axial_stress"))
    row("constrained modulus, GPa", of_seeds("uniaxial_strain", "constrained_modulus_pa", GPA))


def secant(pressure):
    """(strength - fc)/p of each seed."""
    bare, strength = of_seeds("triaxial_0", STRENGTH, MPA), of_seeds(f"triaxial_{pressure}", STRENGTH, MPA)
    return {seed: (strength[seed] - bare[seed]) / float(pressure) for seed in strength if seed in bare}


def triaxial():
    heading("In the sleeve, fc of the same packing")
    bare = of_seeds("triaxial_0", STRENGTH, MPA)
    fc = statistics.mean(bare.values()) if bare else 43
    row("fc, MPa", bare)
    for pressure in PRESSURES:
        p = float(pressure)
        lines = sorted((f(fc, p) - fc) / p for f in (mander, newman))
        wanted = (0.85 * lines[0], 1.15 * lines[1]) if p < 60 else (None, None)
        row(f"(strength - fc)/p at {pressure} MPa", secant(pressure), *wanted,
            f"{lines[0]:.1f} ... {lines[1]:.1f}, Mander 1988, EN 1998-3")
    at_peak = {p: of_seeds(f"triaxial_{p}", "strain_at_peak_platen", 1e3) for p in ("0", "9")}
    row("strain at peak at 9 MPa, 1e-3", at_peak["9"])
    low, high = attard_setunge_strain(fc, 9), mander_strain(fc, 9)
    row("the same over that at 0", ratio(at_peak["9"], at_peak["0"]), low, high,
        f"{low:.1f}, Attard and Setunge 1996, {high:.1f}, Mander 1988")
    row("last over peak at 9 MPa, at 1.45 times the strain at peak", of_seeds("triaxial_9", "left_at_1.45"),
        laboratory=".99 at .36 fc, Imran and Pantazopoulou 1996")
    for pressure in ("30", "60"):
        row(f"last over peak at {pressure} MPa, at 3.45e-2", of_seeds(f"triaxial_{pressure}", "left_at_0.0345"), 0.9)
    for pressure, least, peak in (("9", "-.8", ".1"), ("30", "-1.6", "-.4"), ("60", "-2.0", "-1.3")):
        at = {"9": ".36", "30": ".63", "60": ".91"}[pressure]
        row(f"least volume at {pressure} MPa ({float(pressure) / fc:.2f} fc), %", of_seeds(f"triaxial_{pressure}", "least_volume_percent"),
            laboratory=f"{least} at {at} fc, Imran and Pantazopoulou 1996")
        row("volume at its peak, %", of_seeds(f"triaxial_{pressure}", "volume_at_peak_percent"), laboratory=f"{peak}, the same")


def biaxial():
    heading("Biaxial strength over uniaxial")
    for platens, name in (("brush", "brush platens"), ("steel", "dry steel")):
        alone = of_seeds(f"biaxial_{platens}_free", STRENGTH, MPA)
        for share in ("0.25", "0.5", "1"):
            row(f"{name}, stresses 1 : {share}", ratio(of_seeds(f"biaxial_{platens}_{share}", STRENGTH, MPA), alone),
                laboratory="1.16 (brushes), Kupfer et al. 1969" if share == "1" else "")


def has_cones(s):
    return 1.0 if s["pattern"] == "cones" else 0.0


def half_angles():
    """Degrees: the mean of each packing's cones at friction .57 and .3; that of a Mohr-Coulomb solid, none without k."""
    angles = {}
    for seed in KNOWN + UNSEEN:
        held = [run for n in ("concrete_0.57", "concrete_0.3") if (run := found.get(f"{n}_{seed}"))]
        of_cones = [run[f"half_angle_{end}_deg"] for run in held for end in ("top", "bottom")]
        of_cones = [angle for angle in of_cones if not math.isnan(angle)]
        if of_cones:
            angles[seed] = statistics.mean(of_cones)
    k = secant("9")
    return angles, math.degrees(math.atan(statistics.mean(k.values()) ** -0.5)) if k else None


def friction():
    heading("Friction of platens, cylinders of height over diameter 2, at .8 of the peak")
    for mu in ("0.57", "0.3", "0.1", "0"):
        name = f"concrete_{mu}"
        greased, held = mu == "0", mu in ("0.57", "0.3")
        row(f"strength, friction {mu}, MPa", of_seeds(name, STRENGTH, MPA))
        row("damage of the worse end", of_seeds(name, "worse_end_damage"), 0.4 if greased else None, 0.3 if held else None)
        row("damage of the middle", of_seeds(name, "middle_damage"), 0.5 if held else None)
        row("r0 of the worse end's dead zone", of_seeds(name, "least_base_ratio"))
        row("share of packings with cones", of_seeds(name, has_cones), 1 if held else None, 0 if greased else None)
    angles, mohr = half_angles()
    row("half-angle of cones by displacement, .3 and .57, degrees", angles, mohr and mohr - 6, mohr and mohr + 6,
        f"{mohr:.0f}, Mohr-Coulomb with k at 9 MPa" if mohr else "")


def recipe():
    heading("What should not matter, over the cylinder as it is")
    dry, lub = (of_seeds(f"concrete_{mu}", STRENGTH) for mu in ("0.57", "0"))
    row("platen friction 1 over .57", ratio(of_seeds("concrete_1", STRENGTH), dry))
    row("end layer of .6 over .3 mean radii, dry", ratio(of_seeds("layer_0.57", STRENGTH), dry))
    row("the same, greased", ratio(of_seeds("layer_0", STRENGTH), lub))
    row("half the speed over the speed", ratio(of_seeds("half_rate", STRENGTH), dry))


def any_stress():
    """Rows of one concrete under any stress, with its bands; ends with how many are within."""
    heading("Under any stress")
    counted = []

    def figure(what, figures, low, high, laboratory=""):
        row(what, figures, low, high, laboratory)
        counted.append(verdict([figures[s] for s in KNOWN if s in figures], low, high))

    dry, cylinder = of_seeds("concrete_0.57", STRENGTH, MPA), "concrete_0.57"
    figure("E, GPa", of_seeds(cylinder, "youngs_modulus_gauge_pa", GPA), 25, 30)
    figure("Poisson's ratio", of_seeds(cylinder, "poisson_ratio"), 0.15, 0.20)
    figure("strength, dry, MPa", dry, 35, 45)
    figure("strain at peak, 1e-3", of_seeds(cylinder, "strain_at_peak_platen", 1e3), 2.0, 2.6)
    tension = of_seeds("tension", STRENGTH, MPA)
    figure("compressive over direct tensile strength", ratio(dry, tension), 8, 12)
    figure("splitting over direct tension", ratio(of_seeds("splitting", STRENGTH, MPA), tension), 0.9, 1.15)
    figure("bending over direct tension", ratio(of_seeds("bending", STRENGTH, MPA), tension), 1.2, 2)
    for platens in ("brush", "smooth"):
        alone = of_seeds(f"biaxial_{platens}_free", STRENGTH, MPA)
        for share, low, high, kupfer in (("1", 1.08, 1.24, "1.16, Kupfer et al. 1969"), ("0.5", 1.15, 1.35, "")):
            both = of_seeds(f"biaxial_{platens}_{share}", STRENGTH, MPA)
            figure(f"two stresses 1 : {share} over one, {platens} platens", ratio(both, alone), low, high, kupfer)
    bare = of_seeds("triaxial_0", STRENGTH, MPA)
    for pressure in ("1.5", "3", "9", "30"):
        fc, p = statistics.mean(bare.values()) if bare else 43, float(pressure)
        lines = sorted((f(fc, p) - fc) / p for f in (mander, newman))
        figure(f"k at {pressure} MPa", secant(pressure), 0.8 * lines[0], 1.2 * lines[1],
               f"{lines[0]:.1f} ... {lines[1]:.1f}, Mander 1988, EN 1998-3")
    at_peak = {p: of_seeds(f"triaxial_{p}", "strain_at_peak_platen") for p in ("0", "9")}
    figure("strain at peak at 9 MPa over bare", ratio(at_peak["9"], at_peak["0"]), 3, 6.5)
    figure("last over peak at 9 MPa, at 3.45e-2", of_seeds("triaxial_9", "left_at_0.0345"), 0.85, None)
    figure("volume at its peak at 9 MPa, %", of_seeds("triaxial_9", "volume_at_peak_percent"), -0.3, 0.5, ".1, Imran and Pantazopoulou 1996")
    figure("the same at 30 MPa", of_seeds("triaxial_30", "volume_at_peak_percent"), -1.0, 0.2, "-.4, the same")
    for form, low, high in (("cube", 1.21, 1.59), ("prism", 1.03, 1.12)):
        held, free = (of_seeds(f"{form}_{mu}", STRENGTH) for mu in ("0.3", "0"))
        figure(f"{form}, friction .3 over 0", ratio(held, free), low, high)
    for height, share, factor in (("50", "1", 1 / 0.87), ("62.5", "1.25", 1 / 0.93), ("75", "1.5", 1 / 0.96), ("87.5", "1.75", 1 / 0.98)):
        core = ratio(of_seeds(f"core_{height}", STRENGTH, MPA), dry)
        figure(f"height over diameter {share} over 2, friction .57", core, 0.95 * factor, 1.05 * factor, f"{factor:.2f}, ASTM C42")
    figure(".5 over 2, friction .57", ratio(of_seeds("flat", STRENGTH, MPA), dry), 1.5, 2.2)
    for mu, low, high in (("0.57", 1, None), ("0.3", 1, None), ("0", None, 0)):
        figure(f"share of packings with cones, friction {mu}", of_seeds(f"concrete_{mu}", has_cones), low, high)
    angles, mohr = half_angles()
    figure("half-angle of cones, .3 and .57, degrees", angles, mohr and mohr - 6, mohr and mohr + 6,
           f"{mohr:.0f}, Mohr-Coulomb with k at 9 MPa" if mohr else "")
    print(f"\n{counted.count('within')} of {len(counted) - counted.count('not run')} rows within, "
          f"{counted.count('not run')} not run")


any_stress()
plain()
triaxial()
friction()
biaxial()
recipe()
residuals = [run["energy_residual_relative"] for run in found.values()]
known = [residual for residual in residuals if not math.isnan(residual)]
print(f"\nLargest energy residual of all runs (1 %): {max(known):.2g}" if known else "\nNo run has an energy residual",
      f"; {len(residuals) - len(known)} runs have none" if len(known) < len(residuals) else "", sep="")
