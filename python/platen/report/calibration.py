"""The page of a calibration: targets beside calibrated values, parameters of the bonds, curves; of an abacus its moduli."""
import math
from functools import partial
from pathlib import Path

import numpy

from . import words
from .house import BLACK, BLUE, CYCLE, GPA, MARKS, MM, MPA, VERMILION, chart, legend_over
from .kit import Spread, over_packings, reading, table_with, with_unit
from .pages import Page, Section, Table
from .run import number_in

JUDGED = (("training", "packings calibrated on", BLUE), ("verification", "unseen packings", VERMILION))
FINDINGS = (("missed", "not met together"), ("at_bounds", "at its bound"), ("undetermined", "not determined by the targets"),
            ("correlated", "hardly distinguished"))
VARIED = ("radius_multiplier", "stiffness_ratio", "bond_poisson_ratio", "bond_modulus_pa")


def _named(key, value):
    """Words of a key of a summary with a unit, and its factor from SI."""
    unit, factor = ("degrees", 180 / math.pi) if key.endswith("_rad") else ("", 1)
    if key.endswith("_pa"):
        unit, factor = ("GPa", GPA) if abs(value) >= 1e9 else ("MPa", MPA)
    return with_unit(words.words_of_key(key.removesuffix("_rad")), unit), factor


def ratios(axes, targets):
    """Calibrated values over their targets, with the scatter of packings; grey: the tolerance."""
    for row, target in enumerate(targets):
        tolerance, label = number_in(target, "tolerance"), row == 0
        axes.barh(row, 2 * tolerance, 0.8, 1 - tolerance, color="#eeeeee", zorder=0, label="tolerance" if label else None)
        for k, (of, (_, name, colour)) in enumerate(zip(target["spreads"], JUDGED)):
            mean, low, high, y = *(value / target["value"] for value in of[:3]), row - 0.15 + 0.3 * k
            axes.errorbar(mean, y, None, [[mean - low], [high - mean]], MARKS[k], color=colour, capsize=3, label=name if label else None)
            if math.isfinite(mean):
                axes.annotate(f"{mean:.3f}", (high, y), (5, 0), textcoords="offset points", va="center", fontsize=8)
    axes.axvline(1, color=BLACK, lw=1)
    axes.margins(x=0.1)
    axes.set(xlabel="Calibrated value over target", ylim=(len(targets) - 0.4, -0.6))
    axes.set_yticks(range(len(targets)), [words.words_of_key(target["key"]) for target in targets])
    axes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=3)


def curve(axes, table):
    """Stress over strain of curve.csv, from rest: the target, the mean of the packings calibrated on, that of unseen ones."""
    gauge = "strain_gauge" in table
    for column, name, colour, line in (("calibrated_pa", JUDGED[0][1], BLUE, "-"), ("unseen_pa", JUDGED[1][1], VERMILION, "-"),
                                       ("wanted_pa", "target", BLACK, "--")):
        strain = table["strain_gauge" if gauge else "strain_platen"]
        axes.plot(numpy.r_[0, strain] * MM, numpy.r_[0, table[column]] * MPA, color=colour, ls=line, label=name)
    axes.set(xlabel=f"Axial strain {'of the gauge' if gauge else 'between platens'} (mm/m)", ylabel="Axial stress (MPa)")
    legend_over(axes, 3)


def abacus(axes, rows, key, title):
    """A figure of the specimen over the first parameter of its bonds that was varied, a curve for each choice of the others; a
    modulus over that of the bonds. rows: as in the summary."""
    x, *others = [one for one in VARIED if len({row[one] for row in rows}) > 1] or VARIED[-1:]
    curves = {}
    for row in rows:
        name = ", ".join(f"{words.words_of_key(one)} {row[one]:.4g}" for one in others if one != "bond_modulus_pa")
        curves.setdefault(name, {})[row[x]] = number_in(row, key) / (row["bond_modulus_pa"] if key.endswith("_pa") else 1)
    for k, (name, values) in enumerate(curves.items()):
        axes.plot(list(values), list(values.values()), MARKS[k % len(MARKS)] + "-", color=CYCLE[k % len(CYCLE)], label=name or None)
    axes.set(xlabel=words.words_of_key(x).capitalize(), ylabel=title)
    legend_over(axes, 2)


