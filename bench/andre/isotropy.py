#!/usr/bin/env python3
"""Figures 6, 7 and 8 of Andre et al. 2012 by the packings that run.sh made, as CSV. Usage: isotropy.py FOLDER, of pack_NUMBER_KAPPA_seed_SEED and lattice

isotropy.csv    packings by number and spread of radii, each seed, and those of all seeds together (`pooled`: what the walls order adds up, chance does
                not; first an ordered packing)
histogram.csv   figure 6: part of the contacts in each pair of opposite cells; density 1 is isotropic

Isotropy: chi_squared of the directions of contacts, 1 +- .11 where they have no preference. e is the paper's measure (11),
sum (f - 1/N)^2 / N over N = 320 cells, of the same contacts, each with both its ends; e_chance is what that is for as
many contacts without preference in equal cells, e_isotropic in these cells, which are not equal."""
import csv
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import platen

CELLS = 160  # pairs of opposite cells
ISOTROPY = ["contacts", "chi_squared", "e", "e_chance", "e_isotropic"]
PACKING = ["particles", "mean_radius_m", "packing_fraction", "core_packing_fraction", "coordination_number", "core_coordination_number"]


def isotropy(tables):
    """ISOTROPY of one packing, or of several together, by their directions.csv."""
    weights, counts = tables[0]["share_of_directions"], sum(table["contacts"] for table in tables)
    n = counts.sum()
    spread = ((counts / n - 1 / CELLS) ** 2).sum()
    uneven = ((weights - 1 / CELLS) ** 2 + weights * (1 - weights) / n).sum()
    both_ends = 2 / 4 / (2 * CELLS)  # two cells with half the share each, over N
    chi_squared = n * ((counts / n - weights) ** 2 / weights).sum() / (CELLS - 1)
    return [int(n), f"{chi_squared:.4g}"] + [f"{both_ends * v:.4g}" for v in (spread, (1 - 1 / CELLS) / n, uneven)]


def write(path, header, rows):
    with open(path, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([header, *rows])


folder = pathlib.Path(sys.argv[1]) if len(sys.argv) == 2 else sys.exit(__doc__)
alike = {}  # (number, kappa): [(seed, run), ...]
for name, run in platen.runs(folder).items():
    number, kappa, seed = name.removeprefix("pack_").replace("seed_", "").split("_") if name != "lattice" else ("face-centred cubic", 0, "")
    alike.setdefault((number, float(kappa)), []).append((seed, run, platen.read_table(run.folder / "directions.csv")))
rows, cells = [], []
for (number, kappa), packings in sorted(alike.items(), key=lambda one: (one[0][0].isdigit(), len(one[0][0]), one[0])):
    figures = [[run.summary[key] for key in PACKING] for _, run, _ in packings]
    rows += [[number, kappa, seed, *of, *isotropy([table])] for (seed, _, table), of in zip(packings, figures)]
    if len(packings) > 1:
        rows.append([number, kappa, "pooled", *(f"{statistics.mean(of):.5g}" for of in zip(*figures)), *isotropy([table for *_, table in packings])])
    if not number.isdigit() or number == "4000" and kappa in (0, 0.25):
        cells += [[number, kappa, *row.values(), row["share_of_contacts"] / row["share_of_directions"]] for row in packings[0][2].records()]
write(folder / "isotropy.csv", ["packing", "kappa", "seed", *PACKING, *ISOTROPY], rows)
write(folder / "histogram.csv", ["packing", "kappa", *packings[0][2], "density"], cells)
