#!/usr/bin/env python3
"""Ready materials of finished searches: scenes/materials/NAME.prm and the table of bench/results/materials.md.

    bench/materials/materials.py FOLDER     FOLDER/NAME is what platen-calibrate wrote for scenes/calibrate_NAME.prm
"""
import math
import re
import statistics
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import platen  # noqa: E402

# Name of the search: name of the material's file, heading, what it is calibrated on and its sources.
MATERIALS = {
    "c40": ("concrete_c40", "Concrete of 47 MPa",
            ["strength, and that under 17.2 and 43 MPa: Imran and Pantazopoulou 1996, ACI Materials Journal 93(6) (measured)",
             "E and tension: fib Model Code 2020 for that strength (formulas, not measured); Poisson's ratio: its design value"]),
    "c70": ("concrete_c70", "Concrete of 78 MPa",
            ["strength, E, tension, Poisson's ratio: means of class C70 in fib Model Code 2020 (a standard)",
             "strength under 8 and 20 MPa: EN 1998-3 (A.6), after Newman and Newman 1971 (a formula)"]),
    "granite": ("granite", "Westerly granite",
                ["strength, and that under 13 and 42 MPa: Mogi 1967, J. Geophys. Res. 72 (measured)",
                 "E and Poisson's ratio: input of a public analysis of such tests, which names no test",
                 "tension: Brazilian, of a data sheet that names no source"]),
    "marble": ("marble", "Carrara marble",
               ["strength, and that under 10 and 30 MPa: McCormick and Rutter 2022 (measured; \"bare\" is at .1 MPa)",
                "tension: triaxial extension, Ramsey and Chester 2004, Nature 428",
                "E and Poisson's ratio: input of a public analysis of these tests, which names no test"]),
    "sandstone": ("sandstone", "Berea sandstone",
                  ["strength: Cleveland Quarries, ASTM C170; under 10 and 50 MPa: Bernabe and Brace 1990 (measured)",
                   "tension: triaxial extension under 10 MPa, Bobich 2005",
                   "E and Poisson's ratio: input of a public analysis, which names no test"]),
    "mortar": ("mortar", "Mortar of lime and volcanic ash",
               ["strength and E: replica of Roman architectural mortar, last of three ages; PNAS, a table of mortar reproductions (which names no test)",
                "tension: reproduction of Trajanic mortar in the same table, of E 3.37 GPa, by an analysis of fracture tests",
                "Poisson's ratio and density: assumed, the table has none; strength under pressure: none"]),
    "silica": ("silica", "Fused silica",
               ["E and Poisson's ratio: Crystran handbook, 5th edition, 2023 (its producer's data)",
                "tension: a data page that names no test; glass is as strong as its surface. Compression is not calibrated: no test of a specimen was found"]),
}
UNITS = {"youngs_modulus_gauge_pa": ("E", 1e9, "GPa"), "poisson_ratio": ("Poisson's ratio", 1, ""),
         "compressive_strength_pa": ("strength", 1e6, "MPa"), "tensile_strength_pa": ("tension", 1e6, "MPa")}


def pressures(found):
    """Pressures of the targets of a scene, as it writes them; None where a target has none."""
    targets = re.findall(r"subsection Target \d+\n(.*?)\n  end", found, re.S)
    return [m[1].strip() if (m := re.search(r"set Pressure *= *(.*)", target)) and m[1].strip() else None for target in targets]


def figures(folder):
    """For each target of a search: label, unit, wanted, mean and deviation of the unseen packings, how far off (%)."""
    targets = platen.Run(folder).summary["targets"]
    for target, pressure in zip(targets, pressures((folder / "found.prm").read_text()), strict=True):
        name, factor, unit = (f"strength at {pressure}", 1e6, "MPa") if pressure else UNITS[target["key"]]
        seen = target["verification"]
        yield name, unit, target["wanted"] / factor, seen["mean"] / factor, seen["deviation"] / factor, 100 * target["verification_miss"]


def secants(folder):
    """Of the compression tests of the unseen packings: E and Poisson's ratio from the start to 40 % of the strength (GPa, -), and the strain at the
    peak (mm/m), mean and deviation each; nothing where strength was no target."""
    found = platen.Run(folder).summary
    rows = [row for row in platen.read_table(folder / "trials.csv").records() if row["test"] == "compression"]
    unseen = rows[-found["verification"].get("compressive_strength_pa", {"seeds": 0})["seeds"]:] if rows else []
    columns = {"youngs_modulus_gauge_pa": 1e-9, "poisson_ratio": 1, "strain_at_peak": 1e3}
    found = [[factor * row[name] for row in unseen] for name, factor in columns.items()]
    return [(statistics.mean(values), statistics.stdev(values)) for values in found if values]


