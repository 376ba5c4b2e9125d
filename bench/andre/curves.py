#!/usr/bin/env python3
"""Figures 6, 7, 8 and 17 of the runs that run.sh made, as CSV. Usage: curves.py FOLDER

isotropy.csv    figure 7: packings of 4000 spheres against the spread of radii, each seed, and all seeds together
                (`pooled`: what the walls order adds up, chance does not); first an ordered packing
histogram.csv   figure 6: part of the contacts in each pair of opposite cells; density 1 is isotropic
refinement.csv  figure 8: packings against the number of spheres, kappa = 0.25
scatter.csv     figure 17: modulus and Poisson's ratio against the number of spheres: the cube pulled between its ends, on
                its bounding section, and its interior (bulk); scatter_summary.csv: the spread over the seeds

Isotropy: chi_squared of the directions of contacts, 1 +- .11 where they have no preference. e is the paper's measure (11),
sum (f - 1/N)^2 / N over N = 320 cells, of the same contacts, each with both its ends; e_chance is what that is for as
many contacts without preference in equal cells, e_isotropic in these cells, which are not equal."""
import pathlib
import statistics
import sys

from runs import figure, platen, summaries, write

folder = pathlib.Path(sys.argv[1])
CELLS = 160  # pairs of opposite cells
PUBLISHED = {"youngs_modulus": 7, "poisson_ratio": 5}  # percent, "over 7 500" elements (andre et al. 2012, 5.3)
ENOUGH = 7500


def directions(name):
    return platen.read_table(folder / name / "directions.csv").records()


def isotropy(tables):
    """contacts, chi squared, e, e_chance, e_isotropic of one packing, or of several together."""
    weights = [row["share_of_directions"] for row in tables[0]]
    counts = [sum(rows) for rows in zip(*([row["contacts"] for row in table] for table in tables))]
    n = sum(counts)
    pairs = [(count / n, weight) for count, weight in zip(counts, weights)]
    chi_squared = n * sum((f - w) ** 2 / w for f, w in pairs) / (CELLS - 1)
    spread = sum((f - 1 / CELLS) ** 2 for f, _ in pairs)
    uneven = sum((w - 1 / CELLS) ** 2 + w * (1 - w) / n for _, w in pairs)
    both_ends = 2 / 4 / (2 * CELLS)  # two cells with half the share each, over N
    return [int(n), f"{chi_squared:.4g}"] + [f"{both_ends * v:.4g}" for v in (spread, (1 - 1 / CELLS) / n, uneven)]


ISOTROPY = ["contacts", "chi_squared", "e", "e_chance", "e_isotropic"]
PACKING = ["particles", "packing_fraction", "core_packing_fraction", "coordination_number", "core_coordination_number"]


def packings(pattern):
    """(number, kappa, seed), name and figures of each, in order."""
    found = []
    for name, summary in summaries(folder, pattern).items():
        number, kappa, seed = name.split("_")[1:]
        found.append(((int(number), float(kappa), int(seed)), name, [summary[key] for key in PACKING],
                      summary["mean_radius_m"]))
    return sorted(found)


# Figures 6 and 7.
rows, cells = [], []
if lattice := summaries(folder, "lattice").get("lattice"):
    rows.append(["face-centred cubic", 0, ""] + [lattice[key] for key in PACKING] + isotropy([directions("lattice")]))
    cells.append(("face-centred cubic", 0, "lattice"))
spreads = packings("pack_4000_*")
for kappa in sorted({key[1] for key, *_ in spreads}):
    same = [(key[2], name, figures) for key, name, figures, _ in spreads if key[1] == kappa and key[2] <= 3]
    for seed, name, figures in same:
        rows.append(["random close", kappa, seed] + figures + isotropy([directions(name)]))
    means = [f"{statistics.mean(values):.5g}" for values in zip(*(figures for _, _, figures in same))]
    rows.append(["random close", kappa, "pooled"] + means + isotropy([directions(name) for _, name, _ in same]))
    if kappa in (0, 0.25):
        cells.append(("random close", kappa, same[0][1]))
write(folder / "isotropy.csv", ["packing", "kappa", "seed"] + PACKING + ISOTROPY, rows)
axis = ["x", "y", "z", "share_of_directions", "contacts", "share_of_contacts"]
write(folder / "histogram.csv", ["packing", "kappa"] + axis + ["density"],
      [[packing, kappa] + [f"{row[key]:.6g}" for key in axis] +
       [f"{row['share_of_contacts'] / row['share_of_directions']:.4g}"]
       for packing, kappa, name in cells for row in directions(name)])

# Figure 8.
write(folder / "refinement.csv", ["number", "seed", "radius_m"] + PACKING + ISOTROPY,
      [[key[0], key[2], radius] + figures + isotropy([directions(name)])
       for key, name, figures, radius in packings("pack_*_0.25_*")])

# Figure 17.
QUANTITIES = ["youngs_modulus_gauge_pa", "poisson_ratio", "bulk/youngs_modulus_pa", "bulk/poisson_ratio"]
runs = []
for name, summary in summaries(folder, "bulk_*").items():
    number, seed = (int(part) for part in name.split("_")[1:])
    runs.append([number, seed, summary["particles"], summary["mean_radius_m"]] +
                [figure(summary, path) for path in QUANTITIES])
runs.sort()
write(folder / "scatter.csv", ["number", "seed", "particles", "radius_m"] + QUANTITIES,
      [["" if value is None else value for value in row] for row in runs])
groups = [(str(number), lambda n, number=number: n == number) for number in sorted({row[0] for row in runs})]
groups.append((f"{ENOUGH} and more", lambda n: n >= ENOUGH))
rows = []
for column, path in enumerate(QUANTITIES, 4):
    for label, belongs in groups:
        values = [row[column] for row in runs if belongs(row[0]) and row[column] is not None]
        if len(values) < 2:
            continue
        mean = statistics.mean(values)
        published = [p for key, p in PUBLISHED.items() if key in path and "more" in label]
        rows.append([path, label, len(values), f"{mean:.5g}", f"{100 * statistics.stdev(values) / mean:.2f}",
                     f"{100 * (max(values) - min(values)) / mean:.2f}"] + (published or [""]))
write(folder / "scatter_summary.csv",
      ["quantity", "number", "runs", "mean", "deviation_percent", "range_percent", "published_percent"], rows)
