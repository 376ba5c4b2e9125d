#!/usr/bin/env python3
"""Ready materials of finished searches: scenes/materials/NAME.prm and the tables of bench/results/materials.md.

    bench/materials/materials.py FOLDER     FOLDER/NAME is what platen-calibrate wrote for scenes/calibrate_NAME.prm. Heading and sources of the
                                            material's file stay; a new one begins with them
    bench/materials/materials.py measure BUILD FOLDER [NAME...]
                                            what platens and slenderness do to each material, and its Poisson's ratio to 40 % of the
                                            strength, on five packings: into FOLDER/NAME; what is there is kept. One thread, half a
                                            minute to two minutes a packing. `concrete` is scenes/parts/concrete.prm with these spheres
    bench/materials/materials.py platens FOLDER
                                            the table of these
"""
import math
import re
import statistics
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import platen  # noqa: E402

PAGE = ROOT / "bench" / "results" / "materials.md"
# Name of the search: name of the material's file. `concrete` is only measured.
MATERIALS = {"c40": "concrete_c40", "c70": "concrete_c70", "granite": "granite", "marble": "marble", "sandstone": "sandstone", "mortar": "mortar",
             "silica": "silica"}
TITLES = {**MATERIALS, "concrete": "parts/concrete.prm, spheres of 2.2 mm"}
# Key of a target: name, factor, unit, what a material has to meet on unseen packings (%; ranges of the laboratory lie within the last four), and
# the word of Bond/Calibrated figures for which it has to be met; all of one word have to. Strengths under pressure: 10 %, "confined".
TARGETS = {"youngs_modulus_gauge_pa": ("E", 1e9, "GPa", 3, "elastic"), "poisson_ratio": ("Poisson's ratio", 1, "", 3, "elastic"),
           "compressive_strength_pa": ("strength", 1e6, "MPa", 5, "compression"), "tensile_strength_pa": ("tension", 1e6, "MPa", 5, "tension"),
           "strength_pa_ratio": ("gain of a cube by friction", 1, "", 12, "friction"),
           "strength_pa_ratio_2": ("gain of a cylinder by friction", 1, "", 3, "friction"),
           "strength_pa_ratio_3": ("strength at h/d 1 over 2", 1, "", 5, "slenderness"),
           "secant_poisson_ratio": ("Poisson's ratio to 40 %", 1, "", 15, "secant ratio")}
ALL_WORDS = ("elastic", "compression", "confined", "tension", "friction", "slenderness", "secant ratio")


def figures(folder):
    """For each target of a search: name, unit, wanted, mean and deviation of the unseen packings, how far off and how far allowed (%), word."""
    for target in platen.Run(folder).summary["targets"]:
        pressure = re.search(r"Confining pressure = ([^,:]+)", target["target"])
        name, factor, unit, allowed, word = (f"strength at {pressure[1].strip()}", 1e6, "MPa", 10, "confined") if pressure else TARGETS[target["key"]]
        seen = target["verification"]
        yield name, unit, target["wanted"] / factor, seen["mean"] / factor, seen["deviation"] / factor, 100 * target["verification_miss"], allowed, word


def secants(folder):
    """Of the compression tests of the unseen packings, as text: E and Poisson's ratio from the start to 40 % of the strength (GPa, -), and the
    strain at the peak (mm/m); nothing where strength was no target. Above 0.5, which no elastic specimen has, a test reports no ratio."""
    seeds = platen.Run(folder).summary["verification"].get("compressive_strength_pa", {"seeds": 0})["seeds"]
    rows = [row for row in platen.read_table(folder / "trials.csv").records() if row["test"] == "compressive_strength_pa"]
    if not seeds:
        return []
    found = [[factor * row[name] for row in rows[-seeds:]] for name, factor in (("youngs_modulus_gauge_pa", 1e-9), ("poisson_ratio", 1),
                                                                                ("strain_at_peak_platen", 1e3))]
    (e, ratio, peak), above = [(statistics.mean(values), statistics.stdev(values)) for values in found], sum(value > 0.5 for value in found[1])
    return [f"{e[0]:.3g} +- {e[1]:.2g}", f"none (above 0.5 in {above} of 5)" if above else f"{ratio[0]:.2g} +- {ratio[1]:.1g}", f"{peak[0]:.3g} +- {peak[1]:.2g}"]


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
    """What the bonds hold for: the words of which the search had targets, all of them met on unseen packings."""
    verdicts = {}
    for *_, off, allowed, word in figures(folder):
        verdicts.setdefault(word, []).append(abs(off) <= allowed)
    return [word for word in ALL_WORDS if all(verdicts.get(word, [False]))]