def _section_of_targets(summary, remarks):
    rows, drawn, found = [], [], []
    for target in summary["targets"]:
        name, factor = _named(target["key"], target["wanted"])
        target["value"], is_curve = target["wanted"] * factor, target.get("kind") == "curve"
        target["spreads"] = spreads = [over_packings(target[key], factor) if key in target else Spread() for key, *_ in JUDGED]
        misses = [number_in(target, key + "_miss") if is_curve else math.nan for key, *_ in JUDGED]
        rows.append([name, "the curve" if is_curve else words.digits(target["value"]),
                     *(of.words(".4g", 0) if math.isnan(miss) else f"off by {100 * miss:.4g} %" for of, miss in zip(spreads, misses)),
                     f"{100 * number_in(target, 'tolerance'):.3g} %", "yes" if target.get("met", target["met_in_training"]) else "no"])
        drawn += [target] if target["wanted"] and any(math.isfinite(of.mean) for of in spreads) else []
    tables = [Table(["target", "value", *(name for _, name, _ in JUDGED), "tolerance", "met"], rows, "Targets and calibrated values",
                    "In brackets: how many packings. +-: standard deviation; ...: range of fewer than five. A curve is off by the root "
                    "mean square over its largest stress.")]
    for key, value in summary.get("found", {}).items():
        name, factor = _named(key, value or 0)
        found += [[name, words.digits(value, factor)]] if value is not None else []
    tables += [Table(["parameter of the bonds", "calibrated value"], found)] if found else []
    remarks += [] if drawn else ["summary.json has no value of a target: there is no picture of them"]
    caption = ("Each calibrated value over its target, mean of the packings with their scatter (standard deviation, of fewer than five "
               "packings their range). Grey: the tolerance.")
    picture = chart("targets", caption, partial(ratios, targets=drawn), heights=0.4 + 0.5 * len(drawn), margin=1.9, titles=True)
    return Section("Targets and calibrated values", [picture] if drawn else [], tables)


def page_of(folder):
    """The Page of a folder of platen-calibrate, None of another. InputError where a file is damaged."""
    folder = Path(folder)
    results = words.results_in(folder)
    summary, sections, curves = results.info, [], []
    if summary.get("app") != "platen-calibrate":
        return None
    with reading(folder / "summary.json"):
        remarks = [f"{how}: {line}" for key, how in FINDINGS for line in summary.get(key, [])]
        if "targets" in summary:
            sections.append(_section_of_targets(summary, remarks))
        if summary.get("abacus"):
            draws = [partial(abacus, rows=summary["abacus"], key=key, title=title) for key, title in
                     (("youngs_modulus_gauge_pa", "Young's modulus over that of the bonds"), ("poisson_ratio", "Poisson's ratio"))]
            caption = "Moduli of the specimen over the parameters of its bonds, mean of the packings."
            sections.append(Section("Abacus", [chart("abacus", caption, *draws, heights=2.8, shared=True)]))
        for file in sorted(folder.glob("curve*.csv"), key=lambda file: (len(file.name), file.name)):
            table = table_with(file, "wanted_pa", "calibrated_pa", "unseen_pa")
            table_with(file, "strain_gauge" if "strain_gauge" in table else "strain_platen")
            caption = "Dashed: the target curve. Blue: mean of the packings calibrated on. Red: mean of unseen packings."
            curves.append(chart(file.stem, caption, partial(curve, table=table), heights=3.2))
    return Page(words.true_title(results), *words.head([results]), [*sections, Section("Curves", curves)], remarks)
