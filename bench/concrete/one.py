"""Table of one concrete in every test, beside laboratories. Usage: one.py FOLDER|FILE.csv [SEED...] [unseen SEED...]

A row is a figure: mean +- standard deviation over packings (how many), of those it was calibrated for and of unseen ones.
Where the mean lies outside of its band the row says so, in red on a terminal. What the table takes from each run is kept in
FOLDER/runs.csv (runs.py), which makes the table alone as well.
"""
import math
import pathlib
import statistics
import sys

import runs

words = sys.argv[2:] or ["1", "2", "3", "4", "5", "unseen", "6", "7"]
cut = words.index("unseen") if "unseen" in words else len(words)
known, unseen = [int(w) for w in words[:cut]], [int(w) for w in words[cut + 1:]]
seeds = known + unseen
MPA, GPA = 1e-6, 1e-9
STRENGTH = "strength_pa"
PRESSURES = ("1.5", "3", "4.5", "9", "30", "60")
found = runs.gather(pathlib.Path(sys.argv[1]))


def of_seeds(name, what, scale=1.0):
    """{seed: figure} of each seed whose run has it; `what` is a column or takes the run."""
    figures = {}
    for seed in seeds:
        run = found.get(f"{name}_{seed}")
        value = run and (what(run) if callable(what) else run[what])
        if value is not None:
            figures[seed] = scale * value
    return figures


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
    return "\033[31m**outside**\033[0m" if sys.stdout.isatty() else "**outside**"


def row(what, figures, low=None, high=None, laboratory=""):
    one, other = ([figures[s] for s in some if s in figures] for some in (known, unseen))
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
    dry, lub = (of_seeds(f"concrete_{ends}", STRENGTH, MPA) for ends in ("dry", "lubricated"))
    cube, cube_lub = (of_seeds(f"cube_{ends}", STRENGTH, MPA) for ends in ("dry", "lubricated"))
    prism, prism_lub = (of_seeds(f"prism_{ends}", STRENGTH, MPA) for ends in ("dry", "lubricated"))
    tension = of_seeds("concrete_tension", STRENGTH, MPA)
    row("E, GPa", of_seeds("concrete_dry", "youngs_modulus_gauge_pa", GPA), 20, 30)
    row("Poisson's ratio", of_seeds("concrete_dry", "poisson_ratio"), 0.15, 0.22)
    row("strength, dry, MPa", dry, 35, 50)
    row("strain at peak, 1e-3", of_seeds("concrete_dry", "strain_at_peak_platen", 1e3), 2, 4)
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
    row("height over diameter .5 over 2, dry", ratio(of_seeds("flat_dry", STRENGTH, MPA), dry), 1.5, 2.2)
    row("1 over 2", ratio(of_seeds("core_50", STRENGTH, MPA), dry), laboratory="1.15 to 1.18, ASTM C42")
    for height, factor in (("62.5", 1 / 0.93), ("75", 1 / 0.96), ("87.5", 1 / 0.98)):
        row(f"{float(height) / 50:g} over 2", ratio(of_seeds(f"core_{height}", STRENGTH, MPA), dry), 0.95 * factor,
            1.05 * factor, f"{factor:.2f}, ASTM C42")
    row("1.25 over 2, friction 0.1", ratio(of_seeds("core_62.5_0.1", STRENGTH, MPA), of_seeds("friction_0.1", STRENGTH, MPA)),
        0.95 / 0.93, 1.05 / 0.93, "1.08, ASTM C42")
    row("splitting strength over direct tension", ratio(of_seeds("brazilian_concrete", STRENGTH, MPA), tension))
    row("bending strength over direct tension", ratio(of_seeds("bending_concrete", STRENGTH, MPA), tension),
        laboratory="1.3 to 2 in small beams")
    row("bulk modulus, GPa", of_seeds("hydrostatic_concrete", "bulk_modulus_pa", GPA))
    row("uniaxial strain: lateral over axial stress", of_seeds("uniaxial_strain_concrete", "lateral_over_axial_stress"))
    row("constrained modulus, GPa", of_seeds("uniaxial_strain_concrete", "constrained_modulus_pa", GPA))


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
        row(f"volume at its peak, %", of_seeds(f"triaxial_{pressure}", "volume_at_peak_percent"), laboratory=f"{peak}, the same")


def biaxial():
    heading("Biaxial strength over uniaxial")
    for platens, name in (("brush", "brush platens"), ("steel", "dry steel")):
        alone = of_seeds(f"biaxial_{platens}_0", STRENGTH, MPA)
        for share in ("0.25", "0.5", "1"):
            row(f"{name}, stresses 1 : {share}", ratio(of_seeds(f"biaxial_{platens}_{share}", STRENGTH, MPA), alone),
                laboratory="1.16 (brushes), Kupfer et al. 1969" if share == "1" else "")


def has_cones(s):
    return 1.0 if s["pattern"] == "cones" else 0.0


def friction():
    heading("Friction of platens, cylinders of height over diameter 2, at .8 of the peak")
    runs = (("concrete_dry", "0.57"), ("friction_0.3", "0.3"), ("friction_0.1", "0.1"), ("concrete_lubricated", "0"))
    for name, mu in runs:
        greased, held = mu == "0", mu in ("0.57", "0.3")
        row(f"strength, friction {mu}, MPa", of_seeds(name, STRENGTH, MPA))
        row("damage of the worse end", of_seeds(name, "worse_end_damage"), 0.4 if greased else None, 0.3 if held else None)
        row("damage of the middle", of_seeds(name, "middle_damage"), 0.5 if held else None)
        row("r0 of the worse end's dead zone", of_seeds(name, "least_base_ratio"))
        row("share of packings with cones", of_seeds(name, has_cones), 1 if held else None, 0 if greased else None)
    angles = {}
    for seed in seeds:
        held = [run for n in ("concrete_dry", "friction_0.3") if (run := found.get(f"{n}_{seed}"))]
        of_cones = [run[f"half_angle_{end}_deg"] for run in held for end in ("top", "bottom")]
        of_cones = [angle for angle in of_cones if angle is not None]
        if of_cones:
            angles[seed] = statistics.mean(of_cones)
    k = secant("9")
    mohr = math.degrees(math.atan(statistics.mean(k.values()) ** -0.5)) if k else None
    row("half-angle of cones by displacement, .3 and .57, degrees", angles, mohr and mohr - 6, mohr and mohr + 6,
        f"{mohr:.0f}, Mohr-Coulomb with k at 9 MPa" if mohr else "")


def recipe():
    heading("What should not matter, over the cylinder as it is")
    dry, lub = (of_seeds(f"concrete_{ends}", STRENGTH) for ends in ("dry", "lubricated"))
    row("platen friction 1 over .57", ratio(of_seeds("friction_1", STRENGTH), dry))
    row("end layer of .6 over .3 mean radii, dry", ratio(of_seeds("layer_dry", STRENGTH), dry))
    row("the same, greased", ratio(of_seeds("layer_lubricated", STRENGTH), lub))
    row("half the speed over the speed", ratio(of_seeds("half_rate", STRENGTH), dry))


plain()
triaxial()
friction()
biaxial()
recipe()
residuals = [run["energy_residual_relative"] for run in found.values()]
known = [residual for residual in residuals if residual is not None]
print(f"\nLargest energy residual of all runs (1 %): {max(known):.2g}" if known else "\nNo run has an energy residual",
      f"; {len(residuals) - len(known)} runs have none" if len(known) < len(residuals) else "", sep="")