def material_file(search, folder, before):
    """The text of scenes/materials/NAME.prm; heading and sources are those of the file before."""
    summary, found = platen.Run(folder).summary, sections(folder / "found.prm")
    specimen, words, missed = found["Specimen"], calibrated(folder), {}
    lines = [before[:before.index("# Holds for")].rstrip("\n"),
             f"# Holds for spheres of {entry(specimen, 'Sphere radius')} mean radius with a spread of {entry(specimen, 'Radius spread')}, packed random close, ends "
             f"ground by {entry(specimen, 'End layer')} radii, as in a cylinder of",
             f"# 50 mm x 100 mm ({summary['particles']} spheres), between dry steel platens (friction {entry(found['Platens'], 'Friction static')}). "
             "Another packing is\n# refused. Specimens of another size take spheres in proportion: 11.4 across the least width; other numbers are noted,\n"
             "# and need another calibration, or the exponents of Bond/Calibrated radius.", "# On five packings that the search did not see:"]
    for name, unit, wanted, mean, deviation, off, _, word in figures(folder):
        if word in words:
            lines.append(f"#   {name} {mean:.4g} +- {deviation:.2g} {unit}".rstrip() + f" (source {wanted:.4g}, {off:+.1f} %)")
        else:
            missed[word] = f" ({name} {mean:.3g}, source {wanted:.3g})"
    if without := [word + missed.get(word, "") for word in ALL_WORDS[4:] if word not in words]:
        lines.append(f"# Not calibrated: {', '.join(without)}.\n# What they are: bench/results/materials.md.")
    if beyond := secants(folder):
        lines += ["# E and Poisson's ratio above are those of small strains. From the start to 40 % of the strength, where bonds have broken already:",
                  f"#   E {beyond[0]} GPa, Poisson's ratio {beyond[1]}; strain at the peak {beyond[2]} mm/m"]
    lines.append(f"# Found by: platen-calibrate scenes/calibrate_{search}.prm")
    for section, keys in KEYS.items():
        lines += [f"subsection {section}"] + [f"  set {key} = {value}" for key in keys if (value := entry(found[section], key))]
        if section == "Bond":  # what they hold for: a run says so where a scene asks for more
            number, unit = entry(specimen, "Radius").split()
            lines += [f"  set Calibrated radius = {entry(specimen, 'Sphere radius')}", f"  set Calibrated width = {2e3 * float(number) / {'m': 1, 'mm': 1e3}[unit]:g} mm",
                      "  set Calibrated packing = random close", f"  set Calibrated figures = {', '.join(words)}"]
        lines.append("end")
    return "\n".join(lines) + "\n"


def renew(header, fresh):
    """Puts rows into the table of the page with this header, in place of those of the same materials."""
    names = ["laboratory, concrete", *TITLES.values()]
    before, rest = PAGE.read_text().split(f"\n{header}\n", 1)
    rule, *lines = rest.split("\n")
    end = next(k for k, line in enumerate(lines) if not line.startswith("|"))
    of = {row: row.split("|")[1].strip() for row in lines[:end] + fresh}
    rows = [row for row in lines[:end] if of[row] not in [of[one] for one in fresh]] + fresh
    PAGE.write_text("\n".join([before, header, rule, *sorted(rows, key=lambda row: names.index(of[row])), *lines[end:]]))
    print(f"wrote {PAGE.relative_to(ROOT)}")


# Laboratory of the table of platens: low and high; of concrete alone, no source has any of a rock.
LABORATORY = {"cube": (1.21, 1.59), "cylinder": (1.03, 1.11), "slenderness": (1.09, 1.21), "secant": (0.17, 0.23)}
SEEDS = 5
MEASURE = """include {include}
subsection Scene
  set Title = Platens and slenderness of {name}
  set Seed = 5
end
subsection Specimen
  set Shape = cylinder
  set Radius = 25 mm
  set Height = 100 mm
  set Sphere radius = 2.2 mm
end
subsection Platens
  set Friction static = 0.57
end
subsection Loading
  set Test = compression
  set Axial rate = {rate}
  set Target strain = {strain}
  set Stop at residual = 0.7
end
subsection Integration
  set Safety = 0.9
  set Damping = 0.5
end
subsection Calibrate
  set Seeds = {seeds}
  set Verification seeds = 0
  set Most trials = 1
  set Free =
  set Target 1 = poisson_ratio: 0.2
  set Target 2 = strength_pa at Specimen/Shape = box, Specimen/Radius =, Specimen/Width x = 50 mm, Specimen/Width y = 50 mm, {short} over Platens/Friction static = 0: 1.42
  set Target 3 = strength_pa over Platens/Friction static = 0: 1.08
  set Target 4 = strength_pa at {short} over Specimen/Height = 100 mm, Loading/Axial rate = {rate}, Loading/Target strain = {strain}: 1.15
end
"""


