#!/usr/bin/env python3
"""Ready materials of scenes/materials: included by a scene of a few lines in another folder they are accepted without a remark, they
come from a search that ships, with its packing, another packing is refused and a test that they are not calibrated for has no figure; the figures in their heads are those of bench/results/materials.md and within what it allows.

    materials_test.py APPS     APPS: folder of the programs
"""
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ALLOWED = {"E": 3, "Poisson's ratio": 3, "strength": 5, "tension": 5}  # %; strengths under pressure 10; ranges of the laboratory: words()
SCENE = """include materials/{}.prm
subsection Specimen
  set Shape = cylinder
  set Radius = 12.5 mm
  set Height = 25 mm
  set Sphere radius = 1.1 mm
end
subsection Platens
  set Friction static = 0.57
end
subsection Loading
  set Axial rate = 0.1 m/s
  set Target strain = 0.01
end
"""
FIGURE = re.compile(r"^#   (.+?) ([\d.]+) \+- ([\d.]+)(?: [GM]Pa)? \(source ([\d.]+), ([-+][\d.]+) %\)$", re.M)

faults = []


def check(holds, what):
    print(f"{'ok     ' if holds else 'FAILED '} {what}")
    if not holds:
        faults.append(what)


def run(apps, name, *arguments):
    """A scene that includes the material: its exit status, what it said against it, and its summary where it wrote one."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "mine.prm").write_text(SCENE.format(name))
        done = subprocess.run([apps / "platen-compress", "mine.prm", *arguments], cwd=folder, capture_output=True, text=True)
        summary = Path(folder) / "results/mine/summary.json"
        summary = json.loads(summary.read_text()) if summary.exists() else {}
    said = [line for line in (done.stdout + done.stderr).splitlines() if re.search(r"\b(error|warning|note):", line)]
    return done.returncode, said, summary


def included(apps, name):
    status, said, _ = run(apps, name, "--dry-run")
    check(status == 0 and not said, f"{name} is accepted by a scene that includes it: status {status} {said}")
    status, said, _ = run(apps, name, "--dry-run", "-s", "Specimen/Packing = advancing front")
    check(status == 2 and any("Specimen/Packing = advancing front is not what the bonds are calibrated for" in line for line in said),
          f"{name} is refused with another packing: status {status} {said}")
    status, said, _ = run(apps, name, "--dry-run", "-s", "Specimen/Sphere radius = 0.9 mm")
    check(status == 0 and len(said) == 1 and "times that of the calibration" in said[0] and "13.9 spheres across the least width for 11.4" in said[0],
          f"{name} with other spheres is noted: status {status} {said}")
    standard = ["-s", "Specimen/Radius = 75 mm", "-s", "Specimen/Height = 300 mm", "-s", "Specimen/Sphere radius = 6.6 mm"]
    status, said, _ = run(apps, name, "--dry-run", *standard)
    check(status == 0 and not said, f"{name} is accepted as a cylinder of 150 mm x 300 mm with spheres in proportion: status {status} {said}")


def figures_of_tests(apps):
    """Silica was not calibrated in compression: a test has a curve, and no strength."""
    for name, has in (("silica", False), ("marble", True)):
        status, said, summary = run(apps, name, "-s", "Output/Fields = off", "-s", "Loading/Stop at residual = 0.5", "--quiet")
        strength, validity = summary.get("strength_pa"), summary.get("validity", {}).get("strength_pa")
        check(status == 0 and (strength is not None) == has and (has or any("without compression" in reason for reason in validity)),
              f"{name} in compression {'has' if has else 'has no'} strength: {strength}, {validity}, status {status} {said}")
        against = summary.get("validity", {}).get("poisson_ratio")
        check(summary.get("poisson_ratio") is None and any("without secant ratio" in reason for reason in against),
              f"{name} in compression has no Poisson's ratio to 40 % of the strength: {against}")
        against_e = summary.get("validity", {}).get("youngs_modulus_gauge_pa")
        # Without a peak a modulus is of a specimen in which nothing has broken.
        check(summary.get("youngs_modulus_gauge_pa") is not None or (not has and any("bonds had broken" in reason for reason in against_e)),
              f"{name} in compression has E, or none without a peak: {against_e}")


def words(name, text, table):
    """What friction and slenderness do, and the secant ratio, are claimed where the table of five packings has them within the laboratory's range; else
    a compression test has no Poisson's ratio."""
    claimed = re.search(r"^  set Calibrated figures = (.*)$", text, re.M)[1].split(", ")
    row = re.search(rf"^\| {name} \|(.*\|.*\|.*\|.*\|.*)\|$", table[table.index("## Platens"):], re.M)
    check(row is not None, f"{name} stands in the table of platens")
    cells = [cell.strip() for cell in row[1].split("|")]
    of = {"friction": cells[0:2], "slenderness": cells[2:3], "secant ratio": cells[3:4]}
    for word in of:
        bad = [cell for cell in of[word] if cell.startswith(("**", "no"))]  # outside, none, not measured
        check(word not in claimed or not bad, f"{name} claims {word} only where it is met: {of[word]}")
        check(word in claimed or re.search(rf"^# Not calibrated: .*{word}", text, re.M), f"{name} says that {word} is not calibrated")


def packing(name, text):
    """Bonds hold for one packing: without its entries a scene takes the default one, and gave half of the strength."""
    part = (ROOT / "scenes/parts/material_search.prm").read_text()
    for key in ("Sphere radius", "Radius spread", "Packing", "Ends", "End layer", "Gap", "Radius rule", "Radius multiplier"):
        line = re.search(rf"^  set {key} = .*$", part, re.M)
        check(line is not None and line[0] in text.splitlines(), f"{name} has the search's {key}: {line and line[0].strip()}")


def figures(name, text, table):
    found = FIGURE.findall(text)
    check(len(found) >= 3, f"{name} has figures in its head: {len(found)}")
    for what, mean, _, source, off in found:
        bound = ALLOWED.get(what, 10)
        check(abs(float(off)) <= bound, f"{name}: {what} {mean}, source {source}: {off} %, at most {bound} %")
        difference = 100 * (float(mean) / float(source) - 1)
        check(abs(difference - float(off)) <= 0.2, f"{name}: {what} {mean} is {off} % off {source}: {difference:+.2f} %")
        row = re.search(rf"^\| {name} \| {re.escape(what)}(?:, [GM]Pa)? \| {source} \| {mean} \+- ", table, re.M)
        check(row is not None, f"{name}: {what} = {mean} stands in the table")


def main():
    apps = Path(sys.argv[1]).resolve()
    files = sorted((ROOT / "scenes/materials").glob("*.prm"))
    table = (ROOT / "bench/results/materials.md").read_text()
    check(len(files) >= 6, f"there are materials: {[path.stem for path in files]}")
    for path in files:
        text = path.read_text()
        search = re.search(r"^# Found by: platen-calibrate (scenes/\S+\.prm)$", text, re.M)
        check(search is not None and (ROOT / search[1]).exists(), f"{path.stem} comes from a search that ships")
        included(apps, path.stem)
        packing(path.stem, text)
        figures(path.stem, text, table)
        words(path.stem, text, table)
    figures_of_tests(apps)
    check(set(re.findall(r"^\| (\w+) \| E,", table, re.M)) == {path.stem for path in files}, "the table has every material and no other")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
