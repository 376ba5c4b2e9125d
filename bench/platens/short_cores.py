#!/usr/bin/env python3
"""Strength of short cylinders over that of height over diameter 2, by the friction of the platens, beside what laboratories find.

Usage: short_cores.py STUDY [PICTURE.png]     STUDY: the folder of platen-study friction bench/platens/short_cores.prm
"""
import pathlib
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import platen

# Over the strength at 2. ASTM C42: one over its correction factors; its row of .5 and those below 1 as a textbook on structural concrete prints them.
C42 = {2: 1.0, 1.75: 1 / 0.98, 1.5: 1 / 0.96, 1.25: 1 / 0.93, 1: 1 / 0.87}
TEXTBOOK = {1: 1.18, 0.75: 1.43, 0.5: 2.0}
HUGHES = {1: (1.21, 1.47)}  # Hughes and Bahramian 1967: cubes over prisms of 2.4, dry platens, the least and the largest of four mixes
MISS = 0.05                 # of a factor, that still meets it


def ratios(study):
    """{surface: {slenderness: ratios of each packing}} of the runs that are done."""
    strength = {}
    for row in study.rows:
        if row["status"] == "done":
            strength[row["surface"], row["slenderness"], row["seed"]] = row["strength_pa"]
    found = {}
    for (surface, slenderness, seed), value in strength.items():
        if (slender := strength.get((surface, 2.0, seed))) and value == value:
            found.setdefault(surface, {}).setdefault(slenderness, []).append(value / slender)
    return found


def told(values):
    return f"{numpy.mean(values):.2f} +- {numpy.std(values, ddof=1):.2f} ({len(values)})" if len(values) > 1 else f"{values[0]:.2f} (1)"


def meets(values, source):
    """Whether the mean is within MISS of the source's factor, or within the range of a source with one."""
    mean = numpy.mean(values)
    return source[0] <= mean <= source[1] if isinstance(source, tuple) else abs(mean / source - 1) <= MISS


def table(found):
    heights = sorted({h for of in found.values() for h in of if h != 2})
    print("| friction of the platens | " + " | ".join(f"{h:g} over 2" for h in heights) + " | meets |\n|" + " --- |" * (len(heights) + 2))
    for surface, of in found.items():
        met = [f"{name} at {h:g}" for name, source in (("ASTM C42", C42), ("the textbook's", TEXTBOOK), ("Hughes and Bahramian", HUGHES))
               for h in heights if h in of and h in source and meets(of[h], source[h])]
        print(f"| {surface} | " + " | ".join(told(of[h]) if h in of else "-" for h in heights) + f" | {', '.join(met) or 'none'} |")
    for name, source in (("ASTM C42", C42), ("textbook", TEXTBOOK), ("Hughes and Bahramian 1967, 1 over 2.4", HUGHES)):
        cells = [source.get(h, "-") for h in heights]
        print(f"| *{name}* | " + " | ".join(f"{c[0]} ... {c[1]}" if isinstance(c, tuple) else c if c == "-" else f"{c:.2f}" for c in cells) + " | |")


def picture(found, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(7, 4.2), dpi=150, layout="constrained")
    for k, (surface, of) in enumerate(found.items()):
        heights = sorted(of)
        axes.errorbar(numpy.array(heights) + 0.008 * (k - 2), [numpy.mean(of[h]) for h in heights], [numpy.std(of[h]) for h in heights],
                      marker="o", markersize=4, capsize=2, linewidth=1.2, label=f"friction {surface}" if surface[0].isdigit() else surface)
    axes.plot(list(C42), list(C42.values()), "ks", markersize=6, fillstyle="none", label="ASTM C42")
    axes.plot(list(TEXTBOOK), list(TEXTBOOK.values()), "k^", markersize=6, fillstyle="none", label="C42 as a textbook prints it, below 1 too")
    axes.vlines(1.03, *HUGHES[1], colors="0.5", linewidth=4, alpha=0.6, label="Hughes and Bahramian 1967, cube over prism")
    axes.set(xlabel="Height over diameter", ylabel="Strength over that at 2")
    axes.legend(fontsize=7)
    figure.savefig(path)


if __name__ == "__main__":
    if not 2 <= len(sys.argv) <= 3:
        sys.exit(__doc__)
    of_study = ratios(platen.Study(sys.argv[1]))
    table(of_study)
    if len(sys.argv) == 3:
        picture(of_study, sys.argv[2])
