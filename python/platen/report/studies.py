"""Pages of studies: strength over friction, slenderness, size, packing or rate; errors over cost; an ordered accuracy."""
import math
from collections import Counter, namedtuple
from copy import copy
from functools import partial
from pathlib import Path

import numpy

from ..errors import InputError
from ..results import Study, runs
from .envelope import line_of, mohr, strength_en_1998_3, strength_over_pressure, strength_richart
from .house import BLACK, CYCLE, GPA, GREY, MARKS, MM, MPA, chart, digits, legend_over, plain_decades, scatter_bars, titled
from .pages import Page, Section, Table
from .precision import section_of_accuracy, section_of_target
from .run import Results, TestRun, listed, number_in, number_with_unit, reading
from .words import ENDINGS, Spread, head, over_packings, true_title, with_unit

MOST = 6  # cases in a chart of stress over strain
GAIN, RELATIVE = "gain over free ends", "strength over that at slenderness 2"
PLATENS, PARAMETERS, ERRORS = ("friction", "slenderness"), ("size", "packing", "rate", "vary"), ("accuracy", "target")
# What cases differ in: words of axes, words of tables and legends, unit, factor from SI. The first that differs is an x axis.
COLUMNS = {"across": ("Diameter of the specimen over that of a sphere", "spheres across", "", 1),
           "friction_static": ("Coefficient of friction of the platens", "friction", "", 1),
           "slenderness": ("Height over width", "height/width", "", 1), "strain_rate": ("Axial strain rate", "strain rate", "1/s", 1),
           "axial_rate_m_s": ("Platen speed", "speed", "mm/s", 1e3), "sphere_radius_m": ("Sphere radius", "sphere radius", "mm", 1e3),
           "radius_m": ("Radius of the specimen", "radius", "mm", 1e3), "height_m": ("Height of the specimen", "height", "mm", 1e3),
           "gap_over_radius": ("Gap over the least sphere radius", "gap/radius", "", 1), "gap_m": ("Gap", "gap", "mm", 1e3),
           "radius_multiplier": ("Radius multiplier of the bonds", "multiplier", "", 1),
           "radius_spread": ("Spread of the sphere radii", "spread", "", 1), "confining_pressure_pa": ("Cell pressure", "cell", "MPa", MPA)}
# Figures of a case: words of axes, words of tables, factor from SI, digits after the point.
FIGURES = {"strength_pa": ("Strength (MPa)", "strength (MPa)", MPA, 1),
           "youngs_modulus_gauge_pa": ("Young's modulus (GPa)", "E (GPa)", GPA, 1),
           "poisson_ratio": ("Poisson's ratio", "Poisson's ratio", 1, 3),
           "strain_at_peak_platen": ("Strain at peak (mm/m)", "strain (mm/m)", MM, 2),
           "particles": ("Spheres", "spheres", 1, 0), "packing_fraction": ("Solid fraction", "solid fraction", 1, 3)}
DRAWN = ("strength_pa", "youngs_modulus_gauge_pa", "strain_at_peak_platen")
BARS = "Bars: standard deviation over the packings, of fewer than five packings their range. One packing has no bar and no line."
NOTE = "+-: standard deviation; ...: range of fewer than five packings. In brackets: how many packings gave the figure, where not all did."


class Case(namedtuple("Case", "name surface labels figures runs packings without_peak")):
    """labels: what it has of COLUMNS, in their units. figures: Spreads by key of FIGURES, in their units. packings: that ended."""


