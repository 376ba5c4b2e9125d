"""The page `Test report` by the standard that the scene names: rows as such a report has them, with what a simulation cannot know left open by
name."""
from functools import partial
from typing import NamedTuple

from ..errors import InputError
from . import curves, words
from .house import chart, digits
from .pages import Page, Section, Table
from .run import TestRun, listed, number_in
from .standard_figures import (DEPARTED, ELASTIC, FRACTURE_WORDS, STEP, STRAIGHT, Missing, Test, c469_points, chord_modulus,
                               chord_poisson, crack_damage, crack_initiation, cycle_modulus, cycle_rate, fracture_type, loading_rate,
                               loadings, secant_modulus, slenderness_factor, splitting_strength, straight_part, tangent, told)

OPEN = "____________________"
_UNITS = {"MPa": 1e-6, "GPa": 1e-9, "mm": 1e3, "mm2": 1e6, "kN": 1e-3, "": 1.0, "MPa/s": 1e-6}


class Row(NamedTuple):
    """figure(test): in SI, a word, or Missing; None: left open. step: to which the value is rounded, in its unit; 0: four digits. how: in
    words, or a function of the test."""

    what: str
    figure: object = None
    unit: str = ""
    step: float = 0
    how: object = "not known to a simulation"

    def value(self, test):
        """(value, reason): the value is None where the test does not give it."""
        try:
            return self.figure(test), ""
        except Missing as reason:
            return None, str(reason)

    def cells(self, test):
        title = words.with_unit(self.what, self.unit)
        if self.figure is None:
            return [title, OPEN, self.how]
        value, reason = self.value(test)
        if value is None:
            return [title, "-", reason]
        text = value if isinstance(value, str) else rounded(value * _UNITS[self.unit], self.step)
        return [title, text, self.how if isinstance(self.how, str) else self.how(test)]


def rounded(value, step):
    """To multiples of a step, with its digits; 0: four digits."""
    if not step:
        return f"{float(f'{value:.4g}'):g}"
    return f"{round(value / step) * step:.{len(f'{step:g}'.partition('.')[2])}f}"


# ---- what rows say
def _percent(share):
    return f"{100 * share:.0f} %"


def _of_speed(test, asked=""):
    """What the speed does in a simulation; asked: by the standard."""
    info = test.run.info
    crossings, signs = number_in(info, "wave_crossings_to_peak"), "; ".join(map(str, listed(info, "signs_of_haste", (dict, str))))
    return f"the standard: {asked} MPa/s. " * bool(asked) + ("No law of the model but its dashpots depends on time; speed adds inertia: waves crossed the "
            f"specimen {digits(crossings)} times before the peak, signs of haste: {signs or 'none'}")


def _of_chord(test):
    low, high = c469_points(test)
    return (f"chord from {digits(low.stress, 1e-6)} MPa at 50 um/m to {digits(high.stress, 1e-6)} MPa (40 % of the strength) at "
            f"{digits(high.strain, 1e6)} um/m")


def _of_straight(test):
    _, low, high = straight_part(test)
    return (f"straight line by least squares over {_percent(low)} to {_percent(high)} of the {test.curve.strength_words}, the longest part "
            f"that leaves the line through its ends by at most {_percent(STRAIGHT)} of it (ends in steps of {_percent(STEP)})")


def _of_cycle(test, number):
    low, high = loadings(test)[number - 1]
    return f"method A: from {digits(low[0], 1e-6)} to {digits(high[0], 1e-6)} MPa, loading {number} of {len(loadings(test))}"


def _of_fracture(test):
    return f"{FRACTURE_WORDS[fracture_type(test)]}; from pattern and cones of summary.json"


def _of_cell(test):
    at_peak = number_in(test.run.info, "confining_pressure_pa")
    return at_peak if at_peak > 0 else 0.0


# ---- rows that several standards have
def _blanks(*names):
    return [Row(name) for name in names]