def measure(build, folder, names):
    """Runs platen-calibrate on what each material ships, once, without a search."""
    searches = {name: (f"materials/{of}.prm", f"calibrate_{name}") for name, of in MATERIALS.items()}
    searches["concrete"] = ("parts/concrete.prm", "calibrate_c40")
    for name in names or ["c40", "c70", "concrete", "marble", "granite", "sandstone", "mortar", "silica"]:
        include, search = searches[name]
        loading = sections(ROOT / "scenes" / f"{search}.prm")["Loading"]
        scene = folder / f"{name}.prm"
        scene.parent.mkdir(parents=True, exist_ok=True)
        rate, strain = entry(loading, "Axial rate"), entry(loading, "Target strain")
        short = f"Specimen/Height = 50 mm, Loading/Axial rate = {float(rate.split()[0]) / 2:g} m/s, Loading/Target strain = {2 * float(strain):g}"
        scene.write_text(MEASURE.format(include=ROOT / "scenes" / include, name=name, seeds=SEEDS, rate=rate, strain=strain, short=short))
        to = folder / name
        if (to / "summary.json").exists():
            continue
        done = subprocess.run([build / "apps" / "platen-calibrate", scene, "-o", to, "-t", "1", "--quiet",
                               *(["--resume"] if (to / "trials.csv").exists() else [])])
        if done.returncode not in (0, 1):  # 1: the targets are what laboratories have, not what the material meets
            sys.exit(f"{name}: status {done.returncode}")


def platen_rows(folder):
    """Of what measure() left, by packing: cube, cylinder, slenderness, secant ratio and strength (MPa), NaN where a specimen came to no peak."""
    rows = platen.read_table(folder / "trials.csv").records()
    by = {(row["test"], row["seed"]): row for row in rows}
    for seed in sorted({row["seed"] for row in rows}):
        strength = {test: row["strength_pa"] for (test, of), row in by.items() if of == seed}
        bare = strength["secant_poisson_ratio"]
        yield {"cube": strength["strength_pa_ratio"] / strength["strength_pa_ratio_over"],
               "cylinder": bare / strength["strength_pa_ratio_2_over"],
               "slenderness": strength["strength_pa_ratio_3"] / strength["strength_pa_ratio_3_over"],
               "secant": by["secant_poisson_ratio", seed]["poisson_ratio"], "strength": 1e-6 * bare}


def platen_cell(name, rows, source):
    """Mean +- deviation of the packings that have it; bold where it lies outside the laboratory's range."""
    values = [row[name] for row in rows if not math.isnan(row[name])]
    if name == "secant" and any(value > 0.5 for value in values):
        return f"none (above 0.5 in {sum(value > 0.5 for value in values)} of {len(values)})"
    if len(values) < 2:
        return f"none ({len(rows) - len(values)} of {len(rows)} came to no peak)"
    mean = statistics.mean(values)
    digits = ".1f" if name == "strength" else ".3f"
    text = f"{mean:{digits}} +- {statistics.stdev(values):{digits}}"
    if source and name in LABORATORY and not LABORATORY[name][0] <= mean <= LABORATORY[name][1]:
        text = f"**{text}**"
    return text + ("" if len(values) == len(rows) else f" ({len(values)} of {len(rows)})")


def main():
    arguments = sys.argv[1:]
    if len(arguments) > 2 and arguments[0] == "measure":
        return measure(Path(arguments[1]).resolve(), Path(arguments[2]).resolve(), arguments[3:])
    if len(arguments) == 2 and arguments[0] == "platens":
        rows, folder = [], Path(arguments[1])
        for name in [name for name in TITLES if (folder / name / "summary.json").exists()]:
            found = list(platen_rows(folder / name))
            judged = {"c40": found[0], "concrete": found[0], "c70": ("cube", "cylinder", "secant")}.get(name, ())
            rows.append(f"| {TITLES[name]} | " + " | ".join(platen_cell(column, found, column in judged) for column in found[0]) + " |")
        return renew("| material | gain of a cube by friction | gain of a cylinder (h/d 2) | strength at h/d 1 over 2 | Poisson's ratio to 40 % | "
                     "strength, MPa |", rows)
    if len(arguments) != 1:
        sys.exit(__doc__)
    folders = {name: Path(arguments[0], name) for name in MATERIALS if Path(arguments[0], name, "found.prm").exists()}
    for search, folder in folders.items():
        path = ROOT / "scenes" / "materials" / f"{MATERIALS[search]}.prm"
        path.write_text(material_file(search, folder, path.read_text()))
        print(f"wrote {path.relative_to(ROOT)}")
    renew("| material | figure | source | five unseen packings | off | allowed |",
          [f"| {MATERIALS[search]} | {name}{', ' + unit if unit else ''} | {wanted:.4g} | {mean:.4g} +- {deviation:.2g} | {off:+.1f} %"
           f"{'' if abs(off) <= allowed else ' **missed**'} | {allowed} % |"
           for search, folder in folders.items() for name, unit, wanted, mean, deviation, off, allowed, _ in figures(folder)])
    renew("| material | E to 40 % of the strength, GPa | Poisson's ratio to 40 % | strain at the peak, mm/m |",
          [f"| {MATERIALS[search]} | {' | '.join(cells)} |" for search, folder in folders.items() if (cells := secants(folder))])


if __name__ == "__main__":
    main()