class Studied(Results):
    """A study that has ended. said: its study.json. cases: {name: Case}. ratios: its comparisons, each with a "spread", and on which
    "side" of the laboratory's range it is, "" within it. InputError where it is damaged, has not ended, or is of a kind without a page."""

    def __init__(self, folder):
        super().__init__(folder)
        file, said = self.folder / "study.json", Study(folder).summary
        status, self.kind, self.said, self.ratios = said.get("status"), said.get("kind", "nothing"), said, []
        if status in ("running", "planned"):
            further = "--run, then --collect" if status == "planned" else "--resume"
            raise InputError(f"{file}: the study has not ended; go on with it by platen-study {self.kind} {further}")
        if self.kind not in (*PLATENS, *PARAMETERS, *ERRORS):
            raise InputError(f"{file}: is of a study of {self.kind}; pages are made of studies of friction, slenderness, size, packing, "
                             f"rate, vary, accuracy and target, and of single runs ({self.folder / 'runs'})")
        with reading(file):
            for key in said["varied"] if self.kind == "vary" else []:  # of any entries: words of their names, the SI unit at the end
                end, unit = next((both for both in ENDINGS if key.endswith(both[0])), ("", ""))
                name = key.removesuffix(end).replace("_", " ")
                COLUMNS.setdefault(key, (name.capitalize(), name, unit, 1))
            self.cases = {one["name"]: self._case(one) for one in (said.get("cases", []) if self.kind in ERRORS else said["cases"])}
            for one in said["comparisons"] if self.kind in PLATENS else []:
                for lost in {one["case"], one["over"]} - {*self.cases}:
                    raise ValueError(f"no case {lost}")
                spread, outside = over_packings(one), one.get("verdict") == "outside"
                side = ("above" if spread.mean > one["laboratory"]["high"] else "below") if outside else ""
                self.ratios.append({**one, "spread": spread, "side": side})

    def _case(self, said):
        varied, height = COLUMNS if self.kind not in ERRORS else (), number_with_unit(self.entry("Specimen/Height"))
        labels = {key: number_in(said, key) * COLUMNS[key][3] for key in varied if math.isfinite(number_in(said, key))}
        if self.kind == "size" and {"radius_m", "sphere_radius_m"} <= labels.keys():
            labels["across"] = labels["radius_m"] / labels["sphere_radius_m"]
        if self.kind == "rate" and height > 0 and "axial_rate_m_s" in labels:
            labels["strain_rate"] = labels.pop("axial_rate_m_s") / (height * MM)
        figures = {key: over_packings(said[key], FIGURES[key][2]) if key in said else Spread() for key in FIGURES}
        ended = said["runs"] - said.get("failed", 0) - said.get("missing", 0)
        surface = said["surface"] if self.kind in PLATENS else ""
        return Case(said["name"], surface, labels, figures, said["runs"], ended, said.get("without_peak", 0))

    @property
    def columns(self):
        """Keys of COLUMNS in which cases differ; of platens without those that follow from others."""
        follow = ("friction_static", "height_m") if self.kind in PLATENS else ()
        labels = [case.labels for case in self.cases.values()]
        return [key for key in COLUMNS if key not in follow and len({of[key] for of in labels if key in of}) > 1]

    def words(self, case, keys=None):
        """What of a case differs from the others, as a legend has it: "grease, height/width 1"; of `keys` alone."""
        parts = [case.surface] if case.surface and (keys is None or "surface" in keys) else []
        parts += [f"{COLUMNS[key][1]} {case.labels[key]:.4g} {COLUMNS[key][2]}".strip() for key in self.columns
                  if key in case.labels and (keys is None or key in keys)]
        return ", ".join(parts) or (case.name if keys is None else "")

    def groups(self, keys):
        """{words: cases} of cases alike in keys."""
        groups = {}
        for case in self.cases.values():
            groups.setdefault(self.words(case, keys), []).append(case)
        return groups

    def value(self, case, key):
        """The Spread of a figure or of an effect, without a mean where it is not given; 1 of a case that others are taken over."""
        if case.without_peak and (key == "strength_pa" or key not in FIGURES):
            return Spread()
        if key in FIGURES:
            return case.figures[key]
        of = [one for one in self.ratios if one["effect"] == key and not one.get("reason")]
        found = [one["spread"] for one in of if one["case"] == case.name]
        return (found + [Spread(1, 1, 1, case.packings) for one in of if one["over"] == case.name] + [Spread()])[0]

    def curves(self, x):
        """{words: cases in the order of x} of what is drawn over a label. Platens that hold otherwise than by friction have no
        place over it."""
        cases = sorted((case for case in self.cases.values() if x in case.labels), key=lambda case: case.labels[x])
        sizes, curves = [[case.labels.get(key) for key in ("radius_m", "height_m")] for case in cases], {}
        for case, size in zip(cases, sizes):
            keys = [key for key in (*self.columns, *(("surface",) if x == "slenderness" else ())) if key != x]
            if x == "across":  # a specimen filled with several spheres, or one sphere in several specimens
                keys = ["radius_m", "height_m"] if sizes.count(size) > 1 else ["sphere_radius_m"]
            if x != "friction_static" or case.surface not in ("brush", "rubber sheet"):
                curves.setdefault(self.words(case, keys), []).append(case)
        return curves