NAME = Row("Specimen", lambda test: words.true_title(test.run), how="title of the scene")
HEIGHT = Row("Height", lambda test: test.height, "mm", 0.1, "of the specimen")
DIAMETER = Row("Diameter", lambda test: test.diameter, "mm", 0.1, "of the specimen")
ACROSS = Row("Smallest width or diameter", lambda test: test.width, "mm", 0.1, "of the specimen")
ENDS = Row("Ends", lambda test: test.entry("Specimen/Ends"), how="Specimen/Ends: of the packing")
RATE = Row("Rate of loading, 10 to 90 % of the strength", loading_rate, "MPa/s", 0, _of_speed)
LOAD = Row("Largest load", lambda test: told(test.run, "strength_pa", "strength") * test.area, "kN", 0.1, "strength times area")
STRENGTH = Row("Compressive strength", lambda test: told(test.run, "strength_pa", "strength"), "MPa", 0.1, "largest load over the section")
STRAINS = Row("Strains", lambda test: test.curve.strain_words, how=lambda test: "mean of the middle half of the specimen, by its spheres"
              if test.curve.by_gauge else "closure over the height")


def _slenderness(asked):
    return Row("Height over diameter", lambda test: test.height / test.width, "", 0.01, asked)


def _of_level(text):
    return lambda test: text + test.curve.strength_words


ROCK = [
    NAME, *_blanks("Source, depth and orientation of the core", "Rock, its texture, and angle of its layers to the axis",
                   "Date of the test", "Moisture and storage", "Temperature"),
    DIAMETER, HEIGHT]
ROCK_FIGURES = [
    ENDS, RATE, Row("Confining pressure at the peak", _of_cell, "MPa", 0.1, "of the cell; 0 without one"),
    STRENGTH._replace(how="axial stress at the peak"), STRAINS,
    Row("Tangent modulus at 50 %", lambda test: tangent(test).modulus, "GPa", 0.1, _of_level("straight line by least squares over 40 to 60 % of the ")),
    Row("Average modulus", lambda test: straight_part(test)[0].modulus, "GPa", 0.1, _of_straight),
    Row("Secant modulus", secant_modulus, "GPa", 0.1, _of_level("from 0 to 50 % of the ")),
    Row("Poisson's ratio, tangent", lambda test: tangent(test, lateral=True).poisson, "", 0.01,
        "that modulus over the slope of stress over lateral strain"),
    Row("Poisson's ratio, average", lambda test: straight_part(test, lateral=True)[0].poisson, "", 0.01, "the same of the average modulus"),
    Row("Crack initiation stress", lambda test: crack_initiation(test)[0], "MPa", 0.1,
        lambda test: f"{_percent(crack_initiation(test)[1])} of the {test.curve.strength_words}: the crack volumetric strain has lost {_percent(DEPARTED)} of the "
        f"largest volumetric strain (E, nu: up to {_percent(ELASTIC)} of the crack damage stress)"),
    Row("Crack damage stress", lambda test: crack_damage(test)[0], "MPa", 0.1,
        lambda test: f"{_percent(crack_damage(test)[1])} of the {test.curve.strength_words}: the volumetric strain reverses"),
    Row("Mode of failure", lambda test: _pattern(test), how="pattern of summary.json, at 0.8 of the peak after it")]
CONCRETE = [NAME, *_blanks("Date of casting, age at the test", "Curing, moisture at the test")]
FRACTURE = Row("Type of fracture (1 to 6)", fracture_type, "", 1, _of_fracture)


def _pattern(test):
    pattern = test.run.info.get("pattern")
    if not pattern:
        raise Missing("the summary has no pattern of failure")
    return pattern


class Standard(NamedTuple):
    """title: what the page is of; rows: in the order of the report."""

    title: str
    rows: list


