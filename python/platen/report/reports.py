"""The page of runs: which pictures it has, in their order."""
from functools import partial

from . import cracks, curves, fields, laboratory, platens, sleeve, specimen, stages, view, words
from . import comparison as compared
from ..errors import InputError
from .pages import Page, Section
from .run import TestRun


def read(folders):
    """TestRuns, with the frames that pictures are drawn of. InputError where one is damaged."""
    runs = [TestRun(folder) for folder in folders]
    for run in runs:
        for name in ("cracks", "events"):
            run.table(name)
        if run.series("specimen") is not None:
            for time in (0.0, run.peak_time, run.pattern_time, run.end_time):
                run.spheres(time)
        if run.series("contacts") is not None:
            run.grid("contacts", run.peak_time)
    return runs


def laboratory_of(run, file, columns=None):
    """The measured curve of a file."""
    area, extent = run.info.get("section", {}).get("area_m2"), run.extent if run.series("specimen") is not None else None
    return laboratory.read(file, columns, area=area, height=extent.height if extent else None)


def write_fields(run):
    """fields.pvd of a run (fields.write_fields). InputError where its frames do not allow it."""
    if not fields.has_stress(run):
        raise InputError(f"{run.folder}: no fields can be made: they need specimen.pvd with stress, contacts.pvd and packing_fraction in summary.json")
    return fields.write_fields(run)


def sections_of(run, measured=None):
    """Sections of one run, as far as its files allow."""
    made = [Section("Stress and energy", curves.pictures_of_curves(run, measured),
                    [laboratory.differences(run, measured)] if measured else []),
            stages.section_of_stages(run), stages.section_of_sides(run), Section("Acoustic emission", curves.pictures_of_events(run))]
    if run.series("specimen") is not None:
        made += [Section("Interactive view", [], element=partial(view.element, run)), Section("The specimen", specimen.pictures_of_specimen(run)),
                 Section("Cracks", cracks.pictures_of_cracks(run)), Section("Platens and ends", platens.pictures_of_ends(run)),
                 Section("The sleeve", sleeve.pictures_of_sleeve(run))]
    made.append(Section("Computing time", curves.pictures_of_costs(run)))
    return [section for section in made if section is not None]


def page_of_runs(runs, measured=None):
    """The page of a run, or of a run beside others."""
    leads, head = words.head_of_runs(runs)
    remarks = [f"{run.name}: {remark}" if len(runs) > 1 else remark for run in runs for remark in run.remarks]
    remarks += [f"{run.name}: no peak reached: the largest stress is no strength" for run in runs if run.peak_reached is False]
    if measured:
        remarks += measured.remarks
    sections = sections_of(runs[0], measured)
    if len(runs) > 1:
        charts = compared.pictures(runs)
        images = specimen.comparison(runs) if any(run.series("specimen") is not None for run in runs) else []
        sections.insert(0, Section("Comparison", [*charts, *images]))
        remarks += compared.remarks(runs)
    return Page(words.true_title(words.results_of(runs[0])), leads, head, sections, remarks)