# ---- charts
def over(axes, studies, x, key, named=True):
    """A figure (key of FIGURES) or an effect of the cases over a label (key of COLUMNS), a curve for each choice of the others; of
    an effect with what laboratories measured. A case without the figure is a gap. named: with a legend of the curves."""
    drawn, beside = 0, {}
    for n, study in enumerate(studies):
        outside = {one["case"] for one in study.ratios if one["effect"] == key and one["side"]}
        for name, cases in study.curves(x).items():
            colour, place = CYCLE[drawn % len(CYCLE)], [case.labels[x] for case in cases]
            mean, low, high, packings = numpy.array([study.value(case, key) for case in cases], float).T
            label = ": ".join(part for part in (study.name if len(studies) > 1 else "", name) if part)
            axes.plot(place, mean, MARKS[n % 3], color=colour, ls="-" if packings.max() > 1 else "", ms=5, label=label if named else None)
            scatter_bars(axes, place, low, high, colour)
            for k in (k for k, case in enumerate(cases) if case.name in outside):
                axes.annotate("outside the laboratory's range", (place[k], mean[k]), (6, 5), textcoords="offset points", fontsize=8)
            beside = {**{case.labels.get("slenderness", 0): colour for case in cases}, **beside}
            drawn += 1
    title, _, unit, _ = COLUMNS[x]
    axes.set(xlabel=with_unit(title, unit), ylabel=FIGURES[key][0] if key in FIGURES else key[0].upper() + key[1:])
    axes.margins(0.06, 0.1)
    if x in ("strain_rate", "axial_rate_m_s"):
        axes.set_xscale("log")
        plain_decades(axes.xaxis)
    if key not in FIGURES:
        axes.axhline(1, color=GREY, lw=0.8, zorder=1)
        _laboratory(axes, studies[0].said.get("laboratory", []), x, key, beside)
    legend_over(axes, 2 if named and len(studies) == 1 else 1)


def _laboratory(axes, measured, x, key, beside):
    """Means and ranges that laboratories measured, a symbol for each series: over friction at dry steel, in the colour of the curve
    of the same slenderness (beside: {slenderness: colour}), else where they were measured."""
    low, high = axes.get_xlim()
    series = {}
    for one in (one for one in measured if one["effect"] == key):
        near, source = [other for other in beside if abs(one["slenderness"] - other) <= 0.05 * other], one["source"].split(",")[0]
        if x == "friction_static" and near:
            series.setdefault((f"laboratory, height/width {one['slenderness']:.4g}: {source}", beside[near[0]]), []).append((0.57, one))
        elif x == "slenderness" and 0.95 * min(beside) <= one["slenderness"] <= 1.05 * max(beside):
            series.setdefault((f"laboratory, {one['platens']}: {source}", BLACK), []).append((one["slenderness"], one))
    for n, ((label, colour), points) in enumerate(series.items()):
        place = numpy.array([at for at, _ in points]) + (0.006 * (n + 1) * (high - low) if x == "friction_static" else 0)
        axes.scatter(place, [one["mean"] for _, one in points], marker=MARKS[3 + n % 7], color=colour, s=28, label=label, zorder=3)
        scatter_bars(axes, place, [one["low"] for _, one in points], [one["high"] for _, one in points], colour)


def stress(axes, study, cases, tests):
    """Stress over strain of cases: a colour each, a thin line for each packing. tests: lists of TestRuns by name of case."""
    for k, case in enumerate(cases):
        for n, run in enumerate(tests[case.name]):
            axes.plot(run.strain[run.rows] * MM, run.stress[run.rows] * MPA, color=CYCLE[k], lw=0.9, label=None if n else study.words(case))
    titled(axes, run.strain_title, run.stress_title, 2)


# ---- pictures and tables of cases
def _pictures_of_stress(studies, remarks):
    """Curves of all runs that ended, at most MOST cases a panel; [] where no run is kept."""
    draws = []
    for study in studies:
        tests = {}
        for name, run in runs(study.folder / "runs", "*_seed_*").items():
            try:
                if run.status == "done":
                    tests.setdefault(name.rpartition("_seed_")[0], []).append(TestRun(run.folder))
            except InputError as error:
                remarks.append(f"{name}: its curve is left out: {error}")
        cases = [case for case in study.cases.values() if case.name in tests]
        alike = sum(case.labels.get("slenderness") == cases[0].labels.get("slenderness") for case in cases) if cases else 0
        size = alike if 1 < alike <= MOST else math.ceil(len(cases) / max(1, math.ceil(len(cases) / MOST)))
        draws += [partial(stress, study=study, cases=cases[k : k + size], tests=tests) for k in range(0, len(cases), size or 1)]
    caption = "Stress over strain of all runs. Each colour is a case, each thin line one packing."
    return [chart("stress_strain", caption, *draws, heights=3.2, shared=True)] if draws else []