STANDARDS = {
    "EN 12390-13": Standard("Secant modulus of elasticity of concrete in compression, method A", [
        *CONCRETE, *_blanks("Place and date of the test", "Adjustment of the specimen (grinding, capping)"),
        Row("Shape", lambda test: test.shape, how="of the specimen"), ACROSS, HEIGHT,
        _slenderness("2 to 4 for this standard"), ENDS,
        STRENGTH._replace(what="Compressive strength fc", how="of the same specimen, after the cycles"),
        Row("Rate of the first loading", cycle_rate, "MPa/s", 0, _of_speed), STRAINS,
        Row("Lower stress", lambda test: loadings(test)[0][0][0], "MPa", 0.1, "start of the first loading; 10 to 20 % of fc"),
        Row("Upper stress", lambda test: loadings(test)[0][1][0], "MPa", 0.1, "end of the first loading; a third of fc"),
        Row("Initial secant modulus E_C,0", partial(cycle_modulus, number=1), "GPa", 0.1, partial(_of_cycle, number=1)),
        Row("Stabilised secant modulus E_C,S", partial(cycle_modulus, number=3), "GPa", 0.1, partial(_of_cycle, number=3)),
        *_blanks("Deviations from the standard", "Statement of the person responsible")]),
    "ASTM C39": Standard("Compressive strength of a cylinder", [
        *CONCRETE, *_blanks("Date of the test"), DIAMETER, HEIGHT, _slenderness("below 1.8 the strength is corrected"),
        Row("Section", lambda test: test.area, "mm2", 1, "over which the stress is: Specimen/Section"), ENDS, *_blanks("Caps or pads"),
        RATE._replace(how=partial(_of_speed, asked="0.25 +- 0.05")), LOAD, STRENGTH,
        Row("Factor for height over diameter", slenderness_factor, "", 0.01, "factors of ASTM C42, interpolated; 1 from 1.8 on"),
        Row("Corrected strength", lambda test: told(test.run, "strength_pa", "strength") * slenderness_factor(test), "MPa", 0.1,
            "strength times that factor"),
        FRACTURE, *_blanks("Defects of specimen or caps")]),
    "ASTM C469": Standard("Static modulus of elasticity and Poisson's ratio of concrete in compression", [
        *CONCRETE, *_blanks("Date of the test"), DIAMETER, HEIGHT, _slenderness("of the specimen"), ENDS, RATE,
        STRENGTH._replace(how="of the same specimen"), STRAINS,
        Row("Chord modulus of elasticity", chord_modulus, "GPa", 0.1, _of_chord),
        Row("Poisson's ratio", chord_poisson, "", 0.01, "lateral over axial strain between the same two points"),
        *_blanks("Unit weight of the concrete")]),
    "ASTM D7012": Standard("Compressive strength and elastic moduli of intact rock", [
        *ROCK, _slenderness("the standard asks for 2 to 2.5"), *ROCK_FIGURES]),
    "ISRM": Standard("Uniaxial strength and deformability of rock, suggested methods", [
        *ROCK, _slenderness("the suggested method asks for 2.5 to 3"), *ROCK_FIGURES]),
    "EN 12390-6": Standard("Tensile splitting strength", [
        *CONCRETE, *_blanks("Date of the test"), DIAMETER, HEIGHT._replace(what="Length"),
        Row("Width of the strips", lambda test: test.entry("Platens/Strip width"), how="Platens/Strip width; 0: flat platens"),
        RATE._replace(how=partial(_of_speed, asked="0.04 to 0.06")),
        Row("Largest load", lambda test: told(test.run, "failure_load_n", "load at failure"), "kN", 0.01, "both platens"),
        Row("Tensile splitting strength", splitting_strength, "MPa", 0.05, "2 P / (pi L d)"),
        Row("Cracks near the loaded diameter", lambda test: told(test.run, "cracks_on_loaded_diameter", "share of cracks"), "", 0.01,
            "share of the broken bonds within a quarter of the radius"),
        *_blanks("Appearance of the concrete and of the fracture", "Defects of the specimen")])}


# ---- the page
def standard_of(run):
    """(word, Standard) that the scene names. InputError without one."""
    word = run.entry("Scene/Standard") or "none"
    if word not in STANDARDS:
        raise InputError(f"{run.folder}: --standard needs Scene/Standard, which is {word}. Allowed: {', '.join(STANDARDS)}")
    return word, STANDARDS[word]


def figures(run):
    """{row: (value in SI or a word, reason)} of what the standard of a run asks for; the value is None where there is a reason."""
    test = Test(run)
    return {row.what: row.value(test) for row in standard_of(run)[1].rows if row.figure is not None}


def page_of(folder):
    """The page of a run of platen-compress or platen-brazilian."""
    run = TestRun(folder)
    (word, standard), test = standard_of(run), Test(run)
    unknown = [row.what[0].lower() + row.what[1:] for row in standard.rows if row.figure is None]
    draw, caption = ((partial(curves.opening, run=run), "Splitting stress over the widening of the disc.") if run.has("opening_m") else
                     (partial(curves.stress, runs=[run]), "Stress over axial strain, and over lateral strain to the left."))
    picture = chart("standard_curve", caption, draw, heights=2.4, width=6.6)
    leads = [f"{word}: {standard.title}.", *words.verdict([run]),
             f"Computed by {run.info.get('version') or 'Platen'}, not measured. Not known to a simulation: {', '.join(unknown)}."]
    table = Table(["item", "value", "how"], [row.cells(test) for row in standard.rows])
    return Page("Test report", leads, [table], [Section("", [picture])], [])