def above_half(folder):
    """How many of the unseen packings have a Poisson's ratio that no elastic specimen has: summary.json of a test says null for it."""
    rows = [row for row in platen.read_table(folder / "trials.csv").records() if row["test"] == "compression"]
    seeds = platen.Run(folder).summary["verification"].get("compressive_strength_pa", {"seeds": 0})["seeds"]
    return sum(row["poisson_ratio"] > 0.5 for row in rows[-seeds:]) if seeds else 0


def secant_ratio(folder):
    """Poisson's ratio to 40 % of the strength, as text."""
    mean, deviation = secants(folder)[1]
    above = above_half(folder)
    return f"{mean:.2g} +- {deviation:.1g}" if above == 0 else f"none (above 0.5 in {above} of 5)"


def entry(found, name):
    """The value of `set NAME = value` in the section that `found` is of, shortened to what a reader needs."""
    value = next(line.split("=", 1)[1].strip() for line in found if line.split("=", 1)[0].split() == ["set", *name.split()])
    return ", ".join(rounded(part.strip()) for part in value.split(","))


def rounded(text):
    number, *unit = text.split(" ", 1) if text else [""]
    try:
        value = float(number)
    except ValueError:
        return text
    if unit == ["Pa"]:
        factor, name = (1e9, "GPa") if value >= 1e9 else (1e6, "MPa")
        return f"{value / factor:.5g} {name}"
    if unit == ["rad"]:
        return f"{math.degrees(value):.5g} degree"
    return " ".join([f"{value:.5g}", *unit])


def sections(path):
    """The lines of a scene by section."""
    result, here = {}, None
    for line in path.read_text().splitlines():
        if line.startswith("subsection "):
            here = result.setdefault(line.split(None, 1)[1], [])
        elif here is not None:
            here.append(line)
    return result


# What a material is: the packing is part of it, since bonds hold for one packing only.
KEYS = {
    "Specimen": ["Sphere radius", "Radius spread", "Packing", "Ends", "End layer"],
    "Material": ["Density"],
    "Effects": ["Bond", "Contact", "Tangential", "Rotation"],
    "Bond": ["Modulus", "Stiffness ratio", "Tensile strength", "Shear strength", "Friction angle", "Moment contribution",
             "Compression limits", "Compression slopes", "Radius multiplier", "Radius rule", "Gap"],
    "Contact": ["Friction", "Stiffness", "Tangential ratio", "Damping"],
    "Platens": ["Stiffness", "Tangential ratio", "Damping"],
}


def calibrated(folder):
    """Entries that say what the bonds hold for, of the targets of a search: a run says so where a scene asks for more."""
    kinds = {"E": "elastic", "Poisson's ratio": "elastic", "strength": "compression", "tension": "tension"}
    figures_of = {kinds.get(name, "confined") for name, *_ in figures(folder)}
    return [f"  set Calibrated radius = {entry(sections(folder / 'found.prm')['Specimen'], 'Sphere radius')}",
            "  set Calibrated packing = random close",
            f"  set Calibrated figures = {', '.join(word for word in ('elastic', 'compression', 'confined', 'tension') if word in figures_of)}"]


def material_file(search, folder):
    """The text of scenes/materials/NAME.prm."""
    _, heading, sources = MATERIALS[search]
    summary, found = platen.Run(folder).summary, sections(folder / "found.prm")
    lines = [f"# {heading}: bonds and packing for a scene that includes this file and sets the shape of its specimen, the friction of its platens\n# and Loading.", "# Calibrated on:"]
    lines += [f"#   {source}" for source in sources]
    specimen = found["Specimen"]
    lines += [f"# Holds for spheres of {entry(specimen, 'Sphere radius')} mean radius with a spread of {entry(specimen, 'Radius spread')}, packed random close, ends "
              f"ground by {entry(specimen, 'End layer')} radii, as in a cylinder of",
              f"# 50 mm x 100 mm ({summary['particles']} spheres), between dry steel platens (friction {entry(found['Platens'], 'Friction static')}). "
              "Another packing is\n# refused, another radius noted: it needs another calibration, or the exponents of Bond/Calibrated radius.",
              "# On five packings that the search did not see:"]
    for name, unit, wanted, mean, deviation, off in figures(folder):
        lines.append(f"#   {name} {mean:.4g} +- {deviation:.2g} {unit}".rstrip() + f" (source {wanted:.4g}, {off:+.1f} %)")
    if beyond := secants(folder):
        (e, de), _, (peak, dpeak) = beyond
        lines.append("# E and Poisson's ratio above are those of small strains. From the start to 40 % of the strength, where bonds have broken already:")
        lines.append(f"#   E {e:.3g} +- {de:.2g} GPa, Poisson's ratio {secant_ratio(folder)}; strain at the peak {peak:.3g} +- {dpeak:.2g} mm/m")
    lines.append(f"# Found by: platen-calibrate scenes/calibrate_{search}.prm")
    for section, keys in KEYS.items():
        lines.append(f"subsection {section}")
        for key in keys:
            value = entry(found[section], key)
            if value:
                lines.append(f"  set {key} = {value}")
        if section == "Bond":
            lines += calibrated(folder)
        lines.append("end")
    return "\n".join(lines) + "\n"