def _pictures_of_platens(studies, number="", which=""):
    """Strength and its ratios over friction and over slenderness, as far as these differ."""
    pictures = []
    for x, effect, name, caption in (
            ("friction_static", GAIN, "strength_friction", "Strength over the friction of the platens; below, over that with free ends."),
            ("slenderness", RELATIVE, "strength_slenderness", "Strength over height/width; below, over that at height/width 2.")):
        if len({case.labels[x] for study in studies for cases in study.curves(x).values() for case in cases}) < 2:
            continue
        draws = [partial(over, studies=studies, x=x, key="strength_pa")]
        if any(one["effect"] == effect and not one.get("reason") for study in studies for one in study.ratios):
            draws.append(partial(over, studies=studies, x=x, key=effect, named=False))
            caption += " Colours as above. Bars of a laboratory: its range" + ("; its symbols stand a little to the right of .57." if x == "friction_static" else ".")
        pictures.append(chart(name + number, f"{caption} {BARS}" + (f" Here: {which}." if which else ""), *draws, heights=3.0, shared=True))
    return pictures


def _pictures_of_parameters(studies):
    """Strength, modulus and strain at the peak over what was varied; [] where nothing was, or no case has one."""
    x = next((key for key in studies[0].columns if all(study.curves(key) for study in studies)), None)
    cases = [case for study in studies for case in study.cases.values()]
    keys = [key for key in DRAWN if x and any(math.isfinite(case.figures[key].mean) for case in cases)]
    draws = [partial(over, studies=studies, x=x, key=key, named=key == keys[0]) for key in keys]
    caption = f"Means of the packings; modulus of the gauge, strain between platens. {BARS} A case without the figure is a gap."
    return [chart(f"study_{studies[0].kind}", caption, *draws, heights=[2.8, 2.2, 2.2][: len(draws)], shared=True)] if draws else []


def tables_of_cases(study, title=""):
    """Cases with what they differ in and their strength; their other figures."""
    platens, cases, further = study.kind in PLATENS, study.cases.values(), []
    header = ["case", *(["platens"] if platens else []), *(with_unit(*COLUMNS[key][1:3]) for key in study.columns)]
    rows = [[case.name, *([case.surface] if platens else []), *(digits(case.labels.get(key)) for key in study.columns),
             str(case.runs) if case.packings == case.runs else f"{case.packings} of {case.runs}",
             ("> " if case.without_peak else "") + case.figures["strength_pa"].words(".1f", case.packings)] for case in cases]
    bore = " >: some packings reached no peak; their strength is larger." if any(case.without_peak for case in cases) else ""
    keys = [key for key in FIGURES if key != "strength_pa" and any(math.isfinite(case.figures[key].mean) for case in cases)]
    if keys:
        figures = [[study.words(case), *(case.figures[key].words(f".{FIGURES[key][3]}f", case.packings) for key in keys)] for case in cases]
        note = "E: of the gauge. Strain: at the peak, between platens."
        further = [Table(["case", *(FIGURES[key][1] for key in keys)], figures, title, note)]
    return [Table([*header, "packings", "strength (MPa)"], rows, title, NOTE + bore), *further]


def tables_of_ratios(study):
    """A table for each effect: ratios beside what laboratories measured."""
    tables = []
    for effect in dict.fromkeys(one["effect"] for one in study.ratios):
        rows, sources = [], {}
        for one in (one for one in study.ratios if one["effect"] == effect):
            case, of, said = study.cases[one["case"]], one["laboratory"], "-"
            verdict = f"{one['side']} the range" if one["side"] else "within" if of else "-"
            if of:
                said = f"{of['mean']:.2f} ({of['low']:.2f} ... {of['high']:.2f})"
                sources.setdefault(f"{of['platens']}: {of['source']}")
            rows.append([study.words(case), study.words(study.cases[one["over"]]), one["spread"].words(".3f", case.packings), said,
                         f"none: {one['reason']}" if one.get("reason") else verdict])
        tables.append(Table(["case", "over", "ratio", "laboratory", ""], rows, effect[0].upper() + effect[1:],
                            f"Laboratory, {'; '.join(sources)}." if sources else ""))
    return tables


