"""A laboratory's list of measured figures beside those of a study: a table with a verdict, a picture, curves."""
import math
import re
import textwrap
from collections import namedtuple
from difflib import get_close_matches

import numpy

from ..errors import InputError
from ..results import Study, runs
from . import studies
from .house import BLACK, BLUE, GREY, MM, MPA, VERMILION, chart, digits
from .laboratory import of_specimen
from .laboratory_list import alike, once, read
from .pages import Section, Table
from .run import Results, TestRun, reading
from .words import with_unit, words_of_key

LONGEST = 110  # letters of a reason in the table; longer ones are remarks
RULE = ("Scatter: root of the sum of the squares of both standard deviations, as far as there are two measured or computed specimens. A figure "
        "agrees where the difference is not above two scatters; without a scatter nothing is said.")


class Compared(namedtuple("Compared", "row case over values packings reason")):
    """A Row beside a study. case, over: Cases, the latter None where there is none; values: of the packings that have it, of `packings`;
    reason: why none has."""

    @property
    def mean(self):
        return float(numpy.mean(self.values)) if len(self.values) else math.nan

    @property
    def deviation(self):
        return float(numpy.std(self.values, ddof=1)) if len(self.values) > 1 else math.nan

    @property
    def scatter(self):
        """NaN where neither has one."""
        return math.sqrt(sum(one * one for one in (self.row.deviation, self.deviation) if one > 0)) or math.nan

    @property
    def agrees(self):
        """None where nothing can be said."""
        off = abs(self.mean - self.row.value)
        return None if math.isnan(off / self.scatter) else off <= 2 * self.scatter


def _case_of(study, row, column, text):
    """The Case of that name, or of those entries, of which as many will do as tell it from the others."""
    said, wanted = {one["name"]: ", ".join(one.get("overrides", [])) for one in study.said["cases"]}, alike(text)
    fits = [name for name, entries in said.items() if text == name or (wanted and wanted <= alike(entries))]
    fits = [name for name in fits if text == name or wanted == alike(said[name])] or fits
    if len(fits) == 1:
        return study.cases[fits[0]]
    what = f"fits {len(fits)} cases of" if fits else "is no case of"
    row.refuse(column, f"{what} {study.folder}. Allowed: {', '.join(fits or said)}, or the entries of one, as {said[(fits or [*said])[0]]!r}")


def _by_seed(study, table, case, figure):
    """{seed: figure} of the packings of a case, NaN where it is not given; a strength is none before the peak."""
    found, of_peak = {}, re.search("strength|at_peak", figure)
    for name, seed, value in zip(table["case"], table["seed"], table[figure]):
        if name == case.name:
            run = Results(study.folder / "runs" / f"{name}_seed_{seed:.0f}") if of_peak else None
            found[seed] = math.nan if run and run.info.get("peak_reached") is False else value
    return found


def compare(study, rows):
    """Compared of each row of a list with a Studied. InputError for a case or a figure that the study does not have."""
    table, found = Study(study.folder).table, []
    figures = [key for key in list(table)[list(table).index("status") + 1:] if table[key].dtype.kind == "f"]
    for row in rows:
        if row.figure not in figures:
            near = get_close_matches(row.figure, figures) or figures
            row.refuse("figure", f"is no number of study.csv. {'Near' if near != figures else 'Allowed'}: {', '.join(near)}")
        case, over = _case_of(study, row, "case", row.case), _case_of(study, row, "over", row.over) if row.over else None
        values = _by_seed(study, table, case, row.figure)
        if over:
            below = _by_seed(study, table, over, row.figure)
            values = {seed: value / below[seed] if below.get(seed) else math.nan for seed, value in values.items()}
        there = [value for value in values.values() if math.isfinite(value)]
        why = [studies.reasons(study.folder, one.name, key) for one in (case, over) if one and not there
               for key in dict.fromkeys((row.figure, row.figure.partition("/")[0]))]
        found.append(Compared(row, case, over, there, len(values), "; ".join(filter(None, why)) or "no packing has it, or reached its peak"))
    once(rows, [(one.row.figure, one.case.name, one.over and one.over.name) for one in found])
    return found


def _shown(one):
    """(name, unit, factor from SI) of a figure as a table has it."""
    unit, factor = next(((unit, factor) for part, unit, factor in (("strain", "mm/m", MM), ("modulus", "GPa", 1e-9), ("_pa", "MPa", MPA),
                                                                    ("_deg", "degrees", 1))
                         if part in one.row.figure and not one.over), ("", 1))
    return words_of_key(one.row.figure), unit, factor


def _words(study, one):
    return study.words(one.case) + (f" over {study.words(one.over)}" if one.over else "")