def table(folders):
    """The table of bench/results/materials.md: one row for each target of each material."""
    lines = ["| material | figure | source | five unseen packings | off | allowed |", "| --- | --- | --- | --- | --- | --- |"]
    for search, folder in folders:
        allowed = {"E": 3, "Poisson's ratio": 3, "strength": 5, "tension": 5}
        for name, unit, wanted, mean, deviation, off in figures(folder):
            limit = allowed.get(name, 10)
            verdict = "" if abs(off) <= limit else " **missed**"
            lines.append(f"| {MATERIALS[search][0]} | {name}{', ' + unit if unit else ''} | {wanted:.4g} | {mean:.4g} +- {deviation:.2g} | "
                         f"{off:+.1f} %{verdict} | {limit} % |")
    return "\n".join(lines)


def beyond_table(folders):
    """What the bonds give beside their targets."""
    lines = ["| material | E to 40 % of the strength, GPa | Poisson's ratio to 40 % | strain at the peak, mm/m |", "| --- | --- | --- | --- |"]
    for search, folder in folders:
        if beyond := secants(folder):
            cells = [f"{mean:.3g} +- {deviation:.2g}" for mean, deviation in beyond]
            cells[1] = secant_ratio(folder)
            lines.append(f"| {MATERIALS[search][0]} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


HEADING = """# Ready materials

Bonds of `scenes/materials`, found by `platen-calibrate scenes/calibrate_NAME.prm` on four packings and judged on five others: mean +-
standard deviation of these five, beside the figure of the source. Cylinders of 50 mm x 100 mm with spheres of 2.2 mm mean radius (about 2 600, 11
across), packed random close, between dry steel platens (friction 0.57); tension between glued ends; pressure on the outer spheres. Yielding parallel
bonds; silica: parallel bonds. Written by `bench/materials/materials.py FOLDER`. Sources, with what was measured, what is a formula and what names
no test: the heads of the files, and [sources.csv](../materials/sources.csv).

"""
BEYOND = """
## Beside the targets

E and Poisson's ratio above are those of small strains (a static solve at 1e-5), the initial tangent. The secants that `summary.json` of a test has go to
40 % of the strength. The larger a material's compressive over tensile strength, the more bonds have broken in tension by then: the secant falls, and
the specimen widens more; above .5 a test reports no Poisson's ratio.

"""
NOTES = """
* **Allowed** is what a ready material has to meet. The searches aim at less (2 to 7 %), and end with status 1 where an unseen packing misses that:
  the strength of marble (3 %) does.
* **Granite and sandstone** were found by earlier searches from coarser spheres. Their scenes begin with the bonds found and check them: one trial.
* **Use granite for strengths only.** Its strength is 25 times that in tension. Bonds break in tension from a fifth of the strength on, E falls by a fifth
  to 40 % of it, and Poisson's ratio rises above .5, which no elastic specimen has, so that a test reports none: do not read deformations off it.
* **Scatter.** Of five packings of so few spheres unconfined strengths scatter by 5 to 9 %, those under pressure by 2 to 5 %, tension by 1 to 2 %. A scene of one packing
  may be further off.
* **What is calibrated is not predicted.** Six figures of each material (mortar: four, silica: three) were targets. Other figures (post-peak slope, flexural and
  splitting strength, toughness) are those of the bonds, and nobody has compared them.
* **Mortar** is one of lime and volcanic ash, soft and weak, for strengths only as granite is: its ratio of strength to tension is the same. No strength
  under pressure is known of it, Poisson's ratio is assumed. No source was found that has E, strength,
  tension and triaxial strengths of one cement mortar: only the strength of a high-strength mortar (82 MPa), and a friction angle of cement-lime mortars.
  To make one, copy `scenes/calibrate_mortar.prm` and set targets of your own.
* **Silica** has no strength in compression: no test of a specimen was found, and glass is as strong as its surface allows. A compression test of it
  has a curve, but its strength is null, with this reason (`Bond/Calibrated figures = elastic, tension`).
"""


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folders = [(name, Path(sys.argv[1]) / name) for name in MATERIALS if (Path(sys.argv[1]) / name / "found.prm").exists()]
    for search, folder in folders:
        path = ROOT / "scenes" / "materials" / f"{MATERIALS[search][0]}.prm"
        path.parent.mkdir(exist_ok=True)
        path.write_text(material_file(search, folder))
        print(f"wrote {path.relative_to(ROOT)}")
    results = ROOT / "bench" / "results" / "materials.md"
    results.write_text(HEADING + table(folders) + "\n" + BEYOND + beyond_table(folders) + "\n" + NOTES)
    print(f"wrote {results.relative_to(ROOT)}")


if __name__ == "__main__":
    main()