def _failed(said):
    """What failed and what was missing, as remarks."""
    how = (("failed_runs", "failed"), ("missing_runs", "were missing when the tables were made"))
    return [f"{said[key]} of {said['runs']} runs {what}: no mean contains them" for key, what in how if said.get(key, 0) > 0]


def reasons(folder, case, figure):
    """Why a figure of a case does not count, from the summaries of its runs; "" where they say nothing."""
    said = [Results(path).info.get("validity") for path in sorted((folder / "runs").glob("*_seed_*"))
            if path.name.rpartition("_seed_")[0] == case]
    against = Counter(str(one) for each in said for one in listed(each, figure, object))
    return "; ".join(f"{count} of {len(said)} runs: {reason}" for reason, count in sorted(against.items()))


def _verdicts(study):
    """(sentences for the top, remarks): what is outside the laboratory's range, and why figures are not given."""
    remarks, judged = [], [one for one in study.ratios if one.get("verdict") and not one.get("reason")]
    for one in study.ratios:
        what, of = f"{one['effect']}, {study.words(study.cases[one['case']])}", one["laboratory"]
        if one["side"]:
            remarks.append(f"{what}: {one['spread'].words('.3f')} is {one['side']} the laboratory's range, "
                           f"{of['low']:.2f} ... {of['high']:.2f} ({of['source']})")
        if one.get("reason"):
            remarks.append(f"{what}: not given: {one['reason']}")
    for case in study.cases.values():
        if case.without_peak:
            remarks.append(f"{study.words(case)}: {case.without_peak} of {case.packings} runs reached no peak up to the target strain: "
                           "its strength is not compared")
        lost = f"{case.runs - case.packings} of {case.runs} runs failed" if case.packings < case.runs else ""
        for key in DRAWN if study.kind in PARAMETERS else DRAWN[:1]:
            why = reasons(study.folder, case.name, key) or lost if math.isnan(case.figures[key].mean) or case.without_peak else ""
            if why or math.isnan(case.figures[key].mean):
                remarks.append(f"{case.name}: no {FIGURES[key][0].split(' (')[0].lower()}{', ' if why else ''}{why}; a gap in the picture")
    outside = sum(one["side"] != "" for one in judged)
    lead = f"Laboratory: {outside or 'none'} of {len(judged)} ratios {'are' if outside > 1 else 'is'} outside the measured range."
    strengths = [case.figures["strength_pa"].mean for case in study.cases.values() if math.isfinite(case.figures["strength_pa"].mean)]
    range_of = [f"Strength {min(strengths):.1f} ... {max(strengths):.1f} MPa over {len(strengths)} cases."] if len(strengths) > 1 else []
    return range_of + ([lead] if judged else []), remarks + _failed(study.said)


def _section_of_failure(study, remarks):
    """Strength over the pressure on the sides, lines of failure and Mohr's circles, of each of the study's envelopes; None where it
    has none."""
    pictures, tables, pressure = [], [], "confining_pressure_pa"
    if pressure in study.columns and "envelopes" not in study.said:
        remarks.append("study.json is of an earlier version, without envelopes: no line of failure; --resume writes it anew")
    for said in listed(study.said, "envelopes"):
        cases = [study.cases[name] for name in said["cases"]]
        others = ["surface", *(key for key in study.columns if key != pressure)]
        name, line = study.words(cases[0], others) if study.kind in PLATENS else said["name"], line_of(said)
        levels = sorted((case.labels.get(pressure, 0), case.figures["strength_pa"]) for case in cases)
        levels = [(s3, of) for s3, of in levels if math.isfinite(of.mean)]
        if math.isnan(line.k):
            remarks.append(f"{name}: {said['reason']}")
            continue
        fc = levels[0][1].mean if levels[0][0] == 0 else math.nan
        laws = [[digits(value if s3 > 0 else math.nan) for value in (
            (of.mean - fc) / (s3 or 1), strength_en_1998_3(fc, s3), strength_richart(fc, s3))] for s3, of in levels]
        lines = [(f"{one['seed']}", line_of(one)) for one in listed(said, "packings")] + [("all", line)]
        note = f"s1 = q + k s3, through all points of a packing, and of all. +-: standard error. {said.get('reason', '')}".strip()
        tables += [Table(["pressure (MPa)", "packings", "strength (MPa)", "(s1 - fc) / s3", "EN 1998-3 (MPa)", "Richart (MPa)"],
                         [[f"{s3:.4g}", str(of.packings), of.words(".1f"), *law] for (s3, of), law in zip(levels, laws)], name),
                   Table(["packing (seed)", "points", "q (MPa)", "k", "c (MPa)", "phi (degrees)"],
                         [[of, str(one.count), *(digits(value) + (f" +- {error:.2g}" if error > 0 else "") for value, error in (
                             (one.q, one.q_error), (one.k, one.k_error), (one.cohesion, one.cohesion_error), (one.phi, one.phi_error)))]
                          for of, one in lines], "", note)]
        points = [(s3, of.mean, of.low, of.high) for s3, of in levels]
        caption = (f"{name}: above, strength over the pressure on the sides, the line through the strengths of all packings, and what EN "
                   f"1998-3 and Richart give for the same unconfined strength; below, Mohr's circles and the tangent of that line. {BARS}")
        pictures.append(chart("failure_envelope" + (f"_{len(pictures)}" if pictures else ""), caption, strength_over_pressure, mohr,
                              points=points, line=line, heights=[3.0, 3.4]))
    return Section("Failure under pressure", pictures, tables) if pictures else None