def table_of(study, compared):
    """A pages.Table: a row for each figure that was measured."""
    rows = []
    for one in compared:
        name, unit, factor = _shown(one)

        def spread(mean, deviation, factor=factor):
            return digits(mean, factor) + (f" +- {deviation * factor:.2g}" if deviation > 0 else "")
        count, off = f"{len(one.values)} of {one.packings}" if len(one.values) < one.packings else str(one.packings), one.mean - one.row.value
        verdict = textwrap.shorten(f"none: {one.reason}", LONGEST, placeholder=" ...") if not one.values else {True: "agrees", False: "does not", None: "-"}[one.agrees]
        rows.append([with_unit(name, unit), _words(study, one), spread(one.row.value, one.row.deviation), spread(one.mean, one.deviation), count,
                     digits(100 * off / abs(one.row.value)) if one.row.value else "-", digits(off / one.scatter), verdict])
    note = "+-: standard deviation. Ratios are of the packings one by one. Difference: computed less measured. " + RULE
    return Table(["figure", "case", "laboratory", "computed", "packings", "difference (%)", "over scatter", ""], rows, "", note)


def forest(axes, study, compared):
    """Computed over measured, a line for each figure, with two scatters to both sides."""
    names = []
    for k, one in enumerate(compared):
        ratio, half = one.mean / one.row.value, 2 * one.scatter / abs(one.row.value)
        colour = {True: BLUE, False: VERMILION, None: GREY}[one.agrees]
        axes.hlines(k, ratio - half, ratio + half, color=colour, lw=1.4)
        axes.plot(ratio, k, "o", color=colour)
        names.append(textwrap.fill(f"{_shown(one)[0]}, {_words(study, one)}", 44))
    axes.axvline(1, color=BLACK, lw=0.8)
    axes.set_yticks(range(len(names)), names)
    axes.set(xlabel="Computed over measured", ylim=(len(names) - 0.4, -0.6))
    axes.grid(False, axis="y")


def curves(axes, study, case, tests, measured):
    """Stress over strain of the packings of a case, thin, and what was measured."""
    sign = -1 if tests[0].peak_stress < 0 else 1
    for n, curve in enumerate(measured):
        axes.plot(sign * curve.strain * MM, sign * curve.stress * MPA, color=BLACK, lw=1.8, label=None if n else "laboratory")
    studies.stress(axes, study, [case], {case.name: tests})


def added(page, folder, file, columns=None):
    """The Page of the study in a folder, led by a list beside it. columns: of the curves, as laboratory.read takes them."""
    study, pictures, charts, remarks, files = studies.Studied(folder), [], [], [], {}
    if study.kind in studies.ERRORS:
        raise InputError(f"--laboratory is for runs and studies of cases; {folder} is of a study of {study.kind}")
    with reading(study.folder / "study.csv"):
        compared = compare(study, read(file))
    drawn, judged = [one for one in compared if one.row.value and one.values], [one for one in compared if one.agrees is not None]
    if drawn:
        caption = ("Computed over measured. Bars: two scatters, so that a figure agrees (blue) where its bar reaches 1, and does not (orange) "
                   "where it ends before. Grey: no scatter is known, and nothing is said.")
        pictures.append(chart("laboratory_figures", caption, forest, study=study, compared=drawn, heights=0.4 + 0.36 * len(drawn), margin=2.9))
    for one in compared:
        if one.row.curve:
            files.setdefault(one.case.name, {})[one.row.curve] = None
    if columns and not files:
        raise InputError(f"--columns = {columns!r} has no effect: {file} names no curve")
    for name in files:
        tests = [TestRun(run.folder) for run in runs(study.folder / "runs", f"{name}_seed_*").values() if run.status == "done"]
        if not tests or len(charts) == studies.MOST:
            remarks.append(f"{name}: the measured curve is not drawn: {f'{studies.MOST} others are' if tests else 'no run is kept'}")
            continue
        measured = [of_specimen(tests[0], one, columns) for one in files[name]]
        remarks += [text for curve in measured for text in curve.remarks]
        charts.append(chart(f"laboratory_{name}", f"{study.words(study.cases[name])}: measured, and each packing.", curves, study=study,
                            case=study.cases[name], tests=tests, measured=measured))
    remarks += [f"{_words(study, one)}: no {_shown(one)[0]}: {one.reason}" for one in compared
                if not one.values and len(one.reason) > LONGEST - 6]
    lead = f"Laboratory's list: {sum(one.agrees for one in judged)} of {len(judged)} figures that have a scatter agree within two of it."
    section = Section("Measured and computed", pictures + charts, [table_of(study, compared)])
    return page._replace(leads=[lead, *page.leads], sections=[section, *page.sections], remarks=[*page.remarks, *remarks])