# ---- pages
def _page_of_cases(studies):
    """Of one study, or of several in the same figures."""
    several, platens, (leads, tables) = len(studies) > 1, studies[0].kind in PLATENS, head(studies)
    remarks, ratios, pictures = [], [], []
    for study in studies:
        start = f"{study.name}: " if several else ""
        lead, further = _verdicts(study)
        leads, remarks = leads + [start + text for text in lead], remarks + [start + text for text in further]
        tables = tables + tables_of_cases(study, study.name if several else "")
        ratios += [table._replace(title=start + table.title) for table in tables_of_ratios(study)]
    if platens and not several:  # alike in spheres and pressure
        for name, cases in studies[0].groups(["sphere_radius_m", "confining_pressure_pa"]).items():
            part = copy(studies[0])
            part.cases = {case.name: case for case in cases}
            pictures += _pictures_of_platens([part], f"_{len(pictures)}" if pictures else "", name)
    else:
        pictures = _pictures_of_platens(studies) if platens else _pictures_of_parameters(studies)
    said = len(remarks)
    failure = None if several else _section_of_failure(studies[0], remarks)
    if not pictures and failure is None and len(remarks) == said:
        count, differ = sum(len(study.cases) for study in studies), any(study.columns for study in studies)
        why = ("no case", "one case")[count] if count < 2 else "no case has a figure" if differ else "cases do not differ"
        remarks.append(f"{why}: there is no curve to draw")
    stresses = Section("Stress and strain", _pictures_of_stress(studies, remarks))
    sections = [Section("Results over what was varied", pictures, ratios), failure, stresses]
    return Page(" and ".join(map(true_title, studies)), leads, tables, sections, remarks)


def page_of(folder, *others):
    """The Page of a study's folder, None where it is none; with others of all in one figure: several of friction and slenderness, or of
    one other kind. InputError where one is damaged, has not ended, or does not go with the others."""
    folders = [Path(one) for one in (folder, *others)]
    lost = [one for one in folders if not (one / "study.json").exists()]
    if lost and not others:
        return None
    if lost:
        raise InputError(f"--compare: {lost[0]} holds no study, {folder} does. Allowed: studies with a study, runs with a run")
    studies = [Studied(one) for one in folders]
    kind, study = studies[0].kind, studies[0]
    for other in studies if others else []:
        if other.kind in ERRORS or (other.kind != kind and not {other.kind, kind} <= {*PLATENS}):
            raise InputError(f"--compare: {other.folder} is of a study of {other.kind}, {folder} of one of {kind}. Allowed: several of "
                             "friction or slenderness, several of size, of packing, of rate, of vary")
    with reading(study.folder / "study.json"):
        if kind not in ERRORS:
            return _page_of_cases(studies)
        section, remarks = (section_of_accuracy if kind == "accuracy" else section_of_target)(study.said)
        stresses = Section("Stress and strain", _pictures_of_stress(studies, remarks))
        leads, tables = head(studies)
        if kind == "target":  # what was ordered comes first
            leads, remarks = remarks[:1] + leads, remarks[1:]
        return Page(true_title(study), leads, tables, [section, stresses], remarks + _failed(study.said))
